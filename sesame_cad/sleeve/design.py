"""From a specification of sleeves to everything that follows from it, as values."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from math import ceil

from patterns.records import Records, plan_records
from sesame_cad.pipeline import Design, Pattern, refusing
from sesame_cad.sleeve.hold import Hold, hold
from sesame_cad.sleeve.hoops import UpperHoop, upper_hoop
from sesame_cad.sleeve.pattern import LOWER, UPPER, SleevePattern, sleeve_pattern
from sesame_cad.sleeve_prediction.curves import ForceCurve, force_curves
from sesame_cad.sleeve_prediction.segment import predict_sleeve
from sesame_cad.specification import Specification
from solver.sleeve.segment import SegmentPrediction

_NOTES: Mapping[str, str] = {
    LOWER: (
        "Sew and prepare the upper array first; cut, rivet and crimp nothing before the ties are "
        "sewn. After release cut the beams from their frame, push each sleeve over the ramps until "
        "it lies compressed between the hooks. Bend the beam through the window of a constraint "
        "strip, and rivet both ends to the strip's."
    ),
    UPPER: (
        "Sew this array first, and leave it in its hoop: it is laid on the lower array, right side "
        "up, before the ties of that one are sewn."
    ),
}


@dataclass(frozen=True)
class SleeveDesign:
    """Beams with sleeves, designed.

    Attributes
    ----------
    spec : Specification
    pattern : SleevePattern
    hoop : UpperHoop
        The hoop of the upper array.
    prediction : SegmentPrediction or None
        None when none is asked for (`layout.shape = "none"`).
    hold : Hold or None
        How the hooks hold the predicted sleeve.
    """

    spec: Specification
    pattern: SleevePattern
    hoop: UpperHoop
    prediction: SegmentPrediction | None
    hold: Hold | None

    @cached_property
    def hoopings(self) -> dict[str, Design]:
        """The layers by their names, each as the design of an array of its own."""
        return {
            name: Design(_layer_spec(self.spec, name, self.hoop), layer, ())
            for name, layer in self._layers().items()
        }

    @cached_property
    def force_curves(self) -> tuple[ForceCurve, ...]:
        """Force of a sleeve against its pitch, cold and hot; none without a prediction."""
        return () if self.prediction is None else force_curves(self.prediction)

    @cached_property
    def records(self) -> dict[str, Records]:
        """What the stitch file of each layer holds."""
        machine = self.spec.patterns_machine()
        return {name: plan_records(one.plan, machine) for name, one in self._layers().items()}

    def _layers(self) -> dict[str, Pattern]:
        # in the order of the work
        return {UPPER: self.pattern.upper, LOWER: self.pattern.lower}


def sleeve_design(
    spec: Specification, progress: Callable[[str], None] = lambda _: None
) -> SleeveDesign:
    """Lay the pattern and predict what the sleeves do.

    Raises
    ------
    InputError
        When the specification asks for what cannot be made.
    NotConvergedError
        When there is no shape to rely on.
    """
    progress("rows, ties and beams")
    pattern = refusing(spec, partial(sleeve_pattern, spec))
    hoop = upper_hoop(spec, pattern.upper)
    if spec.layout.shape == "none":
        return SleeveDesign(spec, pattern, hoop, None, None)
    progress("sleeves and the beam that they bend")
    found = predict_sleeve(spec)
    return SleeveDesign(spec, pattern, hoop, found, hold(spec, found))


def _layer_spec(spec: Specification, name: str, hoop: UpperHoop) -> Specification:
    """Give the specification under the layer's name, with its hoop and notes for its operator."""
    notes = [_NOTES[name]]
    machine = spec.machine
    if name == UPPER:
        width, height = map(ceil, hoop.inside_mm)
        notes.append(
            f"Take a hoop of at least {width} x {height} mm inside and less than "
            f"{machine.hoop_width_mm:g} x {machine.hoop_height_mm:g} mm outside: it must lie "
            "inside the lower hoop."
        )
        smallest = {"hoop_width_mm": float(width), "hoop_height_mm": float(height)}
        machine = machine.model_copy(update=smallest)
    notes += [spec.output.notes] if spec.output.notes else []
    output = spec.output.model_copy(update={"notes": "\n".join(notes)})
    own = {"name": f"{spec.name}-{name}", "output": output, "machine": machine}
    return spec.model_copy(update=own)
