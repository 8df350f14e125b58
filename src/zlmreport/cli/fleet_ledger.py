"""``zlmreport fleet report``, ``backup``, ``rebuild``: the overview anew, a ledger copied or made again."""

from __future__ import annotations

import datetime as dt
import os
import sys
from argparse import Namespace
from functools import partial
from pathlib import Path

from zlmreport.cli.terminal import make_visible, show_path
from zlmreport.errors import INCOMPLETE, AccessError, InputError, Place, count_in_words
from zlmreport.files import Document, write
from zlmreport.fleet.basis import write_path_in
from zlmreport.fleet.exports import write_calendar, write_metrics
from zlmreport.fleet.ledger import Ledger
from zlmreport.fleet.overview import make_overview
from zlmreport.fleet.printing import Names
from zlmreport.fleet.state import FleetState, Rules, describe_state
from zlmreport.job.fleet import FleetFile, find_jobs, is_retired, load_fleet
from zlmreport.plugin.registry import find_plugins


def report(options: Namespace) -> int:
    """Write the files anew, each whole or not at all; the ledger is only read."""
    fleet = load_fleet(options.fleet, extensions=lambda: find_plugins(files=options.plugin).extensions)
    state = _write_state(fleet)
    folder: Path = options.output or fleet.output
    names = Names(find_plugins(files=options.plugin).standards)
    files = os.path.relpath(fleet.output, folder)
    language = fleet.keys.language
    contents = (
        make_overview(state, language, names, files).encode(),
        write_metrics(state).encode(),
        write_calendar(state, language),
    )
    named = zip(fleet.reports, contents, strict=True)
    for path in write(Document(folder / name, content) for name, content in named):
        print(show_path(path))
    return 0


def _write_state(fleet: FleetFile) -> FleetState:
    found, unmatched = find_jobs(fleet)
    named = (write_path_in(fleet.path.parent, path) for path in found)
    jobs = [job for job in named if not is_retired(job, fleet)]
    with Ledger.open(fleet.ledger, fleet.name, create=False) as ledger:
        rules = Rules(fleet.keys.interval, partial(is_retired, fleet=fleet))
        night = ledger.find_last_night()
        if unmatched and night is None:
            raise InputError(unmatched)
        seen = night and night.see_at(dt.datetime.now(dt.UTC))
        return describe_state(fleet.name, ledger.list_entries(), jobs, seen, rules)


def backup(options: Namespace) -> int:
    """Copy the ledger; the file is whole or not there."""
    fleet = load_fleet(options.fleet)
    with Ledger.open(fleet.ledger, fleet.name, create=False) as ledger:
        try:
            options.output.parent.mkdir(parents=True, exist_ok=True)
            ledger.write_backup(options.output)
        except OSError as error:
            message = f"cannot be written: {error.strerror or error}"
            raise AccessError.at(Place(str(options.output)), message) from error
    print(show_path(options.output))
    return 0


def rebuild(options: Namespace) -> int:
    """Make the ledger again, and say what could not be taken into it."""
    from zlmreport.fleet.rebuilding import rebuild as from_certificates  # noqa: PLC0415 - reads them with all rooms

    fleet = load_fleet(options.fleet)
    now = dt.datetime.now(dt.UTC).isoformat(timespec="seconds")
    rebuilt = from_certificates(fleet, find_plugins(files=options.plugin), now)
    for problem in rebuilt.problems:
        print(make_visible(str(problem)), file=sys.stderr)
    count = len(rebuilt.numbers)
    are = "is" if count == 1 else "are"
    print(f"{count_in_words(count, 'certificate')} {are} in the ledger; the next night compares each")
    return INCOMPLETE if rebuilt.problems else 0
