"""``./run`` on machines that lack something: it says what, and what to do."""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from subprocess import CompletedProcess

import pytest

from environments import ROOT
from processes import run

_TOOLS = ["cat", "cksum", "dirname", "env", "sh"]
#: Answers as a Python 3.11 would that lacks nothing but a system library, and cannot make environments.
_PYTHON = """
case "$1" in
-) echo libpango-1.0-0 ;;
-c) case "$2" in *print*) echo 3.11 ;; esac ;;
*) exit 1 ;;
esac
"""


class Machine:
    """A machine on which only a few commands are installed."""

    def __init__(self, folder: Path) -> None:
        self.bin = folder / "bin"
        self.log = folder / "log"
        self.environment = folder / "environment"
        self.bin.mkdir()
        for tool in _TOOLS:
            found = shutil.which(tool)
            assert found, tool
            (self.bin / tool).symlink_to(found)

    def install(self, command: str, script: str) -> None:
        """Install a command that is a shell script, and logs how it is called."""
        path = self.bin / command
        path.write_text(f'#!/bin/sh\necho "{command} $*" >>"{self.log}"\n{script}\n', encoding="utf-8")
        path.chmod(0o755)

    def run(self, *arguments: str) -> CompletedProcess[str]:
        variables = {"PATH": str(self.bin), "ZLMREPORT_VENV": str(self.environment)}
        return run(ROOT / "run", *arguments, env=variables)

    def calls(self, command: str) -> list[str]:
        """Return how a command was called, in order."""
        return [
            line
            for line in self.log.read_text(encoding="utf-8").splitlines()
            if line.startswith(f"{command} ")
        ]


@pytest.fixture
def machine(tmp_path: Path) -> Machine:
    return Machine(tmp_path)


def test_without_python_it_says_which_one_is_needed(machine: Machine) -> None:
    done = machine.run("certificate")
    assert done.returncode == 1
    assert "Python 3.11 or newer is needed, and only these are here: none" in done.stderr


def test_a_python_that_is_too_old_is_named(machine: Machine) -> None:
    machine.install("python3", 'case "$2" in *print*) echo 3.9 ;; *) exit 1 ;; esac')
    done = machine.run("certificate")
    assert done.returncode == 1
    assert "only these are here: 3.9." in done.stderr


def test_without_root_and_sudo_it_says_what_to_install(machine: Machine) -> None:
    machine.install("python3", _PYTHON)
    machine.install("apt-get", "exit 0")
    machine.install("id", "echo 1000")
    done = machine.run("tests")
    assert done.returncode == 1
    assert "install them yourself: apt-get install libpango-1.0-0" in done.stderr
    assert not machine.calls("apt-get")


def test_without_apt_get_it_says_what_is_missing(machine: Machine) -> None:
    machine.install("python3", _PYTHON)
    done = machine.run("tests")
    assert done.returncode == 1
    assert "there is no apt-get" in done.stderr
    assert "libpango-1.0-0" in done.stderr


@pytest.mark.parametrize(("user", "by_sudo"), [("0", False), ("1000", True)])
def test_system_packages_are_installed_as_root_or_by_sudo(
    machine: Machine, user: str, *, by_sudo: bool
) -> None:
    machine.install("python3", _PYTHON)
    machine.install("apt-get", "exit 0")
    machine.install("sudo", '"$@"')
    machine.install("id", f"echo {user}")
    machine.run("tests")
    assert [call.split()[1] for call in machine.calls("apt-get")] == ["update", "install"]
    assert machine.calls("apt-get")[1].endswith(" libpango-1.0-0")
    assert bool(machine.calls("sudo")) is by_sudo


def test_a_failing_apt_get_ends_it_with_the_packages(machine: Machine) -> None:
    machine.install("python3", _PYTHON)
    machine.install("apt-get", "exit 100")
    machine.install("id", "echo 0")
    done = machine.run("tests")
    assert done.returncode == 1
    assert "apt-get could not install system packages" in done.stderr


def test_no_environment_is_made_over_an_error(machine: Machine) -> None:
    machine.install("python3", _PYTHON.replace("echo libpango-1.0-0", ":"))
    done = machine.run("tests")
    assert done.returncode == 1
    assert f"no virtual environment could be made in {machine.environment}" in done.stderr
    assert not machine.environment.exists()


def test_tests_go_on_without_the_programs_that_some_of_them_need(machine: Machine) -> None:
    machine.install("python3", _PYTHON.replace("echo libpango-1.0-0", ":"))
    machine.install("id", "echo 1000")
    (machine.environment / "bin").mkdir(parents=True)
    machine.install("python", "exit 0")
    (machine.bin / "python").rename(machine.environment / "bin" / "python")
    done = machine.run("tests")
    assert done.returncode == 0
    assert "tests that need chromium will be skipped" in done.stderr
    assert machine.calls("python")[-1].startswith("python -m pytest")


@pytest.mark.parametrize(
    ("arguments", "code"), [(["--help"], 0), (["-h"], 0), ([], 2), (["certificates"], 2)]
)
def test_its_commands_are_listed(machine: Machine, arguments: list[str], code: int) -> None:
    done = machine.run(*arguments)
    assert done.returncode == code
    assert "./run COMMAND" in (done.stderr if code else done.stdout)


@pytest.mark.parametrize(
    ("arguments", "asked"), [((), "-m not long"), (("--long", "tests/model"), "-m long tests/model")]
)
def test_the_tests_that_take_long_are_run_by_themselves(
    machine: Machine, arguments: tuple[str, ...], asked: str
) -> None:
    machine.install("python3", _PYTHON.replace("echo libpango-1.0-0", ":"))
    (machine.environment / "bin").mkdir(parents=True)
    machine.install("python", "exit 0")
    (machine.bin / "python").rename(machine.environment / "bin" / "python")
    assert machine.run("tests", *arguments).returncode == 0
    assert machine.calls("python")[-1].endswith(asked)


def test_continuous_integration_runs_both_parts_of_the_tests() -> None:
    lines = (ROOT / ".ci" / "run").read_text(encoding="utf-8").splitlines()
    assert {"./run tests", "./run tests --long"} <= set(lines)


def test_mutants_are_tried_by_a_command_of_its_own(machine: Machine) -> None:
    machine.install("python3", _PYTHON.replace("echo libpango-1.0-0", ":"))
    (machine.environment / "bin").mkdir(parents=True)
    machine.install("python", "exit 0")
    (machine.bin / "python").rename(machine.environment / "bin" / "python")
    assert machine.run("mutation", "--mutants", "3").returncode == 0
    assert machine.calls("python")[-1] == "python tests/mutation.py --mutants 3"


@pytest.mark.parametrize("script", ["run", ".ci/run"])
def test_scripts_can_be_executed(script: str) -> None:
    assert os.access(ROOT / script, os.X_OK)
