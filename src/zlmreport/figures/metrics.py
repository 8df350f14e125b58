"""How far a text moves the pen: advance widths, kerning and ligatures of the bundled faces.

The font files tell it, and no library that draws is needed; each is read once, when its first text is set.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache, lru_cache
from importlib.resources import files
from itertools import pairwise
from pathlib import Path
from typing import Any
from unicodedata import normalize

from zlmreport.figures.canvas import Face, Label, Run
from zlmreport.quantities.formatting import Span, spans

_NO_GLYPH = ".notdef"


@cache
def font_file(face: Face) -> Path:
    """Return the path of a face's file: fonts of the system are never used."""
    return Path(str(files("zlmreport_templates").joinpath("fonts", f"{face.value}.ttf")))


@lru_cache(maxsize=4096)
def advance(text: str, face: Face) -> float:
    """Return how far a text of size 1 moves the pen."""
    return _metrics(face).advance(text)


def mark_offset(letter: str, mark: str, face: Face) -> tuple[float, float]:
    """Return how far right of a letter's pen, and above it, that of a mark on it stands, at size 1."""
    return _metrics(face).mark_offset(letter, mark)


def has_letter(letter: str, face: Face) -> bool:
    """Return whether a face has a shape for a letter."""
    return _metrics(face).has_letter(letter)


@cache
def _metrics(face: Face) -> _Metrics:
    return _Metrics(font_file(face))


class _Metrics:
    """What a face says of the widths of its glyphs, which have names, in parts of an em."""

    def __init__(self, path: Path) -> None:
        from fontTools.ttLib import TTFont  # noqa: PLC0415 - slow to load

        font = TTFont(path, lazy=True)
        self._em = font["head"].unitsPerEm
        self._glyphs = font.getBestCmap()
        self._widths = font["hmtx"].metrics
        # A ligature of this typeface joins two letters.
        self._ligatures = {
            (first, ligature.Component[0]): ligature.LigGlyph
            for lookup in _lookups(font["GSUB"].table, "liga")
            for subtable in lookup
            for first, ligatures in subtable.ligatures.items()
            for ligature in ligatures
        }
        self._marks = [each for lookup in _lookups(font["GPOS"].table, "mark") for each in lookup]
        self._pairs = [
            [_Pairs(subtable) for subtable in lookup] for lookup in _lookups(font["GPOS"].table, "kern")
        ]

    def has_letter(self, letter: str) -> bool:
        """Return whether there is a glyph for a letter."""
        return ord(letter) in self._glyphs

    def advance(self, text: str) -> float:
        """Return how far a text of size 1 moves the pen."""
        glyphs = self._ligated(
            [self._glyphs.get(ord(letter), _NO_GLYPH) for letter in normalize("NFC", text)]
        )
        units = sum(self._widths[glyph][0] for glyph in glyphs)
        units += sum(self._kerning(first, second) for first, second in pairwise(glyphs))
        return float(units / self._em)

    def mark_offset(self, letter: str, mark: str) -> tuple[float, float]:
        """Return how far right of a letter's pen, and above it, that of its mark stands."""
        base_glyph, mark_glyph = self._glyphs[ord(letter)], self._glyphs[ord(mark)]
        for subtable in self._marks:
            if mark_glyph in subtable.MarkCoverage.glyphs and base_glyph in subtable.BaseCoverage.glyphs:
                record = subtable.MarkArray.MarkRecord[subtable.MarkCoverage.glyphs.index(mark_glyph)]
                base = subtable.BaseArray.BaseRecord[subtable.BaseCoverage.glyphs.index(base_glyph)]
                anchor, own = base.BaseAnchor[record.Class], record.MarkAnchor
                return (
                    (anchor.XCoordinate - own.XCoordinate) / self._em,
                    (anchor.YCoordinate - own.YCoordinate) / self._em,
                )
        raise LookupError(f"no place for U+{ord(mark):04X} on {letter!r}")

    def _ligated(self, glyphs: Sequence[str]) -> list[str]:
        found: list[str] = []
        for glyph in glyphs:
            ligature = self._ligatures.get((found[-1], glyph)) if found else None
            if ligature:
                found[-1] = ligature
            else:
                found.append(glyph)
        return found

    def _kerning(self, first: str, second: str) -> int:
        """Return how much closer two glyphs stand: of each lookup, the first subtable that knows them."""
        found = ((pairs.kerning(first, second) for pairs in lookup) for lookup in self._pairs)
        return sum(next((units for units in of_lookup if units is not None), 0) for of_lookup in found)


class _Pairs:
    """One subtable of kerning: of pairs of glyphs, or of pairs of their classes."""

    def __init__(self, subtable: Any) -> None:
        self._subtable = subtable
        self._first = {glyph: index for index, glyph in enumerate(subtable.Coverage.glyphs)}

    def kerning(self, first: str, second: str) -> int | None:
        """Return the units by which the first glyph's advance changes; None where the subtable is silent."""
        index = self._first.get(first)
        if index is None:
            return None
        if self._subtable.Format == 1:
            records = self._subtable.PairSet[index].PairValueRecord
            value = next((each.Value1 for each in records if each.SecondGlyph == second), None)
            return None if value is None else value.XAdvance
        of_first = self._subtable.ClassDef1.classDefs.get(first, 0)
        of_second = self._subtable.ClassDef2.classDefs.get(second, 0)
        value = self._subtable.Class1Record[of_first].Class2Record[of_second].Value1
        return value.XAdvance if value else 0


def _lookups(table: Any, feature: str) -> Iterator[Sequence[Any]]:
    """Yield the subtables of each lookup of a feature, which is the same for all scripts of this typeface."""
    record = next(each for each in table.FeatureList.FeatureRecord if each.FeatureTag == feature)
    for index in record.Feature.LookupListIndex:
        yield table.LookupList.Lookup[index].SubTable


#: Subscripts, as parts of the type size: their size, and how far they lie below the line.
_SUBSCRIPT_SIZE = 0.72
_SUBSCRIPT_DROP = 0.2


def plain_label(text: str, size: float, face: Face = Face.REGULAR) -> Label:
    """Return a line of words or a number."""
    return Label((Run(text, face, size, 0.0, 0.0),), size * advance(text, face), size)


@lru_cache(maxsize=1024)
def symbol_label(notation: str, size: float) -> Label:
    """Return a symbol or a formula as `zlmreport.quantities.formatting` writes it."""
    runs = []
    end = 0.0
    for span in spans(notation):
        run = _run(span, size, end)
        runs.append(run)
        end += run.size * advance(run.text, run.face)
    return Label(tuple(runs), end, size)


def _run(span: Span, size: float, start: float) -> Run:
    face = Face.ITALIC if span.italic else Face.REGULAR
    if span.subscript:
        return Run(span.text, face, size * _SUBSCRIPT_SIZE, start, size * _SUBSCRIPT_DROP)
    return Run(span.text, face, size, start, 0.0)
