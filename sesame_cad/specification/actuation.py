"""The section [actuation]: how the wire is heated, what cools it, and what lies on the array."""

from __future__ import annotations

from pydantic import Field

from sesame_cad.specification.section import Section


class ActuationSection(Section):
    """Heat and load; defaults from makers' data of nickel-titanium actuator wire.

    Heat capacity, latent heat and the meaning of a wire's transition temperature, the start of
    austenite: Dynalloy, Technical Characteristics of Flexinol, F1140 Rev I.2. Width of the
    hysteresis, 30 ± 5 °C: Fort Wayne Metals, actuator wire. Both spans: usual for such wire.
    """

    heating_span_C: float = Field(  # noqa: N815 - the unit's own spelling
        default=10.0,
        ge=0.01,
        le=500,
        description=(
            "the temperature in °C from the start of austenite, wire.transition_C, to its finish"
        ),
    )
    hysteresis_C: float = Field(  # noqa: N815
        default=30.0,
        ge=0,
        le=500,
        description="the temperature in °C by which the wire transforms back later, on average",
    )
    cooling_span_C: float = Field(  # noqa: N815
        default=10.0,
        ge=0.01,
        le=500,
        description="the temperature in °C from the start of martensite down to its finish",
    )
    heat_capacity_J_gK: float = Field(  # noqa: N815
        default=0.837, ge=0.01, le=10, description="the wire's heat capacity in J/gK"
    )
    latent_heat_J_g: float = Field(  # noqa: N815
        default=24.2, ge=0, le=1000, description="the latent heat of the transformation in J/g"
    )
    ambient_C: float = Field(  # noqa: N815
        default=25.0, ge=-200, le=300, description="the temperature around the array in °C"
    )
    convection_W_m2K: float | None = Field(  # noqa: N815
        default=None,
        ge=0,
        le=1e5,
        description=(
            "the heat in W/m²K that the wire's surface gives away; when left out, that of a "
            "horizontal wire in still air"
        ),
    )
    heating_s: float = Field(
        default=30.0, gt=0, le=1e6, description="the time in s for which the current flows"
    )
    cooling_s: float = Field(
        default=30.0, ge=0, le=1e6, description="the time in s without current after that"
    )
    cycles: int = Field(
        default=3, ge=1, le=100, description="how often both are repeated (a count)"
    )
    load_g: float = Field(
        default=0.0, ge=0, le=1e9, description="the mass in g of a slab that lies on the array"
    )
