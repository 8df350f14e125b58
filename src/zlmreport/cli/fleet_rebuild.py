"""``zlmreport fleet rebuild``: the ledger of a fleet, from its certificates."""

from __future__ import annotations

import datetime as dt
import sys
from argparse import Namespace

from zlmreport.cli.terminal import visible
from zlmreport.fleet.rebuilding import rebuild
from zlmreport.job.fleet import load_fleet
from zlmreport.plugins import find_plugins

_INCOMPLETE = 4


def run(options: Namespace) -> int:
    """Make the ledger again, and say what could not be taken into it."""
    fleet = load_fleet(options.fleet)
    now = dt.datetime.now(dt.UTC).isoformat(timespec="seconds")
    rebuilt = rebuild(fleet, find_plugins(files=options.plugin), now)
    for problem in rebuilt.problems:
        print(visible(str(problem)), file=sys.stderr)
    print(f"{len(rebuilt.numbers)} certificates are in the ledger; the next night compares each")
    return _INCOMPLETE if rebuilt.problems else 0
