"""Signals in time: the one Gaussian filter of the studies, norms, crossings."""
from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import erf

Array = NDArray[np.float64]

# Beyond this many standard deviations the Gaussian is below 2e-15 of its total.
REACH = 8.0
# Gauss-Legendre points on panels of one standard deviation: the Gaussian alone is integrated to 1e-14.
_PANEL_POINTS = 12


def gaussian_filter(t: ArrayLike, values: ArrayLike, sigma: float, at: ArrayLike | None = None) -> Array:
    """Convolution of a sampled signal with a Gaussian of standard deviation sigma, at the times `at` (default: t).

    The signal is taken as piecewise linear through the samples, which need not be equidistant, 0 before the first
    and constant after the last: that convolution is exact, in closed form. `values` may have further axes.
    Results closer than about 4 sigma to the last sample lean on the constant continuation.
    """
    t = np.asarray(t, dtype=float)
    values = np.asarray(values, dtype=float)
    if t.ndim != 1 or values.shape[0] != t.size or t.size < 2:
        raise ValueError("need at least two samples, and as many times as samples")
    if not np.all(np.diff(t) > 0):
        raise ValueError("sample times must increase")
    if not sigma > 0:
        raise ValueError("sigma must be > 0")
    at = t if at is None else np.asarray(at, dtype=float)

    # A piecewise linear signal is a sum of ramps that start at the samples, one per change of slope. The Gaussian of a
    # ramp that starts at 0 is the integral of the normal distribution.
    slopes = np.zeros((t.size + 1,) + values.shape[1:])
    slopes[1:-1] = np.diff(values, axis=0) / np.diff(t).reshape((-1,) + (1,) * (values.ndim - 1))
    kinks = np.diff(slopes, axis=0)
    z = (at[:, None] - t[None, :]) / sigma
    normal = 0.5 * (1 + erf(z / np.sqrt(2)))
    ramps = sigma * (z * normal + np.exp(-0.5 * z**2) / np.sqrt(2 * np.pi))
    filtered = np.tensordot(ramps, kinks, axes=1)
    return filtered + np.tensordot(normal[:, :1], values[:1], axes=1)  # the first sample, where it is not 0


def gaussian_filter_from_front(function, front: float, t: ArrayLike, sigma: float) -> Array:
    """Convolution with a Gaussian of a function of time that is 0 before `front` and smooth after it.

    `function` takes an array; it is evaluated up to REACH standard deviations after the last of the times t.
    """
    t = np.atleast_1d(np.asarray(t, dtype=float))
    end = float(np.max(t)) + REACH * sigma
    if end <= front:
        return np.zeros_like(t)
    n_panels = int(np.ceil((end - front) / sigma))
    x, w = np.polynomial.legendre.leggauss(_PANEL_POINTS)
    width = (end - front) / n_panels
    s = (front + width * (np.arange(n_panels)[:, None] + 0.5 * (x[None, :] + 1))).ravel()
    weights = np.tile(0.5 * width * w, n_panels) * function(s)
    kernel = np.exp(-0.5 * ((t[:, None] - s[None, :]) / sigma) ** 2) / (sigma * np.sqrt(2 * np.pi))
    return kernel @ weights


def relative_l2(t: ArrayLike, values: ArrayLike, reference: ArrayLike) -> float:
    """||values - reference|| / ||reference|| over time, trapezoidal rule on the times t."""
    t = np.asarray(t, dtype=float)
    reference = np.asarray(reference, dtype=float)
    difference = np.trapz((np.asarray(values, dtype=float) - reference) ** 2, t)
    return float(np.sqrt(difference / np.trapz(reference**2, t)))


def peak(t: ArrayLike, values: ArrayLike) -> tuple[float, float]:
    """Time and height of the largest sample, refined by the parabola through it and its two neighbours."""
    t = np.asarray(t, dtype=float)
    values = np.asarray(values, dtype=float)
    i = int(np.argmax(values))
    if i == 0 or i == values.size - 1:
        return float(t[i]), float(values[i])
    a, b, c = np.polyfit(t[i - 1 : i + 2] - t[i], values[i - 1 : i + 2], 2)
    return float(t[i] - b / (2 * a)), float(c - b**2 / (4 * a))


def first_crossing(t: ArrayLike, values: ArrayLike, level: float) -> float:
    """First time at which the signal rises through `level`, by linear interpolation. ValueError if it never does."""
    t = np.asarray(t, dtype=float)
    values = np.asarray(values, dtype=float)
    above = np.nonzero(values >= level)[0]
    if above.size == 0:
        raise ValueError(f"the signal stays below {level}")
    i = int(above[0])
    if i == 0:
        return float(t[0])
    return float(t[i - 1] + (level - values[i - 1]) / (values[i] - values[i - 1]) * (t[i] - t[i - 1]))
