"""ISO 230-6: body diagonals of a work space, and those of its faces."""

from __future__ import annotations

from itertools import pairwise, product
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, strategies as st

from cli.commands import Shop
from installed import registry
from zlmreport.machines.kinematics import Chain, deviation
from zlmreport.measurement.measurement_set import join_lines
from zlmreport.plugin import Axis, Evaluation, Language, MeasurementSet
from zlmreport.plugin.standard import evaluate
from zlmreport.testing import bidirectional_test

STANDARD = registry().standard("iso230-6:2002")
(DIAGONALS,) = STANDARD.measurands
#: By the axes that fall along them; the first end is where all of them begin.
BODY = ("PPP", "NPP", "PNP", "NNP")
#: By the squareness error that they show.
FACES = {"C0Y": ("XYPP", "XYNP"), "B0Z": ("XZPP", "XZNP"), "A0Z": ("YZPP", "YZNP")}
ARCSECOND = np.pi / 180 / 3600
SPACE = {"X": (0.0, 500.0), "Y": (0.0, 400.0), "Z": (0.0, 300.0)}
SHARES = np.linspace(0.0, 1.0, 9)


def line(name: str, up: np.ndarray, down: np.ndarray | None = None, length: float = 600.0) -> MeasurementSet:
    """Return the readings of a diagonal, µm: a row for each of nine positions, a column for each run."""
    back = np.full_like(up, np.nan) if down is None else down
    return bidirectional_test(SHARES * length, up, back, axis=Axis(name, quantity=DIAGONALS.of_lines))


def together(tests: dict[str, MeasurementSet], space: dict[str, tuple[float, float]] = SPACE) -> Evaluation:
    options = STANDARD.options.model_validate({"axes": space})
    return evaluate(STANDARD, join_lines(Axis("space", quantity=DIAGONALS), tests), options, {})


def values(evaluation: Evaluation) -> dict[str, float]:
    return {each.quantity.symbol: each.value * 1e6 for each in evaluation.parameters}


@given(st.integers(0, 2**32 - 1))
def test_deviations_of_each_diagonal_and_the_largest_of_them(seed: int) -> None:
    """Against loops over single positions that share nothing with the program."""
    scatter = np.random.default_rng(seed)
    up = {name: scatter.normal(0, 3, (9, 3)) for name in BODY}
    down = {name: scatter.normal(0, 3, (9, 3)) for name in BODY}
    found = values(together({name: line(name, up[name], down[name]) for name in BODY}))
    spans, reversals = {}, {}
    for name in BODY:
        means = [sum(row) / 3 for row in up[name]], [sum(row) / 3 for row in down[name]]
        spans[name] = np.ptp([*means[0], *means[1]])
        reversals[name] = max(abs(a - b) for a, b in zip(*means, strict=True))
        assert found[f"E_{name}_fwd"] == pytest.approx(max(means[0]) - min(means[0]))
        assert found[f"E_{name}_bwd"] == pytest.approx(max(means[1]) - min(means[1]))
        assert found[f"E_{name}"] == pytest.approx(spans[name])
        assert found[f"B_{name}"] == pytest.approx(reversals[name])
    assert found["E_d"] == pytest.approx(max(spans.values()))
    assert found["B_d"] == pytest.approx(max(reversals.values()))


def along(
    signs: dict[str, int], error: dict[str, float], space: dict[str, tuple[float, float]]
) -> np.ndarray:
    """Return the deviation along a diagonal, µm, of a machine with errors, by its kinematics."""
    places = np.zeros((len(SHARES), 3))
    direction = np.zeros(3)
    for axis, sign in signs.items():
        side = np.ptp(space[axis]) * 1e-3
        places[:, "XYZ".index(axis)] = side * (SHARES if sign > 0 else 1 - SHARES)
        direction["XYZ".index(axis)] = sign * side
    moved = deviation(error, Chain("XYZF"), places)
    moved = moved - moved[0]
    return np.asarray(moved @ (direction / np.linalg.norm(direction)) * 1e6)[:, np.newaxis]


def scales(error: float, space: dict[str, tuple[float, float]]) -> dict[str, MeasurementSet]:
    """Return body diagonals of a machine whose X scale is too long by as much as that of Y is too short."""
    found = {}
    sides = np.array([np.ptp(space[axis]) * 1e-3 for axis in "XYZ"])
    for name in BODY:
        direction = np.array([1 if each == "P" else -1 for each in name]) * sides
        elongated = error * np.array([1, -1, 0]) * direction
        total = float(elongated @ direction / np.linalg.norm(direction)) * 1e6
        found[name] = line(name, total * SHARES[:, np.newaxis])
    return found


