"""Roles are told apart by people who see no colour, and by those who see other colours."""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from zlmreport.document.figures.shapes import READINGS
from zlmreport.plugin import Approach
from zlmreport.plugin.page import ROLE_STYLES, Colour
from zlmreport.plugin.standard import Role

roles = pytest.mark.parametrize("role", Role, ids=lambda role: role.name.lower())

#: Simulation of deuteranopia in linear sRGB: Machado, Oliveira, Fernandes, IEEE TVCG 15 (2009), severity 1.
DEUTERANOPIA = np.array(
    [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
)


def _linear(colour: Colour) -> np.ndarray:
    parts = np.array(colour)
    return np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)


def _luminance(colour: Colour) -> float:
    return float(_linear(colour) @ (0.2126, 0.7152, 0.0722))


def test_every_role_has_a_style() -> None:
    assert set(ROLE_STYLES) == set(Role)


def test_no_two_roles_share_both_line_and_mark() -> None:
    looks = [(style.stroke.dashes, style.mark) for style in ROLE_STYLES.values()]
    assert len(set(looks)) == len(looks)


def test_lines_without_marks_differ_in_their_dashes() -> None:
    dashes = [style.stroke.dashes for style in ROLE_STYLES.values() if style.mark is None]
    assert len(set(dashes)) == len(dashes)


@roles
def test_a_line_stands_out_from_white_paper_without_its_colour(role: Role) -> None:
    contrast = 1.05 / (_luminance(ROLE_STYLES[role].stroke.colour) + 0.05)
    assert contrast >= 4.0


@roles
def test_a_band_is_lighter_than_its_limits_and_lets_the_grid_through(role: Role) -> None:
    assert 0 < ROLE_STYLES[role].tint.opacity <= 0.2


@pytest.mark.parametrize(
    ("one", "other"),
    [
        (Role.MEAN_POSITIVE, Role.MEAN_NEGATIVE),
        (Role.LIMIT_POSITIVE, Role.LIMIT_NEGATIVE),
        (Role.SPREAD, Role.REVERSAL),
        (Role.MODEL_POSITIVE, Role.MODEL_NEGATIVE),
        (Role.UNCERTAINTY_POSITIVE, Role.UNCERTAINTY_NEGATIVE),
    ],
)
def test_colours_of_a_pair_stay_apart_for_the_red_green_blind(one: Role, other: Role) -> None:
    seen = [DEUTERANOPIA @ _linear(ROLE_STYLES[role].stroke.colour) for role in (one, other)]
    assert np.abs(seen[0] - seen[1]).max() > 0.1


def test_readings_of_the_two_approaches_point_where_their_arrows_do() -> None:
    marks = {approach: READINGS[approach][0].value for approach in Approach}
    assert marks == {Approach.POSITIVE: "triangle, up", Approach.NEGATIVE: "triangle, down"}


def test_readings_are_finer_than_any_curve() -> None:
    widths = [stroke.width for _, stroke in READINGS.values()]
    assert all(width < style.stroke.width for width, style in itertools.product(widths, ROLE_STYLES.values()))
