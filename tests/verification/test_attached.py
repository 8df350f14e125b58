"""The files that a certificate carries, without a certificate around them."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import pytest

from zlmreport.verification.attached import stated_by


def carrier(content: bytes, name: str = "CAL-1.json", relationship: str = "Data") -> Any:
    return SimpleNamespace(
        carried={name: SimpleNamespace(name=name, content=content, relationship=relationship)}
    )


@pytest.mark.parametrize("number", ["1e999", "-Infinity", "NaN", "1" * 400])
def test_a_number_that_no_certificate_can_state_is_no_result(number: str) -> None:
    """No comparison decides on it, and no JSON of ours could say so."""
    with pytest.raises(ValueError, match=r"^CAL-1.json: no JSON: \S+ is no finite number$"):
        stated_by(carrier(b'{"schema": "zlmreport/results/1", "limit": %s}' % number.encode()))
