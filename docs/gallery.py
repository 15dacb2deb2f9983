"""Draw the gallery: the pictures of every example, as `design` draws them.

    python docs/gallery.py [FOLDER]

writes ``NAME-plan.png``, ``NAME-shapes.png`` and the like, beside the documentation's other
pictures unless a folder is given.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path

import sesame_cad
from sesame_cad.package import pictures

DOCS = Path(__file__).parent
EXAMPLES = DOCS.parent / "examples"


def draw(names: Iterable[str], folder: Path) -> None:
    """Draw some examples into a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name in names:
        design = sesame_cad.design(EXAMPLES / f"{name}.toml")
        for path, content in pictures(design.made):
            (folder / f"{name}-{Path(path).name}").write_bytes(content)


if __name__ == "__main__":
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else DOCS / "pictures" / "gallery"
    draw(sorted(file.stem for file in EXAMPLES.glob("*.toml")), target)
