"""What all tests share."""

from __future__ import annotations

import fcntl
import gc
import os
import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

import hypothesis
import pytest

from environments import HOUSE_STANDARD, ROOT, Distribution, Environment, build, built, install

#: The matrices are small: more threads only wait for each other. For what the tests start, too.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
#: Hundreds of processes load the same modules, and each would compile them all again.
os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
sys.dont_write_bytecode = False

hypothesis.settings.register_profile("workstation", deadline=None, max_examples=30)
hypothesis.settings.register_profile("ci", deadline=None, max_examples=30, derandomize=True, print_blob=True)
hypothesis.settings.register_profile("thorough", deadline=None, max_examples=1000)  # --hypothesis-profile
hypothesis.settings.load_profile("ci" if os.environ.get("CI") else "workstation")


@pytest.hookimpl(trylast=True)  # after pytest's own order
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with what takes long or waits: a worker that comes to it last would be waited for."""
    items.sort(key=lambda item: item.get_closest_marker("early") is None)


def pytest_collection_finish() -> None:
    """Let the garbage collector walk what tests make, not all that is loaded: a fifth of the CPU."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(200_000, 20, 100)


#: Returns the folder of a name, filled by a function.
Shared: TypeAlias = Callable[[str, Callable[[Path], object]], Path]


@pytest.fixture(scope="session")
def shared(tmp_path_factory: pytest.TempPathFactory) -> Shared:
    """Return a function that returns a folder of a name: the first worker fills it, and all use it."""
    own = tmp_path_factory.getbasetemp()
    root = own.parent if "PYTEST_XDIST_WORKER" in os.environ else own

    def filled(name: str, fill: Callable[[Path], object]) -> Path:
        folder, whole = root / name, root / f"{name}-is-whole"
        with (root / f"{name}-lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            if not whole.exists():
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir()
                fill(folder)
                whole.touch()
        return folder

    return filled


@pytest.fixture(scope="session")
def zlmreport_distribution(shared: Shared) -> Distribution:
    """The project, built."""
    return built(shared("zlmreport", lambda folder: build(ROOT, folder)))


@pytest.fixture(scope="session")
def house_distribution(shared: Shared) -> Distribution:
    """The third party's example plugin, built."""
    return built(shared("house-standard", lambda folder: build(HOUSE_STANDARD, folder)))


@pytest.fixture(scope="session")
def environment(shared: Shared, zlmreport_distribution: Distribution) -> Environment:
    """A fresh environment in which only zlmreport is installed."""
    return Environment(shared("environment", lambda folder: install(folder, zlmreport_distribution.wheel)))


@pytest.fixture(scope="session")
def house_environment(
    shared: Shared,
    zlmreport_distribution: Distribution,
    house_distribution: Distribution,
) -> Environment:
    """A fresh environment in which zlmreport and the third party's plugin are installed."""
    wheels = (zlmreport_distribution.wheel, house_distribution.wheel)
    return Environment(shared("house-environment", lambda folder: install(folder, *wheels)))
