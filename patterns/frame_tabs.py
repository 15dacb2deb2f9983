"""A frame that holds parallel beams at the sleeves' pitch until they are cut free."""

from __future__ import annotations

from dataclasses import dataclass, replace

from patterns.beam import Beam, below
from patterns.contour import Contour
from patterns.cut_piece import CutPiece
from patterns.errors import PatternError
from patterns.positive import check_positive
from patterns.rounding import Corner, rounded


@dataclass(frozen=True, slots=True)
class Frame:
    """How beams hang in a frame: by a tab at each end, on the axis.

    Attributes
    ----------
    pitch_mm : float
        Distance of neighbouring beams' axes. The frame is as far from the outer beams as from the
        middle between two, so that no needle meets it beside a sleeve that is no wider.
    tab_width_mm, tab_length_mm : float
        Of the tabs between a beam's end and the frame.
    tab_radius_mm : float
        Of the corners at both ends of a tab, and of the openings' other corners.
    border_mm : float
        Width of the frame's four bars.
    corner_radius_mm : float
        Of the frame's outer corners.
    """

    pitch_mm: float
    tab_width_mm: float = 1.5
    tab_length_mm: float = 4.0
    tab_radius_mm: float = 0.5
    border_mm: float = 8.0
    corner_radius_mm: float = 3.0

    def __post_init__(self) -> None:
        """Refuse what is no frame."""
        check_positive(
            "frame",
            pitch_mm=self.pitch_mm,
            tab_width_mm=self.tab_width_mm,
            tab_length_mm=self.tab_length_mm,
            tab_radius_mm=self.tab_radius_mm,
            border_mm=self.border_mm,
            corner_radius_mm=self.corner_radius_mm,
        )

    def size_mm(self, beam_length_mm: float, count: int) -> tuple[float, float]:
        """Width and height of the frame around so many beams."""
        width = beam_length_mm + 2 * (self.tab_length_mm + self.border_mm)
        return width, count * self.pitch_mm + 2 * self.border_mm


def framed_beams(beam: Beam, count: int, frame: Frame, name: str = "framed beams") -> CutPiece:
    """Give beams and frame as one piece; what lies between them are openings.

    Parameters
    ----------
    beam : Beam
        Every one of the beams.
    count : int
        How many there are, one above the other; the centre of all is the origin.
    frame : Frame
        What holds them.

    Raises
    ------
    PatternError
        When there is no beam, beams would meet, or tabs and round corners have no room.
    """
    check_positive("frame", beams=count)
    widest = beam.width_mm + 2 * beam.hook_height_mm
    if frame.pitch_mm <= widest:
        raise PatternError(
            f"no frame with a pitch of {frame.pitch_mm:g} mm: it must be greater than "
            f"{widest:g} mm, the width of a beam with its hooks"
        )
    axes = [(k - (count - 1) / 2) * frame.pitch_mm for k in range(count)]
    low, high = axes[0] - frame.pitch_mm / 2, axes[-1] + frame.pitch_mm / 2
    lines = [_bar(beam, frame, low)]
    for axis in axes:
        lines += [_lower_side(beam, frame, axis), _upper_side(beam, frame, axis)]
    lines.append(_bar(beam, frame, high))
    openings = tuple(
        rounded((*under, *reversed(over))).reversed()
        for under, over in zip(lines[::2], lines[1::2], strict=True)
    )
    own = beam.piece(name)
    holes = tuple(replace(hole, y_mm=axis) for axis in axes for hole in own.holes)
    return CutPiece(name, _around(beam, frame, low, high), holes, openings)


def _inner_mm(beam: Beam, frame: Frame) -> float:
    """Half the distance between the frame's left and right bar."""
    return beam.length_mm / 2 + frame.tab_length_mm


def _bar(beam: Beam, frame: Frame, y_mm: float) -> tuple[Corner, ...]:
    """A bar's inner edge, from left to right."""
    x, radius = _inner_mm(beam, frame), frame.tab_radius_mm
    return Corner(-x, y_mm, radius), Corner(x, y_mm, radius)


def _upper_side(beam: Beam, frame: Frame, axis_mm: float) -> tuple[Corner, ...]:
    """The upper side of a beam and its two tabs, from left to right."""
    return tuple(
        Corner(corner.x_mm, corner.y_mm + axis_mm, corner.radius_mm)
        for corner in _side(beam, frame)
    )


def _lower_side(beam: Beam, frame: Frame, axis_mm: float) -> tuple[Corner, ...]:
    return tuple(
        Corner(corner.x_mm, corner.y_mm + axis_mm, corner.radius_mm)
        for corner in below(_side(beam, frame))
    )


def _side(beam: Beam, frame: Frame) -> tuple[Corner, ...]:
    end, inner = beam.length_mm / 2, _inner_mm(beam, frame)
    y, radius = frame.tab_width_mm / 2, frame.tab_radius_mm
    left = Corner(-inner, y, radius), Corner(-end, y, radius)
    right = Corner(end, y, radius), Corner(inner, y, radius)
    return (*left, *beam.edge_corners(), *right)


def _around(beam: Beam, frame: Frame, low_mm: float, high_mm: float) -> Contour:
    x = _inner_mm(beam, frame) + frame.border_mm
    bottom, top = low_mm - frame.border_mm, high_mm + frame.border_mm
    places = ((-x, bottom), (x, bottom), (x, top), (-x, top))
    return rounded([Corner(*place, frame.corner_radius_mm) for place in places])
