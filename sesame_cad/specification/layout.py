"""The section [layout]: where the loops lie."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from patterns.lattice import Cell, Lattice, centred, lattice_cells, lattice_loops
from patterns.layout import ROUNDED_MM, TANGENCY_TOLERANCE_MM, Loop
from patterns.terminals import Side
from sesame_cad.specification.section import Allowed, Section

Kind = Literal["grid", "brick", "hexagonal", "row", "circles"]

TILING = ("grid", "row")
"""Kinds whose loops, equal and with contacts a quarter turn apart, keep one shape side by side."""

CELL = Allowed("a list, each item a row and a column, such as [[1, 1], [2, 4]]")
CIRCLES = Allowed(
    "a list, each item with three numbers, such as {x_mm = 0, y_mm = 0, diameter_mm = 25}"
)


class Circle(Section):
    """One loop of an arrangement that is given loop by loop."""

    x_mm: float = Field(description="the centre's place in mm, to the right")
    y_mm: float = Field(description="the centre's place in mm, away from the operator")
    diameter_mm: float = Field(ge=0.1, le=10_000, description="the loop's diameter in mm")


class LayoutSection(Section):
    """Tangent loops: on a lattice, some left out, or any circles."""

    kind: Kind = Field(
        default="grid",
        description=(
            "the arrangement of the loops (a word): a square grid; rows that are shifted by half a "
            "loop in turn, all equally long (brick) or clipped to the first row's width "
            "(hexagonal); one row; or any tangent circles"
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
            "the loops' centres and diameters in mm, to four decimals, when the kind is circles"
        ),
    )
    terminals: Literal["corner", "left", "right", "top", "bottom"] = Field(
        default="corner",
        description="where the two tails leave the array (a word); the corner is the bottom left",
    )
    between: Literal["cut", "kept"] = Field(
        default="cut", description="what becomes of the fabric between the loops (a word)"
    )
    shape: Literal["auto", "cell", "coupled", "none"] = Field(
        default="auto",
        description=(
            "the prediction of the shape (a word): from one cell, as square grids and rows of "
            "equal loops allow; of all loops together, as they act on each other (coupled); cell "
            "where it holds, else coupled (auto); or none, for stitch and cut files only"
        ),
    )

    @property
    def diameter_mm(self) -> float:
        """Diameter of the loops, of circles the largest; 0 when it is not known."""
        return self.loop_diameter_mm or max(self.diameters_mm, default=0.0)

    @property
    def diameters_mm(self) -> tuple[float, ...]:
        """Every diameter that occurs, as far as it is known."""
        if self.kind == "circles":
            return tuple(sorted({circle.diameter_mm for circle in self.circles}))
        return () if self.loop_diameter_mm is None else (self.loop_diameter_mm,)

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
        return Side(self.terminals)

    def cells(self) -> tuple[Cell, ...]:
        """Rows and columns, from 0, of the loops of a lattice that are not left out."""
        gone = {(row - 1, column - 1) for row, column in self.missing}
        return tuple(cell for cell in self.all_cells() if cell not in gone)

    def all_cells(self) -> tuple[Cell, ...]:
        """Rows and columns, from 0, of a lattice's loops; none for circles."""
        if self.kind == "circles":
            return ()
        return lattice_cells(self._lattice, self._rows, self.columns or 0)

    def loops(self) -> tuple[Loop, ...]:
        """Lay the loops, centred on the origin, in the order of the cells or circles."""
        if self.kind == "circles":
            given = (Loop(one.x_mm, one.y_mm, one.diameter_mm) for one in self.circles)
            return centred(tuple(given))
        gone = [(row - 1, column - 1) for row, column in self.missing]
        size = (self._rows, self.columns or 0, self.loop_diameter_mm or 0.0)
        return lattice_loops(self._lattice, *size, gone)

    @property
    def _rows(self) -> int:
        return 1 if self.kind == "row" else self.rows or 0

    @property
    def _lattice(self) -> Lattice:
        return Lattice.GRID if self.kind in TILING else Lattice(self.kind)
