import pytest

from solver.materials import LoopMaterials
from solver.sleeve.cell import SleeveCell

SMALL = LoopMaterials(7e5, 0.27e-3, 28e9, 0.3e-3, 12.5e-3)
"""The small array's loop of the paper's Table I."""


@pytest.fixture(scope="session")
def cell():
    return SleeveCell(SMALL, strain=0.3, poisson=0.45, stripe_m=0.025)
