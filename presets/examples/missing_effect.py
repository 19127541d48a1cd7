# %% [markdown]
# # From a measurement to the missing effect, and to other conditions
#
# The force map of a DMSP-20 of 300 mm (Martens and Boblan 2017). The model is found on its low pressures
# and then predicts the high ones, which it has not seen.

# %%
import mckibben as mk

data = mk.read("martens-dmsp-20-300")
print(data)
table = data.to_frame()
pulling = table[table["force_N"] > 0]
low = mk.Measurement.from_frame(pulling[pulling["pressure_Pa"] <= 4e5], name="up to 4 bar")
high = mk.Measurement.from_frame(pulling[pulling["pressure_Pa"] > 4e5], name="above 4 bar")

# %% [markdown]
# The ideal muscle fails, and the diagnosis says why.

# %%
ideal = mk.Model.preset("DMSP-20", length="300 mm").ideal()
print(ideal.compare(low).rmse, "N")
found = ideal.diagnose(low)
print(found.sentence)
print(found.to_frame().head())
found.plot()

# %% [markdown]
# The repaired model, on what it was found with and on what it has not seen.

# %%
better = found.model
print(better)
known, new = better.compare(low), better.compare(high)
print(f"{known.rmse:.1f} N on the known rows, {new.rmse:.1f} N above 4 bar")
print(f"{ideal.compare(high).rmse:.1f} N above 4 bar by the ideal muscle")
print(*new.messages, sep="\n")
new.plot()

# %% [markdown]
# An effect can also be added by hand, and fitted.

# %%
fitted = ideal.with_effect("bladder_elasticity", shear_modulus="0.5 MPa").compare(low, fit=True)
print(fitted.parameters["bladder_elasticity"]["shear_modulus"])
print(fitted.model.compare(high).rmse, "N")
