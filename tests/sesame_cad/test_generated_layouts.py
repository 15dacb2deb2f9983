"""Generated layouts and labels through writing and reading back, in every format.

``python tests/sesame_cad/test_generated_layouts.py 10000`` tries so many, on two cores.
"""

import io
import os
import sys
from collections import Counter
from math import cos, radians, sin
from multiprocessing import Pool

import numpy as np
import pystitch
from hypothesis import HealthCheck, given, seed, settings
from hypothesis import strategies as st

from patterns.records import plan_from_records, plan_records
from sesame_cad.errors import InputError
from sesame_cad.files.dst import clean_label, decode_dst, write_dst
from sesame_cad.files.stitch_formats import FORMATS, write_embroidery
from sesame_cad.pipeline import pattern
from sesame_cad.specification import specification_from
from sesame_cad.threads import threads_of

READERS = {
    "dst": pystitch.DstReader,
    "exp": pystitch.ExpReader,
    "u01": pystitch.U01Reader,
    "pes": pystitch.PesReader,
    "jef": pystitch.JefReader,
    "vp3": pystitch.Vp3Reader,
}
FAR_MM = 0.05
SUITE = 30
outcomes = Counter()


@st.composite
def chains(draw):
    """Tangent circles, each to the right of the one before."""
    x, y, size = 0.0, 0.0, draw(st.integers(200, 500)) / 10
    circles = [{"x_mm": x, "y_mm": y, "diameter_mm": size}]
    for _ in range(draw(st.integers(0, 5))):
        other, angle = draw(st.integers(200, 500)) / 10, radians(draw(st.integers(-40, 40)))
        apart = (size + other) / 2
        x, y, size = x + apart * cos(angle), y + apart * sin(angle), other
        circles.append({"x_mm": round(x, 4), "y_mm": round(y, 4), "diameter_mm": size})
    return {"kind": "circles", "circles": circles}


@st.composite
def lattices(draw):
    layout = {
        "kind": draw(st.sampled_from(["grid", "brick", "hexagonal", "row"])),
        "columns": draw(st.integers(1, 4)),
        "loop_diameter_mm": draw(st.integers(150, 600)) / 10,
    }
    return layout if layout["kind"] == "row" else layout | {"rows": draw(st.integers(1, 3))}


@st.composite
def sections(draw):
    wire = {"diameter_mm": draw(st.integers(5, 50)) / 100}
    layout = draw(st.one_of(lattices(), chains()))
    side = draw(st.sampled_from(["corner", "left", "right", "top", "bottom"]))
    stitching = {
        "couching_interval_mm": draw(st.integers(10, 40)) / 10,
        "cover_spacing_mm": draw(st.integers(25, 60)) / 100,
        "tail_length_mm": draw(st.integers(15, 60)),
    }
    return {
        "wire": wire,
        "layout": layout | {"terminals": side, "shape": "none"},
        "stitching": stitching,
    }


def blocks_by_library(data, kind):
    """Needle points in mm of each block, as pystitch reads them."""
    found = pystitch.EmbPattern()
    as_it_is = {"trims": False, "trim_distance": None, "clipping": False}
    READERS[kind].read(io.BytesIO(data), found, as_it_is)
    blocks = [[]]
    for x, y, code in found.stitches:
        if code & 0xFF in {pystitch.STOP, pystitch.COLOR_CHANGE}:
            blocks.append([])
        elif code & 0xFF == pystitch.STITCH:
            blocks[-1].append((x / 10, -y / 10))
    return [np.array(block) for block in blocks]


def assert_comes_back(given_sections, label):
    """Every point within 0.05 mm of the plan; blocks, runs and stops equal."""
    try:
        spec = specification_from(given_sections, "generated", "test")
        plan = pattern(spec).plan
    except InputError:
        outcomes["refused"] += 1
        return
    outcomes["sewn"] += 1
    records = plan_records(plan, spec.patterns_machine())
    threads = threads_of(plan, spec.machine)
    files = {kind: write_embroidery(records, kind, threads) for kind in FORMATS}
    files["dst"] = write_dst(records, label)
    decoded = decode_dst(files["dst"])
    assert decoded.header.label == clean_label(label)
    again = plan_from_records(decoded.records, plan.blocks)
    for one, other in zip(again.blocks, plan.blocks, strict=True):
        assert len(one.runs) == len(other.runs)
        for run, right in zip(one.runs, other.runs, strict=True):
            assert run.approach == right.approach
            np.testing.assert_array_equal(run.needles, right.needles)
    expected = [np.concatenate([run.needles for run in b.runs]) / 10 for b in plan.blocks]
    for kind, data in files.items():
        found = blocks_by_library(data, kind)
        assert [len(block) for block in found] == [len(block) for block in expected], kind
        for one, other in zip(found, expected, strict=True):
            assert np.abs(one - other).max() <= FAR_MM, kind


@settings(deadline=None, max_examples=SUITE, suppress_health_check=[HealthCheck.too_slow])
@given(sections(), st.text(max_size=40))
def test_every_layout_and_label_comes_back(given_sections, label):
    assert_comes_back(given_sections, label)


def _explore(part):
    """Try a share of the examples, with a seed of its own."""
    number, examples = part
    profile = settings(deadline=None, max_examples=examples, derandomize=False, database=None)
    searching = given(sections(), st.text(max_size=40))(assert_comes_back)
    profile(seed(number)(searching))()
    counted = Counter(outcomes)
    outcomes.clear()
    return counted


if __name__ == "__main__":
    wanted = int(sys.argv[1])
    cores = min(2, os.cpu_count() or 1)
    with Pool(cores) as pool:
        found = sum(pool.imap(_explore, [(k, wanted // 20) for k in range(20)]), Counter())
    print(f"{found['sewn']} layouts came back, {found['refused']} were refused")
