"""The layouts of probed points give the same measurement, and their defects are told with the place."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from environments import ROOT
from installed import registry
from refusals import refusal
from step_gauge.simulated_cmm import MachineErrors, SimulatedTest, simulate
from zlmreport.plugin import (
    ANGLE,
    STRAIGHTNESS,
    Axis,
    AxisKind,
    FloatArray,
    InputError,
    MeasurementSet,
    Place,
)
from zlmreport.plugin.protocols import SourceContext
from zlmreport_step_gauge.calibration import cut_section, read_calibration
from zlmreport_step_gauge.gauge import StepGauge
from zlmreport_step_gauge.initial_points import InitialPoints
from zlmreport_step_gauge.location import Located, locate
from zlmreport_step_gauge.set_up import GaugeSetUp

DATA = ROOT / "tests" / "data" / "step_gauge"
RAW, LOG, CALYPSO = DATA / "stepgauge_raw.csv", DATA / "stepgauge.res", DATA / "STEPGAUGE_1_chr.txt"
SOURCE = registry().source("step-gauge")
CALIBRATED = read_calibration(DATA / "stepgauge_cal.csv")
HERE = Place("job.yaml", 12, 5)
#: The line of the recorded run, and the centre of the front face of its first block: half a micrometre would
#: not matter for telling the faces apart.
DIRECTION = (-0.0006, 0.9999998, 0.0)


def whole(**stated: Any) -> GaugeSetUp:
    plain = {
        "gauge": CALIBRATED.gauge,
        "located": None,
        "tip_radius": 2e-3,
        "radius_is_corrected": False,
        "effective_radius": None,
        "probing_uncertainty": 0.0,
        "gauge_expansion": None,
        "scale_expansion": None,
        "files": (CALIBRATED.file,),
        "place": HERE,
    }
    return GaugeSetUp(**{**plain, **stated})


def located(gauge: StepGauge) -> Located:
    """Return where the gauge of the recorded run lies."""
    test = SimulatedTest(
        gauge_with_size(gauge), (0.2908632, 0.041015, 0.20128), DIRECTION, point_uncertainty=0.0
    )
    points = simulate(test, MachineErrors(), np.random.default_rng(1)).initial_points
    return locate(InitialPoints(points, HERE), gauge, 2e-3, 1e-6)


def gauge_with_size(gauge: StepGauge) -> StepGauge:
    from dataclasses import replace

    return replace(gauge, block_width=20e-3, block_height=15e-3)


@pytest.mark.parametrize(
    ("axis", "what"),
    [
        (Axis("C", AxisKind.ROTARY), "a rotary axis"),
        (Axis("X", quantity=STRAIGHTNESS), "straightness"),
        (Axis("X", quantity=ANGLE), "angle"),
    ],
)
def test_lengths_measure_neither_angles_nor_what_lies_across(axis: Axis, what: str) -> None:
    with pytest.raises(InputError, match=f"along a linear axis, and this job is on {what};"):
        SOURCE.read(SOURCE.options(file=RAW), SourceContext(axis, HERE, {"step_gauge": whole()}))


def read(path: Path, set_up: GaugeSetUp | None = None, **keys: Any) -> MeasurementSet:
    options = SOURCE.options(file=path, **keys)
    return SOURCE.read(options, SourceContext(Axis("Y"), HERE, {"step_gauge": set_up or whole()}))


def means(measurements: MeasurementSet) -> FloatArray:
    grid = measurements.deviations().mean(axis=-1)
    return np.where(np.isnan(grid[0]), grid[1], grid[0])


def test_a_table_of_points_gives_a_target_for_each_face() -> None:
    found = read(RAW)
    assert found.target_positions == pytest.approx(0.01 * np.arange(10))
    assert len(found.runs) == 2


def test_the_deviation_of_a_front_face_is_that_of_the_difference_of_two_centres() -> None:
    # Faces 9 and 1, means of both cycles: 119.01872 − 39.015675 mm along y; S₉ = 80.00064 mm.
    by_hand = 119.01872e-3 - 39.015675e-3 - 80.00064e-3
    assert means(read(RAW))[8] == pytest.approx(by_hand, abs=0.02e-6)


def test_the_log_of_the_run_gives_what_its_table_gives() -> None:
    assert means(read(LOG)) == pytest.approx(means(read(RAW)), abs=1e-9)


def test_points_without_numbers_find_their_faces_by_where_the_gauge_lies() -> None:
    found = read(LOG, whole(located=located(CALIBRATED.gauge)))
    assert means(found) == pytest.approx(means(read(RAW)), abs=0.05e-6)


def test_a_sequence_of_coordinates_is_cut_into_cycles(tmp_path: Path) -> None:
    lines = [line for line in RAW.read_text(encoding="utf-8").splitlines() if line[:1].isdigit()]
    sequence = tmp_path / "raw.dat"
    sequence.write_text("\n".join("  ".join(line.split(",")[2:5]) for line in lines), encoding="utf-8")
    assert np.allclose(read(sequence).deviation, read(RAW).deviation, atol=1e-12)


def test_a_sequence_that_is_no_whole_number_of_cycles_is_refused(tmp_path: Path) -> None:
    sequence = tmp_path / "raw.dat"
    sequence.write_text("1 2 3\n4 5 6\n", encoding="utf-8")
    told = refusal(read, sequence)
    assert "holds 2 points, and a cycle over this section has 10: a face was missed" in told


def test_a_table_of_characteristics_gives_distances_of_the_surface() -> None:
    of = whole(gauge=cut_section(CALIBRATED.gauge, 1, 2, HERE))
    # actual minus calibrated, mean of the two parts: 10.00036 − 9.99962 and so on
    by_hand = [0.0, 0.74e-6, -0.28e-6, 1.30e-6]
    assert means(read(CALYPSO, of)) == pytest.approx(by_hand, abs=1e-9)


def test_remarks_may_stand_before_a_table_of_characteristics(tmp_path: Path) -> None:
    of = whole(gauge=cut_section(CALIBRATED.gauge, 1, 2, HERE))
    remarked = tmp_path / "part_chr.txt"
    remarked.write_text(f"# measured by hand\n\n{CALYPSO.read_text(encoding='utf-8')}", encoding="utf-8")
    assert means(read(remarked, of)) == pytest.approx(means(read(CALYPSO, of)))


def test_a_number_that_no_face_has_is_told_as_a_name(tmp_path: Path) -> None:
    table = tmp_path / "part_chr.txt"
    table.write_text(f"partnb\tid\tactual\tunit\n1\tF{'3' * 5000}\t20.0\tmm\n", encoding="utf-8")
    assert "names no face of the gauge; state measurement.source.faces" in refusal(read, table)


def test_a_line_that_holds_a_tag_alone_is_no_log(tmp_path: Path) -> None:
    table = tmp_path / "points.txt"
    table.write_text("12345 \n", encoding="utf-8")
    assert "three numbers are expected, x y z: '12345'" in refusal(read, table)


def test_characteristics_of_other_names_are_mapped_by_the_job(tmp_path: Path) -> None:
    renamed = tmp_path / "part_chr.txt"
    text = CALYPSO.read_text(encoding="utf-8")
    for number, name in enumerate("ABCD", 1):
        text = text.replace(f"\tF0{number}\tY1", f"\tStep {name}\tY1")
    renamed.write_text(text, encoding="utf-8")
    of = whole(gauge=cut_section(CALIBRATED.gauge, 1, 2, HERE))
    mapping = {f"Step {name}": number for number, name in enumerate("ABCD", 1)}
    assert means(read(renamed, of, faces=mapping)) == pytest.approx(means(read(CALYPSO, of)))
    assert "'Step A' names no face of the gauge; state measurement.source.faces" in refusal(read, renamed, of)


def test_front_faces_alone_make_a_test_in_one_direction() -> None:
    found = read(RAW, whole(radius_is_corrected=True, tip_radius=None), side="front")
    assert found.approaches == (1,)
    assert len(found.target_positions) == 5


def test_a_normal_that_looks_the_other_way_is_refused_with_its_line(tmp_path: Path) -> None:
    turned = tmp_path / "turned.csv"
    turned.write_text(
        RAW.read_text(encoding="utf-8").replace("-0.0006000,0.9999998", "0.0006000,-0.9999998"),
        encoding="utf-8",
    )
    message = refusal(read, turned, whole(located=located(CALIBRATED.gauge)))
    assert (
        "turned.csv:4:1: face 2 is a back face, and the normal of this point looks the other way" in message
    )


def test_an_error_answer_in_a_log_is_refused_with_its_line(tmp_path: Path) -> None:
    log = tmp_path / "run.res"
    log.write_text(
        '00010 &\n00120 ! Error(2, 1006, PtMeas, "Surface not found")\n00120 %\n', encoding="utf-8"
    )
    assert "run.res:2:1: the machine answered with an error: 2, 1006, PtMeas" in refusal(read, log)


def test_a_point_off_every_face_is_refused_with_its_line(tmp_path: Path) -> None:
    log = tmp_path / "run.res"
    log.write_text(LOG.read_text(encoding="utf-8").replace("Y(59.01421)", "Y(54.01421)"), encoding="utf-8")
    message = refusal(read, log, whole(located=located(CALIBRATED.gauge)))
    assert "on no face of it" in message


def test_text_in_the_place_of_a_coordinate_is_refused_with_its_column(tmp_path: Path) -> None:
    broken = tmp_path / "broken.csv"
    broken.write_text(RAW.read_text(encoding="utf-8").replace("53.01088", "x"), encoding="utf-8")
    assert "broken.csv:4:15: column y: 'x' stands where a number belongs" in refusal(read, broken)
