# %% [markdown]
# # Find the hidden effect
#
# An axis with a lost motion that its error model does not have. The model says that something is missing,
# what it is, and how the error falls once it is added.

# %%
import zlmreport as z

data = z.simulate(
    axis={"name": "X", "travel": [0, 1000]},
    targets={"count": 21},
    effects=[{"backlash": {"lost_motion": 4}}, {"scale-error": {"slope": 10}}],
    noise={"reading": 0.3},
    seed=2,
)
model = z.fit(data, ["offset", "scale-error"])
model

# %%
diagnosis = model.diagnose()
diagnosis

# %%
assert diagnosis.verdict == "missing"
assert diagnosis.candidates[0].effect == "backlash"

# %% [markdown]
# Add it, and look again.

# %%
better = model.add(diagnosis.candidates[0])
model.rms, better.rms

# %%
assert better.rms < model.rms / 4
assert abs(better["backlash.lost_motion"].value - 4) < 0.5

# %%
axes = better.plot()
