"""Whatever is typed into a job is printed as it is typed, and does nothing."""

from __future__ import annotations

import json
import re
from html.parser import HTMLParser
from io import BytesIO
from itertools import cycle
from pathlib import Path

import pikepdf
import pytest
from pypdf import PdfReader

from pdf_conformance import complaints
from processes import PYTHON, run
from security.hostile import CIRCLE, READINGS, circle_text_keys, circular_job_with, job_with, text_keys
from zlmreport.cli import main
from zlmreport.plugin.registry import find_plugins

pytestmark = pytest.mark.long  # all of them look at documents that take long to make

#: The formats, by the folder of their files: two of them write the same file.
FORMATS = {
    "out": [each.identifier for each in find_plugins().renderers if each.identifier != "pdf-typst"],
    "by-typst": ["pdf-typst"],
}
ATTACKS = (
    '<img src="file:///etc/passwd">',
    '<link rel=stylesheet href="http://example.com/x.css">',
    "</style><style>*{background:url(file:///etc/passwd)}@import 'http://example.com/'",
    "\" style=\"background:url('file:///etc/hosts')\" x='",
    "{{ ''.__class__.__mro__ }} {% include '/etc/passwd' %}",
    '<!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]> &e; ]]>',
    "<script>alert(1)</script><svg onload=alert(1)>",
    "<a rel=attachment href='file:///etc/passwd'>x</a>",
    '#read("/etc/passwd") #{ panic() } $x$ *a* _b_ @c <d> // e \\ `f` = g',
)

#: The command line, telling at its end which files and addresses it opened.
_WATCHED = """
import sys

opened = set()


def watch(event, arguments):
    if event in {"open", "socket.connect", "socket.getaddrinfo", "urllib.Request"}:
        opened.add(f"{event} {arguments[0]}")


sys.addaudithook(watch)
from zlmreport.cli import main

code = main(sys.argv[1:])
print(*sorted(opened), sep="\\n")
sys.exit(code)
"""


