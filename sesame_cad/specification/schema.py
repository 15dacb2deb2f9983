"""The specification as a JSON schema, for editors that complete and check TOML."""

from __future__ import annotations

from typing import Any

from sesame_cad.specification.specification import Specification

TITLE = "sesame-cad specification"


def json_schema() -> dict[str, Any]:
    """Describe specification files: every key with its unit, limits and default.

    Returns
    -------
    dict
        A JSON schema (2020-12). ``name`` is neither required nor has a default: the file's own
        name stands in for it.
    """
    schema = Specification.model_json_schema()
    schema["title"] = TITLE
    schema["description"] = "An array of shape-memory loops on stretched fabric."
    schema["required"] = [key for key in schema["required"] if key != "name"]
    schema["$schema"] = "https://json-schema.org/draft/2020-12/schema"
    return schema
