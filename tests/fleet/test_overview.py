"""The overview says first what needs somebody, and shows every axis."""

from __future__ import annotations

import base64
import hashlib
import itertools
import re
import zlib
from dataclasses import replace
from datetime import UTC, datetime, timedelta
from html import unescape
from html.parser import HTMLParser
from typing import Any
from xml.etree import ElementTree as ET

import pytest

from fleet.histories import entry, history, parameter, quarters
from zlmreport.fleet.overview import MOST_DRAWN, make_overview
from zlmreport.fleet.printing import Names
from zlmreport.fleet.records import MODEL, About, LedgerEntry, NightNotice, PastNight, State
from zlmreport.fleet.state import describe_state
from zlmreport.plugin import Language, same_in_all_languages as same
from zlmreport.plugin.registry import find_plugins

NIGHT = datetime(2026, 11, 21, 2, 0, tzinfo=UTC)
LATEST = quarters(8)[-1]


def of_night(one: LedgerEntry, **changes: Any) -> LedgerEntry:
    return replace(one, night=NIGHT.isoformat(), **changes)


def page(*entries: LedgerEntry, language: Language = Language.ENGLISH, files: str = ".") -> str:
    jobs = [each.job for each in entries]
    night = PastNight(NIGHT, NIGHT + timedelta(seconds=94)) if entries else None
    state = describe_state("Hall North", entries, jobs, night)
    return make_overview(state, language, Names(find_plugins().standards), files)


def text(html: str) -> str:
    """Return what a reader sees, in one line."""
    body = html.partition("<main>")[2] or html
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", " ", re.sub(r"<svg.*?</svg>", " ", body, flags=re.DOTALL)))


def section(html: str, key: str) -> str:
    return html.partition(f'<section id="{key}"')[2].partition("</section>")[0]


def needs(*entries: LedgerEntry, **options: Any) -> str:
    return text(section(page(*entries, **options), "needs"))


CALM = history([8.0, 8.4, 8.1, 8.3, 8.2])
FAILURE = of_night(
    entry(LATEST, job="y/2026.yaml", state=State.FAILED, measured="", message="y.csv:3:4: 'abc' is no number")
)


def test_what_concerns_the_whole_night_stands_first() -> None:
    notices = (NightNotice(About.FOLDER, same("the folder is empty")),)
    state = describe_state("Hall North", CALM, ["x"], PastNight(NIGHT, NIGHT, notices))
    html = make_overview(state, Language.ENGLISH, Names(find_plugins().standards), ".")
    assert "Folder of certificates the folder is empty" in text(section(html, "needs"))


def test_jobs_that_there_was_no_time_for_are_not_called_unchanged() -> None:
    night = PastNight(NIGHT, NIGHT, untried=("x", "y"))
    state = describe_state("Hall North", (), ["x", "y", "z"], night)
    html = make_overview(state, Language.ENGLISH, Names(find_plugins().standards), ".")
    assert "0 made, 1 unchanged, 0 as drafts, 0 failed, 2 left for lack of time" in html


def test_a_fleet_without_trouble_says_so() -> None:
    assert "Nothing: every job was made" in needs(*CALM)


def test_a_fleet_that_never_ran_says_so() -> None:
    assert "has not run yet" in needs()


def test_a_failure_is_told_with_its_message() -> None:
    said = needs(*CALM, FAILURE)
    assert "y/2026.yaml" in said
    assert "y.csv:3:4: &#39;abc&#39; is no number" in said


def test_a_failure_is_told_with_the_night_since_which_it_fails() -> None:
    made = entry(quarters(1)[0], parameter(8.0), job=FAILURE.job, night="2026-11-18T02:00:00+00:00")
    nights = [replace(FAILURE, night=f"2026-11-{day}T02:00:00+00:00") for day in (19, 20)]
    assert "2026-11-19" in needs(made, *nights, FAILURE)


def test_a_failure_that_was_mended_is_none() -> None:
    before = replace(FAILURE, night="2026-11-20T02:00:00+00:00")
    mended = of_night(entry(LATEST, parameter(8.0), job=FAILURE.job))
    assert "abc" not in needs(before, mended)


def test_a_job_that_is_no_longer_of_the_fleet_does_not_fail() -> None:
    state = describe_state("Hall North", [*CALM, FAILURE], [each.job for each in CALM], None)
    assert state.failures == ()


