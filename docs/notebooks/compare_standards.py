# %% [markdown]
# # Compare standards
#
# The same readings by four rules: what one of them calls the accuracy of an axis, another calls by another
# name, and forms with other coverage factors.

# %%
import zlmreport as z

data = z.simulate(
    axis={"name": "X", "travel": [0, 1000]},
    targets={"count": 21},
    runs=5,
    effects=[{"scale-error": {"slope": 8}}, {"backlash": {"lost_motion": 3}}],
    noise={"reading": 0.8},
    seed=7,
)
names = {"iso230-2:1988": "A", "iso230-2:2014": "A", "vdi-dgq-3441": "P", "nmtba": "P"}
values = {standard: z.evaluate(data, standard)[symbol].value for standard, symbol in names.items()}
values

# %% [markdown]
# ISO 230-2:1988 takes 3 s on each side of a mean, the edition of 2014 takes 2 s: never compare parameters
# across standards, or across editions.

# %%
assert values["iso230-2:1988"] > values["iso230-2:2014"]

# %% [markdown]
# Where both are formed of means alone, the editions agree.

# %%
old, new = (z.evaluate(data, standard) for standard in ("iso230-2:1988", "iso230-2:2014"))
assert old["B"].value == new["B"].value
{each.symbol: (each.value, new[each.symbol].value) for each in old}
