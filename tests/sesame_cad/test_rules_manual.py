"""docs/rules.md tells every rule, and keys that there are."""

import ast
import re
from pathlib import Path

from patterns.rules import catalogue
from patterns.rules.catalogue import CATALOGUE, catalogue_table
from sesame_cad.specification.specification import sections

ROOT = Path(__file__).parents[2]
MANUAL = ROOT / "docs" / "rules.md"
TABLE = re.compile(r"(<!-- rules: .*? -->\n).*(<!-- end of rules -->)", re.DOTALL)

OF_SHEETS = ("beam_rules.py", "cut_rules.py", "nest_rules.py")


def _with_table(text):
    return TABLE.sub(lambda found: f"{found[1]}\n{catalogue_table()}\n\n{found[2]}", text)


def names_in_code():
    """Words that a rule's module gives as the rule of a violation."""
    found = set()
    rules = Path(catalogue.__file__).parent
    for file in (*rules.glob("*.py"), *(rules.parent / name for name in OF_SHEETS)):
        if file.name == "catalogue.py":
            continue
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and not ast.unparse(node.func).endswith(".replace"):
                found |= {a.value for a in node.args[:3] if isinstance(a, ast.Constant)}
            elif isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "_RULE":
                found.add(node.value.value)
    return {name for name in found if isinstance(name, str) and re.fullmatch(r"[a-z-]{3,}", name)}


def test_the_manual_holds_the_catalogue():
    """To mend: python tests/sesame_cad/test_rules_manual.py."""
    text = MANUAL.read_text(encoding="utf-8")
    assert _with_table(text) == text


def test_every_rule_in_the_code_is_in_the_catalogue_and_no_other():
    names = [note.name for note in CATALOGUE]
    assert len(set(names)) == len(names)
    assert set(names) == names_in_code()


def test_the_keys_are_keys_of_a_specification():
    for note in CATALOGUE:
        for path in note.keys:
            section, _, key = path.partition(".")
            assert key in sections()[section].model_fields, path


if __name__ == "__main__":
    MANUAL.write_text(_with_table(MANUAL.read_text(encoding="utf-8")), encoding="utf-8")
