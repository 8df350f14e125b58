"""What each effect gave as a class, before it stood in a catalogue, it gives there."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from plugins.effects.installed import EFFECTS
from zlmreport.testing import full_designs

#: Of each form, on some tests: the θ in the middle of its grid, and the columns at every 83rd reading.
GOLDEN = json.loads(
    (Path(__file__).parents[2] / "data" / "effects" / "columns.json").read_text(encoding="utf-8")
)


@pytest.mark.parametrize("named", GOLDEN)
def test_columns_are_those_of_the_class(named: str) -> None:
    identifier, _, keys = named.partition(" ")
    effect = EFFECTS[identifier]
    form = effect.with_settings(effect.options.model_validate(json.loads(keys))) if keys else effect
    for test, golden in GOLDEN[named].items():
        design = full_designs()[test]
        columns = form.columns(design, np.array(golden["theta"]))[7::83]
        # A wave of 20 µm has turned 10⁵ times at the end of a metre: there ten digits are left.
        np.testing.assert_allclose(columns, golden["columns"], rtol=1e-11, atol=2e-10 * np.abs(columns).max())
