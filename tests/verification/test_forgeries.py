"""No forged certificate holds."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from verification.altering import Forgery, rewritten
from verification.forgeries import FORGERIES
from zlmreport.errors import InputError
from zlmreport.verification.findings import Outcome, Verification

Verify = Callable[[bytes], Verification]


def test_forgeries_are_many_and_each_has_its_own_name() -> None:
    names = [each.name for each in FORGERIES]
    assert len(names) == len(set(names)) > 100
    assert all(each.seen for each in FORGERIES)


@pytest.mark.parametrize("forgery", FORGERIES, ids=lambda each: each.name)
def test_a_forged_certificate_does_not_hold(forgery: Forgery, issued: bytes, verified: Verify) -> None:
    is_found(forgery, issued, verified)


@pytest.mark.parametrize("forgery", FORGERIES[::10], ids=lambda each: each.name)  # each way costs time
def test_a_forged_certificate_of_typst_does_not_hold(
    forgery: Forgery, by_typst: bytes, verified: Verify
) -> None:
    is_found(forgery, by_typst, verified)


@pytest.mark.parametrize("printed", ["issued", "by_typst"])
def test_what_another_program_saved_again_is_not_what_was_issued(
    printed: str, request: pytest.FixtureRequest, verified: Verify
) -> None:
    pdf: bytes = request.getfixturevalue(printed)
    assert verified(pdf).holds
    assert verified(rewritten(pdf, lambda _: None)).outcome is Outcome.DOES_NOT_HOLD


def is_found(forgery: Forgery, pdf: bytes, verified: Verify) -> None:
    forged = forgery.make(pdf)
    try:
        found = verified(forged)
    except InputError:
        return
    expected = Outcome.UNDECIDED if forgery.name == "another release" else Outcome.DOES_NOT_HOLD
    assert found.outcome is expected, f"seen: {forgery.seen}"
