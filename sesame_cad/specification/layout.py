"""The section [layout]: where the loops lie."""

from __future__ import annotations

from math import radians
from typing import Annotated, Literal

from pydantic import Field

from patterns.lattice import Lattice, centred, lattice_cells, lattice_loops, row_loops, rows_apart
from patterns.layout import ROUNDED_MM, TANGENCY_TOLERANCE_MM
from patterns.loop import Cell, Loop
from patterns.terminals import Side
from sesame_cad.specification.section import Allowed, Section

Kind = Literal["grid", "brick", "hexagonal", "row", "circles", "sleeve"]

TILING = ("grid", "row")
"""Kinds whose loops have contacts a quarter turn apart."""

SLEEVE = "sleeve"
"""The kind whose rows lie apart, a beam along each."""

ROW_ROOM_MM = 8.0
"""Between the rows of sleeves, if their pitch is left out: for ties, needle and margins."""

_UPRIGHT_DEG = 90

CELL = Allowed("a list, each item a row and a column, such as [[1, 1], [2, 4]]")
CIRCLES = Allowed(
    "a list, each item with three numbers, such as {x_mm = 0, y_mm = 0, diameter_mm = 25}, and for "
    "an ellipse axis_ratio and axis_angle_deg"
)
DIAMETERS = Allowed("a list, each item a number from 0.1 to 10000, such as [25, 30, 25]")

LARGEST_AXIS_RATIO = 5


class Circle(Section):
    """One loop of an arrangement that is given loop by loop."""

    x_mm: float = Field(description="the centre's place in mm, to the right")
    y_mm: float = Field(description="the centre's place in mm, away from the operator")
    diameter_mm: float = Field(ge=0.1, le=10_000, description="the loop's diameter in mm")
    axis_ratio: float = Field(
        default=1.0, ge=1, le=LARGEST_AXIS_RATIO, description="its length over its width (no unit)"
    )
    axis_angle_deg: float = Field(
        default=0.0, ge=-360, le=360, description="direction of its length in degrees"
    )

    def loop(self) -> Loop:
        """Give the loop as the geometry knows it."""
        angle = radians(self.axis_angle_deg)
        return Loop(self.x_mm, self.y_mm, self.diameter_mm, self.axis_ratio, angle)


