"""Every installed renderer passes every check that a third party's author runs."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from zlmreport.plugin.protocols import Renderer
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import RENDERER_CHECKS

RENDERERS = find_plugins().renderers


@pytest.mark.parametrize("renderer", RENDERERS, ids=lambda renderer: renderer.identifier)
@pytest.mark.parametrize("check", RENDERER_CHECKS)
def test_conforms(renderer: Renderer, check: Callable[..., None]) -> None:
    check(renderer)


def test_the_formats_that_users_are_promised_are_there() -> None:
    assert {"pdf", "html", "json"} <= {renderer.identifier for renderer in RENDERERS}
