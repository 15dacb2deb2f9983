"""What a maker decides: sections of keys in a TOML file, checked all at once."""

from sesame_cad.specification.loading import load_specification, specification_from
from sesame_cad.specification.schema import json_schema
from sesame_cad.specification.specification import Specification

__all__ = ["Specification", "json_schema", "load_specification", "specification_from"]
