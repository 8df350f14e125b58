"""A changed document names the earlier one and the reason, and has a number of its own."""

import pytest

from document.certificate.documents import COMPLETE, certificate, lines_of
from zlmreport.plugin.renderer import Notice

AMENDS = {"number": "CAL-0", "reason": "Wrong serial number.", "changes": ["Serial number: S-1, not S-2"]}


@pytest.fixture
def document(tmp_path):
    """Compose a document that changes CAL-0, with other keys of its certificate."""

    def compose(**keys):
        changed = {**COMPLETE["certificate"], "amends": AMENDS, **keys}
        words_only = COMPLETE
        return certificate(tmp_path, {**words_only, "certificate": changed})

    return compose


@pytest.mark.parametrize(
    ("keys", "title"),
    [
        ({}, "Amendment to Calibration Certificate CAL-0"),
        ({"language": "de"}, "Änderung zum Kalibrierschein CAL-0"),
        ({"kind": "report"}, "Amendment to Measuring Report CAL-0"),
        ({"kind": "report", "language": "de"}, "Änderung zum Messbericht CAL-0"),
        ({"title": "Factory Test"}, "Amendment to Factory Test CAL-0"),
    ],
)
def test_an_amendment_is_titled_by_what_it_amends(document, keys, title):
    assert document(**keys).title == title


def test_every_page_of_an_amendment_has_its_own_number(document):
    assert document().page_words.number == "Amendment CAL-1"


def test_a_replacement_is_a_whole_certificate_by_title_and_on_every_page(document):
    replacing = document(amends={**AMENDS, "kind": "replacement"})
    assert replacing.title == "Calibration Certificate"
    assert replacing.page_words.number == "Calibration Certificate CAL-1"


@pytest.mark.parametrize(
    ("kind", "heading"),
    [
        ("amendment", "This document amends CAL-0, which remains valid in all that is not changed here"),
        ("replacement", "This document replaces CAL-0, which is no longer valid"),
    ],
)
def test_the_first_page_begins_with_what_is_changed_and_why(document, kind, heading):
    first = document(amends={**AMENDS, "kind": kind}).cover[0]
    assert first == Notice(heading, ("Reason: Wrong serial number.", "Changed: Serial number: S-1, not S-2"))


def test_a_document_that_changes_none_speaks_of_none(document):
    text = "\n".join(line for block in document(amends=None).cover for line in lines_of(block))
    assert "amends" not in text
    assert "replaces" not in text
