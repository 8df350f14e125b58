"""Doing the same with every job of a command line, and saying what became of each."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterable, Sequence
from functools import partial

from zlmreport.cli.results import Result, attempt, refuse_shared_files
from zlmreport.cli.summary import summary
from zlmreport.cli.terminal import print_json, print_problems
from zlmreport.job.job import Job


def do_all(
    loaded: Sequence[Result],
    work: Callable[[Result, Job], Result],
    lines: Callable[[Result], Iterable[str]],
    options: Namespace,
    *,
    fail_on_nonconformity: bool = False,
) -> int:
    """Work on every job that has no mistake so far, and return the worst exit code.

    Parameters
    ----------
    loaded
        The jobs of the command line.
    work
        What is done with one.
    lines
        What people read of one that is done.
    options
        Of the command line: ``quiet`` and ``json``.
    fail_on_nonconformity
        Whether a limit that is not met counts as a failure.
    """
    results = []
    printed = False
    for checked in refuse_shared_files(loaded):
        result = attempt(checked, partial(work, checked, checked.job)) if checked.job else checked
        results.append(result)
        if result.error:
            print_problems(result.error)
        elif not (options.quiet or options.json):
            if printed:
                print()
            print(*lines(result), sep="\n", flush=True)
            printed = True
    code = max(result.exit_code(fail_on_nonconformity=fail_on_nonconformity) for result in results)
    if options.json:
        print_json(summary(results, code))
    return code
