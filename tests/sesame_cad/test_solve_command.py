import json

import pytest
from click.testing import CliRunner

from sesame_cad.cli import cli

LOOP = ["solve", "--strain", "0.3", "--beta", "0.0145", "--poisson", "0.3"]


def _run(*arguments):
    return CliRunner().invoke(cli, [*LOOP, *arguments])


def test_json_alone_on_stdout():
    result = _run("--axial-stiffness", "1000", "--json")
    assert result.exit_code == 0
    data = json.loads(result.stdout)
    assert data["height_over_perimeter"] == pytest.approx(0.13125, abs=1e-5)
    assert data["buckled"] is True
    assert data["status"] == "converged"
    assert data["height_mm"] is None


def test_published_reading_is_another_energy():
    plane, published = (
        json.loads(_run("--json", *more).stdout)["energy"]
        for more in ([], ["--reading", "published"])
    )
    assert published > 1.2 * plane


def test_a_person_is_told_what_was_left_out():
    result = _run()
    assert "saddle" in result.stdout
    assert "left out: twist of the wire" in result.stdout


def test_flat_says_so():
    result = CliRunner().invoke(
        cli, ["solve", "--strain", "0.1", "--beta", "0.03", "--poisson", "0.3"]
    )
    assert "flat (below the buckling threshold)" in result.stdout


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--strain", "-0.1"], "strain"),
        (["--strain", "nan"], "strain"),
        (["--beta", "0"], "beta"),
        (["--beta", "inf"], "beta"),
        (["--poisson", "0.7"], "poisson"),
        (["--axial-stiffness", "-1"], "axial_stiffness"),
    ],
)
def test_numbers_out_of_range(arguments, named, faults_of_command):
    (fault,) = faults_of_command([*LOOP, *arguments])
    assert fault.startswith(f"error: {named} = ")


def test_no_shape_to_rely_on_is_an_error():
    result = CliRunner().invoke(
        cli, ["solve", "--strain", "0.3", "--beta", "0.002", "--poisson", "0.3", "--json"]
    )
    assert result.exit_code == 1
    assert result.stdout == ""
    assert "not a minimum" in result.stderr
