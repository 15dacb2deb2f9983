"""``sesame-cad sweep``: a whole design space instead of one design."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from sesame_cad.errors import InputError
from sesame_cad.number_range import NumberRange
from sesame_cad.sweeps.fig_2 import FIG_2

if TYPE_CHECKING:
    from sesame_cad.sweeps.plan import SweepPlan
    from sesame_cad.sweeps.store import SweepStore

LARGE = 20_000
"""Points from which a sweep of single loops is shared by all processors: they take ten seconds."""

INTERRUPTED = 130


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
    type=NumberRange(1e-6, 0.1),
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
    from sesame_cad.commands.sweep_plan import designs_plan, loops_plan

    if spec is None:
        plan = loops_plan(sets, state, dimensionless)
    else:
        plan = designs_plan(spec, sets, state or "cold", dimensionless)
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
