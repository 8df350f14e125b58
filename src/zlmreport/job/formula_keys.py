"""Keys of an effect that is written as a formula: parameters, units, ranges, needs, words."""

from __future__ import annotations

from collections.abc import Mapping
from enum import StrEnum
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Field, PlainSerializer, PlainValidator, WithJsonSchema, field_validator

from zlmreport.errors import did_you_mean
from zlmreport.job.types import Finite, JobPart, Options, Positive, Text, optional
from zlmreport.language import Language, Words
from zlmreport.measurement.measurand import OF_SYMBOLS, POSITIONING, Measurand

_LANGUAGES = tuple(language.value for language in Language)
_ENGLISH = Language.ENGLISH.value
_NAME = r"^[a-z][a-z0-9]*(-[a-z0-9]+)*$"


def _take_phrase(value: Any) -> Words:
    """Return a text in every language; one that is written once is English, or alike in all of them."""
    if isinstance(value, Words):
        return value
    if isinstance(value, Mapping):
        lacking = [name for name in {_ENGLISH, *value} if not str(value.get(name) or "").strip()]
        unknown = [name for name in value if name not in _LANGUAGES]
        if lacking or unknown:
            strange = f"{unknown[0]} is none of {', '.join(_LANGUAGES)}" if unknown else ""
            wrong = strange or f"{', '.join(sorted(lacking))} is missing"
            raise ValueError(f"a text is {{en: …, de: …}}; {wrong}")
        return Words.of({name: " ".join(str(text).split()) for name, text in value.items()})
    if not isinstance(value, str) or not value.strip():
        raise ValueError("a text is expected, or {en: …, de: …}")
    return Words(" ".join(value.split()))


def _write_stated(words: Words) -> str | dict[str, str]:
    texts = {name: text for name in _LANGUAGES if (text := getattr(words, name)) is not None}
    return words.en if set(texts) == {_ENGLISH} else texts


#: A text in several languages, ``{en: …, de: …}``, the English one first of all; or one text alone.
Phrase: TypeAlias = Annotated[
    Words,
    PlainValidator(_take_phrase),
    PlainSerializer(_write_stated),
    WithJsonSchema(
        {
            "anyOf": [
                {"type": "string"},
                {
                    "type": "object",
                    "properties": {name: {"type": "string"} for name in _LANGUAGES},
                    "required": [_ENGLISH],
                    "additionalProperties": False,
                },
            ]
        }
    ),
]
#: A parameter of an effect of the model.
ParameterName: TypeAlias = Annotated[str, Field(pattern=r"^[a-z][a-z0-9-]*\.\w+$")]

#: Units of parameters on a linear axis, and what each is on a rotary one.
UNITS_OF_PARAMETERS: Mapping[str, str] = {
    "um": "arcsec",
    "mm": "deg",
    "um/m": "arcsec/deg",
    "um/K": "arcsec/K",
    "um/(m K)": "arcsec/(deg K)",
    "deg": "deg",
    "s": "s",
    "1": "1",
}
_SPELLINGS = (("µ", "u"), ("μ", "u"), ("″", "arcsec"), ("°", "deg"), ("*", " "), ("·", " "))


class Search(StrEnum):
    """What a searched parameter is, and so which of its values a search begins with."""

    FADING_LENGTH = "fading-length"  #: Shares of the travel, from a hundredth to a fifth.
    TIME_CONSTANT = "time-constant"  #: Shares of the test's time, from a twentieth to one and a half.
    DRIFT_TIME = "drift-time"  #: The same, and so long a one that what drifts does so steadily.
    WAVE_LENGTH = "wave-length"  #: From one wave in the travel to half as many as there are targets.
    WAVE_TIME = "wave-time"  #: From one wave in the test to nine, with many readings more, up to 24.
    JOINT = "joint"  #: Between any two targets but the outermost.
    MOMENT = "moment"  #: Between any two readings but the outermost.
    KINK = "kink"  #: Anywhere in the travel but near its ends.
    WHOLE_NUMBER = "whole-number"  #: As many waves a turn as the targets can tell.
    RUN = "run"  #: Any run but the first.
    PAUSE = "pause"  #: The first reading after any of the three longest pauses.
    PLACE = "place"  #: Anywhere in the travel, its ends too.
    WIDTH = "width"  #: Shares of the travel, from a fifth to nearly a half.
    PEAK = "peak"  #: Anywhere in the test's time.
    SPELL = "spell"  #: Shares of the test's time, from a third to four fifths.
    LAG = "lag"  #: Shares of the test's time, from a fiftieth to a half.
    FIXED_POINT = "fixed-point"  #: Places in the travel but the zero of the axis.


