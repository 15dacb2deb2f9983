"""A cell under a slab: its height against load and temperature, and the load that flattens it.

The force of a loop pressed between plates grows as they close, up to a largest force F_max, and
falls from there to nothing: the flat loop is an equilibrium without force. Under a dead load W a
loop therefore stands where F = W on the falling side, and no lower; with W > F_max it snaps flat.
Flat it stays as long as the load lies on it, however its stiffness changes: to rise by a small
amplitude costs work in proportion to it, and frees energy in proportion to its square only.
"""

from __future__ import annotations

from scipy.optimize import brentq

from solver.errors import NotConvergedError, SceneError
from solver.held import solve_between_plates
from solver.held_equilibrium import HeldEquilibrium
from solver.plates import PlateAxis, Plates
from solver.scene import LoopScene

PRESSED_TO = (1.0, 0.97, 0.93, 0.88, 0.82, 0.76, 0.70, 0.64, 0.58, 0.52, 0.46)
"""Heights, in units of the free one, at which the force is solved; the largest force lies at about
0.6 for all strains and stiffnesses that were tried."""

_PRESS_TOLERANCE = 5e-3


def pressed(
    scene: LoopScene,
    height: float,
    start: HeldEquilibrium | None = None,
    *,
    tolerance: float = _PRESS_TOLERANCE,
) -> HeldEquilibrium:
    """Press a cell to a height, that of the wire's centreline; its ``force`` is that of the slab.

    Raises
    ------
    NotConvergedError
        When there is no shape to rely on.
    """
    plates = Plates(height, PlateAxis.HEIGHT)
    return solve_between_plates(scene, plates, tolerance=tolerance, start=start)


def stands_at(scene: LoopScene, free_height: float, load: float) -> HeldEquilibrium:
    """Find where a cell carries a load, by solving it there.

    Parameters
    ----------
    free_height : float
        Without load.
    load : float
        On this cell, in units of E_f t R, greater than 0.

    Raises
    ------
    SceneError
        When the load is not positive.
    NotConvergedError
        When it flattens the cell.
    """
    if not load > 0:
        raise SceneError(f"load = {load:g}: must be greater than 0")
    known: dict[float, HeldEquilibrium] = {}

    def excess(height: float) -> float:
        nearest = min(known, key=lambda other: abs(other - height), default=None)
        start = None if nearest is None else known[nearest]
        known[height] = pressed(scene, height, start)
        return known[height].force - load

    above = free_height
    for share in PRESSED_TO[1:]:
        height = share * free_height
        if excess(height) > 0:
            found = float(brentq(excess, height, above, xtol=1e-5 * free_height))
            return known[found] if found in known else pressed(scene, found, known[height])
        if known[height].force < known.get(above, known[height]).force:
            break
        above = height
    largest = max(one.force for one in known.values())
    raise NotConvergedError(
        f"load = {load:g}: flattens the cell, which carries no more than about {largest:.3g}; use "
        "a lighter load or more cells"
    )
