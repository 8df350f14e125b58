"""Jobs that build on other files."""

from __future__ import annotations

import hashlib
from pathlib import Path

import pytest

from job.jobs import REGISTRY, SOUND
from refusals import refused
from zlmreport.errors import Place
from zlmreport.job.extends import LONGEST_CHAIN
from zlmreport.job.loading import load
from zlmreport.plugin import AccessError, InputError
from zlmreport.plugin.extension import Job


def _files(folder: Path, **texts: str) -> Path:
    """Write files, and return the job among them."""
    for name, text in texts.items():
        path = folder / f"{name.replace('__', '/')}.yaml"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    return folder / "job.yaml"


def _loaded(folder: Path, **texts: str) -> Job:
    return load(_files(folder, **texts), REGISTRY)


def test_groups_are_merged_and_the_jobs_own_word_holds(tmp_path: Path) -> None:
    base = "machine: {manufacturer: Ours, serial: 1}\ncustomer: {name: Theirs}\n"
    job = _loaded(tmp_path, job=f"extends: base.yaml\n{SOUND}", base=base)
    assert job.keys.machine.manufacturer == "Ours"
    assert job.keys.machine.serial == "17"
    assert job.keys.customer is not None


def test_lists_are_replaced(tmp_path: Path) -> None:
    base = "evaluate: [no-such-standard, another]\n"
    job = _loaded(tmp_path, job=f"extends: base.yaml\n{SOUND}", base=base)
    assert [choice.identifier for choice in job.standards] == ["exemplary:1"]


def test_of_several_files_the_later_one_holds(tmp_path: Path) -> None:
    first, second = "customer: {name: A, address: First}\n", "customer: {name: B}\n"
    job = _loaded(tmp_path, job=f"extends: [first.yaml, second.yaml]\n{SOUND}", first=first, second=second)
    assert job.keys.customer is not None
    assert (job.keys.customer.name, job.keys.customer.address) == ("B", "First")


def test_extended_file_may_extend_another(tmp_path: Path) -> None:
    files = {"a": "extends: b.yaml\n", "b": "customer: {name: B}\n"}
    job = _loaded(tmp_path, job=f"extends: a.yaml\n{SOUND}", **files)
    assert job.keys.customer is not None


def test_value_can_be_taken_away(tmp_path: Path) -> None:
    job = _loaded(tmp_path, job=f"extends: a.yaml\n{SOUND}customer:\n", a="customer: {name: B}\n")
    assert job.keys.customer is None


def test_an_extended_file_may_end_in_capitals(tmp_path: Path) -> None:
    (tmp_path / "Shared.YML").write_text("customer: {name: B}\n", encoding="utf-8")
    job = _loaded(tmp_path, job=f"extends: Shared.YML\n{SOUND}")
    assert job.keys.customer.name == "B"


def test_paths_are_relative_to_the_file_that_names_them(tmp_path: Path) -> None:
    shared = "laboratory: {name: L, logo: logo.png}\noutput: {directory: results}\n"
    text = SOUND.replace("output: {directory: out, formats: [exemplary]}", "output: {formats: [exemplary]}")
    job = _loaded(tmp_path, job=f"extends: shared/laboratory.yaml\n{text}", shared__laboratory=shared)
    assert job.keys.laboratory is not None
    assert job.keys.laboratory.logo == tmp_path / "shared" / "logo.png"
    assert job.directory == tmp_path / "shared" / "results"
    assert job.source.options.file == tmp_path / "six.txt"


def test_mistake_in_an_extended_file_is_placed_there(tmp_path: Path) -> None:
    (problem,) = refused(
        _loaded, tmp_path, job=f"extends: base.yaml\n{SOUND}", base="machine:\n  manufactuer: Ours\n"
    ).problems
    assert problem.place.file == str(tmp_path / "base.yaml")
    assert (problem.place.line, problem.place.column) == (2, 3)


def test_what_each_job_has_of_its_own_is_missing_in_the_job_and_not_in_a_file_that_it_extends(
    tmp_path: Path,
) -> None:
    base = (
        "certificate: {kind: report}\naxis: {kind: linear, travel: [0, 300]}\n"
        "measurement: {date: 2026-11-18, source: {plugin: exemplary-text}}\n"
    )
    job = "schema: zlmreport/job/1\nextends: base.yaml\nevaluate: [exemplary:1]\n"
    problems = refused(_loaded, tmp_path, job=job, base=base).problems
    assert [each.message.split(" is missing")[0] for each in problems] == [
        "axis.name",
        "certificate.number",
        "measurement.source.file",
    ]
    assert {each.place for each in problems} == {Place(str(tmp_path / "job.yaml"), 1, 1)}


def test_a_group_that_a_job_begins_is_where_it_lacks_a_key(tmp_path: Path) -> None:
    job = SOUND.replace("    file: six.txt\n", "").replace("    plugin: exemplary-text\n", "    words: []\n")
    (problem, *_) = refused(
        _loaded,
        tmp_path,
        job=f"extends: base.yaml\n{job}",
        base="measurement: {source: {plugin: exemplary-text}}\n",
    ).problems
    assert problem.place.file == str(tmp_path / "job.yaml")


def test_what_an_extended_file_begins_is_missing_there(tmp_path: Path) -> None:
    base = "certificate: {authorised_by: {function: Head}}\n"
    (problem,) = refused(_loaded, tmp_path, job=f"extends: base.yaml\n{SOUND}", base=base).problems
    assert problem.message.startswith("certificate.authorised_by.name is missing")
    assert problem.place == Place(str(tmp_path / "base.yaml"), 1, 15)


@pytest.mark.parametrize("certificate", ["", "certificate: {language: de}\n"])
def test_a_document_of_several_jobs_lacks_its_number_itself(tmp_path: Path, certificate: str) -> None:
    document = f"schema: zlmreport/job/1\n{certificate}measurements: [part.yaml]\n"
    (problem,) = refused(_loaded, tmp_path, job=document, part=SOUND).problems
    assert problem.message.startswith("certificate.number is missing")
    assert problem.place == Place(str(tmp_path / "job.yaml"), 2 if certificate else 1, 1)


def test_missing_file_is_named_where_it_is_extended(tmp_path: Path) -> None:
    with pytest.raises(AccessError, match=r"job\.yaml:1:19: .*none\.yaml cannot be read: no such file"):
        _loaded(tmp_path, job=f"extends: [a.yaml, none.yaml]\n{SOUND}", a="machine: {}\n")


def test_circle_is_refused_with_its_chain(tmp_path: Path) -> None:
    with pytest.raises(
        InputError, match=r"b\.yaml:1:10: .* in a circle: job\.yaml → a\.yaml → b\.yaml → a\.yaml"
    ):
        _loaded(tmp_path, job=f"extends: a.yaml\n{SOUND}", a="extends: b.yaml\n", b="extends: a.yaml\n")


def test_file_that_extends_itself_is_a_circle(tmp_path: Path) -> None:
    with pytest.raises(InputError, match=r"in a circle: job\.yaml → job\.yaml"):
        _loaded(tmp_path, job=f"extends: ./job.yaml\n{SOUND}")


def test_circle_by_a_link_is_found(tmp_path: Path) -> None:
    (tmp_path / "link.yaml").symlink_to("job.yaml")
    with pytest.raises(InputError, match="in a circle"):
        _loaded(tmp_path, job=f"extends: link.yaml\n{SOUND}")


def test_same_file_by_two_ways_is_no_circle(tmp_path: Path) -> None:
    files = {"a": "extends: c.yaml\n", "b": "extends: c.yaml\n", "c": "customer: {name: C}\n"}
    job = _loaded(tmp_path, job=f"extends: [a.yaml, b.yaml]\n{SOUND}", **files)
    assert [file.name for file in job.files] == ["job.yaml", "a.yaml", "c.yaml", "b.yaml"]


def test_endless_row_of_files_ends(tmp_path: Path) -> None:
    files = {f"f{number}": f"extends: f{number + 1}.yaml\n" for number in range(LONGEST_CHAIN + 1)}
    with pytest.raises(InputError, match=f"more than {LONGEST_CHAIN} files extend one another in a row"):
        _loaded(tmp_path, job=f"extends: f0.yaml\n{SOUND}", **files)


def test_files_that_extend_the_next_one_twice_are_read_once(tmp_path: Path) -> None:
    last = LONGEST_CHAIN - 2
    files = {f"f{number}": f"extends: [f{number + 1}.yaml, f{number + 1}.yaml]\n" for number in range(last)}
    job = _loaded(
        tmp_path, job=f"extends: f0.yaml\n{SOUND}", **files, **{f"f{last}": "customer: {name: C}\n"}
    )
    assert len(job.files) == LONGEST_CHAIN


def test_files_are_known_by_name_size_and_digest(tmp_path: Path) -> None:
    job = _loaded(tmp_path, job=SOUND)
    (file,) = job.files
    content = (tmp_path / "job.yaml").read_bytes()
    assert (file.name, file.size, file.sha256) == (
        "job.yaml",
        len(content),
        hashlib.sha256(content).hexdigest(),
    )
