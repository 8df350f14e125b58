"""The files that a certificate carries, without a certificate around them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from zlmreport.verification.attached import compare, find_stated_by
from zlmreport.verification.carrier import Carried
from zlmreport.verification.findings import VerificationVerdict


def carrier(content: bytes, name: str = "CAL-1.json", relationship: str = "Data") -> Any:
    return SimpleNamespace(
        carried={name: SimpleNamespace(name=name, content=content, relationship=relationship)}
    )


@pytest.mark.parametrize("number", ["1e999", "-Infinity", "NaN", "1" * 400])
def test_a_number_that_no_certificate_can_state_is_no_result(number: str) -> None:
    """No comparison decides on it, and no JSON of ours could say so."""
    with pytest.raises(ValueError, match=r"^CAL-1.json: \S+ is no finite number$"):
        find_stated_by(carrier(b'{"schema": "zlmreport/results/1", "limit": %s}' % number.encode()))


def carried(content: bytes) -> dict[str, Carried]:
    """One file that a renderer makes of the readings, as a PDF carries it."""
    return {"CAL-1.xml": Carried("CAL-1.xml", content, "Alternative", "", "", "")}


@pytest.mark.parametrize(
    ("content", "same_processor", "verdict"),
    [
        (b"<value>1.25000000001</value>", True, VerificationVerdict.DIFFERS),
        (b"<value>1.25000000001</value>", False, VerificationVerdict.HOLDS),
        (b"<value>1.26</value>", False, VerificationVerdict.DIFFERS),
        (b"<conformity>fail</conformity>", False, VerificationVerdict.DIFFERS),
        (b"<note>A = 0.1 um, passed</note>", False, VerificationVerdict.DIFFERS),
    ],
)
def test_what_is_made_of_the_readings_is_made_again(
    content: bytes,
    same_processor: bool,
    verdict: VerificationVerdict,
) -> None:
    """Another processor rounds the last digit otherwise; the same one does not."""
    again = carried(b"<value>1.25</value>")
    (found,) = compare((), carried(content), again, same_processor=same_processor)
    assert found.verdict is verdict
