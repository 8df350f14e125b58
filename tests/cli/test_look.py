"""``zlmreport look``: the block it proposes reads the file, and ``init --from`` writes a job that runs."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from openpyxl import Workbook

from cli.commands import Shop
from environments import ROOT
from zlmreport import ZlmreportError
from zlmreport.cli import main
from zlmreport.looking import look_at
from zlmreport.plugin import InputError
from zlmreport.plugin.registry import find_plugins

REGISTRY = find_plugins({})
LONG = "target,direction,run,deviation\n0,+,1,1.5\n100,+,1,2.5\n100,-,1,0.5\n0,-,1,-0.5\n"
GERMAN = (
    "Prüfling: Fräsmaschine\nBediener: Müller\n\n"
    "Sollposition;Richtung;Messlauf;Abweichung (mm);Bemerkung\n"
    "0,0;auf;1;0,0015;kalt\n100,0;auf;1;0,0025;\n100,0;ab;1;0,0005;warm\n0,0;ab;1;-0,0005;\n"
    "Ende des Protokolls\n"
)
FRENCH = (
    "Position cible (mm);Sens;Passe;Écart (µm);Température de l'air (°C)\n"
    "0,0;aller;1;1,5;20,1\n100,0;aller;1;2,5;20,1\n100,0;retour;1;0,5;20,2\n0,0;retour;1;-0,5;20,2\n"
)
ITALIAN = "Posizione nominale [mm];Passata 1 andata;Passata 1 ritorno;Media\n0;1,5;-0,5;0\n100;2,5;0,5;0\n"
SPANISH = (
    "Posicion objetivo,Posicion real,Sentido,Ciclo\n"
    "0,0.0015,ida,1\n100,100.0025,ida,1\n100,100.0005,vuelta,1\n0,-0.0005,vuelta,1\n"
)
WIDE = "Target\tRun 1 fwd\tRun 1 bwd\tMean\n0\t1.5\t-0.5\t0.5\n100\t2.5\t0.5\t1.5\n"
POSITIONS = "Soll;1+;1-\n0;0,0015;-0,0005\n100;100,0025;100,0005\n"
ACTUAL = "nominal,actual,dir,cycle\n0,0.0015,up,1\n100,100.0025,up,1\n100,100.0005,down,1\n0,-0.0005,down,1\n"


def workbook(table: str) -> bytes:
    """Return a table of tabs as a spreadsheet saves it, its numbers as numbers."""
    book, saved = Workbook(), BytesIO()
    for line in table.splitlines():
        book.active.append([float(cell) if cell[-1].isdigit() else cell for cell in line.split("\t")])
    book.save(saved)
    return saved.getvalue()


TABLES: dict[str, tuple[bytes, dict[str, Any]]] = {
    "the usual": (LONG.encode(), {}),
    "a German protocol": (
        GERMAN.encode("cp1252"),
        {
            "encoding": "cp1252",
            "columns": {
                "target": "Sollposition",
                "direction": "Richtung",
                "run": "Messlauf",
                "deviation": "Abweichung",
            },
            "skip_rows": 3,
            "ends_before": "Ende des Protokolls",
            "ignore": ["Bemerkung"],
        },
    ),
    "a French protocol": (
        FRENCH.encode(),
        {
            "columns": {
                "target": "Position cible",
                "direction": "Sens",
                "run": "Passe",
                "deviation": "Écart",
                "air_temperature": "Température de l'air",
            }
        },
    ),
    "an Italian wide table": (
        ITALIAN.encode(),
        {"layout": "wide", "columns": {"target": "Posizione nominale"}, "ignore": ["Media"]},
    ),
    "a Spanish table without accents": (
        SPANISH.encode(),
        {
            "columns": {
                "target": "Posicion objetivo",
                "direction": "Sentido",
                "run": "Ciclo",
                "position": "Posicion real",
            }
        },
    ),
    "UTF-16": (LONG.replace(",", "\t").encode("utf-16"), {"encoding": "utf-16"}),
    "a wide table": (WIDE.encode(), {"layout": "wide", "ignore": ["Mean"]}),
    "a wide table whose targets are called positions": (
        WIDE.replace("Target", "Position").encode(),
        {"layout": "wide", "columns": {"target": "Position"}, "ignore": ["Mean"]},
    ),
    "a workbook": (workbook(WIDE), {"layout": "wide", "ignore": ["Mean"]}),
    "a wide table of positions": (
        POSITIONS.encode(),
        {"layout": "wide", "values": "position", "columns": {"target": "Soll"}},
    ),
    "actual positions": (
        ACTUAL.encode(),
        {"columns": {"target": "nominal", "position": "actual", "direction": "dir", "run": "cycle"}},
    ),
}


@pytest.fixture
def table(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Any:
    """Return a function that writes a table to a folder of its own, and gives its path."""
    monkeypatch.chdir(tmp_path)

    def written(content: bytes) -> Path:
        path = tmp_path / "from shop" / "x-axis.csv"
        path.parent.mkdir()
        path.write_bytes(content)
        return path

    return written


@pytest.mark.parametrize("kind", TABLES)
def test_table_is_read_by_the_keys_that_are_proposed(kind: str, table: Any) -> None:
    content, keys = TABLES[kind]
    looked = look_at(table(content), REGISTRY)
    assert (looked.source.identifier, looked.proposal.keys) == ("laser-csv", keys)
    np.testing.assert_allclose(
        looked.read.deviations()[:, :, 0] * 1e6, [[1.5, 2.5], [-0.5, 0.5]], rtol=0, atol=1e-7
    )


@pytest.mark.parametrize("kind", TABLES)
def test_job_that_is_written_runs(kind: str, table: Any, capsys: pytest.CaptureFixture[str]) -> None:
    path = table(TABLES[kind][0])
    assert main(["init", "--from", str(path), "job"]) == 0
    assert main(["check", "job/job.yaml"]) == 0, capsys.readouterr().err
    assert main(["init", "--from", str(path), "job"]) != 0  # nothing that is there is touched


@pytest.mark.parametrize(
    "rows",
    [
        "target,direction,run,deviation\n50,+,1,1.5\n50,-,1,2.5\n",
        "target (rad),direction,run,deviation (urad)\n0,+,1,0.1\n0.9,+,1,0.2\n1.8,+,1,0.3\n",
    ],
    ids=["a single target", "targets of many digits in degrees"],
)
def test_travel_that_is_written_holds_the_targets(
    rows: str, table: Any, capsys: pytest.CaptureFixture[str]
) -> None:
    path = table(rows.encode())
    assert main(["init", "--from", str(path), "job"]) == 0
    assert main(["check", "job/job.yaml"]) == 0, capsys.readouterr().err


def test_a_name_of_several_lines_stays_a_comment(table: Any, capsys: pytest.CaptureFixture[str]) -> None:
    path = table(LONG.encode())
    path = path.rename(path.with_name("x\ny: 1.csv"))
    assert main(["init", "--from", str(path), "job"]) == 0
    assert main(["check", "job/job.yaml"]) == 0, capsys.readouterr().err


def test_what_nobody_can_see_in_a_file_is_asked(table: Any, capsys: pytest.CaptureFixture[str]) -> None:
    table(b"target,run,deviation\n0,1,1.5\n100,1,2.5\n")
    assert main(["look", "from shop/x-axis.csv"]) == 0
    printed = capsys.readouterr().out
    for part in ("sign: nominal-actual", "units: {deviation: mm}", "Were all readings taken upwards?"):
        assert part in " ".join(printed.split())
    assert printed.endswith('source:\n  plugin: laser-csv\n  file: x-axis.csv\n  direction: "+"\n')


def test_whether_values_are_averages_is_asked_where_they_are_called_so(table: Any) -> None:
    of_a_laser = "Position\tBidirectional Avg Error\n0\t0.0001\n100\t0.0011\n200\t0.0021\n"
    asked = look_at(table(of_a_laser.encode()), REGISTRY).proposal.asks
    assert any(
        "average of several readings, as 'Position Bidirectional Avg Error' says" in each for each in asked
    )


def test_a_mean_beside_the_readings_is_asked_about_nothing(table: Any) -> None:
    assert not any("average" in each for each in look_at(table(WIDE.encode()), REGISTRY).proposal.asks)


def test_of_a_file_whose_suffix_nobody_knows_it_is_told_what_a_table_of_readings_needs(table: Any) -> None:
    path = table(b"No.\tAxis position\tCombined\n1\t0\t0.1\n2\t100\t1.1\n")
    path = path.rename(path.with_suffix(".ren"))
    with pytest.raises(InputError, match="there is no column 'target'"):
        look_at(path, REGISTRY)


def test_unit_that_stands_in_the_header_is_not_asked(table: Any) -> None:
    asked = " ".join(look_at(table(TABLES["a German protocol"][0]), REGISTRY).proposal.asks)
    assert "sign:" in asked
    assert "units:" not in asked


def test_of_names_that_nobody_foresaw_it_is_told_which_would_be_right(table: Any) -> None:
    """Rows of signs and numbers below them are no names of columns."""
    rows = "0,0;+;1;1,5\n9,0;+;1;1,7\n20,0;+;1;1,9\n20,0;-;1;2,9\n9,0;-;1;2,5\n0,0;-;1;2,1\n"
    path = table(f"Plaats;Zin;Ronde;Afwijking\n{rows}".encode())

    with pytest.raises(ZlmreportError) as refused:
        look_at(path, REGISTRY)

    assert str(refused.value.problems[0]).startswith(
        f"{path}:1:1: there is no column 'target'; name it in the job, as in 'columns: {{target: …}}' "
        "(the file has 'Plaats', 'Zin', 'Ronde', 'Afwijking')"
    )


def test_files_of_instruments_find_their_readers() -> None:
    data = ROOT / "tests" / "data" / "sources"
    found = {
        name: look_at(data / name, REGISTRY).source.identifier
        for name in ("bidirectional.rtl", "ecmc_13e6c326.dat")
    }
    assert found == {"bidirectional.rtl": "renishaw-rtl", "ecmc_13e6c326.dat": "ecmc"}


@pytest.mark.parametrize(
    "content",
    [
        b"",
        b"nothing but words\n",
        bytes(range(256)),
        b"1,2,3\n4,5,6\n",
        WIDE.replace("Mean", "9" * 5000).encode(),
        WIDE.replace("2.5", "9" * 5000).encode(),
    ],
    ids=["empty", "words", "bytes", "numbers", "a name of 5000 digits", "a cell of 5000 digits"],
)
def test_file_that_nobody_reads_is_told_with_its_name(content: bytes, table: Any) -> None:
    path = table(content)
    with pytest.raises(ZlmreportError, match=r"x-axis\.csv"):
        look_at(path, REGISTRY)


@pytest.mark.parametrize(
    ("file", "told"),
    [
        (
            "rotary-axis/c-axis.csv",
            "5 targets from 0° to 40°; 10 runs, both directions; deviations −82.08″ to 145.44″;",
        ),
        (
            "circle/circle-xy.csv",
            "600 angles from 0° to 359.4°; 2 turns, both senses; deviations −12.2 to 11.3 µm;",
        ),
        (
            "linear-axis/y-axis.csv",
            "9 targets from −20 to 20 mm; 5 runs, both directions; deviations −48.74 to 64.66 µm;",
        ),
    ],
)
def test_what_a_file_holds_is_told_in_its_terms_and_units(shop: Shop, file: str, told: str) -> None:
    output = shop.run("look", str(ROOT / "configs" / file)).output
    assert told in " ".join(output.split())


def test_file_that_is_not_there_is_told(shop: Shop) -> None:
    run = shop.run("look", "none.csv")
    assert (run.code, run.output) == (3, "")
    assert run.messages.startswith("none.csv: ")


SENSORS = "time (h),X1,X2,Z,air_temperature\n" + "".join(
    f"{hour},{hour % 5},{hour % 3},{hour},20.{hour % 10}\n" for hour in range(25)
)


def test_a_file_of_sensors_over_time_becomes_a_test_of_each(table: Any) -> None:
    looked = look_at(table(SENSORS.encode()), REGISTRY)
    assert looked.source.identifier == "channels-csv"
    assert looked.proposal.tests == tuple(looked.read.tests) == ("X1", "X2", "Z")
    assert looked.standard == "iso230-3"


def test_a_job_on_sensors_that_is_written_runs(table: Any, capsys: pytest.CaptureFixture[str]) -> None:
    path = table(SENSORS.encode())
    assert main(["init", "--from", str(path), "job"]) == 0
    assert main(["check", "job/job.yaml"]) == 0, capsys.readouterr().err


def test_what_sensors_read_over_time_is_told(table: Any, capsys: pytest.CaptureFixture[str]) -> None:
    table(SENSORS.encode())
    assert main(["look", "from shop/x-axis.csv"]) == 0
    printed = " ".join(capsys.readouterr().out.split())
    assert "Z: 25 readings over 24 h; 0 to 24 µm; with air_temperature" in printed
    assert "How far are X1 and X2 apart (mm)?" in printed
    assert "source: plugin: channels-csv file: x-axis.csv tests: {X1: {}, X2: {}, Z: {}}" in printed


def test_sensors_whose_times_fall_are_told_by_their_reader(table: Any) -> None:
    fallen = SENSORS.replace("\n9,", "\n7.5,")
    with pytest.raises(InputError, match="the time is before that of the reading of channel 'X1'"):
        look_at(table(fallen.encode()), REGISTRY)


PLATE = (ROOT / "configs" / "flatness" / "plate.csv").read_bytes()


def test_a_file_of_a_plate_becomes_a_test_of_each_line(table: Any) -> None:
    looked = look_at(table(PLATE), REGISTRY)
    assert looked.source.identifier == "plate-csv"
    assert len(looked.read.tests) == len(looked.proposal.tests) == 8
    assert looked.standard == "union-jack"


def test_a_job_on_a_plate_that_is_written_runs(table: Any, capsys: pytest.CaptureFixture[str]) -> None:
    path = table(PLATE)
    assert main(["init", "--from", str(path), "job"]) == 0
    assert main(["check", "job/job.yaml"]) == 0, capsys.readouterr().err


def test_a_plate_without_a_station_is_told_by_its_reader(table: Any) -> None:
    left = b"\n".join(row for row in PLATE.splitlines() if not row.startswith(b"NW-SE,2,"))
    with pytest.raises(InputError, match="station 2 of the line is left out"):
        look_at(table(left), REGISTRY)


def test_whose_a_temperature_is_that_does_not_say_so_is_asked(table: Any) -> None:
    rows = b"Soll;Richtung;Lauf;Abweichung;Temperatur\n0;+;1;0,1;20,1\n9;+;1;0,3;20,2\n"
    found = look_at(table(rows), REGISTRY)
    (asked,) = (each for each in found.proposal.asks if "temperature" in each)
    assert asked.startswith("Whose temperature is Temperatur?")
    assert "material_temperature: Temperatur" in asked
    assert set(found.read.conditions) == {"Temperatur"}


def test_of_one_target_it_is_said_where_it_is(shop: Shop) -> None:
    shop.write("one.csv", "target,direction,run,deviation\n125.5,+,1,1\n125.5,-,1,2\n")
    assert "2 readings of 1 target at 125.5 mm; 1 run" in shop.run("look", "one.csv").output
