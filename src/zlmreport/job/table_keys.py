"""The keys by which data sources that read tables let a job say what a table does not say itself."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, ClassVar, Literal, Self

from pydantic import AfterValidator, Field, field_validator, model_validator

from zlmreport.errors import did_you_mean
from zlmreport.job.types import JobPath, Options, optional
from zlmreport.language.formatting import DecimalSign
from zlmreport.measurement.columns import Cells, find_decimal_sign, fold, read_heading
from zlmreport.measurement.sentinels import find_sentinels
from zlmreport.measurement.table import BAR, BLANKS, THOUSANDS, TextTable, read_table
from zlmreport.measurement.text_file import read_text, require_known_encoding
from zlmreport.measurement.units import Scale, Unit, find_unit_named

_DELIMITERS = {"comma": ",", "semicolon": ";", "tab": "\t", "bar": BAR, "blanks": BLANKS}


class TablePlace(Options):
    """Where a table stands in its file."""

    sheet: str | None = optional("Of a workbook: the name of the sheet that holds the table.")
    skip_rows: Annotated[int, Field(ge=0)] | None = optional(
        "Rows of the file above the header that are not read."
    )
    ends_before: str | None = optional(
        "The table ends before the row that begins so: Mean, or whatever stands below it.", min_length=1
    )
    lines: tuple[Annotated[int, Field(ge=1)], Annotated[int, Field(ge=1)]] | None = optional(
        "First line (the header) and last line of the table, where the file holds more; in place "
        "of skip_rows and ends_before."
    )

    @model_validator(mode="after")
    def _place_is_stated_once(self) -> Self:
        if self.lines and (self.skip_rows is not None or self.ends_before is not None):
            raise ValueError("'lines' stands in place of 'skip_rows' and 'ends_before'; remove it, or them")
        if self.lines and self.lines[0] >= self.lines[1]:
            raise ValueError("'lines' names the header's line and the last line; the second is the larger")
        return self


class TableOptions(TablePlace):
    """Where a table is, and what it does not say itself: the base of the keys of a source of tables.

    A data source says which columns it knows, the units that they may have, and what a header looks like.
    """

    column_names: ClassVar[tuple[str, ...]] = ()
    column_units: ClassVar[Mapping[str, Mapping[str, Unit | Scale]]] = {}
    header_example: ClassVar[str] = ""

    file: JobPath = Field(description="The table, relative to the file that names it.")
    transposed: bool = Field(
        default=False,
        description="Whether the table lies on its side: a column of the file is a row of the table.",
    )
    header: tuple[str, ...] = Field(
        (), description="Names of the columns, where the file has no row of names: [target, deviation]."
    )
    header_rows: Literal[1, 2] = Field(
        1,
        description="2: a name is made of two cells, such as 'Run 1' over 'up'; the upper one holds for "
        "those to its right that are empty.",
    )
    columns: dict[str, str] = Field(default_factory=dict, description="The file's own names of columns.")
    ignore: tuple[str, ...] = Field((), description="Columns of the file that are not read, by name.")
    missing: tuple[str, ...] = Field(
        (), description="What stands in a cell whose reading is missing, beside nothing: ['---', n/a]."
    )
    units: dict[str, str] = Field(
        default_factory=dict,
        description="Units by column. Without it the unit behind the number, in the header's brackets or in "
        "a row below the header holds.",
    )
    delimiter: Literal[",", ";", "\t", "comma", "semicolon", "tab", "bar", "blanks"] | None = optional(
        "What parts the columns; told apart if not stated, but for blanks."
    )
    decimal: Literal[".", ",", "point", "comma"] | None = optional(
        "The decimal sign; told apart if not stated."
    )
    thousands: Literal["point", "comma", "blank", "apostrophe"] | None = optional(
        "What parts groups of three digits, as in 1.250,5."
    )
    encoding: Annotated[str, AfterValidator(require_known_encoding)] | None = optional(
        "Encoding of the file, if it is not UTF-8: cp1252, gbk, utf-16."
    )

    @classmethod
    def knows_column(cls, name: str) -> bool:
        """Whether a job may name a column so."""
        return fold(name) in cls.column_names

    @field_validator("columns")
    @classmethod
    def _columns_are_known(cls, columns: dict[str, str]) -> dict[str, str]:
        for name in columns:
            if not cls.knows_column(name):
                raise ValueError(
                    f"{name!r} is no column of a measurement file; {did_you_mean(name, cls.column_names)}"
                )
        return columns

    @field_validator("units")
    @classmethod
    def _units_are_of_columns(cls, units: dict[str, str]) -> dict[str, str]:
        for name, spelling in units.items():
            if name not in cls.column_units:
                near = did_you_mean(name, list(cls.column_units))
                raise ValueError(f"{name!r} is no column with a unit; {near}")
            find_unit_named(spelling, cls.column_units[name])
        return units

    @model_validator(mode="after")
    def _notation_is_one(self) -> Self:
        if self.header and self.header_rows > 1:
            raise ValueError("'header' names the columns of a file without a header; remove 'header_rows'")
        if self.thousands and self.decimal and THOUSANDS[self.thousands] == self.stated_decimal_sign:
            raise ValueError(f"'decimal' and 'thousands' are both {self.thousands}; one of them is another")
        return self

    @property
    def stated_delimiter(self) -> str | None:
        """The delimiter that the job states."""
        return _DELIMITERS.get(self.delimiter, self.delimiter) if self.delimiter else None

    @property
    def stated_decimal_sign(self) -> DecimalSign | None:
        """The decimal sign that the job states: by its name, or as the one that parts no thousands."""
        if self.decimal is not None:
            return DecimalSign.COMMA if self.decimal in {",", "comma"} else DecimalSign.POINT
        return {"point": DecimalSign.COMMA, "comma": DecimalSign.POINT}.get(self.thousands or "")

    def names_column(self, text: str) -> bool:
        """Whether a header is the name of a column that the source knows, or of which the job speaks."""
        named = read_heading(text)
        return fold(named.name) in self.column_names or any(
            named.is_called(name) for name in (*self.columns.values(), *self.ignore)
        )

    def read_table(self, names_column: Callable[[str], bool] | None = None) -> TextTable:
        """Read the table; raise `InputError` if there is none, `AccessError` if the file cannot be read.

        `names_column`: Whether a header is known, where more are than `names_column` of these keys tells.
        """
        text = read_text(self.file, self.encoding, self.sheet, keeps_long_lines=True)
        return read_table(text, self, names_column or self.names_column)

    def cells_of(self, table: TextTable, numbers: Sequence[int]) -> Cells:
        """Return what reads the cells of a table; `numbers` are the columns whose numbers have decimals."""
        thousands = THOUSANDS[self.thousands] if self.thousands else ""
        sign = self.stated_decimal_sign or find_decimal_sign(table, numbers, thousands)
        missing = frozenset(word.casefold() for word in self.missing)
        sentinels = {
            index: found
            for index in numbers
            if (found := find_sentinels((row.cells[index] for row in table.rows), sign))
        }
        return Cells(table, sign, thousands, missing, sentinels)
