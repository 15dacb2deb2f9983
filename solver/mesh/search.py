"""When a sparse minimisation ends, and with what."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from solver.mesh.factorization import Factored

Vectors = NDArray[np.float64]


@dataclass(frozen=True)
class SearchLimits:
    """When a minimisation ends, and how far its first step may go.

    Attributes
    ----------
    gradient : float
        Largest component of the gradient at a minimum.
    decrease : float
        Ends, unconverged, when the model promises less than this fraction of the energy; 0 never.
    radius : float
        Of the first trust region: the square root of twice an energy.
    steps : int
        At most.
    steady : bool
        Whether steps are found with `Curvature.STEADY`, for fabric whose stiffness has kinks; such
        a minimisation also ends where next to nothing is left to gain.
    little : float
        Part of the energy that a way down from there may still gain.
    before : tuple of float
        Energies on the way to where it begins, when it goes on from where another ended.
    """

    gradient: float = 1e-8
    decrease: float = 0.0
    radius: float = 0.3
    steps: int = 500
    steady: bool = False
    little: float = 1e-6
    before: tuple[float, ...] = ()


@dataclass(frozen=True)
class SparseMinimum:
    """Where a minimisation ended.

    Attributes
    ----------
    positions : array (n, 3)
    value, gradient_norm : float
        Energy, and the largest component of its gradient.
    entries : array (nnz,)
        Of the Hessian there.
    factored : Factored
        Its factorisation, with a little stiffness lent to free motions, when converged.
    negative : int
        Negative eigenvalues of the Hessian, beyond those of free motions.
    steps, factorizations : int
    converged : bool
        Whether the gradient is small and no eigenvalue is negative.
    way_down : float
        Part of the energy that a step along them gains, where they were found and left alone.
    most_steps : int
        That it might have taken.
    way : tuple of float
        Energies at the shapes on the way, this one's last.
    """

    positions: Vectors
    value: float
    gradient_norm: float
    entries: Vectors
    factored: Factored
    negative: int
    steps: int
    factorizations: int
    converged: bool
    most_steps: int
    way_down: float = 0.0
    way: tuple[float, ...] = ()
