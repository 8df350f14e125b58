"""What users install: distributions built from the tree, and virtual environments that hold only them."""

from __future__ import annotations

import importlib.util
import os
import sys
import venv
from dataclasses import dataclass
from pathlib import Path
from subprocess import CompletedProcess
from types import ModuleType

from processes import PYTHON, run

ROOT = Path(__file__).parents[1]
HOUSE_STANDARD = ROOT / "plugins" / "zlmreport-house-standard"


@dataclass(frozen=True, slots=True)
class Distribution:
    """The two files of a release: sources, and the wheel that was built from those sources."""

    sdist: Path
    wheel: Path


def build(project: Path, folder: Path) -> None:
    """Build a project's source distribution, and its wheel from that."""
    run(PYTHON, "-m", "build", "--no-isolation", "--outdir", folder, project, check=True)


def built(folder: Path) -> Distribution:
    """Return what was built into a folder."""
    (sdist,), (wheel,) = folder.glob("*.tar.gz"), folder.glob("*.whl")
    return Distribution(sdist, wheel)


def install(folder: Path, *wheels: Path) -> None:
    """Make a fresh virtual environment with a few wheels; libraries they need come from the one of the tests.

    That those libraries are the declared ones is a test of its own, so nothing has to be downloaded here.
    """
    venv.create(folder, symlinks=True)
    pip = (PYTHON, "-m", "pip", "--python", folder / "bin" / "python", "install", "--quiet")
    run(*pip, "--no-compile", "--no-deps", "--no-index", *wheels, check=True)
    (site,) = folder.glob("lib/python*/site-packages")
    libraries = [f"{path}\n" for path in sys.path if Path(path).name == "site-packages"]
    (site / "libraries.pth").write_text("".join(libraries), encoding="utf-8")


class Environment:
    """A virtual environment that has been made, and its commands."""

    def __init__(self, folder: Path) -> None:
        self.bin = folder / "bin"
        self.python = self.bin / "python"
        self._environment = {
            name: value
            for name, value in os.environ.items()
            if name not in {"PYTHONPATH", "VIRTUAL_ENV", "PYTHONHOME"}
        }
        self._environment["PATH"] = f"{self.bin}{os.pathsep}{os.environ['PATH']}"

    def run(self, *command: str | Path, folder: Path) -> CompletedProcess[str]:
        """Run a command that is found here first."""
        return run(*command, cwd=folder, env=self._environment)


def imported_from(name: str, folder: Path) -> ModuleType:
    """Return the module of a plugin that was just written, as its author's Python would load it."""
    spec = importlib.util.spec_from_file_location(name, folder / f"{name}.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module
