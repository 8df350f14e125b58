"""A calibration certificate without a mandatory item is refused, item by item and all at once."""

import pytest

from document.certificate.documents import COMPLETE, certificate, without
from refusals import messages, refused
from zlmreport.document.certificate.clauses import MANDATORY_ITEMS

#: A job that states every item, those of an axis that was adjusted included.
EVERYTHING = {
    **COMPLETE,
    "location": "Hall 1, Lane 2",
    "as_found": {
        "adjustment": "Backlash compensation renewed.",
        "measurement": {"date": "2022-04-06", "source": COMPLETE["measurement"]["source"]},
    },
}
#: What to take out so that an item is not stated, where that is not its key alone.
TAKEN_OUT = {
    "laboratory.name": ["laboratory"],
    "location": ["location", "customer.address"],
    "customer.name": ["customer"],
    "machine.model": ["machine.manufacturer", "machine.model"],
}


def lacking(key):
    return without(*TAKEN_OUT.get(key, [key]), keys=EVERYTHING)


def bare(certificate):
    """Return no more than the keys of a document on an axis that was adjusted."""
    source = COMPLETE["measurement"]["source"]
    return {
        **{key: COMPLETE[key] for key in ("schema", "axis", "evaluate")},
        "certificate": certificate,
        "measurement": {"source": source},
        "as_found": {"measurement": {"source": source}},
    }


def refusals(folder, keys):
    """Return the messages of all items that a job with these keys lacks."""
    return messages(certificate, folder, keys)


def test_a_complete_certificate_is_accepted(tmp_path):
    assert certificate(tmp_path, EVERYTHING).title == "Calibration Certificate"


def test_keys_of_the_usual_job_are_enough_for_a_certificate(tmp_path):
    assert certificate(tmp_path).title == "Calibration Certificate"


@pytest.mark.parametrize("item", MANDATORY_ITEMS, ids=lambda item: f"{item.clause}-{item.key}")
def test_a_missing_item_is_named_with_its_clause_and_key(tmp_path, item):
    messages = refusals(tmp_path, lacking(item.key))
    assert any(f"{item.clause})" in each and f"add {item.key}," in each for each in messages)


def test_all_missing_items_are_named_at_once(tmp_path):
    found = refusals(tmp_path, bare({"number": "CAL-1"}))
    assert sum("ISO/IEC 17025:2017, 7.8" in each for each in found) == len(MANDATORY_ITEMS)


def test_a_measuring_report_may_lack_all_of_them(tmp_path):
    assert certificate(tmp_path, bare({"number": "REP-1", "kind": "report"})).title == "Measuring Report"


def test_five_keys_are_enough_for_a_measuring_report(tmp_path):
    keys = bare({"number": "REP-1", "kind": "report"})
    del keys["as_found"]
    assert len(keys) == 5
    assert certificate(tmp_path, keys).title == "Measuring Report"


def test_the_message_stands_where_the_key_would_be_added(tmp_path):
    (problem,) = refused(certificate, tmp_path, without("machine.serial")).problems
    lines = (tmp_path / "job.yaml").read_text().splitlines()
    assert lines[problem.place.line - 1].startswith(("machine:", "  manufacturer:"))
