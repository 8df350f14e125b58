"""Squareness and parallelism from two measured lines."""

from __future__ import annotations

import numpy as np
import pytest

from installed import registry
from plugins.standards.iso230_1.lines import evaluated, hp, line, together, values
from zlmreport.machines.kinematics import Chain, deviation
from zlmreport.measurement.measurement_set import join_lines
from zlmreport.plugin import Axis, Language, error_named
from zlmreport.plugin.extension import Acts
from zlmreport.plugin.standard import evaluate

ARCSECOND = np.pi / 180 / 3600


def hp_square(kind: str, **square: float) -> dict[str, float]:
    """Return the printed example: the second line read in the sense of the square, and so turned here."""
    positions, readings = hp(2)
    lines = together("C0Y", x=line("EYX", *hp(1)), y=line("EXY", positions, [-each for each in readings]))
    return values(lines, reference_line=kind, **({"square": square} if square else {}))


@pytest.mark.parametrize(
    ("kind", "printed", "computed"),
    [("end-points", -5.5, -5.5233), ("least-squares", -5.2, -5.1716)],
)
def test_the_printed_squareness(kind: str, printed: float, computed: float) -> None:
    found = hp_square(kind)["C0Y"]
    assert found == pytest.approx(computed, abs=5e-5)
    assert found == pytest.approx(printed, abs=0.05)


def test_the_error_of_the_square_is_added() -> None:
    assert hp_square("end-points", error=1.25)["C0Y"] == pytest.approx(hp_square("end-points")["C0Y"] + 1.25)


#: Of each squareness error: its two lines, and the axes of these.
PAIRS = {"C0Y": ("EYX", "EXY"), "B0Z": ("EZX", "EXZ"), "A0Z": ("EZY", "EYZ")}


@pytest.mark.parametrize("symbol", PAIRS)
def test_a_machine_out_of_square_is_found_to_be_so(symbol: str) -> None:
    """Lines of a machine that has this error and no other, by the kinematics of the whole machine."""
    true = 7.0 * ARCSECOND
    positions = np.linspace(0.0, 0.4, 9)
    lines = {}
    for name, error in zip("ab", PAIRS[symbol], strict=True):
        moved = np.zeros((len(positions), 3))
        moved[:, "XYZ".index(error[2])] = positions
        across = deviation({symbol: true}, Chain("XYZF"), moved)[:, "XYZ".index(error[1])]
        lines[name] = line(error, positions * 1e3, across * 1e6)
    found = evaluated(together(symbol, **lines)).value(symbol)
    assert found == pytest.approx(true)


@pytest.mark.parametrize("symbol", PAIRS)
def test_an_alignment_that_both_lines_share_leaves_no_squareness(symbol: str) -> None:
    positions = np.linspace(0.0, 400.0, 9)
    first, second = PAIRS[symbol]
    tilt = 0.02 * positions  # the square turned in its plane: one line rises, the other falls
    lines = together(symbol, a=line(first, positions, tilt), b=line(second, positions, -tilt))
    assert values(lines)[symbol] == pytest.approx(0.0, abs=1e-9)


def test_parallel_axes_have_the_difference_of_their_slopes() -> None:
    positions = np.linspace(0.0, 500.0, 6)
    first, second = line("EXZ", positions, 0.03 * positions), line("EXW", positions, 0.01 * positions)
    iso = registry().standard("iso230-1:2012")
    (parallelism,) = [each for each in iso.measurands if each.identifier == "parallelism"]
    standard = iso.of_error(parallelism)
    both = join_lines(Axis("Z", quantity=parallelism), {"a": first, "b": second})
    found = evaluate(standard, both, standard.options(), {})
    assert found.value("parallelism") == pytest.approx(20e-6)


def test_one_line_gives_no_angle() -> None:
    assert values(together("C0Y", x=line("EYX", *hp(1)))) == {}


def test_lines_that_do_not_meet_are_told() -> None:
    positions = np.linspace(0.0, 400.0, 9)
    low, high = line("EYX", positions, positions * 0, at=[("Z", 0.05)]), [("X", 0.1), ("Z", 0.30)]
    apart = together("C0Y", x=low, y=line("EXY", positions, positions * 0, at=high))
    (found,) = (each for each in evaluated(apart).findings if "one plane" in each.requirement.en)
    assert found.met is False
    assert found.found.in_language(Language.ENGLISH) == "250 mm apart in Z"


def test_the_square_tilts_the_second_line_by_its_uncertainty() -> None:
    standard = registry().standard("iso230-1:2012").of_error(error_named("C0Y"))
    lines = together("C0Y", x=line("EYX", *hp(1)), y=line("EXY", *hp(2)))
    options = standard.options.model_validate({"square": {"error": 0, "expanded_uncertainty": 0.5}})
    ((name, (found,)),) = standard.contributions(lines, options).items()
    assert name == "y"
    assert found.acts is Acts.ALONG_THE_LENGTH
    assert found.standard_uncertainty == pytest.approx(0.25 * ARCSECOND * 0.45)
