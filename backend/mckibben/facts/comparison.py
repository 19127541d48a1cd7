"""Figures of a comparison of a model with measurements: channels, errors, the residual, the measured range.

r is the residual, measured − model, row by row. A figure without a unit of its own has that of the predicted
channel, which the result says; errors of several channels together are multiples of the noise of each.
"""

from __future__ import annotations

from dataclasses import replace

from mckibben.facts.figure import Condition, Figure, Group
from mckibben.facts.units import QUANTITIES, Scale, quantity_of

#: Percentile of the speeds that is the largest one of a measured range.
FASTEST = 99.0

#: Unit of an error of several channels together.
TIMES_NOISE = Scale("× noise")


def error_scale(unit: str) -> Scale:
    """Unit in which reports and the terminal show an error.

    Args:
        unit: SI unit of the error; "1" of several channels together.
    """
    if unit == "1":
        return TIMES_NOISE
    quantity = quantity_of(unit)
    return Scale(unit) if quantity is None else QUANTITIES[quantity].scales["bar"]


_NOISE = Condition("the noise is stated or can be estimated", "the noise is not known")
_GROUPS = Condition("there are two or more groups of rows", "only one group: there is no held-out error")
_MAGNITUDE = Condition("a measured value differs from 0", "all measured values are 0")
_STROKE = Condition("a length or a stroke is predicted and varies", "the error is none of a varying length")
_VARIES = Condition("the measured values vary", "the measured values do not vary")
_STDERR = Condition("it is fitted and the data determine it", "it is given, or the data do not determine it")
_FITTED = Condition("several values are fitted", "no fitted values are strongly correlated")
_WINDOWS = Condition(
    "a stroke was measured over time, and where a command drives the model the pressure too",
    "windows begin from a measured stroke over time, and from the pressure where a command drives the model",
)
_CHECK = Condition("a file is kept for a check", "no file is kept for a check")
_SPECIMENS = Condition("there are several specimens", "there is one specimen")
_ACCURACY = Condition("an accuracy is stated or assumed", "no accuracy is stated or assumed")
_LAGS = Condition("the sweeps are long enough", "the sweeps are too short for an autocorrelation")
_INPUT = Condition(
    "there are times, sweeps of at least 100 rows, and an input that varies within them",
    "no correlation with an input: it takes times, sweeps of at least 100 rows, and a pressure, command, "
    "load "
    "or contraction that varies within them",
)
_LOOPS = Condition(
    "the force is measured over a length that returns to its start",
    "no loops in these data: a loop is the force over a length that returns to its start, at one pressure",
)
_MEASURED = Condition("it was measured or stated", "it was not measured")

#: Columns of measurements: what is measured, predicted, and what a residual is shown over.
CHANNELS = Group(
    "channel",
    "Channels of a measurement",
    Figure("contraction", "ε", "1", "Contraction", "1 − length/rest length.", quantity="ratio"),
    Figure("pressure", "p", "Pa", "Pressure", "Gauge pressure in the muscle."),
    Figure(
        "velocity", "dL/dt", "m/s", "Velocity dL/dt",
        "Change of the length over time, positive while the muscle lengthens; velocities of a run count "
        "towards shorter.",
        quantity="sweep",
    ),
    Figure(
        "direction", "", "1", "Direction of motion", "−1 shortening, 1 lengthening, 0 at rest or unknown.",
        quantity="number",
    ),
    Figure("time", "t", "s", "Time", "Time of the row."),
    Figure("length", "L", "m", "Length", "Length of the muscle."),
    Figure(
        "displacement", "x", "m", "Stroke", "Rest length − length of the muscle."
    ),
    Figure(
        "diameter", "D", "m", "Diameter",
        "Diameter at mid-span; it is compared with that of the braid, the middle of the wall.",
    ),
    Figure("force", "F", "N", "Force", "Tension of the muscle."),
    Figure("load", "", "N", "Load", "Force that the muscle carries."),
    Figure(
        "command", "u", "1", "Command", "Opening of the valve: 1 fill, 0 closed, −1 vent.",
        quantity="number",
    ),
    Figure("temperature", "T", "K", "Muscle temperature", "Temperature of the muscle, not of its air."),
    Figure("angle", "φ", "rad", "Angle", "Angle of the joint."),
    Figure("torque", "M", "N*m", "Torque", "Torque on the joint, as it was measured."),
    Figure("lever", "r", "m", "Lever", "Lever at which the muscle pulls at the joint."),
    Figure(
        "counter_pressure", "p₂", "Pa", "Pressure of the second muscle",
        "Gauge pressure in the muscle that pulls against the first.",
    ),
    Figure("group", "", "1", "Group", "Number of the sweep or run.", quantity="number"),
)  # fmt: skip

