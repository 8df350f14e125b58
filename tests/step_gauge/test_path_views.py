"""The picture of a probing path shows where everything is, from three sides."""

from __future__ import annotations

from xml.etree import ElementTree as ET

import numpy as np
import pytest

from step_gauge.paths import planned
from zlmreport.plugin import Language
from zlmreport_step_gauge.gauge import Side
from zlmreport_step_gauge.paths.foretold import draw_path
from zlmreport_step_gauge.paths.path import PathKind
from zlmreport_step_gauge.paths.plan import PlannedPath
from zlmreport_step_gauge.paths.views import View, make_path_views

VOLUME = ((0.0, 0.5), (0.0, 0.6), (0.0, 0.5))


def path(kind: PathKind = PathKind.VERTICAL, orientation: str = "y") -> PlannedPath:
    return planned(
        blocks=3,
        kind=kind,
        orientation=orientation,
        cycles=2,
        safe_position=(0.05, 0.05, 0.45),
        working_volume=VOLUME,
    )


def right_angled(kind: PathKind, orientation: str = "y") -> View:
    return make_path_views(path(kind, orientation))[1]


@pytest.mark.parametrize("orientation", ["x", "y", "z", "diagonal"])
def test_from_the_side_lengths_along_and_upward_are_true(orientation: str) -> None:
    view = right_angled(PathKind.VERTICAL, orientation)
    front, *_ = [touch for touch in view.touches if touch.side is Side.FRONT]
    assert front.end - front.start == pytest.approx([2.5, 0.0], abs=1e-9)
    wide, high = np.ptp(view.way, axis=0)
    assert (wide, high) == pytest.approx((50 + 2 * 4.5, 5 + 2 + 3))


@pytest.mark.parametrize("orientation", ["x", "y", "z", "diagonal"])
def test_blocks_that_are_equally_deep_stand_in_the_order_of_the_gauge(orientation: str) -> None:
    _, side, _ = make_path_views(planned(blocks=9, orientation=orientation))
    assert np.all(np.diff(side.blocks[:, :, 0].mean(axis=1)) > 0)


@pytest.mark.parametrize("orientation", ["x", "y", "z", "diagonal"])
def test_from_above_the_path_goes_round_below_the_blocks(orientation: str) -> None:
    view = right_angled(PathKind.HORIZONTAL, orientation)
    assert view.way[:, 1].min() == pytest.approx(view.blocks[..., 1].min() - 2 - 3)
    assert np.ptp(view.way, axis=0) == pytest.approx((50 + 2 * 4.5, 5 + 2 + 3))


@pytest.mark.parametrize("kind", list(PathKind))
def test_each_face_of_one_cycle_has_its_arrow_and_its_number(kind: PathKind) -> None:
    for view in make_path_views(path(kind))[:2]:
        assert len(view.touches) == 6
        numbers = {note.text.in_language(Language.ENGLISH): note.side for note in view.notes}
        assert numbers == {str(face): Side.FRONT if face % 2 else Side.BACK for face in range(1, 7)}


def test_what_looks_away_from_the_eye_is_not_drawn() -> None:
    axonometric, side, _ = make_path_views(path())
    assert len(axonometric.blocks) == 3 * 3  # top, right and front of three blocks
    assert len(side.blocks) == 3
    assert len(side.base) == 1


def test_in_the_machine_stand_volume_axes_and_safe_position() -> None:
    *_, view = make_path_views(path())
    assert (len(view.edges), len(view.arrows)) == (12, 3)
    texts = {note.text.in_language(Language.GERMAN) for note in view.notes}
    assert texts == {"X", "Y", "Z", "sichere Position"}


def test_without_volume_and_safe_position_there_are_none() -> None:
    *_, view = make_path_views(planned(blocks=2))
    assert not len(view.edges)
    assert len(view.notes) == 3


@pytest.mark.parametrize("kind", list(PathKind))
@pytest.mark.parametrize("language", list(Language))
def test_everything_is_drawn_inside_the_image(kind: PathKind, language: Language) -> None:
    image = ET.fromstring(draw_path(path(kind), language))
    _, _, width, height = map(float, image.attrib["viewBox"].split())
    for element in image.iter():
        data = element.attrib.get("d", "")
        numbers = [float(each) for each in "".join(c if c not in "MLCZ" else " " for c in data).split()]
        for x, y in zip(numbers[::2], numbers[1::2], strict=True):
            assert -0.01 <= x <= width + 0.01
            assert -0.01 <= y <= height + 0.01


def test_the_image_says_what_it_shows() -> None:
    image = ET.fromstring(draw_path(path(), Language.ENGLISH))
    assert image.attrib["aria-label"].startswith(
        "Path of the probe over 6 faces of Gauge 7, over the top of the blocks: 12 points in"
    )


def test_each_view_has_its_own_scale() -> None:
    image = ET.fromstring(draw_path(path(), Language.ENGLISH))
    texts = ["".join(element.itertext()) for element in image.iter() if element.tag.endswith("text")]
    bars = [text for text in texts if text.endswith(" mm")]
    assert len(bars) == 3
