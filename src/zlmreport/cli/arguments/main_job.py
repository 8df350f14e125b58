"""The main job, which has no word of its own on the command line."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from zlmreport import __version__
from zlmreport.cli.arguments.parser import JSON_HELP, CommandParser, add_jobs

#: Environment variable with the password of the key that signs.
SIGN_PASSWORD = "ZLMREPORT_SIGN_PASSWORD"  # noqa: S105 (a name)

_MAIN_EPILOG = """\
examples:
  zlmreport init first && zlmreport first/job.yaml
  zlmreport x-axis.yaml y-axis.yaml --output certificates
  zlmreport x-axis.yaml --format pdf,html,json --fail-on-nonconformity

exit codes: 0 done; 1 done, but a limit is not met (only with --fail-on-nonconformity);
2 a job, its data or the command line is wrong; 3 a file could not be read or written
"""


def main_job(commands: Mapping[str, str]) -> CommandParser:
    """Return the parser of the main job; its help lists the other commands, each with a line."""
    parser = CommandParser("zlmreport", _description(commands), _MAIN_EPILOG)
    parser.add_argument("--version", action="version", version=f"zlmreport {__version__}")
    add_jobs(parser)
    parser.add_argument(
        "-o", "--output", metavar="DIR", type=Path, help="folder of the files, instead of the job's"
    )
    parser.add_argument(
        "--format", metavar="F,F", help="formats, parted by commas, instead of the job's: pdf,html,json"
    )
    parser.add_argument(
        "--sign",
        metavar="ID",
        help="sign the PDF with the key in a PKCS#12 file (ID.p12) or a token (pkcs11:…); its password is "
        f"asked for, or stands in the environment variable {SIGN_PASSWORD}",
    )
    parser.add_argument("--quiet", action="store_true", help="print nothing but mistakes")
    parser.add_argument("--json", action="store_true", help=JSON_HELP)
    parser.add_argument(
        "--fail-on-nonconformity", action="store_true", help="exit with 1 if a stated limit is not met"
    )
    return parser


def _description(commands: Mapping[str, str]) -> str:
    listed = "\n".join(f"  {name:12} {summary}" for name, summary in commands.items())
    return (
        "Read the measurements that a job names, evaluate them by its standards, and write\n"
        f"the certificate.\n\nother commands:\n{listed}\n"
    )
