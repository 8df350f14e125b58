"""A plugin with which the whole process goes: named, with exit code 2, and nothing is written."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest

from environments import ROOT
from processes import PATIENCE, ZLMREPORT, group, run
from verification.issued import READINGS
from zlmreport.presence import SIZE, Presence

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="processes are forked and watched")
_WHO = "standard 'drawn' of plugin drawn ({folder}/drawn.py): arithmetic"
_JOB = """\
schema: zlmreport/job/1
certificate: {number: A-1, kind: report}
axis: {name: X}
measurement: {source: {plugin: laser-csv, file: x.csv}}
evaluate: [drawn]
"""


def _laid_out(folder: Path, deed: str) -> None:
    """Write a job and the plugin of its standard, which does something before it computes."""
    text = (ROOT / "src/zlmreport/skeletons/standard.py.txt").read_text(encoding="utf-8")
    for name, value in {"identifier": "drawn", "words": "Drawn", "Class": "Drawn"}.items():
        text = text.replace(f"{{{{{name}}}}}", value)
    does = f"        {deed}\n        return Arithmetic(\n"
    text = text.replace("        return Arithmetic(\n", does).replace(
        "import numpy", "import os, sys\nimport numpy"
    )
    (folder / "drawn.py").write_text(text, encoding="utf-8")
    (folder / "x.csv").write_text(READINGS, encoding="utf-8")
    (folder / "job.yaml").write_text(_JOB, encoding="utf-8")


_OPTIONS = ("job.yaml", "--plugin", "drawn.py", "--format", "json", "--quiet")


@pytest.mark.parametrize(
    ("deed", "told"),
    [
        ("os._exit(0)", ": the process ended with exit code 0 while this plugin was at work"),
        ("os._exit(3)", ": the process ended with exit code 3 while this plugin was at work"),
        ("os.execv('/bin/true', ['true'])", ": the process ended with exit code 0 while"),
        ("os.kill(os.getpid(), 9)", ": the process was ended by SIGKILL while this plugin was at work"),
        ("os.abort()", ": the process was ended by SIGABRT while this plugin was at work"),
        ("os.close(1)", " closed or changed stdout"),
        ("os.close(2)", " closed or changed stderr"),
        ("os.closerange(0, 256)", " closed or changed stdout and stderr"),
        ("sys.stdout.close()", " closed or changed stdout"),
        ("os.fork()", " forked the process, and its copy came back"),
        ("sys.exit(0)", " raised SystemExit: 0 (drawn.py"),
    ],
)
def test_a_plugin_with_which_the_process_goes_is_named(deed: str, told: str, tmp_path: Path) -> None:
    _laid_out(tmp_path, deed)
    done = run(*ZLMREPORT, *_OPTIONS, cwd=tmp_path)
    assert done.returncode == 2
    assert _WHO.format(folder=tmp_path) + told in done.stderr
    assert not list(tmp_path.glob("A-1*"))


@pytest.mark.parametrize(
    "deed",
    [
        "pass",
        "os.fork() or os._exit(0)",
        "__import__('subprocess').run(['true'])",
        "__import__('multiprocessing').get_context('fork').Pool(1).map(abs, [1])",
    ],
)
def test_a_plugin_may_start_processes_of_its_own(deed: str, tmp_path: Path) -> None:
    _laid_out(tmp_path, deed)
    run(*ZLMREPORT, *_OPTIONS, cwd=tmp_path, check=True)
    assert (tmp_path / "A-1.json").is_file()


def test_a_plugin_that_ends_a_worker_of_a_fleet_is_named(tmp_path: Path) -> None:
    _laid_out(tmp_path, "os._exit(0)")
    fleet = "schema: zlmreport/fleet/1\nname: F\njobs: [job.yaml]\nledger: sqlite:///l.db\n"
    (tmp_path / "fleet.yaml").write_text(f"{fleet}output: {{directory: night}}\n", encoding="utf-8")
    done = run(*ZLMREPORT, "fleet", "fleet.yaml", "--plugin", "drawn.py", cwd=tmp_path)
    assert done.returncode == 4
    assert f"while this plugin was at work, twice: {_WHO.format(folder=tmp_path)}" in done.stdout


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGKILL])
def test_who_ends_the_command_ends_all_of_it(number: signal.Signals, tmp_path: Path) -> None:
    """The line to what it starts is closed once no process of it is left."""
    _laid_out(tmp_path, "__import__('time').sleep(100)")
    program = "import os, sys; os.write(1, b'x'); os.execv(sys.argv[1], sys.argv[1:])"
    with group(sys.executable, "-c", program, *ZLMREPORT, *_OPTIONS, cwd=tmp_path, stdout=-1) as process:
        assert process.stdout.read(1) == b"x"
        process.send_signal(number)
        assert process.stdout.read() == b""
        assert process.wait(PATIENCE) == -number


def test_what_is_noted_is_read_by_another() -> None:
    memory = memoryview(bytearray(SIZE))
    presence = Presence(memory)
    outer = presence.begin("source 'a': read")
    inner = presence.begin("source 'b': read" * 100)
    assert Presence(memory).called.startswith("source 'b': read")
    assert presence.end(inner) == ""
    assert Presence(memory).called == "source 'a': read"
    presence.end(outer)
    assert (Presence(memory).called, Presence(memory).last) == ("", "source 'a': read")


_TELLS_OF_NUMPY = """
import importlib.abc, os, sys
class Seen(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        if name == "numpy":
            print("threads:", os.environ.get("OPENBLAS_NUM_THREADS"), flush=True)
sys.meta_path.insert(0, Seen())
sys.argv = ["zlmreport", "plugins"]
from zlmreport.cli import watched_main
watched_main()
"""


def test_the_process_at_work_has_one_thread_for_small_matrices(monkeypatch: pytest.MonkeyPatch) -> None:
    """Numpy asks the environment once, while it is loaded."""
    monkeypatch.delenv("OPENBLAS_NUM_THREADS", raising=False)
    found = subprocess.run(
        [sys.executable, "-c", _TELLS_OF_NUMPY], capture_output=True, text=True, check=True
    )
    assert found.stdout.splitlines()[0] == "threads: 1"
