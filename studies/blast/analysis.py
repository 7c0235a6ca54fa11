"""What the runs say: crack lengths and orientations, fracture energy edge by edge, the ledger."""
from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from studies.blast.cases import CAVITY, RADIUS, THICKNESS, Case
from studies.common.fields import read_vtu
from studies.common.results import Table
from studies.fracture.law import SOFTENING_INTEGRAL, softening

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Cracks:
    """n edges that have begun to soften, of cracks_*.vtu (docs/deck.md); two columns: of their two ends."""

    ends: Array             # (n, 2, 2) m, reference shape
    displacement: Array     # (n, 2, 2) m
    damage: Array           # (n, 2)
    fracture_i: Array       # (n, 2) J/m2, dissipated in opening
    fracture_ii: Array      # (n, 2) J/m2, in sliding
    tensile: Array          # (n, 2) Pa
    cohesion: Array         # (n, 2) Pa
    penalty: Array          # (n, 1) Pa/m
    mode: Array             # (n), o^2/(o^2 + s^2) where the edge failed, or as it is
    time_of_failure: Array  # (n) s, infinite where it has not failed

    @property
    def length(self) -> Array:
        return np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)

    @property
    def fracture(self) -> Array:
        return self.fracture_i + self.fracture_ii

    @property
    def area(self) -> Array:
        """(n, 1) m2, that an end stands for."""
        return 0.5 * THICKNESS * self.length[:, None]

    @property
    def middle(self) -> Array:
        return self.ends.mean(axis=1)

    @property
    def angle(self) -> Array:
        """rad from x, modulo pi."""
        way = self.ends[:, 1] - self.ends[:, 0]
        return np.arctan2(way[:, 1], way[:, 0]) % np.pi

    @property
    def failed(self) -> NDArray[np.bool_]:
        return np.isfinite(self.time_of_failure)


def frames(folder: Path, series: str) -> list[tuple[float, Path]]:
    """Times (s) and files of a .pvd."""
    root = ElementTree.parse(Path(folder) / f"{series}.pvd").getroot()
    return sorted((float(e.attrib["timestep"]), Path(folder) / e.attrib["file"]) for e in root.iter("DataSet"))


def nearest(folder: Path, series: str, t: float) -> Path:
    return min(frames(folder, series), key=lambda frame: abs(frame[0] - t))[1]


def read_cracks(path: Path) -> Cracks:
    grid = read_vtu(path)
    pairs = grid.connectivity.reshape(-1, 2)
    of_point = {name: np.asarray(values, dtype=float)[pairs] for name, values in grid.point_data.items()}
    time = np.asarray(grid.cell_data["time_of_failure"], dtype=float).copy()
    time[~(time >= 0)] = np.inf
    mode, penalty = (np.asarray(grid.cell_data[name], dtype=float) for name in ("mode", "penalty"))
    return Cracks(grid.points[pairs], of_point["displacement"][..., :2], of_point["end_damage"],
                  of_point["end_dissipated_fracture_i"], of_point["end_dissipated_fracture_ii"],
                  of_point["end_tensile_strength"], of_point["end_cohesion"], penalty[:, None], mode, time)


def last_cracks(folder: Path) -> Cracks:
    return read_cracks(frames(folder, "cracks")[-1][1])


# ---- fracture energy -------------------------------------------------------------------------------------------------

_DAMAGE = np.linspace(0, 1, 4001)
_INTEGRAL = np.concatenate([[0.0], np.cumsum(0.5 * (softening(_DAMAGE[1:]) + softening(_DAMAGE[:-1]))
                                             * np.diff(_DAMAGE))])


