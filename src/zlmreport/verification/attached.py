"""The files that a certificate carries: what it states of them, and whether they are those.

The results file says what the certificate was made from. Those files are laid out so that its job finds them
and no others, compared with what is stated of them and with those of the certificate made again, and a
digital certificate among them is held against what PTB publishes for it.
"""

from __future__ import annotations

import contextlib
import hashlib
import math
import os
import posixpath
import re
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from pydantic import Field

from zlmreport.document.certificate.results_file import (
    MACHINE_RESULTS,
    RESULTS,
    ResultsFile,
    ResultsPart,
    read_results,
)
from zlmreport.errors import AccessError, InputError, Place, Problem, ZlmreportError
from zlmreport.files import confine
from zlmreport.job.types import Enclosure, enclose
from zlmreport.verification.carrier import Carried, Carrier
from zlmreport.verification.findings import CheckedStatement, VerificationVerdict


class StatedSource(ResultsPart):
    """A file that the certificate was made from."""

    role: str
    name: str
    path: str
    sha256: str
    size: int


class _Provenance(ResultsPart):
    generator: str
    plugins: dict[str, str]
    sources: tuple[StatedSource, ...] = Field(min_length=1)


class Results(ResultsFile):
    """A results file as far as a verification needs to understand it."""

    provenance: _Provenance


@dataclass(frozen=True, slots=True)
class StatedResults:
    """A results file."""

    name: str  #: Of the attachment.
    tree: dict[str, Any] = field(repr=False)  #: All that it says.
    results: Results  #: What is understood of it.


def find_stated_by(carrier: Carrier) -> StatedResults | None:
    """Return what the results file of a certificate states; None if it carries none that can be read.

    Raises `ValueError` if there is one, and it is no sound results file.
    """
    for file in carrier.carried.values():
        if file.relationship != "Data" or not file.name.endswith(".json"):
            continue
        try:
            tree = read_results(file.content)
            if isinstance(tree, dict) and tree.get("schema") in {RESULTS, MACHINE_RESULTS}:
                return StatedResults(file.name, tree, Results.of(tree))
        except ValueError as error:
            raise ValueError(f"{file.name}: {error}") from error
    return None


#: Of a file system, in bytes.
_LONGEST_NAME = 255


@dataclass(frozen=True, slots=True)
class Layout:
    """Files in a folder that is gone when the work is done."""

    job: Path  #: The job file.
    names: Mapping[str, str]  #: What each file is called in messages, by where it lies.

    def list_problems(self, error: ZlmreportError) -> tuple[Problem, ...]:
        """Return what went wrong with the files by their own names."""
        return tuple(
            Problem(
                replace(problem.place, file=self._name_files(problem.place.file)),
                self._name_files(problem.message),
            )
            for problem in error.problems
        )

    def _name_files(self, message: str) -> str:
        for path, name in self.names.items():
            message = message.replace(path, name)
        return message


@contextlib.contextmanager
def lay_out(sources: Sequence[StatedSource], carried: Mapping[str, Carried]) -> Iterator[Layout]:
    """Write each attached source into a folder of its own; jobs name these files only while it lasts.

    `carried`: The attachments, by name: each is a name and no path.
    """
    with tempfile.TemporaryDirectory(prefix="zlmreport-verify-") as folder:
        files: dict[str, Path] = {}
        names: dict[str, str] = {}
        for number, source in enumerate(sources):
            path = Path(folder, str(number), _find_file_name(source))
            path.parent.mkdir()
            names[str(path)] = source.name
            files.setdefault(posixpath.normpath(source.path), path)
            if source.name in carried:
                path.write_bytes(carried[source.name].content)
        nowhere = Path(folder, "not attached")
        nowhere.mkdir()
        names[f"{nowhere}/"] = ""
        with confine(Path(folder)), enclose(Enclosure(files, nowhere)):
            yield Layout(next(iter(files.values())), names)


def _find_file_name(source: StatedSource) -> str:
    """Return the name that a file had, for documents print it; another where no file can have that name."""
    name = posixpath.basename(source.path)
    try:
        is_possible = len(os.fsencode(name)) <= _LONGEST_NAME and "\0" not in name
    except UnicodeEncodeError:
        is_possible = False
    return name if is_possible and name not in {"", ".", ".."} else "file"


