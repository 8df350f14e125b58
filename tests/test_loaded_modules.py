"""How much a command loads: modules are counted, for times drift."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

from environments import ROOT

_COUNT = """\
import sys
from zlmreport.cli import main
code = main(sys.argv[1:])
own = [name for name in sys.modules if name.partition(".")[0] in {"zlmreport", "zlmreport_plugins"}]
print(len(own), *sorted({name.partition(".")[0] for name in sys.modules}), file=sys.stderr)
print(*own, file=sys.stderr)
sys.exit(code)
"""


def _loaded(folder: Path, *arguments: str) -> tuple[set[str], set[str]]:
    """Return the packages and the own modules that a command loads."""
    done = subprocess.run(
        [sys.executable, "-c", _COUNT, *arguments],
        cwd=folder,
        env={**os.environ, "XDG_CACHE_HOME": str(folder)},
        capture_output=True,
        text=True,
        check=True,
    )
    packages, own = done.stderr.splitlines()[-2:]
    return set(packages.split()[1:]), set(own.split())


def test_help_loads_the_command_line_alone(tmp_path: Path) -> None:
    packages, own = _loaded(tmp_path, "--help")
    assert len(own) <= 20
    assert not packages & {"numpy", "pydantic", "yaml", "pluggy", "matplotlib", "weasyprint", "sqlalchemy"}


def test_a_command_that_says_its_release_alone_loads_no_plugin_and_no_library_beside() -> None:
    """Both processes: the one that does it, and the one that watches."""
    done = subprocess.run(
        [sys.executable, "-X", "importtime", "-m", "zlmreport", "--version"],
        capture_output=True,
        text=True,
        check=True,
    )
    loaded = {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}
    assert "zlmreport.cli" in loaded
    assert not loaded & {"numpy", "pydantic", "yaml", "pluggy", "zlmreport.plugin", "zlmreport.job"}


def test_results_load_neither_what_draws_nor_what_the_job_does_not_name(tmp_path: Path) -> None:
    job = ROOT / "configs" / "linear-axis" / "certificate.yaml"
    packages, own = _loaded(tmp_path, str(job), "--format", "json", "--output", str(tmp_path), "--quiet")
    assert len(own) <= 170
    assert not packages & {
        "matplotlib",
        "weasyprint",
        "jinja2",
        "fontTools",
        "sqlalchemy",
        "ssl",
        "starlette",
        "pypdf",
        "uharfbuzz",
        "xml",
    }
    rooms = {whole.rpartition(".")[0] for whole in own} | {".".join(whole.split(".")[:2]) for whole in own}
    assert not rooms & {"zlmreport.live", "zlmreport.fleet", "zlmreport.document.typesetting"}
    assert not rooms & {"zlmreport.model"}
    assert not own & {
        "zlmreport.job.effect_choices",
        "zlmreport.plugin.extension",
        "zlmreport_plugins.renderers.json_results.tables",
    }
    assert not rooms & {"zlmreport.document.signing", "zlmreport_plugins.effects"}
    assert not rooms & {"zlmreport_plugins.instruments"}
