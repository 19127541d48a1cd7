"""A run as columns over time, and one phase of it."""

from __future__ import annotations

from dataclasses import dataclass, field, fields

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Impact:
    """An impact on an end stop: instant [s], position of the stop [m], velocity before it [m/s]."""

    time: float
    position: float
    velocity: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Trace:
    """A run as columns, SI; the grid need not be even.

    Attributes:
        time: ascending [s].
        position: stroke, positive = shorter [m]; velocity [m/s] and acceleration [m/s^2] likewise.
        pressure: of the muscle, gauge [Pa].
        force: tension of the muscle [N].
        mass_flow: into the muscle [kg/s], negative = out.
        contact: whether the load touches a stop.
        choked: whether, or on which side, the valve is choked; 0 = not.
        supply_mass_flow: from the supply [kg/s]; default: the flow into the muscle.
        exhaust_mass_flow: to the atmosphere, positive [kg/s]; default: the flow out of the muscle.
        supplied, vented: air taken from the supply and let out since the start [kg]; default: integrals of
            these flows by the trapezoidal rule.
        from_states: whether both are counted from the states because the flows do not conserve mass.
        tube_charge: the part of the air that is in the tube [kg]; default 0.
        impacts: in order of time. At each the trace has two rows, before and after it.
        table: the columns of real numbers as the rows of one array, in the order of `REAL`.

    Raises:
        ValueError: columns of different length, fewer than two rows, time not ascending, nan or inf.
    """

    time: Array
    position: Array
    velocity: Array
    acceleration: Array
    pressure: Array
    force: Array
    mass_flow: Array
    contact: NDArray[np.bool_] = None  # type: ignore  # always an array after construction
    choked: NDArray[np.int_] = None  # type: ignore
    supply_mass_flow: Array = None  # type: ignore
    exhaust_mass_flow: Array = None  # type: ignore
    supplied: Array = None  # type: ignore
    vented: Array = None  # type: ignore
    tube_charge: Array = None  # type: ignore
    impacts: tuple[Impact, ...] = ()
    from_states: bool = False
    table: Array = field(init=False, repr=False)

    def __post_init__(self) -> None:
        flow = np.asarray(self.mass_flow, dtype=np.float64)
        absent = {
            "contact": np.zeros(len(self.time), dtype=bool),
            "choked": np.zeros(len(self.time), dtype=int),
            "supply_mass_flow": np.maximum(flow, 0.0),
            "exhaust_mass_flow": np.maximum(-flow, 0.0),
            "tube_charge": np.zeros(len(self.time)),
        }
        kinds = {"contact": np.bool_, "choked": np.int_}
        for name in _COLUMNS:
            stated = getattr(self, name)
            if stated is None and name in ("supplied", "vented"):
                rate = self.supply_mass_flow if name == "supplied" else self.exhaust_mass_flow
                steps = 0.5 * np.diff(self.time) * (rate[1:] + rate[:-1])
                stated = np.concatenate([[0.0], np.cumsum(steps)])
            column = np.asarray(absent[name] if stated is None else stated)
            column = column.astype(kinds.get(name, np.float64), copy=False)
            if column.shape != (len(self.time),) or not np.isfinite(column).all():
                raise ValueError(f"{name}: {len(self.time)} finite values are needed")
            object.__setattr__(self, name, column)
        if len(self.time) < 2 or not (np.diff(self.time) > 0.0).all():
            raise ValueError("time: two or more ascending values are needed")
        self.__dict__.update(_of_table(np.array([getattr(self, name) for name in REAL])))

    @classmethod
    def sound(
        cls, table: Array, contact: NDArray[np.bool_], choked: NDArray[np.int_], *,
        impacts: tuple[Impact, ...], from_states: bool,
    ) -> Trace:  # fmt: skip
        """The trace of a table that is known to be finite and to ascend, which is not checked again."""
        made = cls.__new__(cls)
        made.__dict__.update(
            _of_table(table), contact=contact, choked=choked, impacts=impacts, from_states=from_states
        )
        return made

    def window(self, start: float, end: float) -> Trace | None:
        """The rows between two instants, with interpolated first and last rows; None when there are none."""
        start, end = max(start, float(self.time[0])), min(end, float(self.time[-1]))
        first, last = np.searchsorted(self.time, start, side="right"), np.searchsorted(self.time, end)
        if not end > start or last <= first:
            return None
        ends = np.array([start, end])
        at = np.searchsorted(self.time, ends, side="right") - 1
        before = np.minimum(at, len(self.time) - 2)
        share = (ends - self.time[before]) / (self.time[before + 1] - self.time[before])
        table = np.empty((len(REAL), last - first + 2))
        table[:, 1:-1] = self.table[:, first:last]
        table[:, [0, -1]] = self.table[:, before] * (1.0 - share) + self.table[:, before + 1] * share
        table[0, [0, -1]] = ends
        rows = np.concatenate([at[:1], np.arange(first, last), at[1:]])
        impacts = tuple(impact for impact in self.impacts if start < impact.time < end)
        return Trace.sound(
            table, self.contact[rows], self.choked[rows], impacts=impacts, from_states=self.from_states
        )


def _of_table(table: Array) -> dict[str, Array]:
    """The attributes that a table gives."""
    return {"table": table, **dict(zip(REAL, table, strict=True))}


#: The fields that are columns, and those of real numbers; time is the first.
_COLUMNS = tuple(each.name for each in fields(Trace) if each.name not in ("impacts", "from_states", "table"))
REAL = tuple(name for name in _COLUMNS if name not in ("contact", "choked"))
