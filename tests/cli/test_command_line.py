"""The command line itself: what it answers to what it does not know, and how it ends."""

from __future__ import annotations

import os
import signal
from pathlib import Path

import pytest

from cli.commands import Shop
from environments import ROOT
from processes import PYTHON, ZLMREPORT, run
from zlmreport import __version__
from zlmreport.cli import arguments

COMMANDS = ["check", "init", "plugins", "schema"]


def test_version_is_printed(shop: Shop) -> None:
    run = shop.run("--version")
    assert (run.code, run.output) == (0, f"zlmreport {__version__}\n")


def test_help_names_every_command_and_the_exit_codes(shop: Shop) -> None:
    run = shop.run("--help")
    assert run.code == 0
    for word in [*COMMANDS, "--output", "--format", "--quiet", "--json", "--fail-on-nonconformity"]:
        assert word in run.output
    assert "3 a file could not be read or written" in " ".join(run.output.split())


@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_has_its_help(command: str, shop: Shop) -> None:
    run = shop.run(command, "--help")
    assert run.code == 0
    assert run.output.startswith(f"usage: zlmreport {command}")


def test_help_fits_a_terminal(shop: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    for command in [[], *([command] for command in COMMANDS)]:
        lines = shop.run(*command, "--help").output.splitlines()
        assert max(map(len, lines)) <= 80, command


def test_without_a_word_it_says_what_one_can_do_and_every_line_of_it_is_a_command(shop: Shop) -> None:
    done = shop.run()
    first, *lines = done.messages.splitlines()
    assert (done.code, first) == (2, "zlmreport: name a job, or say what you want:")
    assert {line.split()[1] for line in lines} - {"JOB.yaml", "--help"} <= set(arguments.COMMANDS)
    assert max(map(len, lines)) <= 80


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--quiet"], "zlmreport: the following arguments are required: JOB.yaml (see zlmreport --help)"),
        (
            ["fleet", "reprot", "fleet.yaml"],
            "zlmreport fleet: 'reprot' is neither a file nor a command; did you mean 'report'?",
        ),
        (["chek", "job.yaml"], "zlmreport: 'chek' is neither a file nor a command; did you mean 'check'?"),
        (["--quiet", "check"], "zlmreport: the command comes first: zlmreport check …"),
        (["job.yaml", "--formt", "pdf"], "zlmreport: unknown option '--formt'; did you mean '--format'?"),
        (["job.yaml", "--form=pdf"], "zlmreport: unknown option '--form'; did you mean '--format'?"),
        (["job.yaml", "--output"], "zlmreport: argument -o/--output: expected one argument"),
        (["job.yaml", "-q"], "zlmreport: unknown option '-q'; did you mean '--quiet'?"),
        (["job.yaml", "-x"], "zlmreport: unknown option '-x'; known: --confine, --fail-on-nonconformity"),
        (["check"], "zlmreport check: the following arguments are required: JOB.yaml"),
        (
            ["check", "job.yaml", "--format=pdf"],
            "zlmreport check: unknown option '--format'; known: --confine",
        ),
        (["init"], "zlmreport init: the following arguments are required: DIR"),
        (["init", "a", "b"], "zlmreport init: 'b' is one argument too many"),
        (["init", "a", "--from", "b.csv", "--machine", "c.csv"], "zlmreport init: --from writes a job"),
        (["init", "a", "--sheet", "Readings"], "zlmreport init: --sheet names a sheet"),
        (
            ["machine", "predict", "m.yaml", "--format", "pdf"],
            "zlmreport machine: --format belongs to certificate, not to predict",
        ),
        (
            ["machine", "check", "m.yaml", "-o", "out"],
            "zlmreport machine: --output belongs to certificate and compensate, not to check",
        ),
        (["machine", "plan", "m.yaml", "--step", "0"], "zlmreport machine: --step belongs to compensate"),
        (
            ["machine", "compensate", "m.yaml", "--trial", "--confirm", "c.yaml"],
            "zlmreport machine: --trial writes one value",
        ),
        (["plan", "job.yaml", "--decide", "bow", "--run", "2"], "zlmreport plan: --run writes programs"),
    ],
)
def test_wrong_command_line_is_answered_with_what_would_be_right(
    arguments: list[str], message: str, shop: Shop
) -> None:
    run = shop.run(*arguments)
    assert run.code == 2
    assert run.output == ""
    assert run.messages.startswith(message)