class Meaning(JobPart):
    """A value that has a name of its own."""

    between: tuple[Finite, Finite] = Field(description="From where to where the value has it.")
    says: Phrase = Field(description="What happened then.")


class Possible(JobPart):
    """Between which values physics allows a parameter; others are not asked for, but refused."""

    least: Finite | Text | None = optional(
        "The least value, or a formula of it: temperature_rise is the largest logged rise in K."
    )
    most: Finite | Text | None = optional("The largest value, or a formula of it.")
    because: Phrase = Field(description="Why, as a sentence without a full stop.")


class Instead(JobPart):
    """Values that are tried although a key of the axis states another: the key may be wrong."""

    key: Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")] = Field(
        description="The key of the effect that asks for it: stated (the usual), or other."
    )
    description: Text = Field(description="What the key chooses.")
    values: tuple[Finite, ...] = Field(description="The values.", min_length=1)


class FormulaParameter(JobPart):
    """A parameter of a formula."""

    unit: Text = Field(
        "1",
        description="Of its value: um, mm, um/m, um/K, um/(m K), s, deg or 1; on a rotary axis arcsec, deg, "
        "arcsec/deg, arcsec/K, arcsec/(deg K), s or 1.",
        examples=["um"],
    )
    range: tuple[Finite | None, Finite | None] | None = optional(
        "Smallest and largest usual value; a parameter that is no factor of a whole term "
        "must have them, and is searched between them."
    )
    value: Finite | None = optional("The value, where it is known and not estimated.")
    equals: ParameterName | None = optional(
        "The parameter of another effect that it is: both are estimated as one.", example="screw-pitch.period"
    )
    notation: Text | None = optional("As it is printed, p_{0}; its name without it.")
    meaning: Phrase | None = optional("What it is, in words.")
    search: Search | None = optional(
        "What it is that is searched: where a search begins follows from the test."
    )
    step: Positive | None = optional(
        "Between the ends of the range only multiples of it from the first make sense."
    )
    values: tuple[Finite, ...] = Field((), description="The only values that make sense.")
    stated: Text | None = optional(
        "The key of the axis that states it, or a formula of such keys; then it is not searched.",
        example="screw_pitch",
    )
    expected: Finite | None = optional("The value that it has if the effect is the cause, for comparison.")
    usual: tuple[Finite, Finite] | None = optional(
        "Smallest and largest value that machines have; its range without it."
    )
    usual_on_rotary: tuple[Finite, Finite] | None = optional(
        "The same on a rotary axis, in arcsec or deg; without it as many radians as metres."
    )
    question: Phrase | None = optional(
        "What is asked of a value far beyond what is usual; {value} and {times} stand for it and "
        "for how many times the usual it is."
    )
    question_below: Phrase | None = optional(
        "The same of a value that is too small, where it is another question."
    )
    meanings: tuple[Meaning, ...] = Field((), description="Values that have a name of their own.")
    possible: Possible | None = optional("Between which values physics allows it.")
    instead: Instead | None = optional("Values that are tried although a key states another.")

    @property
    def spelled(self) -> str:
        """The unit as `UNITS_OF_PARAMETERS` has it."""
        return _spell_unit(self.unit)

    @field_validator("unit")
    @classmethod
    def _is_a_unit(cls, unit: str) -> str:
        if _spell_unit(unit) not in {*UNITS_OF_PARAMETERS, *UNITS_OF_PARAMETERS.values()}:
            there_are = ", ".join(UNITS_OF_PARAMETERS)
            raise ValueError(f"{unit!r} is no unit of a parameter; there are {there_are}")
        return unit

    @field_validator("range")
    @classmethod
    def _rises(
        cls, ends: tuple[float | None, float | None] | None
    ) -> tuple[float | None, float | None] | None:
        if ends is not None and None not in ends and not ends[0] < ends[1]:  # type: ignore[operator]
            raise ValueError("the first end of its range must be less than the second")
        return ends


def _spell_unit(unit: str) -> str:
    for found, written in _SPELLINGS:
        unit = unit.replace(found, written)
    return " ".join(unit.split())


class Needs(JobPart):
    """What an effect needs beside what stands in its formula: logged columns, keys of the axis, time."""

    axis: Literal["linear", "rotary"] | None = optional(
        "The kind of axis; without it any that its units fit."
    )
    both_directions: bool = Field(default=False, description="Targets approached from both directions.")
    targets: int | None = optional("The least number of target positions.", ge=2)
    runs: int | None = optional("The least number of runs.", ge=2)
    whole_period: Literal["screw_pitch", "signal_period", "scale_element", "pole_pitch"] | None = optional(
        "The key of the axis whose period the measured travel must hold."
    )


