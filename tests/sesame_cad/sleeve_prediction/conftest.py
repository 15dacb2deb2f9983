from pathlib import Path

import pytest

from sesame_cad.sleeve_prediction.segment import predict_sleeve
from sesame_cad.specification import load_specification

EXAMPLE = Path(__file__).parents[3] / "examples/beam-sleeves.toml"


@pytest.fixture(scope="session")
def spec():
    return load_specification(EXAMPLE)


@pytest.fixture(scope="session")
def prediction(spec):
    return predict_sleeve(spec)
