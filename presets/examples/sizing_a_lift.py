# %% [markdown]
# # Sizing a lift, and checking the proposal with a full transient

# %%
import mckibben as mk

task = {
    "load": {"mass": "20 kg"},
    "stroke": "60 mm",
    "time": "0.5 s",
    "supply_pressure": "6 bar",
    "limits": {"max_length": "600 mm", "max_parallel": 1},
    "catalogue": {"muscles": ["DMSP-20", "DMSP-40"], "valves": ["MPYE-5-1/8-HF"], "tube_length": "1 m"},
}
sized = mk.size(task)
print(sized)
print(sized.to_frame())
sized.plot()

# %% [markdown]
# The best proposal as a drive: its full run must make the stroke in the time.

# %%
best = sized.proposals[0]
run = best.drive.run()
print(f"{best.muscle}, {1e3 * best.nominal_length:.0f} mm: {best.reason}")
print(
    f"{1e3 * run.position.max():.1f} mm after {run.timing.extend.positioning_time} s; promised {best.time} s"
)
run.plot()

# %% [markdown]
# What if the load is heavier, or the supply weaker?

# %%
for mass in ("20 kg", "25 kg", "30 kg"):
    heavier = best.drive.changed(load={"mass": mass}).run()
    print(mass, f"{1e3 * heavier.position.max():.1f} mm", heavier.timing.extend.positioning_time)
weak = best.drive.changed(supply="4 bar").run()
print("4 bar:", f"{1e3 * weak.position.max():.1f} mm")
