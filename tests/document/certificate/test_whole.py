"""The wording of all that a certificate states beside its results."""

import os
from pathlib import Path

import pytest

from document.certificate.documents import certificate, having, lines_of
from document.certificate.everything import EVERYTHING, write_tables
from zlmreport.evaluation.uncertainty.monte_carlo import TRIALS
from zlmreport.plugin.renderer import Facts

GOLDEN = Path(__file__).with_name("golden")
#: The sections that are not about one standard, the budget or the files.
SECTIONS = ("conditions", "as-found-as-left", "opinions")


@pytest.mark.parametrize("kind", ["amendment", "replacement"])
@pytest.mark.parametrize("language", ["en", "de"])
def test_the_wording_is_what_was_read_and_approved(tmp_path, language, kind):
    """Set ZLMREPORT_APPROVE=1 to take the present text as approved, and read the difference."""
    write_tables(tmp_path)
    keys = having("certificate.language", language, EVERYTHING)
    keys = having("as_found.work", "repair" if kind == "amendment" else "adjustment", keys)
    amends = {"number": "CAL-0", "kind": kind, "reason": "Wrong serial number.", "changes": ["S-1, not S-2"]}
    document = certificate(tmp_path, having("certificate.amends", amends, keys), TRIALS)
    lines = [document.title, *(line for block in document.cover for line in lines_of(block))]
    for section in document.sections:
        if section.key in SECTIONS:
            lines.extend(["", f"# {section.title}"])
            lines.extend(line for block in section.blocks for line in lines_of(block))
    text = "\n".join(lines) + "\n"
    approved = GOLDEN / f"{kind}.{language}.txt"
    if os.environ.get("ZLMREPORT_APPROVE"):
        approved.write_text(text, encoding="utf-8")
    assert text == approved.read_text(encoding="utf-8")


def test_in_french_a_space_stands_before_the_colon_within_what_was_measured(tmp_path):
    write_tables(tmp_path)
    document = certificate(tmp_path, having("certificate.language", "fr", EVERYTHING))
    blocks = (block for section in document.sections for block in section.blocks)
    values = [value for block in blocks if isinstance(block, Facts) for _, value in block.pairs]
    assert any("EYY (VDI/VDE 2617-3\N{NO-BREAK SPACE}: ypy)" in value for value in values)
