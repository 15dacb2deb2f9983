"""Force and height of a sleeve against its pitch."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure

from sesame_cad.pictures.canvas import png_bytes
from sesame_cad.pictures.landscape import COLD_LINE
from sesame_cad.pictures.shapes import INK, WIRE
from sesame_cad.sleeve_prediction.curves import ForceCurve
from solver.sleeve.segment import SegmentPrediction


def sleeve_force_picture(prediction: SegmentPrediction, curves: Sequence[ForceCurve]) -> bytes:
    """Draw curves cold and hot, the compressed pitch marked; a PNG."""
    figure = Figure(figsize=(8.0, 4.2), layout="constrained")
    force, height = figure.subplots(1, 2)
    for curve in curves:
        colour = COLD_LINE if curve.temperature == "cold" else WIRE
        force.plot(curve.pitch_mm, curve.force_N, color=colour, label=curve.temperature)
        height.plot(curve.pitch_mm, curve.crest_height_mm, color=colour, label=curve.temperature)
    pitch_mm = prediction.segment.pitch_m * 1e3
    for couple, colour in ((prediction.cold, COLD_LINE), (prediction.hot, WIRE)):
        force.plot(pitch_mm, couple.force_N, "o", color=colour)
        height.plot(pitch_mm, couple.pressed.crest_height_m * 1e3, "o", color=colour)
        force.annotate(
            f"{couple.force_N:.2f} N",
            (pitch_mm, couple.force_N),
            (6, 6),
            textcoords="offset points",
            color=colour,
        )
    for axes, label in ((force, "push along the beam, N"), (height, "crests over valleys, mm")):
        axes.axvline(pitch_mm, color=INK, linewidth=0.8, linestyle=":")
        axes.set_xlabel("pitch of the loops, mm")
        axes.set_ylabel(label)
        axes.set_ylim(bottom=0)
        axes.spines[["top", "right"]].set_visible(False)
    force.legend(frameon=False)
    figure.suptitle(f"a sleeve, held at a pitch of {pitch_mm:.1f} mm", fontsize=11, color=INK)
    return png_bytes(figure)
