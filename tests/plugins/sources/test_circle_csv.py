"""Tables of circles: senses, angles or times, deviations or radii, feed-in, and averages of many readings."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from installed import registry
from plugins.sources.reading import MM, UM, File, said
from zlmreport.looking import look_at
from zlmreport.plugin import CIRCLE, Axis, InputError, NominalCircle

#: Radius 150 mm, feed 1000 mm/min.
XY = Axis("XY", quantity=CIRCLE, circle=NominalCircle("XY", 0.15, 1 / 60))
HEADER = "sense,run,angle,deviation\n"


@pytest.fixture
def file(tmp_path: Path) -> File:
    return File("circle-csv", tmp_path / "circle.csv")


def rows(count=36, senses=("ccw", "cw"), runs=(1,), deviation=math.cos, first=0.0):
    """Return rows of full turns, each beginning at an angle and going on in its sense."""
    for run in runs:
        for sense in senses:
            way = 1 if sense == "ccw" else -1
            for step in range(count):
                angle = (first + way * step * 360 / count) % 360
                yield f"{sense},{run},{angle:.9g},{deviation(math.radians(angle)):.12g}"


def table(*args, **keys) -> str:
    return HEADER + "\n".join(rows(*args, **keys)) + "\n"


def read(file: File, content: str, **keys):
    return file.read(content, XY, **keys)


def test_a_circle_is_read_as_sense_angle_and_run(file: File) -> None:
    found = read(file, table(runs=(1, 2)))
    assert found.deviations().shape == (2, 36, 2)
    assert found.target_positions[9] == pytest.approx(math.pi / 2)
    assert found.approach[:3].tolist() == [1, 1, 1]  # counter-clockwise
    np.testing.assert_allclose(found.deviations()[0, :, 0], UM * np.cos(found.target_positions), atol=1e-14)
    np.testing.assert_array_equal(found.deviations()[0], found.deviations()[1])
    assert not found.missing()


def test_readings_keep_the_order_of_time(file: File) -> None:
    found = read(file, table(first=90.0))
    clockwise = found.target_positions[found.target[found.approach == -1]]
    assert np.degrees(clockwise[:3]).tolist() == pytest.approx([90.0, 80.0, 70.0])


@pytest.mark.parametrize(("ccw", "cw"), [("CCW", "CW"), ("counter-clockwise", "clockwise"), ("G3", "G2")])
def test_senses_are_known_by_their_spellings(file: File, ccw: str, cw: str) -> None:
    content = table().replace("ccw", "§").replace("cw", cw).replace("§", ccw)
    assert read(file, content).approaches == (1, -1)


def test_radii_give_deviations_from_the_nominal_one(file: File) -> None:
    content = table(deviation=lambda angle: 150 + 0.002 * math.sin(angle)).replace("deviation", "radius")
    found = read(file, content)
    np.testing.assert_allclose(
        found.deviations()[0, :, 0], 2 * UM * np.sin(found.target_positions), atol=1e-12
    )


def test_columns_and_units_are_as_the_job_says(file: File) -> None:
    content = table().replace("sense,run,angle,deviation", "Drehsinn;Lauf;Winkel;Abweichung [nm]")
    lines = [line.replace(",", ";").replace(".", ",") for line in content.splitlines()[1:]]
    keys = {"sense": "Drehsinn", "run": "Lauf", "angle": "Winkel", "deviation": "Abweichung"}
    found = read(file, "\n".join([content.splitlines()[0], *lines]), columns=keys)
    assert found.deviations()[0, 0, 0] == pytest.approx(1e-9)


def test_angles_are_reckoned_from_times_and_the_feed(file: File) -> None:
    # 1000 mm/min on 150 mm: 6.366° a second.
    turn = 2 * math.pi * 150 / (1000 / 60)
    lines = [f"{sense},1,{step * turn / 72:.9f},{step}" for sense in ("ccw", "cw") for step in range(72)]
    found = read(file, "sense,run,time,deviation\n" + "\n".join(lines), start=90)
    angle = np.degrees(found.target_positions[found.target])
    assert angle[:3].tolist() == pytest.approx([90, 95, 100], abs=1e-6)
    assert angle[72:75].tolist() == pytest.approx([90, 85, 80], abs=1e-6)
    assert "time and feed: each turn begins at 90° and goes on with 1000 mm/min" in said(found)[0]


def test_what_goes_beyond_a_turn_is_set_aside_by_halves(file: File) -> None:
    lines = [f"ccw,1,{step % 360},{step}" for step in range(-45, 405)]
    found = read(file, HEADER + "\n".join(lines))
    assert len(found.deviation) == 360
    assert sorted((found.deviation / UM).round(6).tolist()) == list(range(360))
    assert "44.5° before it and 44.5° behind it are set aside" in " ".join(said(found))


@pytest.mark.parametrize(
    ("keys", "first"), [({"feed_in": 30, "feed_out": 60}, -15), ({"feed_in": 90}, 45), ({"feed_out": 0}, 45)]
)
def test_stated_arcs_are_set_aside(file: File, keys, first: int) -> None:
    lines = [f"ccw,1,{step % 360},{step}" for step in range(-45, 406)]
    found = read(file, HEADER + "\n".join(lines), **keys)
    assert (found.deviation / UM).round(6).tolist() == list(range(first, first + 360))


def test_the_reading_that_closes_a_turn_is_not_counted_twice(file: File) -> None:
    lines = [f"ccw,1,{10 * step},{step}" for step in range(37)]
    assert len(read(file, HEADER + "\n".join(lines)).deviation) == 36


def test_an_arc_is_read_as_it_is(file: File) -> None:
    lines = [f"{sense},1,{step},1" for sense in ("ccw", "cw") for step in range(-20, 201)]
    lines[221:] = reversed(lines[221:])
    found = read(file, HEADER + "\n".join(lines))
    assert found.deviations().shape == (2, 221, 1)


def many(noise=0.0, vibration=0.0, hertz=0.0, count=20_000):
    """Return a table of so many readings a turn, each sense at angles of its own."""
    random = np.random.default_rng(7)
    seconds = 2 * math.pi * 0.15 * 60  # of a turn at 1 m/min
    lines = []
    for sense, way, first in (("ccw", 1, 0.0), ("cw", -1, 0.003)):
        time = np.arange(count) * seconds / count
        angle = first + way * 360 * time / seconds
        value = 30 * np.cos(np.radians(angle)) + 4 * np.sin(2 * np.radians(angle))
        value += random.normal(0, noise, count) + vibration * np.sin(2 * np.pi * hertz * time)
        lines += [f"{sense},1,{a:.6f},{v:.5f}" for a, v in zip(angle % 360, value, strict=True)]
    return HEADER + "\n".join(lines)


def test_many_readings_are_averaged_without_moving_the_path(file: File) -> None:
    found = read(file, many())
    assert len(found.target_positions) == 3600
    angle = found.target_positions[found.target]
    np.testing.assert_allclose(
        found.deviation / UM, 30 * np.cos(angle) + 4 * np.sin(2 * angle), rtol=0, atol=1e-4
    )
    averaging = found.provenance.averaging
    assert averaging.readings == 40_000
    assert averaging.amplitude == 0.0


@pytest.mark.parametrize("begins", [0.0, 0.2, 1.25])
def test_an_arc_in_which_a_turn_begins_and_ends_keeps_its_place_in_time(file: File, begins: float) -> None:
    # arcs of 2.5°, with 50 readings in each
    lines = ["sense,run,angle,deviation,time"]
    for sense, way in (("ccw", 1), ("cw", -1)):
        lines += [
            f"{sense},1,{(begins + way * 0.05 * index) % 360:.2f},1,{(way < 0) * 1e4 + index * 0.05:.2f}"
            for index in range(7_201)
        ]
    found = read(file, "\n".join(lines), readings_per_turn=144)
    assert found.deviations().shape == (2, 144, 1)
    assert np.diff(found.time).min() > 0


def test_a_vibration_that_averages_hide_is_told(file: File) -> None:
    # 47 Hz at 0.6 µm, which averages over six readings still show in part; over arcs of 1° it is gone.
    found = read(file, many(noise=0.2, vibration=0.6, hertz=47.0), readings_per_turn=360)
    averaging = found.provenance.averaging
    assert averaging.frequency == pytest.approx(47.0, abs=0.05)
    assert averaging.amplitude / UM == pytest.approx(0.6, abs=0.03)
    assert "47 Hz (by the stated feed)" in " ".join(said(found))


def test_noise_alone_is_no_vibration(file: File) -> None:
    averaging = read(file, many(noise=0.2), readings_per_turn=360).provenance.averaging
    assert averaging.amplitude == 0.0
    assert averaging.left_out / UM == pytest.approx(0.2, rel=0.05)


def test_readings_that_all_share_their_angles_are_kept(file: File) -> None:
    found = read(file, table(3600))
    assert found.provenance.averaging is None
    assert found.deviations().shape == (2, 3600, 1)


def test_a_missing_reading_stays_missing(file: File) -> None:
    lines = table().splitlines()
    lines[5] = lines[5].rpartition(",")[0] + ","
    found = read(file, "\n".join(lines))
    assert len(found.missing()) == 1


def test_one_sense_for_all_is_stated_by_the_job(file: File) -> None:
    lines = [f"1,{10 * step},1" for step in range(36)]
    content = "run,angle,deviation\n" + "\n".join(lines)
    assert read(file, content, sense="ccw").approaches == (1,)
    assert "say 'sense: ccw' for all readings" in file.complaint(content, XY)


def test_conditions_are_kept_beside_each_reading(file: File) -> None:
    lines = [f"ccw,1,{10 * step},1,{20 + step / 100}" for step in range(36)]
    found = read(file, "sense,run,angle,deviation,air_temperature\n" + "\n".join(lines))
    assert found.conditions["air_temperature"][1] == pytest.approx(293.16)


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        (HEADER + "ccw,1,0,1\nccw,1,120,2\nccw,1,240,3\n", "circle.csv:2:9: run 1 ccw has 3 readings"),
        (table().replace("ccw,1,10,", "cww,1,10,"), "circle.csv:3:1: 'cww' is no sense of a circle"),
        (table().replace("angle", "angel"), "circle.csv:1:1: there is no column 'angle', but 'angel'"),
        (table().replace("ccw,1,10,", "ccw,1.5,10,"), "circle.csv:3:5: 1.5 is no number of a run"),
        (table().replace("ccw,1,10,", "ccw,1,,"), "circle.csv:3:7: there is no angle"),
        (table().replace("ccw,1,10,", "ccw,1,ten,"), "circle.csv:3:7: 'ten' stands where a number belongs"),
        ("sense,angle,angle,deviation\nccw,1,1,1\n", "circle.csv:1:13: column 3 is called 'angle'"),
        ("sense,angle,deviation,radius\nccw,1,1,1\n", "circle.csv:1:1: there are both deviations and radii"),
        (
            HEADER + "\n".join(f"ccw,1,{math.radians(10 * step):.5f},1" for step in range(36)),
            "circle.csv:1:11: the angles reach 6.109: as degrees that is hardly an arc; are they radians?",
        ),
        (
            table(deviation=lambda angle: 150 + 0.002 * math.sin(angle)),
            "circle.csv:1:17: the deviations are about 150, as the nominal radius (circle.radius), 150 mm",
        ),
        (
            table(deviation=lambda angle: 0.002 * math.sin(angle) + 0.1).replace("deviation", "radius"),
            "circle.csv:1:17: the radii are about 0.1 mm, and the nominal radius",
        ),
        (
            table().replace("ccw", "§").replace("cw", "ccw").replace("§", "cw"),
            "circle.csv:2:8: run 1 cw: the angles of this turn rise, so that it went ccw",
        ),
    ],
)
def test_a_wrong_table_is_refused_with_its_place(file: File, content: str, complaint: str) -> None:
    assert file.complaints(content, XY)[0].startswith(complaint)


def test_radians_are_read_where_they_are_stated(file: File) -> None:
    content = HEADER + "\n".join(f"ccw,1,{math.radians(10 * step):.7f},1" for step in range(36))
    found = read(file, content, units={"angle": "rad"})
    assert np.degrees(found.target_positions[1]) == pytest.approx(10, abs=1e-4)


def test_without_a_circle_in_the_job_nothing_is_read(file: File) -> None:
    assert "this job has no circle" in file.complaint(table(), Axis("X"))


def test_a_radius_in_metres_is_read_in_metres(file: File) -> None:
    content = table(deviation=lambda _: 0.150003).replace("deviation", "radius (m)")
    assert read(file, content).deviation[0] == pytest.approx(3 * UM)
    assert XY.circle.radius == MM * 150


@pytest.mark.parametrize(("way", "sense"), [(1, "ccw"), (-1, "cw")])
def test_a_turn_that_names_no_sense_is_known_by_its_radial_deviations(
    file: File, tmp_path: Path, way: int, sense: str
) -> None:
    path = tmp_path / "run.csv"
    turn = [f"{(way * step * 10) % 360},{math.cos(step):.3f}" for step in range(36)]
    path.write_text("\n".join(["Angle [deg],Radial deviation [um]", *turn]) + "\n", encoding="utf-8")
    (found,) = file.source.proposals(path)
    assert dict(found.keys) == {"sense": sense, "columns": {"deviation": "Radial deviation [um]"}}
    assert found.circle is not None


def test_angles_of_a_rotary_axis_are_no_circle(file: File, tmp_path: Path) -> None:
    path = tmp_path / "rotary.csv"
    path.write_text("angle,deviation\n" + "".join(f"{10 * n},{n}\n" for n in range(36)), encoding="utf-8")
    assert not list(file.source.proposals(path))


@pytest.mark.parametrize(
    "rows",
    [
        "angle,radial error\n",
        "angle,radial error\n0,1\n",
        "sense,run,angle,radius\nccw,1,0,\nccw,1,90,\n",
    ],
)
def test_a_table_that_tells_nothing_of_a_circle_is_looked_at_without_a_warning(
    file: File, tmp_path: Path, rows: str
) -> None:
    path = tmp_path / "empty.csv"
    path.write_text(rows, encoding="utf-8")
    assert all(each.circle for each in file.source.proposals(path))


def test_deviations_in_a_column_of_radii_are_told_from_radii(tmp_path: Path) -> None:
    path = tmp_path / "run.csv"
    turn = [f"ccw,1,{angle},{0.01 + angle / 1e6:.6f}" for angle in range(0, 360, 10)]
    path.write_text("\n".join(["sense,run,angle,radius", *turn]) + "\n", encoding="utf-8")
    with pytest.raises(InputError, match="are they deviations, or is a unit wrong"):
        look_at(path, registry())


@pytest.mark.parametrize(
    "header",
    [
        "Drehsinn;Lauf;Winkel;Abweichung (µm)",
        "sens de rotation;tour;angle;écart radial (µm)",
        "Senso di rotazione;Giro;Angolo;Scostamento (µm)",
        "Sentido de giro;Vuelta;Ángulo;Desviación (µm)",
    ],
)
def test_a_circle_with_headings_of_another_language_is_looked_at_as_a_circle(
    header: str, tmp_path: Path
) -> None:
    """It was read as a table of directions."""
    path = tmp_path / "run.csv"
    turn = [f"ccw;1;{angle};{angle / 100}" for angle in range(0, 360, 10)]
    path.write_text("\n".join([header, *turn]) + "\n", encoding="utf-8")
    looked = look_at(path, registry())
    assert looked.source.identifier == "circle-csv"
    np.testing.assert_allclose(looked.read.deviation * 1e6, [angle / 100 for angle in range(0, 360, 10)])
