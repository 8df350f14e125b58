"""Each check of a renderer passes the exemplary one, and finds the sin it is there for."""

from __future__ import annotations

import html
import itertools
import json
import re
import time
from collections.abc import Callable
from dataclasses import replace
from datetime import datetime

import pytest

from refusals import failed_checks
from testing.exemplary import ExemplaryPage, ExemplaryRenderer
from testing.sinning import make_sinner, make_tests
from zlmreport.plugin import Language, Words
from zlmreport.plugin.renderer import Block, Cell, Certificate, Formulas, Notice, Table
from zlmreport.testing import RENDERER_CHECKS, check_renderer, renderers, sample_certificate

COUNTER = itertools.count()


def on_paper(change: Callable[[bytes], bytes]) -> Callable[..., bytes]:
    return lambda _, certificate: change(ExemplaryPage().render(certificate))


def german_only(_self: object, certificate: Certificate) -> bytes:
    assert certificate.language is Language.GERMAN, "English is not written"
    return b"Deutsch"


def unescaped(_self: object, certificate: Certificate) -> bytes:
    return f"{certificate.title} {certificate.number}".encode()


def title_only(_self: object, certificate: Certificate) -> bytes:
    return f"<h1>{certificate.title}</h1><p>{certificate.number}</p>".encode()


def without(kind: type) -> Callable[..., bytes]:
    """Return a renderer that drops every block of a kind."""

    def render(_self: object, certificate: Certificate) -> bytes:
        sections = tuple(
            replace(each, blocks=tuple(block for block in each.blocks if not isinstance(block, kind)))
            for each in certificate.sections
        )
        return ExemplaryPage().render(replace(certificate, sections=sections))

    return render


def without_values(_self: object, certificate: Certificate) -> bytes:
    return json.dumps([certificate.number, certificate.title]).encode()


def in_nanometres(_self: object, certificate: Certificate) -> bytes:
    (parameter,) = certificate.evaluations[0].parameters
    return json.dumps([certificate.number, certificate.title, parameter.value * 1e9]).encode()


def backwards(_self: object, certificate: Certificate) -> bytes:
    return ExemplaryPage().render(replace(certificate, sections=certificate.sections[::-1]))


def by_symbol(_self: object, certificate: Certificate) -> bytes:
    found = sorted(certificate.evaluations[0].parameters, key=lambda each: each.quantity.symbol)
    return json.dumps([each.value for each in found]).encode()


def in_one_unit(_self: object, certificate: Certificate) -> bytes:
    return json.dumps([1e6 * each.value for each in certificate.evaluations[0].parameters]).encode()


def joined_by_commas(_self: object, certificate: Certificate) -> bytes:
    return f"title,number,value\n{certificate.title},{certificate.number},1\n".encode()