class LayoutSection(Section):
    """Tangent loops: on a lattice, some left out, any circles and ellipses, or rows of sleeves."""

    kind: Kind = Field(
        default="grid",
        description=(
            "the arrangement of the loops (a word): a square grid; rows that are shifted by half a "
            "loop in turn, all equally long (brick) or clipped to the first row's width "
            "(hexagonal); one row; any tangent circles and ellipses; or two layers of rows apart, "
            "each row around a beam of plastic, which it bends (sleeve)"
        ),
    )
    rows: int | None = Field(
        default=None, ge=1, le=200, description="the number of rows of loops (a count)"
    )
    columns: int | None = Field(
        default=None, ge=1, le=200, description="the number of loops in a row (a count)"
    )
    loop_diameter_mm: float | None = Field(
        default=None,
        ge=0.1,
        le=10_000,
        description="the diameter in mm of the wire's centreline in a loop, in the hoop",
    )
    row_pitch_mm: float = Field(
        default=0.0,
        ge=0,
        le=10_000,
        description=(
            "the distance in mm of neighbouring rows of sleeves, which is that of their beams; 0 "
            f"is {ROW_ROOM_MM:g} mm more than the loops' diameter"
        ),
    )
    diameters_mm: Annotated[tuple[Annotated[float, Field(ge=0.1, le=10_000)], ...], DIAMETERS] = (
        Field(
            default=(),
            strict=False,
            description=(
                "the diameters in mm of the loops of a row, from the left, when they differ; "
                "instead of layout.columns and layout.loop_diameter_mm"
            ),
        )
    )
    axis_ratio: float = Field(
        default=1.0,
        ge=1,
        le=LARGEST_AXIS_RATIO,
        description=(
            "the length of each loop over its width (no unit); an ellipse is as long around as the "
            "circle of its diameter"
        ),
    )
    axis_angle_deg: Literal[0, 90] = Field(
        default=0,
        description="direction of the loops' length in degrees: along the rows or across them",
    )
    missing: Annotated[tuple[Annotated[tuple[int, int], Field(strict=False)], ...], CELL] = Field(
        default=(),
        strict=False,  # TOML's lists are not tuples
        description=(
            "the loops that are left out (a count each for row and column, from 1 at the bottom "
            "left)"
        ),
    )
    circles: Annotated[tuple[Circle, ...], CIRCLES] = Field(
        default=(),
        strict=False,
        description=(
            "the loops' centres and diameters in mm, to four decimals, when the kind is circles; "
            "of an ellipse also its length over its width, and its length's direction in degrees"
        ),
    )
    terminals: Literal["corner", "left", "right", "top", "bottom"] = Field(
        default="corner",
        description=(
            "where the two tails leave the array (a word); the corner is the bottom left, and of "
            "the rows of sleeves the left"
        ),
    )
    between: Literal["cut", "kept"] = Field(
        default="cut", description="what becomes of the fabric between the loops (a word)"
    )
    shape: Literal["auto", "cell", "coupled", "none"] = Field(
        default="auto",
        description=(
            "the prediction of the shape (a word): from one cell, as square grids and rows of "
            "equal circles allow; of all loops together, as they act on each other (coupled); cell "
            "where it holds, else coupled (auto); or none, for stitch and cut files only"
        ),
    )

    @property
    def diameter_mm(self) -> float:
        """Diameter of the loops, of circles the largest; 0 when it is not known."""
        return self.loop_diameter_mm or max(self.known_diameters_mm, default=0.0)

    @property
    def known_diameters_mm(self) -> tuple[float, ...]:
        """Every diameter that occurs, as far as it is known."""
        return tuple(sorted({loop.diameter_mm for loop in self.kinds_of_loops()}))

    @property
    def tolerance_mm(self) -> float:
        """How far from touching circles may be given: they are rounded when they are typed in."""
        return ROUNDED_MM if self.kind == "circles" else TANGENCY_TOLERANCE_MM

    @property
    def count(self) -> int:
        """Loops that are there."""
        return len(self.circles) if self.kind == "circles" else len(self.cells())

    @property
    def side(self) -> Side:
        """Where the tails leave, as the geometry knows it."""
        if self.kind == SLEEVE and self.terminals == "corner":
            return Side.LEFT
        return Side(self.terminals)

    @property
    def pitch_of_rows_mm(self) -> float:
        """Distance of neighbouring rows of sleeves."""
        return self.row_pitch_mm or self.diameter_mm + ROW_ROOM_MM

    def kinds_of_loops(self) -> tuple[Loop, ...]:
        """Give a loop of each size and shape, wherever it lies; as far as they are known."""
        if self.kind == "circles":
            return tuple(dict.fromkeys(one.loop() for one in self.circles))
        one = () if self.loop_diameter_mm is None else (self.loop_diameter_mm,)
        sizes = dict.fromkeys(self.diameters_mm or one)
        return tuple(Loop(0.0, 0.0, size, self.axis_ratio) for size in sizes)

    def cells(self) -> tuple[Cell, ...]:
        """Rows and columns, from 0, of the loops of a lattice that are not left out."""
        gone = {(row - 1, column - 1) for row, column in self.missing}
        return tuple(cell for cell in self.all_cells() if cell not in gone)

    def all_cells(self) -> tuple[Cell, ...]:
        """Rows and columns, from 0, of a lattice's loops; none for circles."""
        if self.kind == "circles":
            return ()
        columns = len(self.diameters_mm) or self.columns or 0
        return lattice_cells(self._lattice, self._rows, columns)

    def loops(self) -> tuple[Loop, ...]:
        """Lay the loops, centred on the origin, in the order of the cells or circles."""
        if self.kind == "circles":
            return centred(tuple(one.loop() for one in self.circles))
        gone = [(row - 1, column - 1) for row, column in self.missing]
        stretch, upright = self.axis_ratio, self.axis_angle_deg == _UPRIGHT_DEG
        if self.diameters_mm:
            return row_loops(self.diameters_mm, gone, axis_ratio=stretch, upright=upright)
        size = (self._rows, self.columns or 0, self.loop_diameter_mm or 0.0)
        if self.kind == SLEEVE:
            return rows_apart(*size, self.pitch_of_rows_mm)
        return lattice_loops(self._lattice, *size, gone, axis_ratio=stretch, upright=upright)

    @property
    def _rows(self) -> int:
        return 1 if self.kind == "row" else self.rows or 0

    @property
    def _lattice(self) -> Lattice:
        return Lattice.GRID if self.kind in (*TILING, SLEEVE) else Lattice(self.kind)
