"""A certificate holds as it was issued, and not after any single change."""

from __future__ import annotations

import datetime as dt
import json
from collections.abc import Callable
from io import BytesIO
from pathlib import Path
from typing import Any

import pytest
from fontTools.ttLib import TTFont
from pikepdf import Array, Dictionary, Name, Pdf
from pypdf import PdfReader, PdfWriter
from pypdf.generic import DecodedStreamObject, DictionaryObject, FloatObject, NameObject, TextStringObject

from installed import registry
from verification.altering import Change, page_of, rewritten
from verification.issued import (
    JOB,
    LABORATORY,
    NUMBER,
    READINGS,
    altered,
    content_of,
    issue,
    lay_out,
    page_with,
    specification,
    with_attachment,
    with_digit,
    with_page_content,
    with_results,
    with_source,
)
from zlmreport import __version__, pipeline
from zlmreport.cli.terminal import say
from zlmreport.errors import InputError
from zlmreport.verification import verify
from zlmreport.verification.findings import (
    CheckedCertificate,
    CheckedStatement,
    VerificationOutcome,
    VerificationVerdict,
)

Verify = Callable[[bytes], CheckedCertificate]
RESULTS = f"{NUMBER}.json"


def differing(found: CheckedCertificate) -> list[str]:
    """The subjects of all findings that differ, and the paths of values."""
    findings = (*found.files, *found.pages, *found.document)
    subjects = [each.subject for each in findings if each.verdict is VerificationVerdict.DIFFERS]
    return subjects + [
        "/".join(each.path) for each in found.values if each.verdict is VerificationVerdict.DIFFERS
    ]


def finding(found: CheckedCertificate, subject: str) -> CheckedStatement:
    (one,) = (
        each
        for each in (*found.files, *found.pages, *found.document)
        if each.subject == subject and each.verdict is VerificationVerdict.DIFFERS
    )
    return one


def test_a_certificate_holds_as_it_was_issued(issued: bytes, verified: Verify) -> None:
    found = verified(issued)
    assert found.holds
    assert differing(found) == []
    assert found.identity.number == NUMBER
    assert {each.subject for each in found.files} == {
        "job.yaml",
        "laboratory.yaml",
        "x-axis.csv",
        "compensation.csv",
        "logo.png",
        RESULTS,
    }
    verdicts = {each.verdict for each in (*found.files, *found.values, *found.pages, *found.document)}
    assert verdicts == {VerificationVerdict.HOLDS}


@pytest.mark.parametrize("printed", ["pdf", "pdf-typst"])
def test_files_whose_names_have_letters_beyond_ascii_are_carried_by_one_name(
    printed: str, verified: Verify, tmp_path: Path
) -> None:
    job = lay_out(tmp_path, job=JOB.replace("x-axis.csv", "Prüfmaß α.csv"))
    (job.parent / "x-axis.csv").rename(job.parent / "Prüfmaß α.csv")
    found = verified(issue(job.rename(job.parent / "Größe Łódź.yaml"), printed))
    assert found.holds
    assert {"Größe Łódź.yaml", "Prüfmaß α.csv"} <= {each.subject for each in found.files}


@pytest.mark.parametrize("printed", ["pdf", "pdf-typst"])
def test_letters_that_no_typeface_has_are_told_where_they_stand(printed: str, tmp_path: Path) -> None:
    lacking = "\U000f1234"
    job = lay_out(tmp_path, job=f"# {lacking}\n{JOB}customer: {{name: A {lacking}}}\n")
    with pytest.raises(InputError, match=r"/job\.yaml:10:20: .*\(U\+F1234"):
        issue(job, printed)


def test_a_letter_that_no_typeface_has_is_told_of_the_name_of_a_file(tmp_path: Path) -> None:
    job = lay_out(tmp_path)
    with pytest.raises(InputError, match=r"/作业\.yaml: the typeface .*'作' \(U\+4F5C"):
        issue(job.rename(job.parent / "作业.yaml"), "pdf-typst")


