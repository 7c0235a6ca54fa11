"""VERIFICATION 17: a plate struck beside its notch."""
from __future__ import annotations

from pathlib import Path

import numpy as np

from studies.common import style
from studies.common.decks import Deck
from studies.common.results import read_summary
from studies.fracture import maps
from studies.fracture.paths import Network, Segments, angle_of, last_cracks, read_times, speeds, start_time

FOLDER = Path(__file__).parent.parent
SIDE, NOTCH, FROM_AXIS = 0.1, 0.05, 0.025  # m: the upper half of the plate, axis along y = 0
YOUNG, POISSON, DENSITY = 190e9, 0.3, 8000.0
VELOCITY, RISE = 16.5, 1e-6                # m/s, s
# Not in the reference: cohesion and G_II. Steel that does not fail in shear here: twice f_t, ten times G_I.
STRENGTH = {"tensile": 844e6, "cohesion": 1688e6, "friction": 0.0, "residual_friction": 0.0, "G_I": 22.13e3, "G_II": 221.3e3}
SIZE = {"full": 0.7e-3, "quick": 1.25e-3}  # m, sub-edges; the cohesion length is G E'/f_t^2 = 6.5 mm
MESHES = {"full": 3, "quick": 1}           # of sizes a little different: as many samples
T_END, FRAME = 90e-6, 2.25e-6          # s; 40 frames, of which every tenth keeps its fields
CRACKED = 0.5                              # damage at which an edge counts as cracked
TIP = np.array([NOTCH, FROM_AXIS])
RAYLEIGH = 2799.0                          # m/s, of VERIFICATION's E, nu and density
SPAN = 6e-6                                # s, over which speeds are taken


def deck(element: str, size: float, method: str, mesh: int = 0) -> Deck:
    return {
        "title": f"fracture: Kalthoff and Winkler, {element}, {method}, mesh {mesh}",
        "mesh": {"file": str(FOLDER / "plate.geo"), "parameters": {
            "width": SIDE, "height": SIDE, "at": FROM_AXIS, "length": NOTCH, "size": 2 * size * (1 - 0.02 * mesh)}},
        "solid": {"element": element, "plane": "strain"},
        "material": [{"density": DENSITY, "constants": {"E": YOUNG, "nu": POISSON}, "strength": STRENGTH}],
        "fracture": {"method": method} | ({"penalty": 50.0} if method == "intrinsic" else {}),
        "contact": {"method": "potential", "friction": 0.0},
        "crack": [{"on": "notch"}],
        "boundary": [{"on": "bottom", "type": "displacement", "value": ["free", 0.0]},
                     {"on": "left_below", "type": "velocity", "value": [VELOCITY, "free"],
                      "amplitude": {"type": "ramp", "end": RISE}}],
        "integrator": {"type": "central_difference"},
        "run": {"t_end": T_END},
        "output": {"fields": FRAME},
    }


def cases(profile: str) -> dict[str, Deck]:
    found = {f"kalthoff-extrinsic-{mesh}": deck("compt", SIZE[profile], "extrinsic", mesh) for mesh in range(MESHES[profile])}
    if profile == "full":
        found["kalthoff-intrinsic-0"] = deck("compt", SIZE[profile], "intrinsic")
    return found


def measure_cracks(cracks: Segments) -> dict:
    """From edges and the times at which they cracked. Speeds are those upwards, over the sine of the angle."""
    angle = angle_of(cracks, TIP, 1e-7)
    way = np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
    times, reach = Network(cracks, TIP, 1e-7).history(way)
    reach = reach - TIP @ way
    at, speed = speeds(times[times > 0], reach[times > 0], SPAN) if np.any(times > 0) else (np.zeros(0), np.zeros(0))
    return {"angle": angle, "start_us": start_time(cracks) * 1e6, "t": times.tolist(), "reach": reach.tolist(),
            "speed_over_rayleigh": float(speed.max()) / RAYLEIGH if speed.size else float("nan"),
            "at": at.tolist(), "speed": speed.tolist()}


def measure_run(folder: Path) -> dict:
    failed = last_cracks(folder)
    failed = failed.chosen(np.isfinite(failed.time_of_failure))
    return measure_cracks(read_times(folder, CRACKED)) | {
        "segments": failed.ends.tolist(), "balance_error": read_summary(folder)["balance_error"]}


def measure(runs: Path, profile: str) -> dict:
    found = {name: measure_run(runs / name) for name in cases(profile)}
    extrinsic = [f for name, f in found.items() if "extrinsic" in name]
    angles = [f["angle"] for f in extrinsic]
    metrics = {"kalthoff_angle_deg": float(np.mean(angles)), "kalthoff_angle_deg_min": min(angles), "kalthoff_angle_deg_max": max(angles),
               "kalthoff_start_us": float(np.mean([f["start_us"] for f in extrinsic])),
               "kalthoff_max_speed_over_rayleigh": max(f["speed_over_rayleigh"] for f in extrinsic),
               "kalthoff_energy_balance_error": max(f["balance_error"] for f in found.values())}
    if profile == "full":
        metrics["kalthoff_intrinsic_angle_deg"] = found["kalthoff-intrinsic-0"]["angle"]
    return {"runs": found, "map": maps.speed_map(runs / "kalthoff-extrinsic-0", T_END, SIDE, SIDE), "metrics": metrics}


FIGURES = ["kalthoff.png"]


def draw(measured: dict, figures: Path) -> None:
    runs = measured["runs"]
    figure, panels = style.plt.subplots(1, 3, figsize=(style.FULL_WIDTH, 2.5))
    maps.draw_map(panels[0], measured["map"], runs["kalthoff-extrinsic-0"]["segments"], "m/s")
    style.panel_label(panels[0], f"a) speed and cracks, {T_END * 1e6:g} µs")
    for (name, found), colour in zip(runs.items(), style.CYCLE):
        maps.draw_cracks(panels[1], found["segments"], colour)
        times = np.array(found["t"])
        panels[2].step(times[times > 0] * 1e6, np.array(found["reach"])[times > 0] * 1e3, where="post", color=colour,
                       label=f"{name.removeprefix('kalthoff-')}: {found['angle']:.0f}°")
    for angle in (60, 70, 80):
        end = TIP + 0.08 * np.array([np.cos(np.radians(angle)), np.sin(np.radians(angle))])
        panels[1].plot(*(np.array([TIP, end]).T * 1e3), color="0.8", lw=0.7, zorder=0)
    panels[1].set(xlim=(0, 100), ylim=(0, 100), aspect="equal", xlabel="x [mm]", ylabel="y [mm]")
    style.panel_label(panels[1], "b) all runs; grey: 60, 70, 80°")
    panels[2].set(xlabel="time [µs]", ylabel="way of the tip [mm]")
    panels[2].legend()
    style.panel_label(panels[2], "c) tip")
    style.save(figure, figures / "kalthoff.png")
