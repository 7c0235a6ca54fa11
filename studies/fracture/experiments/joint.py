"""VERIFICATION 14: one joint between two elements, pulled, sheared, both, with unloading; and sheared under pressure. A side that opens,
pulled the same way: what is in shear until it opens, `shear_box` has."""
from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from studies.common import style
from studies.common.decks import Deck
from studies.common.results import read_table
from studies.fracture.law import Answer, Properties, along, traction

HALF = 1e-3  # m: the joint runs from (-HALF, 0) to (HALF, 0), in two sub-edges
LENGTH = 2 * HALF
# Elements as good as rigid: the joint's stiffness is PENALTY times theirs. It adds 1e-7 or so to the joint's compliance.
YOUNG, PENALTY = 2e16, 5e-8
LAW = Properties(tensile=3e6, cohesion=8e6, friction=0.6, residual_friction=0.35, G_I=80.0, G_II=240.0,
                 penalty=PENALTY * YOUNG / HALF)
PRESSURE = 5e6  # Pa, of the case with friction
# A side that opens: the stress of the elements, the same everywhere, leads to the envelope.
EXTRINSIC_YOUNG = 3e11
EXTRINSIC_LAW = replace(LAW, extrinsic=True)
LOADING = 0.1   # of the time, until the side has opened for certain
STRONG = 1e3    # strength of the elements' other sides over that of this one
# Turning points along the ray, as parts of its length until nothing holds: unloading twice, once beyond the start.
CYCLE = [0, 0.2, 0.05, 0.5, 0, 0.7, 0.7, 1.05]
SLIDING_CYCLE = [0, 0.2, -0.1, 0.5, 0, 0.7, 0.7, 1.05]
MIXES = {"opening": 0, "mix-30": 30, "mix-45": 45, "mix-60": 60, "sliding": 90}  # angle in the plane of x and y, degrees


def end_of_ray(angle: float, law: Properties = LAW) -> tuple[float, float]:
    """Opening and slip, m, at which nothing holds any more."""
    x, y = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    x = 0.0 if abs(x) < 1e-12 else x
    last = law.last_lambda(x * x)
    return last * x * law.opening_at_peak, last * y * law.slip_at_peak


def extrinsic_points() -> list[tuple[float, float]]:
    """Way of the end, m, against time. The elements are strained until the side opens, to some one and a half times what that takes."""
    o, _ = end_of_ray(0, EXTRINSIC_LAW)
    way = [1.5 * 2 * LENGTH * LAW.tensile / EXTRINSIC_YOUNG, *(part * o for part in CYCLE[1:])]
    return [(0.0, 0.0), *zip(np.linspace(LOADING, 1, len(way)), way)]


def turning_points(case: str) -> list[tuple[float, float]]:
    if case == "friction":
        closed = -PRESSURE / LAW.penalty
        share = LAW.friction * PRESSURE / LAW.penalty
        end = end_of_ray(90)[1] + share
        return [(0, 0), (closed, 0)] + [(closed, part * end) for part in SLIDING_CYCLE[1:]]
    o, s = end_of_ray(MIXES[case])
    return [(part * o, part * s) for part in (SLIDING_CYCLE if case == "sliding" else CYCLE)]


def amplitude(values: list[float]) -> Deck:
    return {"type": "table", "times": list(np.linspace(0, 1, len(values))), "values": values}


def deck(case: str, steps: int) -> Deck:
    points = turning_points(case)
    moved = [{"on": "upper", "type": "displacement", "value": ["free", 1.0], "amplitude": amplitude([o for o, _ in points])},
             {"on": "upper", "type": "displacement", "value": [1.0, "free"], "amplitude": amplitude([s for _, s in points])}]
    half = HALF / 2
    return {
        "title": f"fracture: one joint, {case}",
        # its diagonal, from the first to the third corner, is the joint
        "mesh": {"generator": "quadrilateral", "corners": [[-HALF, 0.0], [0.0, -HALF], [HALF, 0.0], [0.0, HALF]],
                 "cells": [1, 1],
                 "parts": [{"name": "lower", "of": "bottom", "from": [-half, -HALF], "to": [0.0, -half]},
                           {"name": "upper", "of": "top", "from": [0.0, half], "to": [half, HALF]}]},
        "solid": {"element": "compt", "plane": "stress"},
        "material": [{"density": 1000.0, "constants": {"E": YOUNG, "nu": 0.0}, "strength": strength(LAW)}],
        "fracture": {"method": "intrinsic", "penalty": PENALTY},
        "boundary": [{"on": "lower", "type": "fixed"}, *moved],
        "integrator": {"type": "quasi_static", "step": 1 / steps, "longest": 1 / steps, "tolerance": 1e-5},
        "run": {"t_end": 1.0},
        "output": {"history": 1e-9, "rows": "steps"},
    }


