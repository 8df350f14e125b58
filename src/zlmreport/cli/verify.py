"""``zlmreport verify``: whether a certificate holds, number by number."""

from __future__ import annotations

from argparse import Namespace
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import Any, TypeAlias

from zlmreport.cli.terminal import (
    Colour,
    lay_out_table,
    make_visible,
    print_json,
    say as said,
    show_path,
    wrap,
)
from zlmreport.document.signing.state import find_trusted_by_user, read_trusted_certificates
from zlmreport.errors import NOT_MET, UNDECIDED, Place
from zlmreport.language import Words, list_in_words, named
from zlmreport.measurement.units import find_printed_symbol
from zlmreport.plugin.registry import find_plugins
from zlmreport.verification.findings import (
    CheckedCertificate,
    CheckedStatement,
    ComparedValue,
    QuotedText,
    VerificationOutcome,
    VerificationVerdict,
    is_number,
)
from zlmreport.verification.verify import verify
from zlmreport.version import __version__

_CODES = {
    VerificationOutcome.HOLDS: 0,
    VerificationOutcome.DOES_NOT_HOLD: NOT_MET,
    VerificationOutcome.UNDECIDED: UNDECIDED,
}
_HOLDS = {
    VerificationOutcome.HOLDS: True,
    VerificationOutcome.DOES_NOT_HOLD: False,
    VerificationOutcome.UNDECIDED: None,
}
_COLOURS = {
    VerificationVerdict.HOLDS: Colour.GREEN,
    VerificationVerdict.DIFFERS: Colour.RED,
    VerificationVerdict.OPEN: Colour.YELLOW,
}
_MOST_LINES = 12
_LONGEST_TEXT = 40
_LONGEST_QUOTE = 200
#: Steps of a value's path that say nothing to people.
_CONTAINERS = frozenset({"evaluations", "parameters", "positions"})
_SAID = {
    VerificationVerdict.HOLDS: Words("holds"),
    VerificationVerdict.DIFFERS: Words("differs"),
    VerificationVerdict.OPEN: Words("not compared"),
    VerificationOutcome.HOLDS: Words("holds", context="confirmed"),
    VerificationOutcome.DOES_NOT_HOLD: Words("does not hold"),
    VerificationOutcome.UNDECIDED: Words("not decided"),
}
_PARTS = {
    "signature": Words("signature"),
    "files": Words("files"),
    "values": Words("values"),
    "pages": Words("pages"),
    "document": Words("document"),
}
_OWN_WORDS = Words("Words that somebody wrote; no reading gives them:")
_IN = Words("{key} (in {names})")
_ALSO_IN = Words("{key} (also in {names})")
#: Last steps by which a key is known again within a measurement; measurements that are named one by one.
_STEPS_OF_A_KEY, _MOST_PLACES = 2, 3
_Say: TypeAlias = Callable[[Words | str], str]
SCHEMA = "zlmreport/verification/1"


def run(options: Namespace) -> int:
    """Verify a certificate; return 1 if anything in it does not hold, 5 if that cannot be decided here."""
    named = options.trusted or find_trusted_by_user()
    found = verify(
        options.certificate,
        find_plugins(files=options.plugin),
        options.dcc_schema,
        trusted=read_trusted_certificates(named, Place("zlmreport --trusted")) if named else (),
        require_signature=options.require_signature,
    )
    code = _CODES[found.outcome]
    if options.json:
        print_json(_collect_values(options.certificate, found, code))
    else:
        print(*_tell_lines(options.certificate, found), sep="\n")
    return code


def _tell_lines(path: Path, found: CheckedCertificate) -> Iterator[str]:
    """Yield the lines on a certificate, in its language; what differs is told in English."""
    identity, signature = found.identity, found.signature
    say = partial(said, language=identity.language)
    # What does not hold is no copy of anything: its digest would only be taken for a sign that it is.
    is_told = identity.digest and found.outcome is not VerificationOutcome.DOES_NOT_HOLD
    digest = f"  {make_visible(identity.digest)}" if is_told else ""
    yield f"{Colour.BOLD.set(show_path(path))}  {_tell_verdict(found, say)}{digest}"
    if identity.number:
        issued = Words(", issued {date}").given(date=identity.issued)
        made_by = Words("made by {program}").given(program=identity.generator)
        date = say(issued) if identity.issued else ""
        yield from wrap(make_visible(f"{identity.title} {identity.number}{date}, {say(made_by)}"))
    yield ""
    stated = Words(
        "{of} attached file as the certificate states", plural="{of} attached files as the certificate states"
    )
    pages = Words("{of} page as printed again", plural="{of} pages as printed again")
    parts = Words("{of} part as printed again", plural="{of} parts as printed again")
    note = say(Words("note"))
    yield from lay_out_table(
        [
            (say(_PARTS["signature"]), _COLOURS[signature.verdict].set(make_visible(say(signature.detail)))),
            *_say_summary(say(_PARTS["files"]), found.files, stated, say),
            *_tell_numbers(found.values, say),
            *_say_summary(say(_PARTS["pages"]), found.pages, pages, say),
            *_say_summary(say(_PARTS["document"]), found.document, parts, say),
            *((note, Colour.YELLOW.set(make_visible(say(remark)))) for remark in found.remarks),
        ],
        indent="  ",
        wrapping=1,
    )
    for standard in dict.fromkeys(value.path[1] for value in found.values if _is_of_parameter(value)):
        yield ""
        yield from _tell_parameters(standard, found.values, say)
    if found.own_words:
        yield ""
        yield from _list_own_words(found.own_words, say)


