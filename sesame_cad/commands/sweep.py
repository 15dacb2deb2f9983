"""``sesame-cad sweep``: a whole design space instead of one design."""

from __future__ import annotations

import os
import re
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

import click

from sesame_cad.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from sesame_cad.sweeps.axis import Axis
    from sesame_cad.sweeps.plan import SweepPlan
    from sesame_cad.sweeps.store import SweepStore

FIG_2 = MappingProxyType(
    {
        "strain": "0:0.5:26",
        "beta": "0.01:0.25:25",
        "poisson": "0.446",
        "axial_stiffness": "1000",
        "reading": "published",
    }
)
"""The paper's Fig. 2; of Poisson's ratio, which it does not give, that which gives its heights."""

LARGE = 20_000
"""Points from which a sweep of single loops is shared by all processors: they take ten seconds."""

INTERRUPTED = 130

_GRID = re.compile(r"([1-9][0-9]{0,2})\s*[x×]\s*([1-9][0-9]{0,2})")


@click.command("sweep")
@click.argument("spec", required=False, type=click.Path(path_type=Path))
@click.option("--set", "sets", multiple=True, help="With SPEC: KEY=RANGE of any numeric key.")
@click.option("--state", type=click.Choice(["cold", "hot"]), help="With SPEC. [cold]")
@click.option("--strain", help=f"Range of the prestrain. [{FIG_2['strain']}]")
@click.option("--beta", help=f"Range of β. [{FIG_2['beta']}]")
@click.option("--poisson", help=f"Poisson's ratio, or a range. [{FIG_2['poisson']}]")
@click.option("--axial-stiffness", help=f"Wire's E_w A_w/(E_f t R). [{FIG_2['axial_stiffness']}]")
@click.option(
    "--reading",
    type=click.Choice(["plane-stress", "published"]),
    help=f"Reading of the fabric's energy. [{FIG_2['reading']}]",
)
@click.option("--loops", help="Rows x columns of an array, solved on a mesh. [1x1]")
@click.option("--between", type=click.Choice(["cut", "kept"]), help="Fabric between them. [cut]")
@click.option(
    "--tolerance",
    type=click.FloatRange(1e-6, 0.1),
    help="Relative error allowed in the height. [0.001; on a mesh 0.1]",
)
@click.option("--scheduler", help="Address of a Dask scheduler, such as tcp://10.0.0.1:8786.")
@click.option(
    "--workers",
    type=click.IntRange(0, 1024),
    help="Processes on this machine; 0 is none. [all processors if the sweep is large]",
)
@click.option("--parquet", is_flag=True, help="Write the table as sweep.parquet too.")
@click.option("--output", "-o", type=click.Path(path_type=Path), help="Folder. [sweep]")
@click.option("--json", "as_json", is_flag=True, help="Print sweep.json to stdout.")
@click.option("--quiet", "-q", is_flag=True, help="Print nothing.")
def command(
    spec: Path | None,
    sets: tuple[str, ...],
    state: str | None,
    scheduler: str | None,
    workers: int | None,
    parquet: bool,
    output: Path | None,
    as_json: bool,
    quiet: bool,
    **dimensionless: Any,
) -> None:
    """Solve a grid of loops or of designs: sweep.csv, and a picture of one or two swept keys.

    Without SPEC the dimensionless model, by default over Fig. 2 of the paper. With SPEC any of its
    numeric keys: --set layout.loop_diameter_mm=20:60:9. A RANGE is first:last:count, values with
    commas, or one value. What is solved stays on disk: the same command goes on after an
    interruption.
    """
    # small matrices, and the same last digit on every machine
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if scheduler is not None and workers is not None:
        raise InputError("--workers starts processes here, --scheduler uses others: give one")
    if spec is None:
        plan = _loops_plan(sets, state, dimensionless)
    else:
        plan = _designs_plan(spec, sets, state or "cold", dimensionless)
    plan.check()
    if parquet:
        _check_parquet()
    from sesame_cad.sweeps.store import SweepStore

    default = "sweep" if spec is None else f"{spec.stem}-sweep"
    store = SweepStore(output or Path(default), plan)
    try:
        _solve(store, scheduler, workers, quiet=quiet or as_json)
    except KeyboardInterrupt:
        left = len(store.missing())
        click.echo(
            f"error: interrupted; {plan.chunks - left} of {plan.chunks} parts are kept in "
            f"{store.folder}, and the same command goes on with the rest",
            err=True,
        )
        raise click.exceptions.Exit(INTERRUPTED) from None
    data = _finish(store, parquet=parquet)
    if as_json:
        import json

        click.echo(json.dumps(data, indent=2, ensure_ascii=False))
    elif not quiet:
        _print(data, store.folder)


