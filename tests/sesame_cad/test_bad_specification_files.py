"""Whole files that are no specification: each gives exactly its faults, one line each."""

import pytest

GOOD = """
[wire]
diameter_mm = 0.5
[layout]
rows = 4
columns = 4
loop_diameter_mm = 50
"""
MISSING = [
    "wire.diameter_mm: missing; give the wire's diameter in mm",
    "layout.rows: missing; give the number of rows of loops",
    "layout.columns: missing; give the number of loops in a row",
    "layout.loop_diameter_mm: missing; give the diameter in mm",
]

WHOLE_FILES = {
    "empty": (b"", MISSING),
    "only a comment": (b"# nothing", MISSING),
    "no wire": (
        GOOD.replace("[wire]\ndiameter_mm = 0.5", "").encode(),
        ["wire.diameter_mm: missing; give the wire's diameter in mm"],
    ),
    "misspelt section": (
        GOOD.replace("[wire]", "[wires]").encode(),
        ["wires: unknown section or key; did you mean [wire]?"],
    ),
    "keys before their sections": (
        b"rows = 3\n" + GOOD.encode(),
        ["rows: unknown section or key; did you mean layout.rows?"],
    ),
    "nothing like it": (
        b"[person]\n" + GOOD.encode(),
        ["person: unknown section or key; known here: name, fabric, wire, layout, model, "],
    ),
    "a section that is a number": (
        b"fabric = 3\n" + GOOD.encode(),
        ["fabric = 3: must be a section, [fabric] with keys below"],
    ),
    "a list of sections": (
        GOOD.replace("[wire]", "[[wire]]").encode(),
        ["wire = [{diameter_mm = 0.5}]: must be a section, [wire] with keys below"],
    ),
    "a name with a blank": (
        b'name = "my array"\n' + GOOD.encode(),
        ['name = "my array": must be 1 to 64 letters, digits and - _ . in quotes, and begin '],
    ),
    "a name that climbs out": (b'name = "../up"\n' + GOOD.encode(), ['name = "../up": must be 1 ']),
    "a name that is hidden": (b'name = ".x"\n' + GOOD.encode(), ['name = ".x": must be 1 to 64 ']),
    "an empty name": (b'name = ""\n' + GOOD.encode(), ['name = "": must be 1 to 64 letters']),
    "a long name": (
        b'name = "' + 65 * b"x" + b'"\n' + GOOD.encode(),
        ['name = "xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx...: must be 1 to 64'],
    ),
    "a name with a line": (b'name = "x\\n"\n' + GOOD.encode(), ['name = "x\\u000A": must be 1 to']),
    "a name that is a number": (b"name = 4\n" + GOOD.encode(), ["name = 4: must be 1 to 64"]),
    "not TOML": (b"[wire]\ndiameter_mm 0.5\n", ["line 2, column 13: not TOML: "]),
    "a number without its digits": (b"[wire]\ndiameter_mm =", ["line 2, column 14: not TOML: "]),
    "an open string": (b'name = "x', ["line 1, column 10: not TOML: Unterminated string"]),
    "a decimal comma": (b"[wire]\ndiameter_mm = 0,5\n", ["line 2, column 16: not TOML: "]),
    "a key twice": (b"[wire]\ndiameter_mm = 1\ndiameter_mm = 2\n", ["line 3, column 16: not TOML"]),
    "a section twice": (b"[wire]\n[wire]\n", ["line 2, column 6: not TOML: "]),
    "JSON": (b'{"wire": {"diameter_mm": 0.5}}', ["line 1, column 1: not TOML: Invalid statement"]),
    "nested beyond reason": (b"a = " + 20_000 * b"[", ["not TOML: nested too deeply"]),
    "an endless integer": (b"a = " + 9_000 * b"9", ["not TOML: Exceeds the limit"]),
    "a long integer": (
        GOOD.replace("rows = 4", f"rows = 0x{'f' * 9000}").encode(),
        [f"layout.rows = 0x{'f' * 55}...: must be from 1 to 200"],
    ),
    "a long value": (
        GOOD.replace("0.5", f'"{"x" * 500}"').encode(),
        [f'wire.diameter_mm = "{"x" * 56}...: must be a number from 0.001 to 10'],
    ),
    "a deep value": (
        GOOD.replace("0.5", f"{'[' * 400}{']' * 400}").encode(),
        ["wire.diameter_mm = ["],
    ),
    "a byte order mark": (
        b"\xef\xbb\xbf" + GOOD.encode(),
        ["begins with a byte order mark; save it as plain UTF-8"],
    ),
    "UTF-16": (GOOD.encode("utf-16"), ["begins with a byte order mark; save it as plain UTF-8"]),
    "Latin-1": (
        GOOD.encode() + "# Schlaufe für".encode("latin-1"),
        ["line 8: not text in UTF-8; save it as UTF-8"],
    ),
    "binary": (b"name = 1\0\0\0", ["a binary file, not a specification in TOML"]),
    "too long": (b"#" * 1_000_001, ["longer than 1 MB; not a specification"]),
    "many at once": (
        (
            b'[fabric]\npoisson = 0.7\nprestrain = "a"\n[wire]\ndiameter_mm = 60\n'
            b"modulus_hot_GPa = 0\n"
            b"[layout]\nrows = 0\ncolumns = 2\nloop_diameter_mm = 50\n[output]\nformat = 1\n"
        ),
        [
            'fabric.prestrain = "a": must be a number greater than 0 and at most 2',
            "fabric.poisson = 0.7: must be greater than -1 and less than 0.5",
            "wire.diameter_mm = 60: must be from 0.001 to 10",
            "wire.modulus_hot_GPa = 0: must be from 0.001 to 2000",
            "layout.rows = 0: must be from 1 to 200",
            "output.format: unknown key; did you mean formats?",
        ],
    ),
    "a fault between keys beside faults of other keys": (
        (
            b"[fabric]\npoisson = 0.7\n[wire]\ndiameter_mm = 0.5\nmodulus_hot_GPa = 0\n"
            b"[layout]\nrows = 0\ncolumns = 4\nloop_diameter_mm = 20\n"
        ),
        [
            "fabric.poisson = 0.7: must be greater than -1 and less than 0.5",
            "wire.modulus_hot_GPa = 0: must be from 0.001 to 2000",
            "layout.rows = 0: must be from 1 to 200",
            "layout.loop_diameter_mm = 20: must be at least 25: ",
        ],
    ),
}


@pytest.mark.parametrize("case", WHOLE_FILES)
def test_a_bad_file_gives_exactly_its_faults(tmp_path, faults_of, case):
    data, expected = WHOLE_FILES[case]
    path = tmp_path / "bad.toml"
    path.write_bytes(data)
    faults = faults_of(path)
    assert len(faults) == len(expected)
    for fault, beginning in zip(faults, expected, strict=True):
        assert fault.startswith(f"bad.toml: {beginning}")


def test_a_missing_file(tmp_path, faults_of):
    assert faults_of(tmp_path / "no.toml") == (
        "no.toml: cannot be read: No such file or directory",
    )


def test_a_directory(tmp_path, faults_of):
    assert faults_of(tmp_path) == (f"{tmp_path.name}: cannot be read: Is a directory",)


def test_a_file_without_permission(tmp_path, faults_of):
    path = tmp_path / "secret.toml"
    path.write_text(GOOD)
    path.chmod(0)
    try:
        path.read_bytes()
    except PermissionError:
        assert faults_of(path) == ("secret.toml: cannot be read: Permission denied",)
    else:
        pytest.skip("whoever runs this may read every file")


def test_a_path_that_no_file_can_have(faults_of):
    assert len(faults_of("a\0b.toml")) == 1
