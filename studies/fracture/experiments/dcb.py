"""VERIFICATION 15: a double cantilever beam that is opened, against beams that turn at their roots."""
from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike, NDArray

from studies.common import style
from studies.common.decks import Deck
from studies.common.fields import frame_path, read_frame
from studies.common.results import read_table
from studies.fracture.law import Properties

ARM = 10e-3                # m, height of an arm
YOUNG, POISSON = 30e9, 0.2  # plane stress
DENSITY = 2500.0
CHI = 0.66                 # root rotation, VERIFICATION 15
# Softening over some ten sub-edges: with half of that, quasi-static runs meet limit points (README).
SEAM = {"tensile": 5e6, "cohesion": 15e6, "friction": 0.0, "residual_friction": 0.0, "G_I": 100.0, "G_II": 300.0}
# Arms that do not break: they are bent to 30 MPa.
ARMS = {"tensile": 1e9, "cohesion": 1e9, "friction": 0.0, "residual_friction": 0.0, "G_I": 1e6, "G_II": 1e6}
NOTCH = 4 * ARM
FIRST, AT_REST, LAST = 5.0, 9.0, 20.0  # a/h from which on and up to which load and opening are compared
SLOW = 10e-3               # s per a/h, of runs in slow motion; arms of 20 h swing in 7 ms
PROFILES = 5               # instants at which the opening along the seam is looked at


def load(opening: ArrayLike) -> NDArray[np.float64]:
    """N per m of thickness. Two beams of length A = a + chi h: opening = 8 P A^3/(E h^3), G = 12 P^2 A^2/(E h^3). A taken
    out: the load of a crack that grows does not know chi."""
    opening = np.asarray(opening, dtype=float)
    return (SEAM["G_I"] * YOUNG * ARM**3 / 12) ** 0.75 * (8 / (opening * YOUNG * ARM**3)) ** 0.5


def opening_at(crack: float) -> float:
    """m, of a growing crack of that length, m."""
    beam = crack + CHI * ARM
    return 8 * np.sqrt(SEAM["G_I"] / (12 * YOUNG * ARM**3)) * beam**2


def beam_length(opening: ArrayLike, force: ArrayLike) -> NDArray[np.float64]:
    """A = a + chi h from compliance, m."""
    return np.cbrt(np.asarray(opening) * YOUNG * ARM**3 / (8 * np.asarray(force)))


def deck(element: str, cells: int, penalty: float, last: float, steps: int, dynamic: bool = False,
         method: str = "intrinsic") -> Deck:
    """cells: along the height of an arm; last: crack length over the height of an arm in the end."""
    cell = ARM / cells
    length = cell * np.ceil((last + 5) * ARM / cell)
    end, t_end = opening_at((last + 0.3) * ARM), last * SLOW if dynamic else 1.0
    # the crack grows evenly if the opening grows as a square
    start = 0.4
    amplitude = {"type": "expression", "expression": f"({start} + {1 - start}*t/{t_end})^2 - {start**2}*(1 - t/{t_end})^2"}
    return {
        "title": f"fracture: double cantilever beam, {element}, {method}",
        "mesh": {"generator": "rectangle", "width": float(length), "height": 2 * ARM, "origin": [0.0, -ARM],
                 "cells": [round(length / cell), 2 * cells], "pattern": "alternating",
                 "parts": [{"name": "upper", "of": "left", "from": [0.0, cell / 2], "to": [0.0, ARM]},
                           {"name": "lower", "of": "left", "from": [0.0, -ARM], "to": [0.0, -cell / 2]}],
                 "lines": [{"name": "notch", "from": [0.0, 0.0], "to": [NOTCH, 0.0]},
                           {"name": "seam", "from": [NOTCH, 0.0], "to": [float(length), 0.0]}]},
        "solid": {"element": element, "plane": "stress"},
        "material": [{"density": DENSITY, "constants": {"E": YOUNG, "nu": POISSON}, "strength": ARMS}],
        "fracture": {"method": method, "penalty": penalty},
        "crack": [{"on": "notch"}],
        "interface": [{"on": "seam", "strength": SEAM}],
        "boundary": [{"on": "upper", "type": "displacement", "value": ["free", end / 2], "amplitude": amplitude},
                     {"on": "lower", "type": "displacement", "value": ["free", -end / 2], "amplitude": amplitude},
                     {"on": "bottom_right", "type": "fixed"}],
        "integrator": {"type": "generalized_alpha", "rho_inf": 0.0, "dt": t_end / steps,
                       "interface_tolerance": SLOW_MOTION} if dynamic else
        {"type": "quasi_static", "step": t_end / steps, "longest": t_end / steps, "tolerance": 1e-7},
        "run": {"t_end": t_end},
        "output": {"history": 1e-9 if not dynamic else t_end / steps, "rows": "steps", "fields": t_end / PROFILES},
    }


