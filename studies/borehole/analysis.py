"""From the histories of the runs to the numbers of the study. README.md defines every metric in words."""
from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from studies.borehole.cases import (CAVITY_RADIUS, DENSITY, DIRECTIONS, FRONT_RADII, PROBE_RADIUS, WINDOW_END, Case,
                                    probe_name)
from studies.common.cavity import CavityStep
from studies.common.results import Table, read_table
from studies.common.signals import first_crossing, gaussian_filter, peak, relative_l2

Array = NDArray[np.float64]

PRESSURE = 1e6  # Pa, of every case but the variant 1kPa
# Instants at which signals are compared: a fortieth of the filter's width, so that sums over them are integrals.
TIMES = np.linspace(0.0, WINDOW_END, 1601)
# The front's speed is taken between these radii.
FRONT_SPAN = (FRONT_RADII[0], FRONT_RADII[-1])


@dataclass(frozen=True)
class Results:
    """The folder with the folders of the runs."""

    folder: Path

    def of(self, case: Case) -> Path:
        return self.folder / case.name

    def snapshot(self, case: Case) -> dict[str, NDArray]:
        """What scripts/snapshot.py kept of the fields."""
        return np.load(self.of(case) / "snapshot.npz")

    def table(self, case: Case) -> Table:
        return _table(self.of(case) / "probes.csv")

    def velocity(self, case: Case, degrees: float = 0.0, radius: float = PROBE_RADIUS) -> tuple[Array, Array]:
        """Times of the run, s, and the radial velocity at a probe, m/s, as it was computed."""
        table = self.table(case)
        return table.t, table[probe_name(radius, degrees) + ".v_r"]

    def filtered_velocity(self, case: Case, degrees: float = 0.0) -> Array:
        """The radial velocity at PROBE_RADIUS after the filter, at TIMES, m/s."""
        return _filtered_velocities(self, case)[:, DIRECTIONS.index(degrees)]

    def raw_velocity(self, case: Case, degrees: float = 0.0) -> Array:
        """The unfiltered radial velocity at TIMES, m/s."""
        t, v = self.velocity(case, degrees)
        return np.interp(TIMES, t, v)

    def displacement(self, case: Case, degrees: float = 0.0) -> Array:
        """The radial displacement at TIMES, m. Between rows the slope is bounded: no filter is needed."""
        table = self.table(case)
        return np.interp(TIMES, table.t, table[probe_name(PROBE_RADIUS, degrees) + ".u_r"])


@lru_cache(maxsize=128)
def _table(path: Path) -> Table:
    return read_table(path)


@lru_cache(maxsize=128)
def _filtered_velocities(results: Results, case: Case) -> Array:
    """Of all directions at once, shape (times, directions): nearly all of the work is the same for each."""
    v = np.stack([results.velocity(case, degrees)[1] for degrees in DIRECTIONS], -1)
    return gaussian_filter(results.table(case).t, v, case.filter_sigma, TIMES)


def cavity(case: Case) -> CavityStep:
    """The closed form that belongs to an isotropic case."""
    constants = case.constants
    if constants["M_alpha"] != constants["M_beta"] or constants["M_alpha"] != constants["M_psi"]:
        raise ValueError(f"{case.name} is not isotropic")
    return CavityStep(PRESSURE, CAVITY_RADIUS, constants["M_v"], constants["M_alpha"], DENSITY)


def rotation_difference(results: Results, turned: Case, unturned: Case, degrees: float = 0.0) -> dict[str, float]:
    """How far a run with everything turned is from the run it should repeat, at one probe."""
    a, b = (results.filtered_velocity(case, degrees) for case in (turned, unturned))
    raw_a, raw_b = (results.raw_velocity(case, degrees) for case in (turned, unturned))
    u_a, u_b = (results.displacement(case, degrees) for case in (turned, unturned))
    return {
        "peak_difference": abs(peak(TIMES, a)[1] / peak(TIMES, b)[1] - 1),
        "history_difference": relative_l2(TIMES, a, b),
        "raw_peak_difference": abs(float(np.max(raw_a) / np.max(raw_b)) - 1),
        "raw_history_difference": relative_l2(TIMES, raw_a, raw_b),
        "displacement_difference": relative_l2(TIMES, u_a, u_b),
    }


