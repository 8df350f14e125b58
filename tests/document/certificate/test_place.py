"""Where the work was done, as the first page says it."""

import pytest

from document.certificate.documents import COMPLETE, certificate, having, job, without
from zlmreport.plugin import InputError, Language
from zlmreport.plugin.renderer import place_of_work

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
    found = place(tmp_path, having("machine.location", "Hall 3", without("location")))
    assert found.words.in_language(Language.GERMAN) == "am Aufstellort der Maschine: Hall 3"


def test_the_place_that_is_stated_goes_before_that_of_the_machine(tmp_path):
    keys = having("machine.location", "Hall 3", {**COMPLETE, "location": {"kind": "laboratory"}})
    assert place(tmp_path, keys).kind == "laboratory"


def test_no_place_is_assumed(tmp_path):
    assert place(tmp_path, without("location")) is None


def test_certificate_without_a_place_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"where the work was done .*7\.8\.2\.1 c"):
        certificate(tmp_path, without("location"))