PENALTY = 100.0
# Vibration of the springs of joints is to be damped, not followed: steps that lose a hundredth of this would be halved by
# default, and there are twenty times as many. What the load is does not depend on it (README).
SLOW_MOTION = 1e-3


def cases(profile: str) -> dict[str, Deck]:
    """At rest up to 9 h: Newton's method does not find its way further (README). In slow motion up to 20 h."""
    found = {"dcb-compt": deck("compt", 3, PENALTY, AT_REST, 60), "dcb-cst": deck("cst", 3, PENALTY, AT_REST, 60)}
    for penalty in (10.0, 1000.0):
        found[f"dcb-compt-penalty{penalty:g}"] = deck("compt", 3, penalty, AT_REST, 60)
    found["dcb-compt-extrinsic"] = deck("compt", 3, PENALTY, AT_REST, 60, method="extrinsic")
    found["dcb-compt-extrinsic-dynamic"] = deck("compt", 3, PENALTY, AT_REST, 200, dynamic=True, method="extrinsic")
    for element in ("compt", "cst") if profile == "full" else ("compt",):
        found[f"dcb-{element}-dynamic"] = deck(element, 4, PENALTY, LAST, 900, dynamic=True) if profile == "full" else \
            deck(element, 3, PENALTY, AT_REST, 200, dynamic=True)
    return found


def crack_tip(folder: Path, t: float, penalty: float, sub_edge: float) -> float:
    """Where along the seam D is 1/2, m; NaN where it is nowhere."""
    frame = read_frame(frame_path(folder, t, 1e-3 * t))
    modulus = YOUNG / (1 - POISSON**2)
    law = Properties(**{key: SEAM[key] for key in ("tensile", "cohesion", "friction", "residual_friction", "G_I", "G_II")},
                     penalty=penalty * modulus / sub_edge)
    half = (1 + 0.5 / float(law.rate(1.0))) * law.opening_at_peak
    place, u = frame.points, frame.point_data["displacement"]
    on_seam = np.abs(place[:, 1]) < 1e-9
    x = np.round(place[on_seam, 0], 9)
    columns = np.unique(x)
    opening = np.array([np.ptp(u[on_seam, 1][x == column]) for column in columns])
    wide = np.nonzero(opening >= half)[0]
    if wide.size == 0 or wide[-1] + 1 == columns.size:
        return float("nan")
    i = int(wide[-1])
    return float(columns[i] + (opening[i] - half) / (opening[i] - opening[i + 1]) * (columns[i + 1] - columns[i]))


def running_mean(crack: NDArray[np.float64], error: NDArray[np.float64]) -> NDArray[np.float64]:
    """Over a way of the crack of one h, some four jumps from node to node, centred; shorter at the ends."""
    return np.array([error[np.abs(crack - at) <= 0.5].mean() for at in crack])


def measure_case(folder: Path, what: Deck, limits: tuple[float, float]) -> dict:
    reactions = read_table(folder / "reactions.csv")
    t_end = what["run"]["t_end"]
    shape = reactions.t / t_end
    start = 0.4
    end = what["boundary"][0]["value"][1] * 2
    opening = end * ((start + (1 - start) * shape) ** 2 - start**2 * (1 - shape) ** 2)
    force = (reactions["upper.R_y"] - reactions["lower.R_y"]) / 2
    there = force > 0
    beam = np.full_like(force, np.nan)
    beam[there] = beam_length(opening[there], force[there])
    crack = beam / ARM - CHI
    compared = there & (crack >= limits[0]) & (crack <= limits[1]) & (reactions.t > 0.1 * t_end)
    error = force[compared] / load(opening[compared]) - 1
    sub_edge = ARM / (what["mesh"]["cells"][1] / 2) / 2
    profiles = []
    for k in range(1, PROFILES + 1):
        t = k * t_end / PROFILES
        tip = crack_tip(folder, t, what["fracture"]["penalty"], sub_edge)
        if not np.isfinite(tip) or not limits[0] <= tip / ARM <= limits[1]:
            continue
        p, a = float(np.interp(t, reactions.t, force)), float(np.interp(t, reactions.t, beam))
        profiles.append({"a_over_h": tip / ARM, "chi": (a - tip) / ARM,
                         "G_error": 12 * p**2 * (tip + CHI * ARM) ** 2 / (YOUNG * ARM**3) / SEAM["G_I"] - 1})
    return {"opening": opening.tolist(), "force": force.tolist(), "crack_over_h": crack.tolist(),
            "load_error_max": float(np.max(np.abs(error))) if error.size else float("nan"),
            "load_error_mean": float(np.mean(error)) if error.size else float("nan"),
            "running_error_max": float(np.max(np.abs(running_mean(crack[compared], error)))) if error.size else float("nan"),
            "reached": float(np.nanmax(crack[compared])) if error.size else float("nan"), "profiles": profiles}


