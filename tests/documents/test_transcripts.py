"""What commands print is written into the pages anew, and what a page leaves out stays left out."""

from __future__ import annotations

from pathlib import Path

import pytest

from documents.examples import matches
from documents.transcripts import renewed, rewrite_page


@pytest.mark.parametrize(
    ("expected", "printed", "new"),
    [
        (["A = 3.1 µm"], ["A = 3.2 µm"], ["A = 3.2 µm"]),
        (["A = … µm"], ["A = 3.2 nm"], ["A = … nm"]),
        (["A = …", "B = 1"], ["A = 3", "B = 2"], ["A = …", "B = 2"]),
        (["first", "…", "last 1"], ["first", "second", "last 2"], ["first", "…", "last 2"]),
        (["…", "last"], ["first", "second", "last"], ["…", "last"]),
        (["first", "…"], ["first"], ["first", "…"]),
        (["first", "last"], ["first", "second", "last"], ["first", "second", "last"]),
        (["first", "second", "last"], ["first", "last"], ["first", "last"]),
        (["a lo…  1.2"], ["a lo…  1.3"], ["a lo…  1.3"]),
    ],
    ids=[
        "a number",
        "a unit after a left-out number",
        "a line after a left-out number",
        "a line after left-out lines",
        "left-out lines that come first",
        "left-out lines of which there are none",
        "a line that comes in",
        "a line that goes out",
        "an ellipsis that the command prints",
    ],
)
def test_what_changed_is_written_anew_and_the_rest_stays(
    expected: list[str], printed: list[str], new: list[str]
) -> None:
    assert renewed(expected, printed) == new
    assert matches(new, "\n".join(printed))


_PAGE = """Once:

- a list

  ```console
  $ printf '%s\\n' \\
  > one two three
  one
  FIRST
  …
  ```

Twice:

```console
$ echo 4
$ echo 5
SECOND
```
"""


def test_a_page_is_rewritten_within_its_console_blocks_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("documents.examples.ROOT", tmp_path)
    (tmp_path / "configs").mkdir()
    page = tmp_path / "page.md"
    page.write_text(_PAGE.replace("FIRST", "2").replace("SECOND", "6"), encoding="utf-8")
    assert rewrite_page(page, tmp_path / "folder")
    assert page.read_text(encoding="utf-8") == _PAGE.replace("FIRST", "two").replace("SECOND", "5")
    assert not rewrite_page(page, tmp_path / "again")
