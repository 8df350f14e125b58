"""Twenty doubtful jobs, by several standards, of axes that move and turn, in every layout and language.

Each is refused or marked where it is read, and of none is anything printed that is not so.
"""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from document.certificate.documents import lines_of, text_of, without
from doubtful.doubtful_jobs import (
    ANGLES,
    GERMAN,
    REPORT,
    SHEET,
    SOUND,
    STANDARD,
    TARGETS,
    TURNING,
    Doubtful,
    by,
    changed,
    machine,
    make_test_of,
    one_direction_twice,
    readings,
    refusals,
    rising,
    with_outlier,
)


def stepped(deviations: np.ndarray) -> np.ndarray:
    """Return readings whose second run stands apart, as after a knock."""
    moved = deviations.copy()
    moved[..., 1] += 9
    return moved


def copied(deviations: np.ndarray) -> np.ndarray:
    """Return readings whose last run is the one before it."""
    moved = deviations.copy()
    moved[..., -1] = moved[..., -2]
    return moved


def with_a_digit_changed(deviations: np.ndarray) -> np.ndarray:
    """Return readings whose last run is the one before it but for a digit."""
    moved = copied(deviations)
    moved[5, 0, -1] += 0.03
    return moved


def moved_by_a_constant(deviations: np.ndarray) -> np.ndarray:
    moved = copied(deviations)
    moved[..., -1] += 1.7
    return moved


def one_direction_moved(deviations: np.ndarray) -> np.ndarray:
    """Return readings whose negative direction is the positive one, less a reversal."""
    moved = deviations.copy()
    moved[:, 1] = moved[:, 0] - 0.8
    return moved


def with_a_stray_target(deviations: np.ndarray) -> np.ndarray:
    moved = deviations.copy()
    moved[6] += 60
    return moved