_NOISE_FIGURE = Figure(
    "noise_floor", "σ", "", "Noise",
    "Standard deviation of a reading: as stated, by the stated accuracy, or estimated from third differences "
    "within sweeps or from near neighbours; 1 of several channels together.", _NOISE,
)  # fmt: skip
_LARGEST = "100 × that error over max |measured|; an offset of the channel, as of a length, makes it small."

#: The error of a model.
COMPARISON = Group(
    "comparison",
    "Comparison of a model with measurements",
    Figure(
        "rmse_beyond_accuracy", "e", "", "Error",
        "√(mean r²) of what errors of the readings within their accuracy do not explain; the RMS error where "
        "they explain nothing. A diagnosis counts with it.",
    ),
    Figure(
        "rmse", "e_r", "", "RMS error",
        "√(mean r²) over the compared rows, whatever the accuracy of the readings; of several channels "
        "together each over its noise.",
    ),
    Figure("nrmse_percent", "", "%", "RMS error of the largest measured magnitude", _LARGEST, _MAGNITUDE),
    Figure(
        "stroke_percent", "", "%", "RMS error of the stroke",
        "100 × RMS error of the length or stroke over the measured stroke, max − min of all rows.",
        _STROKE,
    ),
    Figure(
        "holdout_rmse", "e_h", "", "Held-out error",
        "The error over whole groups of rows, each predicted with values fitted to the others (to first "
        "order "
        "around the fit); the error itself where nothing is fitted.", _GROUPS,
    ),
    _NOISE_FIGURE,
    Figure(
        "over_noise", "e/σ", "1", "Error over noise", "The error over the noise.", _NOISE, quantity="number"
    ),
    Figure("residual_mean", "", "", "Mean of the residual", "mean(measured − model)."),
    Figure(
        "fit_percent", "", "%", "Fit (100 % is perfect)",
        "100 (1 − √(Σ r²/Σ (measured − mean)²)) over the compared rows, the mean of the channels; at 90 % "
        "the "
        "model leaves 1 % of the variance.", _VARIES,
    ),
    Figure("full_scale", "", "", "Largest measured magnitude", "max |measured|."),
    Figure("rows", "", "1", "Rows", "Number of rows of the measurements.", quantity="number"),
    Figure("rows_used", "n", "1", "Rows used", "Number of compared rows.", quantity="number"),
    Figure(
        "fitted", "k", "1", "Fitted values",
        "Number of values that were fitted; with 0 no group was left out of anything.", quantity="number",
    ),
)  # fmt: skip

_REVERSALS = Condition(
    "readings of force lie where the motion turns",
    "no readings of force where the motion turns",
)

#: Readings where the motion turns, which are in none of the errors.
REVERSALS = Group(
    "reversals",
    "Readings at reversals",
    Figure(
        "rows", "", "1", "Readings at reversals",
        "Rows at which the motion turns: dry friction may have any value of its range there; a model without "
        "friction has a range of no width.",
        _REVERSALS, quantity="number",
    ),
    Figure(
        "low", "F₁", "", "Least force at a reversal",
        "The lesser of the forces of the shortening and the lengthening muscle; at a joint of its torques.",
        _REVERSALS,
    ),
    Figure(
        "high", "F₂", "", "Larger force at a reversal",
        "The larger of the forces of the shortening and the lengthening muscle; at a joint of its torques.",
        _REVERSALS,
    ),
    Figure(
        "distance", "", "", "Distance from the range of friction",
        "max(F₁ − F, F − F₂, 0); the largest one of all readings.", _REVERSALS,
    ),
    Figure(
        "outside", "", "1", "Readings outside of the range",
        "Readings with a distance of more than three standard deviations of the noise; of a model without "
        "friction, also of more than three times the error of the other rows.",
        _REVERSALS, quantity="number",
    ),
)  # fmt: skip

