"""Sparse symmetric factorisation with inertia: what the Newton steps need, by several libraries.

The count of negative pivots is the number of negative eigenvalues (Sylvester), which makes a
factorisation a test of stability.
"""

from __future__ import annotations

import importlib
from collections.abc import Callable
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array
from scipy.sparse.linalg import splu

from solver.mesh.assembly import LowerPattern

Vectors = NDArray[np.float64]
Indices = NDArray[np.int64]


@dataclass(frozen=True)
class Factored:
    """A factorised matrix; only the last one of a factoriser may be used.

    Attributes
    ----------
    negative : int
        Number of negative eigenvalues.
    solve : callable
        Right-hand sides (n,) or (n, k) to solutions.
    """

    negative: int
    solve: Callable[[Vectors], Vectors]


class Factoriser(Protocol):
    """Factorises matrices of one pattern; what depends on the pattern alone is done once."""

    def factorise(self, entries: Vectors) -> Factored:
        """Factorise the matrix whose lower triangle has these entries (nnz,)."""
        ...


def _columnwise(solve: Callable[[Vectors], Vectors]) -> Callable[[Vectors], Vectors]:
    """Let a solver of one right-hand side solve for several."""

    def solved(right: Vectors) -> Vectors:
        if right.ndim == 1:
            return solve(right)
        return np.stack([solve(column) for column in right.T], axis=1)

    return solved


class Feral:
    """`feral-solver` (MIT): multifrontal LDLᵀ with Bunch–Kaufman pivots, written in Rust."""

    def __init__(self, pattern: LowerPattern) -> None:
        feral: Any = importlib.import_module("feral")
        self._solver: Any = feral.Solver(parallel=False, ordering="amf")
        self._matrix: Any = feral.CscMatrix.from_triplet(
            pattern.size, pattern.rows, pattern.columns, np.ones(len(pattern.rows))
        )

    def factorise(self, entries: Vectors) -> Factored:
        """Factorise the matrix whose lower triangle has these entries."""
        self._matrix.set_values(entries)
        _, inertia = self._solver.factor(self._matrix)
        return Factored(int(inertia.n_neg + inertia.n_zero), self._solver.solve)


class Qdldl:
    """`qdldl` (Apache-2): LDLᵀ without pivoting."""

    def __init__(self, pattern: LowerPattern) -> None:
        self._qdldl: Any = importlib.import_module("qdldl")
        self._solver: Any = None
        # an upper triangle by columns is a lower one by rows
        self._order = np.lexsort((pattern.columns, pattern.rows))
        self._indices = pattern.columns[self._order]
        counts = np.bincount(pattern.rows, minlength=pattern.size)
        self._starts = np.concatenate([[0], np.cumsum(counts)])
        self._size = pattern.size

    def factorise(self, entries: Vectors) -> Factored:
        """Factorise the matrix whose lower triangle has these entries."""
        upper = csc_array(
            (entries[self._order], self._indices, self._starts), shape=(self._size, self._size)
        )
        if self._solver is None:
            self._solver = self._qdldl.Solver(upper, upper=True)
        else:
            self._solver.update(upper, upper=True)
        pivots = self._solver.factors()[1]
        return Factored(int(np.sum(pivots <= 0)), _columnwise(self._solver.solve))


class Pardiso:
    """`py-mkl-pardiso` (Intel licence, x86 only)."""

    _ANALYSED_BY_METIS = 2
    _NEGATIVE_EIGENVALUES = 22

    def __init__(self, pattern: LowerPattern) -> None:
        self._library: Any = importlib.import_module("pymklpardiso._mkl_pardiso")
        self._pattern = pattern
        self._solver: Any = None

    def factorise(self, entries: Vectors) -> Factored:
        """Factorise the matrix whose lower triangle has these entries."""
        if self._solver is None:
            self._solver = self._library.PardisoSolver(self._library.MTYPE_REAL_SYM_INDEF, 0)
            # a lower triangle by columns is an upper one by rows
            self._solver.set_pattern(
                ia=self._pattern.starts, ja=self._pattern.rows, n=self._pattern.size
            )
            self._solver.factor(entries)
        else:
            self._solver.refactor_values(entries)
        negative = int(self._solver.get_iparm_value(self._NEGATIVE_EIGENVALUES))
        return Factored(negative, self._solver.solve)


class SuperLu:
    """scipy's SuperLU: always there, slowest.

    With pivots taken from the diagonal alone, the signs of U's diagonal give the inertia.
    """

    def __init__(self, pattern: LowerPattern) -> None:
        below = pattern.rows != pattern.columns
        slots = np.arange(len(pattern.rows))
        row = np.concatenate([pattern.rows, pattern.columns[below]])
        column = np.concatenate([pattern.columns, pattern.rows[below]])
        order = np.lexsort((row, column))
        self._slots = np.concatenate([slots, slots[below]])[order]
        self._indices = row[order]
        counts = np.bincount(column, minlength=pattern.size)
        self._starts = np.concatenate([[0], np.cumsum(counts)])
        self._size = pattern.size

    def factorise(self, entries: Vectors) -> Factored:
        """Factorise the matrix whose lower triangle has these entries."""
        full = csc_array(
            (entries[self._slots], self._indices, self._starts), shape=(self._size, self._size)
        )
        factored = splu(
            full,
            permc_spec="MMD_AT_PLUS_A",
            diag_pivot_thresh=0.0,
            options={"SymmetricMode": True},
        )
        return Factored(int(np.sum(factored.U.diagonal() <= 0)), factored.solve)


BACKENDS: dict[str, tuple[str, Callable[[LowerPattern], Factoriser]]] = {
    "pardiso": ("pymklpardiso", Pardiso),
    "feral": ("feral", Feral),
    "qdldl": ("qdldl", Qdldl),
    "superlu": ("scipy", SuperLu),
}
"""Module and class of each backend, fastest first."""


def available() -> tuple[str, ...]:
    """Names of the backends that can be imported, fastest first."""
    return tuple(name for name, (module, _) in BACKENDS.items() if find_spec(module))


def factoriser(pattern: LowerPattern, backend: str | None = None) -> Factoriser:
    """Make a factoriser of a pattern, by a named backend or the fastest that is there."""
    return BACKENDS[backend or available()[0]][1](pattern)
