"""What the runs say: crack lengths and orientations, fracture energy edge by edge, the ledger."""
from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from studies.blast.cases import CAVITY, CONSTANTS, GPA, INTERFACES, PENALTY, RADIUS, THICKNESS, Case, height
from studies.common.decks import Deck
from studies.common.fields import read_vtu
from studies.common.results import Table
from studies.fracture.law import SOFTENING_INTEGRAL, softening

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Cracks:
    """n edges that have begun to soften, of cracks_*.vtu; two columns: of their two ends."""

    ends: Array             # (n, 2, 2) m, reference shape
    displacement: Array     # (n, 2, 2) m
    damage: Array           # (n, 2)
    opening: Array          # (n, 2) m
    slip: Array             # (n, 2) m
    fracture: Array         # (n, 2) J/m2
    mode: Array             # (n), o^2/(o^2 + s^2) where the edge failed, or as it is
    time_of_failure: Array  # (n) s, infinite where it has not failed

    @property
    def length(self) -> Array:
        return np.linalg.norm(self.ends[:, 1] - self.ends[:, 0], axis=1)

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
    return Cracks(grid.points[pairs], of_point["displacement"][..., :2], of_point["end_damage"],
                  of_point["end_opening"], of_point["end_slip"], of_point["end_dissipated_fracture"],
                  np.nan_to_num(np.asarray(grid.cell_data["mode"], dtype=float)), time)


def last_cracks(folder: Path) -> Cracks:
    return read_cracks(frames(folder, "cracks")[-1][1])


# ---- fracture energy -------------------------------------------------------------------------------------------------

_DAMAGE = np.linspace(0, 1, 4001)
_INTEGRAL = np.concatenate([[0.0], np.cumsum(0.5 * (softening(_DAMAGE[1:]) + softening(_DAMAGE[:-1]))
                                             * np.diff(_DAMAGE))])


def dissipation(damage: Array, omega: Array, penalty: Array, strength: Deck, extrinsic: bool) -> Array:
    """J/m2 along a path of constant omega up to D, from FORMULATION 7 alone.

    With A = omega f_t^2/k + (1 - omega) c_0^2/k and dD = q d lambda, d(dissipated) = (z d lambda - lambda dz) A/2 gives
    A/2 [2 I(D)/q - (lambda z(D) - 1)], I the integral of z: at D = 1 just G, and G + A/2 where the energy of the offset
    is lost as well (extrinsic).
    """
    a_i, a_ii = strength["tensile"] ** 2 / penalty, strength["cohesion"] ** 2 / penalty
    area = omega * a_i + (1 - omega) * a_ii
    ratio = omega * a_i / strength["G_I"] + (1 - omega) * a_ii / strength["G_II"]
    rate = SOFTENING_INTEGRAL * ratio / (1.0 if extrinsic else 1 - ratio / 2)
    return area / 2 * (2 * np.interp(damage, _DAMAGE, _INTEGRAL) / rate - ((1 + damage / rate) * softening(damage) - 1))


def layer_of(points: Array) -> NDArray[np.int64]:
    """0 to 3 from the top."""
    heights = np.array([[height(k, x) for x in points[:, 0]] for k in range(len(INTERFACES))])
    return np.sum(points[None, :, 1] < heights, axis=0) if len(points) else np.zeros(0, dtype=int)


def penalties(case: Case, cracks: Cracks) -> Array:
    """k of every edge, Pa/m, with the mean of the P-wave moduli along and across the bedding: exact for the isotropic rock."""
    moduli = np.array([M_v + 0.5 * (M_alpha + M_beta) for M_v, M_alpha, M_beta, _ in CONSTANTS[case.material]]) * GPA
    return PENALTY * moduli[layer_of(cracks.middle)] / cracks.length


def expected_energy(case: Case, cracks: Cracks) -> Array:
    """J of every edge: what both ends must have dissipated for their damage, in the edge's mode throughout."""
    strength = case.strength
    f, c = strength["tensile"], strength["cohesion"]
    open_squared = np.maximum(cracks.opening, 0) ** 2
    both = open_squared + cracks.slip ** 2
    now = np.divide(open_squared, both, out=np.zeros_like(both), where=both > 0)
    mode = np.where(cracks.failed[:, None], cracks.mode[:, None], now)
    omega = mode * c**2 / (mode * c**2 + (1 - mode) * f**2)
    ends = dissipation(cracks.damage, omega, penalties(case, cracks)[:, None], strength, case.method == "extrinsic")
    return THICKNESS * cracks.length * ends.mean(axis=1)


def written_energy(cracks: Cracks) -> Array:
    """J of every edge, as the file has it."""
    return THICKNESS * cracks.length * cracks.fracture.mean(axis=1)


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
