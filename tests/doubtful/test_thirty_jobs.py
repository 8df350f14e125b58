"""Thirty more doubtful jobs: limits that contradict, logs with gaps, copies, words that say nothing.

Each is refused, marked where it is read, or right, and of none is anything printed that is not so.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from document.certificate import documents
from document.certificate.documents import text_of, without
from doubtful.doubtful_jobs import (
    GERMAN,
    REPORT,
    SHEET,
    SOUND,
    STANDARD,
    Doubtful,
    by,
    changed,
    composed,
    first_page,
    machine,
    make_test_of,
    order,
    parameter,
    readings,
    refusals,
    write,
)
from zlmreport.plugin import Language

FRENCH = ("certificate.language", "fr")
_COUNT = len(order())


def in_reverse_order(_: np.ndarray) -> np.ndarray:
    """Return readings of an axis that is 60 µm too long, those of its way back in the wrong order."""
    turned = readings(slope=60)
    turned[:, 1] = turned[::-1, 1].copy()
    return turned


def with_one_sign_turned(_: np.ndarray) -> np.ndarray:
    turned = readings(slope=-40)
    turned[:, 1] *= -1
    return turned


_LOGGED_ONLY = without("environment.axis_temperature", keys=SOUND)
_STEADY = [20.0] * _COUNT
JOBS: dict[str, Doubtful] = {
    "limits of A and E exchanged": Doubtful(
        changed(by("iso230-2:2014", A=5, E=8)),
        "ISO 230-2:2014: the limit of E, 8 µm, is above that of A, 5 µm, and A is never smaller than E",
    ),
    "a limit of R↑ above that of A, two steps away, in German": Doubtful(
        changed(GERMAN, by("iso230-2:2006", A=6, R_fwd=7)),
        "der Grenzwert von R↑, 7 µm, liegt über dem von A, 6 µm",
    ),
    "limits of NMTBA exchanged, with a guard band": Doubtful(
        changed(SHEET, by("nmtba", P=12, Pa=15), ("decision_rule", "guard-band")),
        "the limit of Pa, 15 µm, is above that of P, 12 µm",
    ),
    "limits of VDI/DGQ 3441 exchanged, in French": Doubtful(
        changed(FRENCH, STANDARD, by("vdi-dgq-3441", Ps_max=4, Ps_mean=9)), "Ps mit"
    ),
    "a display that stood at zero": Doubtful(
        SOUND,
        "All readings are equal: the sensor, or its display, may have stood still",
        lambda deviations: np.round(deviations / 100),
    ),
    "a way back in the wrong order": Doubtful(
        changed(by("iso230-2:2014", A=200)),
        "The two directions run counter to each other along the axis",
        in_reverse_order,
    ),
    "signs of one direction turned, on a French sheet": Doubtful(
        changed(FRENCH, SHEET, by("vdi-vde-2617", P=200)), "à l’opposé l’un de l’autre", with_one_sign_turned
    ),
    "two sensors that were logged 5 K apart": Doubtful(
        _LOGGED_ONLY,
        "Material temperature: 25 °C: the expansion is reckoned with 20 °C",
        logged={"axis_temperature": _STEADY, "material_temperature": [25.0] * _COUNT},
    ),
    "a workpiece that was logged warmer than the scale is stated": Doubtful(
        changed(GERMAN, SHEET),
        "Materialtemperatur: 22 °C: die Ausdehnung ist mit 20 °C gerechnet",
        logged={"material_temperature": [22.0] * _COUNT},
    ),
    "a logger with a gap": Doubtful(
        _LOGGED_ONLY,
        "between two readings at which it was logged lie 30 at which it was not",
        logged={"axis_temperature": [20.0] * 40 + [None] * 30 + [20.0] * 40},
    ),
    "a log that ends before the test": Doubtful(
        changed(GERMAN, of=_LOGGED_ONLY),
        "Temperatur des Maschinenmaßstabs: bei den letzten 70 Messwerten nicht aufgezeichnet",
        logged={"axis_temperature": [20.0] * 40 + [None] * 70},
    ),
    "a log that begins after the test": Doubtful(
        changed(SHEET),
        "Air temperature: not logged at the first 60 readings",
        logged={"air_temperature": [None] * 60 + [20.0] * 50},
    ),
    "a dwell longer than the time between two readings": Doubtful(
        changed(STANDARD, ("measurement.dwell", 60)),
        "Readings follow each other after 20 s as a rule, and a dwell of 60 s at each target is stated",
        logged={"time": [20.0 * number for number in range(_COUNT)]},
    ),
    "a test of two days that is dated one": Doubtful(
        SOUND,
        "The readings go over 47.8 h, and the measurement is dated 2026-11-18 only",
        logged={"time": [1580.0 * number for number in range(_COUNT)]},
    ),
    "a unidirectional method with two directions": Doubtful(
        changed(GERMAN, ("measurement.method", "unidirectional")), "Ein einseitiges Verfahren ist angegeben"
    ),
    "the serial number of the machine on the instrument": Doubtful(
        changed(FRENCH, SHEET, ("instrument.serial", "s-1")), "le même numéro de série, S-1"
    ),
    "an uncertainty in millimetres": Doubtful(
        changed(SHEET, ("instrument.expanded_uncertainty", 0.001)),
        "Expanded uncertainty of the instrument: 0.001 µm, and its readings were given in steps of 1 µm",
        np.round,
    ),
    "a misalignment in micrometres": Doubtful(
        changed(GERMAN, ("uncertainty.misalignment", 300)), "300 mm ist ungewöhnlich"
    ),
    "a range of the coefficient in 1/K": Doubtful(
        changed(("uncertainty.expansion_coefficient", 1e-6)),
        "Expansion coefficient, machine: 0.000001 µm/(m·K) is unusual",
    ),
}


test_a_doubtful_job_is_marked_and_prints_nothing_that_is_not_so = make_test_of(JOBS)


# What is sound is not marked.


@pytest.mark.parametrize(
    "logged",
    [
        {"axis_temperature": [20.0 if number % 22 == 0 else None for number in range(_COUNT)]},
        {"axis_temperature": [20.0] * 50 + [None] * 3 + [20.0] * 57},
        {"axis_temperature": _STEADY, "material_temperature": [20.6] * _COUNT},
        {"axis_temperature": _STEADY, "air_temperature": [20.0] * 80 + [26.0] * 30},
    ],
)
def test_a_log_as_logs_are_is_not_marked(logged: Any, tmp_path: Path) -> None:
    write(tmp_path, readings(), logged)

    document = documents.certificate(tmp_path, _LOGGED_ONLY)

    assert document.doubts == document.evidence == ()


@pytest.mark.parametrize(
    "limits", [{"A": 10, "E": 8, "R": 7, "B": 5, "M": 8}, {"A": 8, "E": 8}, {"M": 9, "R": 5}]
)
def test_limits_in_their_order_are_not_marked(limits: dict[str, float], tmp_path: Path) -> None:
    assert composed(tmp_path, changed(by("iso230-2:2014", **limits))).evidence == ()


# Right, and no longer otherwise.


def test_readings_in_steps_of_10_micrometres_have_them_in_their_uncertainty(tmp_path: Path) -> None:
    coarse = np.round(10 * readings(), -1)
    document = composed(tmp_path, changed(by("iso230-2:2014", A=60)), coarse)

    of_steps = {each.contributor: each.standard_uncertainty for each in document.budget.contributions}
    assert of_steps["resolution"] == pytest.approx(10e-6 / np.sqrt(12))
    assert "steps of the readings, coarser than their last digit" in text_of(document)
    assert (parameter(document, "R").expanded_uncertainty or 0.0) > 5e-6


@pytest.mark.parametrize(
    ("standard", "said", "unsaid"),
    [
        ("vdi-dgq-3441", "6 times its standard deviation", "P averages the scatter of both directions"),
        ("vdi-vde-2617", "4 times its standard deviation", "The reversal span is an amount"),
        (
            "nmtba",
            "six times their standard deviation (z − 1)",
            "readings of both directions form one sample",
        ),
    ],
)
def test_the_notes_on_a_test_in_one_direction_are_on_one(
    standard: str, said: str, unsaid: str, tmp_path: Path
) -> None:
    write(tmp_path, readings())
    lines = (tmp_path / "x.csv").read_text(encoding="utf-8").splitlines()
    one_way = [line for line in lines if ",-," not in line]
    (tmp_path / "x.csv").write_text("\n".join(one_way) + "\n", encoding="utf-8")

    text = text_of(documents.certificate(tmp_path, changed(by(standard, P=20))))

    assert said in text
    assert unsaid not in text


def test_two_axes_with_the_readings_of_one_are_marked(tmp_path: Path) -> None:
    document = machine(tmp_path, {"X": (SOUND, readings()), "Y": (SOUND, readings())})

    said = "The readings of EXX and EYY are identical in every digit: one line may have been read twice"
    assert said in first_page(document)
    assert said in [each.in_language(document.language) for each in document.evidence]


def test_a_length_that_the_instrument_corrected_by_another_coefficient_is_not_said_to_hold_at_20_degrees(
    tmp_path: Path,
) -> None:
    """At 24 °C, by 23 and not by 11.5 µm/(m·K): 45.7 µm on 993 mm."""
    other = changed(
        ("instrument.compensates", {"material": 23, "air": True}), ("environment.axis_temperature", 24)
    )

    (finding,) = (
        each
        for each in composed(tmp_path, other).evaluations[0].findings
        if each.requirement.en.startswith("Results for 20")
    )

    assert finding.met is False
    assert "the machine has 11.5 µm/(m·K), and 45.7 µm are left" in finding.found.in_language(
        Language.ENGLISH
    )
    same = changed(("instrument.compensates.material", 11.5), of=other)
    assert "45.7 µm" not in text_of(composed(tmp_path, same))


# Refused at its line, with what would be right.


@pytest.mark.parametrize(
    ("key", "value", "said"),
    [
        ("customer.address", "n/a", "how to reach the customer"),
        ("customer.name", "-", "the customer's name"),
        ("laboratory.address", "---", "the laboratory's address"),
        ("machine.serial", "none", "an unambiguous identification of the machine"),
        ("machine.serial", "unbekannt", "an unambiguous identification of the machine"),
        ("certificate.authorised_by", {"name": "tbd"}, "the person who authorises the certificate"),
        ("location", "-", "location: '-' states nothing"),
        ("procedure", "T.B.D.", "procedure: 'T.B.D.' states nothing"),
        ("measurement.warm_up", "k. A.", "measurement.warm_up: 'k. A.' states nothing"),
        ("certificate.amends", {"number": "CAL-0", "reason": "-"}, "certificate.amends.reason: '-'"),
        ("opinions", [{"statement": "It holds.", "basis": "?"}], "opinions.0.basis: '?' states nothing"),
    ],
)
def test_a_dash_is_no_statement_on_a_certificate(key: str, value: object, said: str, tmp_path: Path) -> None:
    refused = refusals(tmp_path, changed((key, value)))

    assert said in refused
    assert "states nothing" in refused


_EXCLUDED = [{"target": 3.1, "direction": "-", "run": 1, "reason": "The hose touched the reflector."}]


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("measurement.warm_up", "none"),
        ("machine.serial", "7"),
        ("measurement.excluded", _EXCLUDED),
        ("measurement.source.units", {"deviation": "um"}),
    ],
)
def test_a_word_is_one(key: str, value: object, tmp_path: Path) -> None:
    assert not refusals(tmp_path, changed((key, value)))


def test_a_dash_is_no_statement_in_a_report_either(tmp_path: Path) -> None:
    stated = [{"standard": "iso230-2:2014", "tolerances": {"A": 10}, "specification": "-"}]
    keys = changed(REPORT, ("measurement.line", "-"), ("evaluate", stated))

    text = text_of(composed(tmp_path, keys))

    assert "not stated: measuring line" in text
    assert "their source is not stated" in text


@pytest.mark.parametrize(
    "title",
    [
        "Calibration Certificate",
        "Kalibrierschein der Achse X",
        "Certificat d’étalonnage",
        "Certificato di taratura",
    ],
)
def test_a_report_is_not_titled_a_certificate(title: str, tmp_path: Path) -> None:
    said = refusals(tmp_path, changed(REPORT, ("certificate.title", title)))

    assert "is the title of a calibration certificate, and this is a measuring report" in said
    assert not refusals(tmp_path, changed(("certificate.title", title)))


@pytest.mark.parametrize("key", ["axis_temperature", "material_temperature"])
def test_a_temperature_in_fahrenheit_is_not_answered_by_correcting(key: str, tmp_path: Path) -> None:
    stated = changed((f"environment.{key}", 68.0), of=_LOGGED_ONLY)

    assert "if °F is meant, it is 20 °C; state it so" in refusals(tmp_path, stated)
    assert "would be 20 °C" in first_page(composed(tmp_path, changed(REPORT, of=stated)))
