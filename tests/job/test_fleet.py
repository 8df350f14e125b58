"""The fleet file: what it may say, and what is said of a mistake in it."""

from __future__ import annotations

from pathlib import Path

import pytest

from job.jobs import REGISTRY, SOUND
from refusals import refusal
from zlmreport.job.extends import Defaults
from zlmreport.job.fleet import FleetFile, list_job_files, load_fleet, number_of
from zlmreport.job.loading import load
from zlmreport.job.parse import parse
from zlmreport.plugin import AccessError, InputError

FLEET = "schema: zlmreport/fleet/1\njobs: jobs/*.yaml\n"


def loaded(folder: Path, *lines: str) -> FleetFile:
    path = folder / "fleet.yaml"
    path.write_text(FLEET + "".join(f"{line}\n" for line in lines), encoding="utf-8")
    return load_fleet(path)


def mistakes(folder: Path, *lines: str) -> str:
    return refusal(loaded, folder, *lines).replace(f"{folder}/", "")


def test_a_schema_and_jobs_are_enough(tmp_path: Path) -> None:
    fleet = loaded(tmp_path)
    assert fleet.name == "fleet"
    assert fleet.output == tmp_path / "certificates"
    assert fleet.ledger == str(tmp_path / "fleet.ledger.db")
    assert fleet.defaults is None
    assert not fleet.formats


def test_files_are_found_beside_the_fleet_file(tmp_path: Path) -> None:
    fleet = loaded(tmp_path, "output: {directory: out}", "ledger: data/ledger.db", "log: {file: fleet.log}")
    assert fleet.output == tmp_path / "out"
    assert fleet.ledger == str(tmp_path / "data/ledger.db")
    assert fleet.keys.log
    assert fleet.keys.log.file == tmp_path / "fleet.log"


def test_the_url_of_a_database_stays_as_it_is(tmp_path: Path) -> None:
    url = "postgresql+psycopg://zlmreport@server/fleet"
    assert loaded(tmp_path, f"ledger: {url}").ledger == url


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("ledgr: x.db", "fleet.yaml:3:1: unknown key 'ledgr'; did you mean 'ledger'?"),
        (
            "ledger: mysql://x/y",
            "fleet.yaml:3:9: ledger: 'mysql://x/y' is no ledger; write a file, or postgresql",
        ),
        ("output: {layot: x}", "fleet.yaml:3:10: unknown key 'layot' in output; did you mean 'layout'?"),
        (
            "output: {layout: '{machin}'}",
            "fleet.yaml:3:18: output.layout: unknown placeholder 'machin'; did you mean 'machine'?",
        ),
        ("output: {layout: '{machine'}", "fleet.yaml:3:18: output.layout: '{machine' has a brace too many"),
        ("output: {layout: '../x'}", "fleet.yaml:3:18: output.layout: '../x' leads out of the output folder"),
        ("output: {layout: '{machine.x}'}", "unknown placeholder 'machine.x'"),
        ("executor: {kind: dusk}", "fleet.yaml:3:18: executor.kind: 'dusk' is unknown; did you mean 'dask'?"),
        ("executor: {kind: dask}", "fleet.yaml:3:1: executor: dask needs its scheduler's address"),
        (
            "executor: {scheduler: x}",
            "fleet.yaml:3:1: executor: processes have no scheduler; write kind: dask",
        ),
        (
            "executor: {kind: dask, scheduler: x, workers: 2}",
            "fleet.yaml:3:1: executor: the scheduler knows its workers; remove workers",
        ),
        ("executor: {workers: 0}", "fleet.yaml:3:21: executor.workers: '0' is not a number of at least 1"),
        (
            "defaults: {laboratry: {}}",
            "fleet.yaml:3:12: unknown key 'laboratry' in defaults; did you mean 'laboratory'?",
        ),
        (
            "defaults: {certificate: {number: A}}",
            "fleet.yaml:3:26: defaults.certificate.number: each certificate has a number of its own",
        ),
    ],
)
def test_a_mistake_is_named_with_its_place_and_what_would_be_right(
    tmp_path: Path, line: str, message: str
) -> None:
    assert message in mistakes(tmp_path, line)


