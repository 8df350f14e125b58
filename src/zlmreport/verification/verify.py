"""The order of a verification: open, evaluate, print, compare; what is said of days and signatures."""

from __future__ import annotations

import datetime as dt
import json
import re
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from zlmreport import pipeline
from zlmreport.document.certificate.build import GENERATOR, Programs
from zlmreport.document.certificate.document import Certificate
from zlmreport.document.certificate.results_file import MACHINE_RESULTS
from zlmreport.document.signing.state import Integrity, Signature, SignatureState, read_signature_state
from zlmreport.errors import InputError, Place, Problem, ZlmreportError
from zlmreport.files import demand
from zlmreport.job.days import find_days_to_come, read_clock
from zlmreport.job.job import Job
from zlmreport.job.loading import load
from zlmreport.language import PartRow, Words, same
from zlmreport.plugin.protocols import Renderer, find_relationship_of, is_made_by
from zlmreport.plugin.registry import Registry
from zlmreport.verification import attached, pages, readers, structure, table, values
from zlmreport.verification.alone import format_of, verify_alone
from zlmreport.verification.attached import (
    Results,
    StatedResults,
    check_digital_certificates,
    find_stated_by,
    lay_out,
)
from zlmreport.verification.carrier import LARGEST, Carrier, find_results_in, guard, open_pdf, read_file
from zlmreport.verification.findings import (
    CheckedCertificate,
    CheckedStatement,
    Identity,
    QuotedText,
    VerificationVerdict,
)
from zlmreport.verification.own_texts import quote_own_texts, quote_own_texts_of

#: The format of a certificate whose creator is this program.
PRINTED = "pdf"
_PROGRAM = GENERATOR.partition(" ")[0]
_RELEASE = re.compile(r"\S+ \d{1,4}(\.\d{1,4}){0,3}((a|b|rc)\d{1,3})?", re.ASCII)
_OTHER_RELEASES = Words(
    "made by {stated}, and this is {here}: readings and parameters are compared, and what else differs is "
    "not decided; to decide, install the releases that made it, and verify it there"
)
_REPEATED = Words("made by {stated}; this is {here}, and it repeats all of it in that name")
_AHEAD = Words("{date} lies in the future: by the clock of this computer it is {today}")
_OWN_LOOK = Words(
    "printed in a typeface or by templates of the laboratory's own (certificate.style), which it does not "
    "carry: how its pages are drawn is not decided"
)
_LACKING_LETTERS = Words(
    "printed with letters that no typeface of this system has: how its pages are drawn is not decided"
)
_NUMBER = re.compile(r"\d+[.,]\d+")
#: Not those of a date, a standard or a document's own number.
_WHOLE_NUMBER = re.compile(r"(?<![\w.,:/-])\d+(?![\d:/-]|[.,]\d)")
_OTHER_RENDERER = Words(
    "printed by {creator}, which is not installed here: how pages are drawn is not decided; to decide, "
    "install it"
)
_OTHER_LIBRARIES = Words(
    "no page is drawn here as it was: other libraries printed it, or every page is altered; each mark on "
    "each page is compared by its shape, its colour and its place"
)
_NOT_ASKED = Words(
    "the file is not byte for byte what is made again (signed, or saved by another program), and {names} "
    "could not be asked what it shows: not installed here"
)

_SIGNATURE = "signature"


@dataclass(frozen=True, slots=True)
class _Again:
    """A certificate that was made again from its attachments.

    `programs` made it here, in whosever name; `results` is its results file. It may be that another renderer
    than the one that made it had to print it. `undrawn` says why its pages cannot be drawn here as they
    were, if they cannot. `own_words` are those of whoever wrote its job, and
    `future_dates` what it says of days that have not come; `digest` is that of its readings and results.
    """

    programs: Programs
    prints: pages.Prints
    results: bytes
    is_by_its_own_renderer: bool
    undrawn: Words | None
    own_words: tuple[QuotedText, ...] = ()
    future_dates: tuple[CheckedStatement, ...] = ()
    digest: str = ""


