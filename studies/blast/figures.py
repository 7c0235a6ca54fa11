"""The figures of the study from the folders of its runs."""
from __future__ import annotations

from functools import lru_cache
from pathlib import Path

import numpy as np
from matplotlib.animation import FuncAnimation, PillowWriter
from matplotlib.collections import LineCollection

from studies.blast.analysis import Cracks, deep, last_cracks, nearest
from studies.blast.cases import CAVITY, DEPTH, MATERIALS, RADIUS, T_END, WIDTH, Case, bedding
from studies.common import style
from studies.common.fields import read_frame, sample_on_grid
from studies.common.results import read_table

PITCH = 0.2  # m
X = np.arange(-WIDTH / 2, WIDTH / 2 + PITCH / 2, PITCH)
Y = np.arange(-DEPTH, PITCH / 2, PITCH)
EARLY, LATE = (1e-3, 2e-3, 4e-3), (7e-3, 10e-3, 16e-3)  # s
COLOUR = {"anisotropic": style.BLUE, "isotropic": style.ORANGE}
HOW = {"extrinsic": ("-", "extrinsic"), "intrinsic": ("--", "intrinsic"), "extrinsic-mesh_2": (":", "extrinsic, mesh 2")}


@lru_cache(maxsize=64)
def speed(folder: Path, t: float) -> np.ndarray:
    """m/s on the grid in the reference shape, NaN in the cavity."""
    frame = read_frame(nearest(folder, "fields", t))
    values = sample_on_grid(frame.points, frame.triangles, np.hypot(*frame.point_data["velocity"][:, :2].T), X, Y)
    return np.where(np.hypot(X[None] - CAVITY[0], Y[:, None] - CAVITY[1]) < RADIUS, np.nan, values)


def failed_by(cracks: Cracks, t: float) -> np.ndarray:
    return cracks.ends[cracks.time_of_failure <= t]


def plan(axes, half_width: float | None = None) -> None:
    axes.set_aspect("equal")
    axes.grid(False)
    if half_width is None:
        axes.set(xlim=(-WIDTH / 2, WIDTH / 2), ylim=(-DEPTH, 0))
    else:
        axes.set(xlim=(CAVITY[0] - half_width, CAVITY[0] + half_width), ylim=(-2 * half_width, 0))


def panel(axes, field: np.ndarray, ends: np.ndarray, top: float, width: float):
    axes.set_facecolor("black")
    image = axes.imshow(field, extent=(X[0], X[-1], Y[0], Y[-1]), origin="lower", vmin=0, vmax=top,
                        cmap=style.SPEED_MAP, interpolation="bilinear")
    for line in bedding()[1:-1]:
        axes.plot(*np.array(line).T, color="white", linewidth=0.4, linestyle=(0, (4, 4)), alpha=0.6)
    drawn = LineCollection(list(ends), colors="white", linewidths=width)
    axes.add_collection(drawn)
    return image, drawn


def snapshots(runs: Path, times: tuple[float, ...], path: Path, half_width: float | None, width: float) -> None:
    """One row per time: anisotropic beside isotropic, one colour scale per row."""
    shape = 1.0 if half_width else DEPTH / WIDTH
    figure, rows = style.plt.subplots(len(times), 2, sharex=True, sharey=True,
                                      figsize=(style.FULL_WIDTH, len(times) * (3.1 * shape + 0.12) + 0.5))
    for row, t in zip(rows, times):
        fields = [speed(runs / Case(material).name, t) for material in MATERIALS]
        top = float(np.nanpercentile(np.concatenate([f[f > 0.02 * np.nanmax(f)] for f in fields]), 98))
        for axes, material, field in zip(row, MATERIALS, fields):
            image, _ = panel(axes, field, failed_by(last_cracks(runs / Case(material).name), t), top, width)
            plan(axes, half_width)
            style.panel_label(axes, f"{material}, {1e3 * t:g} ms")
        row[0].set_ylabel("y [m]")
        figure.colorbar(image, ax=list(row), label="speed [m/s]", extend="max", pad=0.01, fraction=0.03)
    for axes in rows[-1]:
        axes.set_xlabel("x [m]")
    style.save(figure, path)


def crack_maps(runs: Path, path: Path) -> None:
    """The end of all runs."""
    figure, rows = style.plt.subplots(2, 3, sharex=True, sharey=True, figsize=(style.FULL_WIDTH, 4.9))
    for row, material in zip(rows, MATERIALS):
        for axes, (how, (_, label)) in zip(row, HOW.items()):
            cracks = last_cracks(runs / f"{material}-{how}")
            axes.add_collection(LineCollection(list(cracks.ends[~cracks.failed]), colors="#BBBBBB", linewidths=0.4))
            axes.add_collection(LineCollection(list(cracks.ends[cracks.failed]), colors=COLOUR[material],
                                               linewidths=0.5))
            axes.add_patch(style.plt.Circle(CAVITY, RADIUS, color="black", fill=False, linewidth=0.6))
            for line in bedding()[1:-1]:
                axes.plot(*np.array(line).T, color=style.GREY, linewidth=0.5, linestyle=(0, (4, 4)))
            plan(axes, 25.0)
            style.panel_label(axes, f"{material}\n{label}")
        row[0].set_ylabel("y [m]")
    for axes in rows[-1]:
        axes.set_xlabel("x [m]")
    style.save(figure, path)


