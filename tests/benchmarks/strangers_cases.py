"""Sealed cases of an outside examiner: muscles, rigs and laboratories that the project has not seen.

Each case is made from a seed by formulas of its own: the pull of the threads by their angle, walls of Yeoh,
Ogden and Fung rubber (thin, or integrated over the thickness), LuGre and Ogden-Roxburgh laws, hereditary
integrals, and for transients a fixed-step Runge-Kutta run of valve, tank, tube, chamber and load. Nothing is
imported from the program. The rule of judgement of each case is written here, with the truth, before any
answer is seen.

Signs: force is a pull > 0; v = dL/dt > 0 is lengthening; friction and damping pull more on lengthening;
strokes are positive towards shorter; pressures are gauge unless called absolute.
"""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Effects = dict[str, dict[str, Any]]

GRAVITY = 9.80665  # m/s2
GAS = 287.05  # J/(kg K)
ROOM = 293.15  # K
NORMAL_DENSITY = 1.185  # kg/m3, ISO 8778
AMBIENT = 101_325.0  # Pa
BAR = 1e5  # Pa
LITRE = 1e-8  # m3/(s Pa) in l/(s bar)
PSI = 6894.757  # Pa
POUND = 4.4482216  # N
INCH = 0.0254  # m

# ------------------------------------------------------------------------------------------------ names
# What counts as one hidden effect: its id, and ids that no such data can tell from it.
GAIN = frozenset({"effectiveness", "pressure_scale", "force_scale"})
"""F = s P g(L): a factor on force, on pressure or on effectiveness is the same number."""
ZERO = frozenset({"force_offset", "prestress"})
"""A constant force is a constant force, in the cell or in the bladder."""
DEAD_ZONE = frozenset({"threshold_pressure", "pressure_offset"})
"""F = (P - P0) g(L), cut at zero: a gauge that reads P0 too much and a bladder that needs P0 to expand."""
WALL = frozenset({"bladder_elasticity"})
ANY_WALL = frozenset({"bladder_elasticity", "linear_elasticity"})
"""A law between the two of the catalogue: either says that the wall is elastic."""
ENDS = frozenset({"contraction_factor", "end_caps", "lost_stroke"})
"""Ineffective ends: the middle contracts by x / (L0 - 2 l); all three name the ends as the cause."""
PRESSED_FRICTION = frozenset({"pressure_friction", "contact_friction"})
"""Both grow with pressure; their shapes over the length agree to 0.3 % in loops."""
PRESLIDING = frozenset({"dahl", "bouc_wen", "maxwell_slip"})
"""One smooth turning curve with one constant: each of the three has it as a special case."""
COULOMB = frozenset({"coulomb_friction"})
ONE_FLOW = frozenset({"tube_resistance", "flow_coefficient"})
"""An on/off valve behind a resistance is a smaller valve, both ways."""
EXHAUST = frozenset({"exhaust_restriction", "silencer"})
"""A silencer without a volume of its own is a restriction."""
HANGING = frozenset({"moving_mass", "load_scale"})
"""A hook that hangs with the load adds weight and inertia as a heavier load does."""

DECIDED = frozenset({"adequate"})
OPEN = frozenset({"adequate", "undecided"})


@dataclass(frozen=True)
class Ask:
    """One question, as a user of the Python door puts it.

    Attributes:
        file: text of the measurement.
        muscle: arguments of the start model.
        effects: of the start model.
        options: of reading: rest length, load, columns.
        drive: valve, supply, load and gas of a transient; None for statics.
    """

    file: str
    muscle: dict[str, Any]
    effects: Effects = field(default_factory=dict)
    options: dict[str, Any] = field(default_factory=dict)
    drive: dict[str, Any] | None = None


@dataclass(frozen=True)
class Stranger:
    """A case with its truth.

    Attributes:
        name: kind/what/size.
        rule: how it is judged: names, nothing, unknown, second, entry, right entry, rows, start or scale.
        owed: the rule in words.
        truth: what was done to the data.
        asks: one, or two whose answers are compared.
        hidden: for each hidden effect the ids that are right.
        tolerated: ids that are neither right nor surplus, because ...: said in ``truth``.
        statuses: that are right; empty for any.
        entries: right hypotheses of a wrong entry; those that must not be asked of a right one; elsewhere
            exact twins of what is hidden, which may be asked.
        twin: whether the wrong entry has an exact twin among the effects: listed first is enough, or that the
            twin in ``hidden`` is named alone.
        rows: bad rows, counted from 1.
        period: of a repetition that may be told [s] or [m].
        second: a second file of the rig; ``noise`` of each of its predicted channels.
        noise: channel -> standard deviation [SI] of what is predicted; of the second file where there is one.
        strength: of the hidden effects over the noise (root mean square), nan where it is not that simple.
        check: expected kind and rows of the first file, for ``--read``.
    """

    name: str
    rule: str
    owed: str
    truth: str
    asks: tuple[Ask, ...]
    hidden: tuple[frozenset[str], ...] = ()
    tolerated: frozenset[str] = frozenset()
    statuses: frozenset[str] = frozenset()
    entries: frozenset[str] = frozenset()
    twin: bool = False
    rows: frozenset[int] = frozenset()
    period: float | None = None
    second: Ask | None = None
    noise: Mapping[str, float] = field(default_factory=dict)
    strength: float = math.nan
    check: tuple[str, int] = ("", 0)

    @property
    def kind(self) -> str:
        return self.name.split("/")[0]

    @property
    def transient(self) -> bool:
        return self.asks[0].drive is not None


# ------------------------------------------------------------------------------------------------ muscles
@dataclass(frozen=True)
class Body:
    """A muscle: braid diameter, length and wall [mm], braid angle [deg]."""

    braid: float
    angle: float
    length: float
    wall: float

    @property
    def rest(self) -> float:
        return self.length * 1e-3

    @property
    def tilt(self) -> float:
        return math.radians(self.angle)

    @property
    def thread(self) -> float:
        """Length of one thread [m]."""
        return self.rest / math.cos(self.tilt)

    @property
    def round(self) -> float:
        """Section of the muscle [m2] if its threads lay across."""
        return math.pi / 4.0 * (self.braid * 1e-3 / math.sin(self.tilt)) ** 2

    @property
    def turns(self) -> float:
        return self.thread * math.sin(self.tilt) / (math.pi * self.braid * 1e-3)

    @property
    def stated(self) -> dict[str, Any]:
        """As a user writes it."""
        return {
            "inside_diameter": f"{self.braid - self.wall:g} mm",
            "braid_diameter": f"{self.braid:g} mm",
            "braid_angle": f"{self.angle:g} deg",
            "nominal_length": f"{self.length:g} mm",
            "wall_thickness": f"{self.wall:g} mm",
        }

    def pull(self, pressure: Any, length: Any, thread: Any = None) -> Any:
        """Tension of the threads [N]: three cosines squared less one, times the round section."""
        cosine = length / (self.thread if thread is None else thread)
        wide = self.round if thread is None else self.round * (thread / self.thread) ** 2
        return pressure * wide * (3.0 * cosine**2 - 1.0)

    def room(self, length: Any) -> Any:
        """Volume inside the braid [m3]."""
        return length * self.round * (1.0 - (length / self.thread) ** 2)

    def blocked(self, pressure: float) -> float:
        return float(self.pull(pressure, self.rest))

    def scaled(self, factor: float) -> Body:
        return Body(self.braid * factor, self.angle, self.length * factor, self.wall * factor)


BODIES = {
    5: Body(6.4, 24.5, 120.0, 1.0),
    8: Body(9.8, 24.0, 165.0, 1.2),
    12: Body(13.9, 23.5, 215.0, 1.4),
    20: Body(21.7, 26.0, 280.0, 1.7),
    40: Body(42.0, 26.2, 385.0, 2.3),
    80: Body(83.0, 25.5, 620.0, 3.4),
}

Law = Callable[[Any, Any, Any], Any]


def yeoh(first: float, second: float, third: float = 0.0) -> Law:
    """Energy of a volume [Pa] from the first invariant, to its third power."""

    def energy(a: Any, b: Any, c: Any) -> Any:
        more = a**2 + b**2 + c**2 - 3.0
        return first * more + second * more**2 + third * more**3

    return energy


def ogden(*terms: tuple[float, float]) -> Law:
    """Energy of a volume [Pa] from powers of the stretches: pairs of modulus and exponent."""

    def energy(a: Any, b: Any, c: Any) -> Any:
        return sum(mu / power * (a**power + b**power + c**power - 3.0) for mu, power in terms)

    return energy


def fung(stiff: float, round_share: float, long_share: float) -> Law:
    """Exponential energy [Pa] of the strains along and around, after Fung's tubes."""

    def energy(a: Any, b: Any, c: Any) -> Any:
        along, around = 0.5 * (a**2 - 1.0), 0.5 * (b**2 - 1.0)
        return 0.5 * stiff * (np.exp(round_share * around**2 + long_share * along**2) - 1.0)

    return energy


def wall_pull(body: Body, length: Any, law: Law, *, thick: bool = False) -> Any:
    """Tension [N] of the wall that follows the braid: the slope of its energy over the length.

    Thin: the stretches at the braid. Thick: Gauss points over the wall, which keeps its volume.
    """
    step = 1e-30j
    stretch = (np.asarray(length, float) + 0j) / body.rest + step
    sine = np.sqrt(1.0 - (stretch * math.cos(body.tilt)) ** 2)
    hoop = sine / math.sin(body.tilt)
    outer = body.braid * 0.5e-3
    if not thick:
        volume = math.pi * 2.0 * outer * body.wall * 1e-3 * body.rest
        energy = volume * law(stretch, hoop, 1.0 / (stretch * hoop))
        return energy.imag / 1e-30 / body.rest
    inner = outer - body.wall * 1e-3
    points, weights = np.polynomial.legendre.leggauss(6)
    total: Any = 0.0
    for point, weight in zip(points, weights, strict=True):
        radius = 0.5 * (outer + inner) + 0.5 * (outer - inner) * point
        now = np.sqrt((hoop * outer) ** 2 - (outer**2 - radius**2) / stretch)
        around = now / radius
        total = total + weight * radius * law(stretch, around, 1.0 / (stretch * around))
    energy = 2.0 * math.pi * body.rest * 0.5 * (outer - inner) * total
    return energy.imag / 1e-30 / body.rest


# ------------------------------------------------------------------------------------------------ benches
@dataclass(frozen=True)
class Bench:
    """What was set: time [s], pressure [Pa], length [m], its rate [m/s] on the way to each row, run."""

    time: Array
    pressure: Array
    length: Array
    rate: Array
    run: Array

    @property
    def rows(self) -> int:
        return len(self.time)


def tent(phase: Any) -> Any:
    """0 at whole numbers, 1 between, straight lines."""
    return 1.0 - np.abs(2.0 * (phase % 1.0) - 1.0)


