"""``zlmreport verify``: whether a certificate holds, number by number."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from zlmreport.cli.terminal import Colour, print_json, shown_path, table, visible
from zlmreport.errors import Place
from zlmreport.plugins import find_plugins
from zlmreport.quantities.units import printed_symbol
from zlmreport.signing.state import trusted_by_user, trusted_certificates
from zlmreport.verification.findings import Finding, Outcome, Value, Verdict, Verification, is_number
from zlmreport.verification.verify import verify
from zlmreport.version import __version__

_CODES = {Outcome.HOLDS: 0, Outcome.DOES_NOT_HOLD: 1, Outcome.UNDECIDED: 5}
_HOLDS = {Outcome.HOLDS: True, Outcome.DOES_NOT_HOLD: False, Outcome.UNDECIDED: None}
_COLOURS = {Verdict.HOLDS: Colour.GREEN, Verdict.DIFFERS: Colour.RED, Verdict.OPEN: Colour.YELLOW}
_MOST_LINES = 12
_LONGEST_TEXT = 40
#: Steps of a value's path that say nothing to people.
_CONTAINERS = frozenset({"evaluations", "parameters", "positions"})
_AS_STATED, _AS_PRINTED = "as the certificate states", "as printed again"
SCHEMA = "zlmreport/verification/1"


def run(options: Namespace) -> int:
    """Verify a certificate; return 1 if anything in it does not hold, 5 if that cannot be decided here."""
    named = options.trusted or trusted_by_user()
    found = verify(
        options.certificate,
        find_plugins(files=options.plugin),
        options.dcc_schema,
        trusted=trusted_certificates(named, Place("zlmreport --trusted")) if named else (),
        require_signature=options.require_signature,
    )
    code = _CODES[found.outcome]
    if options.json:
        print_json(_values(options.certificate, found, code))
    else:
        print(*_lines(options.certificate, found), sep="\n")
    return code


def _lines(path: Path, found: Verification) -> Iterator[str]:
    """Yield the _lines on a certificate."""
    yield f"{Colour.BOLD.of(shown_path(path))}  {_verdict(found)}"
    identity = found.identity
    if identity.number:
        issued = f", issued {identity.issued}" if identity.issued else ""
        yield visible(f"  {identity.title} {identity.number}{issued}, made by {identity.generator}")
    yield ""
    yield from table(
        [
            ("signature", _in_colour(found.signature.verdict, visible(found.signature.detail))),
            *_summary("files", found.files, f"attached files {_AS_STATED}"),
            *_numbers(found.values),
            *_summary("pages", found.pages, f"pages {_AS_PRINTED}"),
            *_summary("document", found.document, f"parts {_AS_PRINTED}"),
            *(("note", Colour.YELLOW.of(visible(remark))) for remark in found.remarks),
        ],
        indent="  ",
    )
    for standard in dict.fromkeys(value.path[1] for value in found.values if _is_of_parameter(value)):
        yield ""
        yield from _parameters(standard, found.values)


def _verdict(found: Verification) -> str:
    match found.outcome:
        case Outcome.HOLDS:
            origin = "signed by a key that is trusted" if found.is_trusted else "consistent, origin unknown"
            return f"{Colour.GREEN.of('holds')}: {origin}"
        case Outcome.UNDECIDED:
            parts = " and ".join(found.undecided)
            return f"{Colour.YELLOW.of('not decided')}: {parts} could not be compared whole"
    count = found.differences
    return f"{Colour.RED.of('does not hold')}: {count} {'difference' if count == 1 else 'differences'}"


def _in_colour(verdict: Verdict, text: str) -> str:
    return _COLOURS[verdict].of(text)


def _summary(label: str, findings: Sequence[Finding], what: str) -> Iterator[tuple[str, str]]:
    """Yield how many findings hold, and each that does not."""
    if not findings:
        return
    others = [each for each in findings if each.verdict is not Verdict.HOLDS]
    yield label, f"{len(findings) - len(others)} of {len(findings)} {what}"
    for each in others[:_MOST_LINES]:
        yield (
            "",
            f"{_in_colour(each.verdict, each.verdict.value)}  {visible(f'{each.subject}: {each.detail}')}",
        )
    if len(others) > _MOST_LINES:
        yield "", f"and {len(others) - _MOST_LINES} more: see --json"


def _numbers(values: Sequence[Value]) -> Iterator[tuple[str, str]]:
    """Yield how many numbers hold, and each value that does not and stands in no table below."""
    numbers = sum(value.is_number for value in values)
    if not numbers:
        return
    holding = sum(value.is_number and value.verdict is Verdict.HOLDS for value in values)
    yield "numbers", f"{holding} of {numbers} as the attached readings give them"
    elsewhere = [
        Finding(" ".join(step for step in value.path if step not in _CONTAINERS), value.verdict, _both(value))
        for value in values
        if value.verdict is Verdict.DIFFERS and not _is_of_parameter(value)
    ]
    yield from list(_summary("", elsewhere, ""))[1:]


def _parameters(standard: str, values: Sequence[Value]) -> Iterator[str]:
    """Yield the parameters of a standard, each with all that is stated of it and differs."""
    of_standard = [value for value in values if _is_of_parameter(value) and value.path[1] == standard]
    units = {str(value.recomputed) for value in of_standard if value.path[-1] == "unit"}
    unit = " ".join(printed_symbol(each) for each in sorted(units))
    rows = []
    for symbol in dict.fromkeys(value.path[3] for value in of_standard):
        own = {value.path[-1]: value for value in of_standard if value.path[3] == symbol}
        wrong = {key: value for key, value in own.items() if value.verdict is Verdict.DIFFERS}
        verdict = Verdict.DIFFERS if wrong else Verdict.HOLDS
        others = "; ".join(f"{key}: {_both(value)}" for key, value in wrong.items() if key != "value")
        value = own.get("value")
        rows.append(
            (
                visible(symbol),
                *(_shown(value) if value else ("", "")),
                _in_colour(verdict, verdict.value) + visible(f"  {others}" if others else ""),
            )
        )
    yield from table([(visible(standard), "stated", "recomputed", unit), *rows], right=(1, 2), indent="  ")


def _is_of_parameter(value: Value) -> bool:
    return len(value.path) > 4 and value.path[0] == "evaluations" and value.path[2] == "parameters"


def _both(value: Value) -> str:
    stated, recomputed = _shown(value)
    return f"{stated} is stated, and {recomputed} recomputed"


def _shown(value: Value) -> tuple[str, str]:
    """Return the stated and the recomputed value with as many digits as tell the two apart."""
    for digits in range(5, 18):
        stated, recomputed = (_written(each, digits) for each in (value.stated, value.recomputed))
        if stated != recomputed or value.verdict is not Verdict.DIFFERS:
            break
    return stated, recomputed


def _written(value: object, digits: int) -> str:
    if value is None:
        return "nothing"
    if is_number(value):
        return f"{value:.{digits}g}"
    text = str(value)
    return f"'{text}'" if len(text) <= _LONGEST_TEXT else f"'{text[: _LONGEST_TEXT - 1]}…'"


def _values(path: Path, found: Verification, exit_code: int) -> dict[str, Any]:
    """Return all that was found; values are in the units of the results file."""
    return {
        "schema": SCHEMA,
        "zlmreport": __version__,
        "exit_code": exit_code,
        "file": str(path),
        "verdict": found.outcome.value,
        "holds": _HOLDS[found.outcome],
        "trusted": found.is_trusted,
        "undecided": list(found.undecided),
        "differences": found.differences,
        "certificate": asdict(found.identity),
        "signature": _finding(found.signature),
        "files": _findings(found.files),
        "values": [
            {
                "path": "/".join(value.path),
                "stated": value.stated,
                "recomputed": value.recomputed,
                "verdict": value.verdict.value,
            }
            for value in found.values
        ],
        "pages": _findings(found.pages),
        "document": _findings(found.document),
        "remarks": list(found.remarks),
    }


def _findings(findings: Iterable[Finding]) -> list[dict[str, str]]:
    return [_finding(each) for each in findings]


def _finding(finding: Finding) -> dict[str, str]:
    return {"subject": finding.subject, "verdict": finding.verdict.value, "detail": finding.detail}
