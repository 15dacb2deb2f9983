"""What a person at the terminal is told of forces and of an actuator."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from sesame_cad.tables import grid

Data = dict[str, Any]


def print_force(data: Data, folder: Path | None) -> None:
    """Print the forces of one loop between plates."""
    console = Console(highlight=False)
    pairs = data.get("curve") or [data]
    for name in ("cold", "hot"):
        for left in _mattering(pair[name] for pair in pairs):
            console.print(
                f"[yellow]warning[/]: {name}: {left} is left out, and matters", soft_wrap=True
            )
    table = Table(box=None, pad_edge=False)
    for heading in ("gap", "force cold", "hot", "height cold", "hot"):
        table.add_column(heading, justify="right")
    for pair in pairs:
        states = [pair["cold"], pair["hot"]]
        table.add_row(
            f"{pair['gap_mm']:g} mm",
            *(_with_unit(state["force_N"], "N", ".3f") for state in states),
            *(_with_unit(state.get("height_mm"), "mm", ".2f") for state in states),
        )
    console.print(f"{data['name']}: one loop between two plates, {data['axis']}")
    console.print(table)
    for fault in dict.fromkeys(
        pair[name]["status"] for pair in pairs for name in ("cold", "hot") if name in pair
    ):
        if fault != "converged":
            console.print(f"no force: {fault}", soft_wrap=True)
    if folder is not None:
        console.print(f"wrote {folder}/", soft_wrap=True)


def print_actuation(data: Data, folder: Path) -> None:
    """Print what a maker asks of an actuator; warnings come first."""
    console = Console(highlight=False)
    for warning in data["warnings"]:
        console.print(f"[yellow]warning[/]: {warning}", soft_wrap=True)
    heat, stroke, load, power = (data[key] for key in ("heat", "stroke", "load", "power"))
    array, duty, wire = data["array"], data["duty"], data["wire"]
    rows = [
        ("array", f"{array['cells']} loops, {array['mass_g']:.2f} g without thread"),
        (
            "current",
            f"{duty['current_A']:g} A for {duty['heating_s']:g} s, none for "
            f"{duty['cooling_s']:g} s, {duty['cycles']} times",
        ),
        (
            "wire",
            f"to {heat['highest_C']:.1f} C, {100 * heat['highest_austenite_fraction']:.0f} % "
            f"austenite; As {wire['austenite_start_C']:g}, Af {wire['austenite_finish_C']:g}, "
            f"Ms {wire['martensite_start_C']:g}, Mf {wire['martensite_finish_C']:g} C",
        ),
        (
            "cooling",
            f"{data['surroundings']['convection_W_m2K']:.1f} W/m²K, "
            f"{data['surroundings']['convection_from']}",
        ),
        (
            "height without load",
            f"{stroke['height_cold_mm']:.2f} mm cold, {stroke['height_hot_mm']:.2f} mm hot",
        ),
        (
            f"height under {load['load_g']:g} g",
            f"{load['height_cold_mm']:.2f} mm cold, {load['height_hot_mm']:.2f} mm hot",
        ),
        (
            "flattened by",
            f"{load['flattening_load_cold_g']:.0f} g cold, "
            f"{load['flattening_load_hot_g']:.0f} g hot",
        ),
        ("stroke of the last cycle", f"{stroke['last_cycle_stroke_mm']:.2f} mm"),
        ("90 % of the way after", _with_unit(stroke["time_to_90_percent_s"], "s", ".1f")),
        ("half of it back after", _with_unit(stroke["time_back_50_percent_s"], "s", ".1f")),
        ("power", f"{power['power_hot_W']:.1f} W at {power['voltage_hot_V']:.1f} V, hot"),
        (
            "a cycle",
            f"takes {power['energy_per_cycle_J']:.0f} J and lifts {load['work_per_cycle_mJ']:.3g} "
            "mJ",
        ),
    ]
    console.print(grid(rows))
    console.print(f"wrote {folder}/", soft_wrap=True)


def _mattering(states: Iterable[Data]) -> list[str]:
    """Terms that are left out of any of the states and matter there."""
    return list(
        dict.fromkeys(
            left["term"]
            for state in states
            for left in state.get("omitted_terms", ())
            if left["matters"]
        )
    )


def _with_unit(value: float | None, unit: str, style: str) -> str:
    return "none" if value is None else f"{value:{style}} {unit}"
