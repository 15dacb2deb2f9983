"""Shapes that come near themselves by a known distance."""

import numpy as np
import pytest
from scipy.optimize import brentq

from solver.mesh.loop_mesh import loop_fan
from solver.mesh.triangulation import embedded, refinements


@pytest.fixture(scope="session")
def rolled_disc():
    return _rolled_disc


def _rolled_disc(gap, refinement=2):
    """Mesh, and positions of the disc rolled to a tube whose opposite rims are ``gap`` apart."""
    mesh = refinements(loop_fan(), refinement)[-1]
    short = brentq(lambda d: 2 * np.sin(d) / (np.pi - d) - gap, -0.5, 1)
    radius = 1 / (np.pi - short)
    positions = embedded(mesh.points)
    angle = positions[:, 0] / radius
    positions[:, 0], positions[:, 2] = radius * np.sin(angle), radius * np.cos(angle)
    return mesh, positions
