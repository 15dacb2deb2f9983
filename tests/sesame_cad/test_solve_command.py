import json
import subprocess
import sys

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
    slack = ["solve", "--strain", "0.3", "--beta", "0.002", "--poisson", "0.3", "--json"]
    result = CliRunner().invoke(cli, [*slack, "--fidelity", "compact"])
    assert result.exit_code == 1
    assert result.stdout == ""
    assert "not a minimum" in result.stderr
    added = json.loads(CliRunner().invoke(cli, [*slack, "--tolerance", "0.005"]).stdout)
    assert added["rung"] == "mesh"
    assert "fabric stretch (tension field)" in added["energy_terms"]


def test_every_rung_gives_the_same_keys():
    keys = []
    for fidelity in ("scaling", "compact", "mesh"):
        result = _run("--fidelity", fidelity, "--tolerance", "0.01", "--json")
        data = json.loads(result.stdout)
        assert data["rung"] == fidelity
        assert data["height_over_perimeter"] == pytest.approx(0.1312, rel=0.08)
        keys.append(set(data) - {"kind", "loop_heights_over_radius", "triangles"})
    assert keys[0] | {"compressed_fraction"} == keys[1] | {"compressed_fraction"}
    assert keys[1] | {"compressed_fraction"} == keys[2]


def test_an_error_that_is_not_known_is_told():
    slack = ["solve", "--strain", "0.3", "--beta", "1e-6", "--poisson", "0.3"]
    run = CliRunner().invoke(cli, [*slack, "--fidelity", "scaling"])
    (line,) = (line for line in run.stdout.splitlines() if "error of the height" in line)
    assert line.split("height")[1].strip() == "not known"
    assert "warning, left out: slack fabric" in run.stdout
    data = json.loads(CliRunner().invoke(cli, [*slack, "--fidelity", "scaling", "--json"]).stdout)
    assert data["height_error"] is None
    assert data["status"] == "not compared"


@pytest.mark.parametrize("loops", [("1x1", "cut"), ("2x2", "cut"), ("1x3", "kept")])
def test_the_law_loads_neither_meshes_nor_sparse_matrices(loops):
    arguments = [*LOOP, "--fidelity", "scaling", "--loops", loops[0], "--between", loops[1]]
    program = (
        "import sys\n"
        "from sesame_cad.cli import cli\n"
        f"cli({[*arguments, '--json']!r}, standalone_mode=False)\n"
        "print([m for m in sys.modules if m.startswith(('scipy.sparse', 'solver.mesh'))])\n"
    )
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=True
    )
    *answer, modules = run.stdout.strip().splitlines()
    assert modules == "[]"
    data = json.loads("\n".join(answer))
    assert ("tile" in data["reason"]) == (loops[0] != "1x1")
    alone = json.loads(_run("--fidelity", "scaling", "--json").stdout)
    assert data["height_over_perimeter"] == alone["height_over_perimeter"]


@pytest.mark.parametrize("tolerance", ["nan", "-1", "inf"])
@pytest.mark.parametrize("fidelity", ["scaling", "auto"])
def test_a_tolerance_that_cannot_be(tolerance, fidelity, faults_of_command):
    (fault,) = faults_of_command([*LOOP, "--fidelity", fidelity, "--tolerance", tolerance])
    assert fault.startswith("error: --tolerance: ")


def test_a_shape_tells_its_writhe_and_how_near_it_comes_to_itself():
    flat = ["solve", "--strain", "0.1", "--beta", "0.03", "--poisson", "0.3", "--json"]
    disc = json.loads(CliRunner().invoke(cli, [*flat, "--fidelity", "compact"]).stdout)
    assert disc["writhe"] == pytest.approx(0, abs=1e-9)
    # opposite points; a quarter turn apart are the nearest that are compared
    assert disc["distances"]["wire_to_wire"] == pytest.approx(2**0.5, rel=1e-3)
    saddle = json.loads(_run("--json").stdout)
    assert saddle["writhe"] == pytest.approx(0, abs=1e-6)
    near = saddle["distances"]
    assert near["wire_diameter_over_radius"] == pytest.approx((32 * 0.0145 / 1000) ** 0.5)
    assert 0.2 < near["wire_to_fabric"] < near["wire_to_wire"] < 2**0.5
    ellipse = ("--axis-ratio", "1.5", "--fidelity", "compact", "--beta", "0.0225", "--json")
    assert abs(json.loads(_run(*ellipse).stdout)["writhe"]) > 1e-3
    law = json.loads(_run("--fidelity", "scaling", "--json").stdout)
    assert law["writhe"] is None
    assert law["distances"] is None


