"""Fit the coefficients of `solver.scaling_law` and measure its error; run with ``python -m``."""

from __future__ import annotations

import numpy as np
from scipy.optimize import least_squares

from solver.many import solve_many
from solver.reading import Reading, density_coefficients
from solver.scaling_law import scaling_height

FINE = (26, 25, (0.0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.47, 0.48, 0.49))
"""Number of strains and of β, and the ν of the grid on which the law was fitted."""

STIFF = 1e6
"""Axial stiffness: the law is that of a wire that does not stretch."""


def solved_grid(strains, betas, poissons):
    """Rows (strain, beta, poisson, reading, H) of buckled loops without slack fabric."""
    rows = []
    e, b, nu = (
        axis.ravel()
        for axis in np.meshgrid(
            np.linspace(0.01, 0.5, strains), np.geomspace(0.01, 0.25, betas), poissons
        )
    )
    for reading in Reading:
        found = solve_many(e, b, nu, reading, STIFF)
        good = (found.status == "converged") & found.buckled & ~found.slack
        heights = found.height_over_perimeter[good]
        rows += [
            (*numbers, reading, height)
            for *numbers, height in zip(e[good], b[good], nu[good], heights, strict=True)
        ]
    return rows


def errors(rows):
    """Errors of the law in H, one for each row."""
    return np.array([scaling_height(*scene) - height for *scene, height in rows])


def fitted(rows):
    """Coefficients (4, 2) of the slopes, by least squares in H."""
    a, b = np.array([density_coefficients(nu, reading) for _, _, nu, reading, _ in rows]).T
    strain, beta = np.array([row[:2] for row in rows], dtype=float).T
    heights = np.array([row[4] for row in rows])
    square = (1 + strain) ** 2
    weights = np.stack([-square * a, -2 * square * b, a + 2 * b, 12 * beta])
    excess = -weights.sum(axis=0)

    def residual(flat):
        linear, bent = np.maximum(flat.reshape(4, 2).T @ weights, -1e9)
        root = np.sqrt(np.maximum(linear**2 + 4 * bent * excess, 0))
        return np.sqrt(2 * excess / np.maximum(linear + root, 1e-9)) / np.pi - heights

    start = np.array([[-5.6, 6.9], [-5.5, 6.7], [-4.5, 3.0], [-2.9, -2.9]])
    return least_squares(residual, start.ravel(), diff_step=1e-4).x.reshape(4, 2)


def main():
    rows = solved_grid(*FINE)
    off = errors(rows)
    worst = rows[int(np.argmax(np.abs(off)))]
    print(f"{len(rows)} loops, largest error {np.abs(off).max():.5f} at {worst}")
    print(f"root of the mean square {np.sqrt(np.mean(off**2)):.5f}")
    print(np.round(fitted(rows), 3))


if __name__ == "__main__":
    main()
