"""What no single key shows to be wrong: days out of order, numbers alike, agreements that are missing."""

from __future__ import annotations

from pathlib import Path

import pytest

from job.jobs import mistakes, with_line, with_lines

MEASURED = "2026-11-18"  # in the sound job
AS_FOUND = "as_found: {measurement: {%s, source: {plugin: exemplary-text, file: six.txt}}}"


def the_mistake(text: str, folder: Path) -> str:
    (found,) = mistakes(text, folder)
    return found.partition(": ")[2]


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (
            "dates: {received: 2026-11-19}",
            "dates.received: 2026-11-19 lies after the measurement of 2026-11-18",
        ),
        (
            "instrument: {name: Laser, calibrated: 2026-03-02, due: 2025-03-02}",
            "instrument.due: 2025-03-02 does not lie after the calibration of 2026-03-02",
        ),
        (
            "environment: {thermometers: [{name: T, calibrated: 2026-03-02, due: 2026-03-02}]}",
            "environment.thermometers.due: 2026-03-02 does not lie after the calibration of 2026-03-02",
        ),
        (
            "dates: {sampled: 2026-11-19}",
            "dates.sampled: 2026-11-19 lies after the measurement of 2026-11-18",
        ),
        (
            "next_due: {date: 2026-11-18, agreed: true}",
            "next_due.date: 2026-11-18 does not lie after the measurement of 2026-11-18",
        ),
        (
            AS_FOUND % "date: 2026-11-19",
            "as_found.measurement.date: 2026-11-19 lies after the measurement as left of 2026-11-18",
        ),
        (
            AS_FOUND % "date: 2026-11-17, end: 2026-11-19",
            "as_found.measurement.date: 2026-11-19 lies after the measurement as left of 2026-11-18",
        ),
        (
            AS_FOUND % "date: 2026-11-17, end: 2026-11-16",
            "as_found.measurement.end: 2026-11-16 lies before the first day, 2026-11-17",
        ),
        (
            AS_FOUND % "end: 2026-11-16",
            "as_found.measurement.end: the first day is missing; add as_found.measurement.date",
        ),
    ],
)
def test_days_follow_each_other(line: str, message: str, tmp_path: Path) -> None:
    assert the_mistake(with_lines(line), tmp_path) == message


@pytest.mark.parametrize(
    "line",
    [
        "dates: {received: 2026-11-18, sampled: 2026-11-18}",
        "next_due: {date: 2026-11-19, agreed: true}",
        AS_FOUND % "date: 2026-11-18",
        AS_FOUND % "date: 2026-11-17, end: 2026-11-18",
    ],
)
def test_days_that_follow_each_other_are_sound(line: str, tmp_path: Path) -> None:
    assert mistakes(with_lines(line), tmp_path) == []


def test_an_item_is_received_before_the_first_of_two_measurements(tmp_path: Path) -> None:
    text = with_lines(AS_FOUND % "date: 2026-11-16", "dates: {received: 2026-11-17}")
    assert the_mistake(text, tmp_path).endswith("2026-11-17 lies after the measurement of 2026-11-16")


def test_the_last_day_of_a_measurement_does_not_lie_before_its_first(tmp_path: Path) -> None:
    text = with_line(9, f"  date: {MEASURED}\n  end: 2026-11-17")
    assert the_mistake(text, tmp_path).startswith("measurement.end: 2026-11-17 lies before the first day")


def test_a_document_is_not_issued_before_the_last_day_of_its_measurement(tmp_path: Path) -> None:
    text = with_line(4, "  kind: report\n  issued: 2026-11-18").replace(
        f"date: {MEASURED}", f"date: {MEASURED}\n  end: 2026-11-19"
    )
    assert the_mistake(text, tmp_path).endswith("2026-11-18 lies before the measurement of 2026-11-19")


@pytest.mark.parametrize("number", ["CAL-1", "cal-1"])
def test_a_changed_document_has_a_number_of_its_own(number: str, tmp_path: Path) -> None:
    text = with_line(4, f"  kind: report\n  amends: {{number: {number}, reason: wrong serial}}")
    assert the_mistake(text, tmp_path) == (
        "certificate.number: CAL-1 is the number of the document that this one amends; a changed document "
        "has a number of its own, such as CAL-1-1"
    )


def test_a_changed_document_states_the_reason(tmp_path: Path) -> None:
    text = with_line(4, "  kind: report\n  amends: {number: CAL-0}")
    assert the_mistake(text, tmp_path).startswith("certificate.amends.reason is missing: why it is changed")


@pytest.mark.parametrize("agreed", ["", ", agreed: false"])
def test_the_next_calibration_is_named_only_by_agreement(agreed: str, tmp_path: Path) -> None:
    message = the_mistake(with_lines(f"next_due: {{date: 2027-11-18{agreed}}}"), tmp_path)
    assert message.startswith("next_due.agreed: ")
    assert "7.8.4.3" in message


def test_an_opinion_has_a_person_who_states_it(tmp_path: Path) -> None:
    message = the_mistake(with_lines("opinions: [{statement: play, basis: reversal}]"), tmp_path)
    assert "7.8.7.1" in message
    assert message.endswith("add by, or certificate.authorised_by")


def test_the_person_who_authorises_the_document_states_its_opinions(tmp_path: Path) -> None:
    text = with_line(4, "  kind: report\n  authorised_by: {name: A. Person}")
    assert mistakes(f"{text}opinions: [{{statement: play, basis: reversal}}]\n", tmp_path) == []


@pytest.mark.parametrize("kind", ["other", "laboratory branch", "customer branch"])
def test_a_place_that_nothing_else_states_has_an_address(kind: str, tmp_path: Path) -> None:
    message = the_mistake(with_lines(f"location: {{kind: {kind}}}"), tmp_path)
    assert message == f"location: a location of kind {kind} needs an address"


@pytest.mark.parametrize("location", ["Hall 3", "{kind: laboratory}", "{kind: other, address: Hall 3}"])
def test_a_place_is_a_text_or_a_kind_of_place(location: str, tmp_path: Path) -> None:
    assert mistakes(with_lines(f"location: {location}"), tmp_path) == []


def test_a_kind_of_place_that_is_unknown_is_answered_with_the_nearest(tmp_path: Path) -> None:
    message = the_mistake(with_lines("location: {kind: custmer}"), tmp_path)
    assert message.startswith("location.kind: 'custmer' is unknown; did you mean 'customer'?")


def test_the_source_of_the_readings_as_found_is_held_against_its_plugin(tmp_path: Path) -> None:
    line = "as_found: {measurement: {source: {plugin: exemplary-text, fil: six.txt}}}"
    found = mistakes(with_lines(line), tmp_path)
    assert any("unknown key 'fil' in as_found.measurement.source" in each for each in found)
