"""What theory says of one step of a scheme on x'' = -omega^2 x: amplification matrices and limits of stability.

With y = omega dt a step takes (omega u, v) to A(y) (omega u, v); schemes that carry an acceleration on take (u, dt v,
dt^2 a). The formulas are those of the papers of integrators/README.md, written down again; Runge-Kutta tables are
those of the installed SUNDIALS, their step the stability function at -i y and i y.
"""
from __future__ import annotations

import ctypes
from functools import lru_cache
from math import sqrt
from typing import Any, Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class _ButcherTable(ctypes.Structure):
    """ARKodeButcherTableMem of SUNDIALS 6, arkode/arkode_butcher.h."""

    _fields_ = [("q", ctypes.c_int), ("p", ctypes.c_int), ("stages", ctypes.c_int),
                ("A", ctypes.POINTER(ctypes.POINTER(ctypes.c_double))), ("c", ctypes.POINTER(ctypes.c_double)),
                ("b", ctypes.POINTER(ctypes.c_double)), ("d", ctypes.POINTER(ctypes.c_double))]


def _library_name(name: str, implicit: bool) -> str:
    """Of the half that elastic forces are in: of additive pairs the implicit one, ark324l2sa_4_2_3: ARK324L2SA_DIRK_4_2_3."""
    if name.startswith("ark"):
        pair, numbers = name.split("_", 1)
        return f"ARKODE_{pair.upper().replace('SAB', 'SAb')}_DIRK_{numbers}"
    return f"ARKODE_{name.upper()}"


@lru_cache(maxsize=None)
def butcher_table(name: str, implicit: bool) -> tuple[Array, Array]:
    """A (s x s) and b (s) of a table of the library, by the program's name."""
    library = ctypes.CDLL("libsundials_arkode.so")
    load = library.ARKodeButcherTable_LoadDIRKByName if implicit else library.ARKodeButcherTable_LoadERKByName
    load.restype, load.argtypes = ctypes.POINTER(_ButcherTable), [ctypes.c_char_p]
    found = load(_library_name(name, implicit).encode())
    if not found:
        raise ValueError(f"SUNDIALS has no table {name}")
    table, s = found.contents, found.contents.stages
    return np.array([[table.A[i][j] for j in range(s)] for i in range(s)]), np.array([table.b[i] for i in range(s)])


class _Coupling(ctypes.Structure):
    """MRIStepCouplingMem of SUNDIALS 6, arkode/arkode_mristep.h."""

    _fields_ = [("matrices", ctypes.c_int), ("stages", ctypes.c_int), ("q", ctypes.c_int), ("p", ctypes.c_int),
                ("c", ctypes.POINTER(ctypes.c_double)),
                ("W", ctypes.POINTER(ctypes.POINTER(ctypes.POINTER(ctypes.c_double)))),
                ("G", ctypes.POINTER(ctypes.POINTER(ctypes.POINTER(ctypes.c_double))))]


@lru_cache(maxsize=None)
def coupling(name: str) -> tuple[Array, Array]:
    """Explicit coupling matrices (k x s x s) and abscissae (s) of a multirate table of the library."""
    load = ctypes.CDLL("libsundials_arkode.so").MRIStepCoupling_LoadTableByName
    load.restype, load.argtypes = ctypes.POINTER(_Coupling), [ctypes.c_char_p]
    kind, end = name[:-1], name[-1]
    found = load(f"ARKODE_{kind.upper()}{end if end.isalpha() else end.upper()}".encode())
    if not found:
        raise ValueError(f"SUNDIALS has no table {name}")
    table, s = found.contents, range(found.contents.stages)
    return (np.array([[[table.W[k][i][j] for j in s] for i in s] for k in range(table.matrices)]),
            np.array([table.c[i] for i in s]))


