"""What a person at the terminal is told of tolerances."""

from __future__ import annotations

from typing import Any

from rich.console import Console
from rich.table import Table

_NAMES = {
    "wire_modulus_GPa": ("wire's modulus", "GPa"),
    "fabric_modulus_kPa": ("fabric's modulus", "kPa"),
    "prestrain": ("prestrain", ""),
    "wire_diameter_mm": ("wire's diameter", "mm"),
}


def print_tolerances(data: dict[str, Any]) -> None:
    """Print each tolerance's part, the bands, and what was measured."""
    console = Console(highlight=False)
    console.print("height over wire length, h/(π d_0), with tolerances")
    table = Table(box=None, pad_edge=False)
    for heading in ("", "cold", "hot"):
        table.add_column(heading, justify="right" if heading else "left")
    cold, hot = data["cold"], data["hot"]
    table.add_row("as specified", f"{cold['height']:.4f}", f"{hot['height']:.4f}")
    for one, other in zip(cold["contributions"], hot["contributions"], strict=True):
        name, unit = _NAMES[one["key"]]
        table.add_row(
            f"{name} ± {one['tolerance']:.3g} {unit}".rstrip(),
            f"{one['height_over_perimeter']:+.4f}",
            f"{other['height_over_perimeter']:+.4f}",
        )
    for name, key in (("all at their worst, first order", "worst"), ("likely (1 σ)", "likely")):
        table.add_row(name, *(f"± {band[key]:.4f}" for band in (cold, hot)))
    for name, key in (("first order", "first_order"), ("solved", "sampled")):
        for what, low, high in (("95 %", 1, 2), ("all", 0, 3)):
            table.add_row(
                f"{cold['samples']} samples, {name}, {what}",
                *(f"{band[key][low]:.4f} to {band[key][high]:.4f}" for band in (cold, hot)),
            )
    console.print(table)
    for band in (cold, hot):
        if band["unsolved"]:
            console.print(f"{band['state']}: {band['unsolved']} samples could not be solved")
    measured = data["measured"]
    if measured is not None:
        console.print(
            f"measured on the paper's {measured['array']}, cold: "
            f"{measured['height_over_perimeter']:.2f}, {measured['lies']}",
            soft_wrap=True,
        )