SINS = [
    (renderers.is_named, {"identifier": "PDF!"}, "lower-case ASCII"),
    (renderers.is_named, {"title": Words(en="", de="Titel")}, "title says nothing in 'en'"),
    (renderers.is_named, {"suffix": "html"}, "must be like '.pdf'"),
    (renderers.writes_every_block, {"render": lambda *_: "text"}, "bytes is expected"),
    (renderers.writes_every_block, {"render": lambda *_: b""}, "an empty file"),
    (renderers.writes_every_block, {"render": german_only}, "English is not written"),
    (
        renderers.reads_no_clock,
        {"render": lambda *_: time.strftime("%Y-%m-%d").encode()},
        "other bytes on another date",
    ),
    (
        renderers.reads_no_clock,
        {"render": lambda *_: str(int(datetime.now().astimezone().timestamp())).encode()},
        "from byte",
    ),
    (
        renderers.reads_no_clock,
        {"render": lambda *_: b"x" * next(COUNTER)},
        "other bytes",
    ),
    (
        renderers.names_the_certificate,
        {"render": on_paper(lambda page: page.replace(b"KIT-", b""))},
        "does not carry the certificate's number",
    ),
    (renderers.prints_what_the_document_says, {"render": title_only}, "does not print "),
    (
        renderers.prints_what_the_document_says,
        {"render": on_paper(lambda page: page + b"<p>Verdict(mark=&lt;Mark.MET: 'met'&gt;, word='met')</p>")},
        "prints an object as Python shows it: Verdict(mark=<Mark.MET: 'met'>…; a cell is a text",
    ),
    (renderers.prints_what_the_document_says, {"render": without(Notice)}, "(notice: heading "),
    (renderers.prints_what_the_document_says, {"render": without(Table)}, "(verdict: "),
    (renderers.prints_what_the_document_says, {"render": without(Formulas)}, "(formulas: "),
    (
        renderers.prints_what_the_document_says,
        {"suffix": ".json", "render": without_values},
        "does not carry the value of the parameter D",
    ),
    (
        renderers.prints_what_the_document_says,
        {"suffix": ".json", "render": in_nanometres},
        "does not carry the value of the parameter D",
    ),
    (renderers.sets_markup_as_text, {"render": unescaped}, "a user's text became an element"),
    (
        renderers.sets_markup_as_text,
        {"render": on_paper(lambda page: page.replace(b"{{7*7}}", b"49"))},
        "does not come out as it was typed",
    ),
    (
        renderers.keeps_letters_and_signs,
        {
            "render": on_paper(
                lambda page: page.decode().encode("latin-1", "replace").decode("latin-1").encode()
            )
        },
        "do not come out as they were typed",
    ),
    (
        renderers.keeps_letters_and_signs,
        {"render": on_paper(lambda page: page.replace("Ł".encode(), b"L"))},
        "Ł do not come out as they were typed",
    ),
    (renderers.keeps_the_order, {"render": backwards}, "not in the order of the certificate"),
    (renderers.keeps_the_order, {"suffix": ".json", "render": by_symbol}, "not in the order"),
    (
        renderers.keeps_the_order,
        {"suffix": ".json", "render": in_one_unit},
        "does not carry 1.57882; a parameter is in SI, or in its own unit",
    ),
    (renderers.keeps_the_order, {"suffix": ".odt"}, "say how a file '.odt' is read"),
    (
        renderers.keeps_letters_and_signs,
        {"render": on_paper(lambda page: page.decode().encode("latin-1", "replace") + b"\xc4")},
        "the file is not UTF-8",
    ),
    (
        renderers.sets_markup_as_text,
        {"suffix": ".csv", "render": joined_by_commas},
        "row 2 has 4 cells, and the first has 3",
    ),
]


test_exemplary_passes, test_a_check_finds_its_sin, test_every_check_has_a_sin = make_tests(
    RENDERER_CHECKS, ExemplaryPage, SINS, lambda *_: ()
)


def test_an_exemplary_format_of_data_passes() -> None:
    check_renderer(ExemplaryRenderer())


def test_all_failures_are_reported_at_once() -> None:
    sinner = make_sinner(ExemplaryPage, {"suffix": "html", "render": lambda *_: b""})
    with pytest.raises(AssertionError, match="suffix"):
        check_renderer(sinner)
    sinner = make_sinner(ExemplaryPage, {"render": lambda *_: b"nothing"})
    checks = failed_checks(check_renderer, sinner)
    assert checks == [
        "names_the_certificate",
        "prints_what_the_document_says",
        "sets_markup_as_text",
        "keeps_letters_and_signs",
        "keeps_the_order",
    ]


def test_the_author_says_how_an_unknown_format_is_read() -> None:
    sinner = type("Other", (ExemplaryPage,), {"suffix": ".odt"})()
    check_renderer(sinner, read=lambda content: html.unescape(re.sub("<[^>]*>", "", content.decode())))


@pytest.mark.parametrize("language", Language)
def test_the_sample_certificate_has_every_kind_of_block_and_of_cell(language: Language) -> None:
    certificate = sample_certificate(language)
    blocks = (*certificate.cover, *(block for section in certificate.sections for block in section.blocks))
    tables = [block for block in blocks if isinstance(block, Table)]
    cells = [cell for table in tables for group in table.groups for row in group.rows for cell in row]
    assert {type(block) for block in blocks} == set(Block.__args__)
    assert {type(cell) for cell in cells} == set(Cell.__args__)
