"""What is cut from the sheet of plastic: beams, constraint strips, and a coupon to try it on."""

from __future__ import annotations

from dataclasses import dataclass

from shapely import Polygon

from patterns.beam import Beam, ConstraintStrip
from patterns.beam_rules import check_beam, check_constraint
from patterns.cut_coupon import hole_coupon, kerf_coupons
from patterns.cut_order import Cut, cuts_in_order
from patterns.cut_piece import CutPiece, numbered
from patterns.cut_rules import check_piece
from patterns.frame_tabs import Frame, framed_beams
from patterns.nest_rules import NestedMat, check_nest
from patterns.nesting import nest
from patterns.violation import Violation
from sesame_cad.specification import Specification

_HOLE_STEPS_MM = (-0.2, -0.1, 0.0, 0.1, 0.2)
_KERF_STEPS_MM = (0.0, 0.1, 0.2)
_SQUARE_MM = 20.0


@dataclass(frozen=True)
class Sheet:
    """A sheet and the lines that are cut from it, in order.

    Attributes
    ----------
    name : str
        What its files are called, after the design's name.
    nested : NestedMat
    cuts : tuple of Cut
    """

    name: str
    nested: NestedMat
    cuts: tuple[Cut, ...]


@dataclass(frozen=True)
class Cutting:
    """Everything that is cut.

    Attributes
    ----------
    count : int
        Of beams, and of constraint strips.
    beam : Beam
    constraint : ConstraintStrip
    laid : tuple of CutPiece
        What is laid between the layers of loops, where it is laid: the frame with all beams, or
        each beam; in the hoop's coordinates.
    sheets : tuple of Sheet
    """

    count: int
    beam: Beam
    constraint: ConstraintStrip
    laid: tuple[CutPiece, ...]
    sheets: tuple[Sheet, ...]

    @property
    def shapes(self) -> tuple[Polygon, ...]:
        """The pieces that are laid, as polygons."""
        return tuple(piece.polygon() for piece in self.laid)


def cutting(spec: Specification) -> Cutting:
    """Lay out the pieces of a design.

    Raises
    ------
    PatternError
        When pieces do not fit on the sheet, or round corners have no room.
    """
    count, beam = spec.layout.rows or 0, spec.beam.beam(spec.sleeve_place)
    strip = spec.constraint
    laid = _laid(spec, beam, count)
    mat, kerf = spec.beam.sheet, spec.beam.kerf_mm
    spacing = spec.beam.spacing_mm + kerf
    pieces = (*laid, *numbered(strip.piece(), count))
    mats = nest(pieces, mat, spacing)
    sheets = [
        _sheet(spec, f"beams-{k}" if len(mats) > 1 else "beams", nested)
        for k, nested in enumerate(mats, start=1)
    ]
    coupons = nest(_coupons(spec), mat, spacing + max(_KERF_STEPS_MM))
    sheets += [_sheet(spec, "coupon", nested) for nested in coupons]
    return Cutting(count, beam, strip, laid, tuple(sheets))


def cutting_violations(spec: Specification, made: Cutting) -> tuple[Violation, ...]:
    """Hold beams, strips, frame and sheets against the rules of cutting."""
    limits = spec.beam.limits
    framed = (fault for piece in made.laid for fault in check_piece(piece, limits))
    return (
        *check_beam(made.beam, limits),
        *check_constraint(made.constraint, made.beam, limits),
        *(framed if spec.beam.frame_tabs else ()),
        *(fault for one in made.sheets for fault in check_nest(one.nested, spec.beam.kerf_mm)),
    )


def _laid(spec: Specification, beam: Beam, count: int) -> tuple[CutPiece, ...]:
    pitch = spec.layout.pitch_of_rows_mm
    if spec.beam.frame_tabs:
        return (framed_beams(beam, count, Frame(pitch)),)
    axes = [(k - (count - 1) / 2) * pitch for k in range(count)]
    pieces = zip(numbered(beam.piece(), count), axes, strict=True)
    return tuple(piece.moved(0.0, axis) for piece, axis in pieces)


def _sheet(spec: Specification, name: str, nested: NestedMat) -> Sheet:
    section = spec.beam
    return Sheet(name, nested, cuts_in_order(nested.pieces, section.kerf_mm, section.overcut_mm))


def _coupons(spec: Specification) -> tuple[CutPiece, ...]:
    """Holes of diameters about the one that is asked for, and squares for kerfs about the own."""
    section = spec.beam
    holes = [section.hole_diameter_mm + step for step in _HOLE_STEPS_MM]
    own = max(0.0, section.kerf_mm - _KERF_STEPS_MM[1])
    kerfs = [round(own + step, 6) for step in _KERF_STEPS_MM]
    return (
        hole_coupon(holes, section.hole_edge_diameters),
        *kerf_coupons(kerfs, _SQUARE_MM),
    )
