"""Measure the error of `solver.scaling_law`, and fit its coefficients; run with ``python -m``.

Every loop of Fig. 2 is solved in the smooth basis, in both readings, with a wire that does not
stretch, with the default one, and at random with softer ones. It is counted where the law does not
know its error, and what it overlooks where it does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares

from solver.ladder.law import law_error
from solver.many import solve_many
from solver.reading import Reading, density_coefficients
from solver.scaling_law import scaling_height, scaling_loop
from solver.scene import LoopScene

FINE = (40, 37, (0.0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.47, 0.48, 0.485, 0.49))
"""Number of strains and of β, and the ν of the grid on which the law was fitted."""

STIFFNESSES = (1e6, 1000.0)
"""Axial stiffnesses on that grid: of a wire that does not stretch, and the default."""

SOFTEST = 1.0
RANDOM = 10_000
"""Loops at random in each reading, with an axial stiffness from the softest to 10⁴ times it."""

HIGHEST_DEGREE = 15
"""Of bases for loops that are slack: the law must not know them, so their height is not needed."""


@dataclass(frozen=True, slots=True)
class Compared:
    """A loop, its height and that of the law, and the law's stated error, both absolute."""

    strain: float
    beta: float
    poisson: float
    reading: Reading
    axial_stiffness: float
    height: float
    law: float
    stated: float
    settled: bool
    sound: bool
    """Whether the fabric is taut and the wire does not meet itself."""

    @property
    def known(self):
        """Whether the law knows its error."""
        return np.isfinite(self.stated)

    @property
    def off(self):
        """Error of the law."""
        return self.law - self.height


def grid(strains, betas, poissons):
    """Strains, β and ν of all points of a grid over Fig. 2; a quarter of the strains are small."""
    few = strains // 4
    strain = np.concatenate([[0.0], np.geomspace(0.001, 0.04, few - 1)])
    strain = np.concatenate([strain, np.linspace(0.05, 0.5, strains - few)])
    axes = np.meshgrid(strain, np.geomspace(0.01, 0.25, betas), poissons)
    return tuple(axis.ravel() for axis in axes)


def at_random(count, seed=1):
    """Strains, β, ν and axial stiffnesses of loops at random, more of them at small strains."""
    strain, beta, poisson, soft = np.random.default_rng(seed).uniform(size=(4, count))
    return 0.5 * strain**1.5, 0.01 * 25**beta, 0.49 * np.sqrt(poisson), SOFTEST * 1e4**soft


def compared(strain, beta, poisson, reading, stiffness):
    """Solve loops, arrays or numbers that broadcast, in the smooth basis and by the law."""
    numbers = np.broadcast_arrays(strain, beta, poisson, stiffness)
    e, b, nu, k = numbers
    found = solve_many(e, b, nu, reading, k, highest_degree=HIGHEST_DEGREE)
    settled = found.status == "converged"
    sound = ~found.slack & ~found.meets
    rows = []
    listed = (axis.tolist() for axis in (*numbers, found.height_over_perimeter, settled, sound))
    for e, b, nu, k, height, done, fine in zip(*listed, strict=True):
        scene = LoopScene(e, b, nu, reading, k)
        law = scaling_height(e, b, nu, reading, k)
        stated = law_error(scene) * (law if law > 0 else 1.0)
        rows.append(Compared(e, b, nu, reading, k, height, law, stated, done, fine))
    return rows


def fitted(rows):
    """Coefficients (4, 2) of the slopes, by least squares in H, of wires that do not stretch."""
    a, b = np.array([density_coefficients(row.poisson, row.reading) for row in rows]).T
    strain, beta, heights = np.array([(row.strain, row.beta, row.height) for row in rows]).T
    square = (1 + strain) ** 2
    weights = np.stack([-square * a, -2 * square * b, a + 2 * b, 12 * beta])
    excess = -weights.sum(axis=0)

    def residual(flat):
        linear, bent = np.maximum(flat.reshape(4, 2).T @ weights, -1e9)
        root = np.sqrt(np.maximum(linear**2 + 4 * bent * excess, 0))
        return np.sqrt(2 * excess / np.maximum(linear + root, 1e-9)) / np.pi - heights

    start = np.array([[-5.6, 6.9], [-5.5, 6.7], [-4.5, 3.0], [-2.9, -2.9]])
    return least_squares(residual, start.ravel(), diff_step=1e-4).x.reshape(4, 2)


def nearness(row):
    """Of a loop that is not sound: how near the law comes to knowing it; known from 1 on."""
    if row.sound:
        return 0.0
    numbers = (row.strain, row.beta, row.poisson, row.reading, row.axial_stiffness)
    found = scaling_loop(*numbers)
    return found.below_threshold / found.taut_above if np.isfinite(found.error) else 0.0


def tell(name, rows):
    """Print what the law knows of buckled loops, and its errors there."""
    rows = [row for row in rows if row.height > 0 or row.law > 0 or not row.sound]
    known = [row for row in rows if row.known]
    missed = sum(not row.sound for row in known)
    open_ones = sum(not row.settled for row in known)
    other = sum((row.height > 0) != (row.law > 0) for row in known)
    taut = [row for row in known if row.settled and row.law > 0]
    off = np.abs([row.off for row in taut])
    share = off / [row.stated for row in taut]
    unsound = sum(not row.sound for row in rows)
    print(f"{name}: {len(rows)} buckled, of which {unsound} are slack or meet themselves")
    print(
        f"  known {len(known)}; among them unsound {missed}, flat by one alone {other}, "
        f"not settled in the smooth basis {open_ones}"
    )
    if unsound:
        print(f"  unsound ones come as near as {max(map(nearness, rows)):.3f} to being known")
    print(f"  largest error {off.max():.5f} at {taut[int(off.argmax())]}")
    print(f"  at most {share.max():.3f} of what is stated, at {taut[int(share.argmax())]}")
    print(f"  root of the mean square {np.sqrt(np.mean(off**2)):.5f}", flush=True)


def main():
    stiff = []
    for stiffness in STIFFNESSES:
        for reading in Reading:
            rows = compared(*grid(*FINE), reading, stiffness)
            tell(f"{reading}, k = {stiffness:g}", rows)
            stiff += [row for row in rows if stiffness == max(STIFFNESSES)]
    for reading in Reading:
        *numbers, stiffness = at_random(RANDOM)
        tell(f"{reading}, k at random", compared(*numbers, reading, stiffness))
    stiff = [row for row in stiff if row.known and row.settled and row.height > 0]
    print(np.round(fitted(stiff), 3))


if __name__ == "__main__":
    main()