def _axes(ranges: dict[str, str], named: Callable[[str], str]) -> tuple[Axis, ...]:
    """Read the ranges of keys; all faults at once, each with the option that gave it."""
    from sesame_cad.sweeps.axis import parse_axis

    axes: list[Axis] = []
    faults: list[str] = []
    for key, text in ranges.items():
        try:
            axes.append(parse_axis(key, text))
        except ValueError as error:
            faults.append(f"{named(key)}: {error}")
    if faults:
        raise InputError(*faults)
    return tuple(axes)


def _loops_plan(sets: tuple[str, ...], state: str | None, given: dict[str, Any]) -> SweepPlan:
    """Plan a sweep of the dimensionless model."""
    if sets or state is not None:
        raise InputError("--set and --state are keys of a specification: give SPEC")
    from sesame_cad.sweeps.loops import KEYS, LoopModel
    from sesame_cad.sweeps.plan import SweepPlan

    ranges = {key: given[key] if given[key] is not None else FIG_2[key] for key in KEYS}
    axes = _axes(ranges, lambda key: f"--{key.replace('_', '-')}")
    reading = given["reading"] or FIG_2["reading"]
    grid = _GRID.fullmatch((given["loops"] or "1x1").strip())
    if grid is None:
        raise InputError(f"--loops: {given['loops']!r} is not rows x columns, such as 3x3")
    rows, columns = int(grid[1]), int(grid[2])
    if rows * columns == 1:
        if given["between"] is not None:
            raise InputError("--between: there is nothing between one loop; give --loops")
        return SweepPlan(LoopModel(reading, given["tolerance"] or 1e-3), axes)
    from sesame_cad.sweeps.arrays import ArrayModel

    between, tolerance = given["between"] or "cut", given["tolerance"] or 0.1
    return SweepPlan(ArrayModel(rows, columns, between, reading, tolerance), axes)


def _designs_plan(
    path: Path, sets: tuple[str, ...], state: str, given: dict[str, Any]
) -> SweepPlan:
    """Plan a sweep of a specification's keys."""
    faults = [
        f"--{option.replace('_', '-')}: not with SPEC, whose own keys say it"
        for option, value in given.items()
        if value is not None
    ]
    if faults:
        raise InputError(*faults)
    from sesame_cad.specification import load_specification
    from sesame_cad.sweeps.designs import DesignModel, numeric_keys
    from sesame_cad.sweeps.plan import SweepPlan

    ranges: dict[str, str] = {}
    for text in sets:
        key, equals, values = text.partition("=")
        key = key.strip()
        if not equals:
            faults.append(f"--set {text!r}: write KEY=RANGE, such as wire.diameter_mm=0.3:0.6:7")
        elif key not in numeric_keys():
            faults.append(f"--set {key}: {_no_such_key(key)}")
        elif key in ranges:
            faults.append(f"--set {key}: given twice")
        else:
            ranges[key] = values
    if not sets:
        faults.append("sweep what? give --set KEY=RANGE, such as wire.diameter_mm=0.3:0.6:7")
    if faults:
        raise InputError(*faults)
    specification = load_specification(path)
    mapping = specification.model_dump(mode="json", exclude_none=True)
    coupled = specification.predicted_shape == "coupled"
    return SweepPlan(
        DesignModel(mapping, state, coupled), _axes(ranges, lambda key: f"--set {key}")
    )


def _no_such_key(key: str) -> str:
    import difflib

    from sesame_cad.sweeps.designs import numeric_keys

    near = difflib.get_close_matches(key, numeric_keys(), n=1)
    hint = f"; did you mean {near[0]}?" if near else ""
    return f"no key of a specification that holds one number{hint}"


