"""Numbers with units, and plain tables, for what is said of a machine."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from zlmreport.document.blocks import Align, Cell, Column, Explained, RowGroup, Table
from zlmreport.language import Words
from zlmreport.language.formatting import round_pair
from zlmreport.language.writer import LanguageWriter
from zlmreport.measurement.units import MICROMETRE, MILLIMETRE, Unit, write_behind
from zlmreport.model.effects.circle_effect import CircleEffect


@dataclass(frozen=True, slots=True)
class Sayer(LanguageWriter):
    """Says words and numbers in one language."""

    def __call__(self, words: Words) -> str:
        """Return a phrase."""
        return self.say(words)

    def explain_effect(self, effect: CircleEffect) -> Explained:
        """Return an effect as machine files name it, and what it is."""
        return Explained(effect.identifier, self(effect.title))

    def write_micrometres(self, value: float) -> str:
        """Return a length in m as µm, without the unit."""
        return self.write_number(MICROMETRE.from_si(value))

    def write_millimetres(self, value: float) -> str:
        """Return a position in m as mm, without the unit."""
        return self.write_stated(round(MILLIMETRE.from_si(value), 3) + 0.0)

    def write_span(self, low: float, high: float) -> str:
        """Return from where to where, m, as mm without the unit."""
        return f"{self.write_millimetres(low)}–{self.write_millimetres(high)}"

    def write_pair(self, value: float, u: float, unit: Unit) -> str:
        """Return a value and its uncertainty, SI, in a unit that is not written; without one the value."""
        if not u:
            return self.write_number(unit.from_si(value))
        return " ± ".join(round_pair(unit.from_si(value), unit.from_si(u), self.language.decimal_sign))

    def write_quantity(self, value: float, unit: Unit) -> str:
        """Return a value, SI, with its unit."""
        return f"{self.write_general(float(f'{unit.from_si(value):.3g}'))}{write_behind(unit.symbol)}"


def make_right_column(heading: str, unit: str = "") -> Column:
    """Return a column of numbers."""
    return Column(heading, unit, Align.RIGHT)


def make_plain_table(caption: str, columns: Iterable[Column], rows: Iterable[tuple[Cell, ...]]) -> Table:
    """Return a table without groups."""
    return Table(caption, tuple(columns), (RowGroup(tuple(rows)),))
