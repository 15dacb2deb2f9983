"""Quantities with units."""

import re
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from sesame_cad.quantities import (
    CURRENT_A,
    LENGTH_MM,
    MASS_G,
    TEMPERATURE_C,
    TIME_S,
    kind_of,
    parse_length_mm,
    parse_modulus_gpa,
    parse_modulus_kpa,
    parse_quantity,
    parse_range,
    parse_strain,
    parse_temperature_c,
)
from sesame_cad.specification.specification import sections


@pytest.mark.parametrize(
    ("parse", "text", "value"),
    [
        (parse_length_mm, "40mm", 40),
        (parse_length_mm, " 4 cm ", 40),
        (parse_length_mm, "0.04 m", 40),
        (parse_length_mm, "0.5in", 12.7),
        (parse_length_mm, "250 µm", 0.25),
        (parse_length_mm, ".5mm", 0.5),
        (parse_length_mm, "5.mm", 5),
        (parse_length_mm, "+4e1mm", 40),
        (parse_length_mm, "-3 mm", -3),
        (parse_modulus_gpa, "28GPa", 28),
        (parse_modulus_gpa, "75000 MPa", 75),
        (parse_modulus_kpa, "700 kPa", 700),
        (parse_modulus_kpa, "0.7MPa", 700),
        (parse_modulus_kpa, "7e5 Pa", 700),
        (parse_strain, "0.3", 0.3),
        (parse_strain, "30%", 0.3),
        (parse_strain, "29 %", 0.29),
        (parse_temperature_c, "40C", 40),
        (parse_temperature_c, "40 °C", 40),
        (parse_temperature_c, "313.15 K", 40),
    ],
)
def test_quantities(parse, text, value):
    assert parse(text) == value


@pytest.mark.parametrize(
    ("parse", "text", "says"),
    [
        (parse_length_mm, "40", "write 40mm"),
        (parse_length_mm, "40 km/h", "allowed units are mm, cm, m, um, µm, in"),
        (parse_length_mm, "40 MM", "allowed units are mm"),
        (parse_length_mm, "mm", "write 40mm"),
        (parse_length_mm, "", "write 40mm"),
        (parse_length_mm, "0,5mm", "allowed units are"),
        (parse_length_mm, "nan mm", "write 40mm"),
        (parse_length_mm, "inf mm", "write 40mm"),
        (parse_length_mm, "1e999mm", "is not a length"),
        (parse_length_mm, "4 5mm", "is not a length"),
        (parse_length_mm, "٤٠mm", "write 40mm"),
        (parse_length_mm, "4\nmm\n5", "write 40mm"),
        (parse_length_mm, "9" * 500 + "mm", "write 40mm"),
        (parse_modulus_kpa, "700", "write 700kPa"),
        (parse_modulus_gpa, "28", "write 28GPa"),
        (parse_modulus_gpa, "28mm", "allowed units are GPa, Pa, kPa, MPa"),
        (parse_strain, "30 mm", "allowed units are %"),
        (parse_temperature_c, "40", "write 40C"),
        (parse_temperature_c, "104F", "allowed units are C, °C, degC, K"),
    ],
)
def test_bad_quantities_are_refused_in_one_line(parse, text, says):
    with pytest.raises(ValueError, match=re.escape(says)) as caught:
        parse(text)
    assert len(str(caught.value).splitlines()) == 1


def test_a_unit_on_a_plain_number_is_refused():
    with pytest.raises(ValueError, match="must be a number without a unit"):
        parse_quantity("fabric.poisson", "0.4 mm")


@pytest.mark.parametrize(
    ("key", "text", "value"),
    [
        ("layout.loop_diameter_mm", "5 cm", 50),
        ("wire.modulus_hot_GPa", "75000 MPa", 75),
        ("fabric.modulus_kPa", "0.7 MPa", 700),
        ("fabric.prestrain", "30%", 0.3),
        ("wire.transition_C", "60C", 60),
        ("wire.resistivity_cold_uohm_cm", "0.8 uohm m", 80),
        ("wire.density_g_cm3", "6450 kg/m3", 6.45),
        ("fabric.areal_density_g_m2", "0.19 kg/m2", 190),
        ("fabric.poisson", "0.45", 0.45),
    ],
)
def test_text_for_a_key(key, text, value):
    assert parse_quantity(key, text) == value


def test_every_example_is_of_its_own_kind():
    for name, section in sections().items():
        for key in section.model_fields:
            kind = kind_of(f"{name}.{key}")
            assert kind.parse(kind.example.split(" or ")[-1]) > 0


@given(st.decimals(-1000, 1000, places=6), st.sampled_from([("mm", 1), ("cm", 10), ("m", 1000)]))
@settings(deadline=None, max_examples=100)
def test_the_nearest_number_comes_out(number, unit):
    assert parse_length_mm(f"{number:f} {unit[0]}") == float(Fraction(number) * unit[1])


@given(st.text("0123456789.,eE+- mcinµ٤%\n", max_size=80))
@settings(deadline=None, max_examples=200)
def test_any_text_is_a_length_or_refused_in_one_line(text):
    refusal = ""
    try:
        parse_length_mm(text)
    except ValueError as error:
        refusal = str(error)
    assert len(refusal.splitlines()) <= 1


@pytest.mark.parametrize(
    ("kind", "text", "value"),
    [
        (MASS_G, "0.04kg", 40),
        (MASS_G, "500 mg", 0.5),
        (TIME_S, "2min", 120),
        (TIME_S, "250ms", 0.25),
        (CURRENT_A, "900mA", 0.9),
    ],
)
def test_quantities_that_are_no_keys(kind, text, value):
    assert kind.parse(text) == value


@pytest.mark.parametrize(
    ("kind", "text", "ends"),
    [
        (LENGTH_MM, "15..45mm", (15, 45)),
        (LENGTH_MM, "1.5cm .. 45 mm", (15, 45)),
        (LENGTH_MM, ".5..1e1mm", (0.5, 10)),
        (TEMPERATURE_C, "-50..300C", (-50, 300)),
        (TEMPERATURE_C, "300K..80C", (26.85, 80)),
    ],
)
def test_ranges(kind, text, ends):
    assert parse_range(kind, text) == ends


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("45mm", "is not a range"),
        ("45..15mm", "the first must be less than the second"),
        ("15..15mm", "the first must be less than the second"),
        ("15..45", "has no unit"),
        ("15..45C", "is not a length"),
        ("..45mm", "is not a length"),
        ("15mm..", "is not a length"),
        ("1..2..3mm", "is not a length"),
    ],
)
def test_bad_ranges_are_refused_in_one_line(text, says):
    with pytest.raises(ValueError, match=says) as caught:
        parse_range(LENGTH_MM, text)
    assert "\n" not in str(caught.value)
