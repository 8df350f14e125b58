"""The files that travel inside a certificate."""

from __future__ import annotations

from hashlib import sha256
from pathlib import Path

import pytest

from job.jobs import REGISTRY, SOUND
from zlmreport import pipeline
from zlmreport.document.certificate.attachments import (
    LARGEST_TOTAL,
    MOST_ATTACHMENTS,
    SourceRole,
    arrange_attachments,
    attach_sources,
    find_media_type,
    list_sources,
)
from zlmreport.job.loading import load
from zlmreport.plugin import InputError, Language
from zlmreport.plugin.renderer import Attachment, Certificate, CertificateSource, Relationship
from zlmreport.plugin.source import SourceFile

PNG = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\x08\0\0\0\0sums\0\0\0\0IENDsums"


def composed(folder: Path, *lines: str, readings: str = "six.txt", job: str = "jobs/job.yaml") -> Certificate:
    """Compose a sound job with more lines, whose readings lie in a file of this name."""
    path = folder / job
    path.parent.mkdir(parents=True, exist_ok=True)
    text = SOUND.replace("file: six.txt", f"file: {readings}")
    path.write_text(text + "\n".join(lines) + "\n")
    (path.parent / readings).parent.mkdir(parents=True, exist_ok=True)
    (path.parent / readings).write_text("1 2 3 -1 -2 -3")
    return pipeline.compose(load(path, REGISTRY), REGISTRY)


def attachment(name: str, size: int = 0) -> Attachment:
    return Attachment(name, bytes(size), "text/plain", Relationship.SOURCE, "")


def paths(sources: tuple[CertificateSource, ...]) -> dict[str, SourceRole]:
    return {source.path: source.role for source in sources}


def test_the_job_its_readings_and_what_it_names_are_its_sources(tmp_path: Path) -> None:
    (tmp_path / "laboratory.yaml").write_text("laboratory: {name: A, address: B, logo: pictures/logo.png}\n")
    (tmp_path / "pictures").mkdir()
    (tmp_path / "pictures/logo.png").write_bytes(PNG)
    certificate = composed(tmp_path, "extends: ../laboratory.yaml")
    assert paths(certificate.sources) == {
        "job.yaml": SourceRole.JOB,
        "../laboratory.yaml": SourceRole.EXTENDED,
        "six.txt": SourceRole.READINGS,
        "../pictures/logo.png": SourceRole.LOGO,
    }


def test_further_tests_and_what_earlier_ones_taught_are_named_as_such(tmp_path: Path) -> None:
    (tmp_path / "priors.yaml").write_text(
        "schema: zlmreport/priors/1\nkind: linear\ntests: 8\nnoise: {}\neffects: {}\n"
    )
    (tmp_path / "six.txt").write_text("1 2 3 -1 -2 -3")
    (tmp_path / "second.yaml").write_text(SOUND)
    (tmp_path / "job.yaml").write_text(f"{SOUND}model: {{sessions: [second.yaml], priors: priors.yaml}}\n")
    job = load(tmp_path / "job.yaml", REGISTRY)
    assert paths(list_sources(job, (), None)) == {
        "job.yaml": SourceRole.JOB,
        "second.yaml": SourceRole.SESSION,
        "priors.yaml": SourceRole.PRIORS,
    }


def test_a_table_of_the_axis_is_a_source(tmp_path: Path) -> None:
    (tmp_path / "jobs").mkdir()
    (tmp_path / "jobs/table.csv").write_text("position,deviation\n0,0\n300,1\n")
    text = SOUND.replace("travel: [0, 300]}", "travel: [0, 300], compensation_table: table.csv}")
    (tmp_path / "jobs/job.yaml").write_text(text)
    (tmp_path / "jobs/six.txt").write_text("1 2 3 -1 -2 -3")
    certificate = pipeline.compose(load(tmp_path / "jobs/job.yaml", REGISTRY), REGISTRY)
    assert paths(certificate.sources)["table.csv"] is SourceRole.TABLE


def test_a_source_is_carried_byte_for_byte(tmp_path: Path) -> None:
    certificate = composed(tmp_path)
    for source in certificate.sources:
        content = (tmp_path / "jobs" / source.path).read_bytes()
        assert source.file.content == content
        assert source.file.sha256 == sha256(content).hexdigest()


def test_what_lies_in_the_folder_later_is_not_what_is_carried(tmp_path: Path) -> None:
    certificate = composed(tmp_path)
    (tmp_path / "jobs/six.txt").write_text("9 9 9 9 9 9")
    contents = {each.name: each.content for each in attach_sources(certificate.sources, Language.ENGLISH)}
    assert contents["six.txt"] == b"1 2 3 -1 -2 -3"


@pytest.mark.parametrize("job", ["job.yaml", "data/job.yaml"])
def test_a_path_from_the_root_is_told_as_the_job_states_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, job: str
) -> None:
    monkeypatch.chdir(tmp_path)
    readings = str(tmp_path / "data" / "six.txt")
    for folder in (Path(), tmp_path):  # the job, too, may be named from the root
        certificate = composed(folder, readings=readings, job=job)
        assert [source.path for source in certificate.sources] == ["job.yaml", readings]


