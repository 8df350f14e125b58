"""The document on a machine: what it says, in both layouts and languages, and that it can be verified."""

import json

import pypdf
import pytest

from zlmreport.cli import main
from zlmreport.plugin.registry import find_plugins
from zlmreport.verification.findings import VerificationVerdict
from zlmreport.verification.verify import verify


def made(folder, **certificate):
    path = folder / "machine.yaml"
    keys = json.dumps({"number": "M-7", "issued": "2026-11-24", **certificate})
    path.write_text(path.read_text(encoding="utf-8") + f"certificate: {keys}\n", encoding="utf-8")
    assert main(["machine", "certificate", str(path), "-o", str(folder)]) == 0
    return folder / "M-7.pdf"


def text(path):
    return "\n".join(page.extract_text() for page in pypdf.PdfReader(path).pages)


@pytest.mark.long
def test_it_says_what_is_known_and_what_is_missing_and_holds(folder):
    path = made(folder)
    said = text(path)
    for part in ("Servo mismatch", "Y lags behind X by", "EXX", "assumed bound", "PPP", "6 of 21", "M-7"):
        assert part in said
    found = verify(path, find_plugins())
    assert found.holds is True
    assert len(found.values) > 0


@pytest.mark.long
def test_a_changed_reading_is_found(folder):
    """The document of other readings, with the results file of these, does not hold."""
    path = made(folder)
    results = json.loads((folder / "M-7.json").read_text(encoding="utf-8"))
    assert results["schema"] == "zlmreport/machine-results/1"
    assert {each["name"] for each in results["provenance"]["sources"]} >= {"machine.yaml", "circle-xy.csv"}
    reader = pypdf.PdfReader(path)
    writer = pypdf.PdfWriter(clone_from=reader)
    embedded = writer._root_object["/Names"]["/EmbeddedFiles"]["/Names"]
    for name, specification in zip(embedded[::2], embedded[1::2], strict=True):
        if name == "M-7.json":
            stream = specification.get_object()["/EF"]["/F"].get_object()
            stream.set_data(stream.get_data().replace(b'"verdict": "missing"', b'"verdict": "adequate"'))
    changed = folder / "changed.pdf"
    writer.write(changed)
    assert verify(changed, find_plugins()).holds is False


@pytest.mark.long
def test_its_other_files_are_held_against_it(folder):
    made(folder)
    assert (
        main(["machine", "certificate", str(folder / "machine.yaml"), "--format", "html", "-o", str(folder)])
        == 0
    )
    results, page = folder / "M-7.json", folder / "M-7.html"
    found = verify(results, find_plugins())
    assert (found.holds, [each.subject for each in found.files]) == (True, ["M-7.json", "M-7.pdf"])
    page.write_bytes(page.read_bytes().replace(b"EXX", b"EYY"))
    found = verify(page, find_plugins())
    assert [each.subject for each in found.files if each.verdict is VerificationVerdict.DIFFERS] == [
        "M-7.html"
    ]


@pytest.mark.long
def test_what_anybody_wrote_is_no_name_of_an_effect(folder):
    written = {each.key for each in verify(made(folder), find_plugins()).own_words}
    assert "machine.serial" in written
    assert not {key for key in written if key.startswith(("chain", "model.effects"))}


@pytest.mark.long
def test_a_sheet_is_one_page_and_german_is_german(folder):
    path = made(folder, layout="sheet", language="de")
    assert len(pypdf.PdfReader(path).pages) == 1
    assert "Eine Vorhersage ist keine Messung." in " ".join(text(path).split())
    assert "Bericht über eine Maschine" in text(path)
    assert "läuft X um" in text(path)
    words = text(path)
    assert words.index("Es fehlt") < words.index("Bild 1") < words.index("Seriennummer")


def test_a_page_calls_parameters_in_its_language_and_a_results_file_by_their_names(folder):
    made(folder, language="fr")
    assert (
        main(
            [
                "machine",
                "certificate",
                str(folder / "machine.yaml"),
                "--format",
                "html,json",
                "-o",
                str(folder),
            ]
        )
        == 0
    )
    page = (folder / "M-7.html").read_text(encoding="utf-8")
    assert [name in page for name in ("X de circle-xy, tour 1", "X of circle-xy, turn 1")] == [True, False]
    names = {
        each["name"]
        for each in json.loads((folder / "M-7.json").read_text("utf-8"))["diagnosis"]["model"]["parameters"]
    }
    assert "X of circle-xy, turn 1" in names


@pytest.mark.parametrize("name", ["csv", "xlsx", "dcc"])
def test_a_format_of_what_a_job_measured_is_refused(name, folder, capsys):
    """A table of nothing but its header says that there is nothing."""
    path = folder / "machine.yaml"
    before = set(folder.iterdir())
    assert main(["machine", "certificate", str(path), "--format", f"json,{name}", "-o", str(folder)]) == 2
    assert f"--format: {name} states what a job measured" in capsys.readouterr().err
    assert set(folder.iterdir()) == before


@pytest.mark.long
def test_effects_have_their_titles_in_the_language_of_the_page(folder):
    said = " ".join(text(made(folder, language="de")).split())
    assert "servo-mismatch: Unterschied der Schleppabstände" in said
    assert said.count("servo-mismatch Unterschied der Schleppabstände") == 2