def verify(
    path: Path,
    registry: Registry,
    dcc_schema: Path | None = None,
    *,
    trusted: Sequence[Any] = (),
    require_signature: bool = False,
) -> CheckedCertificate:
    """Verify a certificate, or a file of one.

    `path`: A PDF that this program made, signed or not; or what it made beside one (`alone`).
    `dcc_schema`: A folder with PTB's schema, to check an attached digital certificate by it and by PTB's
        rules.
    `trusted`: Certificates of signers or of authorities, as `zlmreport.document.signing.state` reads them.

    Raises `AccessError` if it cannot be read, or printed again; `InputError` if it is no such PDF; or if it
    is, and what it carries cannot be evaluated here although none of its sources was changed: because a
    plugin is not installed, for example.
    """
    content = demand(path, LARGEST)
    if made_by := format_of(content):
        return verify_alone(
            path,
            content,
            made_by,
            registry,
            lambda pdf: verify(
                pdf, registry, dcc_schema, trusted=trusted, require_signature=require_signature
            ),
        )
    carrier = open_pdf(read_file(path), Place(str(path)))
    state = read_signature_state(carrier.content, trusted)
    found = CheckedCertificate(
        Identity(generator=carrier.creator),
        _find_on_signatures(state, is_required=require_signature),
        is_signed=state.integrity is not Integrity.UNSIGNED,
        is_trusted=state.is_trusted,
        is_time_trusted=state.is_time_trusted,
    )
    try:
        stated = find_stated_by(carrier)
    except ValueError as error:
        spoiled = CheckedStatement("results file", VerificationVerdict.DIFFERS, str(error))
        compared = attached.compare((), carrier.carried, None)
        changed = (each for each in compared if each.verdict is VerificationVerdict.DIFFERS)
        return replace(found, files=(spoiled, *changed))
    if stated is None:
        if not carrier.creator.startswith(f"{_PROGRAM} "):
            raise InputError.at(
                carrier.place,
                "is no certificate of zlmreport: it carries no results file to verify; one that was printed "
                "to PDF, scanned, split or joined with others has lost it: verify the file as it was issued",
            )
        lacking = CheckedStatement.of("results file", "is not attached; every certificate carries one")
        return replace(found, files=(lacking,))
    identity, provenance = dict(stated.results.certificate), stated.results.provenance
    found = replace(found, identity=Identity(**identity, generator=provenance.generator))
    sources = provenance.sources
    with lay_out(sources, carrier.carried) as layout:
        try:
            is_machine = stated.tree.get("schema") == MACHINE_RESULTS
            make_again = _make_machine_again if is_machine else make_certificate_again
            again = make_again(layout.job, carrier, stated.results, registry)
        except Exception as error:  # what anyone sent may break anything that it is handed to
            ended = error if isinstance(error, ZlmreportError) else _make_unforeseen(carrier.place, error)
            problems = layout.list_problems(ended)
            compared = attached.compare(sources, carrier.carried, None)
            if all(finding.verdict is not VerificationVerdict.DIFFERS for finding in compared):
                raise type(ended)([_place_within(carrier, each) for each in problems]) from error
            reason = f"cannot be evaluated again: {'; '.join(map(str, problems))}"
            return replace(found, files=(*compared, CheckedStatement.of("readings", reason)))
    complete = _compare(found, carrier, stated, again)
    if dcc_schema is None:
        return complete
    digital = check_digital_certificates(carrier.carried, dcc_schema)
    return replace(complete, files=(*complete.files, *digital))


def _place_within(carrier: Carrier, problem: Problem) -> Problem:
    """Return a problem of an attached file in the name of the certificate, too: only that is at hand."""
    if problem.place.file not in carrier.carried:
        return problem
    file = f"{Path(carrier.place.file).name}: {problem.place.file}"
    return replace(problem, place=replace(problem.place, file=file))


def _make_unforeseen(place: Place, error: Exception) -> ZlmreportError:
    reason = " ".join(f"{type(error).__name__}: {error}".split())[:300]
    return InputError.at(place, f"cannot be evaluated again: {reason}")


