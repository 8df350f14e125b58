"""``zlmreport schema``: the JSON Schema of the job file."""

from __future__ import annotations

from argparse import Namespace

from zlmreport.cli.terminal import print_json
from zlmreport.job.schema import job_schema
from zlmreport.plugins import find_plugins


def run(options: Namespace) -> int:
    """Print the schema, with the keys of all installed plugins."""
    print_json(job_schema(find_plugins(files=options.plugin)))
    return 0
