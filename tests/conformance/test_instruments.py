"""Every installed live instrument passes every check that an author runs, against its own emulator."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from zlmreport.plugin.protocols import Instrument
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import INSTRUMENT_CHECKS


@pytest.mark.parametrize("instrument", find_plugins().instruments, ids=lambda each: each.identifier)
@pytest.mark.parametrize("check", INSTRUMENT_CHECKS)
def test_conforms(check: Callable[[Instrument], None], instrument: Instrument) -> None:
    check(instrument)
