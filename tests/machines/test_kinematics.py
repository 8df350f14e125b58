from itertools import permutations

import numpy as np
import pytest
from hypothesis import given, strategies as st

from machines.exact import exact_deviation
from zlmreport.machines.kinematics import COMPONENTS, ERRORS, Chain, ErrorLine, deviation, lever_arm

MICRO = 1e-6
_ORDERS = tuple("".join(order) for order in permutations("XYZ"))
CHAINS = [f"{order[:place]}F{order[place:]}" for order in _ORDERS for place in range(4)]
_coordinate = st.floats(-0.3, 0.3)
_point = st.tuples(_coordinate, _coordinate, _coordinate)


def _sizes(seed):
    random = np.random.default_rng(seed)
    return {
        name: float(random.uniform(-15, 15) * MICRO if name[1] in "XYZ" else random.uniform(-60, 60) * MICRO)
        for name in COMPONENTS
    }


@given(st.sampled_from(CHAINS), _point, _point, st.integers(0, 2**32))
def test_the_linear_rule_is_the_product_of_exact_matrices_within_some_nanometres(
    letters, position, tool, seed
):
    errors = _sizes(seed)
    found = deviation(errors, Chain(letters), np.array([position]), tool)[0]
    assert np.abs(found - exact_deviation(letters, position, tool, errors)).max() < 25e-9


@given(st.sampled_from(CHAINS), _point, _point, st.integers(0, 2**32))
def test_it_is_within_a_nanometre_of_them_for_errors_of_a_good_machine(letters, position, tool, seed):
    errors = {name: value / 6 for name, value in _sizes(seed).items()}
    found = deviation(errors, Chain(letters), np.array([position]), tool)[0]
    assert np.abs(found - exact_deviation(letters, position, tool, errors)).max() < 1e-9


def _published_xyz(e, position, t):
    """The order XYZ as `machine.md` 1.2 writes it out."""
    _, y, z = position
    tx, ty, tz = t
    return (
        e["EXX"] + e["EXY"] + e["EXZ"] - e["C0Y"] * y + e["B0Z"] * z
        + (e["EBX"] + e["EBY"]) * (z + tz) + e["EBZ"] * tz - e["ECX"] * (y + ty) - (e["ECY"] + e["ECZ"]) * ty,
        e["EYX"] + e["EYY"] + e["EYZ"] - e["A0Z"] * z
        - (e["EAX"] + e["EAY"]) * (z + tz) - e["EAZ"] * tz + (e["ECX"] + e["ECY"] + e["ECZ"]) * tx,
        e["EZX"] + e["EZY"] + e["EZZ"] + e["EAX"] * (y + ty) + (e["EAY"] + e["EAZ"]) * ty
        - (e["EBX"] + e["EBY"] + e["EBZ"]) * tx,
    )  # fmt: skip


def _published_yxz(e, position, t):
    """The order YXZ likewise: the bridge of most coordinate measuring machines."""
    x, y, z = position
    tx, ty, tz = t
    return (
        e["EXX"] + e["EXY"] + e["EXZ"] - e["C0Y"] * y + e["B0Z"] * z
        + (e["EBX"] + e["EBY"]) * (z + tz) + e["EBZ"] * tz - (e["ECX"] + e["ECY"] + e["ECZ"]) * ty,
        e["EYX"] + e["EYY"] + e["EYZ"] - e["A0Z"] * z
        - (e["EAX"] + e["EAY"]) * (z + tz) - e["EAZ"] * tz + e["ECY"] * (x + tx) + (e["ECX"] + e["ECZ"]) * tx,
        e["EZX"] + e["EZY"] + e["EZZ"] + (e["EAX"] + e["EAY"] + e["EAZ"]) * ty
        - e["EBY"] * (x + tx) - (e["EBX"] + e["EBZ"]) * tx,
    )  # fmt: skip


@pytest.mark.parametrize(("order", "written_out"), [("XYZ", _published_xyz), ("YXZ", _published_yxz)])
@given(_point, _point, st.integers(0, 2**32))
def test_two_orders_are_as_they_are_written_out(order, written_out, position, tool, seed):
    random = np.random.default_rng(seed)
    errors = {name: float(random.uniform(-1, 1)) for name in ERRORS}
    for place in range(4):
        chain = Chain(f"{order[:place]}F{order[place:]}")
        found = deviation(errors, chain, np.array([position]), tool)[0]
        assert found == pytest.approx(written_out(errors, position, tool), abs=1e-12)


@given(
    st.sampled_from(_ORDERS),
    st.tuples(_point, _point),
    _point,
    st.sampled_from("XYZ"),
    st.integers(0, 2**32),
)
def test_an_error_is_itself_on_the_line_on_which_it_was_measured_wherever_angles_were(
    order, places, tool, axis, seed
):
    position, elsewhere = places
    errors = {name: value for name, value in _sizes(seed).items() if name[2] == axis}
    line, other = (ErrorLine(dict(zip("XYZ", each, strict=True)), tool) for each in (position, elsewhere))
    lines = {name: line if name[1] in "XYZ" else other for name in errors}
    found = deviation(errors, Chain(f"F{order}"), np.array([position]), tool, lines)[0]
    assert found == pytest.approx([errors[f"E{d}{axis}"] for d in "XYZ"], abs=1e-15)