def make_certificate_again(job_path: Path, carrier: Carrier, stated: Results, registry: Registry) -> _Again:
    """Load the attached job, evaluate it, and print it with all that the document carries.

    It is printed in the name of the releases that it states: where their names are all that differs, another
    release has repeated it.
    """
    results, printer = registry.renderer(pipeline.RESULTS), _find_printer(carrier, registry)
    job, has_own_look = _replace_look(load(job_path, registry, formats=(printer.identifier,)))
    here = pipeline.find_programs(job, registry)
    named = stated.provenance.generator, stated.provenance.plugins
    certificate = pipeline.compose(job, registry, named if _are_releases_of(named, here) else here)
    others = [
        each
        for each in registry.renderers
        if each is not results and _is_carried(each, certificate, carrier) and _is_made(each, certificate)
    ]
    contents, has_letters = _print_again(certificate, [results, *others, printer], registry)
    undrawn = _OWN_LOOK if has_own_look else None if has_letters else _LACKING_LETTERS
    return _Again(
        here,
        pages.Prints(open_pdf(contents[printer.identifier], Place(f"{carrier.place} (printed again)"))),
        contents[pipeline.RESULTS],
        is_made_by(printer, carrier.creator) or carrier.creator.startswith(f"{_PROGRAM} "),
        undrawn,
        quote_own_texts(certificate, job),
        _say_days_to_come(job, read_clock()),
        certificate.digest,
    )


def _print_again(
    certificate: Certificate, renderers: Sequence[Renderer], registry: Registry
) -> tuple[Mapping[str, bytes], bool]:
    """Return the files of a certificate by their renderers, and whether a typeface has all its letters."""
    try:
        return pipeline.render(certificate, renderers, registry), True
    except InputError:
        with_boxes = replace(certificate, look=replace(certificate.look, may_lack_letters=True))
        return pipeline.render(with_boxes, renderers, registry), False


def _make_machine_again(path: Path, carrier: Carrier, stated: Results, registry: Registry) -> _Again:
    """Read the attached machine file with all that it names, and print its document again."""
    from zlmreport.machines.document import make_machine_document  # noqa: PLC0415 - only for such a document
    from zlmreport.machines.reading import read_machine  # noqa: PLC0415

    printer, here = _find_printer(carrier, registry), (GENERATOR, dict[str, str]())
    named = stated.provenance.generator, stated.provenance.plugins
    generator = named[0] if _are_releases_of(named, here) else GENERATOR
    machine = read_machine(path, registry, find_results_in)
    document = make_machine_document(machine, registry, generator)
    printed = printer.render(document.certificate)
    return _Again(
        here,
        pages.Prints(open_pdf(printed, Place(f"{carrier.place} (printed again)"))),
        document.results,
        is_made_by(printer, carrier.creator) or carrier.creator.startswith(f"{_PROGRAM} "),
        undrawn=None,
        own_words=quote_own_texts_of(machine.file.keys),
    )


def _say_days_to_come(job: Job, today: dt.date) -> tuple[CheckedStatement, ...]:
    """Return the days of a job that have not come yet, as not decided."""
    return tuple(
        CheckedStatement(
            f"{each.within}{each.key}",
            VerificationVerdict.OPEN,
            _AHEAD.given(date=each.day.isoformat(), today=today.isoformat()),
        )
        for each in find_days_to_come(job, today)
    )


def _replace_look(job: Job) -> tuple[Job, bool]:
    """Return a job in the bundled typeface and templates, and whether it asks for others.

    Those of whoever sent the document would show what they like, and are not run.
    """
    style = job.keys.certificate.style
    usual = style.model_copy(update={"typeface": None, "templates": None})
    certificate = job.keys.certificate.model_copy(update={"style": usual})
    return replace(job, keys=job.keys.model_copy(update={"certificate": certificate})), usual != style


def _are_releases_of(stated: Programs, here: Programs) -> bool:
    """Whether programs are the same but for their releases; whatever else stood there would be printed."""
    (generator, plugins), (generator_here, plugins_here) = stated, here
    return plugins.keys() == plugins_here.keys() and all(
        one == other or (_RELEASE.fullmatch(one) and one.split(" ")[0] == other.split(" ")[0])
        for one, other in (
            (generator, generator_here),
            *((plugins[each], plugins_here[each]) for each in plugins),
        )
    )


def _find_printer(carrier: Carrier, registry: Registry) -> Renderer:
    """Return the renderer that made a document, as the document says."""
    own = (each for each in registry.renderers if is_made_by(each, carrier.creator))
    return next(own, None) or registry.renderer(PRINTED)


def _is_carried(renderer: Renderer, certificate: Certificate, carrier: Carrier) -> bool:
    (name,) = pipeline.name_files(certificate.number, [renderer])
    return find_relationship_of(renderer) is not None and name in carrier.carried


