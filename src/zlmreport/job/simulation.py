"""A simulation file: its keys in users' units, how many targets and readings it may have; checked."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

from pydantic import AfterValidator, Field

from zlmreport.errors import InputError, Place, Problem, count_in_words, quoted
from zlmreport.job.axis import convert_axis_to_si
from zlmreport.job.contradictions import validate
from zlmreport.job.document_keys import Number
from zlmreport.job.effect_choices import EffectChoice, choose_effects_of
from zlmreport.job.evaluation_keys import AxisModelKeys
from zlmreport.job.extends import SIMULATION, read_composition, refuse_other_format
from zlmreport.job.measurement_keys import AxisKeys
from zlmreport.job.tree import Keys, find_at, find_key_place, place_of
from zlmreport.job.types import Finite, JobPart, NotNegative, Positive, Text, optional
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.provenance import SourceFile

if TYPE_CHECKING:
    from zlmreport.plugin.registry import Registry

Share = Annotated[float, Field(ge=0, lt=1)]


def _take_file_name(text: str) -> str:
    if "/" in text or "\\" in text or text in {".", ".."}:
        raise ValueError(f"{quoted(text)} is no file's name; the folder comes with --output")
    return text


FileName = Annotated[Text, AfterValidator(_take_file_name)]


class TargetKeys(JobPart):
    """The target positions: a number of them at random fractions of a period, or a list."""

    count: int | None = optional("Number of targets over the travel.", example=21, ge=2, le=2000)
    fractions_of: NotNegative | None = optional(
        "Period of whose random fractions the targets lie, mm or degrees; 0 for even targets. "
        "Without it axis.screw_pitch, or else even targets."
    )
    positions: list[Finite] | None = optional(
        "Instead: all targets, rising, mm or degrees.", min_length=1, max_length=2000
    )


class CourseKeys(JobPart):
    """A condition during the test."""

    start: Finite = Field(description="At the first reading.", examples=[20.4])
    end: Finite | None = optional(
        "At the last reading; with a time constant, what it tends to. Without it: start."
    )
    time_constant: Positive | None = optional("Of the way from start to end, s.")
    swing: NotNegative = Field(0.0, description="Amplitude of a sine that is added.")
    swing_period: Positive = Field(900.0, description="Its period, s.")
    sensor_noise: NotNegative = Field(0.0, description="Standard deviation of what is logged.")
    resolution: NotNegative = Field(0.0, description="Of what is logged.")
    logged: bool = Field(default=True, description="Whether it is logged; it acts in any case.")


class SimulatedNoiseKeys(JobPart):
    """Everything random about the readings: standard deviations, micrometres (arc seconds)."""

    reading: NotNegative = Field(0.0, description="Of a single reading.", examples=[0.5])
    unequal: Share = Field(0.0, description="Share of itself by which it differs from target to target.")
    position: NotNegative = Field(0.0, description="Fixed in position.")
    position_and_direction: NotNegative = Field(
        0.0, description="Fixed in position, of opposite sign in the two directions."
    )
    run: NotNegative = Field(0.0, description="Of a whole run.")
    drift: NotNegative = Field(0.0, description="Slow random drift.")
    drift_time: Positive = Field(600.0, description="Time over which the drift forgets itself, s.")
    outlier_share: Share = Field(0.0, description="Probability that a reading is an outlier.")
    outlier_size: NotNegative = Field(0.0, description="How far an outlier is off.")
    missing_share: Share = Field(0.0, description="Probability that a reading is missing.")
    resolution: NotNegative = Field(0.0, description="Of the instrument.")


class SimulationOutput(JobPart):
    """The files."""

    readings: FileName | None = optional(
        "The table of readings; without it the simulation file's own name with .csv."
    )
    job: FileName = Field("job.yaml", description="A job that evaluates the readings.")
    number: Number = Field("SIMULATION-1", description="Number of that job's report.")


class SimulationKeys(JobPart):
    """A simulation file: an axis, a test of it, and what is to be found."""

    schema_: Literal["zlmreport/simulation/1"] = Field(
        alias="schema", description="Version of this format.", examples=["zlmreport/simulation/1"]
    )
    extends: list[Text] | Text | None = optional(
        "Files whose keys this one builds on; paths are relative to this file."
    )
    seed: int = Field(
        ge=0, description="Of everything random: the same file gives the same test.", examples=[1]
    )
    axis: AxisKeys = Field(description="The axis.", examples=[{"name": "X", "travel": [0, 1000]}])
    targets: TargetKeys = Field(description="The target positions.", examples=[{"count": 21}])
    method: Literal["linear", "unidirectional", "pendulum", "quasi-pilgrim"] = Field(
        "linear", description="Positioning method."
    )
    runs: int = Field(5, ge=1, le=1000, description="Readings of each target in each direction.")
    overrun: Positive = Field(
        5.0,
        ge=0.001,
        description="How far beyond a target the axis turns round, mm or degrees, at least 0.001.",
    )
    feed: Positive = Field(2000.0, ge=0.001, description="Feed, mm/min or degrees/min, at least 0.001.")
    dwell: NotNegative = Field(5.0, description="Time at rest before each reading, s.")
    effects: list[str | dict[str, dict[str, Any] | None]] = Field(
        [],
        description="Effects with the values of their parameters, in users' units.",
        examples=[[{"backlash": {"lost_motion": 4}}]],
    )
    noise: SimulatedNoiseKeys = Field(
        default_factory=SimulatedNoiseKeys, description="Everything random about the readings."
    )
    conditions: dict[str, CourseKeys] = Field(
        {},
        description="By the names of measurement files: axis_temperature, air_pressure …",
        examples=[{"axis_temperature": {"start": 20.4}}],
    )
    time_logged: bool = Field(default=True, description="Whether the readings carry times.")
    model: AxisModelKeys | None = optional("The error model that the written job begins with.")
    output: SimulationOutput = Field(default_factory=SimulationOutput, description="The files.")


#: In both directions together; a file of readings may have some more lines.
MOST_READINGS = 200_000


@dataclass(frozen=True, slots=True)
class SimulationFile:
    """A checked simulation file."""

    path: Path  #: The file.
    keys: SimulationKeys  #: What it says, in the users' units.
    axis: Axis  #: The axis in SI.
    effects: tuple[EffectChoice, ...]  #: Effects with their parameters.
    source: SourceFile  #: Name and digest of the file.
    tree: Keys  #: What it says, value by value, with the places.

    def place_of(self, *steps: str | int) -> Place:
        """Return where a key stands; of one that is missing, its nearest parent's place."""
        return place_of(self.tree, steps)


