"""Starts the command line: ``python -m zlmreport``."""

import sys

from zlmreport.cli import watched_main

sys.exit(watched_main())
