"""VERIFICATION 18: a disc pressed along a diameter: elastic stress at its centre, load at which it splits, where it splits."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from studies.common import style
from studies.common.decks import Deck
from studies.common.fields import frame_path, read_frame
from studies.common.results import read_table
from studies.fracture.law import SOFTENING_INTEGRAL
from studies.fracture.paths import Segments, apart

FOLDER = Path(__file__).parent.parent
RADIUS = 25e-3
ALPHA = np.radians(6.0)  # half of the loaded arc
YOUNG, POISSON, DENSITY = 30e9, 0.2, 2500.0
STRENGTH = {"tensile": 5e6, "cohesion": 25e6, "friction": 0.7, "residual_friction": 0.5, "G_I": 5.0, "G_II": 50.0}
PENALTY = 50.0
PRESSURE = 1e4           # Pa, of the elastic runs
# Of each platen, s and m/s: fast up to some 80 % of the load, then slowly, because a crack takes 20 us through the disc. A
# wave goes through it in 14 us.
VELOCITY = [(0.0, 0.0), (40e-6, 0.12), (150e-6, 0.12), (190e-6, 0.03), (1.0, 0.03)]
T_END = {"full": 4e-4, "quick": 4e-4}
FRAMES = 40
# m, composites of the elastic runs and of those that break
SIZES = {"full": (1.25e-3, 1.25e-3), "quick": (2.5e-3, 2e-3)}
OPEN = 0.5 * STRENGTH["G_I"] / (SOFTENING_INTEGRAL * STRENGTH["tensile"])  # m: half way to nothing
DROPPED = 0.75           # of the peak load: the disc has split
NEAR_CENTRE = 0.08       # of the radius: stresses are averaged over it


def centre_stress(pressure: float) -> tuple[float, float]:
    """xx and yy at the centre, Pa, of a disc under a pressure on two arcs of 2 ALPHA: the sum of pairs of point loads dP, each
    2 dP/(pi D) across and -6 dP/(pi D) along itself."""
    return (2 * pressure / np.pi * (np.sin(2 * ALPHA) - ALPHA), -2 * pressure / np.pi * (np.sin(2 * ALPHA) + ALPHA))


def force_of(pressure: float) -> float:
    """N per m of thickness."""
    return 2 * RADIUS * pressure * np.sin(ALPHA)


def base(element: str, size: float, aligned: bool) -> Deck:
    return {
        "title": f"fracture: Brazilian disc, {element}",
        "mesh": {"file": str(FOLDER / "disc.geo"), "parameters": {"R": RADIUS, "size": size, "alpha": float(ALPHA), "aligned": int(aligned)}},
        "solid": {"element": element, "plane": "stress"},
        "material": [{"density": DENSITY, "constants": {"E": YOUNG, "nu": POISSON}}],
    }


def elastic_deck(element: str, size: float) -> Deck:
    ramp = {"type": "ramp", "end": 1.0}
    return base(element, size, False) | {
        "load": [{"on": on, "type": "pressure", "value": PRESSURE, "amplitude": ramp} for on in ("top", "bottom")],
        "boundary": [{"on": on, "type": "displacement", "value": value}
                     for on, value in (("left_point", ["free", 0.0]), ("right_point", ["free", 0.0]),
                                       ("top_point", [0.0, "free"]))],
        "integrator": {"type": "quasi_static"},
        "run": {"t_end": 1.0},
    }


def breaking_deck(element: str, size: float, profile: str, aligned: bool, method: str = "intrinsic") -> Deck:
    result = base(element, size, aligned)
    result["material"][0]["strength"] = STRENGTH
    if method == "extrinsic":  # halves that have come apart touch
        result["contact"] = {"method": "potential", "friction": STRENGTH["residual_friction"]}
    t_end = T_END[profile]
    return result | {
        "fracture": {"method": method} | ({"penalty": PENALTY} if method == "intrinsic" else {}),
        "boundary": [{"on": on, "type": "velocity", "value": ["free", float(sign)],
                      "amplitude": {"type": "table", "times": [t for t, _ in VELOCITY], "values": [v for _, v in VELOCITY]}} for on, sign in (("top", -1), ("bottom", 1))],
        "integrator": {"type": "central_difference"},
        "run": {"t_end": t_end},
        "output": {"history": t_end / 1000, "fields": t_end / FRAMES},
    }


def cases(profile: str) -> dict[str, Deck]:
    elastic, breaking = SIZES[profile]
    found = {f"brazilian-elastic-{element}": elastic_deck(element, elastic) for element in ("cst", "compt")}
    for element in ("cst", "compt") if profile == "full" else ("compt",):
        found[f"brazilian-{element}"] = breaking_deck(element, breaking, profile, aligned=True)
    found["brazilian-compt-extrinsic"] = breaking_deck("compt", breaking, profile, aligned=True, method="extrinsic")
    if profile == "full":
        found["brazilian-compt-free"] = breaking_deck("compt", breaking, profile, aligned=False)
    return found


def measure_elastic(folder: Path) -> dict:
    frame = read_frame(frame_path(folder, 1.0, 1e-6))
    corners = frame.points[frame.triangles]
    middle = corners.mean(axis=1)
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = np.abs(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0]) / 2
    near = np.linalg.norm(middle, axis=1) < NEAR_CENTRE * RADIUS
    stress = np.average(frame.cell_data["cauchy_stress"][near][:, :2], axis=0, weights=area[near])
    exact = centre_stress(PRESSURE)
    point_load = 2 * force_of(PRESSURE) / (np.pi * 2 * RADIUS)
    return {"stress": stress.tolist(), "exact": list(exact), "error": abs(stress[0] / exact[0] - 1),
            "error_yy": abs(stress[1] / exact[1] - 1), "of_point_load": stress[0] / point_load, "triangles": int(near.sum())}


def split(cracks: Segments) -> dict:
    """Of the inner part of the disc, |y| < 0.6 R: along which share of the loaded diameter an edge nearby is open, and how far
    from it open edges are in the mean, weighted by their opening."""
    x, y = (cracks.middle / RADIUS).T
    inner = np.abs(y) < 0.6
    bins = np.linspace(-0.6, 0.6, 13)
    close = inner & (np.abs(x) < 0.2)
    share = float(np.mean(np.histogram(y[close], bins)[0] > 0))
    away = float(np.average(np.abs(x[inner]), weights=(cracks.length * cracks.opening)[inner])) if inner.any() else float("nan")
    return {"share": share, "away": away}


def measure_breaking(folder: Path, t_end: float) -> dict:
    reactions = read_table(folder / "reactions.csv")
    top, bottom = -reactions["top.R_y"], reactions["bottom.R_y"]
    force = (top + bottom) / 2
    peak = int(np.argmax(force))
    # the load drops as the disc splits: the first frame after that; later the halves break in turn
    after = np.nonzero(force[peak:] < DROPPED * force[peak])[0]
    dropped = float(reactions.t[peak + after[0]]) if after.size else float("nan")
    found = {"t": reactions.t[::5].tolist(), "force": force[::5].tolist(), "peak": float(force[peak]),
             "t_peak": float(reactions.t[peak]), "t_dropped": dropped,
             "unbalanced": float(abs(top[peak] - bottom[peak]) / force[peak])}
    found["strength_ratio"] = 2 * found["peak"] / (np.pi * 2 * RADIUS) / STRENGTH["tensile"]
    step = t_end / FRAMES
    if np.isfinite(dropped):
        frame = min(t_end, step * np.ceil(dropped / step))
        cracks = apart(read_frame(frame_path(folder, frame, 0.1 * step)))
        open_ones = cracks.chosen(cracks.opening > OPEN)
        found |= split(open_ones) | {"frame": frame, "segments": open_ones.ends.tolist(),
                                     "opening": open_ones.opening.tolist()}
    else:
        found |= {"share": float("nan"), "away": float("nan"), "frame": float("nan"), "segments": [], "opening": []}
    return found


def measure(runs: Path, profile: str) -> dict:
    names = list(cases(profile))
    elastic = {name: measure_elastic(runs / name) for name in names if "elastic" in name}
    broken = {name: measure_breaking(runs / name, T_END[profile]) for name in names if "elastic" not in name}
    aligned = {name: b for name, b in broken.items() if not name.endswith("free")}
    ratios = [b["strength_ratio"] for b in aligned.values()]
    extrinsic = broken["brazilian-compt-extrinsic"]["strength_ratio"]
    free = {"brazilian_strength_ratio_free": broken["brazilian-compt-free"]["strength_ratio"]} if profile == "full" else {}
    return {"elastic": elastic, "broken": broken, "metrics": {
        "brazilian_center_stress_error": max(e["error"] for e in elastic.values()),
        "brazilian_center_stress_over_point_load": elastic["brazilian-elastic-compt"]["of_point_load"],
        "brazilian_strength_ratio_min": min(ratios), "brazilian_strength_ratio_max": max(ratios),
        "brazilian_strength_ratio": broken["brazilian-compt"]["strength_ratio"], "brazilian_strength_ratio_extrinsic": extrinsic,
        "brazilian_split_share": min(b["share"] for b in aligned.values()),
        "brazilian_split_away": max(b["away"] for b in aligned.values()),
        "brazilian_platens_unbalanced": max(b["unbalanced"] for b in broken.values()), **free}}


FIGURES = ["brazilian.png"]


def draw(measured: dict, figures: Path) -> None:
    from matplotlib.collections import LineCollection

    broken = measured["broken"]
    names = {"brazilian-cst": "CST", "brazilian-compt": "COMPT", "brazilian-compt-extrinsic": "COMPT, extrinsic",
             "brazilian-compt-free": "COMPT, free mesh"}
    columns = 3
    rows = -(-(len(broken) + 1) // columns)
    figure, panels = style.plt.subplots(rows, columns, figsize=(style.FULL_WIDTH, 2.6 * rows))
    panels = panels.ravel()
    for panel in panels[len(broken) + 1 :]:
        panel.set_axis_off()
    for (name, found), colour in zip(broken.items(), style.CYCLE):
        panels[0].plot(np.array(found["t"]) * 1e6, 2 * np.array(found["force"]) / (np.pi * 2 * RADIUS) / STRENGTH["tensile"],
                       color=colour, label=names[name])
    panels[0].axhspan(0.85, 1.15, color="0.93", zorder=0)
    panels[0].set(xlabel="time [µs]", ylabel="2P/(πDh) over tensile strength")
    panels[0].legend(fontsize=6)
    style.panel_label(panels[0], "a) load")
    around = np.linspace(0, 2 * np.pi, 200)
    for letter, panel, (name, found) in zip("bcde", panels[1:], broken.items()):
        panel.plot(25 * np.cos(around), 25 * np.sin(around), color=style.GREY, lw=0.7)
        for sign in (1, -1):
            arc = sign * np.pi / 2 + np.linspace(-ALPHA, ALPHA, 20)
            panel.plot(25 * np.cos(arc), 25 * np.sin(arc), "k", lw=3)
        panel.add_collection(LineCollection(np.array(found["segments"]).reshape(-1, 2, 2) * 1e3, colors=style.RED, linewidths=1.2))
        panel.set_aspect("equal")
        panel.grid(False)
        panel.set(xlabel="x [mm]", ylabel="y [mm]")
        style.panel_label(panel, f"{letter}) {names[name]}, " + (f"{found['frame'] * 1e6:.0f} µs" if found["segments"] else "not split"))
    style.save(figure, figures / "brazilian.png")
