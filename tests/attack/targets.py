"""What is attacked: sound files, the one that is spoiled, and the commands that get it."""

from __future__ import annotations

import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import warnings
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from attack.edits import BINARY, TEXT, Edit
from environments import ROOT
from verification.issued import READINGS, content_of, with_attachment
from zlmreport import pipeline
from zlmreport.cli import main
from zlmreport.evaluation.uncertainty import expanded
from zlmreport.model.diagnosis import null_distribution
from zlmreport.plugin.registry import find_plugins
from zlmreport.verification.attached import check_digital_certificates
from zlmreport.verification.carrier import Carried

_CONFIGS = ROOT / "configs"
_SOURCES = ROOT / "tests" / "data" / "sources"
_GAUGE_FILES = ROOT / "tests" / "data" / "step_gauge"
_GAUGE = ("job.yaml", "gauge.yaml", "probed.csv", "initial-points.csv")

#: Does something in a folder and returns an exit code.
Attack = Callable[[Path], int]


@dataclass(frozen=True, slots=True)
class Target:
    """Something that is attacked.

    Attributes
    ----------
    name
        Of it.
    lay_out
        Writes sound files into a folder.
    spoilt
        The file that is spoiled, by its path there.
    attacks
        One of them is made.
    edits
        How the file may be spoiled.
    share
        How many inputs of a round it gets: what takes long gets fewer, nothing none.
    """

    name: str
    lay_out: Callable[[Path], object]
    spoilt: str
    attacks: tuple[Attack, ...]
    edits: Sequence[Edit] = TEXT
    share: int = 1


def _command(*words: str) -> Attack:
    """Return a command; what begins with ``@`` is a file or folder in the attacked one."""
    return lambda folder: main([str(folder / word[1:]) if word.startswith("@") else word for word in words])


def _examples(*names: str) -> Callable[[Path], None]:
    def lay(folder: Path) -> None:
        for name in names:
            to = folder / "c" / name  # the examples write into a folder beside theirs
            to.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(_CONFIGS / name, to)

    return lay


def _job(plugin: str, key: str, file: str) -> str:
    return (
        "schema: zlmreport/job/1\ncertificate: {number: A-1, kind: report}\naxis: {name: X}\n"
        f"measurement: {{source: {{plugin: {plugin}, {key}: {file}}}}}\nevaluate: [nmtba]\n"
    )


def _measured(plugin: str, file: str, key: str = "file") -> Callable[[Path], None]:
    def lay(folder: Path) -> None:
        shutil.copy(_SOURCES / file, folder / file)
        (folder / "job.yaml").write_text(_job(plugin, key, file), encoding="utf-8")

    return lay


def _probed(file: str) -> Callable[[Path], None]:
    def lay(folder: Path) -> None:
        for name in (file, "stepgauge_cal.csv"):
            shutil.copy(_GAUGE_FILES / name, folder / name)
        gauge = "\nstep_gauge: {calibration: stepgauge_cal.csv, tip_radius: 2, last_block: 2}\n"
        job = _job("step-gauge", "file", file).replace(
            "\nevaluate: [nmtba]\n", f"{gauge}evaluate: [step-gauge]\n"
        )
        (folder / "job.yaml").write_text(job, encoding="utf-8")

    return lay


def _by_rules_of_ptb(folder: Path) -> int:
    """Check a digital certificate as one that a PDF carries; the schema stands for PTB's."""
    root = "digitalCalibrationCertificate"
    (folder / "dcc.xsd").write_text(
        f'<schema xmlns="http://www.w3.org/2001/XMLSchema" targetNamespace="https://ptb.de/dcc">'
        f'<element name="{root}"/></schema>'
    )
    list(
        check_digital_certificates(
            {"x.xml": Carried("x.xml", (folder / "y-axis.xml").read_bytes(), "", "", "", "")}, folder
        )
    )
    return 0


def with_few_draws() -> None:
    """Simulate little: what a spoiled file breaks does not depend on how often."""
    pipeline.add_uncertainty = lambda *given: expanded.add_uncertainty(*given[:2], trials=100)  # type: ignore[attr-defined]
    null_distribution.TRIALS = 20