def test_no_document_tells_folders_that_the_job_does_not_state(tmp_path: Path) -> None:
    (tmp_path / "customers").mkdir()
    (tmp_path / "customers/laboratory.yaml").write_text("laboratory: {name: A, address: B, logo: logo.png}\n")
    (tmp_path / "customers/logo.png").write_bytes(PNG)
    certificate = composed(tmp_path, f"extends: {tmp_path}/customers/laboratory.yaml")
    assert certificate.sources[-1].path == "logo.png"


def test_files_of_one_name_are_told_apart(tmp_path: Path) -> None:
    (tmp_path / "job.yaml").write_text("axis: {name: Y}\n")
    certificate = composed(tmp_path, "extends: ../job.yaml")
    assert [(each.name, each.path) for each in certificate.sources] == [
        ("job.yaml", "job.yaml"),
        ("job-2.yaml", "../job.yaml"),
        ("six.txt", "six.txt"),
    ]


@pytest.mark.parametrize(
    ("readings", "name"),
    [
        ("CAL-1.json", "CAL-1-2.json"),  # the results file has that name
        ("CAL-1.laser.csv", "CAL-1-2.laser.csv"),  # so begin the names of the certificate's own files
        ("a:b?.txt", "a_b_.txt"),  # not seen, or not taken, everywhere
    ],
)
def test_a_source_whose_name_is_taken_or_not_plain_gets_another(
    tmp_path: Path, readings: str, name: str
) -> None:
    assert composed(tmp_path, readings=readings).sources[-1].name == name


@pytest.mark.parametrize(
    ("language", "description"),
    [
        (Language.ENGLISH, "Readings: six.txt"),
        (Language.GERMAN, "Messwerte: six.txt"),
        (Language.FRENCH, "Lectures\N{NO-BREAK SPACE}: six.txt"),
    ],
)
def test_an_attachment_says_what_it_is(tmp_path: Path, language: Language, description: str) -> None:
    *_, last = attach_sources(composed(tmp_path).sources, language)
    assert last == Attachment("six.txt", b"1 2 3 -1 -2 -3", "text/plain", Relationship.SOURCE, description)


def test_a_source_whose_reader_kept_no_bytes_is_named_and_not_attached() -> None:
    source = CertificateSource(SourceRole.READINGS, "x.csv", "x.csv", SourceFile("x.csv", "0" * 64, 3))
    assert list(attach_sources([source], Language.ENGLISH)) == []


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("x.csv", "text/csv"),
        ("X.CSV", "text/csv"),
        ("job.yaml", "application/yaml"),
        ("CAL-1.json", "application/json"),
        ("x.unknown", "application/octet-stream"),
        ("x", "application/octet-stream"),
    ],
)
def test_media_types_are_the_same_on_every_machine(name: str, expected: str) -> None:
    assert find_media_type(name) == expected


def test_attachments_stand_in_the_order_of_their_names() -> None:
    names = ["b", "a", "ä", "Z"]
    assert [each.name for each in arrange_attachments(map(attachment, names), "CAL-1")] == [
        "Z",
        "a",
        "b",
        "ä",
    ]


def test_more_files_than_a_certificate_carries_are_refused() -> None:
    fitting = [attachment(str(number)) for number in range(MOST_ATTACHMENTS)]
    assert len(arrange_attachments(fitting, "CAL-1")) == MOST_ATTACHMENTS
    with pytest.raises(InputError, match="CAL-1: its 65 files"):
        arrange_attachments([*fitting, attachment("one more")], "CAL-1")


def test_files_larger_than_a_certificate_carries_are_refused() -> None:
    with pytest.raises(InputError, match="64 MiB"):
        arrange_attachments([attachment("a", LARGEST_TOTAL), attachment("b", 1)], "CAL-1")


def test_what_a_job_named_from_the_root_names_is_told_from_there_too(tmp_path: Path) -> None:
    for folder in ("left", "right"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "test.yaml").write_text(SOUND.replace("number: CAL-1", f"number: {folder}"))
        (tmp_path / folder / "six.txt").write_text("1 2 3 -1 -2 -3")
    (tmp_path / "document").mkdir()
    stated = ", ".join(str(tmp_path / folder / "test.yaml") for folder in ("left", "right"))
    document = tmp_path / "document" / "job.yaml"
    document.write_text(
        f"schema: zlmreport/job/1\ncertificate: {{number: D-1, kind: report}}\nmeasurements: [{stated}]\n"
    )
    job = load(document, REGISTRY)
    readings = [SourceFile.of(tmp_path / folder / "six.txt", folder.encode()) for folder in ("left", "right")]
    assert {each.path for each in list_sources(job, readings, None)} == {
        "job.yaml",
        *(str(tmp_path / folder / name) for folder in ("left", "right") for name in ("test.yaml", "six.txt")),
    }
