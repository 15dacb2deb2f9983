"""The mat or sheet that pieces are cut from."""

from __future__ import annotations

from dataclasses import dataclass
from types import MappingProxyType

from patterns.positive import check_positive


@dataclass(frozen=True, slots=True)
class Mat:
    """What a cutting machine can reach.

    Attributes
    ----------
    width_mm, height_mm : float
        Usable size; its lower left corner is the origin.
    margin_mm : float
        Left free along all four sides.
    """

    width_mm: float
    height_mm: float
    margin_mm: float = 3.0

    def __post_init__(self) -> None:
        """Refuse what is no mat."""
        check_positive(
            "mat",
            width_between_margins_mm=self.width_mm - 2 * self.margin_mm,
            height_between_margins_mm=self.height_mm - 2 * self.margin_mm,
        )
        if self.margin_mm != 0:
            check_positive("mat", margin_mm=self.margin_mm)

    @property
    def room_mm(self) -> tuple[float, float]:
        """Width and height between the margins."""
        return self.width_mm - 2 * self.margin_mm, self.height_mm - 2 * self.margin_mm


MATS = MappingProxyType(
    {
        "scanncut-12x12": Mat(296.67, 298.80),
        "scanncut-12x24": Mat(296.0, 603.0),
    }
)
"""Mats of Brother's ScanNCut in inches; usable sizes as users tell them, to be measured first."""