def _is_made(renderer: Renderer, certificate: Certificate) -> bool:
    """Whether a file can be made of this certificate at all; one that cannot be is none of it."""
    try:
        renderer.render(certificate)
    except ZlmreportError:
        return False
    return True


def _compare(
    found: CheckedCertificate, carrier: Carrier, stated: StatedResults, again: _Again
) -> CheckedCertificate:
    """Return all that is found of a certificate that could be made again."""
    provenance = stated.results.provenance
    by_same_programs = again.programs == (provenance.generator, provenance.plugins)
    printed = _compare_printed(carrier, again.prints, is_signed=found.is_signed)
    compared = guard(
        lambda: values.compare(stated.tree, json.loads(again.results), same_programs=by_same_programs),
        carrier.place,
    )
    differs = any(each.verdict is not VerificationVerdict.HOLDS for each in compared)
    found = replace(
        found,
        identity=replace(found.identity, digest=again.digest),
        files=attached.compare(
            provenance.sources,
            carrier.carried,
            again.prints.carrier.carried,
            same_programs=by_same_programs,
            compared_by_value=stated.name if differs else "",
            same_processor=carrier.carried[stated.name].content == again.results,
        ),
        values=compared,
        pages=printed.pages,
        document=(*printed.document, *_list_claims(again.own_words), *again.future_dates),
        own_words=again.own_words,
    )
    if not by_same_programs:
        left_open = _leave_open(found)
        remark = _OTHER_RELEASES if left_open.undecided else _REPEATED
        stated_programs = _name_programs(provenance.generator, provenance.plugins)
        return replace(
            left_open, remarks=(remark.given(stated=stated_programs, here=_name_programs(*again.programs)),)
        )
    if not again.is_by_its_own_renderer:
        remark = _OTHER_RENDERER.given(creator=carrier.creator or "another renderer")
        return replace(_leave_open(found), remarks=(remark,))
    if again.undrawn:
        lacking = guard(lambda: _count_taken(carrier, again.prints.carrier), carrier.place)
        detail = f"{', '.join(sorted(lacking)[:8])} cannot be read on its pages" if lacking else ""
        left_open = _leave_open(found)
        found = replace(left_open, remarks=(again.undrawn,) if left_open.undecided else ())
        return replace(found, document=(*found.document, CheckedStatement.of("printed numbers", detail)))
    remarks = () if printed.is_drawn_alike else (_OTHER_LIBRARIES,)
    not_asked = readers.name_absent()
    if not_asked and any(each.subject == readers.SUBJECT for each in found.document):
        remarks = (*remarks, _NOT_ASKED.given(names=", ".join(not_asked)))
    return replace(found, remarks=remarks)


def _list_claims(own_words: Sequence[QuotedText]) -> tuple[CheckedStatement, ...]:
    """Return what words that somebody wrote claim, as not decided: nothing computes it."""
    return tuple(
        CheckedStatement(each.key, VerificationVerdict.OPEN, each.claim) for each in own_words if each.claim
    )


def _compare_printed(carrier: Carrier, again: pages.Prints, *, is_signed: bool) -> pages.ComparedPages:
    """Compare a document with the same one printed again: its bytes first.

    Nothing is interpreted where they are the same. What is not byte for byte the same is read strictly, and
    must be the same to every reader.
    """
    expected = again.carrier
    if carrier.content == expected.content:
        held = tuple(
            CheckedStatement(f"page {number}", VerificationVerdict.HOLDS)
            for number in range(1, len(expected.reader.pages) + 1)
        )
        return pages.ComparedPages(
            held,
            (CheckedStatement("the file, byte for byte", VerificationVerdict.HOLDS),),
            is_drawn_alike=True,
        )
    objects = table.check_table(carrier.content, is_signed=is_signed)
    printed = pages.compare(carrier, again, is_signed=is_signed)
    document = (objects, guard(lambda: structure.compare(carrier.reader), carrier.place), *printed.document)
    if all(each.verdict is VerificationVerdict.HOLDS for each in (*printed.pages, *document)):
        seen = guard(
            lambda: readers.compare(carrier, expected.content, is_drawn_alike=printed.is_same), carrier.place
        )
        document = (*document, seen)
    return replace(printed, document=document)


