"""Reads what `gneiss matrices` writes (docs/matrices.md)."""
from __future__ import annotations

import json
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
import scipy.sparse as sparse
from numpy.typing import NDArray
from scipy.io import mmread


@dataclass(frozen=True)
class System:
    """Nodes (n, 2) m, elements by their nodes, the degrees of freedom without a support; matrices over all of them."""

    folder: Path
    nodes: NDArray[np.float64]
    elements: NDArray[np.int64]
    free: NDArray[np.int64]

    @property
    def n_dof(self) -> int:
        return 2 * len(self.nodes)

    @cached_property
    def stiffness(self) -> sparse.csr_matrix:
        return mmread(self.folder / "stiffness.mtx").tocsr()

    @cached_property
    def mass(self) -> NDArray[np.float64]:
        """Lumped: the diagonal, kg."""
        return mmread(self.folder / "mass.mtx").diagonal()


def read_system(folder: Path) -> System:
    description = json.loads((Path(folder) / "system.json").read_text())
    free = np.setdiff1d(np.arange(description["n_dof"]), description["constrained_dofs"])
    return System(Path(folder), np.array(description["nodes_m"]), np.array(description["elements"]), free)
