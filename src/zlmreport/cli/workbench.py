"""``zlmreport workbench``: the loop of the error model as a local web page."""

from __future__ import annotations

import contextlib
import datetime as dt
import signal
from argparse import Namespace
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

from zlmreport.cli.terminal import show_path
from zlmreport.errors import AccessError, InputError, Place
from zlmreport.files import Document, write_new
from zlmreport.job.parse import SUFFIXES, is_named_as_yaml
from zlmreport.looking import look_at, write_job_of
from zlmreport.plugin.registry import Registry, find_plugins

if TYPE_CHECKING:
    from zlmreport.web.answers import PageAnswers
    from zlmreport.web.folder import FolderWorkbench

_PLACE = Place("zlmreport workbench")
#: Suffixes of jobs; any other file holds readings.


def run(options: Namespace) -> int:
    """Serve the page of a job until the user ends it."""
    try:
        from zlmreport.web.app import serve  # noqa: PLC0415 - an extra that need not be there
    except ModuleNotFoundError as error:
        package = (error.name or "").partition(".")[0]
        if package not in {"starlette", "uvicorn"}:
            raise
        raise AccessError.at(
            _PLACE, f"{package} is not installed; install the workbench: pip install 'zlmreport[workbench]'"
        ) from error
    workbench = _open_workbench(options)
    signal.signal(signal.SIGTERM, _end)
    with contextlib.suppress(KeyboardInterrupt):
        serve(workbench, options.port, _print_address, open_browser=not options.no_browser)
    return 0


def _open_workbench(options: Namespace) -> PageAnswers | FolderWorkbench:
    """Return the page of a job, of a machine, or of a folder.

    Raises `InputError` if a folder or a machine stands beside other files, or a folder holds none.
    """
    from zlmreport.web.app import Workbench  # noqa: PLC0415 - the extra is there
    from zlmreport.web.folder import FolderWorkbench, JobFolder, find_jobs_in, is_machine  # noqa: PLC0415
    from zlmreport.web.machine_app import MachineWorkbench  # noqa: PLC0415

    registry, plugins = find_plugins(files=options.plugin), tuple(options.plugin)
    first, *others = (_find_job_of(each, registry) for each in options.jobs)
    folder = next((each for each in (first, *others) if each.is_dir()), None)
    if folder is None:
        machine = next(filter(is_machine, (first, *others)), None)
        if machine is None:
            return Workbench.of((first, *others), registry, plugins)
        if others:
            raise InputError.at(_PLACE, f"{machine} is a machine: name it alone; its tests stand in it")
        return MachineWorkbench.of(machine, registry, plugins)
    if others:
        raise InputError.at(_PLACE, f"{folder} is a folder: name it alone, or the jobs in it one by one")
    find_jobs_in(first)
    return FolderWorkbench(JobFolder(first, registry, dt.date.today), registry, plugins)


def _find_job_of(path: Path, registry: Registry) -> Path:
    """Return the job of what is opened: for a file of readings that beside it, written if there is none."""
    if is_named_as_yaml(path) or not path.is_file():
        return path
    job = path.with_suffix(SUFFIXES[0])
    if not job.exists():
        text = write_job_of(look_at(path, registry), path, job.parent)
        write_new([Document(job, text.encode())])
        print(f"{show_path(job)}: written for {show_path(path)}")
    return job


def _end(_number: int, _frame: FrameType | None) -> NoReturn:
    """End as after Ctrl-C, so that nothing goes on beside."""
    raise KeyboardInterrupt


def _print_address(address: str) -> None:
    print(f"workbench: {address}")
    print("It answers this computer alone; Ctrl-C ends it.", flush=True)
