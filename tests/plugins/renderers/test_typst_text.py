"""What a PDF by Typst says is what the certificate says, letter for letter as in the PDF by WeasyPrint."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import pytest
from pypdf import PdfReader

from document.typesetting import samples
from environments import ROOT
from installed import load_job, registry
from plugins.renderers.pdf_pages import numbers_of, printed_numbers, read, sample, texts, unspaced
from zlmreport import pipeline
from zlmreport.plugin import InputError, Language
from zlmreport.plugin.renderer import Certificate, Facts, Formulas, Graph, Notice, Paragraph, Table
from zlmreport_plugins.renderers.pdf_typst.words import AS_WORDS, MARKED, SYMBOL, fit_text_with_symbols


def _letters(reader: PdfReader, running: tuple[str, ...]) -> Counter[str]:
    """All characters of all pages but spaces, without what stands at the head and foot of each.

    Two writers share out a document among pages each in its own way.
    """
    found: Counter[str] = Counter()
    for number, text in enumerate(texts(reader), start=1):
        found += Counter(unspaced(text))
        of_page = running[-1].format(number, len(reader.pages))
        found -= Counter(unspaced("".join((of_page, *running[: 1 if number == 1 else -1]))))
    return found


def _body(reader: PdfReader, running: tuple[str, ...]) -> str:
    """All text of all pages without spaces, and without what stands at the head and foot of each."""
    pages = []
    for number, text in enumerate(texts(reader), start=1):
        page = unspaced(text)
        for each in (*running[:-1], running[-1].format(number, len(reader.pages))):
            page = page.replace(unspaced(each), "", 1)
        pages.append(page)
    return "".join(pages)


def _sentences(certificate: Certificate) -> Iterator[str]:
    """All running text of a certificate, and the values of its facts."""
    blocks = (*certificate.cover, *(block for section in certificate.sections for block in section.blocks))
    for block in blocks:
        match block:
            case Paragraph(text):
                yield text
            case Notice(heading, items):
                yield from (heading, *items)
            case Facts(pairs):
                yield from (value for _, value in pairs)
            case Table(caption) | Formulas(caption):
                yield caption
            case Graph(figure):
                yield figure.title.in_language(certificate.language)


def _running(certificate: Certificate) -> tuple[str, ...]:
    """The texts of every page, those of the following ones, and the number of the page."""
    words = certificate.page_words
    laboratory = certificate.letterhead.laboratory.name if certificate.letterhead else ""
    return words.number, laboratory, certificate.subtitle, f"{words.page}{{}}{words.of}{{}}"


def test_a_document_that_is_all_on_its_first_page_is_printed_as_the_sheet_of_a_machine_is() -> None:
    certificate = replace(samples.certificate(), sections=())
    (page,) = texts(read(certificate, "pdf-typst"))
    assert certificate.number in page


@pytest.mark.parametrize("language", Language)
def test_it_says_what_the_other_says_letter_for_letter(language: Language) -> None:
    running = _running(samples.certificate(language))
    assert _letters(sample(language, press="pdf-typst"), running) == _letters(sample(language), running)


@pytest.mark.long
@pytest.mark.parametrize("job", ["german/messbericht.yaml", "as-found/certificate.yaml"])
def test_every_number_and_every_sentence_of_a_real_certificate_stands_in_both(job: str) -> None:
    certificate = pipeline.compose(load_job(Path(ROOT, "configs", job), ("pdf",)), registry())
    sentences = list(_sentences(certificate))
    assert len(sentences) > 20
    for identifier in ("pdf", "pdf-typst"):
        reader = PdfReader(BytesIO(registry().renderer(identifier).render(certificate)))
        body = _body(reader, _running(certificate))
        assert [sentence for sentence in sentences if unspaced(sentence) not in body] == []
        assert not numbers_of(certificate) - printed_numbers("\n".join(texts(reader)))


def test_a_letter_with_a_bar_is_read_as_such_and_one_without_is_not() -> None:
    text = "".join("".join(texts(sample(press="pdf-typst"))).split())
    assert "max[x̄i]" in text
    assert "xi1↑" in text
    assert "x̄i1↑" not in text


@pytest.mark.parametrize(
    ("customer", "told"), [("中文", "'中' (U+4E2D"), ("🙂", "U+1F642"), ("a\x01b", "U+0001 a control")]
)
def test_a_letter_that_the_typeface_lacks_is_refused_by_name(customer: str, told: str) -> None:
    with pytest.raises(InputError) as refused:
        read(samples.certificate(standards=0, customer=customer), "pdf-typst")
    assert told in str(refused.value)
    assert "ask for the format pdf" in str(refused.value)


def test_line_ends_of_a_value_are_kept() -> None:
    cover, *_ = texts(sample(press="pdf-typst"))
    assert "Werkstraße 7\n70565 Stuttgart\nDeutschland" in cover


def test_a_symbol_in_a_text_is_set_as_one_and_the_name_of_a_standard_stays_whole() -> None:
    assert fit_text_with_symbols("Umax by VDI/VDE 2617", ["U_{max}"], 50.0) == [
        ([[[True, False, "U"], [False, True, "max"]]], SYMBOL),
        (" by ", AS_WORDS),
        ((("VDI/VDE 2617",),), MARKED),
    ]


def test_a_number_is_not_parted_at_its_hyphens() -> None:
    assert ((("4711-D-K-2026.",),), MARKED) in fit_text_with_symbols("No. 4711-D-K-2026.", [], 50.0)
