"""A notched beam in three-point bending (Petersson's geometry): the load it bears, by joints that are there from the start and by
sides that open, against the same beam solved here with a rigid seam."""
from __future__ import annotations

from pathlib import Path

import numpy as np
import scipy.sparse.linalg as sparse_linalg

from studies.common import style
from studies.common.decks import Deck
from studies.common.matrices import read_system
from studies.common.results import read_table
from studies.fracture.law import SOFTENING_INTEGRAL, softening

SPAN, DEPTH, THICKNESS, NOTCH = 2.0, 0.2, 0.05, 0.1  # m
YOUNG, POISSON, DENSITY = 30e9, 0.2, 2400.0          # plane stress
SEAM = {"tensile": 3.33e6, "cohesion": 10e6, "friction": 0.0, "residual_friction": 0.0, "G_I": 124.0, "G_II": 400.0}
BULK = {"tensile": 1e9, "cohesion": 1e9, "friction": 0.0, "residual_friction": 0.0, "G_I": 1e7, "G_II": 1e7}
LOADED = 0.02            # m, half of the length under the load
DEFLECTION = 1.2e-3      # m, at the end
PENALTY = 20.0
CELLS = {"full": (10, 20), "quick": (10,)}  # along the depth
METHODS = ("extrinsic", "intrinsic")
"""
"""
