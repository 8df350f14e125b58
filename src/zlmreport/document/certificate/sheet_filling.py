"""The layout ``sheet``: which sentences and facts find room on the page, and which go to the details.

A page with room for everything holds everything: facts in two columns as many as go, the others as running
text. Where there is less, it keeps what matters most to somebody at the machine: what is to be noted, who and
what was measured, and what the law wants. The rest is handed back, for the page of details.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, TypeAlias, TypeVar

from zlmreport.document.blocks import Block, Facts, Notice, Paragraph
from zlmreport.document.certificate import columns
from zlmreport.language import Words, join_parts, named

if TYPE_CHECKING:
    from zlmreport.document.writer import Writer

#: A name and a value.
Pair: TypeAlias = tuple[str, str]

_T = TypeVar("_T")
_B = TypeVar("_B", bound=Block)

#: Facts in two columns: at most, for more are no longer read at a glance; and where room is short, for
#: customer and machine are looked for.
_MOST_IN_COLUMNS, _FEWEST_IN_COLUMNS = 24, 4
#: Lines in a column of who and what was measured; a longer one is running text.
_MOST_LINES = 3

_DETAILS = Words("Details")
_ELSEWHERE = Words("On the page “{details}”: {what}.")
_TO_BE_NOTED = Words("To be noted")
_SEE_DETAILS = Words("{heading}: see the page “{details}”")

#: How the page calls what stands elsewhere.
_NAMES = {
    "notices": Words("what is to be noted"),
    "who": Words("who and what"),
    "law": Words("decision rule and uncertainty"),
    "conditions": Words("further conditions"),
    "corrections": Words("the corrections"),
}


@dataclass(frozen=True, slots=True)
class SheetContent:
    """What there is to say, each in the order in which it matters."""

    notices: tuple[Notice, ...] = ()  #: What must not be overlooked.
    who: tuple[Pair, ...] = ()  #: Customer, machine, dates, who answers for it.
    law: tuple[Paragraph, ...] = ()  #: Sentences on decision rule, uncertainty and traceability.
    #: Under which circumstances; a group without a heading has names that say of what they are.
    conditions: tuple[Facts, ...] = ()
    #: Facts of conditions that are short and understood without the heading of their group.
    plain: frozenset[Pair] = frozenset()
    corrections: tuple[Block, ...] = ()  #: What was corrected.

    @property
    def names(self) -> list[str]:
        """What of all this there is, in its order."""
        return [name for name in _NAMES if getattr(self, name)]


@dataclass(frozen=True, slots=True)
class Filled:
    """What stands on the page: below the graph, below the parameters, and what has no place on it."""

    notices: tuple[Notice, ...]
    others: tuple[Block, ...]
    left: SheetContent

    @property
    def height(self) -> float:
        """How much of the page all of it takes, points."""
        return columns.estimate_height(self.notices) + columns.estimate_height(self.others)


def fill(said: SheetContent, room: float, writer: Writer, gained: float = 0.0) -> Filled:
    """Return what a page with so much room holds; `gained` is what it has besides if it is not the last."""
    whole = _fill_with_all(said, room, writer)
    if whole:
        return whole
    filled = _fill_with_what_matters(said, room + gained, writer, _NAMES)
    return _fill_with_what_matters(said, room + gained, writer, filled.left.names)


def measure_least(said: SheetContent, writer: Writer) -> float:
    """Return the points of a page that no more than says where all of it stands."""
    pointed_at = _list_ways_to_note(said.notices, writer)[-1]
    return columns.estimate_height([_say_elsewhere(said.names, writer), *pointed_at])


def lay_out_details(
    left: Iterable[SheetContent], writer: Writer, page: float
) -> tuple[str, tuple[Block, ...]]:
    """Return title and blocks of the page of what sheets do not hold; what several lack stands there once.

    What is too long for a page of so many points stands there in small type.
    """
    lacking = tuple(left)
    groups: dict[str, dict[Pair, None]] = {"": dict.fromkeys(pair for each in lacking for pair in each.who)}
    for each in lacking:
        for group in each.conditions:
            groups.setdefault(group.heading, {}).update(dict.fromkeys(group.pairs))
    facts = [Facts(tuple(pairs), heading) for heading, pairs in groups.items() if pairs]
    law = [paragraph for each in lacking for paragraph in each.law]
    small_facts = [block for each in facts for block in _set_fine(_write_in_running_text([each], writer))]
    small_law = [replace(each, fine=True) for each in law]
    title = writer.say(_DETAILS)
    ways: list[tuple[Block, ...]] = [
        (
            *(notice for each in lacking for notice in each.notices),
            *stated,
            *sentences,
            *(block for each in lacking for block in each.corrections),
        )
        for stated, sentences in ((facts, law), (facts, small_law), (small_facts, small_law))
    ]
    once = [tuple(dict.fromkeys(blocks)) for blocks in ways]
    room = page - columns.estimate_heading_height(title)
    return title, next((blocks for blocks in once if columns.estimate_height(blocks) <= room), once[-1])


def _fill_with_all(said: SheetContent, room: float, writer: Writer) -> Filled | None:
    """Return everything, with as many facts in columns as there is room for; None where not all fits."""
    notices = _box_notices(said.notices, writer)
    short, _ = _split_by_length(said.who)
    short += tuple(pair for group in said.conditions for pair in group.pairs if pair in said.plain)
    most = min(len(short), _MOST_IN_COLUMNS)
    for count in range(most, min(most, _FEWEST_IN_COLUMNS) - 1, -1):
        shown = short[:count]
        others = (
            *_balance_columns(shown),
            *_write_facts_in_a_line(_keep_others(said.who, shown), writer),
            *_split_sentences(said.law),
            *_set_fine(_write_in_running_text(_drop_facts(said.conditions, shown), writer)),
            *said.corrections,
        )
        filled = Filled(notices, others, SheetContent())
        if filled.height <= room:
            return filled
    return None


def _fill_with_what_matters(
    said: SheetContent, room: float, writer: Writer, reserved: Iterable[str]
) -> Filled:
    """Return the page whose room is taken in the order of what matters, with the line that says what is gone.

    `reserved`: What of its names that line has room for.
    """
    ways = _list_ways_to_note(said.notices, writer)
    in_full, pointed_at = ways[0], ways[-1]
    page = _Room(room)
    page.take([_say_elsewhere(reserved, writer), *pointed_at])
    noted = page.upgrade(pointed_at, ways[1:])
    who, long_who = _who(said, page, writer)
    law = page.choose(said.law, _split_sentences)
    noted = page.upgrade(noted, ways)
    plain = [pair for group in said.conditions for pair in group.pairs if pair in said.plain]
    shown = page.choose(plain[: _MOST_IN_COLUMNS - len(who)], _balance_columns, after=who)
    further = _drop_facts(said.conditions, shown)
    pairs = [pair for group in further for pair in group.pairs]
    running = page.choose(
        pairs, lambda pairs: _set_fine(_write_in_running_text(_keep_facts(further, pairs), writer))
    )
    corrections = page.upgrade((), [said.corrections])
    cut = said.notices if noted == pointed_at else _cut(said.notices, writer)
    left = SheetContent(
        notices=() if noted == in_full else cut,
        who=_keep_others(said.who, (*who, *long_who)),
        law=_keep_others(said.law, law),
        conditions=_drop_facts(further, running),
        corrections=_keep_others(said.corrections, corrections),
    )
    others = (
        *_balance_columns((*who, *shown)),
        *_write_facts_in_a_line(long_who, writer),
        *_split_sentences(law),
        *_set_fine(_write_in_running_text(_keep_facts(further, running), writer)),
        *corrections,
    )
    pointer = [_say_elsewhere(left.names, writer)] if left.names else []
    return Filled(noted, (*others, *pointer), left)


def _who(said: SheetContent, page: _Room, writer: Writer) -> tuple[tuple[Pair, ...], tuple[Pair, ...]]:
    """Take room for who and what was measured; return what of it stands in columns, and what in a line.

    In columns stands what leaves room for the law.
    """
    short, _ = _split_by_length(said.who)
    ways = [(short[:count], _keep_others(said.who, short[:count])) for count in (_FEWEST_IN_COLUMNS, 0)]
    for beside in (_split_sentences(said.law), ()):
        for in_columns, in_a_line in ways:
            blocks: list[Block] = [*_balance_columns(in_columns), *_write_facts_in_a_line(in_a_line, writer)]
            if page.holds((*blocks, *beside)):
                page.take(blocks)
                return in_columns, in_a_line
    return (), page.choose(said.who, lambda pairs: _write_facts_in_a_line(pairs, writer))


class _Room:
    """Room of a page, that is taken piece by piece."""

    def __init__(self, free: float) -> None:
        self._free = free

    def holds(self, blocks: Sequence[Block]) -> bool:
        return columns.estimate_height(blocks) <= self._free

    def take(self, blocks: Sequence[Block]) -> None:
        self._free -= columns.estimate_height(blocks)

    def choose(
        self,
        items: Sequence[_T],
        laid: Callable[[tuple[_T, ...]], Sequence[Block]],
        after: tuple[_T, ...] = (),
    ) -> tuple[_T, ...]:
        """Take room for those items that it holds, in their order; those they stand `after` have theirs."""
        already = columns.estimate_height(laid(after))
        chosen: tuple[_T, ...] = ()
        for item in items:
            if columns.estimate_height(laid((*after, *chosen, item))) - already <= self._free:
                chosen = (*chosen, item)
        self._free -= columns.estimate_height(laid((*after, *chosen))) - already
        return chosen

    def upgrade(self, now: tuple[_B, ...], ways: Sequence[tuple[_B, ...]]) -> tuple[_B, ...]:
        """Return the first of the ways that there is room for in place of what stands there now, or that."""
        free = self._free + columns.estimate_height(now)
        for way in ways:
            if columns.estimate_height(way) <= free:
                self._free = free - columns.estimate_height(way)
                return way
        return now


def _list_ways_to_note(notices: tuple[Notice, ...], writer: Writer) -> list[tuple[Notice, ...]]:
    """Return from long to short how notices stand.

    In full; those of a line in full, and of the others the headings, with the page where they stand; that
    page alone.
    """
    if not notices:
        return [()]

    def elsewhere(heading: str | Words) -> Notice:
        return Notice(writer.say(_SEE_DETAILS.given(heading=heading, details=_DETAILS)), ())

    brief = tuple(each if _is_short(each, writer) else elsewhere(each.heading) for each in notices)
    pointed_at = elsewhere(_TO_BE_NOTED)
    return [_box_notices(notices, writer), _box_notices(brief, writer), (pointed_at,)]


def _cut(notices: Iterable[Notice], writer: Writer) -> tuple[Notice, ...]:
    """Return the notices of which a page that is short of room has but the headings."""
    return tuple(each for each in notices if each.items and not _is_short(each, writer))


def _is_short(notice: Notice, writer: Writer) -> bool:
    """Return whether a notice is a line, and no more is to be said of it."""
    return columns.notice_lines(_write_as_item(notice, writer)) == 1


def _box_notices(notices: tuple[Notice, ...], writer: Writer) -> tuple[Notice, ...]:
    """Return several notices as one: frames take room."""
    if len(notices) < 2:
        return notices
    symbols = tuple(dict.fromkeys(symbol for each in notices for symbol in each.symbols))
    items = tuple(_write_as_item(each, writer) for each in notices)
    return (Notice(writer.say(_TO_BE_NOTED), items, symbols=symbols),)


def _write_as_item(notice: Notice, writer: Writer) -> str:
    if not notice.items:
        return notice.heading
    return writer.say(named(notice.heading, join_parts(notice.items, writer.language)))


def _say_elsewhere(names: Iterable[str], writer: Writer) -> Paragraph:
    """Return the line that says what stands on the page of details."""
    what = ", ".join(writer.say(_NAMES[name]) for name in names)
    return Paragraph(writer.say(_ELSEWHERE.given(details=_DETAILS, what=what)), fine=True)


def _split_by_length(pairs: Sequence[Pair]) -> tuple[tuple[Pair, ...], tuple[Pair, ...]]:
    """Return the facts that a column holds in a few lines, and the others."""
    short = tuple(pair for pair in pairs if columns.count_fact_lines(*pair) <= _MOST_LINES)
    return short, _keep_others(pairs, short)


def _keep_others(items: Iterable[_T], taken: Container[_T]) -> tuple[_T, ...]:
    return tuple(each for each in items if each not in taken)


def _drop_facts(groups: Iterable[Facts], taken: Container[Pair]) -> tuple[Facts, ...]:
    """Return groups without some of their facts, and without groups that have no other."""
    left = (replace(group, pairs=_keep_others(group.pairs, taken)) for group in groups)
    return tuple(group for group in left if group.pairs)


def _keep_facts(groups: Sequence[Facts], kept: Container[Pair]) -> tuple[Facts, ...]:
    return _drop_facts(groups, {pair for group in groups for pair in group.pairs if pair not in kept})


def _set_fine(text: str) -> tuple[Paragraph, ...]:
    return (Paragraph(text, fine=True),) if text else ()


def _split_sentences(paragraphs: Sequence[Paragraph]) -> tuple[Paragraph, ...]:
    symbols = dict.fromkeys(symbol for each in paragraphs for symbol in each.symbols)
    fine = _set_fine(" ".join(each.text for each in paragraphs))
    return tuple(replace(each, symbols=tuple(symbols)) for each in fine)


def _write_facts_in_a_line(pairs: Iterable[Pair], writer: Writer) -> tuple[Paragraph, ...]:
    return _set_fine(_write_in_a_line(pairs, writer))


def _write_in_a_line(pairs: Iterable[Pair], writer: Writer) -> str:
    said = (writer.say(named(*pair)) for pair in pairs)
    text = join_parts(said, writer.language)
    return f"{text.rstrip('. ')}." if text else ""


def _write_in_running_text(groups: Iterable[Facts], writer: Writer) -> str:
    return " ".join(
        f"{group.heading} – {_write_in_a_line(group.pairs, writer)}"
        if group.heading
        else _write_in_a_line(group.pairs, writer)
        for group in groups
    )


def _balance_columns(pairs: Sequence[Pair]) -> tuple[Facts, ...]:
    """Return facts as two groups of nearly one height, which stand beside each other."""
    if len(pairs) < 2:
        return (Facts(tuple(pairs)),) if pairs else ()
    lines = [columns.count_fact_lines(*pair) for pair in pairs]
    end = min(range(1, len(pairs)), key=lambda end: max(sum(lines[:end]), sum(lines[end:])))
    return Facts(tuple(pairs[:end])), Facts(tuple(pairs[end:]))