@pytest.mark.parametrize(
    "line",
    ["output: {directory: ../out}", "ledger: ../x.db", "log: {file: ../x.log}", "priors: ../priors.yaml"],
)
def test_what_a_confined_fleet_keeps_elsewhere_is_told_where_it_stands(tmp_path: Path, line: str) -> None:
    said = mistakes(tmp_path, "confine: .", line)
    assert said.startswith("fleet.yaml:4:")
    assert "to which this run is confined" in said


def test_a_database_lies_in_no_folder_to_which_a_fleet_is_confined(tmp_path: Path) -> None:
    assert loaded(tmp_path, "confine: .", "ledger: postgresql://server/fleet").ledger.startswith("postgresql")


def test_a_job_is_no_fleet(tmp_path: Path) -> None:
    path = tmp_path / "job.yaml"
    path.write_text(SOUND, encoding="utf-8")
    with pytest.raises(InputError, match=r"this file is a job .* and a fleet of jobs is expected"):
        load_fleet(path)


def test_a_fleet_is_no_job(tmp_path: Path) -> None:
    loaded(tmp_path)
    with pytest.raises(
        InputError, match=r"this file is a fleet of jobs .*; zlmreport fleet FLEET.yaml takes it"
    ):
        load(tmp_path / "fleet.yaml", REGISTRY)


def test_a_fleet_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match=r"none.yaml: cannot be read: no such file"):
        load_fleet(tmp_path / "none.yaml")


def test_jobs_come_once_in_the_order_of_their_names(tmp_path: Path) -> None:
    for name in ("jobs/b.yaml", "jobs/a.yaml", "jobs/deep/c.yaml"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).touch()
    fleet = loaded(tmp_path)
    path = tmp_path / "all.yaml"
    path.write_text("schema: zlmreport/fleet/1\njobs: ['**/*.yaml', jobs/a.yaml]\n", encoding="utf-8")
    names = [str(each.relative_to(tmp_path)) for each in list_job_files(load_fleet(path))]
    assert names == ["fleet.yaml", "jobs/a.yaml", "jobs/b.yaml", "jobs/deep/c.yaml"]
    assert [each.name for each in list_job_files(fleet)] == ["a.yaml", "b.yaml"]


def test_a_job_that_is_named_in_several_ways_comes_once_by_its_plainest_name(tmp_path: Path) -> None:
    """Taken for two jobs, both would be refused: their number is the same."""
    (tmp_path / "hall" / "jobs").mkdir(parents=True)
    (tmp_path / "hall" / "jobs" / "x.yaml").touch()
    (tmp_path / "hall" / "jobs" / "a-link.yaml").symlink_to("x.yaml")
    (tmp_path / "hall" / "current").symlink_to("jobs")
    (tmp_path / "way").symlink_to("hall")
    for folder in (tmp_path / "hall", tmp_path / "way"):
        path = folder / "fleet.yaml"
        patterns = "jobs/../jobs/x.yaml", "./jobs/x.yaml", "current/*.yaml", "jobs/*.yaml", "../hall/jobs/*"
        path.write_text(f"schema: zlmreport/fleet/1\njobs: [{', '.join(patterns)}]\n", encoding="utf-8")
        assert list_job_files(load_fleet(path)) == (folder / "jobs" / "x.yaml",)
    path.write_text("schema: zlmreport/fleet/1\njobs: [jobs/../jobs/x.yaml]\n", encoding="utf-8")
    assert [each.name for each in list_job_files(load_fleet(path))] == ["x.yaml"]
    whole = tmp_path / "hall" / "jobs" / "x.yaml"
    path.write_text(f"schema: zlmreport/fleet/1\njobs: [{whole}]\n", encoding="utf-8")
    assert list_job_files(load_fleet(path)) == (whole,)


def test_every_pattern_without_a_file_is_named(tmp_path: Path) -> None:
    fleet = loaded(tmp_path)
    with pytest.raises(InputError, match=r"fleet.yaml:2:7: jobs: no file is called 'jobs/\*.yaml'; nothing"):
        list_job_files(fleet)