JOBS: dict[str, Doubtful] = {
    "drift by VDI/DGQ 3441 on a sheet": Doubtful(
        changed(SHEET, GERMAN, by("vdi-dgq-3441", P=25)), "Mittelwerte der Durchläufe steigen von", rising
    ),
    "drift of two runs by NMTBA": Doubtful(
        changed(REPORT, by("nmtba", P=25)), "Run means lie between", stepped, runs=2
    ),
    "a run that stands apart": Doubtful(
        changed(STANDARD, by("iso230-2:2006", A=25)),
        "1 µm is stated of drift at rest: what exceeds it",
        stepped,
    ),
    "drift that is declared negligible": Doubtful(
        changed(
            GERMAN,
            ("uncertainty", without("environmental_variation", keys=SOUND["uncertainty"])),
            ("uncertainty.negligible.environmental_variation", "air-conditioned hall"),
        ),
        "Drift in Ruhe ist als vernachlässigbar erklärt: dies ist der Achse zugerechnet und nicht in U",
        rising,
    ),
    "an outlier by ISO 230-2:1988": Doubtful(
        changed(SHEET, by("iso230-2:1988", A=200)), "The reading of run 2 at 398.3 mm ↓ lies", with_outlier
    ),
    "an outlier of an axis that turns": Doubtful(
        changed(GERMAN, STANDARD, by("iso230-2:2014", A=200), of=TURNING),
        "Der Messwert von Durchlauf 2 bei 127° ↓ liegt",
        with_outlier,
        ANGLES,
    ),
    "a run that was copied": Doubtful(
        changed(GERMAN, SHEET, by("vdi-vde-2617", P=20)),
        "Die Durchläufe 4, 5 sind in jeder Stelle gleich",
        copied,
    ),
    "a run that was copied and touched up": Doubtful(
        SOUND, "Runs 4, 5 differ by a constant only, but for single digits", with_a_digit_changed
    ),
    "a run that was copied and moved": Doubtful(
        changed(GERMAN, SHEET, by("vdi-dgq-3441", P=25)),
        "Die Durchläufe 4, 5 unterscheiden sich bis auf einzelne Stellen nur um eine Konstante",
        moved_by_a_constant,
    ),
    "a direction that was copied and moved": Doubtful(
        changed(GERMAN, STANDARD),
        "in Durchläufen 1, 2, 3, 4, 5, und streuen sonst: Kopien",
        one_direction_moved,
    ),
    "a target that is off in every run": Doubtful(
        changed(by("iso230-2:2014", A=200)), "The target at 601.4 mm lies", with_a_stray_target
    ),
    "a target of an axis that turns, off in every run": Doubtful(
        changed(GERMAN, SHEET, by("iso230-2:2014", A=200), of=TURNING),
        "Die Sollposition 180° liegt in jedem Durchlauf",
        with_a_stray_target,
        ANGLES,
    ),
    "an interferometer of which nobody says in which air it counted": Doubtful(
        changed(REPORT, ("instrument", without("compensation", keys=SOUND["instrument"]))),
        "U incomplete: Air temperature; Air pressure; Relative humidity not considered",
    ),
    "an interferometer whose compensation is a dash": Doubtful(
        changed(REPORT, GERMAN, ("instrument.compensation", "-")),
        "U unvollständig: Lufttemperatur; Luftdruck; Relative Luftfeuchte nicht berücksichtigt",
    ),
    "a direction that was copied": Doubtful(
        changed(by("iso230-2:1997", B=1)), "Both directions are identical in every digit", one_direction_twice
    ),
    "a straightness whose single run was copied to the other direction": Doubtful(
        changed(REPORT, GERMAN, ("measurement.error", "EYX"), by("iso230-1:2012", EYX=5)),
        "Beide Richtungen sind in jeder Stelle gleich, in Durchlauf 1",
        one_direction_twice,
        runs=1,
    ),
    "a straightness in millimetres": Doubtful(
        changed(REPORT, ("measurement.error", "EYX"), by("iso230-1:2012", EYX=5)),
        "if the file has mm",
        lambda deviations: deviations / 1e3,
    ),
    "degrees read as seconds of arc": Doubtful(
        changed(GERMAN, SHEET, by("vdi-dgq-3441", P=12), of=TURNING),
        "gehört measurement.source.units: {deviation: deg} in den Auftrag",
        lambda deviations: deviations / 3600,
        ANGLES,
    ),
    "a turning axis taken for a straight one": Doubtful(
        changed(REPORT, STANDARD, ("axis", {"name": "C", "travel": [0, 360]})),
        "Axis C is taken for a linear one",
        targets=ANGLES,
    ),
    "an expansion coefficient of 115": Doubtful(
        changed(GERMAN, SHEET, ("environment.expansion_coefficient", 115)),
        "115 µm/(m·K) ist ungewöhnlich",
    ),
    "a correction by 0.0115 mm/(m·K)": Doubtful(
        changed(
            ("corrections", {"material": {"temperature": "axis_temperature"}}),
            ("environment.expansion_coefficient", 0.0115),
            ("environment.axis_temperature", 21.5),
            ("uncertainty.resolution", 0.01),
        ),
        "0.0115 mm/(m·K) would be 11.5 µm/(m·K)",
    ),
    "an instrument without a date": Doubtful(
        changed(GERMAN, SHEET, ("instrument", without("calibrated", keys=SOUND["instrument"]))),
        "Messgerät: Datum der Kalibrierung nicht angegeben",
    ),
    "a report by an instrument that was overdue": Doubtful(
        changed(REPORT, GERMAN, SHEET, ("instrument.due", "2026-10-01")),
        "Messgerät: Kalibrierung war am 2026-10-01 fällig, vor der Messung vom 2026-11-18",
    ),
    "a report by a thermometer without a certificate": Doubtful(
        changed(REPORT, STANDARD, ("environment.thermometers", [{"name": "T 1", "certificate": "none"}])),
        "T 1: no calibration certificate named",
    ),
    "a turning axis beside the scope": Doubtful(
        changed(
            ("laboratory.cmc", {"constant": 0.3, "kind": "linear"}), by("iso230-2:2014", A=9), of=TURNING
        ),
        "Outside the accredited scope: results of a rotary axis",
        targets=ANGLES,
    ),
    "a turning axis beside a scope of lengths": Doubtful(
        changed(
            ("laboratory.cmc", {"constant": 0.3, "per_metre": 0.5}), by("iso230-2:2014", A=9), of=TURNING
        ),
        "Outside the accredited scope: results of a rotary axis",
        targets=ANGLES,
    ),
    "five runs over 2.5 m": Doubtful(
        changed(REPORT, GERMAN, SHEET, ("axis.travel", [0, 2500]), by("iso230-2:2006", A=20)),
        "über ihre Grenzwerte wird nicht entschieden",
        targets=2.5 * TARGETS,
    ),
    "one run and a limit of R": Doubtful(
        changed(REPORT, GERMAN, STANDARD, by("iso230-2:2014", R=5)),
        "R ist durch diese Messung nicht bestimmt; über den Grenzwert wird nicht entschieden",
        runs=1,
        said_in=text_of,
    ),
}


