"""The overview of a fleet: one page of HTML that somebody opens each morning."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from datetime import date

from zlmreport.fleet import overview_words as words
from zlmreport.fleet.overview_cells import Cells
from zlmreport.fleet.overview_graph import Period
from zlmreport.fleet.overview_legend import legend
from zlmreport.fleet.overview_machines import machines
from zlmreport.fleet.overview_names import Names
from zlmreport.fleet.overview_needs import needs
from zlmreport.fleet.overview_state import FleetState, Night
from zlmreport.language import Language, Words
from zlmreport.typesetting.overview import (
    OverviewContext,
    OverviewSectionContext,
    TileContext,
    overview_style,
)
from zlmreport.typesetting.templates import render
from zlmreport.version import __version__

_MINUTE = 60


def overview(state: FleetState, language: Language, names: Names, files: str) -> str:
    """Return the page; the same ledger gives the same page.

    Parameters
    ----------
    state
        Of the fleet.
    language
        Of the page.
    names
        Of standards and their symbols.
    files
        Folder of the certificates, relative to that of the page.
    """
    cells = Cells(language, names, _period(state), files)
    printed = replace(state, trends=tuple(map(names.as_printed, state.trends)))
    return render(
        OverviewContext(
            language=language.value,
            title=cells.say(words.TITLE),
            subtitle=state.name,
            generator=f"zlmreport {__version__}",
            style=overview_style(),
            facts=tuple(_facts(printed, cells)),
            tiles=tuple(_tiles(printed, cells)),
            tiles_title=cells.say(words.HEADLINE),
            sections=tuple(map(render, _sections(printed, cells))),
        )
    )


def _period(state: FleetState) -> Period:
    dates = [each.measured for trend in state.trends for each in trend.series.calibrations]
    return Period(min(dates, default=date.min), max(dates, default=date.min))


def _facts(state: FleetState, cells: Cells) -> Iterator[tuple[str, str]]:
    yield cells.say(words.LAST_RUN), cells.say(_run(state.night))
    yield cells.say(words.JOBS), cells.say(words.JOBS_DONE.given(jobs=state.jobs, **state.counts))
    yield cells.say(words.CERTIFICATES), str(len(state.certificates))


def _run(night: Night | None) -> Words:
    if night is None:
        return words.NEVER
    began = night.began.strftime("%Y-%m-%d %H:%M UTC")
    if night.seconds is None:
        return words.INTERRUPTED.given(began=began)
    minutes, seconds = divmod(round(night.seconds), _MINUTE)
    duration = words.MINUTES.given(minutes=minutes, seconds=seconds) if minutes else words.SECONDS
    return words.RAN.given(began=began, duration=duration.given(number=seconds))


def _tiles(state: FleetState, cells: Cells) -> Iterator[TileContext]:
    drifting = {(each.series.machine, each.series.axis) for each in state.drifting}
    counted = (
        (len(state.failures), words.FAILED, "failed"),
        (len(state.not_met), words.NOT_MET, "not-met"),
        (len(state.undecided), words.UNDECIDED, "undecided"),
        (len(drifting), words.DRIFTING, "drifting"),
        (len(state.drafts), words.DRAFTS, "drafts"),
    )
    for number, label, key in counted:
        style = f"raised {key}" if number else "calm"
        yield TileContext(str(number), cells.say(label), style, key if number else "")
    yield TileContext(str(len(state.axes)), cells.say(words.AXES), "calm", "machines")


def _sections(state: FleetState, cells: Cells) -> Iterator[OverviewSectionContext]:
    needed = tuple(map(render, needs(state, cells)))
    nothing = "" if needed else cells.say(words.NOTHING if state.jobs else words.NO_NIGHT)
    yield OverviewSectionContext("needs", cells.say(words.NEEDS), nothing, "calm", needed)
    shown = tuple(map(render, machines(state, cells)))
    yield OverviewSectionContext("machines", cells.say(words.MACHINES), "", "", shown)
    reading = (render(legend(cells)),)
    yield OverviewSectionContext("reading", cells.say(words.READING), "", "", reading)
