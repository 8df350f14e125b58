"""A whole machine in a notebook: what its axes predict, and what they lack."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from numbers import Real
from pathlib import Path
from typing import Any

from zlmreport.document.blocks import Section
from zlmreport.errors import InputError, Place, did_you_mean, quoted
from zlmreport.files import write_new
from zlmreport.language import Language
from zlmreport.machines.choosing import add_effect
from zlmreport.machines.comparison import compare_circles, compare_tests
from zlmreport.machines.cross_confirmation import confirm as confirmed
from zlmreport.machines.cross_making import CrossMade, CrossWanted, make_cross, make_table_documents
from zlmreport.machines.cross_report import collect_confirmation, collect_cross
from zlmreport.machines.diagnosis import MachineDiagnosis, diagnose as diagnosed
from zlmreport.machines.diagnosis_report import build_values, collect_diagnosis
from zlmreport.machines.editing import BELONGS_INTO_EVERY_MODEL
from zlmreport.machines.kinematics import ERRORS
from zlmreport.machines.reading import MachineFile, is_always_there, read_machine
from zlmreport.machines.report import collect_prediction
from zlmreport.machines.study import CircleStudy
from zlmreport.machines.subjects.axes import lay_out_errors, lay_out_space
from zlmreport.machines.subjects.cross_tables import lay_out_cross
from zlmreport.machines.subjects.findings import lay_out_diagnosis
from zlmreport.machines.subjects.saying import Sayer
from zlmreport.measurement.units import MICROMETRE, MILLIMETRE
from zlmreport.notebook.layout import sections_html
from zlmreport.plugin.registry import Registry, find_plugins
from zlmreport.verification.carrier import find_results_in

_PLACE, _SAY = Place("z.machine"), Sayer(Language.ENGLISH)


@dataclass(frozen=True, repr=False)
class DiagnosisOfMachine:
    """What a diagnosis of a machine found; deviations in µm."""

    values: Mapping[str, Any]  #: As ``zlmreport machine diagnose --json`` has it.
    sections: tuple[Section, ...]  #: The same for people.

    @property
    def verdict(self) -> str:
        """``adequate``, ``missing`` or ``unexplained``."""
        return str(self.values["verdict"])

    @property
    def missing(self) -> tuple[str, ...]:
        """The effects that belong in, first the one to add first."""
        return tuple(self.values["set"])

    @property
    def candidates(self) -> tuple[Mapping[str, Any], ...]:
        """All effects that are worth a word, best first."""
        return tuple(self.values["candidates"])

    def __str__(self) -> str:
        """Return the verdict in a sentence."""
        return str(self.values["statement"])

    def __repr__(self) -> str:
        """Return the verdict in a sentence."""
        return f"<Diagnosis: {self}>"

    def _repr_html_(self) -> str:
        return sections_html(self.sections)


@dataclass(frozen=True, repr=False)
class BuiltMachine:
    """The steps by which a model of a machine came about."""

    machine: Machine  #: With all effects that were found.
    steps: tuple[Mapping[str, Any], ...]  #: Each effect with the RMS before and after it, µm.
    verdict: str

    def __repr__(self) -> str:
        """Return the steps in a line."""
        steps = " → ".join(f"+ {each['effect']} {each['rms_after']:.2g}" for each in self.steps)
        return f"<Build: {f'{steps} µm' if steps else 'nothing to add'}, {self.verdict}>"


@dataclass(frozen=True, repr=False)
class MachineTables:
    """Tables across the axes of a machine in the words of a control; lengths in µm."""

    machine: Machine
    made: CrossMade

    @property
    def values(self) -> dict[str, Any]:
        """As ``zlmreport machine compensate --json`` has it."""
        return collect_cross(self.made)

    @property
    def files(self) -> dict[str, str]:
        """The text of each file by its name."""
        return {f"{self.machine.file.number}{end}": text for end, text in self.made.files.items()}

    @property
    def forecast(self) -> dict[str, Any]:
        """Circles, diagonals and the largest error of the work space, before and after.

        A forecast is no measurement.
        """
        return dict(self.values["forecast"])

    def __repr__(self) -> str:
        """Return the files."""
        return f"<Tables: {', '.join(self.files)}>"

    def _repr_html_(self) -> str:
        return sections_html(lay_out_cross(self.made, _SAY))

    def save(self, folder: str | Path) -> Path:
        """Write the files; none that is there already is touched.

        Raises `AccessError` if they cannot be written, or are there.
        """
        write_new(make_table_documents(self.made.files, Path(folder), self.machine.file.number))
        return Path(folder)

    def confirm(self, *jobs: str | Path) -> dict[str, Any]:
        """Hold circles that were run again, with the tables in effect, against the forecast.

        Parameters
        ----------
        *jobs
            Of the circles; each on the path of one of the machine file.

        Returns
        -------
        As ``--confirm --json`` has it: ``verdict``, what part was ``applied`` with its
        ``expanded_uncertainty``, and each circle before, as forecast and after.

        Raises `InputError` if one of them is no circle, or was not run before.
        """
        if not jobs:
            raise InputError.at(_PLACE, "confirm takes the job of a circle that was run again")
        file, registry = self.machine.file, self.machine.registry
        return collect_confirmation(
            confirmed(file, self.made, [Path(each) for each in jobs], registry, _PLACE)
        )


@dataclass(frozen=True, repr=False)
class Machine:
    """A machine as its file describes it, and what its circles say; `add` and `remove` write no file."""

    file: MachineFile
    registry: Registry
    changed: CircleStudy | None = None  #: The study of its circles with other effects than the file states.

    @cached_property
    def study(self) -> CircleStudy:
        """What its circles say. Raises `InputError` if its file names none."""
        return self.changed or self.file.make_study()

    @property
    def effects(self) -> tuple[str, ...]:
        """The effects of its model."""
        return self.study.names

    @property
    def rms(self) -> float:
        """Root mean square of what axes and effects leave of the circles, µm."""
        return MICROMETRE.from_si(self.study.rms)

    def __repr__(self) -> str:
        """Return what is known of it."""
        machine = self.file.machine
        known, tests = len(ERRORS) - len(machine.unmeasured), len(self.file.test_names)
        left = f", {self.rms:.2g} µm left of its circles" if self.file.circles else ""
        return (
            f"<Machine {machine.chain.letters}: {known} of {len(ERRORS)} errors known, tests: {tests}{left}>"
        )

    def _repr_html_(self) -> str:
        machine = self.file.machine
        return sections_html([lay_out_errors(machine, _SAY, is_full=False), lay_out_space(machine, _SAY)])

    def predict(self) -> dict[str, Any]:
        """Return what the axes predict of tests, work space and diagonals, as ``--json`` has it."""
        return collect_prediction(self.file.machine, compare_tests(self.file, self.registry))

    def diagnose(self) -> DiagnosisOfMachine:
        """Say which effect is missing."""
        found = self._diagnose()
        before, after = (
            compare_circles(self.file, self.registry, study) for study in (found.study, found.complete)
        )
        sections = tuple(lay_out_diagnosis(found, before, _SAY))
        return DiagnosisOfMachine(collect_diagnosis(found, before, after), sections)

    def add(self, effect: str | Mapping[str, Any]) -> Machine:
        """Return the machine with one effect more: its name, or a candidate of a diagnosis.

        Raises `InputError` if there is no such effect, or it stands in the model already.
        """
        name = _name_effect(effect)
        found = {each.identifier: each for each in self.file.catalogue}
        if name not in found:
            raise InputError.at(_PLACE, f"{quoted(name)} is no effect; {did_you_mean(name, list(found))}")
        if name in self.effects:
            raise InputError.at(_PLACE, f"{name} stands in the model already")
        return Machine(self.file, self.registry, add_effect(self.study, found[name]))

    def remove(self, effect: str | Mapping[str, Any]) -> Machine:
        """Return the machine with one effect less.

        Raises `InputError` if it does not stand in the model, or belongs into every one.
        """
        name = _name_effect(effect)
        own = next((each.effect for each in self.study.effects if each.effect.identifier == name), None)
        if own is None:
            known = did_you_mean(name, self.effects)
            raise InputError.at(_PLACE, f"{quoted(name)} does not stand in the model; {known}")
        if is_always_there(own, self.file.circles):
            raise InputError.at(_PLACE, f"{name} {BELONGS_INTO_EVERY_MODEL}")
        return Machine(self.file, self.registry, self.study.without(name))

    def build(self) -> BuiltMachine:
        """Add effect after effect, as long as each has evidence of its own."""
        found = self._diagnose()
        values = build_values(found)
        return BuiltMachine(
            Machine(self.file, self.registry, found.complete), tuple(values["steps"]), values["verdict"]
        )

    def compensate(
        self, controller: str, moves: str | None = None, step: float | None = None
    ) -> MachineTables:
        """Make tables across axes for a control: straightness and squareness go, as far as it takes them.

        Parameters
        ----------
        controller
            Of which control: ``siemens-840d-cec``, ``linuxcnc``.
        moves
            Which way a positive value moves an axis, ``plus`` or ``minus``, where that is not known: a trial
            shows it (``zlmreport machine compensate --trial``).
        step
            Between rows, mm; without it as measured.

        Raises `InputError` if the control takes no such tables, its sign is neither known nor stated, or
        nothing is known that they could hold.
        """
        if step is not None and not (isinstance(step, Real) and step > 0):
            raise InputError.at(_PLACE, f"step is {step!r}: rows are more than 0 mm apart, such as 25")
        spacing = None if step is None else MILLIMETRE.to_si(step)
        wanted = CrossWanted(controller, moves, spacing, _PLACE, is_command=False)
        return MachineTables(self, make_cross(self.file, self.registry, wanted))

    def _diagnose(self) -> MachineDiagnosis:
        return diagnosed(self.study, self.file.catalogue)


def _name_effect(effect: str | Mapping[str, Any]) -> str:
    """Return the name of an effect, which a candidate of a diagnosis has as well."""
    return str(effect.get("effect", "") if isinstance(effect, Mapping) else effect)


def machine(path: str | Path) -> Machine:
    """Read a machine file with all that it names.

    Raises `InputError` with every mistake.
    """
    registry = find_plugins()
    return Machine(read_machine(Path(path), registry, find_results_in), registry)