def test_a_limit_that_is_not_met_is_told_with_value_uncertainty_and_limit() -> None:
    said = needs(entry(LATEST, parameter(21.04, conforms=False)))
    assert "Limit not met" in said
    assert "21.0 ± 1.0 µm" in said
    assert "20 µm" in said


def test_what_the_latest_certificate_of_an_axis_leaves_doubtful_is_told_with_what_to_do() -> None:
    first, second = quarters(2)
    doubts = (same("Run 3 mirrors the others"), same("All readings are equal"))
    said = needs(entry(first, parameter(8.0)), entry(second, parameter(8.0), doubts=doubts))
    assert "Doubtful 1 Axes whose latest certificate has readings or units that look wrong: " in said
    assert "correct the job or its readings and issue an amendment" in said
    axis = f"X Example Works MT 500, serial 1 CAL-{second} JSON"
    assert f"{axis} Run 3 mirrors the others All readings are equal" in said


def test_what_was_doubtful_of_an_earlier_certificate_is_history() -> None:
    first, second = quarters(2)
    before = entry(first, parameter(8.0), doubts=(same("Run 3 mirrors the others"),))
    assert "Nothing" in needs(before, entry(second, parameter(8.0)))


def test_a_tile_and_the_table_that_it_leads_to_count_the_same() -> None:
    html = page(entry(LATEST, parameter(21.0, conforms=False), parameter(30.0, symbol="E", conforms=False)))
    assert '<span class="number">1</span> <span class="label">Limit not met</span>' in html
    assert 'Limit not met <span class="count">1</span>' in html


def test_a_limit_that_was_not_met_before_an_adjustment_is_history() -> None:
    first, second = quarters(2)
    before = entry(first, parameter(21.0, conforms=False))
    assert "Nothing" in needs(before, entry(second, parameter(12.0)))


def test_a_limit_that_nothing_is_stated_of_is_told() -> None:
    assert "Undecided" in needs(entry(LATEST, parameter(19.8, conforms=None)))


def test_a_drift_is_told_with_the_month_in_which_its_limit_is_met() -> None:
    # 8 µm in January 2025 and 4.4 µm a year: 20 µm after 2.7 years.
    said = needs(*history([8.0, 9.12, 10.18, 11.31, 12.4, 13.49]))
    assert "Drifting" in said
    assert "/year" in said
    assert re.search(r"2027-0[789]", said)


def test_a_drift_away_from_the_limit_has_no_month() -> None:
    assert "moves away from it" in needs(*history([13.49, 12.4, 11.31, 10.18, 9.12, 8.0]))


def test_a_drift_that_began_beyond_its_limit_has_no_month_that_nobody_saw() -> None:
    """The line leads back to a day before the first test: of what was then nothing is known."""
    told = needs(*history([22.0, 23.1, 24.0, 25.2, 26.1, 27.0], limit=20.0))
    assert "before the first date" in told
    assert "2024-" not in told


def test_a_drift_without_a_limit_is_told_all_the_same() -> None:
    assert "no limit stated" in needs(*history([8.0, 9.12, 10.18, 11.31, 12.4, 13.49], limit=None))


def test_a_draft_is_told_with_its_reason() -> None:
    draft = of_night(entry(LATEST, state=State.DRAFT, message="the readings have changed"))
    assert "the readings have changed" in needs(draft)


def test_what_needs_somebody_comes_before_the_machines() -> None:
    html = page(*CALM, FAILURE)
    assert html.index('id="needs"') < html.index('id="machines"')


def test_failures_come_first() -> None:
    html = page(entry(LATEST, parameter(21.0, conforms=False)), FAILURE)
    assert html.index('<h3 id="failed"') < html.index('<h3 id="not-met"')


def test_every_axis_is_shown_with_its_latest_value_and_a_graph() -> None:
    entries = [*CALM, *history([3.0, 3.1, 3.2, 3.1, 3.25], axis="Y")]
    machines = section(page(*entries), "machines")
    assert "3.2 ± 1.0 µm" in text(machines)
    assert machines.count("<svg") == 2


def test_a_parameter_without_a_limit_is_shown_where_its_standard_limits_none() -> None:
    stated = (parameter(8.0), parameter(2.0, symbol="R", limit=None, conforms=None))
    other = parameter(9.0, standard="vdi-dgq-3441", symbol="P", limit=None, conforms=None)
    shown = text(section(page(entry(LATEST, *stated, other)), "machines"))
    assert "9.0 ± 1.0 µm" in shown
    assert "2.0 ± 1.0 µm" not in shown


