"""Which known key a misspelt or misplaced one was meant to be."""

from __future__ import annotations

from difflib import get_close_matches

from sesame_cad.specification.specification import sections

LEAST_LIKENESS = 0.5
"""Below this ratio of `difflib` a suggestion would mislead more than help."""

LEAST_LIKENESS_ELSEWHERE = 0.85
"""The same for keys of other sections, which are many."""


def nearest_key(keys: tuple[str, ...]) -> tuple[str, ...] | None:
    """Find the known keys that are nearest to unknown ones.

    A key is looked for in its own section first, then in all of them; a key outside of every
    section is looked for among the sections' names, then in the sections.
    """
    *section, wrong = keys
    beside = list(sections()[section[0]].model_fields) if section else ["name", *sections()]
    near = get_close_matches(wrong, beside, 1, LEAST_LIKENESS)
    return (*section, near[0]) if near else _elsewhere(wrong)


def _elsewhere(wrong: str) -> tuple[str, ...] | None:
    homes = {key: (name, key) for name, model in sections().items() for key in model.model_fields}
    near = get_close_matches(wrong, [*homes, *sections()], 1, LEAST_LIKENESS_ELSEWHERE)
    return homes.get(near[0], (near[0],)) if near else None
