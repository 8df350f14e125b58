"""The number of the release."""

import datetime as dt

__version__ = "0.2.0"
#: The day on which this release was made: a clock that shows an earlier one is wrong.
RELEASED = dt.date(2026, 11, 28)