def loops(
    body: Body,
    bars: Sequence[float],
    periods: Sequence[float],
    *,
    low: float = 0.005,
    high: Sequence[float] = (0.16,),
    cycles: int = 2,
    rows: int = 60,
    pause: float = 8.0,
) -> Bench:
    """Length triangles at held pressures; each run starts at rest after it was last stretched.

    ``high`` holds the largest contraction of one cycle after the other, over and over.
    """
    parts, clock, run = [], 0.0, 0
    for bar in bars:
        for period in periods:
            run += 1
            t = np.arange(1, cycles * rows + 1) * (period / rows)
            turn = np.minimum((np.arange(1, cycles * rows + 1) - 1e-9) // rows, cycles - 1).astype(int)
            top = np.array([high[k % len(high)] for k in turn])
            share = low + (top - low) * tent(t / period)
            falling = (t / period - 1e-9) % 1.0 < 0.5
            rate = np.where(falling, -1.0, 1.0) * (top - low) * 2.0 / period * body.rest
            length = body.rest * (1.0 - share)
            parts.append((clock + t, np.full(len(t), bar * BAR), length, rate, np.full(len(t), run)))
            clock += t[-1] + pause
    return Bench(*(np.concatenate(column).astype(float) for column in zip(*parts, strict=True)))


def ramps(
    body: Body,
    shares: Sequence[float],
    periods: Sequence[float],
    *,
    bars: tuple[float, float] = (0.5, 6.0),
    cycles: int = 2,
    rows: int = 50,
    pause: float = 6.0,
) -> Bench:
    """Pressure triangles at held lengths."""
    parts, clock, run = [], 0.0, 0
    for share in shares:
        for period in periods:
            run += 1
            t = np.arange(1, cycles * rows + 1) * (period / rows)
            pressure = BAR * (bars[0] + (bars[1] - bars[0]) * tent(t / period))
            still = np.zeros(len(t))
            length = np.full(len(t), body.rest * (1.0 - share))
            parts.append((clock + t, pressure, length, still, np.full(len(t), run)))
            clock += t[-1] + pause
    return Bench(*(np.concatenate(column).astype(float) for column in zip(*parts, strict=True)))


def scattered(rng: np.random.Generator, body: Body, rows: int, *, most: float = 0.17) -> Bench:
    """Readings at rest, in random order: pressures of a hand valve, lengths of a spindle."""
    pressure = rng.uniform(1.2, 6.2, rows) * BAR
    share = rng.uniform(0.0, most, rows)
    order = np.arange(rows, dtype=float)
    return Bench(order, pressure, body.rest * (1.0 - share), np.zeros(rows), np.ones(rows))


def lattice(body: Body, bars: Sequence[float], shares: Sequence[float]) -> Bench:
    """Readings at rest on a full grid, pressure by pressure."""
    pressure, share = (a.ravel() for a in np.meshgrid(np.array(bars) * BAR, np.array(shares), indexing="ij"))
    rows = len(pressure)
    return Bench(
        np.arange(rows, dtype=float), pressure, body.rest * (1.0 - share), np.zeros(rows), np.ones(rows)
    )


def stairs(body: Body, bars: Sequence[float], steps: Sequence[float], *, hold: float, every: float) -> Bench:
    """Length steps of a second, each held, at held pressures."""
    parts, clock = [], 0.0
    for run, bar in enumerate(bars, 1):
        begin, share, pieces = clock, steps[0], []
        for goal in steps[1:]:
            t = np.concatenate([np.linspace(0.1, 1.0, 10), 1.0 + np.arange(every, hold + 1e-9, every)])
            moving = t <= 1.0
            now = share + (goal - share) * np.minimum(t, 1.0)
            rate = np.where(moving, -(goal - share) * body.rest, 0.0)
            pieces.append((begin + t, body.rest * (1.0 - now), rate))
            begin, share = begin + t[-1], goal
        t, length, rate = (np.concatenate(column) for column in zip(*pieces, strict=True))
        parts.append((t, np.full(len(t), bar * BAR), length, rate, np.full(len(t), run)))
        clock = begin + 120.0
    return Bench(*(np.concatenate(column).astype(float) for column in zip(*parts, strict=True)))


def lengths_at(pull: Callable[[Array, Array], Array], pressure: Array, force: Array, body: Body) -> Array:
    """The length [m] at which a pull that grows with the length equals a force, by halving."""
    low, high = np.full(len(pressure), 0.6 * body.rest), np.full(len(pressure), 1.1 * body.rest)
    for _ in range(60):
        middle = 0.5 * (low + high)
        short = pull(pressure, middle) < force
        low, high = np.where(short, middle, low), np.where(short, high, middle)
    return 0.5 * (low + high)


def held_loads(
    body: Body,
    loads: Sequence[float],
    pull: Callable[[Array, Array], Array],
    *,
    bars: tuple[float, float] = (2.0, 6.0),
    friction: float = 0.0,
    rows: int = 50,
    cycles: int = 2,
    period: float = 60.0,
) -> tuple[Bench, Array]:
    """Pressure triangles under dead loads, slowly: the bench with its true lengths, and the load [N].

    With dry friction the muscle follows where it is dragged: the play between both balances.
    """
    parts, clock = [], 0.0
    for run, load in enumerate(loads, 1):
        t = np.arange(1, cycles * rows + 1) * (period / rows)
        pressure = BAR * (bars[0] + (bars[1] - bars[0]) * tent(t / period))
        shortest = lengths_at(pull, pressure, np.full(len(t), load - friction), body)
        longest = lengths_at(pull, pressure, np.full(len(t), load + friction), body)
        length = np.empty(len(t))
        now = longest[0]
        for i in range(len(t)):
            now = min(max(now, shortest[i]), longest[i])
            length[i] = now
        rate = np.gradient(length, t)
        parts.append((clock + t, pressure, length, rate, np.full(len(t), run), np.full(len(t), load)))
        clock += t[-1] + 20.0
    *bench, load_column = (np.concatenate(column).astype(float) for column in zip(*parts, strict=True))
    return Bench(*bench), load_column


# --------------------------------------------------------------------------------------- laws with memory
def lugre(bench: Bench, slide: float, stiff: float, *, stick: float = 1.0, speed: float = 0.004) -> Array:
    """LuGre friction [N]: bristles of a stiffness [N/m] that slip at ``slide`` [N], more when slow."""
    z, out = slide / stiff, np.empty(bench.rows)
    before = bench.length[0]
    for i in range(bench.rows):
        moved = bench.length[i] - before
        before = bench.length[i]
        v = bench.rate[i]
        limit = slide * (1.0 + (stick - 1.0) * math.exp(-((v / speed) ** 2)))
        if moved:
            end = math.copysign(limit / stiff, moved)
            z = end + (z - end) * math.exp(-stiff * abs(moved) / limit)
        out[i] = stiff * z
    return out


def chains(bench: Bench, arms: Sequence[tuple[float, float]]) -> Array:
    """Tension [N] of spring-dashpot arms (stiffness [N/m], time [s]) beside the muscle, at rest before."""
    out = np.zeros(bench.rows)
    steps, moved = np.diff(bench.time, prepend=0.0), np.diff(bench.length, prepend=bench.length[0])
    for stiff, tau in arms:
        stretched = 0.0
        for i in range(bench.rows):
            fade = math.exp(-steps[i] / tau)
            mean = tau / steps[i] * (1.0 - fade) if steps[i] else 1.0
            stretched = stretched * fade + moved[i] * mean
            out[i] += stiff * stretched
    return out


def hereditary(bench: Bench, stiff: float, scale: float, power: float) -> Array:
    """Tension [N] of a wall that relaxes as a power of time, by Boltzmann's sum over all steps."""
    moved = np.diff(bench.length, prepend=bench.length[0])
    middle = bench.time - 0.5 * np.diff(bench.time, prepend=bench.time[0])
    age = bench.time[:, None] - middle[None, :]
    kernel = np.where(age >= 0.0, stiff * (1.0 + np.maximum(age, 0.0) / scale) ** (-power), 0.0)
    return kernel @ moved


def run_in(bench: Bench, body: Body, law: Law, share: float, width: float) -> Array:
    """Tension [N] that an Ogden-Roxburgh wall has lost where it was stretched further before."""

    def energy(length: float) -> float:
        stretch = length / body.rest
        hoop = math.sqrt(1.0 - (stretch * math.cos(body.tilt)) ** 2) / math.sin(body.tilt)
        return float(law(stretch, hoop, 1.0 / (stretch * hoop)))

    whole = wall_pull(body, bench.length, law)
    most, lost = 0.0, np.empty(bench.rows)
    top = energy(body.rest * 0.82)
    for i in range(bench.rows):
        now = energy(bench.length[i])
        most = max(most, now)
        lost[i] = share * math.erf((most - now) / (width * top))
    return -whole * lost


def lagged(bench: Bench, signal: Array, tau: float) -> Array:
    """A first-order amplifier, settled at the beginning of each run."""
    out = np.empty_like(signal)
    for run in np.unique(bench.run):
        rows = np.flatnonzero(bench.run == run)
        state = signal[rows[0]]
        out[rows[0]] = state
        for before, i in pairwise(rows):
            step = bench.time[i] - bench.time[before]
            slope = (signal[i] - signal[before]) / step
            rest = state - signal[before] + slope * tau
            state = signal[i] - slope * tau + rest * math.exp(-step / tau)
            out[i] = state
    return out


def later(bench: Bench, signal: Array, delay: float) -> Array:
    """A signal that is recorded late, run by run."""
    out = np.empty_like(signal)
    for run in np.unique(bench.run):
        rows = bench.run == run
        out[rows] = np.interp(bench.time[rows] - delay, bench.time[rows], signal[rows])
    return out


# ------------------------------------------------------------------------------------------------ noise
def white(rng: np.random.Generator, rows: int) -> Array:
    return rng.standard_normal(rows)


def dependent(rng: np.random.Generator, rows: int, memory: float) -> Array:
    """First-order noise of unit variance."""
    out, fresh = np.empty(rows), rng.standard_normal(rows) * math.sqrt(1.0 - memory**2)
    state = rng.standard_normal()
    for i in range(rows):
        state = memory * state + fresh[i]
        out[i] = state
    return out


def swinging(rng: np.random.Generator, rows: int, period: float, memory: float) -> Array:
    """Second-order noise of unit variance that swings with a period of so many rows, out of step."""
    first, second = 2.0 * memory * math.cos(2.0 * math.pi / period), -(memory**2)
    out = np.zeros(rows + 400)
    fresh = rng.standard_normal(rows + 400)
    for i in range(2, rows + 400):
        out[i] = first * out[i - 1] + second * out[i - 2] + fresh[i]
    kept = out[400:]
    return kept / (math.sqrt((1.0 - second) / ((1.0 + second) * ((1.0 - second) ** 2 - first**2))))


def heavy(rng: np.random.Generator, rows: int) -> Array:
    """Student's t with three degrees of freedom, of unit variance."""
    return rng.standard_t(3, rows) / math.sqrt(3.0)


# ------------------------------------------------------------------------------------------------ files
@dataclass(frozen=True)
class Habit:
    """How a laboratory writes: separator, decimal sign, heads with factors by channel."""

    between: str
    comma: bool
    heads: Mapping[str, tuple[str, float]]


HABITS = {
    "plain": Habit(",", False, {
        "time": ("time_s", 1.0), "pressure": ("pressure_bar", 1e-5), "length": ("length_mm", 1e3),
        "stroke": ("displacement_mm", 1e3), "force": ("force_N", 1.0), "load": ("load_N", 1.0),
        "command": ("command", 1.0), "run": ("run", 1.0), "temperature": ("temperature_degC", 1.0),
    }),
    "bracket": Habit("\t", False, {
        "time": ("t [s]", 1.0), "pressure": ("p [kPa]", 1e-3), "length": ("L [mm]", 1e3),
        "stroke": ("stroke [mm]", 1e3), "force": ("F [N]", 1.0), "load": ("load [N]", 1.0),
        "command": ("valve", 1.0), "run": ("cycle", 1.0), "temperature": ("temperature [degC]", 1.0),
    }),
    "german": Habit(";", True, {
        "time": ("Zeit [ms]", 1e3), "pressure": ("Druck [mbar]", 1e-2), "length": ("Länge [mm]", 1e3),
        "stroke": ("Hub [mm]", 1e3), "force": ("Kraft [N]", 1.0), "load": ("Last [N]", 1.0),
        "command": ("Ventil", 1.0), "run": ("Versuch", 1.0), "temperature": ("Temperatur [°C]", 1.0),
    }),
    "french": Habit(";", True, {
        "time": ("Temps (s)", 1.0), "pressure": ("Pression (MPa)", 1e-6), "length": ("Longueur (mm)", 1e3),
        "stroke": ("Course (mm)", 1e3), "force": ("Force (kN)", 1e-3), "load": ("Charge (N)", 1.0),
        "command": ("Commande", 1.0), "run": ("Cycle", 1.0), "temperature": ("Température (°C)", 1.0),
    }),
    "american": Habit(",", False, {
        "time": ("Time (s)", 1.0), "pressure": ("Pressure (psi)", 1.0 / PSI),
        "length": ("Length (in)", 1.0 / INCH),
        "stroke": ("Stroke (in)", 1.0 / INCH), "force": ("Force (lbf)", 1.0 / POUND),
        "load": ("Load (lbf)", 1.0 / POUND), "command": ("Command", 1.0), "run": ("Run", 1.0),
        "temperature": ("Temperature (degC)", 1.0),
    }),
}  # fmt: skip


def table(columns: Mapping[str, Array], habit: str = "plain", heads: Mapping[str, str] | None = None) -> str:
    """The text of a file; ``heads`` replaces heads by channel, whose values stay in the unit of the habit."""
    style = HABITS[habit]
    names = [(heads or {}).get(channel, style.heads[channel][0]) for channel in columns]
    lines = [style.between.join(names)]
    made = []
    for channel, values in columns.items():
        factor = style.heads[channel][1]
        digits = "{:.8g}" if channel == "time" else "{:.7g}"
        made.append([digits.format(round(float(value) * factor, 9)) for value in values])
    lines += [style.between.join(row) for row in zip(*made, strict=True)]
    text = "\n".join(lines) + "\n"
    return "\n".join([lines[0], text.split("\n", 1)[1].replace(".", ",")]) if style.comma else text


def force_file(
    bench: Bench, force: Array, body: Body, habit: str = "plain", *, stroke: bool = False, timed: bool = True
) -> str:
    """Force over pressure and length."""
    columns: dict[str, Array] = {"time": bench.time} if timed else {}
    columns["pressure"] = bench.pressure
    columns["stroke" if stroke else "length"] = body.rest - bench.length if stroke else bench.length
    columns["force"] = force
    if timed:
        columns["run"] = bench.run
    return table(columns, habit)


# ------------------------------------------------------------------------------------------------ transients
@dataclass(frozen=True)
class Plant:
    """A hanging load on a muscle behind a valve, with all that may be wrong with it.

    Attributes:
        conductance, ratio: of the valve, both ways [l/(s bar)].
        supply: gauge [bar]; start: gauge pressure at the beginning [bar].
        mass, damping: of the load and the muscle [kg], [N s/m].
        exponent: of the gas; None for the energy balance with ``heat`` [W/(m2 K)].
        dead: volume beside the muscle [m3].
        spool: natural frequency [rad/s] and damping of the spool; None for an instant one.
        tube: conductance [l/(s bar)] and ratio between valve and muscle; None for none.
        leak: conductance from the muscle to the room [l/(s bar)].
        feed: tank before the valve [m3] and the conductance of its feed [l/(s bar)]; None for a stiff supply.
        venting: conductance of the exhaust over that stated.
        added: mass that hangs with the load and is not stated [kg].
        drag: damping that the start model does not have [N s/m].
        rub: dry friction of the muscle [N].
        detent: force [N], stroke [m] and width [m] of a magnet beside the way.
    """

    body: Body
    conductance: float
    supply: float
    start: float
    mass: float
    damping: float
    ratio: float = 0.3
    exponent: float | None = 1.0
    heat: float = 0.0
    dead: float = 0.0
    spool: tuple[float, float] | None = None
    tube: tuple[float, float] | None = None
    leak: float = 0.0
    feed: tuple[float, float] | None = None
    venting: float = 1.0
    added: float = 0.0
    drag: float = 0.0
    rub: float = 0.0
    detent: tuple[float, float, float] | None = None

    @property
    def effects(self) -> Effects:
        """Of the start model: the damping that the user knows."""
        return {"viscous_damping": {"coefficient": f"{self.damping:g} N*s/m"}} if self.damping else {}

    def stated(self, **changed: Any) -> dict[str, Any]:
        """The drive as its user writes it; ``changed`` are parts."""
        drive: dict[str, Any] = {
            "valve": {
                "sonic_conductance": f"{self.conductance:g} l/(s*bar)",
                "critical_pressure_ratio": self.ratio,
            },
            "supply": {"pressure": f"{self.supply:g} bar"},
            "load": {"mass": f"{self.mass:g} kg", "arrangement": "hanging"},
            "gas": {"polytropic_exponent": 1.0 if self.exponent is None else self.exponent},
            "stops": {"min_contraction": -0.05, "max_contraction": 0.33},
            "start_pressure": f"{self.start:g} bar",
        }
        return {**drive, **changed}


def flow(conductance: float, ratio: float, up: float, down: float) -> float:
    """Mass flow [kg/s] through an orifice after ISO 6358, from absolute pressures, at room temperature."""
    if up < down:
        return -flow(conductance, ratio, down, up)
    share = down / up
    if share <= ratio:
        psi = 1.0
    elif share < 0.999:
        psi = math.sqrt(1.0 - ((share - ratio) / (1.0 - ratio)) ** 2)
    else:
        psi = math.sqrt(1.0 - ((0.999 - ratio) / (1.0 - ratio)) ** 2) * (1.0 - share) / 0.001
    return conductance * LITRE * NORMAL_DENSITY * up * psi


def in_series(
    conductance: float, ratio: float, tube: tuple[float, float] | None, up: float, down: float
) -> float:
    """Mass flow through an orifice and, behind it, a tube: the pressure between them by halving."""
    if tube is None or conductance <= 0.0:
        return flow(conductance, ratio, up, down)
    if up < down:
        return -in_series(conductance, ratio, tube, down, up)
    low, high = down, up
    for _ in range(28):
        middle = 0.5 * (low + high)
        if flow(conductance, ratio, up, middle) > flow(*tube, middle, down):
            low = middle
        else:
            high = middle
    return flow(conductance, ratio, up, 0.5 * (low + high))


def course(plant: Plant, command: Array, step: float, inner: int = 10) -> dict[str, Array]:
    """Time, true gauge pressure and stroke of a plant, its command held between rows; Runge-Kutta."""
    body = plant.body
    load = plant.mass + plant.added
    weight = load * GRAVITY
    start = plant.start * BAR
    length = lengths_at(lambda p, q: body.pull(p, q), np.array([start]), np.array([weight]), body)[0]
    if plant.detent is not None:  # begins far from the magnet
        assert body.rest - length < plant.detent[1] - 2.5 * plant.detent[2]
    begin = start + AMBIENT
    room = body.room(length) + plant.dead
    store = begin if plant.exponent is not None else begin * room / 0.4
    supply = plant.supply * BAR + AMBIENT
    state = [body.rest - length, 0.0, store, begin * room / (GAS * ROOM), 0.0, 0.0, supply]

    def rates(y: list[float], u: float) -> list[float]:
        stroke, speed, stored, mass, spool, spooling, source = y
        now = body.rest - stroke
        volume = body.room(now) + plant.dead
        slope = body.pull(1.0, now)  # -dV/dL: dV/dt = slope * speed
        pressure = stored if plant.exponent is not None else 0.4 * stored / volume
        opening = u if plant.spool is None else min(max(spool, -1.0), 1.0)
        before = source if plant.feed is not None else supply
        filling = in_series(plant.conductance * max(opening, 0.0), plant.ratio, plant.tube, before, pressure)
        out = plant.conductance * plant.venting * max(-opening, 0.0)
        venting = -in_series(out, plant.ratio, plant.tube, AMBIENT, pressure) if out else 0.0
        lost = flow(plant.leak, 0.4, pressure, AMBIENT) if plant.leak else 0.0
        if plant.exponent is not None:
            net = filling - venting - lost
            change = plant.exponent / volume * (GAS * ROOM * net - pressure * slope * speed)
            gathered = net
        else:
            warm = pressure * volume / (GAS * mass)
            hot = math.sqrt(ROOM / warm)
            venting, lost = venting * hot, lost * hot
            gathered = filling - venting - lost
            wide = math.sqrt(max(4.0 / math.pi * body.room(now) / now, 0.0))
            surface = math.pi * wide * now + 0.5 * math.pi * wide**2
            change = (
                3.5 * GAS * (filling * ROOM - (venting + lost) * warm)
                - pressure * slope * speed
                + plant.heat * surface * (ROOM - warm)
            )
        tension = body.pull(pressure - AMBIENT, now) - (plant.damping + plant.drag) * speed
        tension -= plant.rub * math.tanh(speed / 2e-4)
        if plant.detent is not None:
            pull, where, width = plant.detent
            tension -= pull * math.exp(-(((stroke - where) / width) ** 2))
        acceleration = max(tension, 0.0) / load - GRAVITY
        moved, hurried = 0.0, 0.0
        if plant.spool is not None:
            natural, damped = plant.spool
            moved, hurried = spooling, natural**2 * (u - spool) - 2.0 * damped * natural * spooling
        refill = 0.0
        if plant.feed is not None:
            tank, feed = plant.feed
            refill = GAS * ROOM / tank * (flow(feed, 0.3, supply, source) - filling)
        return [speed, acceleration, change, gathered, moved, hurried, refill]

    out = np.empty((len(command), 2))
    h = step / inner
    for i, u in enumerate(command):
        gauge = (
            state[2]
            if plant.exponent is not None
            else 0.4 * state[2] / (body.room(body.rest - state[0]) + plant.dead)
        )
        out[i] = gauge - AMBIENT, state[0]
        for _ in range(inner):
            a = rates(state, u)
            b = rates([s + 0.5 * h * r for s, r in zip(state, a, strict=True)], u)
            c = rates([s + 0.5 * h * r for s, r in zip(state, b, strict=True)], u)
            d = rates([s + h * r for s, r in zip(state, c, strict=True)], u)
            state = [
                s + h / 6.0 * (p + 2.0 * q + 2.0 * r + w)
                for s, p, q, r, w in zip(state, a, b, c, d, strict=True)
            ]
    time = np.asarray(np.arange(len(command)) * step, float)
    return {"time": time, "pressure": out[:, 0], "stroke": out[:, 1]}


def switched(step: float, *phases: tuple[float, float]) -> Array:
    """A command by phases: duration [s] and opening."""
    return np.concatenate([np.full(round(duration / step), opening) for duration, opening in phases])


STEP = 0.004  # s
USUAL = switched(
    STEP, (0.1, 0.0), (0.25, 1.0), (0.45, 0.0), (0.2, -1.0), (0.4, 0.0), (0.3, 1.0), (0.4, 0.0), (0.25, -1.0),
    (0.35, 0.0),
)  # fmt: skip
OTHER = switched(
    STEP, (0.1, 0.0), (0.12, 1.0), (0.25, 0.0), (0.15, 1.0), (0.3, 0.0), (0.3, -1.0), (0.3, 0.0), (0.4, 1.0),
    (0.4, 0.0), (0.15, -1.0), (0.3, 0.0),
)  # fmt: skip


def waving(seconds: float, low: float, high: float) -> Array:
    """A proportional command that sweeps its frequency [Hz], with a mean of zero."""
    t = np.arange(round(seconds / STEP)) * STEP
    phase = 2.0 * np.pi * (low * t + 0.5 * (high - low) * t**2 / seconds)
    return np.where(t < 0.1, 0.0, 0.9 * np.sin(phase))


def plant_of(size: int) -> Plant:
    """A usual rig: a load that hangs at rest about 18 % up, a valve that fills in some tenths of a second."""
    if size == 12:
        return Plant(BODIES[12], 0.036, 6.0, 2.6, 14.0, 75.0)
    if size == 20:
        return Plant(BODIES[20], 0.12, 6.0, 2.5, 30.0, 240.0)
    return Plant(BODIES[40], 0.75, 6.5, 2.4, 110.0, 900.0)


SPREAD = {12: (0.012 * BAR, 4e-5), 20: (0.015 * BAR, 6e-5), 40: (0.015 * BAR, 9e-5)}
"""Noise of pressure [Pa] and stroke [m] by size."""


def recorded(
    rng: np.random.Generator,
    plant: Plant,
    size: int,
    command: Array = USUAL,
    habit: str = "plain",
    noise: Callable[[np.random.Generator, int], Array] = white,
    grain: tuple[float, float] | None = None,
) -> str:
    """The file of a run: command, pressure and stroke over time."""
    run = course(plant, command, STEP)
    sigma = SPREAD[size]
    pressure = run["pressure"] + sigma[0] * noise(rng, len(command))
    stroke = run["stroke"] + sigma[1] * noise(rng, len(command))
    if grain is not None:
        pressure = np.round(pressure / grain[0]) * grain[0]
        stroke = np.round(stroke / grain[1]) * grain[1]
    return table({"time": run["time"], "command": command, "pressure": pressure, "stroke": stroke}, habit)


def moved_by(plant: Plant, size: int, without: Plant, command: Array = USUAL) -> float:
    """How far hidden effects move the channels, over their noise (the larger root mean square)."""
    here, there = course(plant, command, STEP), course(without, command, STEP)
    pressure, stroke = SPREAD[size]
    return max(
        float(np.sqrt(np.mean((here["pressure"] - there["pressure"]) ** 2))) / pressure,
        float(np.sqrt(np.mean((here["stroke"] - there["stroke"]) ** 2))) / stroke,
    )


# ------------------------------------------------------------------------------------------------ the cases
Make = Callable[[np.random.Generator, str], Stranger]

NAMED = (
    "every hidden effect is named, or stands in a group of what cannot be told apart with a named one, and "
    "no other effect is named"
)
NOTHING = "adequate: no effect, no unknown effect, no entry asked"
UNDECIDED = "adequate or undecided: no effect, no unknown effect, no entry asked"
STRUCTURE = "unknown_effect or undecided, with the place, period or term of the rest told; no effect is named"
ENTRY = "the wrong entry is the first of `context` and asked (or asked, or rightly corrected, on reading)"
SEALED: dict[str, Make] = {}


def case(name: str) -> Callable[[Make], Make]:
    """Registers a case under its name."""

    def registered(make: Make) -> Make:
        SEALED[name] = make
        return make

    return registered


def rms(values: Array) -> float:
    return float(np.sqrt(np.mean(values**2)))


def strangers(seed: int, only: str = "") -> list[Stranger]:
    """The cases of a seed whose name holds a text, each from numbers of its own."""
    return [
        make(np.random.default_rng([seed, zlib.crc32(name.encode())]), name)
        for name, make in SEALED.items()
        if only in name
    ]


def statics(
    rng: np.random.Generator,
    name: str,
    body: Body,
    bench: Bench,
    extra: Array | float,
    hidden: tuple[frozenset[str], ...],
    truth: str,
    *,
    base: Array | None = None,
    sigma: float = 0.006,
    noise: Callable[[np.random.Generator, int], Array] = white,
    effects: Effects | None = None,
    habit: str = "plain",
    stroke: bool = False,
    timed: bool = True,
    kind: str = "",
    rule: str = "names",
    owed: str = NAMED,
    spread: float | None = None,
    **more: Any,
) -> Stranger:
    """A case of force over pressure and length: the ideal pull (or ``base``), ``extra``, and noise.

    ``sigma`` is the noise as a share of the force at rest length and 6 bar, ``spread`` the same in N.
    """
    level = sigma * body.blocked(6e5) if spread is None else spread
    force = (body.pull(bench.pressure, bench.length) if base is None else base) + extra
    assert float(force.min()) > 0.0, f"{name}: the muscle is slack"
    read = force + level * noise(rng, bench.rows)
    strength = rms(force - body.pull(bench.pressure, bench.length)) / level
    strength = strength if hidden or rule == "unknown" else math.nan
    text = force_file(bench, read, body, habit, stroke=stroke, timed=timed)
    ask = Ask(text, body.stated, effects or {}, {"rest_length": f"{body.length:g} mm"})
    if strength < 3.5 and hidden:
        truth += " (near the noise)"
    return Stranger(
        name, rule, owed, truth, (ask,), hidden, noise={"force": level}, strength=strength,
        check=(kind, bench.rows), **more,
    )  # fmt: skip


# ---------------------------------------------------------------------- singles, statics
@case("single/Yeoh wall, thick/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (2.5, 4.0, 5.5), (30.0,))
    extra = wall_pull(body, bench.length, yeoh(0.19e6, 0.006e6, 0.0008e6), thick=True)
    return statics(
        rng, name, body, bench, extra, (WALL,), "wall of Yeoh rubber, integrated over its thickness",
        kind="isobaric",
    )  # fmt: skip


@case("single/Ogden wall/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = scattered(rng, body, 70)
    extra = wall_pull(body, bench.length, ogden((0.30e6, 1.6), (0.012e6, 4.0)))
    return statics(
        rng, name, body, bench, extra, (WALL,), "wall of Ogden rubber with two terms, readings at rest",
        timed=False, habit="german", kind="static",
    )  # fmt: skip


@case("single/Fung wall/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = ramps(body, (0.0, 0.03, 0.06, 0.09, 0.12, 0.15), (40.0,), bars=(2.5, 6.0), cycles=1)
    extra = wall_pull(body, bench.length, fung(0.5e6, 0.9, 1.4))
    return statics(
        rng, name, body, bench, extra, (ANY_WALL,),
        "exponential wall, between the hyperelastic and the linear law of the catalogue", kind="isometric",
    )  # fmt: skip


@case("single/Coulomb/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = loops(body, (2.0, 3.5, 5.0), (24.0, 6.0), rows=50)
    extra = 0.045 * body.blocked(6e5) * np.sign(bench.rate)
    return statics(
        rng, name, body, bench, extra, (COULOMB,), "dry friction of one size at two speeds", habit="french",
        kind="isobaric",
    )  # fmt: skip


@case("single/Coulomb near the noise/8")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[8]
    bench = loops(body, (2.0, 4.0, 6.0), (20.0, 5.0), rows=50)
    extra = 2.4 * 0.006 * body.blocked(6e5) * np.sign(bench.rate)
    return statics(
        rng, name, body, bench, extra, (COULOMB,), "dry friction of 2.4 x the noise at two speeds",
        kind="isobaric", stroke=True,
    )  # fmt: skip


@case("single/friction with pressure/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = loops(body, (1.5, 3.0, 4.5, 6.0), (40.0, 10.0), cycles=2, rows=40)
    extra = 0.09 * body.blocked(1.0) * bench.pressure * np.sign(bench.rate)
    return statics(
        rng, name, body, bench, extra, (PRESSED_FRICTION,),
        "dry friction in proportion to the pressure, the same at both speeds", kind="isobaric",
    )  # fmt: skip


@case("single/LuGre/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (2.5, 4.5), (30.0,), high=(0.16, 0.10, 0.05), cycles=6, rows=50)
    slide = 0.07 * body.blocked(6e5)
    extra = lugre(bench, slide, slide / 0.004, stick=1.08)
    return statics(
        rng, name, body, bench, extra, (PRESLIDING,),
        "LuGre bristles of 4 mm, 8 % more friction when slow, nested loops of 45 to 13 mm", kind="isobaric",
    )  # fmt: skip


@case("single/viscous, exponent 0.6/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (3.0, 5.0), (20.0, 5.0, 1.25), rows=50)
    fastest = float(np.abs(bench.rate).max())
    size = 0.13 * body.blocked(6e5)
    extra = size * np.sign(bench.rate) * (np.abs(bench.rate) / fastest) ** 0.6
    return statics(
        rng, name, body, bench, extra, (frozenset({"viscous_damping"}),),
        "damping with the power 0.6 of the speed, three speeds, 1 to 16", kind="isobaric",
    )  # fmt: skip


@case("single/power-law relaxation/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = stairs(body, (3.0, 5.0), (0.01, 0.05, 0.09, 0.13, 0.09, 0.05, 0.01), hold=60.0, every=2.0)
    extra = hereditary(bench, 0.35 * body.blocked(6e5) / (0.1 * body.rest), 0.4, 0.45)
    return statics(
        rng, name, body, bench, extra, (frozenset({"creep"}),),
        "stress relaxation with the power -0.45 of time after length steps, held 60 s; the part that has not "
        "relaxed in the test is elastic, so an elastic wall beside it is not surplus",
        kind="isobaric", tolerated=ANY_WALL,
    )  # fmt: skip


@case("single/Prony chains/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = loops(body, (3.0, 5.0), (60.0, 12.0, 2.4), rows=50, pause=60.0)
    unit = body.blocked(6e5) / (0.16 * body.rest)
    extra = chains(bench, ((0.14 * unit, 0.7), (0.11 * unit, 5.0), (0.08 * unit, 35.0)))
    return statics(
        rng, name, body, bench, extra, (frozenset({"creep"}),),
        "three relaxing arms, 0.7, 5 and 35 s, loops at three speeds 1 to 25", kind="isobaric",
    )  # fmt: skip


@case("single/Mullins/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    law = yeoh(0.4e6, 0.0)
    bench = loops(body, (3.0, 4.5), (30.0,), high=(0.06, 0.06, 0.11, 0.11, 0.16, 0.16), cycles=6, rows=40)
    base = body.pull(bench.pressure, bench.length) + wall_pull(body, bench.length, law)
    extra = run_in(bench, body, law, 0.45, 0.25)
    return statics(
        rng, name, body, bench, extra, (frozenset({"mullins"}),),
        "Ogden-Roxburgh softening of a wall that the start model has (0.4 MPa); first cycles are stiffer",
        base=base, effects={"bladder_elasticity": {"shear_modulus": "0.4 MPa"}}, kind="isobaric",
    )  # fmt: skip


@case("single/ineffective ends/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = scattered(rng, body, 60)
    active = body.rest - 2.0 * 0.013
    stretched = body.rest * (1.0 - (body.rest - bench.length) / active)
    extra = body.pull(bench.pressure, stretched) - body.pull(bench.pressure, bench.length)
    return statics(
        rng, name, body, bench, extra, (ENDS,), "13 mm at each end do not contract, readings at rest",
        timed=False, kind="static", habit="american",
    )  # fmt: skip


@case("single/effectiveness/8")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[8]
    bench = scattered(rng, body, 45)
    extra = -0.14 * body.pull(bench.pressure, bench.length)
    return statics(
        rng, name, body, bench, extra, (GAIN,), "86 % of the ideal force; a braid diameter is its twin",
        timed=False, kind="static", entries=frozenset({"braid_diameter"}),
    )  # fmt: skip


@case("single/rig compliance/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = ramps(body, (0.01, 0.06, 0.11, 0.16), (30.0,), rows=60)
    stiff = body.blocked(6e5) / 0.010
    force = body.pull(bench.pressure, bench.length)
    for _ in range(60):
        force = body.pull(bench.pressure, bench.length - force / stiff)
    extra = force - body.pull(bench.pressure, bench.length)
    return statics(
        rng, name, body, bench, extra, (frozenset({"rig_compliance"}),),
        "the frame gives 10 mm at the largest force; the length is read at the frame", kind="isometric",
        habit="german",
    )  # fmt: skip


@case("single/thread stretch/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = ramps(body, (0.0, 0.05, 0.10, 0.15, 0.20), (30.0,), rows=50)
    thread = np.full(bench.rows, body.thread)
    for _ in range(60):  # tension of all threads over their stiffness
        all_threads = (
            2.0 * bench.pressure * body.round * (thread / body.thread) ** 2 * (bench.length / thread)
        )
        thread = body.thread * (1.0 + all_threads / 38e3)
    extra = body.pull(bench.pressure, bench.length, thread) - body.pull(bench.pressure, bench.length)
    return statics(
        rng, name, body, bench, extra, (frozenset({"thread_extensibility"}),),
        "nylon threads of EA 38 kN together", kind="isometric",
    )  # fmt: skip


@case("single/pressure dead zone/5")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[5]
    bench = ramps(body, (0.0, 0.06, 0.12), (25.0,), bars=(0.0, 6.0), rows=60)
    level = 0.006 * body.blocked(6e5)
    force = body.pull(np.maximum(bench.pressure - 0.42 * BAR, 0.0), bench.length)
    text = force_file(bench, force + level * white(rng, bench.rows), body, "french")
    strength = rms(force - body.pull(bench.pressure, bench.length)) / level
    return Stranger(
        name, "names", NAMED, "nothing happens below 0.42 bar; rows below it hold noise only",
        (Ask(text, body.stated, {}, {"rest_length": f"{body.length:g} mm"}),), (DEAD_ZONE,),
        noise={"force": level}, strength=strength, check=("isometric", bench.rows),
    )  # fmt: skip


@case("single/force zero/80")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[80]
    bench = loops(body, (2.0, 4.0, 6.0), (60.0,), rows=50)
    return statics(
        rng, name, body, bench, -0.06 * body.blocked(6e5), (ZERO,), "the cell reads 6 % of 6 bar too little",
        kind="isobaric", habit="french",
    )  # fmt: skip


@case("single/length zero/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (1.5, 3.5, 5.5), (30.0,), rows=50, high=(0.2,))
    extra = body.pull(bench.pressure, bench.length + 0.006) - body.pull(bench.pressure, bench.length)
    return statics(
        rng, name, body, bench, extra, (frozenset({"length_offset"}),),
        "the true length is 6 mm more than read, loops to 20 %", kind="isobaric",
    )  # fmt: skip


@case("single/force lag/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (3.0, 5.0), (2.0, 1.0), rows=100)
    ideal = body.pull(bench.pressure, bench.length)
    return statics(
        rng, name, body, bench, lagged(bench, ideal, 0.07) - ideal, (frozenset({"sensor_lag"}),),
        "an amplifier of 70 ms on the force, triangles of 2 and 1 s", kind="isobaric",
    )  # fmt: skip


@case("single/time skew/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = loops(body, (2.5, 5.0), (4.0, 1.6), rows=80)
    ideal = body.pull(bench.pressure, bench.length)
    return statics(
        rng, name, body, bench, later(bench, ideal, 0.12) - ideal, (frozenset({"time_skew"}),),
        "the force is recorded 120 ms late, rows every 50 and 20 ms", kind="isobaric", habit="german",
    )  # fmt: skip


@case("single/pressure zero, isotonic/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench, load = held_loads(body, (200.0, 320.0, 440.0), body.pull, bars=(2.0, 5.0))
    level = 0.0003
    length = lengths_at(body.pull, bench.pressure - 0.12 * BAR, load, body)
    text = table({
        "time": bench.time, "pressure": bench.pressure,
        "length": length + level * white(rng, bench.rows), "load": load, "run": bench.run,
    })  # fmt: skip
    return Stranger(
        name, "names", NAMED, "the gauge reads 0.12 bar too much, three dead loads",
        (Ask(text, body.stated, {}, {"rest_length": f"{body.length:g} mm"}),), (DEAD_ZONE,),
        noise={"length": level}, strength=rms(length - bench.length) / level, check=("isotonic", bench.rows),
    )  # fmt: skip


@case("single/Coulomb, isotonic/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    loads = (900.0, 1300.0, 1700.0)
    bench, load = held_loads(body, loads, body.pull, bars=(2.0, 5.0), friction=150.0)
    smooth = lengths_at(body.pull, bench.pressure, load, body)
    level = 0.00045
    text = table({
        "time": bench.time, "pressure": bench.pressure,
        "length": bench.length + level * white(rng, bench.rows), "load": load, "run": bench.run,
    }, "german")  # fmt: skip
    return Stranger(
        name, "names", NAMED,
        "dry friction of 150 N under three dead loads: the play between both balances (rate-free; a "
        "friction that is smooth at the turn has the same as its limit)",
        (Ask(text, body.stated, {}, {"rest_length": f"{body.length:g} mm"}),), (COULOMB | PRESLIDING,),
        noise={"length": level}, strength=rms(bench.length - smooth) / level, check=("isotonic", bench.rows),
    )  # fmt: skip


# ---------------------------------------------------------------------- transients
def transient(
    rng: np.random.Generator,
    name: str,
    size: int,
    hidden: tuple[frozenset[str], ...],
    truth: str,
    *,
    command: Array = USUAL,
    habit: str = "plain",
    plant: Plant | None = None,
    noise: Callable[[np.random.Generator, int], Array] = white,
    grain: tuple[float, float] | None = None,
    rule: str = "names",
    owed: str = NAMED,
    drive: Mapping[str, Any] | None = None,
    second: Array | None = None,
    statuses: frozenset[str] = frozenset(),
    entries: frozenset[str] = frozenset(),
    twin: bool = False,
    **changed: Any,
) -> Stranger:
    """A case of a run: the usual rig of a size, ``changed`` in what nobody knows."""
    known = plant or plant_of(size)
    real = replace(known, **changed)
    stated = known.stated(**{"tube": None, **(drive or {})})
    if stated["tube"] == "unstated":
        del stated["tube"]
    told = {"rest_length": f"{known.body.length:g} mm"}
    ask = Ask(
        recorded(rng, real, size, command, habit, noise, grain),
        known.body.stated,
        known.effects,
        told,
        stated,
    )
    after = None
    if second is not None:
        text = recorded(rng, real, size, second, habit, noise, grain)
        after = Ask(text, known.body.stated, known.effects, told, stated)
    sigma = SPREAD[size]
    strength = moved_by(real, size, known, command) if changed else math.nan
    if changed and strength < 3.5:
        truth += " (near the noise)"
    return Stranger(
        name, rule, owed, truth, (ask,), hidden, statuses=statuses, entries=entries, twin=twin, second=after,
        noise={"pressure": sigma[0], "displacement": sigma[1]}, strength=strength,
        check=("transient", len(command)),
    )  # fmt: skip


@case("single/dead volume/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 20, (frozenset({"dead_volume"}),), "45 cm3 of fittings beside the muscle", dead=45e-6
    )


@case("single/spool dynamics/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 20, (frozenset({"spool_lag"}),),
        "a spool of 7 Hz, damped 0.75, under a sweep of 0.3 to 6 Hz",
        command=waving(3.6, 0.3, 6.0), spool=(44.0, 0.75), habit="german",
    )  # fmt: skip


@case("single/tube resistance/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 40, (ONE_FLOW,), "a narrow tube of 0.95 l/(s bar) in series, which nobody states",
        tube=(0.95, 0.2), drive={"tube": "unstated"},
    )  # fmt: skip


@case("single/leak/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 12, (frozenset({"leak"}),), "a leak of 2.5e-4 l/(s bar)", leak=2.5e-4, habit="french"
    )


@case("single/supply droop/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 40, (frozenset({"supply_droop"}),),
        "a tank of 3 l, filled through an orifice of 0.5 l/(s bar), before the valve", feed=(3e-3, 0.5),
    )  # fmt: skip


@case("single/exhaust restriction/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(rng, name, 20, (EXHAUST,), "the exhaust passes 68 %", venting=0.68)


@case("single/viscous damping/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 40, (frozenset({"viscous_damping"}),), "damping of 1500 N s/m; the start model has none",
        plant=replace(plant_of(40), damping=0.0), drag=1500.0,
    )  # fmt: skip


@case("single/hanging mass/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng,
        name,
        20,
        (HANGING,),
        "a hook of 1.2 kg hangs with the load of 30 kg",
        added=1.2,
        habit="american",
    )


# ---------------------------------------------------------------------- pairs and triples
@case("several/Ogden wall, Coulomb/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (2.5, 4.0, 5.5), (30.0, 7.5), rows=50)
    extra = wall_pull(body, bench.length, ogden((0.4e6, 1.7)))
    extra = extra + 0.04 * body.blocked(6e5) * np.sign(bench.rate)
    return statics(
        rng, name, body, bench, extra, (WALL, COULOMB), "wall of Ogden rubber, power 1.7; dry friction",
        kind="isobaric",
    )  # fmt: skip


@case("several/Yeoh wall, friction with pressure/80")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[80]
    bench = loops(body, (2.0, 3.5, 5.0), (60.0, 15.0), rows=50)
    extra = wall_pull(body, bench.length, yeoh(0.3e6, 0.008e6))
    extra = extra + 0.07 * body.blocked(1.0) * bench.pressure * np.sign(bench.rate)
    return statics(
        rng, name, body, bench, extra, (WALL, PRESSED_FRICTION),
        "wall of Yeoh rubber; friction with pressure",
        kind="isobaric", habit="german",
    )  # fmt: skip


@case("several/wall, rig compliance/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = ramps(body, (0.01, 0.04, 0.07, 0.10, 0.13, 0.16), (30.0,), bars=(2.0, 6.0), rows=40)
    law, stiff = yeoh(0.25e6, 0.004e6), body.blocked(6e5) / 0.008
    force = body.pull(bench.pressure, bench.length)
    for _ in range(80):
        true = bench.length - force / stiff
        force = 0.5 * (force + body.pull(bench.pressure, true) + wall_pull(body, true, law))
    return statics(
        rng, name, body, bench, 0.0, (WALL, frozenset({"rig_compliance"})),
        "wall of Yeoh rubber in a frame that gives 8 mm at the largest force", base=force, kind="isometric",
    )  # fmt: skip


@case("several/effectiveness, force zero/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = scattered(rng, body, 80)
    extra = -0.11 * body.pull(bench.pressure, bench.length) + 0.05 * body.blocked(6e5)
    return statics(
        rng, name, body, bench, extra, (GAIN, ZERO),
        "89 % of the ideal force, and a cell that reads too much",
        timed=False, kind="static", habit="bracket",
    )  # fmt: skip


@case("several/wall, Prony chains/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (3.0, 4.5, 6.0), (48.0, 8.0, 1.6), rows=40, pause=60.0)
    unit = body.blocked(6e5) / (0.16 * body.rest)
    extra = wall_pull(body, bench.length, yeoh(0.28e6, 0.0))
    extra = extra + chains(bench, ((0.06 * unit, 0.5), (0.05 * unit, 4.0), (0.04 * unit, 28.0)))
    return statics(
        rng, name, body, bench, extra, (WALL, frozenset({"creep"})),
        "a plain rubber wall and three relaxing arms", kind="isobaric",
    )  # fmt: skip


@case("several/Coulomb, viscous/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = loops(body, (2.5, 5.0), (24.0, 6.0, 1.5), rows=50)
    full = body.blocked(6e5)
    extra = 0.03 * full * np.sign(bench.rate) + 0.09 * full * bench.rate / float(np.abs(bench.rate).max())
    return statics(
        rng, name, body, bench, extra, (COULOMB, frozenset({"viscous_damping"})),
        "dry friction and damping, three speeds 1 to 16", kind="isobaric", habit="american",
    )  # fmt: skip


@case("several/ends, wall, Coulomb/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (2.5, 3.5, 4.5, 5.5), (30.0, 7.5), rows=40)
    active = body.rest - 2.0 * 0.014
    moved = body.rest * (1.0 - (body.rest - bench.length) / active)
    base = body.pull(bench.pressure, moved) + wall_pull(body, bench.length, yeoh(0.3e6, 0.005e6))
    extra = 0.04 * body.blocked(6e5) * np.sign(bench.rate)
    return statics(
        rng, name, body, bench, extra, (ENDS, WALL, COULOMB),
        "14 mm at each end do not contract; a rubber wall; dry friction", base=base, kind="isobaric",
    )  # fmt: skip


@case("several/LuGre, wall, force zero/5")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[5]
    bench = loops(body, (3.0, 4.5, 6.0), (20.0,), high=(0.15, 0.09, 0.04), cycles=6, rows=40)
    full = body.blocked(6e5)
    extra = wall_pull(body, bench.length, yeoh(0.16e6, 0.003e6)) + 0.05 * full
    extra = extra + lugre(bench, 0.05 * full, 0.05 * full / 0.0016)
    return statics(
        rng, name, body, bench, extra, (PRESLIDING, WALL, ZERO),
        "bristles of 1.6 mm; a rubber wall; a cell that reads too much", kind="isobaric", sigma=0.005,
        habit="german",
    )  # fmt: skip


@case("several/dead volume, spool/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 20, (frozenset({"dead_volume"}), frozenset({"spool_lag"})),
        "40 cm3 of fittings and a spool of 6 Hz under a sweep", command=waving(4.0, 0.3, 6.0), dead=40e-6,
        spool=(38.0, 0.8),
    )  # fmt: skip


@case("several/exhaust, viscous/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 40, (EXHAUST, frozenset({"viscous_damping"})),
        "the exhaust passes 70 %; damping of 1300 N s/m that the start model does not have",
        plant=replace(plant_of(40), damping=0.0), venting=0.70, drag=1300.0, habit="german",
    )  # fmt: skip


@case("several/hanging mass, leak/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 12, (HANGING, frozenset({"leak"})), "a hook of 0.5 kg on 14 kg; a leak of 1e-3 l/(s bar)",
        added=0.5, leak=1e-3,
    )  # fmt: skip


@case("several/dead volume, spool, exhaust/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 20, (frozenset({"dead_volume"}), frozenset({"spool_lag"}), EXHAUST),
        "35 cm3 of fittings, a spool of 6 Hz, an exhaust that passes 72 %", command=waving(4.0, 0.3, 5.0),
        dead=35e-6, spool=(38.0, 0.8), venting=0.72,
    )  # fmt: skip


# ---------------------------------------------------------------------- nothing hidden
def null(
    rng: np.random.Generator,
    name: str,
    body: Body,
    bench: Bench,
    truth: str,
    *,
    decided: bool = True,
    **more: Any,
) -> Stranger:
    """Nothing but noise."""
    return statics(
        rng, name, body, bench, 0.0, (), f"nothing hidden; {truth}", rule="nothing",
        owed=NOTHING if decided else UNDECIDED, statuses=DECIDED if decided else OPEN, **more,
    )  # fmt: skip


@case("null/white/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    bench = loops(BODIES[20], (2.0, 4.0, 6.0), (30.0,))
    return null(rng, name, BODIES[20], bench, "white noise", kind="isobaric", habit="german")


@case("null/AR 0.9/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    bench = loops(BODIES[12], (2.0, 4.0, 6.0), (20.0, 5.0), rows=80)
    return null(
        rng, name, BODIES[12], bench, "noise that remembers 10 rows; loops of 80", kind="isobaric",
        noise=lambda g, n: dependent(g, n, 0.9),
    )  # fmt: skip


@case("null/AR 0.95/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    bench = ramps(BODIES[40], (0.0, 0.05, 0.10, 0.15), (40.0,), rows=100)
    return null(
        rng, name, BODIES[40], bench, "noise that remembers 20 rows; ramps of 50", decided=False,
        kind="isometric", noise=lambda g, n: dependent(g, n, 0.95),
    )  # fmt: skip


@case("null/AR 0.98/80")
def _(rng: np.random.Generator, name: str) -> Stranger:
    bench = loops(BODIES[80], (2.5, 5.0), (60.0,), rows=120)
    return null(
        rng, name, BODIES[80], bench, "noise that remembers 50 rows; four loops of 120", decided=False,
        kind="isobaric", noise=lambda g, n: dependent(g, n, 0.98),
    )  # fmt: skip


@case("null/swinging AR(2)/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    bench = loops(BODIES[20], (2.0, 4.0, 6.0), (24.0,), rows=80)
    return null(
        rng, name, BODIES[20], bench, "noise that swings with 17 rows and forgets its phase in 30",
        decided=False, kind="isobaric", noise=lambda g, n: swinging(g, n, 17.3, 0.965),
    )  # fmt: skip


@case("null/mains hum/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = loops(body, (2.5, 5.0), (2.013,), cycles=2, rows=800)
    level = 0.005 * body.blocked(6e5)
    phase = rng.uniform(0.0, 6.28)
    hum = 1.5 * level * np.sin(2.0 * np.pi * 50.0 * bench.time + phase)
    return statics(
        rng, name, body, bench, hum, (),
        "nothing hidden; hum of 50 Hz, 1.5 x the white noise, 397 rows a second",
        rule="nothing", owed=f"{NOTHING}; or the hum is told as a repetition of 20 ms", statuses=DECIDED,
        period=0.02, spread=level, kind="isobaric",
    )  # fmt: skip


@case("null/coarse digits/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = scattered(rng, body, 60)
    grain = 0.015 * body.blocked(6e5)
    force = body.pull(bench.pressure, bench.length) + 0.004 * body.blocked(6e5) * white(rng, bench.rows)
    force = np.round(force / grain) * grain
    made = null(
        rng, name, body, bench, "a display whose last digit is 1.5 % of the largest force", base=force,
        timed=False, kind="static", spread=1e-9,
    )  # fmt: skip
    return replace(made, noise={"force": math.hypot(0.004 * body.blocked(6e5), grain / math.sqrt(12.0))})


@case("null/noise grows/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = loops(body, (1.5, 3.0, 4.5, 6.0), (30.0,), rows=50)
    ideal = body.pull(bench.pressure, bench.length)
    return null(
        rng, name, body, bench, "noise of 1.2 % of the force of each row", kind="isobaric",
        noise=lambda g, n: g.standard_normal(n) * 2.0 * ideal / float(ideal.max()), habit="french",
    )  # fmt: skip


@case("null/heavy tails/8")
def _(rng: np.random.Generator, name: str) -> Stranger:
    bench = loops(BODIES[8], (2.0, 4.0, 6.0), (20.0, 5.0), rows=50)
    return null(
        rng,
        name,
        BODIES[8],
        bench,
        "noise of Student's t with 3 degrees of freedom",
        kind="isobaric",
        noise=heavy,
    )


@case("null/slow drift of a day/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = scattered(rng, body, 90)
    drift = 0.005 * body.blocked(6e5) * np.sin(np.linspace(0.3, 4.2, bench.rows))
    return null(
        rng, name, body, bench,
        "a zero that drifts by half the noise over the day, readings in random order, no clock "
        "(a drift of the force zero is the truth, if it is told)",
        decided=False, base=body.pull(bench.pressure, bench.length) + drift, timed=False, kind="static",
        tolerated=frozenset({"force_drift", "force_thermal"}),
    )  # fmt: skip


@case("null/isotonic white/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench, load = held_loads(body, (110.0, 170.0, 230.0), body.pull, bars=(2.0, 5.0))
    level = 0.0003
    text = table({
        "time": bench.time, "pressure": bench.pressure,
        "stroke": body.rest - bench.length + level * white(rng, bench.rows), "load": load, "run": bench.run,
    }, "french")  # fmt: skip
    return Stranger(
        name, "nothing", NOTHING, "nothing hidden; white noise of 0.3 mm under three dead loads",
        (Ask(text, body.stated, {}, {"rest_length": f"{body.length:g} mm"}),), statuses=DECIDED,
        noise={"length": level}, check=("isotonic", bench.rows),
    )  # fmt: skip


@case("null/transient white/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 20, (), "nothing hidden; white noise", rule="nothing", owed=NOTHING, statuses=DECIDED
    )


@case("null/transient AR 0.9/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 40, (), "nothing hidden; noise that remembers 10 rows", rule="nothing", owed=UNDECIDED,
        statuses=OPEN, noise=lambda g, n: dependent(g, n, 0.9), habit="german",
    )  # fmt: skip


@case("null/transient coarse digits/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 12, (), "nothing hidden; white noise, steps of 20 mbar and 0.1 mm", rule="nothing",
        owed=NOTHING, statuses=DECIDED, grain=(0.02 * BAR, 1e-4),
    )  # fmt: skip


# ---------------------------------------------------------------------- in no catalogue
def unknown(
    rng: np.random.Generator, name: str, body: Body, bench: Bench, extra: Array, truth: str, **more: Any
) -> Stranger:
    """Something that no catalogue has."""
    return statics(
        rng, name, body, bench, extra, (), f"in no catalogue: {truth}", rule="unknown", owed=STRUCTURE, **more
    )


@case("unknown/bump over contraction/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (2.0, 4.0, 6.0), (30.0,), rows=80)
    share = 1.0 - bench.length / body.rest
    extra = 0.1 * body.blocked(6e5) * np.exp(-(((share - 0.085) / 0.014) ** 2))
    return unknown(rng, name, body, bench, extra, "a bump of 10 % at 8.5 % contraction", kind="isobaric")


@case("unknown/kink in pressure/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = ramps(body, (0.0, 0.05, 0.10, 0.15), (30.0,), rows=60)
    over = np.maximum(bench.pressure - 3.6 * BAR, 0.0)
    extra = -0.45 * body.pull(over, bench.length)
    return unknown(
        rng,
        name,
        body,
        bench,
        extra,
        "above 3.6 bar each bar adds 55 % only",
        kind="isometric",
        habit="german",
    )


@case("unknown/saturation in pressure/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = loops(body, (0.8, 1.6, 2.4, 3.2, 4.0, 4.8, 5.6, 6.4), (30.0,), rows=40, cycles=1)
    share = bench.pressure / (4.2 * BAR)
    extra = body.pull(bench.pressure * ((1.0 + share**6) ** (-1.0 / 6.0) - 1.0), bench.length)
    return unknown(
        rng, name, body, bench, extra, "the force saturates at 4.2 bar (a sixth-power blend)", kind="isobaric"
    )


@case("unknown/resonance of the frame/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (2.5, 5.0), (4.0,), cycles=3, rows=160)
    since = bench.time - np.array([bench.time[bench.run == r][0] for r in bench.run]) + 4.0 / 160.0
    after = (since - 1e-9) % 2.0
    extra = 0.14 * body.blocked(6e5) * np.exp(-after / 0.5) * np.cos(2.0 * np.pi * 4.7 * after)
    return unknown(
        rng, name, body, bench, extra, "the frame rings with 4.7 Hz after each turn", kind="isobaric"
    )


@case("unknown/sticky place of a guide/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = loops(body, (2.0, 4.0, 6.0), (40.0, 10.0), rows=60)
    share = 1.0 - bench.length / body.rest
    place = np.exp(-(((share - 0.11) / 0.016) ** 4))
    extra = 0.1 * body.blocked(6e5) * place * np.sign(bench.rate)
    return unknown(
        rng, name, body, bench, extra,
        "a guide that rubs between 9.5 and 12.5 % contraction only (dry friction beside an unknown rest is "
        "no wrong name)",
        tolerated=COULOMB | PRESSED_FRICTION | frozenset({"guide_friction"}), kind="isobaric",
    )  # fmt: skip


@case("unknown/periodic scale of length/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (2.5, 4.0, 5.5), (40.0,), rows=120)
    error = 0.0032 * np.sin(2.0 * np.pi * bench.length / 0.015 + rng.uniform(0.0, 6.28))
    extra = body.pull(bench.pressure, bench.length + error) - body.pull(bench.pressure, bench.length)
    return unknown(
        rng, name, body, bench, extra, "the length scale interpolates wrongly, 3.2 mm with a period of 15 mm",
        kind="isobaric", sigma=0.004,
    )  # fmt: skip


@case("unknown/range of the load cell/80")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[80]
    bench = loops(body, (2.0, 3.0, 4.0, 5.0, 6.0), (60.0,), rows=50)
    ideal = body.pull(bench.pressure, bench.length)
    edge = 0.42 * body.blocked(6e5)
    extra = np.where(ideal > edge, 0.075 * body.blocked(6e5), 0.0)
    return unknown(
        rng, name, body, bench, extra, "above 42 % the amplifier changes its range and reads 7.5 % more",
        kind="isobaric",
    )  # fmt: skip


@case("unknown/magnet on the way/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    plant = plant_of(20)
    start = (
        plant.body.rest
        - lengths_at(
            plant.body.pull, np.array([plant.start * BAR]), np.array([plant.mass * GRAVITY]), plant.body
        )[0]
    )
    return transient(
        rng, name, 20, (), "in no catalogue: a magnet holds back, 60 N about a place on the way, 3 mm wide",
        rule="unknown", owed=STRUCTURE, detent=(60.0, float(start) + 0.013, 0.003),
    )  # fmt: skip


# ---------------------------------------------------------------------- held out
HELD = (
    "the model found, saved and loaded, predicts a second file of the rig without fitting: its error is at "
    "most 1.2 x the noise of that file, in each channel"
)


def held_out(
    rng: np.random.Generator,
    name: str,
    body: Body,
    benches: tuple[Bench, Bench],
    force: Callable[[Bench], Array],
    hidden: tuple[frozenset[str], ...],
    truth: str,
    *,
    sigma: float = 0.006,
    habit: str = "plain",
    timed: bool = True,
    kind: str = "",
    more: tuple[Array, Array] | None = None,
) -> Stranger:
    """Two files of one rig; ``more`` is the temperature of each row [degC]."""
    level = sigma * body.blocked(6e5)
    asks = []
    for number, bench in enumerate(benches):
        true = force(bench)
        assert float(true.min()) > 0.0, f"{name}: the muscle is slack"
        read = true + level * white(rng, bench.rows)
        if more is None:
            text = force_file(bench, read, body, habit, timed=timed)
        else:
            text = table({
                "time": bench.time, "pressure": bench.pressure, "length": bench.length, "force": read,
                "temperature": more[number], "run": bench.run,
            }, habit)  # fmt: skip
        asks.append(Ask(text, body.stated, {}, {"rest_length": f"{body.length:g} mm"}))
    first = benches[0]
    strength = rms(force(first) - body.pull(first.pressure, first.length)) / level
    return Stranger(
        name, "second", HELD, truth, (asks[0],), hidden, second=asks[1], noise={"force": level},
        strength=strength, check=(kind, first.rows),
    )  # fmt: skip


@case("held out/droop of a tank/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 20, (frozenset({"supply_droop"}),),
        "a tank of 0.8 l behind an orifice of 0.07 l/(s bar); second: other pulses", rule="second", owed=HELD,
        feed=(0.8e-3, 0.07), second=OTHER,
    )  # fmt: skip


@case("held out/droop of a line/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 40, (frozenset({"supply_droop"}),),
        "0.15 l of line behind an orifice of 1.1 l/(s bar); second: other pulses", rule="second", owed=HELD,
        feed=(0.15e-3, 1.1), second=OTHER, habit="german",
    )  # fmt: skip


@case("held out/heat/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 20, (frozenset({"heat_exchange"}),),
        "gas with a temperature, 60 W/(m2 K) at the wall; an isothermal start model; second: other pulses",
        rule="second", owed=HELD, exponent=None, heat=60.0, second=OTHER,
    )  # fmt: skip


@case("held out/heat/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 12, (frozenset({"heat_exchange"}),),
        "gas with a temperature, 35 W/(m2 K) at the wall; an isothermal start model; second: other pulses",
        rule="second", owed=HELD, exponent=None, heat=35.0, second=OTHER,
    )  # fmt: skip


@case("held out/ends/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    active = body.rest - 2.0 * 0.016

    def force(bench: Bench) -> Array:
        return body.pull(bench.pressure, body.rest * (1.0 - (body.rest - bench.length) / active))

    benches = scattered(rng, body, 70), lattice(body, (1.0, 2.6, 4.3, 5.7), (0.02, 0.06, 0.10, 0.14, 0.165))
    return held_out(
        rng, name, body, benches, force, (ENDS,), "16 mm at each end do not contract; second: a grid",
        timed=False, kind="static", habit="american",
    )  # fmt: skip


@case("held out/ends/80")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[80]
    active = body.rest - 2.0 * 0.042

    def force(bench: Bench) -> Array:
        return body.pull(bench.pressure, body.rest * (1.0 - (body.rest - bench.length) / active))

    benches = loops(body, (2.0, 4.0, 6.0), (60.0,)), loops(body, (1.4, 3.0, 5.0), (30.0,), high=(0.14,))
    return held_out(
        rng, name, body, benches, force, (ENDS,),
        "42 mm at each end do not contract; second: other pressures",
        kind="isobaric",
    )  # fmt: skip


@case("held out/drift of a warm-up/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]

    def force(bench: Bench) -> Array:
        warm = 0.10 * body.blocked(6e5) * (1.0 - np.exp(-bench.time / 140.0))
        return body.pull(bench.pressure, bench.length) + warm

    benches = loops(body, (2.0, 4.0, 6.0, 3.0), (40.0,)), loops(body, (5.0, 2.5, 3.5), (20.0, 40.0))
    return held_out(
        rng, name, body, benches, force, (frozenset({"force_drift"}),),
        "the amplifier warms up in 140 s from the start of each file; second: other pressures and speed",
        kind="isobaric",
    )  # fmt: skip


@case("held out/drift with temperature/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    benches = loops(body, (2.0, 4.0, 6.0), (30.0, 15.0)), loops(body, (5.0, 2.5, 3.5), (20.0,))
    first, second = benches
    warm = (
        20.0 + 6.0 * np.sin(first.time / 60.0),
        23.0 - 5.0 * np.cos(second.time / 45.0),
    )
    slope = 0.012 * body.blocked(6e5)

    def force(bench: Bench) -> Array:
        room = warm[0] if bench is first else warm[1]
        return body.pull(bench.pressure, bench.length) + slope * (room - 20.0)

    return held_out(
        rng, name, body, benches, force, (frozenset({"force_thermal"}),),
        "the zero of the cell moves with the recorded temperature; second: other pressures and temperatures",
        kind="isobaric", more=warm,
    )  # fmt: skip


@case("held out/Yeoh wall/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]

    def force(bench: Bench) -> Array:
        return body.pull(bench.pressure, bench.length) + wall_pull(body, bench.length, yeoh(0.35e6, 0.01e6))

    benches = loops(body, (2.5, 4.0, 5.5), (30.0,)), loops(body, (3.2, 5.0), (15.0,), high=(0.15,))
    return held_out(
        rng, name, body, benches, force, (WALL,),
        "wall of Yeoh rubber; second: other pressures, twice the speed",
        kind="isobaric", habit="german",
    )  # fmt: skip


@case("held out/Ogden wall/8")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[8]
    law = ogden((0.22e6, 1.5), (0.01e6, 3.5))

    def force(bench: Bench) -> Array:
        return body.pull(bench.pressure, bench.length) + wall_pull(body, bench.length, law)

    benches = scattered(rng, body, 80), lattice(body, (2.2, 3.8, 5.4), (0.01, 0.05, 0.09, 0.13, 0.16))
    shifted = replace(benches[0], pressure=benches[0].pressure + 0.8 * BAR)
    return held_out(
        rng, name, body, (shifted, benches[1]), force, (WALL,), "wall of Ogden rubber; second: a grid",
        timed=False, kind="static",
    )  # fmt: skip


# ---------------------------------------------------------------------- wrong entries
def entered(
    made: Stranger,
    entries: frozenset[str],
    *,
    twin: bool = False,
    rule: str = "entry",
    owed: str = ENTRY,
    **ask: Any,
) -> Stranger:
    """A case whose question says something else than the truth; ``ask`` replaces parts of the question."""
    return replace(
        made, rule=rule, owed=owed, entries=entries, twin=twin, asks=(replace(made.asks[0], **ask),)
    )  # fmt: skip


@case("wrong entry/rest length/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (1.5, 3.0, 4.5, 6.0), (30.0,), rows=50)
    made = statics(rng, name, body, bench, 0.0, (), "typed 300 mm instead of 280 mm", kind="isobaric")
    stated = {**body.stated, "nominal_length": "300 mm"}
    return entered(made, frozenset({"rest_length"}), muscle=stated, options={"rest_length": "300 mm"})


@case("wrong entry/rest length beside a wall/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = loops(body, (2.5, 4.0, 5.5), (30.0,), rows=60)
    extra = wall_pull(body, bench.length, yeoh(0.3e6, 0.0))
    made = statics(
        rng, name, body, bench, extra, (WALL,),
        "typed 410 mm instead of 385 mm; a rubber wall is missing too",
        kind="isobaric", habit="german",
    )  # fmt: skip
    stated = {**body.stated, "nominal_length": "410 mm"}
    return entered(made, frozenset({"rest_length"}), muscle=stated, options={"rest_length": "410 mm"})


@case("wrong entry/braid diameter/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = scattered(rng, body, 60)
    made = statics(
        rng, name, body, bench, 0.0, (),
        "typed 23.7 mm instead of 21.7 mm (the exact twin of a factor on the force: listed first is enough)",
        timed=False, kind="static",
    )  # fmt: skip
    stated = {**body.stated, "braid_diameter": "23.7 mm", "inside_diameter": "22 mm"}
    return entered(made, frozenset({"braid_diameter"}), twin=True, muscle=stated)


@case("wrong entry/braid angle/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = ramps(body, (0.0, 0.05, 0.10, 0.15, 0.20), (30.0,), rows=50)
    made = statics(rng, name, body, bench, 0.0, (), "typed 26.5 deg instead of 23.5 deg", kind="isometric")
    return entered(made, frozenset({"braid_angle"}), muscle={**body.stated, "braid_angle": "26.5 deg"})


@case("wrong entry/load mass/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return transient(
        rng, name, 20, (frozenset({"load_scale"}),),
        "typed 24 kg instead of 30 kg (to name the load's scale, and "
        "nothing else, says the same)",
        rule="entry", owed=ENTRY, entries=frozenset({"load", "load_mass", "mass"}),
        drive={"load": {"mass": "24 kg", "arrangement": "hanging"}}, twin=True,
    )  # fmt: skip


@case("wrong entry/absolute pressure/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = ramps(body, (0.0, 0.05, 0.10, 0.15), (30.0,), bars=(1.0, 6.0), rows=50)
    made = statics(
        rng, name, body, bench, 0.0, (),
        "the sensor reads absolute pressure, the head says bar only", kind="isometric",
    )  # fmt: skip
    level = made.noise["force"]
    force = body.pull(bench.pressure, bench.length) + level * white(rng, bench.rows)
    read = replace(bench, pressure=bench.pressure + AMBIENT)
    return entered(made, frozenset({"absolute_pressure"}), file=force_file(read, force, body))


def unnamed(
    rng: np.random.Generator, name: str, body: Body, bench: Bench, channel: str, factor: float, typed: str
) -> tuple[str, dict[str, Any]]:
    """A file with a head without unit, its values ``factor`` times SI, and what its user types for it."""
    level = 0.006 * body.blocked(6e5)
    columns = {
        "time": bench.time,
        "pressure": bench.pressure,
        "stroke": body.rest - bench.length,
        "force": body.pull(bench.pressure, bench.length) + level * white(rng, bench.rows),
        "run": bench.run,
    }
    columns[channel] = columns[channel] * factor / HABITS["plain"].heads[channel][1]
    head = {"pressure": "P", "force": "F", "stroke": "x"}[channel]
    text = table(columns, heads={channel: head})
    named = "displacement" if channel == "stroke" else channel
    options = {"rest_length": f"{body.length:g} mm", "columns": {named: f"{head} [{typed}]"}}
    return text, options


def typed_unit(
    rng: np.random.Generator,
    name: str,
    body: Body,
    channel: str,
    factor: float,
    typed: str,
    right: str,
    words: str,
) -> Stranger:
    """A unit that the user typed wrongly for a head without one."""
    bench = loops(body, (1.5, 3.0, 4.5), (24.0,), rows=50)
    made = statics(rng, name, body, bench, 0.0, (), words, kind="isobaric")
    text, options = unnamed(rng, name, body, bench, channel, factor, typed)
    return entered(made, frozenset({right}), file=text, options=options)


@case("wrong entry/psi typed as bar/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return typed_unit(
        rng,
        name,
        BODIES[12],
        "pressure",
        1.0 / PSI,
        "bar",
        "pressure_in_psi",
        "the head says P, values in psi",
    )


@case("wrong entry/kgf typed as N/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return typed_unit(
        rng, name, BODIES[20], "force", 1.0 / GRAVITY, "N", "force_in_kgf", "the head says F, values in kgf"
    )


@case("wrong entry/lbf typed as N/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return typed_unit(
        rng, name, BODIES[40], "force", 1.0 / POUND, "N", "force_in_lbf", "the head says F, values in lbf"
    )


@case("wrong entry/cm typed as mm/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    return typed_unit(
        rng, name, BODIES[20], "stroke", 100.0, "mm", "stroke_in_cm", "the head says x, values in cm"
    )


# ---------------------------------------------------------------------- right entries, imitated
RIGHT = "the entry that the effect imitates is not asked; the effect is named and no other"


@case("right entry/ends imitate a rest length/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (1.5, 3.0, 4.5, 6.0), (30.0,), rows=50)
    active = body.rest - 2.0 * 0.020
    moved = body.rest * (1.0 - (body.rest - bench.length) / active)
    extra = body.pull(bench.pressure, moved) - body.pull(bench.pressure, bench.length)
    made = statics(
        rng, name, body, bench, extra, (ENDS,), "20 mm at each end do not contract; all entries are right",
        kind="isobaric",
    )  # fmt: skip
    return entered(made, frozenset({"rest_length"}), rule="right entry", owed=RIGHT)


@case("right entry/a gauge zero imitates absolute pressure/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = ramps(body, (0.0, 0.05, 0.10, 0.15), (30.0,), bars=(1.0, 6.0), rows=50)
    extra = -body.pull(0.45 * BAR, bench.length)
    made = statics(
        rng, name, body, bench, extra, (DEAD_ZONE,), "the gauge reads 0.45 bar too much; it is a gauge",
        kind="isometric", habit="german",
    )  # fmt: skip
    return entered(made, frozenset({"absolute_pressure"}), rule="right entry", owed=RIGHT)


@case("right entry/a wall imitates a braid angle/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = loops(body, (2.5, 4.0, 5.5), (30.0,), rows=60)
    extra = wall_pull(body, bench.length, yeoh(0.35e6, 0.0))
    made = statics(
        rng, name, body, bench, extra, (WALL,), "a rubber wall; all entries are right", kind="isobaric"
    )
    return entered(
        made, frozenset({"braid_angle", "braid_diameter", "rest_length"}), rule="right entry", owed=RIGHT
    )


# ---------------------------------------------------------------------- bad rows
ROWS = "these rows and only these are in `suspect_rows`, and the verdict without them is right"


def bad_rows(
    rng: np.random.Generator,
    name: str,
    body: Body,
    bench: Bench,
    spoil: Callable[[Array], Array],
    rows: Sequence[int],
    truth: str,
    *,
    extra: Array | float = 0.0,
    hidden: tuple[frozenset[str], ...] = (),
    habit: str = "plain",
    timed: bool = False,
    kind: str = "static",
) -> Stranger:
    """A file some of whose forces are spoiled; ``rows`` from 1."""
    level = 0.006 * body.blocked(6e5)
    force = body.pull(bench.pressure, bench.length) + extra + level * white(rng, bench.rows)
    text = force_file(bench, spoil(force), body, habit, timed=timed)
    ask = Ask(text, body.stated, {}, {"rest_length": f"{body.length:g} mm"})
    return Stranger(
        name, "rows", ROWS, truth, (ask,), hidden, rows=frozenset(rows), noise={"force": level},
        statuses=frozenset() if hidden else OPEN, check=(kind, bench.rows),
    )  # fmt: skip


@case("bad rows/a digit too many/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    row = int(rng.integers(4, 20))

    def spoil(force: Array) -> Array:
        force[row - 1] *= 10.0
        return force

    return bad_rows(
        rng, name, BODIES[20], scattered(rng, BODIES[20], 24), spoil, (row,),
        f"row {row} is ten times too large",
        habit="german",
    )  # fmt: skip


@case("bad rows/a wrong lever/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    row = int(rng.integers(3, 15))

    def spoil(force: Array) -> Array:
        force[row - 1] *= 0.62
        return force

    bench = lattice(BODIES[12], (2.0, 4.0, 6.0), (0.0, 0.03, 0.06, 0.09, 0.12, 0.15))
    return bad_rows(
        rng, name, BODIES[12], bench, spoil, (row,), f"row {row} was computed with another lever, 62 %"
    )


@case("bad rows/two swapped/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = lattice(body, (1.5, 3.0, 4.5, 6.0), (0.0, 0.02, 0.04, 0.06, 0.08, 0.10, 0.12, 0.14, 0.16, 0.18))
    low, high = int(rng.integers(2, 9)), int(rng.integers(32, 39))

    def spoil(force: Array) -> Array:
        force[[low - 1, high - 1]] = force[[high - 1, low - 1]]
        return force

    return bad_rows(
        rng, name, body, bench, spoil, (low, high), f"the forces of rows {low} and {high} are swapped",
        habit="french",
    )  # fmt: skip


@case("bad rows/a loose plug/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    bench = loops(BODIES[20], (2.0, 4.0, 6.0), (30.0,))
    first = int(rng.integers(140, 170))

    def spoil(force: Array) -> Array:
        force[first - 1 : first + 5] -= 0.22 * BODIES[20].blocked(6e5)
        return force

    return bad_rows(
        rng, name, BODIES[20], bench, spoil, range(first, first + 6),
        f"six rows from {first} on were read with a loose plug", timed=True, kind="isobaric",
    )  # fmt: skip


@case("bad rows/two beside a wall/8")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[8]
    bench = lattice(body, (3.0, 4.5, 6.0), tuple(np.linspace(0.0, 0.16, 12)))
    rows = sorted(int(i) for i in rng.choice(np.arange(3, 35), 2, replace=False))

    def spoil(force: Array) -> Array:
        force[rows[0] - 1] += 0.35 * body.blocked(6e5)
        force[rows[1] - 1] *= 0.1
        return force

    extra = wall_pull(body, bench.length, yeoh(0.22e6, 0.0))
    return bad_rows(
        rng, name, body, bench, spoil, rows, f"rows {rows[0]} and {rows[1]} are typed wrongly; a rubber wall",
        extra=extra, hidden=(WALL,),
    )  # fmt: skip


@case("bad rows/one of fifteen/80")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[80]
    bench = lattice(body, (2.0, 4.0, 6.0), (0.0, 0.04, 0.08, 0.12, 0.16))
    row = int(rng.integers(2, 15))

    def spoil(force: Array) -> Array:
        force[row - 1] += 0.17 * body.blocked(6e5)
        return force

    return bad_rows(rng, name, body, bench, spoil, (row,), f"row {row} of fifteen reads 17 % too much")


# ---------------------------------------------------------------------- start model
START = (
    "from both start models the final effects (those of the start that are not superfluous, and those named) "
    "hold every hidden one and no other"
)
PRESET = {
    "bladder_elasticity": {"shear_modulus": "0.4 MPa"},
    "dahl": {},
    "viscous_damping": {},
}
"""What a maker's preset brings along."""


def two_starts(made: Stranger, effects: Effects) -> Stranger:
    """The same file from the ideal muscle and from the effects of a preset."""
    (ask,) = made.asks
    return replace(made, rule="start", owed=START, asks=(ask, replace(ask, effects=effects)))


@case("start model/wall, Coulomb/20")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[20]
    bench = loops(body, (2.5, 4.0, 5.5), (30.0, 7.5), rows=50)
    extra = wall_pull(body, bench.length, yeoh(0.3e6, 0.004e6)) + 0.04 * body.blocked(6e5) * np.sign(
        bench.rate
    )
    made = statics(
        rng, name, body, bench, extra, (WALL, COULOMB | PRESLIDING),
        "a rubber wall and dry friction (a preset's friction of a short turn has it as its limit)",
        kind="isobaric",
    )  # fmt: skip
    return two_starts(made, PRESET)


@case("start model/LuGre, viscous/12")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[12]
    bench = loops(body, (2.5, 5.0), (24.0, 3.0), high=(0.16, 0.08), cycles=4, rows=40)
    full = body.blocked(6e5)
    extra = lugre(bench, 0.05 * full, 0.05 * full / 0.002)
    extra = extra + 0.09 * full * bench.rate / float(np.abs(bench.rate).max())
    made = statics(
        rng, name, body, bench, extra, (PRESLIDING, frozenset({"viscous_damping"})),
        "bristles of 2 mm and damping; no rubber", kind="isobaric",
    )  # fmt: skip
    return two_starts(made, PRESET)


@case("start model/wall, force zero/40")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[40]
    bench = ramps(body, (0.0, 0.02, 0.05, 0.08, 0.12, 0.16), (30.0,), bars=(2.5, 6.0), rows=50)
    extra = wall_pull(body, bench.length, ogden((0.5e6, 1.8))) - 0.035 * body.blocked(6e5)
    made = statics(
        rng, name, body, bench, extra, (WALL, ZERO), "a rubber wall and a cell that reads too little",
        kind="isometric",
    )  # fmt: skip
    start: Effects = {"bladder_elasticity": {"shear_modulus": "0.4 MPa"}, "effectiveness": {}}
    return two_starts(made, start)


@case("start model/ends/8")
def _(rng: np.random.Generator, name: str) -> Stranger:
    body = BODIES[8]
    bench = scattered(rng, body, 80)
    active = body.rest - 2.0 * 0.010
    moved = body.rest * (1.0 - (body.rest - bench.length) / active)
    extra = body.pull(bench.pressure, moved) - body.pull(bench.pressure, bench.length)
    made = statics(
        rng,
        name,
        body,
        bench,
        extra,
        (ENDS,),
        "10 mm at each end do not contract",
        timed=False,
        kind="static",
    )
    start: Effects = {"bladder_elasticity": {"shear_modulus": "0.4 MPa"}, "prestress": {}}
    return two_starts(made, start)


# ---------------------------------------------------------------------- scaling
SCALE = "the same status, and the same effects (or groups that share one), at both sizes"
SMALL = Body(5.6, 25.0, 90.0, 0.7)


def two_sizes(
    seed: np.random.Generator,
    name: str,
    make: Callable[[np.random.Generator, Body, str], Stranger],
) -> Stranger:
    """The same case at 5 and at 80 mm: lengths sixteenfold, forces 256-fold, times and pressures the same."""
    number = int(seed.integers(2**31))
    small = make(np.random.default_rng(number), SMALL, name)
    large = make(np.random.default_rng(number), SMALL.scaled(16.0), name)
    return replace(small, rule="scale", owed=SCALE, asks=(*small.asks, *large.asks))


@case("scaling/nothing/5 and 80")
def _(rng: np.random.Generator, name: str) -> Stranger:
    def make(g: np.random.Generator, body: Body, name: str) -> Stranger:
        bench = loops(body, (2.0, 4.0, 6.0), (30.0,))
        return statics(g, name, body, bench, 0.0, (), "nothing hidden; white noise", kind="isobaric")

    return two_sizes(rng, name, make)


@case("scaling/wall, Coulomb/5 and 80")
def _(rng: np.random.Generator, name: str) -> Stranger:
    def make(g: np.random.Generator, body: Body, name: str) -> Stranger:
        bench = loops(body, (2.5, 4.0, 5.5), (30.0, 7.5), rows=40)
        extra = wall_pull(body, bench.length, yeoh(0.17e6, 0.003e6))
        extra = extra + 0.05 * body.blocked(6e5) * np.sign(bench.rate)
        return statics(
            g, name, body, bench, extra, (WALL, COULOMB), "a rubber wall and dry friction", kind="isobaric"
        )

    return two_sizes(rng, name, make)


@case("scaling/effectiveness, force zero/5 and 80")
def _(rng: np.random.Generator, name: str) -> Stranger:
    def make(g: np.random.Generator, body: Body, name: str) -> Stranger:
        bench = scattered(g, body, 70)
        extra = -0.1 * body.pull(bench.pressure, bench.length) - 0.03 * body.blocked(6e5)
        return statics(
            g, name, body, bench, extra, (GAIN, ZERO), "90 % of the ideal force; the cell reads too little",
            timed=False, kind="static",
        )  # fmt: skip

    return two_sizes(rng, name, make)


@case("scaling/LuGre, length zero/5 and 80")
def _(rng: np.random.Generator, name: str) -> Stranger:
    def make(g: np.random.Generator, body: Body, name: str) -> Stranger:
        bench = loops(body, (2.0, 3.5, 5.0), (30.0,), high=(0.18, 0.09), cycles=4, rows=40)
        full = body.blocked(6e5)
        true = bench.length + 0.02 * body.rest
        extra = body.pull(bench.pressure, true) - body.pull(bench.pressure, bench.length)
        extra = extra + lugre(bench, 0.06 * full, 0.06 * full / (0.012 * body.rest))
        return statics(
            g, name, body, bench, extra, (PRESLIDING, frozenset({"length_offset"})),
            "bristles of 1.2 % of the length; the true length is 2 % more than read", kind="isobaric",
        )  # fmt: skip

    return two_sizes(rng, name, make)
