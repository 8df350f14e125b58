"""What the seven standards define: symbols, order, names by edition, formulas, signs."""

from __future__ import annotations

import re

import pytest

from plugins.standards.installed import STANDARDS
from zlmreport.language.formatting import write_plain
from zlmreport.plugin import Language
from zlmreport.plugin.standard import Quantity, QuantityGroup

ISO_1988 = "A A_fwd A_bwd R R_fwd R_bwd B B_mean"
ISO_SINCE_1997 = "A A_fwd A_bwd E E_fwd E_bwd M R R_fwd R_bwd B B_mean"
VDI = "P Pa Ps_max Ps_mean U_max U_mean"

PARAMETERS = {
    "iso230-2:1988": ISO_1988,
    "iso230-2:1997": ISO_SINCE_1997,
    "iso230-2:2006": ISO_SINCE_1997,
    "iso230-2:2014": ISO_SINCE_1997,
    "vdi-dgq-3441": VDI,
    "vdi-vde-2617": VDI,
    "nmtba": "P Pa Ps_max Ps_mean O",
}
BY_POSITION = {
    **dict.fromkeys([name for name in PARAMETERS if name.startswith("iso")], "R_fwd R_bwd R"),
    **dict.fromkeys(["vdi-dgq-3441", "vdi-vde-2617"], "U Ps"),
    "nmtba": "X Ps",
}
DESIGNATIONS = {
    "iso230-2:1988": "ISO 230-2:1988",
    "iso230-2:1997": "ISO 230-2:1997",
    "iso230-2:2006": "ISO 230-2:2006",
    "iso230-2:2014": "ISO 230-2:2014",
    "vdi-dgq-3441": "VDI/DGQ 3441",
    "vdi-vde-2617": "VDI/VDE 2617",
    "nmtba": "NMTBA (1972)",
}


def quantity(identifier: str, symbol: str) -> Quantity:
    return next(each for each in STANDARDS[identifier].quantities if each.symbol == symbol)


def texts(identifier: str) -> list[str]:
    """Return everything that a standard says, in both languages."""
    standard = STANDARDS[identifier]
    words = [
        standard.title,
        *standard.notes,
        *(each.name for each in (*standard.quantities, *standard.position_quantities)),
        *(each.meaning for each in standard.quantities),
    ]
    return [each.in_language(language) for each in words for language in Language]


def test_there_are_these_seven_standards() -> None:
    assert {name: standard.designation for name, standard in STANDARDS.items()} == DESIGNATIONS


@pytest.mark.parametrize("identifier", STANDARDS)
def test_parameters_have_the_symbols_of_the_results_file(identifier: str) -> None:
    assert [each.symbol for each in STANDARDS[identifier].quantities] == PARAMETERS[identifier].split()


@pytest.mark.parametrize("identifier", STANDARDS)
def test_columns_by_position(identifier: str) -> None:
    found = [each.symbol for each in STANDARDS[identifier].position_quantities]

    assert found == BY_POSITION[identifier].split()


@pytest.mark.parametrize("identifier", STANDARDS)
def test_no_share_of_good_parts_is_promised(identifier: str) -> None:
    promised = re.compile(r"\b9\d([.,]\d)? ?%")

    assert [text for text in texts(identifier) if promised.search(text)] == []


@pytest.mark.parametrize("identifier", STANDARDS)
def test_no_clause_is_cited_that_nobody_has_read(identifier: str) -> None:
    cited = re.compile(r"\b(clause|Abschnitt)\b")

    assert [text for text in texts(identifier) if cited.search(text)] == []


@pytest.mark.parametrize("identifier", STANDARDS)
def test_formulas_count_positions_by_the_letter_of_the_edition(identifier: str) -> None:
    since_1997 = identifier in {"iso230-2:1997", "iso230-2:2006", "iso230-2:2014"}
    index = "_{i}" if since_1997 else "_{j}"
    formulas = [each.formula for each in STANDARDS[identifier].quantities]

    assert all(index in formula.replace("_{sj}", "_{j}") for formula in formulas)