def extrinsic_deck(steps: int) -> Deck:
    points = extrinsic_points()
    strong = strength(LAW) | {"tensile": STRONG * LAW.tensile, "cohesion": STRONG * LAW.cohesion,
                              "G_I": STRONG**2 * LAW.G_I, "G_II": STRONG**2 * LAW.G_II}
    return {
        "title": "fracture: a side that opens",
        "mesh": {"generator": "rectangle", "width": LENGTH, "height": 2 * LENGTH, "origin": [0.0, -LENGTH], "cells": [1, 2],
                 "lines": [{"name": "seam", "from": [0.0, 0.0], "to": [LENGTH, 0.0]}]},
        "solid": {"element": "compt", "plane": "stress"},
        "material": [{"density": 1000.0, "constants": {"E": EXTRINSIC_YOUNG, "nu": 0.0}, "strength": strong}],
        "interface": [{"on": "seam", "strength": strength(LAW)}],
        "fracture": {"method": "extrinsic", "penalty": LAW.penalty * HALF / EXTRINSIC_YOUNG},
        "boundary": [{"on": "bottom", "type": "fixed"},
                     {"on": "top", "type": "displacement", "value": [0.0, 1.0],
                      "amplitude": {"type": "table", "times": [float(t) for t, _ in points], "values": [float(o) for _, o in points]}}],
        "integrator": {"type": "quasi_static", "step": 1 / steps, "longest": 1 / steps, "tolerance": 1e-5},
        "run": {"t_end": 1.0},
        "output": {"history": 1e-9, "rows": "steps"},
    }


def strength(law: Properties) -> Deck:
    return {"tensile": law.tensile, "cohesion": law.cohesion, "friction": law.friction,
            "residual_friction": law.residual_friction, "G_I": law.G_I, "G_II": law.G_II}


EXTRINSIC_CASE = "joint-opening-extrinsic"


def cases(profile: str) -> dict[str, Deck]:
    steps = 7 * (600 if profile == "full" else 200)
    return {f"joint-{case}": deck(case, steps) for case in [*MIXES, "friction"]} | {EXTRINSIC_CASE: extrinsic_deck(steps)}


def friction_work(law: Answer, slip: np.ndarray) -> float:
    """What friction has dissipated, J/m2. Up to the envelope one spring carries friction and cohesion, tau_f + c_0; where they
    part, two springs hold tau_f c_0/k less than it, which is counted as friction, as is what its spring then holds."""
    limit = LAW.friction * PRESSURE
    before = (limit * LAW.cohesion + limit**2 / 2) / LAW.penalty
    return float(np.trapz(law.friction, slip)) + before - law.friction[-1] ** 2 / (2 * LAW.penalty)


BETWEEN = 20  # points of the law between two of a run


def measure_extrinsic(folder: Path) -> dict:
    reactions, history = read_table(folder / "reactions.csv"), read_table(folder / "history.csv")
    there = reactions.t >= LOADING * (1 - 1e-9)  # the strains of the elements are behind
    normal = reactions["top.R_y"][there] / LENGTH
    o = np.interp(reactions.t[there], *np.transpose(extrinsic_points())) - normal * 2 * LENGTH / EXTRINSIC_YOUNG
    fine_o, fine_s = along(list(zip(o, np.zeros_like(o))), BETWEEN)
    law = traction(EXTRINSIC_LAW, fine_o, fine_s, start=(LAW.tensile, 0.0))
    # with what its springs held where it opened
    exact = LAW.G_I + LAW.tensile * LAW.opening_at_peak / 2
    fracture = float(history["dissipated_fracture"][-1]) / LENGTH
    return {"path_error": float(np.max(np.abs(normal - law.normal[::BETWEEN])) / LAW.tensile),
            "fracture_J_m2": fracture, "exact_fracture_J_m2": exact, "fracture_error": abs(fracture / exact - 1),
            "peak_over_strength": float(np.max(reactions["top.R_y"])) / LENGTH / LAW.tensile,
            "W_I_over_G_I": float(np.trapz(normal, o)) / LAW.G_I}


