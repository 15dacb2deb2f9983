"""What several tests of the product need."""

import pytest

from sesame_cad.errors import InputError
from sesame_cad.specification import load_specification


@pytest.fixture
def faults_of():
    """Load a specification that must not load, and give its faults; each must be one line."""

    def load(path, overrides=None):
        with pytest.raises(InputError) as caught:
            load_specification(path, overrides)
        assert all(len(fault.splitlines()) == 1 for fault in caught.value.faults)
        return caught.value.faults

    return load
