"""``zlmreport verify``: whether a certificate holds, number by number."""

from __future__ import annotations

from argparse import Namespace

from zlmreport.cli.terminal import print_json
from zlmreport.cli.verify_json import as_json
from zlmreport.cli.verify_lines import lines
from zlmreport.plugins import find_plugins
from zlmreport.verification.verify import verify

_DOES_NOT_HOLD = 1


def run(options: Namespace) -> int:
    """Verify a certificate; return 1 if anything in it does not hold."""
    found = verify(options.certificate, find_plugins(files=options.plugin), options.dcc_schema)
    code = 0 if found.holds else _DOES_NOT_HOLD
    if options.json:
        print_json(as_json(options.certificate, found, code))
    else:
        print(*lines(options.certificate, found), sep="\n")
    return code