def test_job_may_be_called_like_a_command(shop: Shop) -> None:
    shop.job(name="check")
    assert shop.run("./check").code == 0


def test_job_needs_no_suffix(shop: Shop) -> None:
    shop.job(name="axis")
    assert shop.run("axis").code == 0


def test_interruption_ends_quietly(shop: Shop, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(**_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("zlmreport.cli.plugins.find_plugins", interrupted)
    run = shop.run("plugins")
    assert (run.code, run.output, run.messages) == (128 + signal.SIGINT, "", "")


def test_reader_that_goes_away_ends_quietly(tmp_path: Path) -> None:
    read_end, write_end = os.pipe()
    os.close(read_end)
    done = run(*ZLMREPORT, "schema", stdout=write_end, cwd=tmp_path)
    os.close(write_end)
    assert (done.returncode, done.stderr) == (128 + signal.SIGPIPE, "")


def test_full_disk_under_the_output_is_an_access_error() -> None:
    full = Path("/dev/full")
    if not full.exists():
        pytest.skip("there is no /dev/full here")
    with full.open("w") as sink:
        done = run(*ZLMREPORT, "schema", stdout=sink)
    assert done.returncode == 3
    assert done.stderr == "the standard output: cannot be read or written: no space left on device\n"
    assert "Traceback" not in done.stderr


def test_terminal_without_the_letters_gets_escapes() -> None:
    environment = {**os.environ, "PYTHONIOENCODING": "ascii", "PYTHONUTF8": "0"}
    done = run(PYTHON, "-W", "error", "-m", "zlmreport", "µ.yaml", env=environment)
    assert done.returncode == 3
    assert done.stderr.startswith("\\xb5.yaml: cannot be read")


def test_a_table_whose_name_is_no_text_makes_no_job(tmp_path: Path) -> None:
    table = tmp_path / os.fsdecode(b"a\xff.csv")
    table.write_bytes((ROOT / "configs" / "linear-axis" / "y-axis.csv").read_bytes())
    done = run(PYTHON, "-m", "zlmreport", "init", "new", "--from", table.name, cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr == (
        "a\\udcff.csv: has a path in another encoding than UTF-8, and no job can name it; rename it\n"
    )


def test_name_that_is_no_text_is_printed_as_an_escape(tmp_path: Path) -> None:
    done = run(PYTHON, "-W", "error", "-m", "zlmreport", os.fsdecode(b"a\xff.yaml"), cwd=tmp_path)
    assert done.returncode == 3
    assert "\\udcff" in done.stderr
    assert "Traceback" not in done.stderr


def test_version_loads_nothing_that_is_slow() -> None:
    code = (
        "import sys; from zlmreport.cli import main; main(['--version']);"
        "print(*sorted({'numpy', 'pydantic', 'yaml', 'pluggy', 'matplotlib', 'weasyprint', 'jinja2'}"
        " & sys.modules.keys()))"
    )
    done = run(PYTHON, "-c", code, check=True)
    assert done.stdout == f"zlmreport {__version__}\n\n"


def test_listing_plugins_loads_no_library_that_draws_or_prints() -> None:
    code = (
        "import sys; from zlmreport.cli import main; main(['plugins']);"
        "print(*sorted({'matplotlib', 'weasyprint', 'jinja2'} & sys.modules.keys()), file=sys.stderr)"
    )
    done = run(PYTHON, "-c", code, check=True)
    assert done.stderr == "\n"
