# %% [markdown]
# # First steps: a muscle from the catalogue, its curves, and a drive through time
#
# Texts have a unit, plain numbers are SI, pressures are gauge.

# %%
import mckibben as mk

model = mk.Model.preset("DMSP-20", length="300 mm")
curves = model.curves("1 bar, 3 bar, 6 bar")
print(curves.force.max(axis=1))
print(model.force(pressure="6 bar", contraction=["0 %", "10 %", "20 %"]))

run = mk.Drive.preset("propneu-20-physical").run()
print(run.timing.extend.rise_time, run.timing.retract.positioning_time)
run.plot()

# %% [markdown]
# The tables of the command line are the text of a result. A notebook shows them by itself.

# %%
print(curves)
print(run)

# %% [markdown]
# Without its effects the muscle is ideal. What do they take from the force?

# %%
lost = model.ideal().force(pressure="6 bar", contraction="10 %") - model.force(
    pressure="6 bar", contraction="10 %"
)
print(f"{lost:.0f} N of the ideal force are lost at 6 bar and 10 %")

# %% [markdown]
# A drive of its own: the same muscle, longer, with a valve, a load and a pulse.

# %%
lift = mk.Drive(
    model.with_geometry(nominal_length="600 mm"),
    valve="MPYE-5-1/8-HF",
    load={"mass": "20 kg"},
    command={"shape": "pulse", "on": "0 s", "off": "1.5 s"},
    duration="3 s",
)
lifted = lift.run()
print(f"{1e3 * lifted.position.max():.0f} mm in {lifted.timing.extend.positioning_time or 0.0:.3f} s")
print(lifted.to_frame().tail())
