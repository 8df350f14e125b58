"""The guide leads from nothing to a certificate, in an environment of its own: it installs a plugin."""

from __future__ import annotations

from pathlib import Path

import pytest

from documents.examples import run_block
from documents.pages import DOCS, blocks
from documents.shell import shell as opened
from environments import Distribution, Environment, install

#: Warnings are errors in the project's commands; pip's own are its own.
_PIP_MAY_WARN = """python() {
    if [ "$2" = pip ]; then PYTHONWARNINGS= command python "$@"; else command python "$@"; fi
}"""


@pytest.fixture
def reader(tmp_path_factory: pytest.TempPathFactory, zlmreport_distribution: Distribution) -> Environment:
    """The environment of somebody who has installed zlmreport and nothing else, and will install more."""
    folder = tmp_path_factory.mktemp("reader")
    install(folder, zlmreport_distribution.wheel)
    return Environment(folder)


@pytest.mark.long
def test_the_guide_leads_to_a_certificate(
    reader: Environment, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("sys.executable", str(reader.python))
    monkeypatch.setenv("PIP_NO_BUILD_ISOLATION", "0")  # a negative option: 0 switches isolation off
    monkeypatch.setenv("PIP_DISABLE_PIP_VERSION_CHECK", "1")
    with opened(tmp_path) as shell:
        shell.run(_PIP_MAY_WARN)
        for block in blocks(DOCS / "how-to" / "add-a-standard.md"):
            run_block(block, tmp_path, shell)
