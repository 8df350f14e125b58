"""A calibration certificate without a mandatory item is refused, item by item and all at once."""

import pytest

from certificate.documents import COMPLETE, certificate, without
from zlmreport.certificate.clauses import MANDATORY_ITEMS
from zlmreport.errors import InputError

ITEMS = [(item.key, item.clause) for item in MANDATORY_ITEMS]


def key_to_drop(key):
    """Return what to drop: a name is mandatory in its own group, so the group goes with it."""
    return key.partition(".")[0] if key.endswith(".name") else key


def test_a_complete_certificate_is_accepted(tmp_path):
    assert certificate(tmp_path).title == "Calibration Certificate"


@pytest.mark.parametrize(("key", "clause"), ITEMS)
def test_a_missing_item_is_named_with_its_clause_and_key(tmp_path, key, clause):
    with pytest.raises(InputError) as refused:
        certificate(tmp_path, without(key_to_drop(key)))
    messages = [problem.message for problem in refused.value.problems]
    assert any(clause in message and f"add {key}" in message for message in messages)


def test_all_missing_items_are_named_at_once(tmp_path):
    keys = {key: COMPLETE[key] for key in ("schema", "axis", "evaluate")}
    keys["certificate"] = {"number": "CAL-1"}
    keys["measurement"] = {"source": COMPLETE["measurement"]["source"]}
    with pytest.raises(InputError) as refused:
        certificate(tmp_path, keys)
    assert len(refused.value.problems) == len(MANDATORY_ITEMS)


@pytest.mark.parametrize("key", sorted({key_to_drop(key) for key, _ in ITEMS}))
def test_a_measuring_report_may_lack_every_item(tmp_path, key):
    keys = without(key)
    keys["certificate"] = {**keys.get("certificate", {"number": "CAL-1"}), "kind": "report"}
    assert certificate(tmp_path, keys).title == "Measuring Report"


def test_the_message_stands_where_the_key_would_be_added(tmp_path):
    with pytest.raises(InputError) as refused:
        certificate(tmp_path, without("machine.serial"))
    (problem,) = refused.value.problems
    lines = (tmp_path / "job.yaml").read_text().splitlines()
    assert lines[problem.place.line - 1].startswith(("machine:", "  manufacturer:"))
