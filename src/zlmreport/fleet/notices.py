"""Notices on a whole night: jobs or folders gone, nothing to do, a wrong clock, a night that got stuck."""

from __future__ import annotations

import datetime as dt
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from zlmreport.errors import Place, ZlmreportError
from zlmreport.fleet.basis import Disk
from zlmreport.fleet.ledger import Night
from zlmreport.fleet.overview_words import AS_DRAFTS
from zlmreport.fleet.plan import Evening, PlannedJob, find_damage
from zlmreport.fleet.records import About, NightNotice, PastNight, State
from zlmreport.job.fleet import FleetFile, is_retired, number_of
from zlmreport.language import Words, same

#: So few may be gone without a word on mounts, or, of a large fleet, such a part.
_FEW, _PART = 3, 0.1
#: Of certificates that are gone, so many are named.
_NAMED = 5
#: About which a night says that it does nothing.
_REFUSALS = frozenset({About.JOBS, About.FOLDER, About.LEDGER})

_STUCK = Words("the night of {night} gave no sign of life; it was killed")
_BROKEN = Words(
    "the night of {night} was broken off, with its last sign of life at {beat}; it had come to {states}. "
    "This one makes good what it left"
)
_CAME_TO = {
    State.MADE: Words("{number} made"),
    State.DRAFT: AS_DRAFTS,
    State.FAILED: Words("{number} failed"),
    State.STOPPED: Words("{number} stopped"),
    State.SET_ASIDE: Words("{number} set aside"),
    State.VANISHED: Words("{number} vanished"),
}
_NOTHING = Words("nothing")
_CLOCK = Words("the clock stands at {now}, before the last night: {last}")
_MANY_GONE = Words("{gone} of {before} jobs are gone since the last night; look whether that is meant")
_MOST_GONE = Words(
    "the only job is gone since the last night; look whether its folder is mounted, or name it under "
    "retired if it is gone on purpose",
    plural="{gone} of {number} jobs are gone since the last night; look whether their folder is mounted, or "
    "name those under retired that are gone on purpose",
)
_NO_FOLDER = Words("is no folder, and the certificates of the fleet belong into one; move away what is there")
_EMPTY = Words(
    "the folder is empty, and {number} certificate was issued into it; look whether it is mounted. A "
    "file in it, whatever it is, lets the night make it again",
    plural="the folder is empty, and {number} certificates were issued into it; look whether it is mounted. "
    "A file in it, whatever it is, lets the night make them again",
)
_FOREIGN = Words(
    "the ledger knows none of the certificates in {folder}, where {found} of {jobs} jobs have theirs; put "
    "its backup back, or make it again: zlmreport fleet rebuild {fleet}"
)
_LEFT = Words(
    "the time of the night was over before {number} of {due} jobs; it is for the next night",
    plural="the time of the night was over before {number} of {due} jobs; they are for the next night",
)
_LEFT_ALONE = Words("the time of the night was over before its only job; it is for the next night")
_DOCUMENTS = Words(
    "{numbers}: issued, gone or changed since, and made again by no job; put them back from a backup, or "
    "name them under retired"
)
_MORE = Words("{numbers} and {more} more")


def find_vanished(known: Evening) -> tuple[str, ...]:
    """Return the jobs that the ledger knows, whose files are gone, and not on purpose."""
    there = set(map(known.name_job, known.jobs))
    return tuple(
        job for job in sorted(known.standings) if job not in there and not is_retired(job, known.fleet)
    )


def list_notices(
    known: Evening, night: Night, gone: Sequence[str], last: PastNight | None
) -> Iterator[NightNotice]:
    """Yield what is to be said before a night, and lets it go on."""
    yield from say_of_last(night, last)
    if last and dt.datetime.fromisoformat(night.began) < last.began:
        yield NightNotice(About.CLOCK, _CLOCK.given(now=night.began, last=last.began.isoformat()))
    new, before = _find_newly_gone(known, gone), len(known.jobs) + len(gone)
    if len(new) > _FEW and len(new) > _PART * before:
        yield NightNotice(About.JOBS, _MANY_GONE.given(gone=len(new), before=before))