def _tell_verdict(found: CheckedCertificate, say: _Say) -> str:
    outcome, count = say(_SAID[found.outcome]), found.differences
    match found.outcome:
        case VerificationOutcome.HOLDS if found.is_trusted:
            trusted = Words("signed by a key that is trusted")
            return say(named(Colour.GREEN.set(outcome), trusted))
        case VerificationOutcome.HOLDS:
            unknown = Words("consistent, origin unknown")
            return say(named(Colour.GREEN.set(outcome), unknown))
        case VerificationOutcome.UNDECIDED:
            names = list_in_words([_PARTS[each] for each in found.undecided])
            open_parts = Words("{names} could not be compared whole")
            return say(named(Colour.YELLOW.set(outcome), open_parts.given(names=names)))
    differences = Words("{number} difference", plural="{number} differences").given(number=count)
    return say(named(Colour.RED.set(outcome), differences))


def _say_summary(
    label: str, findings: Sequence[CheckedStatement], what: Words, say: _Say
) -> Iterator[tuple[str, str]]:
    """Yield how many findings hold, and each that does not."""
    if not findings:
        return
    others = [each for each in findings if each.verdict is not VerificationVerdict.HOLDS]
    yield (
        label,
        say(what.given(of=_count_of(len(findings) - len(others), len(findings)), number=len(findings))),
    )
    for each in others[:_MOST_LINES]:
        verdict = _COLOURS[each.verdict].set(say(_SAID[each.verdict]))
        yield "", f"{verdict}  {make_visible(say(named(each.subject, each.detail)))}"
    if len(others) > _MOST_LINES:
        more = Words("and {n} more: see --json")
        yield "", say(more.given(n=len(others) - _MOST_LINES))


def _count_of(number: int, total: int) -> Words:
    return Words("{number} of {total}").given(number=number, total=total)


def _tell_numbers(values: Sequence[ComparedValue], say: _Say) -> Iterator[tuple[str, str]]:
    """Yield how many numbers hold, and each value that does not and stands in no table below."""
    numbers = sum(value.is_number for value in values)
    if not numbers:
        return
    holding = sum(value.is_number and value.verdict is VerificationVerdict.HOLDS for value in values)
    given = Words("{of} as the attached readings give them")
    yield say(Words("numbers")), say(given.given(of=_count_of(holding, numbers)))
    elsewhere = [
        CheckedStatement(
            " ".join(step for step in value.path if step not in _CONTAINERS), value.verdict, _say_both(value)
        )
        for value in values
        if value.verdict is VerificationVerdict.DIFFERS and not _is_of_parameter(value)
    ]
    yield from list(_say_summary("", elsewhere, given, say))[1:]


def _list_own_words(texts: Sequence[QuotedText], say: _Say) -> Iterator[str]:
    """Yield the words that somebody else wrote, each once, with what nobody can tell by looking."""
    yield f"  {say(_OWN_WORDS)}"
    by_text: dict[str, list[QuotedText]] = {}
    for each in texts:
        by_text.setdefault(each.text, []).append(each)
    for text, alike in by_text.items():
        places = ", ".join(_name_places([each.key for each in alike], say))
        quote = f"'{_shorten(text)}'"
        yield make_visible(f"  {say(named(places, quote))}")
        yield from (
            f"    {_COLOURS[VerificationVerdict.OPEN].set(make_visible(say(oddity)))}"
            for oddity in alike[0].oddities
        )


def _name_places(keys: Sequence[str], say: _Say) -> Iterator[str]:
    """Yield the keys under which a text stands: those of several measurements that end alike as one."""
    by_end: dict[str, list[list[str]]] = {}
    for key in keys:
        steps = key.split(".")
        by_end.setdefault(".".join(steps[-_STEPS_OF_A_KEY:]), []).append(steps)
    for alike in by_end.values():
        shared = 0
        while all(len(each) > shared and each[-1 - shared] == alike[0][-1 - shared] for each in alike):
            shared += 1
        key = ".".join(alike[0][-shared:])
        names = [".".join(each[:-shared]) for each in alike]
        others = [each for each in names if each]
        words = _ALSO_IN if len(others) < len(names) else _IN
        # The only key there is has nothing before what it shares with itself.
        yield say(words.given(key=key, names=_name_a_few(others, say))) if others else key


