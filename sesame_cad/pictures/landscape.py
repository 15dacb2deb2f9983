"""The energy of a segment on its way from one state to the other."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from sesame_cad.pictures.canvas import png_bytes
from sesame_cad.pictures.shapes import INK, WIRE
from solver.errors import NotConvergedError
from solver.sleeve.segment import SegmentPrediction
from solver.strip.landscape import Landscape, energy_to_minus
from solver.strip.scene import StripScene
from solver.strip.state import Side

COLD_LINE = "#2F4B6E"


def landscape_picture(prediction: SegmentPrediction) -> bytes:
    """Draw the energy from state + to state −, cold and with the lower sleeve hot; a PNG."""
    figure = Figure(figsize=(8.0, 4.6), layout="constrained")
    axes = figure.subplots()
    rest = energy_to_minus(prediction.rest.scene)
    zero = prediction.rest.unloaded[Side.UP].bending_J
    _draw(axes, rest, zero, COLD_LINE, "both sleeves cold")
    for label, scene in _hot_scenes(prediction):
        hot = _landscape(scene)
        if hot is not None:
            _draw(axes, hot, float(hot.energy_J[0]), WIRE, label)
            break
    _mark_barrier(axes, rest, prediction)
    axes.set_xticks([0, 90, 180], ["state +", "S-shaped", "state -"])
    axes.set_xlabel("phase of the beam's shape")
    axes.set_ylabel("energy from state + on, mJ")
    axes.spines[["top", "right"]].set_visible(False)
    axes.legend(frameon=False, loc="lower left")
    axes.set_title(_title(prediction), fontsize=11, color=INK)
    return png_bytes(figure)


def _hot_scenes(prediction: SegmentPrediction) -> Iterator[tuple[str, StripScene]]:
    """Give the segment with its lower sleeve hot, and, far below that, just as it snaps."""
    heated, critical = prediction.heated.scene, prediction.critical_couple_N_m
    yield "lower sleeve hot", heated
    if critical is not None:
        snapping = replace(heated, couple_bottom_N_m=critical, couple_top_N_m=0.0)
        yield "lower sleeve warm enough to snap it", snapping


def _landscape(scene: StripScene) -> Landscape | None:
    """Give none under couples so large that nothing comes to rest at some phase."""
    try:
        return energy_to_minus(scene)
    except NotConvergedError:
        return None


def _draw(axes: Axes, found: Landscape, zero: float, colour: str, label: str) -> None:
    energy = 1e3 * (found.energy_J - zero)
    axes.plot(np.rad2deg(found.phase_rad), energy, color=colour, label=label, linewidth=2)


def _mark_barrier(axes: Axes, rest: Landscape, prediction: SegmentPrediction) -> None:
    barrier = prediction.barrier_J
    if barrier is None:
        return
    phase = float(np.rad2deg(rest.phase_rad[int(np.argmax(rest.energy_J))]))
    axes.plot([phase, phase], [0.0, 1e3 * barrier], color=INK, linewidth=1, linestyle=":")
    axes.text(phase + 3, 5e2 * barrier, f"barrier {1e3 * barrier:.2f} mJ", color=INK)


def _title(prediction: SegmentPrediction) -> str:
    critical = prediction.critical_couple_N_m
    if critical is None:
        return "no couple snaps the segment"
    does = "snaps" if prediction.snaps else "does not snap"
    return (
        f"heating one side {does} the segment: {prediction.couple_N_m * 1e3:.2f} N mm, "
        f"critical {critical * 1e3:.2f} N mm"
    )
