# %% [markdown]
# # Evaluate a test
#
# Targets in mm; deviations in µm, a row for each run.

# %%
import zlmreport as z

targets = [0, 250, 500, 750, 1000]
up = [[0.1, 3.2, 6.9, 10.4, 13.8], [0.3, 3.4, 6.8, 10.1, 13.9]]
down = [[-2.1, 0.9, 4.6, 8.2, 11.5], [-2.0, 1.2, 4.4, 8.0, 11.9]]
data = z.test(targets, up, down)
result = z.evaluate(data, "iso230-2:2014", tolerances={"A": 20, "B": 2})
result

# %% [markdown]
# One value has its unit, its limit and what is said of it.

# %%
accuracy = result["A"]
accuracy.value, accuracy.unit, accuracy.limit, accuracy.conforms

# %%
assert accuracy.conforms
assert not result["B"].conforms

# %% [markdown]
# The table by target, and what the standard asks of a test and this one does not meet.

# %%
result.positions

# %%
result.findings

# %%
assert any("5" in finding for finding in result.findings)

# %% [markdown]
# The prescribed graph, on axes of matplotlib.

# %%
axes = result.plot()
axes.set_title("X, before the repair")