def cavity_errors(results: Results, case: Case, degrees: float = 0.0) -> dict[str, float]:
    """Relative L2 errors over the window against the closed form, at PROBE_RADIUS."""
    exact = cavity(case)
    v = exact.filtered_velocity(PROBE_RADIUS, TIMES, case.filter_sigma)
    filtered = results.filtered_velocity(case, degrees)
    return {
        "velocity": relative_l2(TIMES, filtered, v),
        "raw_velocity": relative_l2(TIMES, results.raw_velocity(case, degrees), exact.velocity(PROBE_RADIUS, TIMES)),
        "displacement": relative_l2(TIMES, results.displacement(case, degrees),
                                    exact.displacement(PROBE_RADIUS, TIMES)),
        "peak": abs(peak(TIMES, filtered)[1] / peak(TIMES, v)[1] - 1),
        "raw_peak": abs(float(np.max(results.raw_velocity(case, degrees))) / exact.front_jump(PROBE_RADIUS) - 1),
    }


@lru_cache(maxsize=128)
def _front_crossings(results: Results, case: Case) -> Array:
    """Times of half the peak of the filtered radial velocity, s, shape (directions, radii): nearly all of the work of the
    filter is the same for each."""
    t = results.table(case).t
    at = np.linspace(t[0], t[-1], TIMES.size)
    v = np.stack([[results.velocity(case, degrees, radius)[1] for radius in FRONT_RADII] for degrees in DIRECTIONS])
    filtered = gaussian_filter(t, np.moveaxis(v, -1, 0), case.filter_sigma, at)
    return np.apply_along_axis(lambda signal: first_crossing(at, signal, 0.5 * peak(at, signal)[1]), 0, filtered)


def front_crossings(results: Results, case: Case, degrees: float) -> tuple[Array, Array]:
    """At FRONT_RADII: times of half the peak of the filtered radial velocity, and exact arrivals, s."""
    arrivals = [case.stiffness.arrival(np.radians(degrees), radius, CAVITY_RADIUS) for radius in FRONT_RADII]
    return _front_crossings(results, case)[DIRECTIONS.index(degrees)], np.array(arrivals)


def front_speed_error(results: Results, case: Case, degrees: float) -> dict[str, float]:
    """Relative error of the front's travel time between the radii of FRONT_SPAN, and the speeds themselves, m/s."""
    crossings, arrivals = front_crossings(results, case, degrees)
    measured, exact = crossings[-1] - crossings[0], arrivals[-1] - arrivals[0]
    way = FRONT_SPAN[1] - FRONT_SPAN[0]
    return {"error": measured / exact - 1, "speed": way / measured, "exact_speed": way / exact}


def all_histories_difference(results: Results, case: Case, reference: Case) -> float:
    """Largest difference over all probes, times, displacement and velocity components, each relative to the largest
    value of its quantity. The two runs must have the same rows: runs with a fixed step."""
    a, b = results.table(case), results.table(reference)
    if a.t.size != b.t.size or np.max(np.abs(a.t - b.t)) > 1e-12 * b.t[-1]:
        raise ValueError(f"{case.name} and {reference.name} have rows at different times")
    worst = 0.0
    for kind in ("u", "v"):
        names = [n for n in b.columns if n.endswith((f".{kind}_x", f".{kind}_y"))]
        scale = max(float(np.max(np.abs(b[n]))) for n in names)
        worst = max(worst, max(float(np.max(np.abs(a[n] - b[n]))) for n in names) / scale)
    return worst


def largest_filtered_difference(results: Results, case: Case, reference: Case) -> float:
    """Largest relative L2 difference of the filtered radial velocity over the probes at PROBE_RADIUS."""
    return max(relative_l2(TIMES, results.filtered_velocity(case, d), results.filtered_velocity(reference, d))
               for d in DIRECTIONS)
