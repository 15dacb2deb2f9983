"""Tables of curves."""

import csv

import pytest

from sesame_cad.files.table_csv import table_csv


def test_numbers_words_and_gaps_read_back():
    columns = {
        "gap_mm": [15, 1 / 3],
        "force_N": [None, 1e-12],
        "status": ['a "b", c', "converged"],
    }
    text = table_csv(columns)
    rows = list(csv.DictReader(text.splitlines()))
    assert rows[0] == {"gap_mm": "15", "force_N": "", "status": 'a "b", c'}
    assert float(rows[1]["gap_mm"]) == pytest.approx(1 / 3, rel=1e-8)
    assert float(rows[1]["force_N"]) == 1e-12
    assert text.endswith("\n")


def test_columns_of_different_length_are_refused():
    with pytest.raises(ValueError, match="shorter"):
        table_csv({"one": [1, 2], "other": [1]})
