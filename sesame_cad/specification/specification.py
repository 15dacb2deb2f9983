"""The specification: everything a maker decides about an array."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Annotated, Literal

from pydantic import Field, model_validator

from patterns.beam import ConstraintStrip
from patterns.circuit import Diameters
from patterns.hooks import SleevePlace
from patterns.machine import Machine
from patterns.stitching import Stitching
from sesame_cad.files.dst_switches import DstSwitches
from sesame_cad.specification.actuation import ActuationSection
from sesame_cad.specification.beam import BeamSection
from sesame_cad.specification.consistency import Together, inconsistencies
from sesame_cad.specification.fabric import FabricSection
from sesame_cad.specification.layout import SLEEVE, LayoutSection
from sesame_cad.specification.machine import MachineSection
from sesame_cad.specification.model import ModelSection
from sesame_cad.specification.outline import OutlineSection
from sesame_cad.specification.output import OutputSection
from sesame_cad.specification.prediction import predicted_shape
from sesame_cad.specification.section import Allowed, Section
from sesame_cad.specification.sleeve import SleeveSection, sewn_width_mm
from sesame_cad.specification.stitching import StitchingSection
from sesame_cad.specification.supply import SupplySection
from sesame_cad.specification.toml_text import number_text, toml_value
from sesame_cad.specification.wire import WireSection
from sesame_cad.specification.wiring import WiringSection
from solver.actuation.convection import natural_convection_W_m2K

PREVIEW_WIRE_DIAMETERS = 0.8
"""The preview's fabric is no thicker than this, so that its edge stays inside the wire."""

Name = Annotated[
    str,
    Field(pattern=r"^[A-Za-z0-9][A-Za-z0-9._-]{0,63}$"),
    Allowed("1 to 64 letters, digits and - _ . in quotes, and begin with a letter or a digit"),
]


class Specification(Section):
    """Everything a maker decides about an array, checked."""

    name: Name = Field(
        description="the design's name (a text); when left out, the file's name without its ending"
    )
    fabric: FabricSection = Field(default=FabricSection(), description="the stretched fabric")
    wire: WireSection = Field(description="the shape-memory wire")
    layout: LayoutSection = Field(description="the arrangement of the loops")
    model: ModelSection = Field(
        default=ModelSection(), description="the mechanics behind the shape"
    )
    stitching: StitchingSection = Field(
        default=StitchingSection(), description="how the wire is tied down and covered"
    )
    machine: MachineSection = Field(
        default=MachineSection(), description="the embroidery machine and its hoop"
    )
    outline: OutlineSection = Field(default=OutlineSection(), description="where the fabric is cut")
    output: OutputSection = Field(default=OutputSection(), description="the files that are written")
    wiring: WiringSection = Field(default=WiringSection(), description="which loops share a wire")
    supply: SupplySection = Field(default=SupplySection(), description="what heats the wire")
    beam: BeamSection = Field(
        default=BeamSection(), description='the beams of sleeves (layout.kind = "sleeve")'
    )
    sleeve: SleeveSection = Field(
        default=SleeveSection(),
        description='the sleeves around the beams (layout.kind = "sleeve")',
    )
    actuation: ActuationSection = Field(
        default=ActuationSection(), description="what happens when the current flows"
    )

    @model_validator(mode="after")
    def _goes_together(self) -> Specification:
        together = Together(
            wire=self.wire,
            layout=self.layout,
            model=self.model,
            wiring=self.wiring,
            stitching=self.stitching,
            machine=self.machine,
            outline=self.outline,
            output=self.output,
            beam=self.beam,
            sleeve=self.sleeve,
        )
        faults = inconsistencies(together)
        if faults:
            raise ValueError("\n".join(map(str, faults)))
        return self

    @property
    def predicted_shape(self) -> Literal["cell", "coupled", "none"]:
        """How the shape is predicted."""
        return predicted_shape(self.layout, self.model, self.wiring, self.wire)

    @property
    def preview_thickness_mm(self) -> float:
        """Thickness of the fabric in the printable preview, in mm."""
        if self.output.preview_thickness_mm is not None:
            return self.output.preview_thickness_mm
        return min(self.fabric.thickness_mm, PREVIEW_WIRE_DIAMETERS * self.wire.diameter_mm)

    @property
    def current_A(self) -> float:  # noqa: N802 - the unit's own spelling
        """The current with which a circuit is heated, in A."""
        return self.wire.design_current_A

    @property
    def convection_W_m2K(self) -> float:  # noqa: N802 - the unit's own spelling
        """Heat that the wire gives away, in W/m²K: in still air, while it transforms."""
        given = self.actuation.convection_W_m2K
        if given is not None:
            return given
        surface_C = self.wire.transition_C + self.actuation.heating_span_C / 2  # noqa: N806
        diameter_m = self.wire.diameter_mm / 1e3
        return natural_convection_W_m2K(diameter_m, surface_C, self.actuation.ambient_C)

    @property
    def diameters_mm(self) -> Diameters:
        """Wire diameter of all circuits, or of each of those that are given one by one."""
        own = tuple(one.wire(self.wire).diameter_mm for one in self.wiring.circuits)
        return own or self.wire.diameter_mm

    def wires(self, count: int) -> tuple[WireSection, ...]:
        """Give the wires of so many circuits."""
        own = tuple(one.wire(self.wire) for one in self.wiring.circuits)
        return own or (self.wire,) * count

    def patterns_machine(self) -> Machine:
        """Give the machine as the geometry knows it."""
        return self.machine.geometry()

    def dst_switches(self) -> DstSwitches:
        """Give what the machine wants of DST files."""
        machine = self.machine
        return DstSwitches(machine.refuses_zero_colours, machine.double_stop)

    def patterns_stitching(self) -> Stitching:
        """Give the stitching settings as the geometry knows them; sleeves always have stripes."""
        settings = self.stitching.geometry()
        return replace(settings, stripes="columns") if self.layout.kind == SLEEVE else settings

    @property
    def compressed_pitch_mm(self) -> float:
        """Distance of neighbouring loops of a compressed sleeve."""
        return self.sleeve.pitch_mm(self.layout, self.beam)

    @property
    def sleeve_place(self) -> SleevePlace:
        """Where on its beam a sleeve is held compressed."""
        return self.sleeve.place(self.layout, self.beam)

    @property
    def constraint(self) -> ConstraintStrip:
        """The strip that keeps a beam bent; its window lets the widest sleeve through."""
        wire_mm, margin_mm = self.wire.diameter_mm, self.outline.margin_mm
        return self.beam.constraint(sewn_width_mm(self.layout.diameter_mm, wire_mm, margin_mm))

    def to_toml(self) -> str:
        """Write the specification in full; reading it back gives an equal one.

        Every key stands there, in the order of the declarations; one without a value is a comment.
        """
        return "\n".join(self._toml_lines()) + "\n"

    def _toml_lines(self) -> Iterator[str]:
        yield f"name = {toml_value(self.name)}"
        for name in sections():
            section: Section = getattr(self, name)
            yield from ("", f"[{name}]")
            for key, value in section.model_dump().items():
                yield _toml_line(key, value)


def sections() -> dict[str, type[Section]]:
    """Give the section classes by name, in the order in which they are written."""
    return {
        name: field.annotation
        for name, field in Specification.model_fields.items()
        if isinstance(field.annotation, type) and issubclass(field.annotation, Section)
    }


def _toml_line(key: str, value: object) -> str:
    if value is None:
        return f"# {key} is left to its default"
    return f"{key} = {number_text(value) if isinstance(value, float) else toml_value(value)}"
