"""What authors of plugins and users of notebooks begin with passes a strict type checker as it is."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from environments import ROOT
from zlmreport.cli import main
from zlmreport.cli.new import GUIDES

FORMULA = """\
schema: zlmreport/job/1
certificate: {number: R-1, kind: report}
axis: {name: X, travel: [0, 100]}
measurement: {source: {plugin: laser-csv, file: x.csv}}
evaluate: [nmtba]
model: {effects: [{name: my-wave, formula: "a*P", parameters: {a: {unit: um/m, range: [-20, 20]}}}]}
"""


@pytest.mark.long
def test_skeletons_and_examples_pass(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    pytest.importorskip("mypy", reason="the type checker is of ./run lint")
    monkeypatch.chdir(tmp_path)
    Path("job.yaml").write_text(FORMULA, encoding="utf-8")
    for kind in GUIDES:
        assert main(["new", kind, f"my-{kind}"]) == 0
    assert main(["new", "effect", "my-wave", "--from", "job.yaml"]) == 0, capsys.readouterr().err
    guide = (ROOT / "docs" / "how-to" / "use-in-a-notebook.md").read_text(encoding="utf-8")
    for name, program in re.findall(r"```python (\w+\.py)\n(.*?)```", guide, re.DOTALL):
        Path(f"example_{name}").write_text(program, encoding="utf-8")
    files = sorted(str(path) for path in tmp_path.rglob("*.py"))
    assert len(files) > 20
    # the cache of ./run lint makes seconds of a minute
    options = ["--strict", "--cache-dir", str(ROOT / ".mypy_cache")]
    done = subprocess.run(
        [sys.executable, "-m", "mypy", *options, *files], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout
