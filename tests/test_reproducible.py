"""The same job gives the same bytes, wherever and whenever it is done."""

from __future__ import annotations

import os
import shutil
from dataclasses import dataclass, field
from hashlib import sha256
from pathlib import Path

import pytest

from environments import ROOT
from processes import PYTHON, run
from zlmreport.plugin.registry import find_plugins

JOB = """\
schema: zlmreport/job/1
extends: certificate.yaml
laboratory: {country: DE}
evaluate: ["iso230-2:2014", vdi-dgq-3441]
"""
RENDERERS = find_plugins().renderers
#: Of formats that write the same file, each in a run of its own.
RUNS = [
    [each.identifier for each in RENDERERS if each.identifier != "pdf-typst"],
    ["pdf-typst"],
]

#: The command line with a clock that is wrong by so many seconds.
_WITH_CLOCK = """
import datetime
import sys
import time

off = float(sys.argv.pop(1))
true_time, true_time_ns, true_localtime, true_gmtime = time.time, time.time_ns, time.localtime, time.gmtime
time.time = lambda: true_time() + off
time.time_ns = lambda: true_time_ns() + int(off * 1e9)
time.localtime = lambda seconds=None: true_localtime(time.time() if seconds is None else seconds)
time.gmtime = lambda seconds=None: true_gmtime(time.time() if seconds is None else seconds)


class Wrong(datetime.datetime):
    @classmethod
    def now(cls, tz=None):
        return cls.fromtimestamp(time.time(), tz)

    @classmethod
    def utcnow(cls):
        return cls.fromtimestamp(time.time(), datetime.UTC).replace(tzinfo=None)

    @classmethod
    def today(cls):
        return cls.now()


class WrongDate(datetime.date):
    @classmethod
    def today(cls):
        return cls.fromtimestamp(time.time())


datetime.datetime, datetime.date = Wrong, WrongDate

from zlmreport.cli import main

job, folder, *runs = sys.argv[1:]
for number, formats in enumerate(runs):
    if code := main([job, "--quiet", "--output", f"{folder}/{number}", "--format", formats]):
        sys.exit(code)
"""


@dataclass(frozen=True, slots=True)
class Circumstances:
    """What differs from run to run.

    `clock` is wrong by so many seconds; `place` is where the job and its data lie; `within` is whether the
    job is called from its own folder.
    """

    variables: dict[str, str] = field(default_factory=dict)
    clock: float = 0.0
    place: str = "jobs"
    within: bool = False


CIRCUMSTANCES = {
    "another day, language and order of sets": Circumstances(
        {
            "TZ": "Pacific/Kiritimati",
            "SOURCE_DATE_EPOCH": "1000000000",
            "PYTHONHASHSEED": "1",
            "LC_ALL": "C",
            "LANG": "C",
            "LANGUAGE": "de",
            "PYTHONUTF8": "0",
            "OPENPYXL_LXML": "False",  # as if lxml were not installed
        },
        clock=400 * 86400.5,
    ),
    "another folder, long ago": Circumstances(
        {"TZ": "America/Anchorage", "LC_ALL": "C.UTF-8", "PYTHONHASHSEED": "2", "HOME": "/nonexistent"},
        clock=-9000 * 86400.5,
        place="a folder ü/of old",
        within=True,
    ),
}


def _made(folder: Path, circumstances: Circumstances) -> dict[str, str]:
    """Make the files in a process of its own, and return the digest of each."""
    configs = shutil.copytree(ROOT / "configs", folder / circumstances.place, copy_function=shutil.copyfile)
    job = configs / "linear-axis" / "job.yaml"
    job.write_text(JOB, encoding="utf-8")
    date = len(circumstances.place) * 1e8
    for path in configs.rglob("*"):
        os.utime(path, (date, date))
    done = run(
        *(PYTHON, "-c", _WITH_CLOCK, str(circumstances.clock)),
        *(job.name if circumstances.within else job, folder / "out"),
        *map(",".join, RUNS),
        env={"PYTHONHASHSEED": "0", **os.environ, **circumstances.variables},
        cwd=job.parent if circumstances.within else folder,
    )
    assert (done.returncode, done.stderr) == (0, "")
    return {
        f"{path.parent.name}/{path.name}": sha256(path.read_bytes()).hexdigest()
        for path in (folder / "out").glob("*/*")
    }


@pytest.fixture(scope="module")
def first(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    return _made(tmp_path_factory.mktemp("first"), Circumstances())


@pytest.mark.long
def test_every_installed_format_is_compared(first: dict[str, str]) -> None:
    assert len(first) == len(RENDERERS) > 2


@pytest.mark.long
@pytest.mark.parametrize("circumstances", CIRCUMSTANCES.values(), ids=CIRCUMSTANCES)
def test_the_same_job_gives_the_same_bytes(
    circumstances: Circumstances, first: dict[str, str], tmp_path: Path
) -> None:
    assert _made(tmp_path, circumstances) == first
