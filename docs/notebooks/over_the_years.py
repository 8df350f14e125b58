# %% [markdown]
# # An axis over the years
#
# Five yearly tests of one axis whose lost motion grows. The results files of a fleet hold the same numbers:
# read them with `json.loads(path.read_text())["evaluations"]`, or let `zlmreport fleet report` draw them.

# %%
import numpy as np
import pandas as pd

import zlmreport as z

years = np.arange(2022, 2027)
tests = [
    z.simulate(
        axis={"name": "X", "travel": [0, 1000]},
        targets={"count": 21},
        effects=[{"backlash": {"lost_motion": 2 + 1.5 * number}}],
        noise={"reading": 0.4},
        seed=int(year),
    )
    for number, year in enumerate(years)
]
history = [z.evaluate(each, "iso230-2:2014") for each in tests]
reversal = np.array([each["B_mean"].value for each in history])
pd.DataFrame({"year": years, "B_mean": reversal, "A": [each["A"].value for each in history]})

# %% [markdown]
# A straight line through the mean reversal value: how fast it grows, and when it reaches a limit.

# %%
slope, _ = np.polyfit(years - years[0], reversal, 1)
limit = 12.0
due = years[-1] + (limit - abs(reversal[-1])) / abs(slope)
round(abs(slope), 2), round(due, 1)

# %%
assert abs(abs(slope) - 1.5) < 0.1
assert 2028 < due < 2030
