"""The seed's own program comes out of the seed's own geometry: Pahk and Kim, Fig. 4.

What the figure tells of its geometry: 20 mm from front face to front face; measuring moves of 4.5 mm, which
are 2.5 mm of approach and a tip of 2 mm radius; 10 mm aside, which are 5 mm of block, 2 mm of tip and 3 mm
of clearance; a path round the side at the height z = 201.280 mm, that comes into the line of the gauge one
step before the first face. The first point is printed with the coordinates x = 290.862, y = 41.013 mm.

All printed digits follow from it, one of them by a hair. Between the steps x falls by 0.012 mm and y rises
by 20.000 mm, so that the direction is (−s, 1, 0) with s from 0.000575 to 0.000625. One step aside y rises
by 0.007, 0.007 and 0.006 mm, although it is 10·s each time, 0.006 mm. Rounding explains that: seen along y
the 20 mm fall short by 20·s²/2 = 4 nm a step, so that the third value rounds down where the first two have
rounded up, if the first lies less than 8 nm above the middle between two digits. In all other places of the
gauge 56.519 would be 56.520, or 16.520 and 36.520 would be 16.519 and 36.519.
"""

from __future__ import annotations

import math
from dataclasses import replace

import pytest

from installed import registry
from step_gauge.paths import PLACE, SETTINGS, location, step_gauge
from zlmreport_step_gauge.paths.path import PathKind, ProbingPath
from zlmreport_step_gauge.paths.plan import plan_path

#: As printed, its points of omission left out.
FIGURE = """\
MV      0.000      0.000      400.000 ;
PO 1 ;
MV  290.877      16.513      201.280 ;
MV  300.877      16.520      201.280 ;
MV  300.865      36.520      201.280 ;
MV  290.865      36.513      201.280 ;
MS  290.862      41.013      201.280 ;
PO 1 ;
MV  290.865      36.513      201.280 ;
MV  300.865      36.520      201.280 ;
MV  300.853      56.519      201.280 ;
MV  290.853      56.513      201.280 ;
MS  290.850      61.013      201.280 ;
PO 1 ;
"""
#: y beside the first station that is printed as 16.520, mm.
BESIDE = 16.5195057
#: x of the first face that is printed as 290.862, mm: from 290.8622 the other stations follow as printed.
FACE = 290.8622


def path(slope: float, beside: float = BESIDE) -> ProbingPath:
    """Return the path of the figure's geometry, for a slope of the direction against y."""
    length = math.hypot(slope, 1.0)
    along, across = (-slope / length, 1 / length), (1 / length, slope / length)
    # Along the gauge from the station beside the beginning: one step, 4.5 mm to the face, half a block; and
    # from there 10 mm back across it.
    y = beside + (20 + 4.5 + 5) * along[1] - 10 * across[1]
    x = FACE + 5 * along[0]
    gauge = step_gauge(4)
    settings = replace(
        SETTINGS, kind=PathKind.HORIZONTAL, lead_in=20e-3, safe_position=(0.0, 0.0, 0.4), cycles=1
    )
    planned = plan_path(
        gauge,
        gauge,
        location((1e-3 * x, 1e-3 * y, 0.20128), (-slope, 1.0, 0.0), (0.0, 0.0, 1.0), 0.06),
        settings,
        size=(0.01, 0.01),
        number="FIG-4",
        place=PLACE,
    )
    return planned.path


def written(planned: ProbingPath) -> list[list[str]]:
    """Return the words of the program, statement by statement: the figure's blanks follow no rule."""
    program = registry().part_program("mv-ms", takes=ProbingPath)
    return [line.split() for line in program.write(planned, program.options()).splitlines()]


def test_every_statement_and_every_digit_of_the_figure_follows() -> None:
    program = written(path(slope=0.00062))
    figure = [line.split() for line in FIGURE.splitlines()]
    assert program[: len(figure)] == figure
    assert program[-1] == ["END;"]


@pytest.mark.parametrize("slope", [0.000576, 0.0006, 0.000624])
def test_any_slope_that_the_figure_allows_gives_it_but_for_a_unit_of_the_last_digit(slope: float) -> None:
    # y of the first face as it is printed
    start = path(slope, 41.013 - (20 + 4.5) / math.hypot(slope, 1) + 10 * slope)
    for found, printed in zip(written(start), (line.split() for line in FIGURE.splitlines()), strict=False):
        assert found[0] == printed[0]
        numbers = [(float(a), float(b)) for a, b in zip(found[1:-1], printed[1:-1], strict=True)]
        assert all(abs(a - b) < 0.00151 for a, b in numbers), (found, printed)