class Harmonics(JobPart):
    """The harmonics of a wave: the key ``harmonics`` of the effect chooses among them."""

    usual: tuple[int, ...] = Field(description="Those that a job means which names none.", min_length=1)
    tried: tuple[tuple[int, ...], ...] = Field(description="Those that a diagnosis tries.", min_length=1)
    further: tuple[tuple[int, ...], ...] = Field(
        (), description="Those that it tries where the effect stands in the model with fewer."
    )


class FormKey(JobPart):
    """A key of the effect that chooses between forms of it."""

    name: Annotated[str, Field(pattern=r"^[a-z][a-z0-9_]*$")] = Field(
        description="The key, as jobs write it."
    )
    description: Text = Field(description="What it chooses.")
    choices: dict[str, dict[str, Text]] = Field(
        description="Its values, the usual one first; and what names of the formula stand for with each.",
        min_length=2,
    )


class FormulaKeys(Options):
    """An effect that is written as a formula."""

    name: Annotated[str, Field(pattern=_NAME, max_length=60)] = Field(
        description="What the job and the results call it: small letters, digits and hyphens.",
        examples=["my-wave"],
    )
    parameters: dict[str, FormulaParameter] = Field(
        description="Its parameters, each with its unit and its range.", min_length=1, max_length=20
    )
    formula: Text = Field(
        description="The deviation, of the parameters and P (target position), D (direction, +1 or −1), t "
        "(time from the first reading), run, v (feed), since_reversal (distance since the last reversal), "
        "middle and half_travel (of what was measured), travel_first and travel_last, turn (360°), air_index "
        "(change of the refractive index), compensation (the table's value; compensation_next, "
        "compensation_before), angular_error, keys of the axis (screw_pitch, signal_period, scale_element) "
        "and logged columns by their names (temperatures in °C); with + − * / ^, pi, sin, cos, tan, atan, "
        "exp, log, tanh, sqrt, abs, floor, min, max, sign and step; a*wave(P/L) is a wave of any phase. It "
        "is parsed, never executed.",
        examples=["a*sin(2*pi*P/L)"],
    )
    title: Phrase | None = optional("In words.")
    remedy: Phrase | None = optional("What to do about it, and what a compensation can do.")
    physics: Phrase | None = optional("What happens: how the cause becomes a deviation.")
    equation: Text | None = optional("As it is printed; the formula without it.")
    look: Phrase | None = optional("What it looks like in the residuals.")
    needs: Needs = Field(default_factory=Needs, description="What it needs of a test.")
    taken_for: dict[str, Phrase] = Field(
        {}, description="Effects that look alike, each with the measurement that tells the two apart."
    )
    contains: tuple[Text, ...] = Field(
        (), description="Effects that are always part of it: they cannot stand beside it in a model."
    )
    ranges_from: Phrase | None = optional("Where the ranges of its parameters come from.")
    measurands: tuple[Text, ...] = Field(
        (POSITIONING.identifier,), description="What it acts on.", examples=[["positioning", "straightness"]]
    )
    harmonics: Harmonics | None = optional("Of its wave; without it the first alone.")
    keys: tuple[FormKey, ...] = Field((), description="Keys that choose between forms of it.")
    common: bool = Field(
        default=False,
        description="Whether hardly a machine is without it: it then needs less evidence than what is rare.",
    )
    several: bool = Field(
        default=False, description="Whether it may stand in a model more than once, as joint, joint-2 …"
    )
    known: Literal["published", "derived", "experience"] = Field(
        "experience",
        description="How its form is known: from a publication, by derivation, or by experience without one.",
    )
    source: Phrase | None = optional("The publication, or what it is derived from.")

    def __hash__(self) -> int:
        """Let a fit be kept by what its model means."""
        return hash((self.name, self.formula, *sorted(self.parameters)))

    @field_validator("measurands")
    @classmethod
    def _are_measured(cls, names: tuple[str, ...]) -> tuple[str, ...]:
        for name in names:
            if name not in OF_SYMBOLS:
                raise ValueError(
                    f"{name!r} is nothing that is measured; {did_you_mean(name, list(OF_SYMBOLS))}"
                )
        return names

    @property
    def acts_on(self) -> tuple[Measurand, ...]:
        """The measurands on which it acts."""
        return tuple(OF_SYMBOLS[name] for name in self.measurands)