_SHOWN_DIGITS = 12
_LONGEST_TEXT = 60
_DESCRIBED = {
    "relationship": "relationship",
    "description": "description",
    "media_type": "media type",
    "dates": "date",
    "listed": "name in the list of names",
    "associated": "number of associations with the document",
    "entries": "description (by its entries)",
}
#: Of numbers with decimals: those of a fitted model differ most from processor to processor. The values of
#: the results file are compared closer.
_TOLERANCE = 1e-6
_NUMBER = re.compile(r"-?\d+\.\d+(?:[eE][+-]?\d+)?")


def compare(  # noqa: PLR0913 - what is stated, found and made again, and how much alike it must be
    sources: Sequence[StatedSource],
    carried: Mapping[str, Carried],
    again: Mapping[str, Carried] | None,
    *,
    same_programs: bool = True,
    compared_by_value: str = "",
    same_processor: bool = False,
) -> tuple[CheckedStatement, ...]:
    """Return a finding for each file that is attached, or should be.

    `again`: What it carries when it is made again, by name; None if it cannot be.
    `same_programs`: Whether the same releases made it again: otherwise files that are made of the readings
        may differ.
    `compared_by_value`: The name of a results file of which differing values are found already.
    `same_processor`: Whether the last digits of computed numbers must be the same, too.
    """
    stated = {source.name: source for source in sources}
    findings = []
    for name in dict.fromkeys((*stated, *carried, *(again or {}))):
        file, source = carried.get(name), stated.get(name)
        if file is None:
            findings.append(CheckedStatement.of(name, "is not attached"))
            continue
        faults = [*_list_digests(file, source)]
        if again is not None:
            faults += _check_descriptions(file, again.get(name))
        is_derived = again is not None and source is None and name != compared_by_value
        derived = again.get(name) if again and is_derived else None
        verdict = (
            VerificationVerdict.DIFFERS
            if faults
            else VerificationVerdict.HOLDS
            if source or again
            else VerificationVerdict.OPEN
        )
        is_same = derived is None or file.content == derived.content
        if derived and not is_same and not same_processor:
            is_same = _are_alike(file.content, derived.content)
        if verdict is VerificationVerdict.HOLDS and not is_same:
            verdict = VerificationVerdict.DIFFERS if same_programs else VerificationVerdict.OPEN
            faults = ["is not what the attached readings give"]
        findings.append(CheckedStatement(name, verdict, "; ".join(faults)))
    return tuple(findings)


def _are_alike(content: bytes, again: bytes) -> bool:
    """Whether two texts are the same but for the last digits of numbers, which other processors round."""
    try:
        texts = content.decode(), again.decode()
    except UnicodeDecodeError:
        return False
    between, between_again = map(_NUMBER.split, texts)
    return between == between_again and all(
        math.isclose(float(one), float(other), rel_tol=_TOLERANCE, abs_tol=_TOLERANCE**2)
        for one, other in zip(*map(_NUMBER.findall, texts), strict=True)
    )


def _list_digests(file: Carried, source: StatedSource | None) -> Iterator[str]:
    digest = hashlib.sha256(file.content).hexdigest()
    if source and (digest, len(file.content)) != (source.sha256, source.size):
        yield (
            f"is not the file that the results come from: its SHA-256 is {digest[:_SHOWN_DIGITS]}…, and "
            f"{source.sha256[:_SHOWN_DIGITS]}… is stated"
        )
    elif file.checksum and file.checksum != hashlib.md5(file.content, usedforsecurity=False).hexdigest():
        yield "is not the file that was attached: the PDF states another checksum"
    elif file.size and file.size != str(len(file.content)):
        yield f"has {len(file.content)} bytes, and the PDF states {file.size[:_SHOWN_DIGITS]}"


def _check_descriptions(file: Carried, again: Carried | None) -> Iterator[str]:
    """Yield where the PDF does not say of a file what it says when it is made again."""
    if again is None:
        yield "is no file of this certificate"
        return
    for key, what in _DESCRIBED.items():
        found, expected = getattr(file, key), getattr(again, key)
        if found != expected and not found and key == "listed":
            yield "is in no list of names: readers of PDF do not show it"
        elif found != expected:
            yield f"its {what} {_say_change(found, expected)}"


