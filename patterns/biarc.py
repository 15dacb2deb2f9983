"""Two circular arcs that join two points smoothly in given directions."""

from __future__ import annotations

import numpy as np

from patterns.path import Arc, Vectors


def biarcs(points_mm: Vectors, tangents: Vectors) -> tuple[Arc, ...]:
    """Run arcs through points, two from each point to the next, without a kink.

    The two arcs between points p and q with unit tangents t and u have control triangles with legs
    of one length d, from |p + d t - (q - d u)| = 2 d (K. M. Bolton, Biarc curves, Computer-Aided
    Design 7, 1975, 89-92).

    Parameters
    ----------
    points_mm, tangents : array (n, 2)
        Along a curve that turns one way, by less than half a turn from point to point.
    """
    start, end = points_mm[:-1], points_mm[1:]
    leaves, arrives = tangents[:-1], tangents[1:]
    chord = end - start
    ahead = np.sum(chord * (leaves + arrives), axis=1)
    square = np.sum(chord**2, axis=1)
    bend = 2 * (1 - np.sum(leaves * arrives, axis=1))
    # the root in the form that stays exact when the tangents are nearly parallel
    leg = square / (ahead + np.sqrt(ahead**2 + bend * square))
    middle = (start + end + leg[:, None] * (leaves - arrives)) / 2
    first = _arcs(start, leaves, middle)
    second = _arcs(end, -arrives, middle)
    return tuple(
        arc for one, back in zip(first, second, strict=True) for arc in (one, _reversed(back))
    )


def _arcs(start: Vectors, along: Vectors, end: Vectors) -> list[Arc]:
    """Arcs that leave points in given directions and lead to other points."""
    chord = end - start
    left = np.stack([-along[:, 1], along[:, 0]], axis=1)
    aside, ahead = np.sum(left * chord, axis=1), np.sum(along * chord, axis=1)
    radius = np.sum(chord**2, axis=1) / (2 * aside)  # negative to the right
    centre = start + radius[:, None] * left
    outward = -np.sign(radius)[:, None] * left
    begin = np.arctan2(outward[:, 1], outward[:, 0])
    sweep = 2 * np.arctan2(aside, ahead)
    rows = np.column_stack([centre, np.abs(radius), begin, sweep]).tolist()
    return [Arc(*row) for row in rows]


def _reversed(arc: Arc) -> Arc:
    circle = (arc.centre_x_mm, arc.centre_y_mm, arc.radius_mm)
    return Arc(*circle, arc.start_rad + arc.sweep_rad, -arc.sweep_rad)
