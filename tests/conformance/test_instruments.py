"""Every installed live instrument passes every check that an author runs, against its own emulator."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from zlmreport.plugin.protocols import Instrument
from zlmreport.plugin.registry import find_plugins
from zlmreport.testing import INSTRUMENT_CHECKS, InstrumentTraits

INSTRUMENTS = find_plugins().instruments
#: What their manuals say; a µMD has no check sum, but each line of a heterodyne one repeats what it says.
TRAITS = {
    "ids3010": InstrumentTraits(has_check_sum=False, tells_lost_beam=True),
    "nd28x": InstrumentTraits(has_check_sum=True, tells_lost_beam=True),
    "text-readout": InstrumentTraits(has_check_sum=False, tells_lost_beam=True),
    "umd0": InstrumentTraits(has_check_sum=False, tells_lost_beam=False),
    "umd1": InstrumentTraits(has_check_sum=True, tells_lost_beam=True),
    "umd2": InstrumentTraits(has_check_sum=True, tells_lost_beam=True),
}


@pytest.mark.parametrize("instrument", INSTRUMENTS, ids=lambda each: each.identifier)
@pytest.mark.parametrize("check", INSTRUMENT_CHECKS)
def test_conforms(check: Callable[..., None], instrument: Instrument) -> None:
    check(instrument, TRAITS[instrument.identifier])