def test_a_day_that_has_not_come_by_the_clock_is_not_decided(
    issued: bytes, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(verify, "read_clock", lambda: dt.date(2026, 11, 1))
    path = tmp_path / "certificate.pdf"
    path.write_bytes(issued)
    found = verify.verify(path, registry())  # what is remembered of other tests knows no clock
    assert found.outcome is VerificationOutcome.UNDECIDED
    said = [each for each in found.document if each.subject == "certificate.issued"]
    assert [each.verdict for each in said] == [VerificationVerdict.OPEN]
    assert "2026-11-20 lies in the future: by the clock of this computer it is 2026-11-01" in say(
        said[0].detail
    )


def test_every_number_of_the_results_file_is_compared(issued: bytes, verified: Verify) -> None:
    found = verified(issued)
    paths = {"/".join(value.path) for value in found.values if value.is_number}
    for key in ("value", "limit", "expanded_uncertainty"):
        assert f"evaluations/nmtba/parameters/P/{key}" in paths
    assert "evaluations/nmtba/positions/100.0/mean_fwd" in paths


def test_it_holds_when_another_program_has_saved_it_again(issued: bytes, verified: Verify) -> None:
    saved = altered(issued, lambda writer: writer.compress_identical_objects())
    assert saved != issued
    assert differing(verified(saved)) == []


def test_a_number_that_is_altered_on_a_page_is_found(issued: bytes, verified: Verify) -> None:
    found = verified(with_digit(issued, "7.26", "7.96"))
    page = f"page {page_with(issued, '7.26')}"
    assert differing(found) == [page]
    assert "'7.96' stands where '7.26' is printed again" in finding(found, page).detail


def test_a_number_that_is_printed_over_another_is_found(issued: bytes, verified: Verify) -> None:
    cover = b"\nq 1 1 1 rg 100 100 50 20 re f Q\n"
    found = verified(with_page_content(issued, 2, lambda content: content + cover))
    assert differing(found) == ["page 2"]
    assert "drawn otherwise" in finding(found, "page 2").detail


def test_a_curve_that_is_altered_is_found(issued: bytes, verified: Verify) -> None:
    def lower(content: bytes) -> bytes:
        head, line, tail = content.partition(b" l\n")
        assert line
        *before, y = head.split(b" ")
        return b" ".join([*before, b"%f" % (float(y) - 3)]) + line + tail

    page = page_with(issued, "Figure 1")
    assert differing(verified(with_page_content(issued, page, lower))) == [f"page {page}"]


def test_a_picture_that_is_put_over_a_page_is_found(issued: bytes, verified: Verify) -> None:
    def put(writer: PdfWriter) -> None:
        form = DecodedStreamObject()
        form.set_data(b"1 1 1 rg 0 0 50 50 re f")
        form.update(
            {NameObject("/Type"): NameObject("/XObject"), NameObject("/Subtype"): NameObject("/Form")}
        )
        objects = writer.pages[1]["/Resources"].get_object()["/XObject"].get_object()
        objects[NameObject("/Over")] = writer._add_object(form)
        drawn = writer.pages[1]["/Contents"].get_object()
        drawn.set_data(drawn.get_data() + b"\n/Over Do\n")

    found = verified(altered(issued, put))
    assert differing(found) == ["page 2", "structure of the file"]
    assert "draws by a form" in finding(found, "page 2").detail


def comment(opened: Pdf) -> None:
    note = Dictionary(Type=Name.Annot, Subtype=Name.Text, Rect=Array([9, 9, 29, 29]), Contents="OK")
    held = [*page_of(opened).get("/Annots", []), opened.make_indirect(note)]
    page_of(opened).Annots = Array(held)


def turn(opened: Pdf) -> None:
    page_of(opened).Rotate = 90


def unlist(opened: Pdf) -> None:
    del opened.Root.Names["/EmbeddedFiles"]


@pytest.mark.parametrize(
    ("change", "subject", "said"),
    [
        (comment, "page 1", "not as printed again: its links, notes or fields"),
        (turn, "page 1", "not as printed again: its rotation"),
        (unlist, "x-axis.csv", "is in no list of names: readers of PDF do not show it"),
    ],
)
def test_what_differs_is_named_and_nothing_else(
    issued: bytes, verified: Verify, change: Change, subject: str, said: str
) -> None:
    assert finding(verified(rewritten(issued, change)), subject).detail == said


def with_font(pdf: bytes, change: Callable[[TTFont], None]) -> bytes:
    """Return a PDF with a change in the font that its running text is set in."""

    def repack(writer: PdfWriter) -> None:
        fonts = writer.pages[0]["/Resources"].get_object()["/Font"].get_object()
        (font,) = (font for font in map(fonts.get, fonts) if font.get_object()["/BaseFont"].endswith("Sans"))
        descendant = font.get_object()["/DescendantFonts"][0].get_object()
        stream = descendant["/FontDescriptor"]["/FontFile2"]
        program, packed = TTFont(BytesIO(stream.get_data())), BytesIO()
        change(program)
        program.save(packed)
        stream.set_data(packed.getvalue())

    return altered(pdf, repack)


def test_a_font_that_draws_one_digit_for_another_is_found(issued: bytes, verified: Verify) -> None:
    def swap(program: TTFont) -> None:
        glyphs, order = program["glyf"], program.getGlyphOrder()
        two, three = order[0x3F], order[0x40]
        glyphs[two], glyphs[three] = glyphs[three], glyphs[two]

    found = verified(with_font(issued, swap))
    assert "page 1" in differing(found)
    assert finding(found, "page 1").detail == "its fonts differ"


def test_a_font_that_another_library_packed_is_the_same(issued: bytes, verified: Verify) -> None:
    repacked = with_font(issued, lambda program: program["name"].names.clear())
    assert differing(verified(repacked)) == []


def test_something_that_no_page_draws_changes_nothing(issued: bytes, verified: Verify) -> None:
    def add(writer: PdfWriter) -> None:
        state = DictionaryObject({NameObject("/ca"): FloatObject(0.5)})
        writer.pages[0]["/Resources"].get_object()["/ExtGState"][NameObject("/unused")] = state

    assert differing(verified(altered(issued, add))) == []


def test_a_state_that_makes_strokes_invisible_is_found(issued: bytes, verified: Verify) -> None:
    def fade(writer: PdfWriter) -> None:
        states = writer.pages[0]["/Resources"].get_object()["/ExtGState"]
        for name in states:
            states[name][NameObject("/ca")] = FloatObject(0)

    assert "page 1" in differing(verified(altered(issued, fade)))


@pytest.mark.long
def test_a_reading_that_is_altered_is_found_with_what_it_changes(issued: bytes, verified: Verify) -> None:
    readings = READINGS.replace("200,+,2,3.1", "200,+,2,8.1").encode()
    found = verified(with_attachment(issued, "x-axis.csv", readings))
    assert "is not the file that the results come from" in finding(found, "x-axis.csv").detail
    assert "evaluations/nmtba/parameters/P/value" in differing(found)


@pytest.mark.long
def test_a_reading_is_found_even_if_its_digest_is_stated(issued: bytes, verified: Verify) -> None:
    readings = READINGS.replace("200,+,2,3.1", "200,+,2,3.2").encode()
    found = verified(with_source(issued, "x-axis.csv", readings))
    assert "x-axis.csv" not in differing(found)
    assert "evaluations/nmtba/parameters/P/value" in differing(found)
    assert "page 1" in differing(found)


@pytest.mark.long
@pytest.mark.parametrize(
    ("key", "value"), [("value", 4.5), ("limit", 30.0), ("conforms", False), ("unit", "mm"), ("symbol", "Q")]
)
def test_a_value_that_is_altered_in_the_results_file_is_found(
    issued: bytes, verified: Verify, key: str, value: Any
) -> None:
    found = verified(
        with_results(issued, lambda results: results["evaluations"][0]["parameters"][0].update({key: value}))
    )
    assert differing(found) == [f"evaluations/nmtba/parameters/P/{key}"]


def test_stated_and_recomputed_value_stand_side_by_side(issued: bytes, verified: Verify) -> None:
    found = verified(
        with_results(issued, lambda results: results["evaluations"][0]["parameters"][0].update(value=4.5))
    )
    (value,) = (each for each in found.values if each.verdict is VerificationVerdict.DIFFERS)
    assert (value.stated, value.recomputed) == (4.5, pytest.approx(7.26, abs=0.005))


@pytest.mark.long
def test_a_parameter_that_is_taken_out_is_found(issued: bytes, verified: Verify) -> None:
    found = verified(with_results(issued, lambda results: results["evaluations"][0]["parameters"].pop()))
    assert all(path.startswith("evaluations/nmtba/parameters/O/") for path in differing(found))
    assert differing(found)


@pytest.mark.long
def test_a_limit_that_is_altered_in_the_job_is_found(issued: bytes, verified: Verify) -> None:
    job = JOB.replace("P: 20", "P: 25").encode()
    found = verified(with_attachment(issued, "job.yaml", job))
    assert {"job.yaml", "evaluations/nmtba/parameters/P/limit"} <= set(differing(found))


def test_a_job_that_is_spoilt_is_found(issued: bytes, verified: Verify) -> None:
    found = verified(with_attachment(issued, "job.yaml", b"schema: zlmreport/job/1\naxes: {}\n"))
    assert differing(found)[0] == "job.yaml"
    assert "cannot be evaluated again: job.yaml:1:1: axis is missing" in finding(found, "readings").detail


@pytest.mark.long
def test_another_laboratory_is_found(issued: bytes, verified: Verify) -> None:
    laboratory = LABORATORY.replace("Example Laboratory", "Other Laboratory").encode()
    found = verified(with_attachment(issued, "laboratory.yaml", laboratory))
    assert {"laboratory.yaml", "page 1", "metadata: Author"} <= set(differing(found))


def test_attachments_that_are_swapped_are_found(issued: bytes, verified: Verify) -> None:
    table, readings = content_of(issued, "compensation.csv"), content_of(issued, "x-axis.csv")
    swapped = with_attachment(with_attachment(issued, "compensation.csv", readings), "x-axis.csv", table)
    assert {"compensation.csv", "x-axis.csv"} <= set(differing(verified(swapped)))


@pytest.mark.parametrize("name", ["job.yaml", "laboratory.yaml", "x-axis.csv", "logo.png", RESULTS])
def test_an_attachment_that_is_taken_out_is_found(issued: bytes, verified: Verify, name: str) -> None:
    def take_out(writer: PdfWriter) -> None:
        listed = writer.root_object["/Names"]["/EmbeddedFiles"]["/Names"]
        index = next(i for i in range(1, len(listed), 2) if listed[i].get_object()["/UF"] == name)
        associated = writer.root_object["/AF"]
        associated.remove(listed[index])
        del listed[index - 1 : index + 1]

    found = verified(altered(issued, take_out))
    subject = "results file" if name == RESULTS else name
    assert "is not attached" in finding(found, subject).detail


def test_an_attachment_that_is_added_is_found(issued: bytes, verified: Verify) -> None:
    found = verified(altered(issued, lambda writer: writer.add_attachment("more.txt", b"more")))
    assert finding(found, "more.txt").detail == "is no file of this certificate"


@pytest.mark.parametrize(
    ("key", "value"),
    [("/Desc", TextStringObject("Readings of another axis")), ("/AFRelationship", NameObject("/Data"))],
)
def test_what_is_said_of_an_attachment_is_compared(
    issued: bytes, verified: Verify, key: str, value: Any
) -> None:
    def change(writer: PdfWriter) -> None:
        specification(writer, "x-axis.csv")[NameObject(key)] = value

    assert differing(verified(altered(issued, change))) == ["x-axis.csv"]


def test_a_page_that_is_appended_is_found(issued: bytes, verified: Verify) -> None:
    pages = len(PdfReader(BytesIO(issued)).pages)
    found = verified(altered(issued, lambda writer: writer.add_blank_page()))
    assert finding(found, f"page {pages + 1}").detail == "is no page of this certificate"


def test_a_page_that_is_removed_is_found_and_the_others_hold(issued: bytes, verified: Verify) -> None:
    found = verified(altered(issued, lambda writer: writer.remove_page(1)))
    assert finding(found, "page 2").detail == "is missing"
    assert [each.subject for each in found.pages if each.verdict is VerificationVerdict.DIFFERS] == ["page 2"]


def test_a_number_that_is_hidden_in_the_metadata_is_found(issued: bytes, verified: Verify) -> None:
    found = verified(altered(issued, lambda writer: writer.add_metadata({"/Title": "Report VERIFY-2"})))
    assert differing(found) == ["metadata: Title"]


def test_an_alternative_text_that_is_altered_is_found(issued: bytes, verified: Verify) -> None:
    def change(writer: PdfWriter) -> None:
        for number in range(len(writer._objects)):
            element = writer._objects[number]
            if isinstance(element, dict) and element.get("/S") == "/Figure":
                element[NameObject("/Alt")] = TextStringObject("Deviations between −1 µm and 1 µm")

    assert differing(verified(altered(issued, change))) == ["structure with alternative texts"]


def test_a_bookmark_that_is_altered_is_found(issued: bytes, verified: Verify) -> None:
    def change(writer: PdfWriter) -> None:
        first = writer.root_object["/Outlines"]["/First"]
        first[NameObject("/Title")] = TextStringObject("Accredited")

    assert differing(verified(altered(issued, change))) == ["bookmarks"]


def test_a_program_that_runs_when_the_file_is_opened_is_found(issued: bytes, verified: Verify) -> None:
    def change(writer: PdfWriter) -> None:
        action = DictionaryObject(
            {NameObject("/S"): NameObject("/JavaScript"), NameObject("/JS"): TextStringObject("app.alert(1)")}
        )
        writer.root_object[NameObject("/OpenAction")] = action

    found = verified(altered(issued, change))
    assert differing(found) == ["structure of the file", "/OpenAction"]
    assert "/OpenAction" in finding(found, "structure of the file").detail


def test_a_file_that_another_job_names_is_called_as_that_job_calls_it(
    issued: bytes, verified: Verify
) -> None:
    """Where this program laid the files out while it verified is nobody's business."""
    job = content_of(issued, "job.yaml").replace(b"x-axis.csv", b"y-axis.csv")
    detail = finding(verified(with_attachment(issued, "job.yaml", job)), "readings").detail
    assert detail.startswith("cannot be evaluated again: y-axis.csv: cannot be read: there is no such file")
    assert "zlmreport-verify" not in detail


def test_a_description_that_lacks_something_is_told_by_what_it_lacks(issued: bytes, verified: Verify) -> None:
    def change(writer: PdfWriter) -> None:
        described = specification(writer, "x-axis.csv")
        del described["/EF"]["/F"]["/Params"]["/ModDate"]
        del described["/UF"]

    detail = finding(verified(altered(issued, change)), "x-axis.csv").detail
    assert (
        detail
        == "its date lacks /ModDate D:20261120000000Z; its description (by its entries) lacks /UF, /ModDate"
    )


def test_results_that_state_a_key_twice_are_found(issued: bytes, verified: Verify) -> None:
    text = content_of(issued, RESULTS).replace(b'"symbol": "P",', b'"symbol": "P", "value": 1.0,', 1)
    stated = json.loads(content_of(issued, RESULTS))["evaluations"][0]["parameters"][0]
    assert stated["symbol"] == "P"
    found = verified(with_attachment(issued, RESULTS, text))
    told = f"{RESULTS}: 'value' is there twice, as 1.0 and as {stated['value']!r}"
    assert finding(found, "results file").detail == told


def test_what_spoils_a_results_file_is_told_with_its_place_and_that_it_was_changed(
    issued: bytes, verified: Verify
) -> None:
    """Without what it states nothing else is compared; that it is not the file that was attached is known."""
    text = content_of(issued, RESULTS)
    spoiled = {
        text.replace(b"{", b"{ // A", 1): "no JSON: line 1, column 3: ",
        text + b"\xff": f"no JSON: byte {len(text) + 1} is no UTF-8",
        b"[" * 100_000: "no JSON: it is nested too deeply",
    }
    for content, told in spoiled.items():

        def change(writer: PdfWriter, content: bytes = content) -> None:
            specification(writer, RESULTS)["/EF"]["/F"].set_data(content)

        found = verified(altered(issued, change))
        assert differing(found) == ["results file", RESULTS]
        assert told in finding(found, "results file").detail
        assert "is not the file that was attached" in finding(found, RESULTS).detail


def test_a_checksum_that_is_not_the_files_is_found(issued: bytes, verified: Verify) -> None:
    def change(writer: PdfWriter) -> None:
        stream = specification(writer, RESULTS)["/EF"]["/F"]
        stream.set_data(stream.get_data() + b"\n")

    assert differing(verified(altered(issued, change))) == [RESULTS]


@pytest.fixture(scope="module")
def older(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Return the report as an earlier release made it that gave the same."""
    with pytest.MonkeyPatch.context() as patch:
        here = pipeline.find_programs
        patch.setattr(
            pipeline,
            "find_programs",
            lambda *given: ("zlmreport 0.0.9", dict.fromkeys(here(*given)[1], "zlmreport 0.0.9")),
        )
        return issue(lay_out(tmp_path_factory.mktemp("older")))


@pytest.mark.long
def test_what_another_release_made_holds_if_all_of_it_is_repeated(older: bytes, verified: Verify) -> None:
    found = verified(older)
    assert found.outcome is VerificationOutcome.HOLDS
    assert found.identity.generator == "zlmreport 0.0.9"
    assert tuple(map(say, found.remarks)) == (
        f"made by zlmreport 0.0.9; this is zlmreport {__version__}, and it repeats all of it in that name",
    )


def _of_first_parameter(pdf: bytes, **entries: Any) -> bytes:
    return with_results(pdf, lambda results: results["evaluations"][0]["parameters"][0].update(entries))


@pytest.mark.parametrize(
    ("change", "part"),
    [
        (lambda pdf: _of_first_parameter(pdf, name="Worded otherwise"), "values"),
        (lambda pdf: _of_first_parameter(pdf, expanded_uncertainty=0.5), "values"),
        (lambda pdf: _of_first_parameter(pdf, conforms=None), "values"),
        (lambda pdf: with_digit(pdf, "7.26", "7.96"), "pages"),
    ],
    ids=["word", "uncertainty", "rule", "page"],
)
def test_what_another_release_stated_and_this_cannot_repeat_is_not_decided(
    older: bytes, verified: Verify, change: Callable[[bytes], bytes], part: str
) -> None:
    found = verified(change(older))
    assert (found.outcome, found.undecided) == (VerificationOutcome.UNDECIDED, (part,))
    assert say(found.remarks[0]).startswith(f"made by zlmreport 0.0.9, and this is zlmreport {__version__}: ")


@pytest.mark.long
def test_a_value_that_the_readings_do_not_give_is_wrong_in_every_release(
    older: bytes, verified: Verify
) -> None:
    found = verified(_of_first_parameter(older, value=4.5))
    assert differing(found) == ["evaluations/nmtba/parameters/P/value"]
    readings = READINGS.replace("200,+,2,3.1", "200,+,2,3.2").encode()
    assert verified(with_source(older, "x-axis.csv", readings)).outcome is VerificationOutcome.DOES_NOT_HOLD


@pytest.mark.long
@pytest.mark.parametrize("named", ["zlmreport 0.0.9, checked by PTB", "zlmreport by PTB", "zlmrep0rt 0.0.9"])
def test_what_is_no_name_of_a_release_is_printed_by_none(issued: bytes, verified: Verify, named: str) -> None:
    stated = with_results(issued, lambda results: results["provenance"].update(generator=named))
    assert verified(stated).outcome is VerificationOutcome.UNDECIDED
