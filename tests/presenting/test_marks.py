"""What others supplied is marked wherever it is printed."""

import pytest

from certificate.documents import COMPLETE, certificate, text_of
from certificate.everything import EVERYTHING, write_tables
from zlmreport.job.contradictions import markable_keys
from zlmreport.presenting.marks import Marks

DISCLAIMER = (
    "† Provided by the customer. The laboratory is not responsible for these data, which can affect the "
    "validity of the results."
)


@pytest.mark.parametrize(
    ("keys", "mark"),
    [
        (("environment.air_temperature",), " †"),
        (("environment.remarks", "environment.air_temperature"), " †"),
        (("machine.serial",), " ‡"),
        (("machine.model",), " †‡"),
        (("environment",), " †"),
        (("environment.air_temperature_2",), ""),
        (("environ",), ""),
        ((), ""),
    ],
)
def test_a_key_is_marked_by_itself_or_its_group_and_a_group_by_what_is_in_it(keys, mark):
    marks = Marks(frozenset({"environment.air_temperature", "machine.model"}), frozenset({"machine"}))
    assert marks.after(*keys) == mark


def test_what_the_customer_supplied_is_marked_on_every_page_that_has_it(tmp_path):
    keys = {**COMPLETE, "provided_by_customer": ["machine.serial"]}
    text = text_of(certificate(tmp_path, keys))
    assert "Serial number †: S-1" in text
    assert "Serial number: S-1" not in text


def test_data_of_the_customer_are_disclaimed(tmp_path):
    keys = {**COMPLETE, "provided_by_customer": ["environment.air_temperature"]}
    assert DISCLAIMER in text_of(certificate(tmp_path, keys))


def test_nothing_is_marked_or_disclaimed_where_all_is_the_laboratorys(tmp_path):
    assert "†" not in text_of(certificate(tmp_path, COMPLETE))


def test_limits_of_the_customer_are_marked_at_the_head_of_their_column(tmp_path):
    text = text_of(certificate(tmp_path, {**COMPLETE, "provided_by_customer": ["evaluate.tolerances"]}))
    assert text.count("Limit † µm") == 2


def test_readings_of_the_customer_are_marked(tmp_path):
    keys = {**COMPLETE, "provided_by_customer": ["measurement.source"]}
    assert "# Readings †" in text_of(certificate(tmp_path, keys))


def test_results_of_external_providers_are_named_and_marked(tmp_path):
    external = {
        "results": "Air temperature",
        "provider": "Thermometry Ltd",
        "reference": "Report 8",
        "keys": ["environment.air_temperature"],
    }
    text = text_of(certificate(tmp_path, {**COMPLETE, "external": [external]}))
    assert "! ‡ Results from external providers\n  - Air temperature: Thermometry Ltd, Report 8\n" in text
    assert "Air temperature ‡: 20.5 °C" in text


def test_every_key_that_others_may_supply_is_marked_where_it_is_printed(tmp_path, monkeypatch):
    """Each key is printed by one that asks for its mark: itself, its group, or what it is a group of."""
    asked = set()
    usual = Marks.after

    def noting(marks, *keys):
        asked.update(keys)
        return usual(marks, *keys)

    write_tables(tmp_path)
    monkeypatch.setattr(Marks, "after", noting)
    certificate(tmp_path, EVERYTHING)
    monkeypatch.undo()
    assert [key for key in markable_keys() if not Marks(frozenset({key})).after(*asked)] == []
