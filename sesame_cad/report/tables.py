"""The numbers of a design as tables of a page, from what `design.json` holds."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

from sesame_cad.summary import model_rows, shape_name, workshop_rows

Data = dict[str, Any]
Row = Sequence[str]

_STATES = ("cold", "hot")


def table(head: Row, rows: Iterable[Row], *, caption: str = "") -> str:
    """Write a table; the first cell of each row names it."""
    names = "".join(f'<th scope="col">{escape(cell)}</th>' for cell in head)
    top = f"<thead><tr>{names}</tr></thead>" if head else ""
    title = f"<caption>{escape(caption)}</caption>" if caption else ""
    body = "".join(
        f'<tr><th scope="row">{escape(row[0])}</th>'
        + "".join(f"<td>{escape(cell)}</td>" for cell in row[1:])
        + "</tr>"
        for row in rows
    )
    return f'<div class="wide"><table>{title}{top}<tbody>{body}</tbody></table></div>'


def facts_table(data: Data) -> str:
    """Give what decides the shape and what the workshop needs."""
    shape = [] if data["cold"] is None else model_rows(data)[1:]
    return table((), [*shape, *workshop_rows(data)])


def shapes_table(data: Data) -> str:
    """Give the two shapes beside each other; nothing of a design without."""
    if data["cold"] is None:
        return ""
    states = [data[name] for name in _STATES]
    rows = [
        ("shape", *(shape_name(one) for one in states)),
        ("height", *(f"{one['height_mm']:.2f} mm" for one in states)),
        ("height over wire length", *(f"{one['height_over_perimeter']:.4f}" for one in states)),
        ("pitch", *(_or_none(one["pitch_mm"], "{:.2f} mm") for one in states)),
        ("footprint", *("{:.1f} × {:.1f} mm".format(*one["footprint_mm"]) for one in states)),
        ("energy of a loop", *(f"{one['energy_mJ']:.2f} mJ" for one in states)),
    ]
    return table(("", *_STATES), rows)


def accuracy_table(data: Data) -> str:
    """Say how the shapes were found, and how well they are known."""
    if data["cold"] is None:
        return ""
    states = [data[name] for name in _STATES]
    rows = [
        ("solved on", *(_rung(one) for one in states)),
        ("error of the height", *(_or_none(one["height_error"], "{:.1e} of it") for one in states)),
        ("status", *(one["status"] for one in states)),
        ("gradient norm", *(_or_none(one["gradient_norm"], "{:.1e}") for one in states)),
        ("lowest eigenvalue", *(_or_none(one["lowest_eigenvalue"], "{:.3g}") for one in states)),
        ("Newton steps", *(str(one["steps"]) for one in states)),
    ]
    return table(("", *_STATES), rows, caption="How the shapes were found")


def omitted_table(data: Data) -> str:
    """Say what the model leaves out, and by which number that is judged."""
    if data["cold"] is None:
        return ""
    values = {
        name: {left["term"]: left for left in data[name]["omitted_terms"]} for name in _STATES
    }
    terms = dict.fromkeys(term for name in _STATES for term in values[name])
    rows = [
        (
            term,
            next(values[name][term]["measure"] for name in _STATES if term in values[name]),
            *(_omitted(values[name].get(term)) for name in _STATES),
        )
        for term in terms
    ]
    return table(("left out", "judged by", *_STATES), rows, caption="What the model leaves out")


def circuits_table(data: Data) -> str:
    """Give wire, resistance and drive of each circuit."""
    rows = [
        (
            made["name"],
            str(len(made["loops"])),
            f"{made['wire_length_mm']:.0f} mm of {made['wire_diameter_mm']:g} mm",
            f"{made['resistance_ohm_cold']:.2f} Ω",
            f"{made['resistance_ohm_hot']:.2f} Ω",
            f"{driven['current_A']:.2f} A",
            f"{driven['voltage_V']:.1f} V",
            f"{driven['power_W']:.1f} W",
            " and ".join("({:.1f}, {:.1f})".format(*place) for place in made["terminals_mm"]),
        )
        for made, driven in zip(data["circuits"], data["electrics"]["circuits"], strict=True)
    ]
    head = ("circuit", "loops", "wire", "cold", "hot", "current", "voltage", "power")
    return table((*head, "terminals A and B, mm"), rows)


def inputs_table(data: Data) -> str:
    """List the specification, with every default filled in."""
    rows = [
        (f"{section}.{key}", str(value))
        for section, keys in data["specification"].items()
        if isinstance(keys, dict)
        for key, value in keys.items()
        if value is not None and value != []
    ]
    return table(("key", "value"), rows)


def _rung(state: Data) -> str:
    more = f", {state['triangles']} triangles" if state.get("triangles") else ""
    return f"{state['rung']}, {state['unknowns']} unknowns{more}"


def _or_none(value: float | None, style: str) -> str:
    return "not known" if value is None else style.format(value)


def _omitted(left: Data | None) -> str:
    if left is None:
        return "not judged"
    value = "not known" if left["value"] is None else f"{left['value']:.3g}"
    return f"{value}, matters" if left["matters"] else value
