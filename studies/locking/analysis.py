"""From what the runs leave to the numbers of the study. README.md defines every metric in words."""
from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from studies.common.fields import Frame, frame_path, read_frame
from studies.common.results import find_number, observed_order, read_summary, read_table
from studies.locking.cases import Case

Array = NDArray[np.float64]

CORNER = (1.0, 1.0)       # m, where the load is
LAST_LEVELS = 4           # meshes from which orders and the spread of an offset are taken
CHECKERBOARD_REACH = 0.5  # m: nearer to the corner the stress itself is too steep to be told from an oscillation

# VERIFICATION 7: u_x of the corner, m, under a unit force (1, -1), M = 0.6667, M_v = 1666.4, uniform_right.
LOCKING_TABLE = {
    "cst": {2: 0.0190, 4: 0.0738, 8: 0.2670, 16: 0.8318, 32: 2.1201},
    "compt": {2: 4.4677, 4: 6.4725, 8: 8.3491, 16: 10.1892, 32: 12.0178},
    "centre": {2: 5.9973, 4: 7.8298, 8: 9.6540, 16: 11.4736, 32: 13.2943},
}
# Compliance of the spread load, m/N, for where deal.II is not there: Taylor-Hood elements on reference.geo, 2 068 001
# unknowns (refined twice). Refined once, it is less by 1e-8 of it; never, by 1.3e-7. After a study has written its decks
#   build/release/tests/crosscheck/gneiss_crosscheck results/locking/decks/reference.toml --element taylor_hood --refine 2
#     --out reference.json
# computes it (4.5 GB, a minute): `compliance` in J over the square of the force, 1e-6 N2. Every study compares the two.
REFERENCE_COMPLIANCE = 7.26442932e-9
TABLE_UNIT = 1e-9  # m/N: a constant of 1 in the table is 1 GPa here


@dataclass(frozen=True)
class Results:
    """The folders with the folders of the runs and with the files of the cross-check."""

    cases: Path
    crosscheck: Path

    def of(self, case: Case) -> Path:
        return self.cases / case.name

    def corner(self, case: Case) -> Array:
        """Displacement of the loaded corner over the force of one component, m/N, shape (2)."""
        table = read_table(self.of(case) / "probes.csv")
        return np.array([table["corner.u_x"][-1], table["corner.u_y"][-1]]) / case.force

    def compliance(self, case: Case) -> float:
        """Work of the full load on the displacement, f . u, over the square of the force, m/N. Of small loads: the
        ramp does half of it."""
        return 2 * find_number(read_summary(self.of(case)), "external_work") / case.force**2

    def frame(self, case: Case) -> Frame:
        return read_frame(frame_path(self.of(case), 1.0, 1e-9))

    def displacement(self, case: Case) -> Array:
        """Of the nodes, m, shape (n_nodes, 2)."""
        return self.frame(case).point_data["displacement"][:, :2]

    def peer(self, case: Case, element: str) -> dict[str, Any]:
        """What deal.II found for the same deck with an element of its own: p1, p2, taylor_hood."""
        return json.loads((self.crosscheck / f"{case.name}-{element}.json").read_text())


def growth_per_halving(M_v: float, M: float) -> float:
    """By how much u_x of the corner grows, over the force, when elements are halved: m/N, thickness 1 m.

    Near the corner the solid is a wedge with a force at its end, across its axis. Stress is radial [Flamant 1892],
    sigma_rr = -P cos(theta)/(c r) with theta from the line of the force, and c = int cos(theta)^2 from pi/4 to 3 pi/4 =
    pi/4 - 1/2 for equilibrium. Its strain, integrated along r, is but for functions of theta a translation along the force
    of P log(1/r)/(c E'), with E' = (C11^2 - C12^2)/C11. At which part of its size an element cuts that off is its own
    affair, but the size is halved. P = sqrt(2) F has F along x.
    """
    c11, c12 = M_v + M, M_v
    return float(np.log(2) / ((c11**2 - c12**2) / c11 * (np.pi / 4 - 0.5)))


def orders(errors: dict[str, float]) -> dict:
    """Of errors by the number of composites: "orders" from each mesh to the next, as "8-16"; "order" over the last
    LAST_LEVELS of them, by least squares, or None where there are no three."""
    n = sorted(map(int, errors))
    size, error = [1 / k for k in n], [abs(errors[str(k)]) for k in n]
    pairs = {f"{a}-{b}": observed_order(size[i : i + 2], error[i : i + 2]) for i, (a, b) in enumerate(zip(n, n[1:]))}
    last = slice(-LAST_LEVELS, None)
    return {"orders": pairs, "order": observed_order(size[last], error[last]) if len(n) > 2 else None}


def relative_difference(a: Array, b: Array) -> float:
    """Largest difference of two fields over the largest value of the second."""
    return float(np.max(np.abs(np.asarray(a) - np.asarray(b))) / np.max(np.abs(b)))


def areas(frame: Frame) -> Array:
    a, b, c = (frame.points[frame.triangles[:, k]] for k in range(3))
    return 0.5 * np.abs((b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1]))


def pressure(frame: Frame) -> Array:
    """-(sigma_xx + sigma_yy)/2 of every sub-triangle, Pa."""
    stress = frame.cell_data["cauchy_stress"]
    return -0.5 * (stress[:, 0] + stress[:, 1])


def stress_difference(frame: Frame, reference: Frame) -> float:
    """Area-weighted L2 norm of the difference in sigma_xx of two runs on the same triangles, over that of the second."""
    if not np.array_equal(frame.triangles, reference.triangles):
        raise ValueError("the two runs have different triangles")
    a, b = (f.cell_data["cauchy_stress"][:, 0] for f in (frame, reference))
    return float(np.sqrt(np.sum(areas(frame) * (a - b) ** 2) / np.sum(areas(frame) * b**2)))


def smoothed(frame: Frame, values: Array) -> Array:
    """Values of triangles after averaging: at each node the mean of its triangles, weighted by area; of each triangle the
    mean of its nodes."""
    area = areas(frame)
    weight, total = np.zeros(len(frame.points)), np.zeros(len(frame.points))
    for k in range(3):
        np.add.at(weight, frame.triangles[:, k], area)
        np.add.at(total, frame.triangles[:, k], area * values)
    return (total / weight)[frame.triangles].mean(axis=1)


def checkerboard(frame: Frame, values: Array) -> float:
    """How much values of triangles oscillate from one to the next: area-weighted L2 norm of their difference from the
    smoothed ones over that of the smoothed ones, over the triangles farther than CHECKERBOARD_REACH from the corner."""
    smooth = smoothed(frame, values)
    centroid = frame.points[frame.triangles].mean(axis=1)
    weight = areas(frame) * (np.hypot(*(centroid - CORNER).T) > CHECKERBOARD_REACH)
    return float(np.sqrt(np.sum(weight * (values - smooth) ** 2) / np.sum(weight * smooth**2)))