#: The error over windows, each of which begins anew from what was measured.
WINDOWS = Group(
    "windows",
    "Error over windows",
    Figure(
        "rmse", "e_w", "", "RMS error over windows",
        "√(mean r²) of a run that begins anew in each window, at the measured stroke, its smoothed speed "
        "and, with a command, the measured pressure; states of effects follow the measured motion.",
        _WINDOWS,
    ),
    Figure(
        "perfect", "", "", "A perfect model over windows",
        "The same error of the model's own run with the noise of the readings in place of the measurement; "
        "white noise, from third differences of all rows where it is not stated.", _WINDOWS,
    ),
    Figure(
        "length", "T_w", "s", "Length of a window",
        "One mean period of the measured motion, twice the duration over the number of its reversals, to two "
        "digits; at most a quarter of the record, at least ten rows.", _WINDOWS,
    ),
    Figure("count", "", "1", "Windows", "Number of whole windows.", _WINDOWS, quantity="number"),
)  # fmt: skip

#: The error on files that are compared but not fitted.
CHECK = Group(
    "check",
    "Check",
    Figure("rmse", "", "", "Check error", "√(mean r²) on files that are compared but not fitted.", _CHECK),
    Figure("nrmse_percent", "", "%", "Check error of the largest measured magnitude", _LARGEST, _CHECK),
    Figure(
        "rows_used", "", "1", "Rows of the check", "Number of its compared rows.", _CHECK, quantity="number",
    ),
)  # fmt: skip

#: The error on each of several specimens.
SPECIMEN = Group(
    "specimen",
    "Error on each specimen",
    Figure(
        "rmse", "", "", "Error",
        "The error on its rows, beyond the accuracy of the readings; of a diagnosis that of the best model.",
    ),
    Figure(
        "holdout_rmse", "", "", "Held-out error",
        "The same over whole groups of its rows, each predicted with values fitted to the others.",
        replace(_GROUPS, otherwise="no group of rows is left out"),
    ),
    Figure(
        "left_out_rmse", "", "", "Error, fitted to the others",
        "Error on its rows of the model fitted to the other specimens alone.", _SPECIMENS,
    ),
    Figure(
        "left_out_percent",
        "", "%", "Error, fitted to the others, of the largest measured magnitude", _LARGEST,
        _SPECIMENS,
    ),
)  # fmt: skip

#: A parameter of a model, as given or fitted.
PARAMETER = Group(
    "parameter",
    "Parameters",
    Figure("value", "", "", "Value", "As given, or fitted."),
    Figure(
        "stderr", "±", "", "± standard error",
        "Standard error of the fitted value, one standard deviation, from the covariance of the fit under "
        "noise that may be correlated from row to row.",
        _STDERR,
    ),
    Figure(
        "correlation", "", "1", "Correlation of two fitted values",
        "Coefficient from the covariance of the fit, −1 to 1; near ±1 the data determine a combination of "
        "the two only.", _FITTED, quantity="number",
    ),
)  # fmt: skip