def measure_case(folder: Path, case: str) -> dict:
    reactions, history = read_table(folder / "reactions.csv"), read_table(folder / "history.csv")
    points = np.array(turning_points(case))
    t = np.linspace(0, 1, len(points))
    o, s = np.interp(reactions.t, t, points[:, 0]), np.interp(reactions.t, t, points[:, 1])
    normal, shear = reactions["upper.R_y"] / LENGTH, reactions["upper.R_x"] / LENGTH
    # the law on the same points and on others between them
    fine_o, fine_s = along(list(zip(o, s)), BETWEEN)
    law = traction(LAW, fine_o, fine_s)
    error = np.hypot(normal - law.normal[::BETWEEN], shear - law.shear[::BETWEEN])
    path_error = np.max(error) / np.max(np.hypot(law.normal, law.shear))
    work_i = float(np.trapz(np.where(normal > 0, normal, 0), o))
    friction_law = friction_work(law, fine_s) if case == "friction" else 0.0
    at_rest = law.friction[-1] ** 2 / (2 * LAW.penalty)  # what the spring of friction holds in the end
    work_ii = float(np.trapz(shear, s)) - friction_law - at_rest
    fracture = float(history["dissipated_fracture"][-1]) / LENGTH
    friction = float(history["dissipated_friction"][-1]) / LENGTH
    omega = np.cos(np.radians(MIXES.get(case, 90))) ** 2
    b = float(LAW.elastic_ratio(omega))
    exact = (LAW.tensile * LAW.opening_at_peak * omega + LAW.cohesion * LAW.slip_at_peak * (1 - omega)) / b
    return {"path_error": float(path_error), "fracture_J_m2": fracture, "exact_fracture_J_m2": exact,
            "fracture_error": abs(fracture / exact - 1),
            "friction_J_m2": friction, "friction_law_J_m2": friction_law,
            "friction_error": abs(friction - friction_law) / exact,
            "W_I_over_G_I": work_i / LAW.G_I, "W_II_over_G_II": work_ii / LAW.G_II,
            "sum_error": abs(work_i / LAW.G_I + work_ii / LAW.G_II - 1),
            "curve": {"opening": o[::5].tolist(), "slip": s[::5].tolist(), "normal": normal[::5].tolist(),
                      "shear": shear[::5].tolist()},
            "law": {"opening": fine_o[::20].tolist(), "slip": fine_s[::20].tolist(), "normal": law.normal[::20].tolist(),
                    "shear": law.shear[::20].tolist()}}


def measure(runs: Path, profile: str) -> dict:
    found = {case: measure_case(runs / f"joint-{case}", case) for case in [*MIXES, "friction"]}
    opening = measure_extrinsic(runs / EXTRINSIC_CASE)
    return {"cases": found, "extrinsic": opening, "metrics": {
        "joint_energy_error_max": max(max(f["fracture_error"], f["sum_error"]) for f in found.values()),
        "joint_energy_error_extrinsic": max(opening["fracture_error"], abs(opening["W_I_over_G_I"] - 1)),
        "joint_path_error_max": max(f["path_error"] for f in found.values()),
        "joint_path_error_extrinsic": opening["path_error"],
        "joint_peak_over_strength_extrinsic": opening["peak_over_strength"],
        "joint_friction_error": found["friction"]["friction_error"],
        "joint_friction_elsewhere": max(abs(f["friction_J_m2"]) for case, f in found.items() if case != "friction")}}


FIGURES = ["joint.png"]


def draw(measured: dict, figures: Path) -> None:
    figure, panels = style.plt.subplots(1, 3, figsize=(style.FULL_WIDTH, 2.4))
    shown = [("opening", "opening", "normal", "opening [µm]", "normal traction [MPa]"),
             ("sliding", "slip", "shear", "slip [µm]", "shear traction [MPa]"),
             ("friction", "slip", "shear", "slip [µm]", "shear traction [MPa]")]
    for letter, panel, (case, along_key, of_key, x_label, y_label) in zip("abc", panels, shown):
        found = measured["cases"][case]
        for source, colour, width in (("curve", style.SKY, 3.5), ("law", "k", 0.7)):
            panel.plot(np.array(found[source][along_key]) * 1e6, np.array(found[source][of_key]) / 1e6, color=colour,
                       lw=width, label={"curve": "program", "law": "law"}[source])
        panel.set(xlabel=x_label, ylabel=y_label)
        style.panel_label(panel, f"{letter}) {case}" + (f", {PRESSURE / 1e6:g} MPa" if case == "friction" else ""))
    panels[0].legend()
    style.save(figure, figures / "joint.png")
