"""Plane waves in a homogeneous anisotropic solid, and the arrival of the front of a finite cavity [FORMULATION 9].

All directions are angles in radians measured from the material axis alpha.
"""
from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import minimize_scalar

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Stiffness:
    """Small-strain stiffness on the material axes, Pa, and density, kg/m3.

    C_11 belongs to alpha, C_22 to beta; C_66 relates the shear stress to the engineering shear strain.
    """

    c11: float
    c22: float
    c12: float
    c66: float
    density: float

    @classmethod
    def from_munjiza(cls, M_v: float, M_alpha: float, M_beta: float, M_psi: float, density: float) -> "Stiffness":
        """C_aaaa = M_v + M_alpha, C_bbbb = M_v + M_beta, C_aabb = M_v, C_abab = M_psi/2."""
        return cls(M_v + M_alpha, M_v + M_beta, M_v, M_psi / 2, density)

    def christoffel(self, angle: ArrayLike) -> Array:
        """Christoffel matrix C_ijkl n_j n_l of the wave normals at `angle`, Pa, shape (..., 2, 2)."""
        angle = np.asarray(angle, dtype=float)
        c, s = np.cos(angle), np.sin(angle)
        off = (self.c12 + self.c66) * c * s
        return np.stack([np.stack([self.c11 * c**2 + self.c66 * s**2, off], -1),
                         np.stack([off, self.c66 * c**2 + self.c22 * s**2], -1)], -2)

    def phase_speed(self, angle: ArrayLike, mode: str = "qP") -> Array:
        """Phase speed of the wave whose normal is at `angle`, m/s."""
        values = np.linalg.eigvalsh(self.christoffel(angle))
        return np.sqrt(values[..., _column(mode)] / self.density)

    def group_velocity(self, angle: ArrayLike, mode: str = "qP") -> Array:
        """Group velocity of the wave whose normal is at `angle`, m/s, shape (..., 2), components on alpha and beta.

        V_i = C_ijkl a_j n_k a_l/(density v) with the unit polarisation a: the gradient of omega(k) = v |k| in k.
        """
        angle = np.asarray(angle, dtype=float)
        values, vectors = np.linalg.eigh(self.christoffel(angle))
        a = vectors[..., :, _column(mode)]
        v = np.sqrt(values[..., _column(mode)] / self.density)
        n1, n2 = np.cos(angle), np.sin(angle)
        mixed = (self.c12 + self.c66) * a[..., 0] * a[..., 1]
        V1 = (self.c11 * a[..., 0] ** 2 + self.c66 * a[..., 1] ** 2) * n1 + mixed * n2
        V2 = (self.c66 * a[..., 0] ** 2 + self.c22 * a[..., 1] ** 2) * n2 + mixed * n1
        return np.stack([V1, V2], -1) / (self.density * v[..., None])

    def group_speed_along(self, ray_angle: float) -> float:
        """Speed of the qP wave whose energy travels along `ray_angle`, m/s: a point source's front."""
        # The ray's front comes from the plane wave that arrives last: r/V = max over n of (x.n)/v(n).
        return 1.0 / self._latest(ray_angle, 1.0, 0.0)

    def arrival(self, angle: float, r: float, cavity_radius: float) -> float:
        """Time at which the qP front of a cavity loaded at t = 0 reaches the point at polar (r, angle), s.

        The maximum over wave normals n of (x.n - a)/v(n) [FORMULATION 9]: the front is the envelope of plane waves that
        start tangent to the cavity. It is not (r - a)/V_group.
        """
        if r < cavity_radius:
            raise ValueError(f"r = {r} m lies inside the cavity of radius {cavity_radius} m")
        return self._latest(angle, r, cavity_radius)

    def front(self, t: float, cavity_radius: float, n_points: int = 721, mode: str = "qP") -> Array:
        """Front at time t (s) of a cavity loaded at t = 0, a n + t V(n), m, shape (n_points, 2), on the material axes.

        The qS sheet has cusps; it is returned as it is.
        """
        angle = np.linspace(0, 2 * np.pi, n_points)
        n = np.stack([np.cos(angle), np.sin(angle)], -1)
        return cavity_radius * n + t * self.group_velocity(angle, mode)

    def _latest(self, angle: float, r: float, radius: float) -> float:
        def delay(normal):
            return (r * np.cos(normal - angle) - radius) / self.phase_speed(normal)

        scan = angle + np.linspace(-np.pi / 2, np.pi / 2, 361)
        best = scan[np.argmax(delay(scan))]
        step = np.pi / 360
        found = minimize_scalar(lambda n: -delay(n), bounds=(best - step, best + step), method="bounded",
                                options={"xatol": 1e-9})
        return float(-found.fun)


def _column(mode: str) -> int:
    if mode not in ("qP", "qS"):
        raise ValueError(f"mode is qP or qS, not {mode!r}")
    return 1 if mode == "qP" else 0
