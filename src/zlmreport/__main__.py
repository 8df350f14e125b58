"""``python -m zlmreport``."""

import sys

from zlmreport.cli import main

sys.exit(main())
