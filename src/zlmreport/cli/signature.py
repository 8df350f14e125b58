"""The option ``--sign``: whose key it names, and its password, which never stands on a command line."""

from __future__ import annotations

import os
import sys
from argparse import Namespace
from contextlib import AbstractContextManager, nullcontext
from getpass import getpass

from zlmreport.cli.arguments.main_job import SIGN_PASSWORD
from zlmreport.errors import InputError, Place
from zlmreport.job.job import Job
from zlmreport.pipeline import PDF
from zlmreport.plugins import Registry
from zlmreport.signing.signer import Signer, open_signer

_PLACE = Place("zlmreport --sign")


def signer_of(options: Namespace) -> AbstractContextManager[Signer | None]:
    """Return who signs, if anybody is asked to."""
    return open_signer(options.sign, _password, _PLACE) if options.sign else nullcontext()


def demand_something_to_sign(job: Job, registry: Registry) -> None:
    """Refuse a job that writes no PDF, rather than leave its user to believe that it is signed."""
    if not any(registry.renderer(identifier).suffix == PDF for identifier in job.formats):
        raise InputError.at(
            job.place_of("output.formats"),
            f"there is nothing to sign: {', '.join(job.formats)} is no PDF; add pdf to the formats",
        )


def _password(of: str) -> str:
    stated = os.environ.get(SIGN_PASSWORD)
    if stated is not None:
        return stated
    if not sys.stdin.isatty():
        raise InputError.at(
            _PLACE,
            f"the password of {of} is asked for at a terminal or stands in {SIGN_PASSWORD}: here is neither",
        )
    return getpass(f"Password of {of}: ", stream=sys.stderr)
