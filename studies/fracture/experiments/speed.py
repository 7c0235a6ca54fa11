"""VERIFICATION 19: joints that are there from the start are springs between the elements: how much slower is a wave?"""
from __future__ import annotations

from pathlib import Path

import numpy as np

from studies.common import style
from studies.common.decks import Deck
from studies.common.results import read_table

YOUNG, DENSITY = 30e9, 2500.0
SPEED = (YOUNG / DENSITY) ** 0.5  # m/s: nu = 0
PENALTIES = [5.0, 20.0, 80.0]
EXTRINSIC = "extrinsic"
CELL = 5e-3                       # m; sub-edges are half of it
HEIGHT = 2 * CELL
PULSE = 0.15 / SPEED              # s: sixty sub-edges
NEAR, FAR = 0.1, 0.4              # m, probes
# Joints in series between elements, FORMULATION 7's k = penalty M/l of an edge of length l: a uniform stress opens an edge by
# sigma n_x l/(p M), so that the mean strain grows by S/p of the elastic one, S = sum of l^2 n_x^2 over the edges per area. On
# cells halved by diagonals: 1 from the upright edges, 1 from the diagonals; composites have joints on every second edge alone.
SERIES = {"cst": 2.0, "compt": 1.0}
PUBLISHED = 1.24                  # VERIFICATION 19, of another code


def slowed(penalty: float, factor: float) -> float:
    """c_eff/c."""
    return (1 + factor / penalty) ** -0.5


def deck(element: str, penalty: float | str | None) -> Deck:
    """Intrinsic joints of a penalty; EXTRINSIC: sides that could open; None: nothing that cracks."""
    slowest = slowed(penalty, 2.5) if isinstance(penalty, float) else 1.0
    length = FAR + 0.05
    t_end = FAR / (SPEED * slowest) + 1.1 * PULSE
    # what comes back from the far end stays behind: it absorbs
    result: Deck = {
        "title": f"fracture: wave speed, {element}, penalty {penalty}",
        "mesh": {"generator": "rectangle", "width": length, "height": HEIGHT, "cells": [round(length / CELL), 2]},
        "solid": {"element": element, "plane": "stress"},
        "material": [{"density": DENSITY, "constants": {"E": YOUNG, "nu": 0.0},
                      "strength": {"tensile": 1e12, "cohesion": 1e12, "friction": 0.0, "residual_friction": 0.0, "G_I": 1e14,
                                   "G_II": 1e14}}],
        "load": [{"on": "left", "type": "traction", "value": [1e3, 0.0],
                  "amplitude": {"type": "expression", "expression": f"(t < {PULSE}) ? sin({np.pi / PULSE}*t)^2 : 0"}}],
        "boundary": [{"on": "right", "type": "absorbing"}],
        "integrator": {"type": "central_difference"},
        "run": {"t_end": t_end},
        "output": {"history": PULSE / 400,
                   "probes": [{"name": name, "at": [x, HEIGHT / 2 + CELL / 8]} for name, x in (("near", NEAR), ("far", FAR))]},
    }
    if penalty == EXTRINSIC:
        result["fracture"] = {"method": "extrinsic"}
    elif penalty:
        result["fracture"] = {"method": "intrinsic", "penalty": penalty}
    else:
        del result["material"][0]["strength"]
    return result


def name_of(element: str, penalty: float | str | None) -> str:
    return f"speed-{element}-" + (penalty if isinstance(penalty, str) else f"penalty{penalty:g}" if penalty else "without")


def cases(profile: str) -> dict[str, Deck]:
    return {name_of(element, penalty): deck(element, penalty) for element in SERIES for penalty in [None, EXTRINSIC, *PENALTIES]}


def lag(t: np.ndarray, first: np.ndarray, second: np.ndarray) -> float:
    """By how much the second signal comes later, s: the largest correlation of the two, refined by a parabola."""
    even = np.linspace(t[0], t[-1], 4 * t.size)
    a, b = np.interp(even, t, first), np.interp(even, t, second)
    n = 1 << int(np.ceil(np.log2(2 * even.size)))
    correlation = np.fft.irfft(np.fft.rfft(b, n) * np.conj(np.fft.rfft(a, n)), n)[: even.size]
    i = int(np.argmax(correlation))
    left, middle, right = correlation[i - 1 : i + 2]
    return float((i + 0.5 * (left - right) / (left - 2 * middle + right)) * (even[1] - even[0]))


def measure(runs: Path, profile: str) -> dict:
    found: dict = {}
    for element in SERIES:
        for penalty in [None, EXTRINSIC, *PENALTIES]:
            probes = read_table(runs / name_of(element, penalty) / "probes.csv")
            found.setdefault(element, {})[str(penalty or "without")] = \
                (FAR - NEAR) / lag(probes.t, probes["near.v_x"], probes["far.v_x"])
    ratios = {element: {str(p): speeds[str(p)] / speeds["without"] for p in PENALTIES} for element, speeds in found.items()}
    metrics = {"speed_without_joints_error": max(abs(s["without"] / SPEED - 1) for s in found.values())}
    metrics["extrinsic_speed_error"] = max(abs(s[EXTRINSIC] / s["without"] - 1) for s in found.values())
    for element, by_penalty in ratios.items():
        for p in PENALTIES:
            metrics[f"intrinsic_speed_ratio_{element}_p{p:g}"] = by_penalty[str(p)]
    metrics["intrinsic_speed_series_difference_max"] = max(
        abs(by_penalty[str(p)] / slowed(p, SERIES[element]) - 1) for element, by_penalty in ratios.items() for p in PENALTIES)
    metrics["intrinsic_speed_published_difference_max"] = max(
        abs(by_penalty[str(p)] / slowed(p, PUBLISHED) - 1) for by_penalty in ratios.values() for p in PENALTIES)
    return {"speeds": found, "ratios": ratios, "metrics": metrics}


FIGURES = ["speed.png"]


def draw(measured: dict, figures: Path) -> None:
    figure, panel = style.plt.subplots(figsize=(style.HALF_WIDTH, 2.6))
    p = np.geomspace(PENALTIES[0] / 1.5, PENALTIES[-1] * 1.5, 100)
    for (element, series), colour, marker in zip(SERIES.items(), style.CYCLE, "os"):
        panel.plot(p, [slowed(x, series) for x in p], color=colour, lw=0.9)
        panel.plot(PENALTIES, [measured["ratios"][element][str(x)] for x in PENALTIES], marker, color=colour, ms=4,
                   label=f"{element.upper()}; line: 1 + {series:g}/p")
    panel.plot(p, [slowed(x, PUBLISHED) for x in p], "k--", lw=0.8, label="published: 1 + 1.24/p")
    panel.set(xscale="log", xlabel="penalty p", ylabel="$c$ over $c$ without joints", ylim=(None, 1.005))
    panel.legend(loc="lower right")
    style.save(figure, figures / "speed.png")