def roses(runs: Path, path: Path) -> None:
    """Length of failed edges by direction, as a part of the whole, within five radii of the cavity."""
    bins = np.linspace(0, np.pi, 19)
    figure, rows = style.plt.subplots(2, 3, figsize=(style.FULL_WIDTH, 5.0), subplot_kw={"projection": "polar"})
    largest = 0.0
    for row, material in zip(rows, MATERIALS):
        for axes, (how, (_, label)) in zip(row, HOW.items()):
            cracks = last_cracks(runs / f"{material}-{how}")
            which = cracks.failed & deep(cracks)
            lengths, _ = np.histogram(cracks.angle[which], bins, weights=cracks.length[which])
            shares = lengths / max(lengths.sum(), 1e-300)
            largest = max(largest, float(shares.max()))
            for turn in (0.0, np.pi):
                axes.bar(bins[:-1] + turn, shares, width=np.diff(bins), align="edge", color=COLOUR[material],
                         edgecolor="white", linewidth=0.4)
            axes.plot(np.linspace(0, 2 * np.pi, 100), np.full(100, 1 / 18), color="black", linewidth=0.6)
            axes.set_axisbelow(True)
            axes.set_xticks(np.radians(range(0, 360, 45)))
            axes.set_yticklabels([])
            axes.set_title(f"{material}, {label}", fontsize=8)
    for axes in rows.ravel():
        axes.set_ylim(0, 1.05 * largest)
    style.save(figure, path)


def crack_length(runs: Path, path: Path) -> None:
    figure, axes = style.plt.subplots(figsize=(style.FULL_WIDTH * 0.75, 3.2))
    for material in MATERIALS:
        for how, (line, label) in HOW.items():
            history = read_table(runs / f"{material}-{how}" / "history.csv")
            axes.plot(1e3 * history.t, history["cracked_length"], line, color=COLOUR[material],
                      label=f"{material}, {label}")
    axes.set(xlabel="t [ms]", ylabel="length of failed edges [m]", xlim=(0, 1e3 * T_END), ylim=(0, None))
    axes.legend()
    style.save(figure, path)


ENTRIES = (("external_work", "work of the pulse", "black"), ("kinetic", "kinetic", style.BLUE),
           ("stored_material", "stored in the rock", style.ORANGE),
           ("dissipated_fracture", "fracture", style.RED), ("dissipated_friction", "friction", style.PURPLE),
           ("dissipated_absorbing", "absorbed outside", style.GREEN), ("stored_contact", "stored in contact", style.SKY),
           ("splitting", "put in by events", style.GREY))


def energy(runs: Path, path: Path) -> None:
    figure, rows = style.plt.subplots(2, 2, sharex=True, figsize=(style.FULL_WIDTH, 5.2), height_ratios=[2, 1],
                                      sharey="row")
    for column, material in enumerate(MATERIALS):
        history = read_table(runs / Case(material).name / "history.csv")
        for key, label, colour in ENTRIES:
            rows[0, column].plot(1e3 * history.t, 1e-6 * history[key], color=colour, label=label)
        style.panel_label(rows[0, column], f"{material}, extrinsic")
        for how, (line, label) in HOW.items():
            other = read_table(runs / f"{material}-{how}" / "history.csv")
            entered = other["external_work"] > 1e-3 * other["external_work"][-1]
            rows[1, column].semilogy(1e3 * other.t[entered], np.maximum(np.abs(other["balance_error"][entered]), 1e-7), line,
                                     color=COLOUR[material], label=label)
        rows[1, column].axhline(5e-3, color="black", linewidth=0.6)
        rows[1, column].set(xlabel="t [ms]", xlim=(0, 1e3 * T_END))
    rows[0, 0].set_ylabel("energy [MJ per m]")
    rows[1, 0].set_ylabel("balance error")
    rows[0, 1].legend(fontsize=7, ncols=2, loc="center right", bbox_to_anchor=(1.0, 0.62))
    rows[1, 1].legend(fontsize=7)
    style.save(figure, path)


def animation(runs: Path, path: Path) -> None:
    """Frames of both materials beside each other; colours to the same speed throughout."""
    n = 32
    times = np.linspace(0, T_END, n + 1)[1:]
    cracks = {material: last_cracks(runs / Case(material).name) for material in MATERIALS}
    figure, axes = style.plt.subplots(1, 2, figsize=(8.0, 2.9), sharey=True)
    shown = {}
    for one, material in zip(axes, MATERIALS):
        shown[material] = panel(one, speed(runs / Case(material).name, times[0]), np.zeros((0, 2, 2)), 3.0, 0.5)
        plan(one)
        one.set_xlabel("x [m]")
    axes[0].set_ylabel("y [m]")
    figure.colorbar(shown[MATERIALS[0]][0], ax=list(axes), label="speed [m/s]", extend="max", pad=0.01, fraction=0.03)

    def update(i: int) -> list:
        for one, material in zip(axes, MATERIALS):
            image, lines = shown[material]
            image.set_data(speed(runs / Case(material).name, times[i]))
            lines.set_segments(list(failed_by(cracks[material], times[i])))
            one.set_title(f"{material}, {1e3 * times[i]:.1f} ms", loc="left")
        return []

    FuncAnimation(figure, update, frames=n).save(path, PillowWriter(fps=6), dpi=100)
    style.plt.close(figure)


def draw(runs: Path, figures: Path) -> None:
    figures.mkdir(parents=True, exist_ok=True)
    snapshots(runs, EARLY, figures / "early.png", 20.0, 0.45)
    snapshots(runs, LATE, figures / "late.png", None, 0.35)
    crack_maps(runs, figures / "cracks.png")
    roses(runs, figures / "roses.png")
    crack_length(runs, figures / "crack_length.png")
    energy(runs, figures / "energy.png")
    animation(runs, figures / "blast.gif")
