"""Broken design rules, drawn in red on the plan."""

from __future__ import annotations

from pathlib import Path

from patterns.violation import Violation
from sesame_cad.errors import InputError
from sesame_cad.files.faults_svg import faults_svg
from sesame_cad.pictures.faults import faults_picture
from sesame_cad.pipeline import Pattern
from sesame_cad.specification import Specification
from sesame_cad.staging import replace_file

KINDS = (".svg", ".png")


def check_picture_name(target: Path) -> None:
    """Refuse names that do not say which kind of picture is wanted.

    Raises
    ------
    InputError
    """
    if target.suffix not in KINDS:
        raise InputError(f"--faults = {str(target)!r}: must end in {' or '.join(KINDS)}")


def draw_broken_rules(
    target: Path, spec: Specification, laid: Pattern, violations: tuple[Violation, ...]
) -> None:
    """Draw the plan with a red circle at each violation, and write it as SVG or PNG.

    Raises
    ------
    InputError
        When the picture cannot be written there.
    """
    if target.suffix == ".png":
        replace_file(target, faults_picture(laid, violations))
    else:
        drawing = faults_svg(laid, violations, spec.diameters_mm, spec.name)
        replace_file(target, drawing.encode())