def _certificate(folder: Path) -> bytes:
    """Return a certificate; a process of its own makes it, for threads of a library do not outlive a fork."""
    program = (
        "import sys; from pathlib import Path; from verification.issued import issue, lay_out; "
        "from attack.targets import with_few_draws; with_few_draws(); "
        "sys.stdout.buffer.write(issue(lay_out(Path(sys.argv[1])), 'pdf-typst'))"
    )
    environment = {**os.environ, "PYTHONPATH": str(ROOT / "tests")}
    done = subprocess.run(
        [sys.executable, "-c", program, folder], env=environment, stdout=subprocess.PIPE, check=True
    )
    return done.stdout


_ANSWERS = (
    *(
        "None",
        "()",
        "[None] * 3",
        "{}",
        "'x' * 10**6",
        "float('nan')",
        "object()",
        "iter(())",
        "b'x'",
        "type",
    ),
    *("Arithmetic({})", "Arithmetic({'D': 1.0, 'S': float('inf')})", "Arithmetic({'D': 'x', 'S': None})"),
    *("Arithmetic({'D': np.zeros((7, 7)), 'S': np.array(['x'])})", "Arithmetic(5)", "1 / 0", "[][1]", "self"),
    *("(yield)", "exit(7)", "self.arithmetic(statistics, options)", "Arithmetic({'D': 1j, 'S': 10**400})"),
    *(
        "[Finding]",
        "[Figure]",
        "[Finding(*'abcdef'[:3])]",
        "statistics.mean_positive.fill(0)",
        "open('/nowhere')",
    ),
)


def _answering(draw: random.Random, content: bytes) -> bytes:
    """Let a plugin answer something else."""
    found = list(re.finditer(rb"(?m)^( {8,12})return (?:.|\n)*?(?=\n\n|\Z)", content))
    one = draw.choice(found)
    return (
        content[: one.start(1)] + one[1] + b"return " + draw.choice(_ANSWERS).encode() + content[one.end() :]
    )


def _of_plugin(folder: Path) -> None:
    text = (ROOT / "src/zlmreport/skeletons/standard.py.txt").read_text(encoding="utf-8")
    for name, value in {"identifier": "drawn", "words": "Drawn", "Class": "Drawn"}.items():
        text = text.replace(f"{{{{{name}}}}}", value)
    (folder / "drawn.py").write_text(text, encoding="utf-8")
    (folder / "x.csv").write_text(READINGS, encoding="utf-8")
    job = _job("laser-csv", "file", "x.csv").replace("[nmtba]", "[drawn]")
    (folder / "job.yaml").write_text(job, encoding="utf-8")


_CHANGE = {"based_on": "0", "action": "add", "effect": "backlash", "parameter": "lost_motion", "value": 1.5}
#: Of the client; a server takes shorter ones.
_LONGEST_PATH = 60_000
_MADE = {"name": "certificate", "controller": "linuxcnc", "format": "pdf"}
_REQUESTS = "\n".join(
    [
        *("GET / x", "GET /effects/backlash x", "GET /files/job.yaml x", "GET /documents/x/1.png x"),
        *("GET /api/job x", "GET /api/results?x=1 x", "GET /api/effects/backlash x", "GET /api/tests?of=0 x"),
        *(f"POST /api/change {json.dumps(_CHANGE)}", f"POST /api/made/check {json.dumps(_MADE)}"),
    ]
)


def _of_page(folder: Path) -> None:
    _examples("hidden-effect/job.yaml", "hidden-effect/x-axis.csv")(folder)
    (folder / "requests").write_text(_REQUESTS, encoding="utf-8")