@pytest.mark.parametrize(
    ("identifier", "symbol", "english", "german"),
    [
        ("iso230-2:1988", "B", "Reversal value", "Umkehrspanne"),
        ("iso230-2:1997", "B", "Reversal value", "Umkehrspanne"),
        ("iso230-2:2006", "B", "Reversal error", "Umkehrspanne"),
        ("iso230-2:2014", "B", "Reversal error", "Umkehrspanne"),
        ("iso230-2:1997", "A", "Bidirectional accuracy of positioning", "Zweiseitige Positioniergenauigkeit"),
        (
            "iso230-2:2014",
            "A",
            "Bidirectional positioning error (accuracy)",
            "Zweiseitige Positionierabweichung (Genauigkeit)",
        ),
        (
            "iso230-2:2006",
            "E",
            "Bidirectional systematic positional deviation",
            "Zweiseitige systematische Positionsabweichung",
        ),
        (
            "iso230-2:2014",
            "E",
            "Bidirectional systematic positioning error",
            "Zweiseitige systematische Positionierabweichung",
        ),
        (
            "iso230-2:2014",
            "M",
            "Mean bidirectional positioning error",
            "Mittlere zweiseitige Positionierabweichung",
        ),
        ("vdi-dgq-3441", "P", "Position uncertainty", "Positionsunsicherheit"),
        ("vdi-dgq-3441", "Pa", "Position deviation", "Positionsabweichung"),
        ("vdi-vde-2617", "U_max", "Largest reversal span", "Größte Umkehrspanne"),
        ("vdi-vde-2617", "Ps_mean", "Mean position spread", "Mittlere Positionsstreubreite"),
        ("nmtba", "O", "Offset", "Nullpunktverschiebung"),
    ],
)
def test_names_follow_the_edition(identifier: str, symbol: str, english: str, german: str) -> None:
    name = quantity(identifier, symbol).name

    assert name.in_language(Language.ENGLISH) == english
    assert name.in_language(Language.GERMAN) == german


@pytest.mark.parametrize(
    ("identifier", "symbol", "formula"),
    [
        ("iso230-2:1988", "R_fwd", "max(6sj↑)"),
        ("iso230-2:2014", "R_fwd", "max(4si↑)"),
        ("iso230-2:1988", "A_bwd", "max(x̄j↓ + 3sj↓) − min(x̄j↓ − 3sj↓)"),
        ("iso230-2:2014", "R", "max(2si↑ + 2si↓ + |Bi|; 4si↑; 4si↓), Bi = x̄i↑ − x̄i↓"),
        ("vdi-dgq-3441", "Ps_max", "max[Psj], Psj = 3(sj↑ + sj↓)"),
        ("vdi-vde-2617", "Ps_max", "max[Psj], Psj = 2(sj↑ + sj↓)"),
        ("vdi-vde-2617", "P", "max[x̄j + ½(Uj + Psj)] − min[x̄j − ½(Uj + Psj)]"),
        ("nmtba", "O", "−½(max[X̄j + ½Psj] + min[X̄j − ½Psj])"),
    ],
)
def test_formulas_carry_the_factor_of_the_standard(identifier: str, symbol: str, formula: str) -> None:
    assert write_plain(quantity(identifier, symbol).formula) == formula


def test_only_the_edition_of_1988_prints_the_mean_reversal_with_the_other_sign() -> None:
    opposite = [
        (identifier, each.symbol)
        for identifier, standard in STANDARDS.items()
        for each in standard.quantities
        if each.printed_sign != 1
    ]

    assert opposite == [("iso230-2:1988", "B_mean")]
    assert write_plain(quantity("iso230-2:1988", "B_mean").formula) == "(1/n) · ∑ (x̄j↓ − x̄j↑)"


def test_the_opposite_sign_is_said_in_a_note() -> None:
    notes = [note.in_language(Language.ENGLISH) for note in STANDARDS["iso230-2:1988"].notes]

    assert any("B̄ is printed with the sign of this edition" in note for note in notes)


def test_a_measuring_machine_measures_and_a_machine_tool_makes_parts() -> None:
    made = quantity("vdi-dgq-3441", "P").meaning.in_language(Language.ENGLISH)
    measured = quantity("vdi-vde-2617", "P").meaning.in_language(Language.ENGLISH)

    assert "part" in made
    assert "part" not in measured
    assert "measured" in measured


def test_parameters_are_grouped_as_the_standards_group_them() -> None:
    groups = {
        (group, each.symbol[0] + each.symbol[1:2].replace("_", ""))
        for standard in STANDARDS.values()
        for each in standard.quantities
        for group in [each.group]
    }

    assert groups == {
        (QuantityGroup.COMPOSITE, "A"),
        (QuantityGroup.COMPOSITE, "P"),
        (QuantityGroup.SYSTEMATIC, "E"),
        (QuantityGroup.SYSTEMATIC, "M"),
        (QuantityGroup.SYSTEMATIC, "B"),
        (QuantityGroup.SYSTEMATIC, "Pa"),
        (QuantityGroup.SYSTEMATIC, "U"),
        (QuantityGroup.SYSTEMATIC, "O"),
        (QuantityGroup.RANDOM, "R"),
        (QuantityGroup.RANDOM, "Ps"),
    }
