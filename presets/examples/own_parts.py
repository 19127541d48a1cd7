# %% [markdown]
# # Own parts: a muscle of your own, an effect of your own, and a fit with a freed angle
#
# Beside this file lies the folder `own`: a muscle preset, and an effect in one Python file.

# %%
from pathlib import Path

import mckibben as mk

here = Path(__file__).parent if "__file__" in globals() else Path.cwd()
mk.use_presets(here / "own" / "presets")
mk.use_effects(here / "own" / "effects")
print(mk.presets("muscles"))
print(mk.effects()["seal_drag"].cause)

# %% [markdown]
# The muscle by its preset, and the same one by its geometry.

# %%
bench = mk.Model.preset("bench-10", length="250 mm")
drawn = mk.Model(
    inside_diameter="10 mm", braid_diameter="11.5 mm", braid_angle="25 deg", nominal_length="250 mm"
)
for model in (bench, drawn):
    print(model.name, model.force(pressure="5 bar", contraction=["0 %", "10 %"]))

# %% [markdown]
# Measured points as arrays: pressures in kPa, lengths in mm, forces in N. Here they are those of a
# published map.

# %%
table = mk.read("martens-dmsp-10-250").to_frame()
table = table[table["force_N"] > 0]
data = mk.Measurement.from_arrays(
    {"pressure": table["pressure_Pa"] / 1e3, "length": table["length_m"] * 1e3, "force": table["force_N"]},
    units={"pressure": "kPa", "length": "mm"},
    name="bench map",
    rest_length="250 mm",
)

# %% [markdown]
# Fit the bladder, the seal, and the braid angle within its tolerance.

# %%
model = bench.with_effect("bladder_elasticity").with_effect("seal_drag", drag="8 N")
before = model.compare(data)
after = model.compare(data, fit=True, free="braid_angle")
print(f"{before.rmse:.1f} N before, {after.rmse:.1f} N after the fit")
print(after)
after.plot()

# %% [markdown]
# Back to the program's own presets and effects.

# %%
mk.use_presets(None)
mk.use_effects()