@pytest.fixture(scope="module")
def made(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a job with attacks in every text, and of its files in the folder `out`.

    The attacks take turns, and where there is room, a text has two.
    """
    folder = tmp_path_factory.mktemp("hostile")
    attacks = cycle(ATTACKS)
    texts = {}
    for n, (path, room) in enumerate(text_keys().items()):
        text = f"text{n:03d} {next(attacks)}"
        second = f" {ATTACKS[(n + 3) % len(ATTACKS)]}"
        texts[path] = text + second if len(text + second) <= room else text
    (folder / "job.yaml").write_text(job_with(texts.__getitem__), encoding="utf-8")
    header, rows = READINGS.split("\n", 1)
    quoted = next(attacks).replace('"', '""')
    with_column = f'{header},"{quoted}"\n' + "".join(f"{row},1\n" for row in rows.splitlines())
    (folder / "x-axis.csv").write_text(with_column, encoding="utf-8")
    (folder / "texts.json").write_text(json.dumps(list(texts.values())), encoding="utf-8")
    opened = ""
    for output, formats in FORMATS.items():
        done = run(
            *(PYTHON, "-c", _WATCHED),
            *("job.yaml", "--quiet", "--output", output, "--format", ",".join(formats)),
            cwd=folder,
        )
        assert (done.returncode, done.stderr) == (0, "")
        opened += done.stdout
    (folder / "opened.txt").write_text(opened, encoding="utf-8")
    return folder


def test_nothing_that_an_attack_names_is_opened(made: Path) -> None:
    opened = (made / "opened.txt").read_text(encoding="utf-8").splitlines()
    assert "open x-axis.csv" in opened
    assert [line for line in opened if line.startswith(("socket", "urllib"))] == []
    assert [line for line in opened if re.search("passwd|hosts|example", line)] == []


class _Page(HTMLParser):
    """The elements of a page, what they refer to, and its text."""

    def __init__(self) -> None:
        super().__init__()
        self.tags: set[str] = set()
        self.references: list[str] = []
        self.handlers: list[str] = []
        self.words: list[str] = []
        self._last = ""

    def handle_starttag(self, tag, attrs) -> None:
        self.tags.add(tag)
        self._last = tag
        self.references += [value or "" for name, value in attrs if name in {"src", "href", "data", "action"}]
        self.handlers += [name for name, _ in attrs if name.startswith("on")]

    def handle_data(self, data) -> None:
        if self._last != "style":
            self.words.append(data)


def test_a_browser_finds_nothing_to_run_or_to_load(made: Path) -> None:
    page = _Page()
    page.feed((made / "out" / "CAL-1.html").read_text(encoding="utf-8"))
    assert not page.tags & {"script", "iframe", "object", "embed", "link", "form", "base"}
    assert page.handlers == []
    assert all(reference.startswith(("#", "data:")) for reference in page.references)


def test_every_text_that_is_printed_is_printed_as_it_was_typed(made: Path) -> None:
    page = _Page()
    page.feed((made / "out" / "CAL-1.html").read_text(encoding="utf-8"))
    printed = "".join("".join(page.words).split())
    texts = json.loads((made / "texts.json").read_text(encoding="utf-8"))
    found = 0
    for text in texts:
        places = printed.count(text[:7])
        found += places > 0
        assert printed.count("".join(text.split())) == places
    assert found > len(texts) / 2


@pytest.mark.parametrize("output", FORMATS)
def test_a_pdf_viewer_finds_nothing_to_run_or_to_load(made: Path, output: str) -> None:
    with pikepdf.open(made / output / "CAL-1.pdf") as pdf:
        assert "/OpenAction" not in pdf.Root
        assert "/JavaScript" not in pdf.Root.get("/Names", {})
        for page in pdf.pages:
            assert "/AA" not in page
            actions = [each.A for each in page.get("/Annots", []) if "/A" in each]
            assert all(action.S == "/GoTo" for action in actions)
        assert all("passwd" not in name for name in pdf.attachments)


@pytest.mark.parametrize("output", FORMATS)
def test_the_pdf_conforms_all_the_same(made: Path, output: str) -> None:
    assert complaints((made / output / "CAL-1.pdf").read_bytes()) == []


def test_every_text_in_one_pdf_is_in_the_other_as_it_was_typed(made: Path) -> None:
    one, other = (
        "".join("".join(page.extract_text() for page in PdfReader(made / output / "CAL-1.pdf").pages).split())
        for output in FORMATS
    )
    texts = json.loads((made / "texts.json").read_text(encoding="utf-8"))
    printed = ["".join(text.split()) for text in texts if "".join(text.split()) in one]
    assert len(printed) > len(texts) / 2
    assert [text for text in printed if text not in other] == []


def test_the_results_file_is_sound(made: Path) -> None:
    assert json.loads((made / "out" / "CAL-1.json").read_bytes())["certificate"]["number"] == "CAL-1"


def test_no_file_holds_what_the_attack_asks_for(made: Path) -> None:
    secret = Path("/etc/passwd").read_bytes().splitlines()[0]
    for path in (file for output in FORMATS for file in (made / output).iterdir()):
        assert secret not in path.read_bytes()
    for output in FORMATS:
        with pikepdf.open(BytesIO((made / output / "CAL-1.pdf").read_bytes())) as pdf:
            for attachment in pdf.attachments.values():
                assert secret not in attachment.get_file().read_bytes()


@pytest.mark.parametrize("attack", ATTACKS)
def test_a_text_of_a_circle_is_printed_as_it_was_typed(attack: str, tmp_path: Path) -> None:
    assert circle_text_keys() != {}
    (tmp_path / "job.yaml").write_text(circular_job_with(lambda _: attack), encoding="utf-8")
    (tmp_path / "circle.csv").write_text(CIRCLE, encoding="utf-8")
    assert main([str(tmp_path / "job.yaml"), "--quiet", "--format", "html"]) == 0
    page = _Page()
    page.feed((tmp_path / "CAL-2.html").read_text(encoding="utf-8"))
    assert "".join(attack.split()) in "".join("".join(page.words).split())
    assert not page.tags & {"script", "iframe", "object", "embed", "link", "form", "base"}
    assert page.handlers == []