def expected(case: Case, cracks: Cracks) -> Array:
    """J/m2 that each end must have dissipated for its damage and its strengths, along a path of constant omega.

    FORMULATION 7 alone, with the deck's G_I and G_II. With A_I = omega f_t^2/k, A_II = (1 - omega) c_0^2/k, A their sum and
    dD = q d lambda, d(dissipated) = (z d lambda - lambda dz) A/2 gives A/2 [2 I(D)/q - (lambda z(D) - 1)], I the integral of
    z. At D = 1 that is 1/(m/G_I + (1 - m)/G_II), m = A_I/A the part lost in opening, and A/2 more where the energy of the
    offset is lost as well (extrinsic). Of what the end has dissipated only the ratio of the modes enters, as m. A mode that
    turns on the way is not in the closed form.
    """
    total = cracks.fracture
    m = np.divide(cracks.fracture_i, total, out=np.ones_like(total), where=total > 0)
    area = 1 / (m / (cracks.tensile**2 / cracks.penalty) + (1 - m) / (cracks.cohesion**2 / cracks.penalty))
    ratio = area * (m / case.strength["G_I"] + (1 - m) / case.strength["G_II"])
    rate = SOFTENING_INTEGRAL * ratio / (1.0 if case.method == "extrinsic" else 1 - ratio / 2)
    D = cracks.damage
    return area / 2 * (2 * np.interp(D, _DAMAGE, _INTEGRAL) / rate - ((1 + D / rate) * softening(D) - 1))


@dataclass(frozen=True)
class Consistency:
    """Differences are relative."""

    all_ends: float   # sum of what all ends must have dissipated, against the ledger
    failed: float     # the same of ends at D = 1, against what they have dissipated
    softening: float  # of the others
    by_end: float     # sum of the magnitudes of the differences of all ends, against the ledger
    files: float      # what all ends have dissipated, against the ledger
    excess: float     # strength of an end over the given one, less 1; mean weighted by dissipation


def consistency(case: Case, cracks: Cracks, ledger: float) -> Consistency:
    """@param ledger  J, dissipated by fracture"""
    must, have = cracks.area * expected(case, cracks), cracks.area * cracks.fracture
    failed = cracks.damage >= 1

    def difference(which: NDArray[np.bool_]) -> float:
        return float(must[which].sum() / have[which].sum() - 1) if np.any(which) else 0.0

    return Consistency(float(must.sum() / ledger - 1), difference(failed), difference(~failed),
                       float(np.abs(must - have).sum() / ledger), float(have.sum() / ledger - 1),
                       float((have * cracks.tensile).sum() / have.sum() / case.strength["tensile"] - 1))


# ---- orientation -----------------------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Orientation:
    """Of axes: an edge at 10 degrees is one at 190."""

    mean: float           # degrees from x, -90 to 90
    concentration: float  # length of the mean of exp(2 i angle), 0 (every direction alike) to 1 (all parallel)


def orientation(angle: Array, weight: Array) -> Orientation:
    if angle.size == 0:
        return Orientation(float("nan"), float("nan"))
    mean = np.sum(weight * np.exp(2j * angle)) / np.sum(weight)
    return Orientation(float(np.degrees(np.angle(mean)) / 2), float(abs(mean)))


def deep(cracks: Cracks) -> NDArray[np.bool_]:
    """Edges about the cavity: not those that the wave opens below the ground as it comes back."""
    return np.hypot(*(cracks.middle - np.array(CAVITY)).T) < 5 * RADIUS


# ---- ledger ----------------------------------------------------------------------------------------------------------

ENTERED = 1e-3  # of the work in the end: from there on the balance has something to be measured against


def worst_balance(history: Table) -> float:
    work = history["external_work"]
    return float(np.max(np.abs(history["balance_error"][work > ENTERED * work[-1]])))


def largest_jump(history: Table) -> tuple[float, float]:
    """s, and of the work in the end: the row of the history over which most energy comes or goes unbooked."""
    jumps = np.diff(history["left_over"])
    worst = int(np.argmax(np.abs(jumps)))
    return float(history.t[worst + 1]), float(jumps[worst] / history["external_work"][-1])