def test_few_calibrations_are_told_from_steady_ones() -> None:
    shown = text(section(page(*CALM[:2]), "machines"))
    assert "2 of 5 dates" in shown


def test_standards_and_symbols_have_their_printed_names() -> None:
    shown = text(section(page(entry(LATEST, parameter(8.0, symbol="A_fwd"))), "machines"))
    assert "A ↑ ISO 230-2:2014" in shown


def test_a_standard_that_is_not_installed_any_more_is_shown_by_its_identifier() -> None:
    shown = text(section(page(entry(LATEST, parameter(8.0, standard="house-1", symbol="H_x"))), "machines"))
    assert "house-1" in shown


def test_a_value_has_the_sign_that_its_standard_prints() -> None:
    # ISO 230-2:1988 prints the mean reversal value with the sign opposite to the results file.
    reversal = parameter(-1.2, standard="iso230-2:1988", symbol="B_mean", expanded_uncertainty=0.1)
    html = page(entry(LATEST, reversal))
    assert " 1.20 ± 0.10 µm" in text(section(html, "machines"))
    assert f"of {LATEST.isoformat()}: 1.20 µm." in html


def test_axes_stand_below_their_machine_each_with_what_was_measured() -> None:
    straight = parameter(3.0, standard="iso230-1:2012", symbol="straightness")
    other = [
        entry(LATEST, straight, axis="EYX", job="eyx.yaml"),
        entry(LATEST, parameter(4.0), machine="B 2"),
    ]
    shown = text(section(page(*CALM, *other), "machines"))
    assert "Example Works MT 500, serial 1 2 axes EYX Straightness" in shown
    assert "B 2 1 axis X A ISO 230-2:2014 4.0 ± 1.0 µm" in shown


def test_a_small_graph_leads_to_the_trend_in_full() -> None:
    html = page(*history([8.0, 9.1, 9.9, 11.0, 12.1, 12.9, 14.0, 15.1]))
    (address,) = set(re.findall(r'<a class="to-trend" href="#([^"]+)" title="8 values of A', html))
    trend = html.partition(f'<article class="trend" id="{address}"')[2].partition("</article>")[0]
    said = text(f"<main>{trend}")
    for part in (
        "X of Example Works MT 500, serial 1",
        "Drift +4.0",
        "/year",
        "2026-10-14 15.1 ± 1.0 µm 20 µm met",
    ):
        assert part in said
    assert said.count("± 1.0 µm") == 8


def test_of_a_large_fleet_graphs_of_what_needs_nobody_are_packed() -> None:
    axes = [
        replace(each, machine=f"MT 500 EX-{number:03}", job=f"{number}/{each.job}")
        for number in range(MOST_DRAWN)
        for each in CALM
    ]
    exceeds = entry(LATEST, parameter(21.0, conforms=False), axis="Z", job="z.yaml")
    html = page(*axes, exceeds)
    shown = re.findall(r'<a class="to-trend" href="#(trend-\d+)"', html)
    assert len(shown) == 2, "in what needs somebody, and among the machines"
    packed = [
        link
        for content in re.findall(r'<script type="application/zlib"[^>]*>(.*?)</script>', html)
        for link in re.findall(r'href="#(trend-\d+)"', zlib.decompress(base64.b64decode(content)).decode())
    ]
    places = [f"trend-{number}" for number in re.findall(r'data-trend="(\d+)"', html)]
    assert packed == places
    assert len({*packed, *shown}) == MOST_DRAWN + 1
    assert len(html) < 600_000


def test_a_trend_shows_the_effects_of_its_axis() -> None:
    play = parameter(4.0, standard=MODEL, symbol="backlash.lost_motion", limit=None, conforms=None)
    html = page(*(replace(each, parameters=(*each.parameters, play)) for each in CALM))
    assert "Effects Parameters of this axis’s error model" in text(html.replace("article", "main"))
    assert "backlash lost motion 4.0 ± 1.0 µm" in text(html.partition("<article")[2])