def test_a_mesh_tells_its_writhe_and_how_near_it_comes_to_itself():
    apart = json.loads(_run("--fidelity", "mesh", "--tolerance", "0.05", "--json").stdout)
    assert apart["writhe"] == pytest.approx(0, abs=1e-6)
    near = apart["distances"]
    assert near["wire_to_wire"] is None
    assert near["looked_over_radius"] == pytest.approx(0.1)
    assert near["crossings"] == 0


def test_what_a_dimensionless_solve_cannot_know_is_told():
    left = {one["term"]: one for one in json.loads(_run("--json").stdout)["omitted_terms"]}
    assert left["gravity"]["value"] is None
    assert "weight of a loop / (E_f t R)" in left["gravity"]["measure"]
    share = left["bending of the fabric"]["value"]
    thin = json.loads(_run("--alpha", "1e-5", "--json").stdout)["omitted_terms"]
    (told,) = (one for one in thin if one["term"] == "bending of the fabric")
    assert told["value"] == pytest.approx(1e-5 * share, rel=1e-6)
    assert sum(one["term"] == "gravity" for one in thin) == 1
    law = json.loads(_run("--fidelity", "scaling", "--json").stdout)["omitted_terms"]
    assert {"gravity", "bending of the fabric"} <= {one["term"] for one in law}


def test_arrays_and_ellipses():
    tiled = json.loads(_run("--loops", "3x3", "--json").stdout)
    assert tiled["rung"] == "compact"
    ellipse = ("--axis-ratio", "1.2", "--json")
    untwisted = json.loads(_run(*ellipse, "--fidelity", "compact").stdout)
    assert untwisted["height_over_perimeter"] == pytest.approx(0.1294, abs=2e-4)
    assert untwisted["kind"] == "diagonal"
    assert json.loads(_run(*ellipse).stdout)["kind"] == "aligned"
    pair = ("--loops", "1x2", "--axis-ratio", "1.2", "--tolerance", "0.05", "--json")
    coupled = json.loads(_run(*pair).stdout)
    assert coupled["rung"] == "mesh"
    assert len(coupled["loop_heights_over_radius"]) == 2


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--loops", "3by3"], "--loops"),
        (["--loops", "0x3"], "--loops"),
        (["--loops", "999x999", "--between", "kept"], "999"),
        (["--axis-ratio", "0.5"], "axis_ratio"),
        (["--modulus-ratio", "-1"], "modulus_ratio"),
        (["--axis-ratio", "2", "--fidelity", "scaling"], "compact"),
    ],
)
def test_scenes_that_cannot_be(arguments, named, faults_of_command):
    (fault,) = faults_of_command([*LOOP, *arguments])
    assert named in fault


def test_bending_of_the_fabric_and_twist_of_the_wire():
    stiff = json.loads(_run("--alpha", "0.1", "--json").stdout)
    assert stiff["energy_terms"]["fabric bending"] > 0
    assert "fabric bending" in stiff["terms"]
    limp = json.loads(_run("--alpha", "2.4e-5", "--json").stdout)
    told = {left["term"]: left for left in limp["omitted_terms"]}["bending of the fabric"]
    assert told["measure"] == "its energy / energy released by buckling"
    assert 0 < told["value"] < 1e-5
    ellipse = ("--axis-ratio", "1.2", "--fidelity", "compact", "--json")
    twisted = json.loads(_run(*ellipse, "--twist-ratio", "0.75").stdout)
    assert twisted["kind"] == "aligned"


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (["--alpha", "1.5"], "alpha = 1.5"),
        (["--alpha", "-1"], "alpha = -1"),
        (["--twist-ratio", "-1"], "twist_ratio = -1"),
        (["--alpha", "0.1", "--fidelity", "scaling"], "alpha = 0"),
    ],
)
def test_stiffnesses_that_cannot_be(arguments, named, faults_of_command):
    (fault,) = faults_of_command([*LOOP, *arguments])
    assert named in fault


def test_contact_is_left_out_on_demand():
    arguments = ("--loops", "2x2", "--between", "kept", "--contact", "off", "--tolerance", "0.5")
    data = json.loads(_run(*arguments, "--json").stdout)
    assert "contact was left out, as asked" in data["reason"]
    (left,) = (o for o in data["omitted_terms"] if o["term"].startswith("contact"))
    assert left["matters"]
    assert left["value"] > 0
    assert data["contact"] is None


def test_arrays_too_large_for_contact_name_the_remedy():
    result = _run("--loops", "10x10", "--between", "kept")
    assert result.exit_code == 1
    assert "--contact off" in result.stderr
