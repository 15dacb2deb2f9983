"""What a person at the terminal is told of a design."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from sesame_cad.tables import grid

Data = dict[str, Any]


def print_design(data: Data, folder: Path) -> None:
    """Print the numbers that decide whether an array is worth sewing; warnings come first."""
    console = Console(highlight=False)
    shown = [name for name in ("cold", "hot") if data[name] is not None]
    for warning in warnings(data):
        console.print(f"[yellow]warning[/]: {warning}", soft_wrap=True)
    if shown:
        console.print(grid(model_rows(data)))
        console.print(_states(data))
        for name in shown:
            if data[name]["rung"] == "mesh":
                console.print(_coupled_line(name, data[name]))
    else:
        console.print(f'{data["name"]}: no shape is predicted (layout.shape = "none")')
    console.print(grid(workshop_rows(data)))
    console.print(f"wrote {folder}/", soft_wrap=True)


def warnings(data: Data) -> list[str]:
    """Give what may spoil the array, a line each; none if all is well."""
    left_out = [
        f"{name}: {left['term']} is left out, and matters: {left['measure']} = {left['value']:.3g}"
        for name in ("cold", "hot")
        if data[name] is not None
        for left in data[name]["omitted_terms"]
        if left["matters"]
    ]
    return [*left_out, *data["electrics"]["warnings"]]


def print_answer(data: Data) -> None:
    """Print a dimensionless solve; what a rung cannot tell is left out."""
    console = Console(highlight=False)
    energy_terms: Data = data["energy_terms"] or {}
    rows = [
        ("rung", f"{data['rung']}: {data['reason']}"),
        ("shape", shape_name(data)),
        ("height / perimeter", f"{data['height_over_perimeter']:.6f}"),
        ("error of the height", _number(data["height_error"], ".1e") or "not known"),
        ("height / radius", _number(data["height_over_radius"], ".6f")),
        ("of each loop", _span(data.get("loop_heights_over_radius", []))),
        ("pitch / diameter", _number(data["pitch_over_diameter"], ".6f")),
        ("energy / (E_f t R²)", _number(data["energy"], ".8f")),
        *((f"  {term}", f"{value:.8f}") for term, value in energy_terms.items()),
        ("status", data["status"]),
        ("gradient norm", _number(data["gradient_norm"], ".1e")),
        ("lowest eigenvalue", _number(data["lowest_eigenvalue"], ".6g")),
        ("writhe", _number(data["writhe"], ".1e")),
        ("nearest parts", _nearest(data["distances"])),
        ("steps", f"{data['steps']} on {data['unknowns']} unknowns"),
        ("seconds", f"{data['seconds']:.6f}"),
    ]
    console.print(grid([row for row in rows if row[1]]))
    for left in data["omitted_terms"]:
        mark = "[yellow]warning[/], left out" if left["matters"] else "left out"
        value = "" if left["value"] is None else f" = {left['value']:.3g}"
        console.print(f"{mark}: {left['term']} ({left['measure']}{value})")


def _nearest(near: Data | None) -> str:
    """Say how near a shape comes to itself, in units of R."""
    if near is None:
        return ""
    beyond = f"more than {near['looked_over_radius'] or 0:.3g} R"
    wires, fabric = (
        beyond if near[key] is None else f"{near[key]:.3g} R"
        for key in ("wire_to_wire", "wire_to_fabric")
    )
    crossings = f", {near['crossings']} crossings" if near["crossings"] else ""
    thick = near["wire_diameter_over_radius"]
    return f"wires {wires}, wire and fabric {fabric}{crossings}; the wire is {thick:.3g} R thick"


def _span(values: list[float]) -> str:
    """Give the smallest and largest of several values; nothing for one."""
    return f"{min(values):.6f} to {max(values):.6f}" if len(values) > 1 else ""


def _number(value: float | None, style: str) -> str:
    return "" if value is None else format(value, style)


def shape_name(state: Data) -> str:
    """Say whether a loop is buckled."""
    return "saddle" if state["buckled"] else "flat (below the buckling threshold)"


def model_rows(data: Data) -> list[tuple[str, str]]:
    """Name and value of what decides the shape, of a design that has one."""
    return [
        ("design", data["name"]),
        ("β cold, hot", f"{data['beta']:.5f}, {data['beta_hot']:.5f}"),
        *_threshold_rows(data),
        ("d_w⁴/d_0³", f"{data['scaling_mm']:.3e} mm"),
    ]


def _threshold_rows(data: Data) -> list[tuple[str, str]]:
    threshold = data["threshold"]
    if threshold is None:
        return [("prestrain", f"{data['strain']:g}")]
    return [
        ("β at which it stays flat", f"{threshold['critical_beta']:.5f}"),
        (
            "prestrain, needed to buckle",
            f"{data['strain']:g}, cold {threshold['critical_strain_cold']:.4f}, "
            f"hot {threshold['critical_strain_hot']:.4f}",
        ),
    ]


def _states(data: Data) -> Table:
    table = Table(box=None, pad_edge=False)
    for heading in ("", "shape", "height", "h/(π d_0)", "pitch", "footprint", "energy of a loop"):
        table.add_column(heading, justify="left" if heading in ("", "shape") else "right")
    for name in ("cold", "hot"):
        state = data[name]
        width, depth = state["footprint_mm"]
        table.add_row(
            name,
            shape_name(state),
            f"{state['height_mm']:.2f} mm",
            f"{state['height_over_perimeter']:.4f}",
            "" if state["pitch_mm"] is None else f"{state['pitch_mm']:.2f} mm",
            f"{width:.1f} × {depth:.1f} mm",
            f"{state['energy_mJ']:.2f} mJ",
        )
    return table


def _coupled_line(name: str, state: Data) -> str:
    """Say how the loops of a coupled shape differ, and how well it is known."""
    heights, error = state["loop_heights_mm"], state["height_error"]
    known = ", with an unknown error" if error is None else f", to within {100 * error:.1g} %"
    return (
        f"{name}: all loops solved together; each {heights['smallest']:.2f} to "
        f"{heights['largest']:.2f} mm high in its own axes{known}, "
        f"on {state['triangles']} triangles"
    )


def workshop_rows(data: Data) -> list[tuple[str, str]]:
    """Name and value of what the workshop needs to know."""
    circuit, stitch = data["circuit"], data["stitch"]
    width, height = stitch["extent_mm"]
    return [
        (
            "wire",
            f"{circuit['wire_length_mm']:.0f} mm with tails, "
            f"{circuit['resistance_ohm_cold']:.2f} Ω cold, "
            f"{circuit['resistance_ohm_hot']:.2f} Ω hot",
        ),
        *_electrics_rows(data),
        ("stages of the wire", f"{circuit['stages']}"),
        ("contacts covered", f"{circuit['covered_contacts']} of {circuit['contacts']}"),
        (
            "stitches",
            f"{stitch['stitches']} in {len(stitch['blocks'])} blocks, {stitch['stops']} stops, "
            f"{width:.1f} × {height:.1f} mm",
        ),
        ("openings to cut", f"{data['outline']['openings']}"),
    ]


def _electrics_rows(data: Data) -> list[tuple[str, str]]:
    """Say what each circuit needs, with its wire where there are several."""
    rows: list[tuple[str, str]] = []
    for made, driven in zip(data["circuits"], data["electrics"]["circuits"], strict=True):
        needs = (
            f"{driven['current_A']:.2f} A at {driven['voltage_V']:.1f} V, "
            f"{driven['power_W']:.1f} W hot"
        )
        if len(data["circuits"]) == 1:
            return [("to heat it", needs)]
        wire = f"{made['wire_length_mm']:.0f} mm of {made['wire_diameter_mm']:g} mm wire"
        rows.append((f"circuit {made['name']}", f"{len(made['loops'])} loops, {wire}, {needs}"))
    return rows
