"""Certificates for notebooks, made from jobs and verified; and compensation tables with their forecast."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

from zlmreport import pipeline
from zlmreport.document.certificate.document import Certificate as ComposedCertificate
from zlmreport.document.subjects.compensation import lay_out_forecast
from zlmreport.document.writer import Writer
from zlmreport.errors import InputError, Place, did_you_mean
from zlmreport.files import Document, write, write_new
from zlmreport.job.days import demand_days_past
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.language import Language, Words
from zlmreport.model.compensation.basis import make_basis_of_means
from zlmreport.model.compensation.curve import make_error_curve
from zlmreport.model.compensation.making import Made, make
from zlmreport.notebook.frames import as_html, frame_of
from zlmreport.notebook.layout import sections_html
from zlmreport.notebook.readings import Readings, checked, readings_of, registry
from zlmreport.notebook.results import Result
from zlmreport.verification.findings import CheckedCertificate
from zlmreport.verification.verify import verify as verify_file

_PLACE = Place("compensate")


class Certificate:
    """The certificate of a job: ``z.certificate("job.yaml").save("x.pdf")``."""

    def __init__(self, job: Job, composed: ComposedCertificate) -> None:
        self._job = job
        self._composed = composed

    @property
    def number(self) -> str:
        """Its identification, also the stem of its files."""
        return self._composed.number

    @property
    def data(self) -> Readings:
        """The readings, corrected as the job says."""
        return Readings(self._composed.measurements)

    @cached_property
    def results(self) -> tuple[Result, ...]:
        """The evaluations by the standards of the job, with uncertainties and decisions."""
        chosen = pipeline.choose_standards(self._job, registry())
        return tuple(
            Result.of(evaluation, standard, options)
            for evaluation, (standard, options) in zip(self._composed.evaluations, chosen, strict=True)
        )

    def save(self, path: str | Path, plugin: str = "") -> Path:
        """Write the certificate, whole or not at all, and return where.

        Parameters
        ----------
        path
            A file whose suffix says the format, ``x.pdf``; or a folder, for all formats of the job: one that
            is there, or a name without a suffix.
        plugin
            Identifier of the renderer, where several write such files: ``pdf-typst``.

        Raises
        ------
        InputError
            If no renderer writes files of this suffix.
        AccessError
            If it cannot be written.
        """
        path = Path(path)
        if path.suffix and not path.is_dir():
            (content,) = self._render([plugin or _find_renderer_of(path)])
            return write([Document(path, content)])[0]
        known = {each.identifier: each for each in registry().renderers}
        names = pipeline.name_files(self.number, [known[each] for each in self._job.formats])
        contents = self._render(self._job.formats)
        write(Document(path / name, content) for name, content in zip(names, contents, strict=True))
        return path

    def _render(self, identifiers: Iterable[str]) -> tuple[bytes, ...]:
        renderers = [registry().renderer(each, Place("save")) for each in identifiers]
        contents = pipeline.render(self._composed, renderers, registry())
        return tuple(contents[each.identifier] for each in renderers)

    def __repr__(self) -> str:
        """Return its number and standards."""
        return f"<Certificate {self.number}: {', '.join(each.standard for each in self.results)}>"

    def _repr_html_(self) -> str:
        return "".join(each._repr_html_() for each in self.results)


def _find_renderer_of(path: Path) -> str:
    by_suffix: dict[str, str] = {}
    for each in registry().renderers:
        by_suffix.setdefault(each.suffix, each.identifier)
    if path.suffix not in by_suffix:
        message = f"no renderer writes {path.suffix} files; {did_you_mean(path.suffix, list(by_suffix))}"
        raise InputError.at(Place(str(path)), message)
    return by_suffix[path.suffix]


def certificate(job: str | Path) -> Certificate:
    """Return the certificate of a job: read, evaluated and composed, not printed yet.

    Raises
    ------
    InputError
        With all that is wrong with the job or its data.
    AccessError
        If a file cannot be read.
    """
    loaded = load(Path(job), registry())
    demand_days_past(loaded)
    return Certificate(loaded, pipeline.compose(loaded, registry()))


_OUTCOMES = {"holds": "holds", "does-not-hold": "does not hold", "undecided": "not decided"}


class Verification:
    """Whether a certificate holds: each of its numbers against its own data, evaluated again."""

    def __init__(self, file: Path, found: CheckedCertificate) -> None:
        self.file = file
        self._found = found

    @property
    def holds(self) -> bool:
        """Whether nothing differs."""
        return self._found.holds

    @property
    def number(self) -> str:
        """Of the certificate, as it says itself."""
        return self._found.identity.number

    @property
    def differences(self) -> tuple[str, ...]:
        """What differs, in words."""
        found = self._found
        statements = (found.signature, *found.files, *found.pages, *found.document)
        return (
            *(
                f"{each.subject}: {_write_in_english(each.detail)}"
                for each in statements
                if each.verdict == "differs"
            ),
            *(
                f"{'.'.join(each.path)}: {each.stated} is stated, {each.recomputed} computed"
                for each in found.values
                if each.verdict == "differs"
            ),
        )

    @property
    def remarks(self) -> tuple[str, ...]:
        """What limits the comparison."""
        return tuple(map(_write_in_english, self._found.remarks))

    def __bool__(self) -> bool:
        """Whether it holds."""
        return self.holds

    def __repr__(self) -> str:
        """Return whether it holds, or is not decided."""
        return f"<Verification of {self.number}: {_OUTCOMES[self._found.outcome]}>"

    def _repr_html_(self) -> str:
        rows = [(each,) for each in self.differences] or [("Every statement that could be compared holds.",)]
        return as_html((f"{self.number}: {_OUTCOMES[self._found.outcome]}",), rows)


def _write_in_english(words: Words | str) -> str:
    return words if isinstance(words, str) else words.in_language(Language.ENGLISH)


def verify(file: str | Path) -> Verification:
    """Evaluate a certificate again from the data that it carries, and compare.

    Raises
    ------
    AccessError, InputError
        If it cannot be read, or is no such certificate.
    """
    path = Path(file)
    return Verification(path, verify_file(path, registry()))


class Compensation:
    """A table in the words of a control: ``z.compensate(data, "linuxcnc").save("tables")``."""

    def __init__(self, data: Readings, made: Made, number: str, asked: Mapping[str, Any]) -> None:
        self.data = data
        self._asked = asked
        self.controller = made.controller.identifier
        self.confidence = made.controller.confidence
        self.files = MappingProxyType({f"{number}{end}": text for end, text in made.files.items()})
        self._made = made

    def __reduce__(self) -> tuple[Any, ...]:
        """Return how to make it anew: plugins stay here, and go by their names."""
        return _make_again, (self.data, self.controller, self._asked)

    @property
    def table(self) -> Any:
        """A frame of what is taken away at each position (mm or °): ``forward`` and ``reverse``, µm or ″."""
        axis, meant = self.data.measurements.axis, self._made.meant
        columns = {
            "position": axis.position_unit.from_si(meant.positions),
            "forward": axis.deviation_unit.from_si(meant.forward),
            "reverse": axis.deviation_unit.from_si(meant.reverse),
        }
        return frame_of(columns, self.data.library)

    @property
    def before(self) -> dict[str, float]:
        """E, M, B and A of the mean deviations as they are, µm or ″."""
        return self._made.forecast.before.in_unit(self._factor)

    @property
    def after(self) -> dict[str, float]:
        """The same as they are expected with the table; a forecast is no measurement."""
        return self._made.forecast.after.in_unit(self._factor)

    @property
    def between(self) -> float:
        """The largest deviation that is expected anywhere between the rows, µm or ″."""
        return self._made.forecast.between * self._factor

    @property
    def _factor(self) -> float:
        return self.data.measurements.axis.deviation_unit.from_si(1.0)

    def save(self, folder: str | Path) -> Path:
        """Write the files of the control; no file that is there already is touched.

        Raises
        ------
        AccessError
            If they cannot be written, or are there.
        """
        documents = [Document(Path(folder) / name, text.encode()) for name, text in self.files.items()]
        write_new(documents)
        return Path(folder)

    def __repr__(self) -> str:
        """Return the control, and E before and after."""
        before, after = self.before["E"], self.after["E"]
        return f"<compensation for {self.controller} ({self.confidence}): E {before:.3g} → {after:.3g}>"

    def _repr_html_(self) -> str:
        writer = Writer.of(self.data.measurements, Language.ENGLISH)
        return sections_html([lay_out_forecast(self._made, writer, ({}, {}))])


def compensate(  # noqa: PLR0913 - each by its name
    data: Readings,
    controller: str,
    *,
    active: Literal["none", "of the axis"],
    number: str = "compensation",
    step: float | None = None,
    unconfirmed: bool = False,
    **keys: Any,
) -> Compensation:
    """Make a compensation table from the mean deviations.

    Parameters
    ----------
    data
        The readings of a test.
    controller
        Of which control: ``linuxcnc``, ``csv``.
    active
        Which table was active during the test: ``none``, or the one ``of the axis``, which it then replaces
        (``z.read(…, axis={"compensation_table": …})``). A new table on top of one that nobody knows corrects
        twice.
    number
        The stem of the names of the files.
    step
        Between rows, mm or °; without it the targets, or what the control takes in their place.
    unconfirmed
        Whether a format that was never tried on the control is written.
    **keys
        Further keys of the controller as in a job: ``type=0``.

    Raises
    ------
    InputError
        If there is no such controller, or it cannot take the table.
    """
    data = readings_of(data, _PLACE.file)
    axis = data.measurements.axis
    if (active == "none") != (axis.compensation_table is None):
        known = "no" if axis.compensation_table is None else "a"
        raise InputError.at(_PLACE, f"active is {active!r}, and the axis of these readings has {known} table")
    writer = registry().controller(controller, _PLACE)
    if writer.confidence != "verified" and not unconfirmed:
        raise InputError.at(
            _PLACE,
            f"the format of {controller} is {writer.confidence}, and was never tried on the control; "
            "unconfirmed=True writes it all the same: try it with care, one point first",
        )
    options = checked(writer.options, keys, "compensate")
    basis = make_basis_of_means(make_error_curve(data.measurements, _PLACE), data.measurements)
    made = make(
        basis,
        axis,
        number,
        _PLACE,
        writer,
        options,
        step=None if step is None else axis.position_unit.to_si(step),
    )
    asked = {"active": active, "number": number, "step": step, "unconfirmed": unconfirmed, **keys}
    return Compensation(data, made, number, asked)


def _make_again(data: Readings, controller: str, asked: Mapping[str, Any]) -> Compensation:
    return compensate(data, controller, **asked)
