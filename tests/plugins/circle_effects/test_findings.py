"""What an effect in a model says of each of its parameters: also of those of which nothing is found."""

import pytest

from zlmreport.plugin import ARCSECOND, MICROMETRE_PER_METRE, Language
from zlmreport.plugin.circle_effect import MILLISECOND, Estimate
from zlmreport_plugins.circle_effects.drives import ServoMismatch
from zlmreport_plugins.circle_effects.geometry import ScaleMismatch, Squareness


@pytest.mark.parametrize(
    ("effect", "unit", "names", "said"),
    [
        (Squareness(), ARCSECOND, "C0Y A0Z", ["X and Y are out of square", "Y and Z are square"]),
        (
            ScaleMismatch(),
            MICROMETRE_PER_METRE,
            "X-Y Y-Z",
            ["the scale of X is longer", "the scales of Y and Z agree"],
        ),
        (ServoMismatch(), MILLISECOND, "T_X-T_Y T_Y-T_Z", ["X lags behind Y", "Y and Z follow alike"]),
    ],
)
def test_axes_that_show_nothing_are_not_said_to_be_off(effect, unit, names, said):
    """Of two planes that were fitted together, one may hold what its axes predict."""
    estimates = [
        Estimate(name, unit, unit.to_si(value), unit.to_si(0.5))
        for name, value in zip(names.split(), (7.0, 0.4), strict=True)
    ]
    found = [each.in_language(Language.ENGLISH) for each in effect.findings(estimates)]
    assert [each.startswith(begin) for each, begin in zip(found, said, strict=True)] == [True, True]
    assert "7.0 ± 0.5" in found[0].replace("7.00 ± 0.50", "7.0 ± 0.5")