def _say_change(found: Any, expected: Any) -> str:
    """Say how a description is not what it should be; of several entries only those that differ."""
    if isinstance(found, tuple) and isinstance(expected, tuple):
        lacking, more = (
            ", ".join(str(each).strip() for each in one if each not in other)[:_LONGEST_TEXT]
            for one, other in ((expected, found), (found, expected))
        )
        if lacking or more:
            return " and ".join([*[f"lacks {lacking}"] * bool(lacking), *[f"has {more}"] * bool(more)])
    shown, right = (str(each)[:_LONGEST_TEXT] for each in (found, expected))
    return f"is {shown!r} and should be {right!r}" if shown else f"is missing and should be {right!r}"


_NAMESPACE = b"https://ptb.de/dcc"
_SCHEMA = "dcc.xsd"
_EXTRA = "checking a digital certificate needs the extra dcc: pip install 'zlmreport[dcc]'"
_MOST_DEFECTS = 3


def check_digital_certificates(carried: Mapping[str, Carried], schema: Path) -> Iterator[CheckedStatement]:
    """Yield what PTB's rules and PTB's schema say of the attached digital certificates.

    `schema`: A folder with PTB's ``dcc.xsd`` and what it imports.

    Raises `AccessError` if the folder holds no schema; `InputError` if the optional libraries that check are
    not installed.
    """
    place = Place(str(schema))
    if not (schema / _SCHEMA).is_file():
        message = f"holds no {_SCHEMA}: name the folder of PTB's schema, such as v3.3.0"
        raise AccessError.at(place, message)
    digital = {name: each.content for name, each in carried.items() if _NAMESPACE in each.content[:1000]}
    if not digital:
        yield CheckedStatement(
            "digital certificate", VerificationVerdict.OPEN, "none is attached: output.formats names no dcc"
        )
    try:
        for name, content in digital.items():
            yield from _check_digital(name, content, schema / _SCHEMA)
    except ImportError as error:
        raise InputError.at(place, _EXTRA) from error


def _check_digital(name: str, content: bytes, schema: Path) -> Iterator[CheckedStatement]:
    from lxml import etree  # noqa: PLC0415 - comes with the optional extra

    parser = etree.XMLParser(resolve_entities=False, no_network=True)
    try:
        certificate = etree.fromstring(content, parser)
    except etree.XMLSyntaxError as error:
        yield CheckedStatement.of(name, f"is not XML: {' '.join(str(error).split())}")
        return
    if certificate.getroottree().docinfo.doctype:  # its entities may be files, which who checks would read
        yield CheckedStatement.of(name, "declares a document type, which no digital certificate does")
        return
    yield _make_finding(
        name, "PTB's rules", _find_broken_rules(etree.tostring(certificate, encoding="unicode"))
    )
    rules = etree.XMLSchema(etree.parse(str(schema), parser))
    rules.validate(certificate)
    yield _make_finding(
        name, "PTB's schema", [f"line {each.line}: {each.message}" for each in rules.error_log]
    )


def _find_broken_rules(text: str) -> list[str]:
    from dcclib.validation.schematron import SchematronValidator  # noqa: PLC0415 - an optional extra
    from saxonche import PySaxonApiError  # noqa: PLC0415 - comes with the extra

    try:
        found = SchematronValidator.for_dcc().validate_str(text)
    except PySaxonApiError as error:  # such as a date that is none, which the rules calculate with
        return [str(error)]
    reports = [each.text for each in found.successful_reports if each.role == "error"]
    return [*(each.text for each in found.failed_assertions), *reports]


def _make_finding(name: str, by: str, broken: list[str]) -> CheckedStatement:
    if not broken:
        return CheckedStatement(name, VerificationVerdict.HOLDS, f"valid by {by}")
    shown = "; ".join(" ".join(each.split()) for each in broken[:_MOST_DEFECTS])
    return CheckedStatement.of(name, f"not valid by {by}: {shown}")
