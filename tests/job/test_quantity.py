"""What a job says was measured, and what does not go with it."""

from __future__ import annotations

from pathlib import Path

import pytest

from job.jobs import SOUND, mistakes


def of(measurement: str) -> str:
    """Return the sound job with another measurement."""
    head, _, rest = SOUND.partition("measurement:\n")
    return f"{head}measurement: {measurement}\n{rest[rest.index('evaluate:') :]}"


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (
            "{error: EYX, source: {plugin: exemplary-text, file: six.txt}}",
            "this job is on straightness (measurement.error: EYX); no installed standard evaluates that",
        ),
        (
            "{error: EYY, source: {plugin: exemplary-text, file: six.txt}}",
            "EYY is an error of axis Y, and axis.name is 'X'; the last letter of the error names the axis",
        ),
        (
            "{error: EYQ, source: {plugin: exemplary-text, file: six.txt}}",
            "'EYQ' is no error of ISO 230-1 that is measured",
        ),
        ("{at: {Q: 3}, source: {plugin: exemplary-text, file: six.txt}}", "'Q' is no axis"),
        ("{at: {tool: 3}, source: {plugin: exemplary-text, file: six.txt}}", "tool is three offsets"),
        (
            "{error: ECC, source: {plugin: exemplary-text, file: six.txt}}",
            "measurement.error: ECC belongs to a rotary axis; axis.kind: rotary",
        ),
        ("{date: 2026-11-18}", "measurement.source: missing"),
    ],
)
def test_what_does_not_go_with_what_was_measured_is_refused(line: str, message: str, tmp_path: Path) -> None:
    assert any(message in each for each in mistakes(of(line), tmp_path))
