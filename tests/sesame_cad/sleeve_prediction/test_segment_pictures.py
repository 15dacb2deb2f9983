from sesame_cad.pictures.landscape import landscape_picture
from sesame_cad.pictures.sleeve_force import sleeve_force_picture
from sesame_cad.sleeve_prediction.curves import ForceCurve

PNG = b"\x89PNG\r\n\x1a\n"


def test_the_landscape_is_drawn(prediction):
    assert landscape_picture(prediction)[:8] == PNG


def test_the_curves_are_drawn(prediction):
    pitch = [20.0, 25.0]
    curves = [ForceCurve(name, *([pitch] * 4)) for name in ("cold", "hot")]
    pictures = [sleeve_force_picture(prediction, curves) for _ in range(2)]
    assert pictures[0][:8] == PNG
    assert pictures[0] == pictures[1]
