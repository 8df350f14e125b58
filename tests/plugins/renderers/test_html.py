"""Certificates as one self-contained page of HTML."""

from __future__ import annotations

import base64
import re
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from html.parser import HTMLParser
from xml.etree import ElementTree as ET

import pytest

from document.typesetting import samples
from installed import registry
from plugins.renderers.pdf_pages import numbers_of, printed_numbers
from zlmreport.plugin import Language
from zlmreport.plugin.renderer import Certificate


class Page(HTMLParser):
    """A page as a browser reads it: elements with attributes, and the text of its body."""

    def __init__(self, content: str) -> None:
        super().__init__()
        self.elements: list[tuple[str, dict[str, str | None]]] = []
        self.style = ""
        self.texts: list[str] = []
        self._inside: list[str] = []
        self.feed(content)

    def handle_starttag(self, tag: str, attrs: Sequence[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))
        self._inside.append(tag)

    def handle_startendtag(self, tag: str, attrs: Sequence[tuple[str, str | None]]) -> None:
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag: str) -> None:
        assert self._inside.pop() == tag

    def handle_data(self, data: str) -> None:
        if "style" in self._inside:
            self.style += data
        elif "body" in self._inside:
            self.texts.append(data)

    @property
    def text(self) -> str:
        return "\n".join(self.texts)


def render(certificate: Certificate) -> Page:
    return Page(registry().renderer("html").render(certificate).decode())


@cache
def sample(language: Language = Language.ENGLISH) -> Page:
    return render(samples.certificate(language))


@pytest.mark.parametrize("language", Language)
def test_it_has_every_number_of_every_table(language: Language) -> None:
    expected = numbers_of(samples.certificate(language))
    assert not expected - printed_numbers(sample(language).text)


@pytest.mark.parametrize("language", Language)
def test_it_says_its_language(language: Language) -> None:
    assert sample(language).elements[0] == ("html", {"lang": language.value})


def test_it_starts_as_html_and_is_xml_as_well() -> None:
    content = registry().renderer("html").render(samples.certificate())
    assert content.startswith(b"<!DOCTYPE html>\n")
    ET.fromstring(content)


def test_elements_that_html_leaves_open_are_not_closed() -> None:
    void = {"br", "col", "img", "meta"}
    content = registry().renderer("html").render(samples.certificate()).decode()
    body = content[: content.index("<svg")]
    assert set(re.findall(r"<(\w+)[^<>]*/>", body)) <= void


def test_it_runs_nothing_and_loads_nothing() -> None:
    page = sample()
    tags = {tag for tag, _ in page.elements}
    assert not tags & {"script", "link", "iframe", "object", "embed", "base", "form"}
    addresses = [
        value or ""
        for _, attributes in page.elements
        for name, value in attributes.items()
        if name in {"src", "href", "xlink:href", "srcset", "action", "data"} or name.startswith("on")
    ]
    assert addresses == []
    assert {url[:16] for url in re.findall(r"url\(([^)]*)\)", page.style)} == {"data:font/woff2;"}
    assert "@import" not in page.style


def test_the_typeface_is_inside() -> None:
    fonts = re.findall(r"url\(data:font/woff2;base64,([^)]*)\)", sample().style)
    assert len(fonts) == 3
    assert all(base64.b64decode(font).startswith(b"wOF2") for font in fonts)


def test_graphs_are_drawings_that_tell_what_they_show() -> None:
    drawings = [attributes for tag, attributes in sample(Language.GERMAN).elements if tag == "svg"]
    expected = [figure.alternative.in_language(Language.GERMAN) for figure in samples.certificate().figures]
    assert [drawing["aria-label"] for drawing in drawings] == expected
    assert {drawing["role"] for drawing in drawings} == {"img"}


def test_no_two_elements_share_an_identifier() -> None:
    identifiers = [attributes["id"] for _, attributes in sample().elements if "id" in attributes]
    assert len(identifiers) == len(set(identifiers))


def test_the_logo_is_inside() -> None:
    plain = samples.certificate(standards=0)
    assert plain.letterhead is not None
    page = render(
        replace(plain, letterhead=replace(plain.letterhead, logo=b"picture", logo_type="image/png"))
    )
    (logo,) = [attributes for tag, attributes in page.elements if tag == "img"]
    assert logo["src"] == f"data:image/png;base64,{base64.b64encode(b'picture').decode()}"
    assert logo["alt"] == "Laboratory for Machine Metrology"


@pytest.mark.parametrize(
    "customer",
    ["<script>alert(1)</script>", "{{ 7 * 7 }}", "</style></html>", '"><img src=x onerror=y>', "🙂"],
)
def test_a_customers_name_is_text(customer: str) -> None:
    page = render(samples.certificate(standards=0, customer=customer))
    assert customer in page.text
    harmless = render(samples.certificate(standards=0, customer="harmless"))
    assert [tag for tag, _ in page.elements] == [tag for tag, _ in harmless.elements]


@pytest.mark.parametrize("paper", ["A4", "Letter"])
def test_it_is_printed_on_the_paper_asked_for(paper: str) -> None:
    assert f"size: {paper} }}" in render(samples.certificate(paper=paper, standards=0)).style


def test_it_can_be_sent_by_mail() -> None:
    assert len(registry().renderer("html").render(samples.certificate())) < 1_000_000
