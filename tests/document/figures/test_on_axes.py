"""A figure of a certificate on given axes of matplotlib: the page's brackets and labels at their values."""

from __future__ import annotations

import subprocess
import sys

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure as Sheet
from matplotlib.patches import PathPatch
from matplotlib.text import Annotation

from document.figures.samples import ALL
from plugins.standards.installed import STANDARDS
from zlmreport.document.figures.on_axes import put
from zlmreport.plugin import Figure, Language
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test

ISO = STANDARDS["iso230-2:2014"]
TEST = bidirectional_test(
    [0, 100, 200], [[1.0, 3.0], [4.0, 5.0], [2.0, 2.5]], [[0.0, 1.0], [2.5, 3.5], [0.5, 1.0]]
)
EVALUATION = evaluate(ISO, TEST, ISO.options(), {})
OVERALL = next(each for each in ISO.figures(EVALUATION, ISO.options()) if each.panels[0].brackets)


def _axes(number: int = 1) -> list[Axes]:
    sheet = Sheet(figsize=(7, 4), layout="constrained")
    FigureCanvasAgg(sheet)
    return sheet.subplots(number, squeeze=False)[:, 0].tolist()


def _texts(axes: Axes) -> list[str]:
    return [each.get_text() for each in axes.texts if isinstance(each, Annotation)]


@pytest.fixture(scope="module")
def overall() -> Axes:
    (axes,) = _axes()
    put(OVERALL, axes)
    return axes


def test_the_graph_of_iso_230_2_has_its_brackets(overall: Axes) -> None:
    assert {bracket.notation for bracket in OVERALL.panels[0].brackets} <= set(_texts(overall))


def test_a_bracket_spans_its_parameter_in_values_of_the_axes(overall: Axes) -> None:
    lengths = [
        np.ptp(each.get_path().vertices[:, 1])
        for each in overall.patches
        if isinstance(each, PathPatch) and len(each.get_path().vertices) == 2
    ]
    for bracket in OVERALL.panels[0].brackets:
        assert any(length == pytest.approx(bracket.high - bracket.low) for length in lengths)


def test_everything_stands_inside_the_axes(overall: Axes) -> None:
    overall.figure.canvas.draw()
    room = overall.get_window_extent().padded(1.0)
    for text in overall.texts:
        box = text.get_window_extent()
        assert room.x0 <= box.x0
        assert box.x1 <= room.x1


def test_axes_have_the_titles_of_the_language() -> None:
    (axes,) = _axes()
    put(OVERALL, axes, Language.GERMAN)
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("Sollposition in mm", "Abweichung in µm")


def test_each_panel_takes_axes_of_its_own() -> None:
    several = ALL["each direction"]
    above, below = _axes(2)
    put(several, [above, below])
    assert "Direction ↑" in _texts(above)
    assert "Direction ↓" in _texts(below)
    with pytest.raises(ValueError, match="2 panels needs as many axes, not 1"):
        put(several, above)


@pytest.mark.parametrize("sample", ALL.values(), ids=ALL)
def test_every_figure_is_drawn(sample: Figure) -> None:
    if sample.panels:
        axes = _axes(len(sample.panels))
        put(sample, axes)
        axes[0].figure.canvas.draw()


def test_settings_of_matplotlib_stay_as_they_are() -> None:
    before = dict(mpl.rcParams)
    put(OVERALL, *_axes())
    assert dict(mpl.rcParams) == before


@pytest.mark.long
def test_a_certificate_needs_no_matplotlib() -> None:
    program = (
        "import sys; from zlmreport.testing.certificates import sample_certificate;"
        "from zlmreport.plugin.registry import find_plugins;"
        "formats = map(find_plugins().renderer, ('pdf', 'html', 'pdf-typst'));"
        "[each.render(sample_certificate()) for each in formats];"
        "print('matplotlib' in sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "False"
