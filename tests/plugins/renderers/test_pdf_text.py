"""What a PDF says is what the certificate says."""

from __future__ import annotations

import unicodedata
from dataclasses import replace

import pytest

from document.typesetting import samples
from plugins.renderers.pdf_pages import (
    numbers_of,
    printed_numbers,
    read,
    sample,
    texts,
)
from zlmreport.plugin import InputError, Language
from zlmreport.plugin.renderer import Notice, Section


@pytest.mark.parametrize("language", Language)
def test_every_number_of_every_table_is_printed(language: Language) -> None:
    expected = numbers_of(samples.certificate(language))
    assert expected.total() > 700
    missing = expected - printed_numbers("\n".join(texts(sample(language))))
    assert not missing


def test_rows_of_numbers_are_read_in_order() -> None:
    text = "\n".join(texts(sample()))
    assert "\n4 150.000 5 5 3.3 0.6 1.9 0.7 0.8 2.6 2.9 3.3\n" in text


def test_decimals_are_written_as_the_language_writes_them() -> None:
    assert printed_numbers("\n".join(texts(sample(Language.GERMAN))))["13,8"] == 2
    assert printed_numbers("\n".join(texts(sample(Language.ENGLISH))))["13.8"] == 2


NAMES = [
    "<b>Müller & Söhne</b> <script>alert(1)</script>",
    '<img src="file:///etc/passwd">',
    "{{ 7 * 7 }} {% raw %}",
    "&lt; &amp; &#65;",
    "x̄ é ñ",
    "Ελληνικά Русский Türkçe",
    "-->]]></style>",
]


def test_a_customers_name_is_printed_as_it_is_typed() -> None:
    text = _unspaced("".join(texts(read(samples.certificate(standards=0, customer=" / ".join(NAMES))))))
    assert [name for name in NAMES if _unspaced(name) not in text] == []


def test_a_name_of_500_characters_is_printed_whole() -> None:
    customer = "".join(chr(ord("a") + n % 26) for n in range(500))
    text = "".join(texts(read(samples.certificate(standards=0, customer=customer))))
    assert customer in _unspaced(text)


def test_a_name_from_right_to_left_leaves_the_rest_as_it_was() -> None:
    customer = "שלום \u202eabc עולם"
    text = "".join(texts(read(samples.certificate(standards=0, customer=customer))))
    # Readers put right-to-left letters into either order; all of them are there.
    assert set("שלוםעabc") <= set(text)
    assert "Sample Works HMC 500" in text


def test_a_letter_that_no_typeface_has_is_named_and_no_box_stands_for_it(weasyprint_log: list[str]) -> None:
    """Not even a signer would see what the box meant; and programs read none of the letters beside it."""
    document = samples.certificate(standards=0, customer="A \U000f1234 Customer")
    weasyprint_log.append(
        '.notdef glyph rendered for Unicode string unsupported by fonts: "\U000f1234" (U+F1234)'
    )

    with pytest.raises(InputError, match=r"nor one of this system has \(U\+F1234 .*\); write it otherwise"):
        read(document)


def test_graphs_carry_their_words_as_text() -> None:
    text = "\n".join(texts(sample(Language.GERMAN)))
    assert text.count("Zielposition in mm") == 4
    assert text.count("Abweichung in µm") == 4


def _unspaced(text: str) -> str:
    return "".join(unicodedata.normalize("NFC", text).split())


def test_names_that_stay_whole_stand_beside_each_other_in_a_notice_too() -> None:
    """The line of a notice begins left of the others: a name in it does not."""
    named = "ISO 230-2:2014, ISO 230-2:2006, VDI/VDE 2617; see 4711-D-K-2026"
    notice = Notice("Not met", (named,))
    document = replace(samples.certificate(standards=0), sections=(Section("s", "S", (notice,)),))
    assert named in "\n".join(texts(read(document)))