@given(st.sampled_from(_ORDERS), _point, _point, st.sampled_from("XYZ"))
def test_the_own_coordinate_never_is_an_arm_of_its_own_rotations(order, position, line, axis):
    chain, own = Chain(f"{order}F"), "XYZ".index(axis)
    arm = lever_arm(axis, chain, ErrorLine(dict(zip("XYZ", line, strict=True))), np.array([position]))[0]
    assert arm[own] == 0.0


def test_the_three_planes_close():
    """α_x − α_y, α_y − α_z and α_z − α_x add up to nothing, whatever the scales."""
    angle = np.linspace(0, 2 * np.pi, 720, endpoint=False)
    scales = np.array([12e-6, -7e-6, 30e-6])
    total = 0.0
    for first, second in ((0, 1), (1, 2), (2, 0)):
        position = np.zeros((len(angle), 3))
        position[:, first], position[:, second] = 0.15 * np.cos(angle), 0.15 * np.sin(angle)
        errors = {
            f"E{a}{a}": scale * position[:, i] for i, (a, scale) in enumerate(zip("XYZ", scales, strict=True))
        }
        moved = deviation(errors, Chain("XYFZ"), position)
        radial = moved[:, first] * np.cos(angle) + moved[:, second] * np.sin(angle)
        total += 4 / 0.15 * float(np.mean(radial * np.cos(2 * angle)))
    assert total == pytest.approx(0.0, abs=1e-15)


@pytest.mark.parametrize("letters", ["XYZ", "XYZF1", "XXYF", "", "FXY", "xyfz"])
def test_what_is_no_chain_is_refused(letters):
    with pytest.raises(ValueError, match="XYFZ"):
        Chain(letters)


def test_squareness_errors_turn_the_axes_as_they_are_said_to():
    errors = {"C0Y": 1e-5, "B0Z": 2e-5, "A0Z": 3e-5}
    at_y, at_z = deviation(errors, Chain("XYFZ"), np.array([[0, 0.1, 0], [0, 0, 0.1]]))
    assert at_y == pytest.approx([-1e-6, 0, 0])  # Y towards −X
    assert at_z == pytest.approx([2e-6, -3e-6, 0])  # Z towards +X and −Y


#: Errors of a machine whose table moves in X below a bridge in Y, each linear in its position: per mm.
_PUBLISHED_SLOPES = {
    "EXX": 1.33e-5, "EXY": -1.12e-5, "EYY": -5.09e-6, "EXZ": 2.6e-5, "EYZ": 4.6e-6, "EZZ": 3.34e-8,
    "EAX": 7.49e-9, "EBX": 1.54e-8, "ECX": 5e-9, "EAY": -4.58e-9, "EBY": -1.43e-8, "ECY": 2.19e-8,
    "EAZ": 2.49e-9, "EBZ": -7.94e-10, "ECZ": 4.78e-8,
}  # fmt: skip
#: What the program makes of them, 0.01 µm: a row for each Z from 50 in steps of 133 mm, X from 250 likewise,
#: Y = 316 mm, the probe's tip at (0, 130, −243.4852) mm from the ram.
_PUBLISHED_DEVIATIONS = (
    "-54 -95 -30,   53 -34 -115,  161 45 -255,  269 142 -449,  376 256 -698",
    "203 -32 -25,   337 16 -110,  472 82 -250,  607 166 -444,  742 267 -693",
    "459 32 -20,    621 67 -105,  784 119 -245, 946 190 -439,  1108 277 -688",
    "716 95 -16,    906 117 -101, 1095 156 -240, 1284 213 -435, 1473 288 -683",
    "973 159 -11,   1190 167 -96, 1406 193 -236, 1623 237 -430, 1839 299 -679",
)


def test_a_published_program_gives_the_same_to_its_last_digit():
    """Measurement Standards Laboratory of New Zealand, `ls_cmm_error_map`, `tests/validation_data/plate`.

    Its errors turn about the carriage, so that a rotation of the table also moves what was read along its own
    axis: EYX and EZX as measured on the line hold that.
    """
    published = [[each.split() for each in row.split(",")] for row in _PUBLISHED_DEVIATIONS]
    found = np.array(published, dtype=float).reshape(-1, 3) * 1e-5
    position = np.array([[250 + 133 * i, 316, 50 + 133 * j] for j in range(5) for i in range(5)], dtype=float)
    errors = {name: slope * position[:, "XYZ".index(name[2])] for name, slope in _PUBLISHED_SLOPES.items()}
    errors["EYX"], errors["EZX"] = errors["ECX"] * position[:, 0], -errors["EBX"] * position[:, 0]
    ours = deviation(errors, Chain("XFYZ"), position, (0.0, 130.0, -243.4852))
    assert np.abs(ours - found).max() < 0.51e-5