def multirate(name: str, y: float) -> Array:
    """Of (omega u, v): u' = v is the fast part, exact; accelerations are the slow one. From stage to stage, c h apart,
    v' = sum_j sum_k W_kij tau^k a_j/c  [Sandu 2019, (2.4); SUNDIALS, MRIStep]."""
    W, c = coupling(name)
    u, v = [np.array([1.0, 0.0])], [np.array([0.0, 1.0])]
    for i in range(1, len(c)):
        length = (c[i] - c[i - 1]) * y
        a = [-stage for stage in u]
        once = sum(W[k, i, j] / (k + 1) * a[j] for k in range(len(W)) for j in range(i))
        twice = sum(W[k, i, j] / ((k + 1) * (k + 2)) * a[j] for k in range(len(W)) for j in range(i))
        u.append(u[-1] + length * v[-1] + length * y * twice)
        v.append(v[-1] + y * once)
    return np.array([u[-1], v[-1]])


def stability_function(name: str, implicit: bool, z: complex) -> complex:
    """R(z) = 1 + z b (I - z A)^-1 1."""
    A, b = butcher_table(name, implicit)
    s = len(b)
    return complex(1 + z * b @ np.linalg.solve(np.eye(s) - z * A, np.ones(s)))


def _kick(y: float) -> Array:
    return np.array([[1, 0], [-y, 1]])


def _drift(y: float) -> Array:
    return np.array([[1, y], [0, 1]])


def leapfrog(y: float) -> Array:
    """Kick, drift, kick."""
    return _kick(y / 2) @ _drift(y) @ _kick(y / 2)


# first ones of the symmetric weights of Stormer-Verlet steps
_COMPOSITIONS = {"single": [], "yoshida_3": [1 / (2 - 2 ** (1 / 3))], "suzuki_5": [1 / (4 - 4 ** (1 / 3))] * 2,
                 "mclachlan_5": [0.28, 0.62546642846767004501]}


def composed(name: str, position: bool, y: float) -> Array:
    first = _COMPOSITIONS[name]
    result = np.eye(2)
    for w in [*first, 1 - 2 * sum(first), *reversed(first)]:
        step = _drift(w * y / 2) @ _kick(w * y) @ _drift(w * y / 2) if position else leapfrog(w * y)
        result = step @ result
    return result


def noh_bathe(p: float, y: float) -> Array:
    """Of (omega u, v): accelerations are -omega^2 u at the end of either sub-step."""
    q1 = (1 - 2 * p) / (2 * p * (1 - p))
    q2 = 0.5 - p * q1
    q0 = 0.5 - q1 - q2
    u, v = np.array([1.0, 0.0]), np.array([0.0, 1.0])     # rows: each quantity as a function of the start
    u1 = u + p * y * v - (p * y) ** 2 / 2 * u
    v1 = v - p * y / 2 * (u + u1)
    rest = (1 - p) * y
    u2 = u1 + rest * v1 - rest**2 / 2 * u1
    v2 = v1 - rest * (q0 * u + (0.5 + q1) * u1 + q2 * u2)
    return np.array([u2, v2])


def newmark(y: float, beta: float, gamma: float, alpha_m: float = 0.0, alpha_f: float = 0.0) -> Array:
    """Generalized-alpha of (u, dt v, dt^2 a): (1 - alpha_m) a1 + alpha_m a = -omega^2 [(1 - alpha_f) u1 + alpha_f u]."""
    u, v, a = np.eye(3)
    known_u, known_v = u + v + (0.5 - beta) * a, v + (1 - gamma) * a
    a1 = (-alpha_m * a - y**2 * ((1 - alpha_f) * known_u + alpha_f * u)) / (1 - alpha_m + y**2 * (1 - alpha_f) * beta)
    return np.array([known_u + beta * a1, known_v + gamma * a1, a1])


def bathe(rho_inf: float, y: float) -> Array:
    """Of (omega u, v)."""
    g = 2 / (2 + sqrt(2 + 2 * rho_inf))
    q1 = (1 + rho_inf) / (4 - 2 * g * (1 - rho_inf))
    q2 = 0.5 - g * q1
    q0 = 1 - q1 - q2
    S = y * np.array([[0.0, 1.0], [-1.0, 0.0]])
    one = np.eye(2)
    middle = np.linalg.solve(one - g / 2 * S, one + g / 2 * S)
    return np.linalg.solve(one - q2 * S, one + q0 * S + q1 * S @ middle)


