"""The commands from a job to its certificate, and those that help to write one."""

from __future__ import annotations

from pathlib import Path

from zlmreport.cli.arguments.parser import JSON_HELP, CommandParser, add_jobs


def check(command: str) -> CommandParser:
    """Return the parser of ``zlmreport check``."""
    parser = CommandParser(
        f"zlmreport {command}",
        "Validate jobs and their data, and hold each standard's requirements against the test.\n"
        "Nothing is written. A requirement that is not met is no mistake; the certificate says so.",
        "example:\n  zlmreport check x-axis.yaml",
    )
    add_jobs(parser)
    parser.add_argument("--quiet", action="store_true", help="print nothing but mistakes")
    parser.add_argument("--json", action="store_true", help=JSON_HELP)
    return parser


def init(command: str) -> CommandParser:
    """Return the parser of ``zlmreport init``."""
    parser = CommandParser(
        f"zlmreport {command}",
        "Write a commented job, a laboratory's shared data and sample readings, to begin with.\n"
        "No file that is there already is touched.",
        "example:\n  zlmreport init first && zlmreport first/job.yaml",
    )
    parser.add_argument("directory", metavar="DIR", type=Path, help="folder; it is made if it is not there")
    return parser


def plugins(command: str) -> CommandParser:
    """Return the parser of ``zlmreport plugins``."""
    return CommandParser(
        f"zlmreport {command}",
        "List every plugin found, by kind, with its identifier, title and distribution,\n"
        "and why one failed to load. ZLMREPORT_DISABLE_PLUGINS=name,name switches plugins off.",
    )


def schema(command: str) -> CommandParser:
    """Return the parser of ``zlmreport schema``."""
    return CommandParser(
        f"zlmreport {command}",
        "Print the JSON Schema of the job file, with the keys of all installed plugins.",
        "example, for editors that use the YAML language server: write the schema to a file,\n"
        "  zlmreport schema > job.schema.json\n"
        "and begin the job with the line\n"
        "  # yaml-language-server: $schema=job.schema.json",
    )


def verify(command: str) -> CommandParser:
    """Return the parser of ``zlmreport verify``."""
    parser = CommandParser(
        f"zlmreport {command}",
        "Evaluate a certificate again from the job and the readings that it carries, print it again, and\n"
        "say for every number, page and attached file whether it holds. Nothing is written.",
        "example:\n  zlmreport verify CAL-2026-0117.pdf\n\n"
        "exit codes: 0 everything holds; 1 something does not; 2 the file is no certificate of zlmreport,\n"
        "or cannot be evaluated here; 3 the file cannot be read",
    )
    parser.add_argument("certificate", metavar="FILE.pdf", type=Path, help="certificate, signed or not")
    parser.add_argument("--json", action="store_true", help="print every finding as JSON")
    parser.add_argument(
        "--dcc-schema",
        metavar="DIR",
        type=Path,
        help="check an attached digital certificate (DCC) by PTB's rules, and by PTB's schema in this folder",
    )
    return parser