def say_of_last(night: Night, last: PastNight | None) -> Iterator[NightNotice]:
    """Yield how the night before ended, if it did not end by itself; one that was refused since told it."""
    if night.took_over:
        yield NightNotice(About.STUCK, _STUCK.given(night=night.took_over))
    if last is None or not night.was_interrupted or night.took_over == last.began.isoformat():
        return
    told = {each.about for each in last.notices}
    if About.BROKEN not in told or not told & _REFUSALS:
        states = [_CAME_TO[each].given(number=last.came_to[each]) for each in State if each in last.came_to]
        came_to = _list_phrases(states) if states else _NOTHING
        beat = (last.beat or last.began).isoformat()
        text = _BROKEN.given(night=last.began.isoformat(), beat=beat, states=came_to)
        yield NightNotice(About.BROKEN, text)


def find_missing(known: Evening, gone: Sequence[str]) -> tuple[Place, NightNotice] | None:
    """Return what is not there and where: a folder that is not mounted, another fleet's ledger; else None."""
    fleet = known.fleet
    new = _find_newly_gone(known, gone)
    if (gone and not known.jobs) or (len(new) > _FEW and len(new) > len(known.jobs)):
        text = _MOST_GONE.given(gone=len(new or gone), number=len(known.jobs) + len(gone))
        return Place(str(fleet.path)), NightNotice(About.JOBS, text)
    own = [each for each in known.certificates.values() if each.fleet == fleet.name and each.files]
    if fleet.output.exists() and not fleet.output.is_dir():
        return Place(str(fleet.output)), NightNotice(About.FOLDER, _NO_FOLDER)
    is_empty = not fleet.output.is_dir() or not _has_other_than_reports(fleet)
    if own and is_empty:
        return Place(str(fleet.output)), NightNotice(About.FOLDER, _EMPTY.given(number=len(own)))
    if known.standings or is_empty:
        return None
    stems = {path.name.partition(".")[0] for path in fleet.output.rglob("*") if path.is_file()}
    found, jobs = sum(_find_number(path, fleet) in stems for path in known.jobs), len(known.jobs)
    if found > _FEW and 2 * found > jobs:
        places = {"folder": str(fleet.output), "fleet": str(fleet.path)}
        return Place(str(fleet.ledger)), NightNotice(
            About.LEDGER, _FOREIGN.given(found=found, jobs=jobs, **places)
        )
    return None


def say_left(number: int, due: int) -> Iterator[NightNotice]:
    """Yield how many jobs there was no time for."""
    if number:
        yield NightNotice(About.LEFT, _LEFT.given(number=number, due=due) if due > 1 else _LEFT_ALONE)


def find_left_documents(known: Evening, planned: Iterable[PlannedJob]) -> Iterator[NightNotice]:
    """Yield, after a night, what became of certificates that no job made again.

    They are those of retired jobs, of jobs that have another number by now, or that are drafts.
    """
    fleet, shelf = known.fleet, Disk(known.fleet.output)
    refused = {each.number for each in planned if each.problems}  # these say so themselves
    damaged = [
        number
        for number, issued in sorted(known.certificates.items())
        if issued.fleet == fleet.name
        and number not in refused
        and not is_retired(number, fleet)
        and any(find_damage(fleet.output, issued.files, shelf))
    ]
    if damaged:
        numbers = same(", ".join(damaged[:_NAMED]))
        more = len(damaged) - _NAMED
        text = _MORE.given(numbers=numbers, more=more) if more > 0 else numbers
        yield NightNotice(About.DOCUMENTS, _DOCUMENTS.given(numbers=text))


def _list_phrases(words: Sequence[Words]) -> Words:
    names = [f"word{index}" for index in range(len(words))]
    phrase = ", ".join(f"{{{name}}}" for name in names)
    return Words(phrase, values=dict(zip(names, words, strict=True)))


def _find_newly_gone(known: Evening, gone: Sequence[str]) -> Sequence[str]:
    return [job for job in gone if known.standings[job].state is not State.VANISHED]


def _has_other_than_reports(fleet: FleetFile) -> bool:
    """Whether anything lies in the folder of certificates but overviews, which are written there, too."""
    return any(path.name not in fleet.reports for path in fleet.output.iterdir())


def _find_number(path: Path, fleet: FleetFile) -> str:
    try:
        return number_of(path, fleet.defaults)[0]
    except ZlmreportError:
        return ""