def measure(runs: Path, profile: str) -> dict:
    found = {}
    for name, what in cases(profile).items():
        last = LAST if what["mesh"]["width"] > (AT_REST + 6) * ARM else AT_REST
        found[name] = measure_case(runs / name, what, (FIRST, last))
    at_rest, dynamic = ["dcb-compt", "dcb-cst"], [
        name for name in found if name.endswith("dynamic") and "extrinsic" not in name]
    profiles = [p for name in (*at_rest, *dynamic) for p in found[name]["profiles"]]
    extrinsic = [found[name] for name in ("dcb-compt-extrinsic", "dcb-compt-extrinsic-dynamic")]
    softest, stiffest = found["dcb-compt-penalty10"], found["dcb-compt-penalty1000"]
    return {"cases": found, "metrics": {
        "dcb_load_error": max(found[name]["load_error_max"] for name in at_rest),
        "dcb_load_error_compt": found["dcb-compt"]["load_error_max"],
        "dcb_load_error_cst": found["dcb-cst"]["load_error_max"],
        "dcb_load_error_dynamic": max(found[name]["running_error_max"] for name in dynamic),
        "dcb_load_error_extrinsic": max(f["running_error_max"] for f in extrinsic),
        "dcb_load_error_extrinsic_mean": max(abs(f["load_error_mean"]) for f in extrinsic),
        "dcb_load_error_dynamic_instant": max(found[name]["load_error_max"] for name in dynamic),
        "dcb_crack_reached_over_h": min(found[name]["reached"] for name in dynamic),
        "dcb_load_change_penalty_10_for_1000": softest["load_error_mean"] - stiffest["load_error_mean"],
        "dcb_chi_min": min(p["chi"] for p in profiles), "dcb_chi_max": max(p["chi"] for p in profiles),
        "dcb_energy_release_error_at_tip": max(abs(p["G_error"]) for p in profiles)}}


FIGURES = ["dcb.png"]


def draw(measured: dict, figures: Path) -> None:
    figure, (left, right) = style.plt.subplots(1, 2, figsize=(style.FULL_WIDTH, 2.8))
    labels = {"dcb-compt": "COMPT", "dcb-cst": "CST", "dcb-compt-dynamic": "COMPT, generalized-α",
              "dcb-compt-extrinsic": "COMPT, sides that open", "dcb-compt-penalty10": "COMPT, penalty 10"}
    furthest = max(max(f["opening"]) for f in measured["cases"].values())
    opening = np.geomspace(opening_at(2 * ARM), furthest, 200)
    left.plot(opening * 1e3, load(opening) / 1e3, "k--", lw=0.9, label="beams, G = $G_I$")
    for (name, label), colour in zip(labels.items(), style.CYCLE):
        found = measured["cases"][name]
        o, p, a = (np.array([np.nan if v is None else v for v in found[key]], dtype=float)
                   for key in ("opening", "force", "crack_over_h"))
        left.plot(o * 1e3, p / 1e3, color=colour, label=label)
        shown = (a > 4.5) & (o > 0.05 * o.max())
        right.plot(a[shown], (p[shown] / load(o[shown]) - 1) * 100, color=colour)
    left.set(xlabel="opening [mm]", ylabel="load [kN/m]", ylim=(0, None))
    left.legend()
    right.axhspan(-5, 5, color="0.93", zorder=0)
    right.set(xlabel="a/h, from compliance", ylabel="load over that of beams − 1 [%]", ylim=(-10, 10))
    style.panel_label(left, "a) load against opening")
    style.panel_label(right, "b) difference")
    style.save(figure, figures / "dcb.png")