#: What the residual shows.
RESIDUAL = Group(
    "residual",
    "The residual",
    Figure(
        "share_explained", "R²", "1", "Share of the squared error that the variable alone predicts",
        "1 − mean((r − mean of its range in the other groups)²)/mean(r²), at least 0; cross-validated, over "
        "ranges with equally many rows. Half of the squared error is 29 % of the error.",
        quantity="ratio",
    ),
    Figure("rmse", "", "", "RMS error there", "√(mean r²) of the rows in the range with the largest one."),
    Figure("mean", "", "", "Mean residual", "mean(r) of the rows in each range or cell."),
    Figure(
        "rms", "", "", "RMS of the residual",
        "√(mean r²) of the rows in each range or cell, its mean in it.",
    ),
    Figure("count", "", "1", "Rows", "Number of rows in each range or cell.", quantity="number"),
    Figure(
        "explained_mean", "", "", "An effect explains",
        "Mean over the rows in the range of the prediction of the model less that without the effect, its "
        "other values unchanged.",
    ),
    Figure(
        "explained_rms", "", "", "RMS of what an effect explains",
        "√(mean d²) over the rows in the range, d the prediction of the model less that without the effect.",
    ),
    Figure(
        "share", "", "1", "Part of the squared error",
        "Share of Σ r² that a variable takes from what those before it left (sequential analysis of "
        "variance, "
        "without what chance gives); all parts add up to 100 %.", quantity="ratio",
    ),
    Figure(
        "autocorrelation",
        "ρ", "1", "Autocorrelation", "Correlation of r with itself some rows later within sweeps.",
        _LAGS, quantity="number",
    ),
    Figure(
        "correlation", "", "1", "Correlation with the input",
        "Correlation of r with the input some rows before it within sweeps.", _INPUT, quantity="number",
    ),
    Figure(
        "band", "", "1", "Half-width of the 95 % band", "1.96 standard deviations of what chance gives.",
        quantity="number",
    ),
    Figure(
        "outside", "", "1", "Share of the lags outside the 95 % band", "Chance gives 5 %.", quantity="ratio"
    ),
    Figure(
        "sign_changes", "", "1", "Sign changes over those of noise",
        "Number of changes of the sign of r − mean(r) within sweeps over half the number of pairs of rows.",
        quantity="number",
    ),
    Figure(
        "white", "", "1", "Neighbouring rows are not correlated",
        "At most 15 % of the lags outside the band, and the sign changes within 3 standard deviations.",
        quantity="number",
    ),
    Figure(
        "area", "", "J", "Area of a loop",
        "∮ r dL; positive: the muscle dissipates more than the model.", _LOOPS,
    ),
    Figure(
        "area_noise", "", "J", "Area of a loop by noise alone",
        "Standard deviation of the area from white noise of the readings, σ √Σ w², with the weights w of the "
        "trapezoidal rule.", replace(_LOOPS, name="there are loops and the noise is known"),
    ),
    Figure("span", "", "m", "Travel of a loop", "max L − min L of the loop.", _LOOPS),
    Figure(
        "friction", "", "N", "Equivalent friction",
        "area/(2 travel): the constant friction force that dissipates as much; negative where the model "
        "dissipates more than the muscle.", _LOOPS,
    ),
)  # fmt: skip

#: An error of readings within their accuracy.
READING_ERROR = Group(
    "reading_error",
    "Errors of the readings within their accuracy",
    Figure(
        "value", "", "", "Error of the reading", "Estimate of the error that the fit allows for.", _ACCURACY,
    ),
    Figure("stderr", "±", "", "± standard error", "Standard error of the estimate.", _ACCURACY),
    Figure(
        "accuracy", "", "", "Accuracy", "Standard deviation of the error as stated or assumed.", _ACCURACY,
    ),
    Figure(
        "rms", "", "", "Changes the prediction by", "RMS over all rows, in the unit of the error.",
        _ACCURACY,
    ),
)  # fmt: skip

#: Quantities whose range in the data of a model is kept with it.
MEASURED = Group(
    "measured",
    "Measured range",
    Figure("rest_length", "L₀", "m", "Rest length", "Rest length of the muscles.", _MEASURED),
    replace(CHANNELS["pressure"], exists_when=_MEASURED),
    replace(CHANNELS["contraction"], exists_when=_MEASURED),
    Figure(
        "speed", "|dL/dt|", "m/s", "Speed",
        f"From 0 to the {FASTEST:.0f}th percentile of |dL/dt|: faster rows are noise of the differentiation.",
        Condition("there are times", "there are no times"), quantity="sweep",
    ),
    replace(CHANNELS["temperature"], exists_when=_MEASURED),
    replace(CHANNELS["load"], exists_when=_MEASURED),
    Figure("mass", "m", "kg", "Moved mass", "Mass that the muscle moves.", _MEASURED),
    Figure("supply", "", "Pa", "Supply pressure", "Gauge pressure upstream of the valve.", _MEASURED),
)  # fmt: skip

#: The noise of the data as a diagnosis says it.
NOISE = Group(
    "noise",
    "Noise",
    replace(_NOISE_FIGURE, name="rmse"),
    Figure(
        "interval", "", "", "Noise, from and to",
        "From the scatter of neighbouring readings to the error of the model, where that is noise.",
        Condition(
            "the noise is known and all that is left is noise",
            "the noise is unknown, or what is left may be more than noise",
        ),
    ),
)  # fmt: skip
