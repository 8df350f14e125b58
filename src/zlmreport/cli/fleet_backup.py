"""``zlmreport fleet backup``: the ledger of a fleet in one file."""

from __future__ import annotations

from argparse import Namespace

from zlmreport.cli.terminal import shown_path
from zlmreport.errors import AccessError, Place
from zlmreport.fleet.ledger import Ledger
from zlmreport.job.fleet import load_fleet


def run(options: Namespace) -> int:
    """Copy the ledger; the file is whole or not there."""
    fleet = load_fleet(options.fleet)
    with Ledger.open(fleet.ledger, fleet.name, create=False) as ledger:
        try:
            options.output.parent.mkdir(parents=True, exist_ok=True)
            ledger.backup(options.output)
        except OSError as error:
            message = f"cannot be written: {error.strerror or error}"
            raise AccessError.at(Place(str(options.output)), message) from error
    print(shown_path(options.output))
    return 0
