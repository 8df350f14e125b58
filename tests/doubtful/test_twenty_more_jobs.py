"""Twenty more doubtful jobs: statements that contradict each other, days, clocks, runs the wrong way round.

Each is refused or marked where it is read, and of none is anything printed that is not so.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from document.certificate import documents
from document.certificate.documents import text_of, without
from doubtful.doubtful_jobs import (
    ANGLES,
    GERMAN,
    REPORT,
    SHEET,
    SOUND,
    STANDARD,
    TURNING,
    Doubtful,
    by,
    changed,
    composed,
    cover,
    first_page,
    make_test_of,
    order,
    parameter,
    readings,
    refusals,
    write,
)
from installed import load_job
from zlmreport import pipeline
from zlmreport.evaluation import traceability
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS
from zlmreport.plugin import InputError, Language
from zlmreport.plugin.renderer import Certificate

_COUNT = len(order())
_EVEN = [20.0 * number for number in range(_COUNT)]


def interchanged(deviations: np.ndarray) -> np.ndarray:
    """Return readings of whose third run somebody has taken + for −."""
    turned = deviations.copy()
    turned[..., 2] = deviations[:, ::-1, 2]
    return turned


def opened(deviations: np.ndarray) -> np.ndarray:
    """Return readings whose fourth run comes back 6 lower."""
    moved = deviations.copy()
    moved[:, 1, 3] -= 6
    return moved


def mirrored(deviations: np.ndarray) -> np.ndarray:
    """Return readings of whose second run the sign is turned."""
    turned = deviations.copy()
    turned[..., 1] *= -1
    return turned


_PAUSING = [each + (9 * 3600 if number >= 44 else 0) for number, each in enumerate(_EVEN)]
_AIR = {"air": {"assumed": "standard air"}}
JOBS: dict[str, Doubtful] = {
    "a certificate of four years later": Doubtful(
        changed(("certificate.issued", "2030-11-20")),
        "Issued on 2030-11-20, 4 years after the measurement of 2026-11-18",
    ),
    "one of a year and a day later, in German, on a sheet": Doubtful(
        changed(GERMAN, SHEET, ("certificate.issued", "2027-11-19")),
        "Ausgestellt am 2027-11-19, 1 Jahr nach der Messung vom 2026-11-18",
    ),
    "a measurement of more than a month": Doubtful(
        changed(("measurement.date", "2026-10-17"), ("measurement.end", "2026-11-18")),
        "The measurement took from 2026-10-17 to 2026-11-18: 33 days",
    ),
    "a report without a day": Doubtful(
        changed(REPORT, of=without("measurement.date", keys=SOUND)),
        "whether the calibrations were valid then cannot be told",
    ),
    "two thermometers that disagree": Doubtful(
        changed(("environment.material_temperature", 21.1)),
        "Material temperature: 21.1 °C: the expansion is reckoned with 20 °C",
    ),
    "a workpiece of 30 °C in an air of 20 °C": Doubtful(
        changed(("environment.material_temperature", 30)), "Air temperature: 20.1 °C: they lie 9.9 K apart"
    ),
    "an air of 35 °C about a machine of 20 °C": Doubtful(
        changed(GERMAN, STANDARD, ("environment.air_temperature", 35)),
        "Lufttemperatur: 35 °C: sie liegen 15 K auseinander",
    ),
    "the coefficient of another material": Doubtful(
        changed(
            ("corrections", {"material": {"temperature": "axis_temperature", "expansion_coefficient": 23.8}}),
            ("environment.axis_temperature", 21),
            ("uncertainty.resolution", 0.01),
        ),
        "Corrected with 23.8 µm/(m·K), and 11.5 µm/(m·K) is stated",
    ),
    "a certificate number used twice": Doubtful(
        changed(
            ("environment.thermometers", [{"name": "T 1", "certificate": "c-1", "calibrated": "2026-02-01"}])
        ),
        "Calibration certificate C-1: two dates are stated for it, 2026-03-02 and 2026-02-01",
    ),
    "a report that is its own reference": Doubtful(
        changed(REPORT, SHEET, ("instrument.certificate", "cal-1")),
        "Measuring instrument: the calibration certificate named, CAL-1, is this document",
    ),
    "a night between two runs": Doubtful(
        changed(by("iso230-2:1997", A=20)),
        "Before a reading of run 3 none was taken for 9 h",
        logged={"time": _PAUSING},
    ),
    "a clock that stood": Doubtful(
        changed(STANDARD),
        "All readings are said to have been taken at the same time",
        logged={"time": [5.0] * _COUNT},
    ),
    "an axis faster than its feed": Doubtful(
        changed(GERMAN, ("measurement.feed", 1000)),
        "fuhr die Achse mit 5900 mm/min, und als Vorschub sind 1000 mm/min angegeben",
        logged={"time": [each / 2000 for each in _EVEN]},
    ),
    "an axis that turns faster than its feed": Doubtful(
        changed(("measurement.feed", 60), of=TURNING),
        "°/min, and its feed is stated as 60 °/min",
        logged={"time": [each / 2000 for each in _EVEN]},
        targets=ANGLES,
    ),
    "a barometer that falls": Doubtful(
        changed(SHEET),
        "Air pressure: 560 hPa was logged at a reading, which is unusual",
        logged={"air_pressure": [1013.0] * (_COUNT - 3) + [560.0] * 3},
    ),
    "a run with its directions interchanged": Doubtful(
        SOUND, "in the others: its directions seem to be interchanged", interchanged
    ),
    "the same of an axis that turns, by VDI/VDE 2617": Doubtful(
        changed(GERMAN, by("vdi-vde-2617", P=12), of=TURNING),
        "seine Richtungen scheinen vertauscht",
        interchanged,
        targets=ANGLES,
    ),
    "a reversal in one run only": Doubtful(
        changed(by("nmtba", P=40)),
        "The reversal of run 4 is 6.82 µm in the mean, and 0.899 µm in the others",
        opened,
    ),
    "a run with its sign turned": Doubtful(
        changed(SHEET), "Run 2 mirrors the others: the sign of its deviations seems to be turned", mirrored
    ),
    "a reading that nobody says why it was set aside": Doubtful(
        changed(
            (
                "measurement.excluded",
                [{"target": 3.1, "direction": "+", "run": 1, "reason": "n/a"}],
            )
        ),
        "The reading of run 1 at 3.1 mm ↑ is set aside without a reason: “n/a”",
    ),
}


test_a_doubtful_job_is_marked_and_prints_nothing_that_is_not_so = make_test_of(JOBS)


def test_each_certificate_of_two_dates_is_told_once(tmp_path: Path) -> None:
    days = ("2026-02-01", "2026-02-02", "2026-02-03")
    sensors = [{"name": f"T {day}", "certificate": "T-1", "calibrated": day} for day in days]

    document = composed(tmp_path, changed(("environment.thermometers", sensors)))

    assert text_of(document).count("two dates are stated for it") == 1


def _adjusted(folder: Path, before: np.ndarray) -> Certificate:
    """Return the certificate of an axis that was adjusted between two measurements."""
    write(folder, before, file="before.csv")
    source = {"plugin": "laser-csv", "file": "before.csv"}
    as_found = {"adjustment": "Pitch errors", "measurement": {"date": "2026-11-17", "source": source}}
    return composed(folder, changed(("as_found", as_found)))


def test_readings_before_an_adjustment_that_are_those_after_it_are_marked(tmp_path: Path) -> None:
    said = "as found, before the adjustment: The readings are in every digit those of the measurement as left"

    assert said in cover(_adjusted(tmp_path, readings()))
    assert said not in cover(_adjusted(tmp_path, readings(seed=2)))


def test_a_certificate_that_names_itself_as_its_reference_is_refused(tmp_path: Path) -> None:
    assert "is this document" in refusals(tmp_path, changed(("instrument.certificate", "CAL-1")))


@pytest.mark.parametrize("layout", ["full", "sheet"])
def test_an_instrument_as_coarse_as_the_axis_is_said_to_have_raised_u(layout: str, tmp_path: Path) -> None:
    """U of the instrument is 1 µm, and E 2.8 µm: the axis may be much flatter than it was read."""
    coarse = changed(("instrument.expanded_uncertainty", 1), ("certificate.layout", layout))

    document = composed(tmp_path, coarse, trials=TRIALS)

    e = parameter(document, "E")
    assert "raised to reach the flattest axis that the readings leave possible" in text_of(document)
    assert e.raised_to.value == "flatter-axis"
    assert (e.coverage_factor or 0.0) > 2.0


def test_an_undated_report_claims_no_traceability(tmp_path: Path) -> None:
    undated = changed(REPORT, of=without("measurement.date", keys=SOUND))

    assert "metrologically traceable" not in text_of(composed(tmp_path, undated))


@pytest.mark.parametrize(
    ("name", "value"), [("air_pressure", 0.0), ("air_temperature", -273.15), ("relative_humidity", 140.0)]
)
def test_air_that_is_nowhere_is_refused_at_its_reading(name: str, value: float, tmp_path: Path) -> None:
    usual = {"air_pressure": 1013.0, "air_temperature": 20.0, "relative_humidity": 50.0}[name]
    write(tmp_path, readings(), {name: [usual] * (_COUNT - 3) + [value] * 3})

    with pytest.raises(InputError, match=rf"(?s):\d+:\d+: {name} is not between .*was a sensor silent"):
        documents.certificate(tmp_path, SOUND)


def test_a_square_without_a_calibration_certificate_is_marked(tmp_path: Path) -> None:
    shutil.copytree(documents.ROOT / "configs", tmp_path / "configs")
    path = tmp_path / "configs/machine/xy-squareness.yaml"
    said = (
        "What was measured against (square): no calibration certificate named, so not shown to be traceable"
    )
    assert said not in _doubts_of(path)

    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace(", certificate: EXAMPLE-CAL-9}", "}"), encoding="utf-8")

    assert said in _doubts_of(path)


def _doubts_of(path: Path) -> list[str]:
    job = load_job(path)
    found = traceability.find_doubts(job, pipeline.read(job, documents.registry()))
    return [each.in_language(Language.ENGLISH) for each in found]


@pytest.mark.parametrize(
    ("count", "said"),
    [
        (4, "One more reading lies as far from the others of its target"),
        (6, "3 more readings lie as far from the others of their targets"),
    ],
)
def test_readings_beyond_those_that_are_named_are_counted(count: int, said: str, tmp_path: Path) -> None:
    spoilt = readings()
    for number in range(count):
        spoilt[2 * number, number % 2, number % 5] += 60.0
    assert said in first_page(composed(tmp_path, SOUND, spoilt))


# What is sound is not marked.


def test_a_correction_by_the_coefficient_that_is_stated_is_not_marked(tmp_path: Path) -> None:
    stated = changed(
        ("corrections", {"material": {"temperature": "axis_temperature", "expansion_coefficient": 11.5}}),
        ("environment.axis_temperature", 21),
        ("uncertainty.resolution", 0.01),
    )
    assert "is stated as the expansion coefficient" not in text_of(composed(tmp_path, stated))


@pytest.mark.parametrize(
    "change",
    [
        ("certificate.issued", "2027-11-18"),
        ("environment.material_temperature", 21),
        ("environment.material_temperature", 19),
        ("environment.material_temperature", "not measured"),
        ("environment.air_temperature", 24),
        ("measurement", {**SOUND["measurement"], "date": "2026-10-18", "end": "2026-11-18"}),
        ("environment.thermometers", [{"name": "T 1", "certificate": "C-1", "calibrated": "2026-03-02"}]),
        ("measurement.feed", 1000),
    ],
)
def test_what_may_well_be_so_is_not_marked(change: tuple[str, Any], tmp_path: Path) -> None:
    write(tmp_path, readings(), {"time": _EVEN})

    document = documents.certificate(tmp_path, changed(change))

    assert document.doubts == document.evidence == ()
