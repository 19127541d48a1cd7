"""Equations of the model: those of every drive, and the effects of this one."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from mckibben.facts.sizing import SIZING
from mckibben.physics.gas import ANR_DENSITY, ANR_TEMPERATURE
from mckibben.report.document import Head, heading, paragraph, table
from mckibben.report.figures import figure, scale_of
from mckibben.report.formula import equation, formula
from mckibben.report.html import Child, Html, html, tag
from mckibben.report.sizing.material import Chosen, SizingMaterial
from mckibben.report.sources import source_text


class _Law(NamedTuple):
    title: str
    equations: Sequence[str]
    words: str


_BASE = (
    _Law(
        "Braid",
        (
            r"b = \frac{L_0}{\cos\theta_0}, \quad n = \frac{L_0\tan\theta_0}{\pi D_0}, \quad "
            r"V = \frac{L\,(b^2 - L^2)}{4\pi n^2}",
        ),
        "Thread length b and turns n from the braid's diameter and angle at rest; volume V at length L.",
    ),
    _Law(
        "Force",
        (r"F = P\,\frac{3L^2 - b^2}{4\pi n^2}, \quad \varepsilon = 1 - \frac{L}{L_0}",),
        "Gauge pressure P, contraction ε; modified by the effects below. A muscle never pushes.",
    ),
    _Law(
        "Stiffness",
        (
            r"k = \frac{\partial F}{\partial L}, \quad "
            r"k_c = \frac{\partial F}{\partial L} - \frac{\partial F}{\partial P}"
            r"\frac{\gamma p\,\partial_L V}{V + \gamma p\,\partial_P V}",
        ),
        "With the valve open (k), and closed (k_c, γ = 1.4, without the volume of the tube). At the load: "
        "times the square of the lever ratio and the number of parallel muscles, plus the spring.",
    ),
    _Law(
        "Flow through valve and tube (ISO 6358)",
        (
            r"\dot m = C\,\rho_0\,p_1\sqrt{T_0/T_1}\;\psi(r), \quad r = p_2/p_1",
            r"\psi = 1\ (r \le b), \quad \psi = \sqrt{1 - \Bigl(\frac{r - b}{1 - b}\Bigr)^2}\ (r > b)",
        ),
        f"Sonic conductance C, critical pressure ratio b, absolute pressures; ρ₀ = {ANR_DENSITY:g} kg/m³ and "
        f"T₀ = {ANR_TEMPERATURE:g} K (ANR).",
    ),
    _Law(
        "Pressure",
        (
            r"\dot p\,(V + \gamma p\,\partial_p V) = (\gamma - 1)(\dot Q + c_p T_0 \dot m_{in} - "
            r"c_p T \dot m_{out}) - \gamma p\,\partial_l V\,\dot l",
            r"T = \frac{p V}{m R}, \quad \dot Q = h\,(\pi D l + \tfrac{\pi}{2} D^2)\,(T_w - T)",
        ),
        "Energy balance of the air, γ = 1.4; length l and diameter D of the muscle, gas mass m, heat "
        "transfer coefficient h, wall at ambient temperature.",
    ),
    _Law(
        "Motion",
        (r"M\ddot s = r^2 F - r\,(m g\sin\alpha + F_{ext}) - k s",),
        "Lever ratio r, inclination α, spring k. The end stops are rigid: an impact takes the speed, and the "
        "load rests there while the force presses it. In a pair, the tension of the second muscle opposes "
        "the first.",
    ),
)  # fmt: skip
_TUBE = _Law(
    "Tube (Eckersten)",
    (r"C = \frac{0.029\,d^2}{\sqrt{l/d^{1.25} + 510}}, \quad b = \frac{474\,C}{d^2}",),
    "Bore d and length l in m, C in m³/(s·Pa); general knowledge, not verified.",
)
_SIZING = (
    _Law(
        SIZING["force_reserve"].label,
        (r"\min_s \frac{N r\,F(P, \varepsilon(s))}{F_{load}(s)} - 1",),
        SIZING["force_reserve"].definition,
    ),
    _Law(
        SIZING["air_volume_anr"].label,
        (r"V_{ANR} = \frac{1}{\rho_0}\int \dot m_{supply}\,dt",),
        SIZING["air_volume_anr"].definition,
    ),
    _Law(
        SIZING["life"].label,
        (
            r"N_{life} = 10^{7 - 2u}, \quad "
            r"u = \max\Bigl(\frac{\varepsilon}{\varepsilon_{max}}, \frac{F}{F_{max}}\Bigr)",
        ),
        SIZING["life"].definition,
    ),
    _Law(
        "Specimens",
        (
            r"F_i(\varepsilon) = F(\varepsilon + \Delta_i), \quad "
            r"\Delta_i \sim \mathcal{N}\Bigl(0, "
            r"\frac{\sigma_F F_0}{\lvert\partial_\varepsilon F(0)\rvert}\Bigr)",
        ),
        "The force curve is shifted along the contraction so that the blocked force F₀ has the relative "
        "standard deviation σ_F; friction and supply pressure are uniformly distributed.",
    ),
)  # fmt: skip


def equations_section(material: SizingMaterial, chosen: Chosen) -> Html:
    """All equations, and each effect with its values in this drive."""
    laws = [*_BASE, *([_TUBE] if chosen.proposal.tube else []), *_SIZING]
    parts: list[Child] = [_law(law) for law in laws]
    parts.append(heading("Effects in the model of this drive"))
    if not chosen.effects:
        parts.append(paragraph("None: the ideal muscle with a thin wall and no losses."))
    parts += [_effect(name, material, chosen) for name in chosen.effects]
    return html(parts)


def _law(law: _Law) -> Html:
    return tag(
        "div",
        heading(law.title),
        [equation(one) for one in law.equations],
        paragraph(law.words, note=True),
        class_="law",
    )


def _effect(name: str, material: SizingMaterial, chosen: Chosen) -> Html:
    effect, values = material.catalogue[name], chosen.effects[name]
    columns = [
        Head("Symbol"),
        Head("Parameter"),
        Head("Value", number=True),
        Head("Source"),
    ]
    rows: list[list[Child]] = [
        [
            formula(parameter.symbol),
            parameter.description,
            figure(value, scale_of(parameter.unit, value, parameter.name), exact=True),
            source_text(source) if (source := chosen.figures.get(f"{name}.{parameter.name}")) else "given",
        ]
        for parameter in effect.parameters
        if (value := values.get(parameter.name)) is not None
    ]
    return tag(
        "div",
        heading(effect.title),
        paragraph(effect.cause),
        equation(effect.equation),
        table(columns, rows, whole=False) if rows else None,
    )
