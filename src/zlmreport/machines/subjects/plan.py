"""The next run of a ballbar as people read it."""

from __future__ import annotations

from zlmreport.document.blocks import Block, Cell, Column, Paragraph, Section
from zlmreport.language import Words, list_in_words
from zlmreport.language.formatting import write_percentage
from zlmreport.machines.planning import NextRun
from zlmreport.machines.subjects.saying import Sayer, make_plain_table, make_right_column


def lay_out_plan(found: NextRun, say: Sayer) -> Section:
    """Return what is to be decided, the runs that do, and what these circles can see."""
    between = [each.title for each in found.between]
    heading = _NOTHING
    if between:
        heading = Words("To tell {effects} apart:").given(effects=list_in_words(between))
    runs: list[tuple[Cell, ...]] = [
        (
            say(each.what),
            say.write_number(each.minutes, 0),
            write_percentage(each.decides, say.language.decimal_sign) if between else "",
        )
        for each in found.proposals
    ]
    blocks: list[Block] = [Paragraph(say(heading))]
    columns = (Column(say(_RUN)), make_right_column(say(_MINUTES)), make_right_column(say(_DECIDES), "%"))
    blocks.append(make_plain_table(say(_NEXT), columns, runs))
    sizes: list[tuple[Cell, ...]] = [
        (
            each.effect,
            say(each.title),
            say.write_general(float(f"{each.unit.from_si(each.size):.2g}")),
            each.unit.symbol,
        )
        for each in found.visible
    ]
    headings = (
        Column(say(_EFFECT)),
        Column(say(_PARAMETER)),
        make_right_column(say(_SIZE)),
        Column(say(_UNIT)),
    )
    blocks += [Paragraph(say(_VISIBLE)), make_plain_table(say(_VISIBLE), headings, sizes)]
    return Section("plan", say(_NEXT), tuple(blocks))


_NEXT = Words("The next run")
_NOTHING = Words("Nothing is to be decided; runs that would add to this:")
_RUN, _MINUTES = Words("run"), Words("minutes")
_DECIDES = Words("decides")
_VISIBLE = Words("Smallest size that these circles show half of the time:")
_EFFECT, _PARAMETER = Words("Effect"), Words("Parameter", context="model")
_SIZE, _UNIT = Words("Size"), Words("Unit")
