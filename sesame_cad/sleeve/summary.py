"""What a person at the terminal is told of beams with sleeves."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rich.console import Console

from sesame_cad.tables import grid

Data = dict[str, Any]


def print_sleeves(data: Data, folder: Path) -> None:
    """Print the numbers that decide whether sleeves are worth sewing; warnings come first."""
    console = Console(highlight=False)
    for warning in sleeve_warnings(data):
        console.print(f"[yellow]warning[/]: {warning}", soft_wrap=True)
    console.print(grid(sleeve_rows(data)))
    if data["sleeve"] is None:
        console.print(f'{data["name"]}: no states are predicted (layout.shape = "none")')
    console.print(f"wrote {folder}/", soft_wrap=True)


def sleeve_rows(data: Data) -> list[tuple[str, str]]:
    """Name and value of the numbers."""
    return [*_beam_rows(data["beams"]), *_model_rows(data), *_layer_rows(data)]


def sleeve_warnings(data: Data) -> list[str]:
    """Give what may spoil the sleeves, a line each; none if all is well."""
    found: list[str] = []
    for left in (data["sleeve"] or {}).get("omitted_terms", []):
        if left["matters"]:
            size = "" if left["value"] is None else f" = {left['value']:.3g}"
            found.append(f"{left['term']} is left out, and matters: {left['measure']}{size}")
    hold = data["beams"]["hold"]
    if hold is not None and not hold["both_sides_hot"]:
        found.append(
            f"with both sides hot the ties move out to {hold['tie_from_axis_mm']['hot']:.1f} mm "
            f"from the beam's axis, past the hooks' tips at {hold['hook_reach_mm']:.1f} mm"
        )
    for layer in data["hoopings"].values():
        found += layer["electrics"]["warnings"]
    return found


def _beam_rows(beams: Data) -> list[tuple[str, str]]:
    strip, count = beams["constraint"], beams["count"]
    return [
        (
            "beams",
            f"{count} of {beams['length_mm']:g} × {beams['width_mm']:g} × "
            f"{beams['thickness_mm']:g} mm, {beams['mass_g']:.2f} g each",
        ),
        (
            "constraint strips",
            f"{count} of {strip['length_mm']:g} × {strip['width_mm']:g} mm around a window of "
            f"{strip['window_mm']:g} mm, "
            f"{strip['mass_g']:.2f} g each",
        ),
        (
            "sheets",
            ", ".join(f"{name}: {one['cuts']} cuts" for name, one in beams["sheets"].items()),
        ),
    ]


def _model_rows(data: Data) -> list[tuple[str, str]]:
    sleeve, segment = data["sleeve"], data["bistable"]
    if sleeve is None:
        return []
    force, moment = sleeve["force_N"], sleeve["moment_Nmm"]
    return [
        (
            "sleeve, compressed",
            f"to {sleeve['compressed_pitch_mm']:.2f} mm a loop, from "
            f"{sleeve['free_pitch_mm']:.2f} mm when free",
        ),
        ("its force", f"{force['cold']:.3f} N cold, {force['hot']:.3f} N hot"),
        ("its moment", f"{moment['cold']:.2f} N mm cold, {moment['hot']:.2f} N mm hot"),
        ("heating one side", _snap_text(segment)),
    ]


def _snap_text(segment: Data) -> str:
    if segment["snaps"] is None or segment["margin"] is None:
        return "no snap is predicted"
    verb = "snaps the beam through" if segment["snaps"] else "does not snap the beam through"
    return f"{verb}: {segment['margin']:.2f} times the critical moment"


def _layer_rows(data: Data) -> list[tuple[str, str]]:
    rows: list[tuple[str, str]] = []
    for name, layer in data["hoopings"].items():
        stitch, circuits = layer["stitch"], layer["electrics"]["circuits"]
        first = layer["circuits"][0]
        width, height = stitch["extent_mm"]
        rows += [
            (
                f"{name} array",
                f"{stitch['stitches']} stitches in {len(stitch['blocks'])} blocks, "
                f"{stitch['stops']} stops, {width:.1f} × {height:.1f} mm",
            ),
            (
                f"circuits of the {name} array",
                f"{len(circuits)}, each {first['wire_length_mm']:.0f} mm of "
                f"{first['wire_diameter_mm']:g} mm wire, {circuits[0]['current_A']:.2f} A at "
                f"{circuits[0]['voltage_V']:.1f} V hot",
            ),
        ]
    return rows