def _check_parquet() -> None:
    from importlib.util import find_spec

    if find_spec("pyarrow") is None:
        raise InputError("--parquet: needs pyarrow: pip install 'sesame-cad[parquet]'")


def _solve(store: SweepStore, scheduler: str | None, workers: int | None, *, quiet: bool) -> None:
    """Solve what is missing, here or on a cluster, telling how far it is."""
    from sesame_cad.progress import telling

    missing = store.missing()
    if not missing:
        return
    with telling(quiet=quiet) as progress:
        done = store.plan.chunks - len(missing)

        def save(index: int, outcomes: list[Any]) -> None:
            nonlocal done
            store.save(index, outcomes)
            done += 1
            progress(f"{done} of {store.plan.chunks} parts of {store.plan.size} points")

        progress(f"{done} of {store.plan.chunks} parts of {store.plan.size} points")
        count = _worker_count(store.plan, len(missing), scheduler, workers)
        if count == 0:
            from sesame_cad.sweeps.here import solve_here

            solve_here(store.plan, missing, save)
            return
        from sesame_cad.sweeps.cluster import local_client, scheduler_client, solve_on

        client = scheduler_client(scheduler) if scheduler is not None else local_client(count)
        with client as connected:
            solve_on(connected, store.plan, missing, save)


def _worker_count(plan: SweepPlan, missing: int, scheduler: str | None, workers: int | None) -> int:
    """Processes that are worth their start; 0 is this one alone."""
    from importlib.util import find_spec

    if find_spec("distributed") is None:
        if scheduler is not None or workers:
            option = "--workers" if scheduler is None else "--scheduler"
            raise InputError(f"{option}: needs Dask: pip install 'sesame-cad[cluster]'")
        return 0
    if scheduler is not None:
        return 1
    if workers is not None:
        return workers
    large = plan.size >= LARGE if plan.model.points_at_once > 1 else missing > 1
    if not large:
        return 0
    from sesame_cad.sweeps.cluster import processors

    count = min(processors(), missing)
    return count if count > 1 else 0


def _finish(store: SweepStore, *, parquet: bool) -> dict[str, Any]:
    """Write table, picture and summary from what is on disk."""
    import hashlib

    from sesame_cad.pictures.phase_diagram import phase_diagram
    from sesame_cad.staging import replace_file
    from sesame_cad.sweeps.store import PARQUET_FILE, PICTURE_FILE, TABLE_FILE
    from sesame_cad.sweeps.summary import summary
    from solver.reading import Reading

    plan, outcomes = store.plan, store.outcomes()
    described = plan.description()
    named = described.get("reading") or described["specification"]["model"]["reading"]
    files = {TABLE_FILE: store.table()}
    title = _title(plan, described, named)
    picture = phase_diagram(plan.swept, outcomes, Reading(named), title)
    if picture is not None:
        files[PICTURE_FILE] = picture
    if parquet:
        from sesame_cad.sweeps.parquet import table_parquet

        files[PARQUET_FILE] = table_parquet(plan.keys, plan.points, outcomes)
    for name, content in files.items():
        replace_file(store.folder / name, content)
    hashes = {name: hashlib.sha256(content).hexdigest() for name, content in files.items()}
    return store.write_data({"summary": summary(outcomes), "files": hashes})


def _title(plan: SweepPlan, described: dict[str, Any], reading: str) -> str:
    fixed = [f"{axis.key} = {axis.values[0]:g}" for axis in plan.axes if not axis.swept]
    what = {
        "loop": "one loop",
        "array": f"{described.get('rows')} × {described.get('columns')} loops",
        "design": f"design, {described.get('state')}",
    }[described["model"]]
    return ", ".join([what, f"{reading} reading", *fixed])


def _print(data: dict[str, Any], folder: Path) -> None:
    counts = data["summary"]
    largest = counts["largest_height_over_perimeter"]
    click.echo(
        f"{counts['points']} points: {counts['buckled']} buckled, {counts['slack']} slack, "
        f"{counts['self_meeting']} meet themselves, {counts['not_converged']} not converged"
    )
    for reason, count in counts["reasons"].items():
        click.echo(f"  {count}: {reason}")
    if largest is not None:
        click.echo(f"largest height / perimeter of a physical point: {largest:.4f}")
    click.echo(f"wrote {folder}/: {', '.join(data['files'])}")