test_a_doubtful_job_is_marked_and_prints_nothing_that_is_not_so = make_test_of(JOBS)


def test_silence_on_the_air_refuses_a_certificate_and_a_word_is_enough(tmp_path: Path) -> None:
    silent = changed(("instrument", without("compensation", keys=SOUND["instrument"])))

    assert "instrument.compensates: {air: true} is enough" in refusals(tmp_path, silent)
    assert not refusals(tmp_path, changed(("instrument.compensates", {"air": True}), of=silent))


# A whole machine.


@pytest.mark.parametrize("layout", ["full", "standard", "sheet"])
@pytest.mark.parametrize("language", ["en", "de"])
def test_the_first_page_of_a_machine_has_what_any_of_its_axes_shows(
    language: str, layout: str, tmp_path: Path
) -> None:
    parts = {
        "X": (SOUND, readings()),
        "Y": (SOUND, rising(readings())),
        "Z": (changed(("instrument.due", "2026-10-01")), readings(seed=2)),
    }
    document = machine(tmp_path, parts, language=language, layout=layout)
    first = "\n".join(line for each in document.cover for line in lines_of(each))

    for en, de in (
        (
            "Y: What readings, dates and calibrations show",
            "Y: Was Messwerte, Termine und Kalibrierungen zeigen",
        ),
        ("Run means rise from", "Mittelwerte der Durchläufe steigen"),
        ("calibration was due on 2026-10-01", "Kalibrierung war am 2026-10-01 fällig"),
    ):
        assert (de if language == "de" else en) in first
    of_z = [each for of in document.sections if of.key.startswith("EZZ-") for each in of.blocks]
    said = "\n".join([first, *(line for each in of_z for line in lines_of(each))])
    assert not re.search("metrologically traceable|metrologisch rückführbar", said)
    assert not re.search("tem calibrated|Kalibriergegenstand|^Kalibrierung$", text_of(document), re.MULTILINE)


# Refused, whatever the layout.


@pytest.mark.parametrize(
    ("keys", "said"),
    [
        (
            changed(SHEET, GERMAN, ("instrument.calibrated", "2027-01-07")),
            "after the measurement of 2026-11-18",
        ),
        (
            changed(STANDARD, ("instrument.certificate", "liegt noch nicht vor")),
            "no calibration certificate named",
        ),
        (changed(("environment.axis_temperature", 24), by("vdi-dgq-3441", P=20)), "corrections: {material:"),
        (changed(GERMAN, ("uncertainty.environmental_variation", 0)), "0 states nothing"),
    ],
)
def test_a_certificate_that_its_own_words_refute_is_refused(keys: Any, said: str, tmp_path: Path) -> None:
    assert said in refusals(tmp_path, keys)
