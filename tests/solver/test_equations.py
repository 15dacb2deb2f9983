"""Docstrings and the numbered equations of docs/theory.md lead to each other."""

import ast
import re
from pathlib import Path

ROOT = Path(__file__).parents[2]
NUMBERED = re.compile(r"^ {4}.*\((\d+)\)$", re.MULTILINE)
REFERRED = re.compile(r"\beq\.\s+\((\d+)\)")
DOCUMENTED = (ast.Module, ast.ClassDef, ast.FunctionDef)


def _equations():
    text = (ROOT / "docs" / "theory.md").read_text(encoding="utf-8")
    return [int(number) for number in NUMBERED.findall(text)]


def _documented(node):
    """The node and all that is public in it."""
    yield node
    for child in node.body:
        if isinstance(child, DOCUMENTED[1:]) and not child.name.startswith("_"):
            yield from _documented(child)


def _references():
    """Numbers in docstrings, each with where it stands and whether a function or class has it."""
    for path in sorted((ROOT / "solver").rglob("*.py")):
        for node in _documented(ast.parse(path.read_text(encoding="utf-8"))):
            text = ast.get_docstring(node) or ""
            for number in REFERRED.findall(text):
                assert "docs/theory.md" in text, f"{path}: eq. ({number}) of what?"
                yield int(number), path.name, not isinstance(node, ast.Module)


def test_equations_are_numbered_in_their_order():
    numbers = _equations()
    assert numbers == list(range(1, len(numbers) + 1))
    assert len(numbers) >= 23


def test_every_equation_is_referred_to_by_what_computes_it():
    computed = {number for number, _, code in _references() if code}
    assert set(_equations()) - computed == set()


def test_no_docstring_refers_to_an_equation_that_is_not_there():
    known = set(_equations())
    assert [(name, number) for number, name, _ in _references() if number not in known] == []
