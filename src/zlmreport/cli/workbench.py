"""``zlmreport workbench``: the loop of the error model as a local web page."""

from __future__ import annotations

import contextlib
import signal
from argparse import Namespace
from types import FrameType
from typing import NoReturn

from zlmreport.errors import AccessError, Place
from zlmreport.plugin.registry import find_plugins

_PLACE = Place("zlmreport workbench")


def run(options: Namespace) -> int:
    """Serve the page of a job until the user ends it."""
    try:
        from zlmreport.web.app import Workbench, serve  # noqa: PLC0415 - an extra that need not be there
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in {"starlette", "uvicorn"}:
            raise
        raise AccessError.at(
            _PLACE, f"{package} is not installed; install the workbench: pip install 'zlmreport[workbench]'"
        ) from error
    workbench = Workbench.of(options.jobs, find_plugins(files=options.plugin), tuple(options.plugin))
    signal.signal(signal.SIGTERM, _end)
    with contextlib.suppress(KeyboardInterrupt):
        serve(workbench, options.port, _print_address, open_browser=not options.no_browser)
    return 0


def _end(_number: int, _frame: FrameType | None) -> NoReturn:
    """End as after Ctrl-C, so that nothing goes on beside."""
    raise KeyboardInterrupt


def _print_address(address: str) -> None:
    print(f"workbench: {address}")
    print("It answers this computer alone; Ctrl-C ends it.", flush=True)
