"""From a simulation file to what it describes, checked."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from zlmreport.errors import InputError, Place, Problem
from zlmreport.job.effects import EffectChoice, effect_choices
from zlmreport.job.extends import compose
from zlmreport.job.formats import SIMULATION, refuse_other_format
from zlmreport.job.installed import Installed
from zlmreport.job.interpret import axis_in_si
from zlmreport.job.simulation_keys import SimulationKeys
from zlmreport.job.tree import Keys, Node, key_place, place_of
from zlmreport.job.validate import validate
from zlmreport.measurement.axis import Axis
from zlmreport.measurement.provenance import SourceFile

#: In both directions together; a file of readings may have some more lines.
MOST_READINGS = 200_000


@dataclass(frozen=True, slots=True)
class SimulationFile:
    """A checked simulation file.

    Attributes
    ----------
    path
        The file.
    keys
        What it says, in the users' units.
    axis
        The axis in SI.
    effects
        Effects with their parameters.
    source
        Name and digest of the file.
    tree
        What it says, value by value, with the places.
    """

    path: Path
    keys: SimulationKeys
    axis: Axis
    effects: tuple[EffectChoice, ...]
    source: SourceFile
    tree: Keys

    def place_of(self, *steps: str | int) -> Place:
        """Return where a key stands; of one that is missing, its nearest parent's place."""
        return place_of(self.tree, steps)


def load_simulation(path: Path, registry: Installed) -> SimulationFile:
    """Read a simulation file and check all that can be checked without simulating.

    Raises
    ------
    InputError
        With every mistake, in the order of their places.
    AccessError
        If it, or a file that it names, cannot be read.
    """
    composition = compose(path)
    tree = composition.keys
    refuse_other_format(tree, SIMULATION)
    problems: list[Problem] = []
    keys = validate(SimulationKeys, tree, problems)
    effects = effect_choices(_value(tree, "effects"), registry, problems, within="effects")
    model = _value(tree, "model")
    if isinstance(model, Keys):
        effect_choices(_value(model, "effects"), registry, problems, within="model.effects")
    if keys:
        problems.extend(_contradictions(keys, tree))
    if problems or keys is None:
        raise InputError(sorted(set(problems)))
    return SimulationFile(path, keys, axis_in_si(keys.axis), effects, composition.files[0], tree)


def _value(tree: Keys, key: str) -> Node | None:
    entry = tree.entries.get(key)
    return entry.value if entry else None


def _contradictions(keys: SimulationKeys, tree: Keys) -> Iterator[Problem]:
    """Yield what no single key shows to be wrong."""
    travel, targets = keys.axis.travel, keys.targets
    if travel and travel[0] >= travel[1]:
        place = key_place(tree, ("axis", "travel"))
        yield Problem(place, "axis.travel: the first position of the travel must be less than the last")
    if (targets.count is None) == (targets.positions is None):
        place = key_place(tree, ("targets",))
        yield Problem(
            place, "targets: either a count of targets, or their positions; for example {count: 21}"
        )
    elif targets.positions is None and travel is None:
        place = key_place(tree, ("axis",))
        yield Problem(place, "axis.travel is missing: targets are spread over it; for example [0, 1000]")
    number = len(targets.positions or ()) or targets.count or 0
    if 2 * number * keys.runs > MOST_READINGS:
        place = key_place(tree, ("runs",))
        yield Problem(
            place,
            f"runs: {keys.runs} runs over {number} targets are more than {MOST_READINGS} readings, "
            "and no file of readings is so long",
        )
    if targets.positions and sorted(set(targets.positions)) != targets.positions:
        place = key_place(tree, ("targets", "positions"))
        yield Problem(place, "targets.positions: target positions rise, and none is there twice")