def amplification(keys: dict[str, Any], y: float) -> Array | None:
    """Of the scheme with these keys of `[integrator]`; None for Runge-Kutta tables, which have eigenvalues alone."""
    kind = keys["type"]
    if kind == "central_difference":
        return leapfrog(y)
    if kind == "verlet":
        return composed(keys["composition"], keys["form"] == "position", y)
    if kind == "noh_bathe":
        return noh_bathe(keys.get("split", 0.54), y)
    if kind == "newmark":
        return newmark(y, keys.get("beta", 0.25), keys.get("gamma", 0.5))
    if kind == "generalized_alpha":
        rho = keys.get("rho_inf", 0.8)
        alpha_m, alpha_f = (2 * rho - 1) / (rho + 1), rho / (rho + 1)
        return newmark(y, (1 - alpha_m + alpha_f) ** 2 / 4, 0.5 - alpha_m + alpha_f, alpha_m, alpha_f)
    if kind == "hht_alpha":
        alpha = keys.get("alpha", 0.1)
        return newmark(y, (1 + alpha) ** 2 / 4, 0.5 + alpha, 0.0, alpha)
    if kind == "bathe":
        return bathe(keys.get("rho_inf", 0.8), y)
    if kind == "mri":
        return multirate(keys["slow_table"], y)
    if kind == "arkode":
        return None
    raise ValueError(f"no theory of {kind} with steps of its own choice")


def eigenvalues(keys: dict[str, Any], y: float, explicit: bool = False) -> NDArray[np.complex128]:
    """Of a step, the principal pair first: of the complex ones the pair of the largest modulus."""
    matrix = amplification(keys, y)
    if matrix is None:
        value = stability_function(keys["table"], not explicit, 1j * y)
        return np.array([value, value.conjugate()])
    found = np.linalg.eigvals(matrix).astype(complex)
    return found[np.lexsort((-found.imag, -np.abs(found), np.abs(found.imag) < 1e-9))]


def growth(keys: dict[str, Any], y: float, explicit: bool) -> float:
    """Spectral radius of a step less 1."""
    return float(np.max(np.abs(eigenvalues(keys, y, explicit)))) - 1


# Growth of a step that counts as unstable: at y = 0.01 tables with an open end at 0 grow by more, round-off by less.
LEAST_GROWTH = 1e-12
# Double eigenvalues on the unit circle are known to the root of round-off; symplectic schemes pass through such.
LEAST_GROWTH_OF_PAIRS = 1e-6


def first_unstable(grows: Callable[[float], bool], largest: float, scan: float = 5e-3) -> float:
    """The first y at which steps grow, by a scan upwards and bisection; inf if there is none up to the largest."""
    y = scan
    while y <= largest and not grows(y):
        y += scan
    if y > largest:
        return float("inf")
    stable, unstable = y - scan, y
    for _ in range(40):
        middle = 0.5 * (stable + unstable)
        stable, unstable = (stable, middle) if grows(middle) else (middle, unstable)
    return stable if stable > 0.1 else 0.0


def stability_limit(keys: dict[str, Any], explicit: bool, largest: float = 8.0) -> float:
    """omega dt up to which no step grows; 0 where every step does, inf where none up to the largest."""
    return _stability_limit(tuple(sorted(keys.items())), explicit, largest)


@lru_cache(maxsize=None)
def _stability_limit(items: tuple[tuple[str, Any], ...], explicit: bool, largest: float) -> float:
    keys = dict(items)
    least = LEAST_GROWTH if keys["type"] in ("arkode", "mri") else LEAST_GROWTH_OF_PAIRS
    return first_unstable(lambda y: growth(keys, y, explicit) > least, largest)
