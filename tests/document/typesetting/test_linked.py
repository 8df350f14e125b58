"""Linked graphs: values that cannot be markup, and one script that the page's policy names."""

from __future__ import annotations

import base64
import hashlib
import json
import re
from dataclasses import replace
from functools import cache
from xml.etree import ElementTree as ET

import pytest

from installed import registry
from model.hidden_effect import CONFIG, job
from zlmreport import pipeline
from zlmreport.document.certificate.document import Linked
from zlmreport.document.typesetting import resources
from zlmreport.plugin.html import compose_html
from zlmreport.plugin.renderer import Certificate


@cache
def certificate() -> Certificate:
    return pipeline.compose(job(CONFIG / "job.yaml"), registry())


@cache
def page() -> str:
    return registry().renderer("html").render(certificate()).decode()


def graphs() -> Linked:
    found = certificate().linked
    assert found is not None
    return found


def scripts(text: str) -> list[str]:
    return re.findall(r"<script>(.*?)</script>", text, re.DOTALL)


@pytest.mark.long
def test_the_policy_names_the_only_script() -> None:
    (script,) = scripts(page())
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    (policy,) = re.findall(r'http-equiv="Content-Security-Policy" content="([^"]*)"', page())
    assert "default-src 'none'" in policy.replace("&#39;", "'")
    assert f"script-src 'sha256-{digest}'" in policy.replace("&#39;", "'").replace("&#43;", "+")


def test_the_page_is_xml_as_well_and_its_values_are_there() -> None:
    tree = ET.fromstring(page())
    (values,) = [each for each in tree.iter("script") if each.get("type") == "application/json"]
    assert values.text
    assert json.loads(values.text)["graphs"] == graphs().graphs


def test_the_page_has_words_for_a_single_reading() -> None:
    assert graphs().texts["chosenOne"] == "1 reading chosen"


def test_the_page_names_no_address_elsewhere() -> None:
    addresses = set(re.findall(r"https?://[^\s\"'<>)]+", "".join(scripts(page()))))
    assert addresses <= {"http://www.w3.org/2000/svg"}
    assert re.search(r'(?:src|href)="(?!#|data:)', page()) is None


def test_no_module_of_the_script_is_left_to_load() -> None:
    assert re.search(r"^\s*(import|export)\b", resources.read_linked_script(), re.MULTILINE) is None


@pytest.mark.parametrize("end", ["</script", "<!--"])
def test_nothing_in_the_script_ends_it(end: str) -> None:
    assert end not in resources.read_linked_script().lower()


def test_nothing_in_the_script_ends_its_section_of_xml() -> None:
    assert resources.read_linked_script().count("]]>") == 1


@pytest.mark.parametrize("text", ["</script><script>alert(1)</script>", "<!--", "&amp;", "]]>", "\x00\u2028"])
def test_hostile_text_is_text(text: str) -> None:
    hostile = replace(graphs(), texts={**graphs().texts, "measured": text})
    written = resources.write_linked_values(hostile)
    assert not set(written) & set("<>&\x00\u2028")
    assert json.loads(written)["texts"]["measured"] == text


@pytest.mark.long
def test_it_is_the_same_twice() -> None:
    resources.read_linked_script.cache_clear()
    again = pipeline.compose(job(CONFIG / "job.yaml"), registry())
    assert registry().renderer("html").render(again).decode() == page()


def test_a_document_that_runs_nothing_has_none_of_it() -> None:
    text = compose_html(certificate())
    assert text == compose_html(replace(certificate(), linked=None))
    assert "<script" not in text