def load_simulation(path: Path, registry: Registry, content: bytes | None = None) -> SimulationFile:
    """Read a simulation file and check all that can be checked without simulating.

    Raises `InputError` with every mistake, in the order of their places; `AccessError` if it, or a file that
    it names, cannot be read.
    """
    composition = read_composition(path, content)
    tree = composition.keys
    refuse_other_format(tree, SIMULATION)
    problems: list[Problem] = []
    keys = validate(SimulationKeys, tree, problems)
    effects = choose_effects_of(find_at(tree, ("effects",)), registry, problems, within="effects")
    choose_effects_of(find_at(tree, ("model", "effects")), registry, problems, within="model.effects")
    if keys:
        problems.extend(_find_contradictions(keys, tree))
    if problems or keys is None:
        raise InputError(sorted(set(problems)))
    return SimulationFile(path, keys, convert_axis_to_si(keys.axis), effects, composition.files[0], tree)


def _find_contradictions(keys: SimulationKeys, tree: Keys) -> Iterator[Problem]:
    """Yield what no single key shows to be wrong."""
    travel, targets = keys.axis.travel, keys.targets
    if travel and travel[0] >= travel[1]:
        place = find_key_place(tree, ("axis", "travel"))
        yield Problem(place, "axis.travel: the first position of the travel must be less than the last")
    if (targets.count is None) == (targets.positions is None):
        place = find_key_place(tree, ("targets",))
        yield Problem(
            place, "targets: either a count of targets, or their positions; for example {count: 21}"
        )
    elif targets.positions is None and travel is None:
        place = find_key_place(tree, ("axis",))
        yield Problem(place, "axis.travel is missing: targets are spread over it; for example [0, 1000]")
    number = len(targets.positions or ()) or targets.count or 0
    if 2 * number * keys.runs > MOST_READINGS:
        place = find_key_place(tree, ("runs",))
        yield Problem(
            place,
            f"runs: {count_in_words(keys.runs, 'run')} over {count_in_words(number, 'target')} are more than "
            f"{MOST_READINGS:,} readings, and no file of readings is so long",
        )
    if targets.positions and sorted(set(targets.positions)) != targets.positions:
        place = find_key_place(tree, ("targets", "positions"))
        yield Problem(place, "targets.positions: target positions rise, and none is there twice")
