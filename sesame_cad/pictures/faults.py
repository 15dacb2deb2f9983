"""The picture of the wire's way, with broken rules in red."""

from __future__ import annotations

from textwrap import wrap

from matplotlib.axes import Axes

from patterns.numbered_faults import NumberedFaults, numbered_faults
from patterns.violation import Violation
from sesame_cad.pictures.canvas import png_bytes
from sesame_cad.pictures.plan import plan_figure
from sesame_cad.pipeline import Pattern

RED = "#e00000"

_CHARACTERS = 125
"""Characters of the legend's font in the figure's width."""

_FONT_SIZE, _LINE_IN = 7, 0.14


def faults_picture(laid: Pattern, violations: tuple[Violation, ...]) -> bytes:
    """Draw the plan with a circle around each violation, and a legend above; a PNG."""
    figure = plan_figure(laid.circuit, laid.plan, laid.outline, laid.marks)
    rules = numbered_faults(violations)
    for rule in rules:
        _draw_rule(figure.axes[0], rule)
    lines = [part for rule in rules for line in rule.legend() for part in wrap(line, _CHARACTERS)]
    figure.set_figheight(figure.get_figheight() + _LINE_IN * len(lines))
    figure.suptitle("\n".join(lines), x=0.02, ha="left", fontsize=_FONT_SIZE, color=RED)
    return png_bytes(figure)


def _draw_rule(axes: Axes, rule: NumberedFaults) -> None:
    places = [*(violation for _, violation in rule.numbered), *rule.others]
    x, y = [one.x_mm for one in places], [one.y_mm for one in places]
    axes.scatter(x, y, s=80, facecolors="none", edgecolors=RED, linewidths=1.2, zorder=10)
    for place, text in rule.labels().items():
        axes.annotate(
            text,
            place,
            xytext=(6, 6),
            textcoords="offset points",
            color=RED,
            fontsize=9,
            fontweight="bold",
            zorder=11,
        )
