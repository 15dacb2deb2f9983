from patterns.violation import Violation


def test_a_violation_is_one_line_that_counts_from_one() -> None:
    fault = Violation("hoop", "outside the hoop", 1.0, -2.5, 0, 9, 3.0, 2.0)
    expected = "hoop: outside the hoop at (1.00, -2.50) mm, block 1, stitch 10: 3.000"
    assert str(fault) == f"{expected} (allowed 2.000)"


def test_what_is_not_known_is_left_out() -> None:
    assert str(Violation("blocks", "missing", 0.0, 0.0)) == "blocks: missing at (0.00, 0.00) mm"
