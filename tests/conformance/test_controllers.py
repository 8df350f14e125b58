"""Every installed controller does what the kit asks."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from zlmreport.plugin.controller import Controller
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import CONTROLLER_CHECKS


@pytest.mark.parametrize("controller", find_plugins().controllers, ids=lambda each: each.identifier)
@pytest.mark.parametrize("check", CONTROLLER_CHECKS)
def test_conforms(check: Callable[..., None], controller: Controller) -> None:
    check(controller, {})