def _name_a_few(names: Sequence[str], say: _Say) -> str:
    if len(names) <= _MOST_PLACES + 1:
        return ", ".join(names)
    more = say(Words("and {n} more").given(n=len(names) - _MOST_PLACES))
    return f"{', '.join(names[:_MOST_PLACES])} {more}"


def _shorten(text: str) -> str:
    line = " ".join(text.split())
    return line if len(line) <= _LONGEST_QUOTE else f"{line[: _LONGEST_QUOTE - 1]}…"


def _tell_parameters(standard: str, values: Sequence[ComparedValue], say: _Say) -> Iterator[str]:
    """Yield the parameters of a standard, each with all that is stated of it and differs."""
    of_standard = [value for value in values if _is_of_parameter(value) and value.path[1] == standard]
    units = {str(value.recomputed) for value in of_standard if value.path[-1] == "unit"}
    unit = " ".join(find_printed_symbol(each) for each in sorted(units))
    rows = []
    for symbol in dict.fromkeys(value.path[3] for value in of_standard):
        own = {value.path[-1]: value for value in of_standard if value.path[3] == symbol}
        wrong = {key: value for key, value in own.items() if value.verdict is VerificationVerdict.DIFFERS}
        verdict = VerificationVerdict.DIFFERS if wrong else VerificationVerdict.HOLDS
        others = "; ".join(f"{key}: {_say_both(value)}" for key, value in wrong.items() if key != "value")
        value = own.get("value")
        rows.append(
            (
                make_visible(symbol),
                *(_show_difference(value) if value else ("", "")),
                _COLOURS[verdict].set(say(_SAID[verdict])) + make_visible(f"  {others}" if others else ""),
            )
        )
    stated, recomputed = Words("stated"), Words("recomputed")
    head = make_visible(standard), say(stated), say(recomputed), unit
    yield from lay_out_table([head, *rows], right=(1, 2), indent="  ")


def _is_of_parameter(value: ComparedValue) -> bool:
    return len(value.path) > 4 and value.path[0] == "evaluations" and value.path[2] == "parameters"


def _say_both(value: ComparedValue) -> str:
    stated, recomputed = _show_difference(value)
    return f"{stated} is stated, and {recomputed} recomputed"


def _show_difference(value: ComparedValue) -> tuple[str, str]:
    """Return the stated and the recomputed value with as many digits as tell the two apart."""
    for digits in range(5, 18):
        stated, recomputed = (_write_value(each, digits) for each in (value.stated, value.recomputed))
        if stated != recomputed or value.verdict is not VerificationVerdict.DIFFERS:
            break
    return stated, recomputed


def _write_value(value: object, digits: int) -> str:
    if value is None:
        return "nothing"
    if is_number(value):
        return f"{value:.{digits}g}"
    if isinstance(value, bool):
        return str(value).lower()
    text = str(value)
    return f"'{text}'" if len(text) <= _LONGEST_TEXT else f"'{text[: _LONGEST_TEXT - 1]}…'"


def _collect_values(path: Path, found: CheckedCertificate, exit_code: int) -> dict[str, Any]:
    """Return all that was found; values are in the units of the results file."""
    return {
        "schema": SCHEMA,
        "zlmreport": __version__,
        "exit_code": exit_code,
        "file": str(path),
        "verdict": found.outcome.value,
        "holds": _HOLDS[found.outcome],
        "trusted": found.is_trusted,
        "time_trusted": found.is_time_trusted,
        "undecided": list(found.undecided),
        "differences": found.differences,
        "certificate": asdict(found.identity),
        "signature": _collect_finding(found.signature),
        "files": _collect_findings(found.files),
        "values": [
            {
                "path": "/".join(value.path),
                "stated": value.stated,
                "recomputed": value.recomputed,
                "verdict": value.verdict.value,
            }
            for value in found.values
        ],
        "pages": _collect_findings(found.pages),
        "document": _collect_findings(found.document),
        "own_words": [
            {
                "key": each.key,
                "text": each.text,
                "marks": list(map(said, each.oddities)),
                "claim": said(each.claim) if each.claim else None,
            }
            for each in found.own_words
        ],
        "remarks": list(map(said, found.remarks)),
    }


def _collect_findings(findings: Iterable[CheckedStatement]) -> list[dict[str, str]]:
    return [_collect_finding(each) for each in findings]


def _collect_finding(finding: CheckedStatement) -> dict[str, str]:
    return {"subject": finding.subject, "verdict": finding.verdict.value, "detail": said(finding.detail)}
