"""Where the work was done, as the first page says it."""

import pytest

from certificate.documents import COMPLETE, having, job, without
from zlmreport.certificate.cover import place_of_work
from zlmreport.language import Language

CUSTOMER = COMPLETE["customer"]["address"]
LABORATORY = COMPLETE["laboratory"]["address"]


def place(folder, keys):
    return place_of_work(job(folder, keys).keys)


@pytest.mark.parametrize(
    ("location", "kind", "words"),
    [
        ("Hall 3, Village", "other", "Hall 3, Village"),
        ({"kind": "laboratory"}, "laboratory", f"in the laboratory: {LABORATORY}"),
        ({"kind": "customer"}, "customer", f"at the customer's: {CUSTOMER}"),
        ({"kind": "customer", "address": "Hall 3"}, "customer", "at the customer's: Hall 3"),
        ({"kind": "other", "address": "Fair, stand 7"}, "other", "Fair, stand 7"),
        (
            {"kind": "laboratory branch", "address": "Lane 9\n12345 Town"},
            "laboratory branch",
            "at a branch of the laboratory: Lane 9, 12345 Town",
        ),
        (
            {"kind": "customer branch", "address": "Works 2"},
            "customer branch",
            "at a branch of the customer: Works 2",
        ),
    ],
)
def test_the_page_says_whose_place_it_was_and_its_address(tmp_path, location, kind, words):
    found = place(tmp_path, {**COMPLETE, "location": location})
    assert (found.kind, found.words.in_language(Language.ENGLISH)) == (kind, words)


def test_a_machine_is_calibrated_where_it_stands_if_nothing_else_is_said(tmp_path):
    found = place(tmp_path, having("machine.location", "Hall 3"))
    assert found.words.in_language(Language.GERMAN) == "am Aufstellort der Maschine: Hall 3"


def test_the_place_that_is_stated_goes_before_that_of_the_machine(tmp_path):
    keys = having("machine.location", "Hall 3", {**COMPLETE, "location": {"kind": "laboratory"}})
    assert place(tmp_path, keys).kind == "laboratory"


def test_without_any_place_it_is_the_customers_and_the_page_says_that_none_was_stated(tmp_path):
    found = place(tmp_path, COMPLETE)
    assert found.kind == "customer"
    assert found.words.in_language(Language.ENGLISH) == (
        f"at the customer's: {CUSTOMER} (no other place is stated)"
    )


def test_nothing_is_assumed_in_a_measuring_report(tmp_path):
    assert place(tmp_path, having("certificate.kind", "report")) is None


def test_there_is_no_place_where_nothing_hints_at_one(tmp_path):
    assert place(tmp_path, without("customer.address")) is None