@pytest.mark.parametrize(
    ("pattern", "said"),
    [
        ("/nowhere/*.yaml", "nothing matches 'nowhere' in /"),
        (".", r"it is a folder; name the files in it, as in \./\*\.yaml"),
        ("machines", r"it is a folder; name the files in it, as in machines/\*\.yaml"),
        (f"{'m' * 300}/*.yaml", "nothing matches 'm"),
    ],
)
def test_a_pattern_that_leads_nowhere_is_told_how_far_it_leads(
    tmp_path: Path, pattern: str, said: str
) -> None:
    (tmp_path / "machines").mkdir()
    path = tmp_path / "fleet.yaml"
    path.write_text(f"schema: zlmreport/fleet/1\njobs: {pattern}\n", encoding="utf-8")
    with pytest.raises(InputError, match=said):
        list_job_files(load_fleet(path))


def test_the_number_of_a_job_is_found_where_it_stands(tmp_path: Path) -> None:
    (tmp_path / "base.yaml").write_text("certificate: {number: CAL-7}\n", encoding="utf-8")
    path = tmp_path / "job.yaml"
    path.write_text("extends: base.yaml\n", encoding="utf-8")
    number, place = number_of(path, None)
    assert (number, place.file, place.line, place.column) == ("CAL-7", str(tmp_path / "base.yaml"), 1, 23)


@pytest.fixture
def defaults(tmp_path: Path) -> Defaults:
    """Return defaults that extend a file, beside a job in a folder below."""
    (tmp_path / "jobs").mkdir()
    (tmp_path / "jobs/job.yaml").write_text(SOUND.replace("serial: 17", "serial: 0018"), encoding="utf-8")
    (tmp_path / "hall.yaml").write_text("machine: {location: Hall 7, model: M}\n", encoding="utf-8")
    fleet = loaded(tmp_path, "defaults:", "  extends: hall.yaml", "  machine: {serial: 1, model: '08 # 15'}")
    assert fleet.defaults
    return fleet.defaults


def test_a_job_stands_above_the_defaults_and_these_above_what_they_extend(
    tmp_path: Path, defaults: Defaults
) -> None:
    machine = load(tmp_path / "jobs/job.yaml", REGISTRY, defaults=defaults).keys.machine
    assert (machine.serial, machine.model, machine.location) == ("0018", "08 # 15", "Hall 7")


def test_a_mistake_in_the_defaults_is_named_in_the_fleet_file(tmp_path: Path, defaults: Defaults) -> None:
    job = load(tmp_path / "jobs/job.yaml", REGISTRY, defaults=defaults)
    place = job.place_of("machine.model")
    assert (place.file, place.line) == (str(tmp_path / "fleet.yaml"), 5)


def test_a_job_with_defaults_is_the_same_as_the_files_that_a_certificate_carries(
    tmp_path: Path, defaults: Defaults
) -> None:
    path = tmp_path / "jobs/job.yaml"
    files = defaults.as_files(path)
    for file in files:
        assert file.path
        assert file.content
        file.path.write_bytes(file.content)
    assert files[0].path
    carried = load(files[0].path, REGISTRY)
    assert carried.keys.model_copy(update={"extends": None}) == load(
        path, REGISTRY, defaults=defaults
    ).keys.model_copy(update={"extends": None})


@pytest.mark.parametrize(
    "text",
    [
        "a: 1\nb:\n- x\n- y: 2\n",
        "a: '1'\nb: \"x: y\"\n",
        "a: {}\nb: []\nc:\n",
        "'a b': |\n  two\n  lines\n",
        "a: [[1, 2], [3]]\n",
        "a: Gaugeway 1, 12345 Town\n",
    ],
)
def test_defaults_written_again_say_the_same(text: str) -> None:
    keys = parse(text.encode(), "fleet.yaml")
    again = parse(Defaults(keys, Path("fleet.yaml")).as_yaml().encode(), "fleet.yaml")
    assert _plain(again) == _plain(keys)


def _plain(node: object) -> object:
    """Return a tree without its places."""
    entries, items = getattr(node, "entries", None), getattr(node, "items", None)
    if entries is not None:
        return {key: _plain(entry.value) for key, entry in entries.items()}
    if isinstance(items, tuple):
        return [_plain(item) for item in items]
    return getattr(node, "text", ""), getattr(node, "is_nothing", None), getattr(node, "plain", None)