def _count_taken(stated: Carrier, again: Carrier) -> Counter[str]:
    """Return the numbers that are printed again, in the usual look, and do not stand on the pages.

    A whole number counts as taken only where others stand instead: heads of tables that go over pages are
    repeated in one look and not in the other. Where the looks have other numbers of pages, those count none.
    """
    texts, texts_again = (
        [page.extract_text() for page in carrier.reader.pages] for carrier in (stated, again)
    )
    taken = _count_numbers(texts_again, _NUMBER) - _count_numbers(texts, _NUMBER)
    whole, whole_again = _count_numbers(texts, _WHOLE_NUMBER), _count_numbers(texts_again, _WHOLE_NUMBER)
    most = 0 if len(texts) == len(texts_again) else max(len(texts), len(texts_again))
    of_pages = {str(page) for page in range(most + 1)}
    gone, instead = (
        Counter({each: count for each, count in numbers.items() if each not in of_pages})
        for numbers in (whole_again - whole, whole - whole_again)
    )
    return taken + gone if instead else taken


def _count_numbers(texts: Sequence[str], kind: re.Pattern[str]) -> Counter[str]:
    return Counter(each for text in texts for each in kind.findall(text))


def _name_programs(generator: str, plugins: Mapping[str, str]) -> str:
    return ", ".join(dict.fromkeys((generator, *sorted(plugins.values()))))


def _leave_open(found: CheckedCertificate) -> CheckedCertificate:
    """Return what is found of pages that cannot be printed here as they were: what differs is not decided."""

    def left_open(finding: CheckedStatement) -> CheckedStatement:
        return (
            replace(finding, verdict=VerificationVerdict.OPEN)
            if finding.verdict is VerificationVerdict.DIFFERS
            else finding
        )

    return replace(
        found, pages=tuple(map(left_open, found.pages)), document=tuple(map(left_open, found.document))
    )


def _find_on_signatures(state: SignatureState, *, is_required: bool) -> CheckedStatement:
    """Return what is to be said of the signatures of a PDF.

    `is_required` says whether it must bear an intact signature that is trusted.
    """
    verdict, detail = {
        Integrity.INTACT: (
            VerificationVerdict.HOLDS,
            _join_statements([_say_signed(each) for each in state.signatures]),
        ),
        Integrity.ALTERED: (
            VerificationVerdict.DIFFERS,
            Words("the file is signed, but {reason}").given(reason=state.reason),
        ),
        Integrity.UNSIGNED: (VerificationVerdict.OPEN, Words("not signed: nothing tells who made the file")),
        Integrity.UNCHECKED: (
            VerificationVerdict.OPEN,
            Words("signed, but the signature is not checked: {reason}").given(reason=state.reason),
        ),
    }[state.integrity]
    if is_required and not state.is_trusted and state.integrity is not Integrity.UNCHECKED:
        required = Words("a signature that is trusted is required")
        return CheckedStatement(_SIGNATURE, VerificationVerdict.DIFFERS, _join_statements([detail, required]))
    return CheckedStatement(_SIGNATURE, verdict, detail)


def _join_statements(parts: Sequence[Words]) -> Words:
    return same(PartRow(tuple(parts)))


def _say_signed(signature: Signature) -> Words:
    when = f"{signature.time:%Y-%m-%d %H:%M %Z}".rstrip() if signature.time else ""
    if signature.is_stamp:
        kept = Words("kept with its proofs since {when}, by {stamper}")
        return kept.given(when=when, stamper=signature.signer)
    by_clock = Words(", {when} by the signer's own clock, which nothing proves")
    by_stamp = Words(", {when} by a time stamp of {stamper}, {trust}").given(
        stamper=signature.stamped_by, trust=_say_trust(is_trusted=signature.is_time_trusted)
    )
    said = Words("intact, by {signer} (SHA-256 of the signer's certificate {digest}){time}; {trust}")
    return said.given(
        signer=signature.signer,
        digest=signature.fingerprint,
        time=(by_stamp if signature.stamped_by else by_clock).given(when=when) if when else "",
        trust=_say_trust(signature.distrust, is_trusted=signature.is_trusted),
    )


def _say_trust(distrust: str = "", *, is_trusted: bool) -> Words:
    if is_trusted:
        return Words("trusted")
    return same(distrust) if distrust not in {"", "of unknown trust"} else Words("of unknown trust")
