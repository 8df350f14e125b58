"""What all tests share."""

from __future__ import annotations

import os

import hypothesis
import pytest

from environments import HOUSE_STANDARD, ROOT, Distribution, Environment, build

#: The matrices are small: more threads only wait for each other. For what the tests start, too.
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

hypothesis.settings.register_profile("workstation", deadline=None, max_examples=30)
hypothesis.settings.register_profile("ci", deadline=None, max_examples=30, derandomize=True, print_blob=True)
hypothesis.settings.register_profile("thorough", deadline=None, max_examples=1000)  # --hypothesis-profile
hypothesis.settings.load_profile("ci" if os.environ.get("CI") else "workstation")


@pytest.fixture(scope="session")
def zlmreport_distribution(tmp_path_factory: pytest.TempPathFactory) -> Distribution:
    """The project, built."""
    return build(ROOT, tmp_path_factory.mktemp("zlmreport"))


@pytest.fixture(scope="session")
def house_distribution(tmp_path_factory: pytest.TempPathFactory) -> Distribution:
    """The third party's example plugin, built."""
    return build(HOUSE_STANDARD, tmp_path_factory.mktemp("house-standard"))


@pytest.fixture(scope="session")
def environment(
    tmp_path_factory: pytest.TempPathFactory, zlmreport_distribution: Distribution
) -> Environment:
    """A fresh environment in which only zlmreport is installed."""
    return Environment(tmp_path_factory.mktemp("environment"), zlmreport_distribution.wheel)


@pytest.fixture(scope="session")
def house_environment(
    tmp_path_factory: pytest.TempPathFactory,
    zlmreport_distribution: Distribution,
    house_distribution: Distribution,
) -> Environment:
    """A fresh environment in which zlmreport and the third party's plugin are installed."""
    wheels = (zlmreport_distribution.wheel, house_distribution.wheel)
    return Environment(tmp_path_factory.mktemp("environment"), *wheels)