def _asked(folder: Path) -> int:
    """Send the workbench requests that are not sound; an answer above 499 is a mistake of its own."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        from starlette.testclient import TestClient
    from zlmreport.web.app import Workbench
    from zlmreport.web.guard import Door

    door, bench = Door.at(8420), Workbench.of([folder / "c/hidden-effect/job.yaml"], find_plugins({}))
    client = TestClient(bench.make_app(door), base_url="http://127.0.0.1:8420", follow_redirects=False)
    client.get(door.address)
    client.headers.update({"Origin": "http://127.0.0.1:8420", "Content-Type": "application/json"})
    lines = dict.fromkeys((folder / "requests").read_bytes().splitlines())
    try:
        for line in [each for each in lines if each not in _REQUESTS.encode().splitlines()]:
            method, _, rest = line.decode("latin-1").partition(" ")
            path, _, body = rest.partition(" ")
            if method.isalpha() and path.startswith("/") and path.isprintable() and len(path) < _LONGEST_PATH:
                answer = client.request(method, path, content=body.encode("latin-1"))
                assert answer.status_code < 500, f"{line!r}: {answer.status_code}"
    finally:
        bench.diagnoses.end()
        bench.commands.end()
    return 0


def targets(folder: Path) -> tuple[Target, ...]:
    """Return all targets; `folder` is for what they need once."""
    with_few_draws()
    pdf = _certificate(folder)
    linear = _examples("laboratory.yaml", "linear-axis/certificate.yaml", "linear-axis/y-axis.csv")
    gauge = _examples("laboratory.yaml", *(f"step-gauge/{name}" for name in _GAUGE))
    hidden = _examples("hidden-effect/job.yaml", "hidden-effect/x-axis.csv", "hidden-effect/simulation.yaml")
    fleet = _examples(
        "laboratory.yaml",
        "fleet/fleet.yaml",
        *(f"fleet/bz-630/{name}" for name in ("machine.yaml", "x-2026-10.yaml", "x-2026-10.csv")),
    )
    checked, model = _command("check", "@c/linear-axis/certificate.yaml"), "@c/hidden-effect/job.yaml"
    results = ("--format", "json,csv", "--output", "@out", "--quiet")

    def issued(folder: Path) -> None:
        (folder / "x.pdf").write_bytes(pdf)

    def attached(name: str) -> Target:
        def lay(folder: Path) -> None:
            issued(folder)
            (folder / "attached").write_bytes(content_of(pdf, name))

        def attack(folder: Path) -> int:
            with tempfile.NamedTemporaryFile(suffix=".pdf") as file:
                file.write(with_attachment(pdf, name, (folder / "attached").read_bytes()))
                file.flush()
                return main(["verify", file.name, "--json"])

        return Target(f"attached {name}", lay, "attached", (attack,))

    return (
        Target(
            "job",
            linear,
            "c/linear-axis/certificate.yaml",
            (checked, _command("@c/linear-axis/certificate.yaml", *results)),
            share=20,
        ),
        Target("laboratory", linear, "c/laboratory.yaml", (checked,), share=8),
        Target(
            "table",
            linear,
            "c/linear-axis/y-axis.csv",
            (checked, _command("look", "@c/linear-axis/y-axis.csv")),
            share=20,
        ),
        Target(
            "model",
            hidden,
            "c/hidden-effect/job.yaml",
            (
                _command("model", "fit", model),
                _command("plan", model),
                _command("compensate", model, "--controller", "linuxcnc", "--output", "@out"),
            ),
            share=12,
        ),
        Target(
            "simulation",
            hidden,
            "c/hidden-effect/simulation.yaml",
            (_command("simulate", "@c/hidden-effect/simulation.yaml", "--output", "@out"),),
            share=50,
        ),
        *(
            Target(
                plugin,
                _measured(plugin, file, key),
                file,
                (_command("check", "@job.yaml"), _command("look", f"@{file}"), *more),
                share=50,
            )
            for plugin, file, key, *more in (
                ("renishaw-rtl", "bidirectional.rtl", "file"),
                ("ecmc", "ecmc_13e6c326.dat", "file"),
                ("dcc", "y-axis.xml", "file", _by_rules_of_ptb),
                ("serial-interferometer", "linear.journal", "journal"),
            )
        ),
        *(
            Target(
                f"gauge {name}",
                gauge,
                f"c/step-gauge/{name}",
                (_command("check", "@c/step-gauge/job.yaml"),),
                share=9,
            )
            for name in _GAUGE
        ),
        *(
            Target(
                f"gauge {file}",
                _probed(file),
                file,
                (_command("check", "@job.yaml"), _command("look", f"@{file}")),
                share=25,
            )
            for file in ("stepgauge.res", "STEPGAUGE_1_chr.txt")
        ),
        Target(
            "fleet",
            fleet,
            "c/fleet/fleet.yaml",
            (
                _command("fleet", "@c/fleet/fleet.yaml", "--dry-run"),
                _command("fleet", "report", "@c/fleet/fleet.yaml"),
            ),
            share=30,
        ),
        Target("pdf", issued, "x.pdf", (_command("verify", "@x.pdf", "--json"),), BINARY, share=4),
        attached("VERIFY-1.json"),
        attached("job.yaml"),
        attached("x-axis.csv"),
        Target(
            "plugin",
            _of_plugin,
            "drawn.py",
            (
                _command("check", "@job.yaml", "--plugin", "@drawn.py"),
                _command("@job.yaml", "--plugin", "@drawn.py", *results),
            ),
            (_answering,),
            share=40,
        ),
        Target("page", _of_page, "requests", (_asked,), share=6),
    )