def test_a_run_at_work_is_not_called_interrupted() -> None:
    night = PastNight(NIGHT, None, came_to={State.MADE: 3}, beat=NIGHT + timedelta(minutes=9))
    said = {}
    for minutes in (10, 60):
        state = describe_state("Hall North", CALM, ["x"], night.see_at(NIGHT + timedelta(minutes=minutes)))
        said[minutes] = make_overview(state, Language.ENGLISH, Names(find_plugins().standards), ".")
    assert "at work: 3 jobs so far" in said[10]
    assert "interrupted" not in said[10]
    assert "interrupted" in said[60]


def test_the_run_as_a_whole_is_no_number_where_there_is_nothing_to_say() -> None:
    tiles = page(*CALM).partition('<ul class="tiles"')[2].partition("</ul>")[0]
    assert "Notices on the run" not in tiles


def test_links_lead_from_the_page_to_the_certificates() -> None:
    one = entry(LATEST, parameter(8.0), files=("MT 500/X/CAL-1.pdf",))
    assert 'href="../certificates/MT%20500/X/CAL-1.pdf"' in page(one, files="../certificates")


def test_users_text_is_no_markup() -> None:
    html = page(entry(LATEST, parameter(8.0), machine="<script>alert(1)</script>"))
    assert "<script>alert" not in html


def test_the_page_loads_nothing_and_runs_only_its_own_script() -> None:
    html = page(*CALM, FAILURE)
    addresses = re.findall(r"(?:src|href)\s*=\s*\"([^\"]*)|url\(([^)]{0,20})", html)
    assert all(
        not re.match(r"[a-z]+:|//", link) and (not url or url.startswith("data:")) for link, url in addresses
    )
    (script,) = re.findall(r"<script>(.*?)</script>", html, re.DOTALL)
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    assert (
        f"default-src 'none'; style-src 'unsafe-inline'; font-src data:; script-src 'sha256-{digest}'"
        in unescape(html)
    )


def test_what_machines_of_one_type_share_is_shown_together() -> None:
    entries = [
        entry(
            LATEST,
            parameter(8.0),
            parameter(value, standard=MODEL, symbol="backlash.lost_motion", limit=None, conforms=None),
            machine=f"Works MC 800 EX-{value}",
            type="Works MC 800",
            job=f"{value}.yaml",
        )
        for value in (4.1, 3.8, 4.4, 4.0)
    ]
    said = text(section(page(*entries), "shared"))
    assert "X Works MC 800 backlash lost motion 4.08 ± 0.40 µm 4 Works MC 800 EX-3.8," in said


def test_the_page_is_well_formed() -> None:
    ET.fromstring(page(*CALM, FAILURE).partition("\n")[2])


class _Outline(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.levels: list[int] = []
        self.tables = self.captions = 0

    def handle_starttag(self, tag: str, attrs: object) -> None:
        del attrs
        if re.fullmatch(r"h\d", tag):
            self.levels.append(int(tag[1]))
        self.tables += tag == "table"
        self.captions += tag == "caption"


@pytest.fixture(scope="module")
def outline() -> _Outline:
    found = _Outline()
    found.feed(page(*CALM, FAILURE, entry(LATEST, parameter(21.0, conforms=False), axis="Z", job="z.yaml")))
    return found


def test_headings_leave_out_no_level(outline: _Outline) -> None:
    assert outline.levels[0] == 1
    assert all(later <= earlier + 1 for earlier, later in itertools.pairwise(outline.levels))


def test_every_table_has_a_caption(outline: _Outline) -> None:
    assert outline.tables == outline.captions > 0


def test_every_graph_says_what_it_shows() -> None:
    labels = re.findall(r'<svg[^>]*aria-label="([^"]*)"', page(*CALM))
    assert labels[0] == "5 values of A from 2025-01-15 to 2026-01-14, the last 8.20 µm. Limit 20.00 µm."


def test_the_same_ledger_gives_the_same_page() -> None:
    assert page(*CALM, FAILURE) == page(*CALM, FAILURE)


def test_a_german_page_is_german() -> None:
    said = needs(*CALM, FAILURE, language=Language.GERMAN)
    assert "Was auf Sie wartet" in said
    shown = text(section(page(*CALM, language=Language.GERMAN), "machines"))
    assert "8,2 ± 1,0 µm" in shown


def test_the_headline_tells_the_last_run() -> None:
    html = page(*CALM, FAILURE)
    headline = text(html.replace("<main>", ""))
    assert "2026-11-21 02:00 UTC, 1 min 34 s" in headline
    assert "6: 0 made, 5 unchanged, 0 as drafts, 1 failed" in html
