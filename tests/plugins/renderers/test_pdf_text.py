"""What a PDF says is what the certificate says."""

from __future__ import annotations

from dataclasses import replace

import pytest

from document.typesetting import samples
from plugins.renderers.pdf_pages import (
    printed_numbers,
    read,
    sample,
    texts,
)
from zlmreport.plugin import InputError, Language
from zlmreport.plugin.renderer import Notice, Section


def test_decimals_are_written_as_the_language_writes_them() -> None:
    assert printed_numbers("\n".join(texts(sample(Language.GERMAN))))["13,8"] == 2
    assert printed_numbers("\n".join(texts(sample(Language.ENGLISH))))["13.8"] == 2


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


def test_names_that_stay_whole_stand_beside_each_other_in_a_notice_too() -> None:
    """The line of a notice begins left of the others: a name in it does not."""
    named = "ISO 230-2:2014, ISO 230-2:2006, VDI/VDE 2617; see 4711-D-K-2026"
    notice = Notice("Not met", (named,))
    document = replace(samples.certificate(standards=0), sections=(Section("s", "S", (notice,)),))
    assert named in "\n".join(texts(read(document)))
