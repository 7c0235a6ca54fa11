"""VERIFICATION 16: a crack that runs and branches."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from studies.common import style
from studies.common.decks import Deck
from studies.common.results import read_summary, read_table
from studies.fracture import maps
from studies.fracture.paths import Network, Segments, last_cracks, read_times, speeds, start_time

FOLDER = Path(__file__).parent.parent
WIDTH, HEIGHT, NOTCH = 0.1, 0.04, 0.05     # m
YOUNG, POISSON, DENSITY = 32e9, 0.2, 2450.0
TRACTION = 1e6                             # Pa, on top and bottom, from the start
RAYLEIGH = 2125.0                          # m/s
# Not in the reference: cohesion and G_II. G_II = G_I, so that a crack that zigzags along edges takes no more per length for it; shear
# alone breaks nothing, three times the tensile strength (README has what other choices do).
STRENGTH = {"tensile": 3.08e6, "cohesion": 9.24e6, "friction": 0.0, "residual_friction": 0.0, "G_I": 3.0, "G_II": 3.0}
SIZE = {"full": 0.5e-3, "quick": 1e-3}     # m, sub-edges; the cohesion length is G E'/f_t^2 = 10.5 mm
MESHES = {"full": 3, "quick": 1}           # of sizes a little different: as many samples
FINE = 0.3e-3                              # m, sub-edges of one run more
T_END = 80e-6
FRAME = 2e-6                               # s, time between frames; fields of every tenth are kept
CRACKED = 0.5                              # damage at which an edge counts as cracked
PARTING = 0.1                              # damage along whose arms the zone of softening parts
ARM = 4e-3                                 # m, a branch is longer
SPAN = 6e-6                                # s, over which speeds are taken
TIP = np.array([NOTCH, HEIGHT / 2])


def deck(element: str, size: float, method: str, mesh: int = 0) -> Deck:
    return {
        "title": f"fracture: branching, {element}, {method}, mesh {mesh}",
        "mesh": {"file": str(FOLDER / "plate.geo"), "parameters": {
            "width": WIDTH, "height": HEIGHT, "at": HEIGHT / 2, "length": NOTCH, "size": 2 * size * (1 - 0.02 * mesh)}},
        "solid": {"element": element, "plane": "strain"},
        "material": [{"density": DENSITY, "constants": {"E": YOUNG, "nu": POISSON}, "strength": STRENGTH}],
        "fracture": {"method": method} | ({"penalty": 50.0} if method == "intrinsic" else {}),
        "contact": {"method": "potential", "friction": 0.0},
        "crack": [{"on": "notch"}],
        "load": [{"on": on, "type": "traction", "value": [0.0, sign * TRACTION]} for on, sign in (("top", 1), ("bottom", -1))],
        "integrator": {"type": "central_difference"},
        "run": {"t_end": T_END},
        "output": {"fields": FRAME},
    }


def cases(profile: str) -> dict[str, Deck]:
    found = {f"branching-extrinsic-{mesh}": deck("compt", SIZE[profile], "extrinsic", mesh) for mesh in range(MESHES[profile])}
    if profile == "full":
        found["branching-intrinsic-0"] = deck("compt", SIZE[profile], "intrinsic")
        found["branching-fine"] = deck("compt", FINE, "extrinsic") | {"title": "fracture: branching, compt, extrinsic, fine mesh"}
    return found


def measure_cracks(cracks: Segments, bridge: float) -> dict:
    """From edges and the times at which they cracked."""
    times, reach = Network(cracks, TIP, 1e-7).history()
    at, speed = speeds(times[times > 0], reach[times > 0], SPAN)
    where, when = Network(cracks, TIP, 1e-7, bridge).fork(ARM)
    return {"start_us": start_time(cracks) * 1e6, "branching_us": when * 1e6, "branching_mm": float(where[0]) * 1e3,
            "speed_over_rayleigh": float(speed.max()) / RAYLEIGH if speed.size else float("nan"),
            "t": times.tolist(), "reach": reach.tolist(), "at": at.tolist(), "speed": speed.tolist()}


def measure_run(folder: Path, size: float) -> dict:
    bridge = 3 * size
    found = measure_cracks(read_times(folder, CRACKED), bridge)
    history = read_table(folder / "history.csv")
    first_at, first = Network(read_times(folder, PARTING), TIP, 1e-7, bridge).fork(ARM)
    failed = last_cracks(folder)
    failed = failed.chosen(np.isfinite(failed.time_of_failure))
    return found | {
        "parting_us": first * 1e6, "parting_mm": float(first_at[0]) * 1e3,
        "softening_us": float(history.t[np.argmax(history["dissipated_fracture"] > 0)]) * 1e6, "failed_us": start_time(failed) * 1e6,
        "cracked_mm": float(failed.length.sum()) * 1e3, "dissipated_over_cracked_G": float(
            history["dissipated_fracture"][-1] / (failed.length.sum() * STRENGTH["G_I"])) if failed.length.size else float("nan"),
        "segments": failed.ends.tolist(), "balance_error": read_summary(folder)["balance_error"]}


def measure(runs: Path, profile: str) -> dict:
    found = {name: measure_run(runs / name, FINE if name == "branching-fine" else SIZE[profile]) for name in cases(profile)}
    extrinsic = [f for name, f in found.items() if "extrinsic" in name]
    metrics = {}
    for name, key in (("start", "start_us"), ("softening", "softening_us"), ("failure", "failed_us"), ("parting", "parting_us"),
                      ("parting_at", "parting_mm"), ("time", "branching_us"), ("at", "branching_mm")):
        values = np.array([f[key] for f in extrinsic])
        values = values[np.isfinite(values)]  # of the runs that branch
        unit = key.split("_")[-1]
        for suffix, of in (("", np.mean), ("_min", np.min), ("_max", np.max)) if len(extrinsic) > 1 else (("", np.mean),):
            metrics[f"branching_{name}_{unit}{suffix}"] = float(of(values)) if values.size else float("nan")
    metrics |= {"branching_runs_that_branch": sum(np.isfinite(f["branching_us"]) for f in extrinsic) / len(extrinsic),
                "branching_max_speed_over_rayleigh": max(f["speed_over_rayleigh"] for f in extrinsic),
                "branching_dissipated_over_cracked_G": max(f["dissipated_over_cracked_G"] for f in extrinsic),
                "branching_energy_balance_error": max(f["balance_error"] for f in found.values())}
    if profile == "full":
        for name, run in (("intrinsic", "branching-intrinsic-0"), ("fine", "branching-fine")):
            of = found[run]
            metrics |= {f"branching_{name}_start_us": of["start_us"], f"branching_{name}_parting_us": of["parting_us"],
                        f"branching_{name}_time_us": of["branching_us"], f"branching_{name}_at_mm": of["branching_mm"],
                        f"branching_{name}_max_speed_over_rayleigh": of["speed_over_rayleigh"]}
    name = "branching-extrinsic-0"
    return {"runs": found, "map": maps.speed_map(runs / name, T_END, WIDTH, HEIGHT), "metrics": metrics}


FIGURES = ["branching.png"]


def draw(measured: dict, figures: Path) -> None:
    runs = measured["runs"]
    figure, panels = style.plt.subplots(2, 2, figsize=(style.FULL_WIDTH, 4.6))
    maps.draw_map(panels[0, 0], measured["map"], runs["branching-extrinsic-0"]["segments"], "m/s")
    panels[0, 0].set_xlim(0, WIDTH * 1e3)
    style.panel_label(panels[0, 0], "a) speed and cracks, 80 µs")
    for (name, found), colour in zip(runs.items(), style.CYCLE):
        label = name.removeprefix("branching-")
        maps.draw_cracks(panels[0, 1], found["segments"], colour)
        times = np.array(found["t"])
        panels[1, 0].step(times[times > 0] * 1e6, np.array(found["reach"])[times > 0] * 1e3, where="post", color=colour, label=label)
        panels[1, 0].plot(found["branching_us"], found["branching_mm"], "o", color=colour, ms=4)
        panels[1, 0].plot(found["parting_us"], found["parting_mm"], "v", color=colour, ms=4)
        panels[1, 1].plot(np.array(found["at"]) * 1e3, np.array(found["speed"]) / RAYLEIGH, color=colour)
    panels[0, 1].set(xlim=(45, 100), ylim=(0, 40), aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    style.panel_label(panels[0, 1], "b) failed edges of all runs")
    panels[1, 0].axvspan(30, 35, color="0.93", zorder=0)
    panels[1, 0].axvline(10, color="0.85", zorder=0)
    panels[1, 0].set(xlabel="time [µs]", ylabel="tip [mm]")
    panels[1, 0].legend()
    style.panel_label(panels[1, 0], "c) tip; ●: branches, ▼: zone parts")
    panels[1, 1].axhline(0.6, color="0.8", zorder=0)
    panels[1, 1].set(xlabel="tip [mm]", ylabel="speed over Rayleigh's", ylim=(0, 0.8))
    style.panel_label(panels[1, 1], "d) speed, mean over 6 µs")
    style.save(figure, figures / "branching.png")
