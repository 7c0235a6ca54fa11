"""Direct shear of an interface that is pressed: peak, residual strength and energy against their closed forms. The normal force is measured:
joints that are there from the start give way to it, those of sides that open do not."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from studies.common import style
from studies.common.decks import Deck
from studies.common.results import read_table

WIDTH, HEIGHT = 1.0, 0.5  # m
YOUNG, DENSITY = 1e9, 2000.0
SEAM = {"tensile": 5e3, "cohesion": 10e3, "friction": 0.5, "residual_friction": 0.4, "G_I": 1.0, "G_II": 5.0}
BLOCKS = {"tensile": 1e8, "cohesion": 1e8, "friction": 0.5, "residual_friction": 0.5, "G_I": 1e7, "G_II": 1e7}
NORMAL = YOUNG * 1e-5 / HEIGHT  # Pa, pressed by 10 um
SHIFT = 2e-3                    # m, at the end
PEAK = (SEAM["cohesion"] + SEAM["friction"] * NORMAL) * WIDTH  # N per m of thickness
RESIDUAL = SEAM["residual_friction"] * NORMAL * WIDTH
EDGES = {"full": (8, 16), "quick": (8,)}
METHODS = ("extrinsic", "intrinsic")


def deck(method: str, element: str, edges: int) -> Deck:
    return {
        "title": f"fracture: direct shear of an interface, {method}, {element}, {edges} edges",
        "mesh": {"generator": "rectangle", "width": WIDTH, "height": HEIGHT, "cells": [edges, edges // 2],
                 "lines": [{"name": "seam", "from": [0.0, HEIGHT / 2], "to": [WIDTH, HEIGHT / 2]}]},
        "solid": {"element": element, "plane": "strain"},
        "material": [{"density": DENSITY, "constants": {"E": YOUNG, "nu": 0.0}, "strength": BLOCKS}],
        "fracture": {"method": method},
        "interface": [{"on": "seam", "strength": SEAM}],
        "contact": {"method": "potential", "friction": SEAM["residual_friction"]},
        "boundary": [{"on": "bottom", "type": "fixed"},
                     {"on": "top", "type": "displacement", "value": [SHIFT, "free"],
                      "amplitude": {"type": "table", "times": [1.0, 2.0, 4.0], "values": [0.0, 0.05, 1.0]}},
                     {"on": "top", "type": "displacement", "value": ["free", -1e-5], "amplitude": {"type": "ramp", "end": 1.0}}],
        "integrator": {"type": "quasi_static", "step": 0.02, "longest": 0.01},
        "run": {"t_end": 4.0},
        "output": {"history": 0.01},
    }


def runs(profile: str) -> dict[str, tuple[str, str, int]]:
    return {f"shear_box-{method}-{element}-{edges}": (method, element, edges)
            for method in METHODS for element in ("cst", "compt") for edges in EDGES[profile]}


def cases(profile: str) -> dict[str, Deck]:
    return {name: deck(*what) for name, what in runs(profile).items()}


def measure(folder: Path, profile: str) -> dict:
    found = {}
    for name, (method, element, edges) in runs(profile).items():
        reactions, history = read_table(folder / name / "reactions.csv"), read_table(folder / name / "history.csv")
        load, normal = reactions["top.R_x"], -reactions["top.R_y"]
        top = int(load.argmax())
        found[name] = {"method": method, "element": element, "edges": edges, "shift": np.interp(
            reactions.t, [1.0, 2.0, 4.0], [0.0, 0.05 * SHIFT, SHIFT]).tolist(), "load": load.tolist(),
            "peak": float(load[top] / (SEAM["cohesion"] * WIDTH + SEAM["friction"] * normal[top])),
            "normal": float(normal[top]) / (NORMAL * WIDTH), "normal_at_end": float(normal[-1]) / (NORMAL * WIDTH),
            "residual": float(load[-1] / (SEAM["residual_friction"] * normal[-1])),
            "fracture": float(history["dissipated_fracture"][-1]) / (SEAM["G_II"] * WIDTH)}
    extrinsic = [f for f in found.values() if f["method"] == "extrinsic"]
    intrinsic = [f for f in found.values() if f["method"] == "intrinsic"]
    return {"runs": found, "metrics": {
        "shear_box_peak_error_extrinsic": max(abs(f["peak"] - 1) for f in extrinsic),
        "shear_box_peak_error_intrinsic": max(abs(f["peak"] - 1) for f in intrinsic),
        "shear_box_normal_loss_extrinsic": max(1 - f["normal_at_end"] for f in extrinsic),
        "shear_box_normal_loss_intrinsic": max(1 - f["normal_at_end"] for f in intrinsic),
        "shear_box_residual_error": max(abs(f["residual"] - 1) for f in found.values()),
        "shear_box_energy_error": max(abs(f["fracture"] - 1) for f in found.values())}}


FIGURES = ["shear_box.png"]


def draw(measured: dict, figures: Path) -> None:
    figure, panel = style.plt.subplots(figsize=(style.FULL_WIDTH * 0.6, 2.6))
    for force, label in ((PEAK, "peak"), (RESIDUAL, "residual")):
        panel.axhline(force / 1e3, color="0.5", lw=0.7, ls="--")
        panel.annotate(label, (1.98, force / 1e3), ha="right", va="bottom", fontsize=7, color="0.4")
    shown = [f for f in measured["runs"].values() if f["edges"] == 8]
    for found, colour in zip(shown, style.CYCLE):
        panel.plot(np.array(found["shift"]) * 1e3, np.array(found["load"]) / 1e3, color=colour,
                   label=f"{found['method']}, {found['element'].upper()}")
    panel.set(xlabel="shift [mm]", ylabel="shear force [kN/m]", ylim=(0, None))
    panel.legend()
    style.save(figure, figures / "shear_box.png")
