"""The section [beam]: the strips of plastic inside sleeves, and how they are cut."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from patterns.beam import Beam, ConstraintStrip
from patterns.cut_piece import POLYCARBONATE_G_CM3, POLYCARBONATE_THICKNESS_MM
from patterns.cut_rules import CutLimits
from patterns.hooks import Barb, SleevePlace
from patterns.mat import MATS, Mat
from patterns.rivets import RivetHoles, joined_segments
from sesame_cad.specification.section import Section

WINDOW_ROOM_MM = 1.0
"""Between a sleeve and the constraint's window, on each side: for cutting and riveting by hand."""

RAMP_HEIGHTS = 2.0
"""Length of a hook's sloping back over its height: gentle enough for a loop to ride up."""


class BeamSection(Section):
    """Beams, the strips that hold their ends nearer, and the sheet that both are cut from."""

    length_mm: float = Field(
        default=160.0, ge=5, le=5000, description="the length in mm of a beam, one bistable segment"
    )
    width_mm: float = Field(
        default=20.0, ge=1, le=500, description="the width in mm of a beam without its hooks"
    )
    thickness_mm: float = Field(
        default=POLYCARBONATE_THICKNESS_MM,
        ge=0.01,
        le=10,
        description="the thickness in mm of the sheet",
    )
    modulus_GPa: float = Field(  # noqa: N815 - the unit's own spelling
        default=2.35, ge=1e-3, le=500, description="the sheet's elastic modulus in GPa"
    )
    poisson: float = Field(
        default=0.37, gt=-1, lt=0.5, description="the sheet's Poisson's ratio (no unit)"
    )
    density_g_cm3: float = Field(
        default=POLYCARBONATE_G_CM3, ge=0.1, le=25, description="the sheet's density in g/cm3"
    )
    constraint_length_mm: float = Field(
        default=156.0,
        ge=5,
        le=5000,
        description="the length in mm of the shorter strip that is riveted to both ends of a beam",
    )
    constraint_rail_mm: float = Field(
        default=4.0,
        ge=1,
        le=500,
        description=(
            "the width in mm of each of that strip's two rails, between which beam and sleeves pass"
        ),
    )
    hole_diameter_mm: float = Field(
        default=3.0, ge=0.5, le=50, description="the diameter in mm of the holes for rivet snaps"
    )
    hole_edge_diameters: float = Field(
        default=1.5,
        ge=0.5,
        le=5,
        description=(
            "the width of the sheet between a hole's edge and the strip's end, which is also the "
            "least to its sides, in diameters of the hole (no unit)"
        ),
    )
    corner_radius_mm: float = Field(
        default=2.0, ge=0.3, le=50, description="the radius in mm of the strips' corners"
    )
    hook_height_mm: float = Field(
        default=3.5,
        ge=1.2,
        le=20,
        description=(
            "the height in mm of the hooks beside a beam, which reach the ties of its compressed "
            "sleeve and hold it so"
        ),
    )
    frame_tabs: bool = Field(
        default=True,
        description=(
            "whether all beams hang in one frame until they are cut free, which keeps them at the "
            "rows' pitch (true or false)"
        ),
    )
    mat: Literal["scanncut-12x12", "scanncut-12x24", "sheet"] = Field(
        default="scanncut-12x12",
        description=(
            "the cutting machine's mat (a word); a sheet is of beam.sheet_width_mm by "
            "beam.sheet_height_mm"
        ),
    )
    sheet_width_mm: float = Field(
        default=300.0, ge=10, le=10_000, description="the width in mm of a sheet, if mat is sheet"
    )
    sheet_height_mm: float = Field(
        default=300.0, ge=10, le=10_000, description="the height in mm of a sheet, if mat is sheet"
    )
    spacing_mm: float = Field(
        default=3.0, ge=0, le=100, description="the distance in mm between pieces on the mat"
    )
    kerf_mm: float = Field(
        default=0.0,
        ge=0,
        le=2,
        description="the width in mm that the cut takes away; 0 for a blade",
    )
    overcut_mm: float = Field(
        default=0.0,
        ge=0,
        le=10,
        description=(
            "the length in mm by which a blade goes on past the start of a cut, 1 to 2 for one "
            "that leaves a bridge; lines in cut files are closed only with 0"
        ),
    )

    @property
    def hole_end_mm(self) -> float:
        """From the centre of the first and last hole to the strip's end."""
        return (self.hole_edge_diameters + 0.5) * self.hole_diameter_mm

    @property
    def segment_mm(self) -> float:
        """Distance of a beam's holes: the length that bends."""
        return self.length_mm - 2 * self.hole_end_mm

    @property
    def chord_mm(self) -> float:
        """Distance of the constraint strip's holes: the chord of the bent beam."""
        return self.constraint_length_mm - 2 * self.hole_end_mm

    @property
    def barb(self) -> Barb:
        """The shape of the hooks."""
        return Barb(height_mm=self.hook_height_mm, ramp_mm=RAMP_HEIGHTS * self.hook_height_mm)

    @property
    def reach_mm(self) -> float:
        """From the axis to the tip of a hook."""
        return self.width_mm / 2 + self.hook_height_mm

    @property
    def sleeve_room_mm(self) -> tuple[float, float]:
        """Begin and end, from the strip's left end, of the room for a sleeve on the left half.

        It begins past the constraint's end, for a sleeve must fit into the constraint's window.
        """
        past_constraint = 2 * self.hole_end_mm + WINDOW_ROOM_MM
        return max(past_constraint, self.corner_radius_mm + self.barb.reach_mm), self.length_mm / 2

    def window_mm(self, sewn_mm: float) -> float:
        """Width of the constraint's window for rows of loops that are so wide with their fabric.

        Stripes keep rows from growing wider than they are sewn.
        """
        return sewn_mm + 2 * WINDOW_ROOM_MM

    @property
    def limits(self) -> CutLimits:
        """What cut pieces keep to."""
        return CutLimits(hole_edge_diameters=self.hole_edge_diameters)

    @property
    def sheet(self) -> Mat:
        """What pieces are cut from."""
        if self.mat == "sheet":
            return Mat(self.sheet_width_mm, self.sheet_height_mm)
        return MATS[self.mat]

    def beam(self, place: SleevePlace) -> Beam:
        """Give a beam that holds a sleeve at a place."""
        holes = self._holes(self.segment_mm)
        size = self.length_mm, self.width_mm
        return Beam(*size, holes, self.corner_radius_mm, (place,), self.barb)

    def constraint(self, sewn_mm: float) -> ConstraintStrip:
        """Give the strip that holds a beam's ends nearer, for rows that are so wide as sewn."""
        holes, window = self._holes(self.chord_mm), self.window_mm(sewn_mm)
        size = self.constraint_length_mm, window + 2 * self.constraint_rail_mm
        return ConstraintStrip(*size, holes, self.corner_radius_mm, window)

    def _holes(self, apart_mm: float) -> RivetHoles:
        return joined_segments(1, apart_mm, self.hole_end_mm, self.hole_diameter_mm)