def test_two_scales_cancel_on_every_diagonal_and_the_document_says_that_it_is_no_diagnosis() -> None:
    square = {"X": (0.0, 400.0), "Y": (0.0, 400.0), "Z": (0.0, 300.0)}
    evaluation = together(scales(50e-6, square), square)  # 20 µm on each of both axes
    assert values(evaluation)["E_PPP_fwd"] == pytest.approx(0.0, abs=1e-9)
    assert any("no diagnosis" in note.en for note in evaluation.notes)
    assert values(together(scales(50e-6, SPACE)))["E_PPP_fwd"] > 1


@pytest.mark.parametrize("symbol", FACES)
def test_a_face_out_of_square_is_found_to_be_so(symbol: str) -> None:
    first, second = FACES[symbol]
    one, other = first[0], first[1]
    true = 4.0 * ARCSECOND
    length = np.hypot(SPACE[one][1], SPACE[other][1])
    tests = {
        name: line(name, along({one: way, other: 1}, {symbol: true}, SPACE), length=length)
        for name, way in ((first, 1), (second, -1))
    }
    found = together(tests)
    assert found.value(symbol) == pytest.approx(true, rel=1e-6)
    assert found.value("E_d") is None


def test_a_face_whose_sides_nobody_stated_shows_no_squareness() -> None:
    flat = np.zeros((9, 1))
    tests = {name: line(name, flat) for name in FACES["C0Y"]}
    assert together(tests, {}).value("C0Y") is None


def test_three_diagonals_have_no_largest_of_four() -> None:
    flat = {name: line(name, np.zeros((9, 5)), np.ones((9, 5))) for name in BODY[:3]}
    found = together(flat)
    assert "E_d" not in values(found)
    assert values(found)["B_NPP"] == pytest.approx(1.0)
    (four,) = (each for each in found.findings if "four" in each.requirement.en)
    assert four.met is False
    assert "NNP" in four.found.in_language(Language.ENGLISH)


def test_a_diagonal_of_one_position_has_no_length_and_no_systematic_deviation() -> None:
    one = bidirectional_test(
        [0.0], np.array([[0.1]]), np.array([[0.3]]), axis=Axis("PPP", quantity=DIAGONALS.of_lines)
    )
    assert values(together({"PPP": one})) == {"B_PPP": pytest.approx(0.2)}


def test_a_diagonal_longer_than_the_work_space_is_told() -> None:
    flat = {name: line(name, np.zeros((9, 5)), length=900.0) for name in BODY}
    (room,) = (each for each in together(flat).findings if "within the work space" in each.requirement.en)
    assert room.met is False
    assert "900 mm" in room.found.in_language(Language.ENGLISH)


JOB = """\
schema: zlmreport/job/1
certificate: {number: D-1, kind: report}
axes: {X: [0, 300], Y: [0, 300], Z: [0, 300]}
measurement:
  date: 2026-11-17
  tests:
    PPP: {source: {plugin: laser-csv, file: d.csv}}
    NPP: {source: {plugin: laser-csv, file: d.csv}}
    PNP: {source: {plugin: laser-csv, file: d.csv}}
    NNP: {source: {plugin: laser-csv, file: d.csv}}
instrument: {name: Laser interferometer, expanded_uncertainty: 0.3 + 0.5*L}
evaluate: ["iso230-6:2002"]
output: {formats: [json]}
"""


@pytest.fixture
def shop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Shop:
    monkeypatch.chdir(tmp_path)
    shop = Shop(tmp_path, capsys)
    rows = [
        f"{50 * step},{way},{run},{step * 0.3:.2f}"
        for run, way in product((1, 2), "+-")
        for step in (range(11) if way == "+" else range(10, -1, -1))
    ]
    assert all(before != after for before, after in pairwise(rows))
    shop.write("d.csv", "\n".join(["target,direction,run,deviation", *rows]))
    return shop


def test_what_is_missing_of_the_uncertainty_is_named_as_for_positions(shop: Shop) -> None:
    run = shop.run(str(shop.write("d.yaml", JOB)))
    assert run.code == 0, run.messages
    text = (shop.folder / "D-1.json").read_text(encoding="utf-8")
    for contributor in ("misalignment", "environmental_variation"):
        assert contributor in text


@pytest.mark.parametrize(
    ("said", "instead", "message"),
    [
        ("NNP: {", "NNQ: {", "'NNQ' is none of the lines of diagonals; did you mean"),
        ("X: [0, 300]", "X: [300, 0]", "X: the first position must be less than the last"),
        ("X: [0, 300]", "V: [0, 300]", "V"),
    ],
)
def test_a_wrong_job_is_told_where(said: str, instead: str, message: str, shop: Shop) -> None:
    run = shop.run(str(shop.write("d.yaml", JOB.replace(said, instead))))
    assert run.code == 2
    assert message in run.messages
    assert "d.yaml:" in run.messages
