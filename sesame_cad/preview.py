"""Printable previews of an array: flat in the hoop, cold and hot."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import trimesh

from sesame_cad.bodies import Body, flat_bodies, released_bodies
from sesame_cad.pipeline import Design
from sesame_cad.shape_state import ShapeState
from sesame_cad.solids import array_solid, union_solid
from sesame_cad.specification import Specification


def state_solid(spec: Specification, state: ShapeState) -> trimesh.Trimesh:
    """Solid of the released array."""
    return joined(released_bodies(spec, state))


def flat_solid(spec: Specification, state: ShapeState) -> trimesh.Trimesh:
    """Solid of the array as it is sewn."""
    return joined(flat_bodies(spec, state))


def joined(bodies: tuple[Body, ...]) -> trimesh.Trimesh:
    """Join bodies that all stand in the same places into one solid.

    Raises
    ------
    InputError
        When the union does not come out as one closed solid.
    """
    one = union_solid((body.points, body.faces) for body in bodies)
    places = bodies[0].places_mm
    return array_solid(one, places) if len(places) > 1 else one


def previews(
    design: Design, progress: Callable[[str], None] = lambda _: None
) -> Iterator[tuple[str, tuple[Body, ...]]]:
    """Give the three previews by name, one after the other; none of a design without a shape."""
    for state in design.states[:1]:
        progress("preview: flat")
        yield "flat", flat_bodies(design.spec, state)
    for state in design.states:
        progress(f"preview: {state.name}")
        yield state.name, released_bodies(design.spec, state)
