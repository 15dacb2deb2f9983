"""Data inside a page, as JSON in elements that a browser does not show."""

from __future__ import annotations

import json
import re
from typing import Any

from sesame_cad.errors import DesignFileError


def embedded(name: str, value: Any) -> str:
    """Put data into a page; no text in it can end the element that holds it."""
    text = json.dumps(value, ensure_ascii=False, allow_nan=False, separators=(",", ":"))
    safe = text.replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{safe}</script>'


def read_embedded(page: str, name: str) -> Any:
    """Read data of a name out of a page.

    Raises
    ------
    DesignFileError
        When there is none, or it is no JSON.
    """
    found = re.search(
        rf'<script type="application/json" id="{re.escape(name)}">([^<]*)</script>', page
    )
    if found is None:
        raise DesignFileError(f"the page holds no data named {name}")
    try:
        return json.loads(found[1])
    except (ValueError, RecursionError) as error:
        raise DesignFileError(f"the page's data named {name} cannot be read: {error}") from None
