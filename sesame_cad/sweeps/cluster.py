"""Solve a sweep's chunks on a Dask cluster: this machine's processors, or many machines."""

from __future__ import annotations

import logging
import os
import signal
from collections.abc import Generator, Sequence
from contextlib import ExitStack, contextmanager
from threading import current_thread, main_thread
from typing import Any, cast

from dask import config  # pyright: ignore[reportPrivateImportUsage]
from distributed import Client, LocalCluster, as_completed

from sesame_cad.errors import InputError
from sesame_cad.sweeps.here import Save
from sesame_cad.sweeps.plan import SweepPlan, solve_chunk

CONNECT_SECONDS = 10

MOST_DEATHS = 10
"""Workers that may die over one chunk before that chunk is blamed for it."""

_SETTINGS = {
    "distributed.scheduler.allowed-failures": MOST_DEATHS,
    "distributed.logging.distributed": "critical",
    # Dask has workers give memory back at once, and asking for it again takes longer than a solve.
    # Whoever sets the one keeps glibc from raising the other by itself; 32 MiB is its largest.
    "distributed.nanny.pre-spawn-environ.MALLOC_TRIM_THRESHOLD_": 1 << 28,
    "distributed.nanny.pre-spawn-environ.MALLOC_MMAP_THRESHOLD_": 1 << 25,
}


@contextmanager
def local_client(workers: int) -> Generator[Client]:
    """Start a cluster of processes on this machine; one thread each, as small solves want it."""
    with config.set(_SETTINGS), ExitStack() as open_until_done:
        with _leaving_interrupts_to_us():
            cluster = open_until_done.enter_context(
                LocalCluster(
                    n_workers=workers,
                    threads_per_worker=1,
                    processes=True,
                    dashboard_address=cast("str", None),  # none: its annotation says otherwise
                    # its page of state is served all the same: at any free port, for us alone
                    scheduler_kwargs={"dashboard_address": "127.0.0.1:0"},
                    silence_logs=logging.CRITICAL,
                )
            )
        yield open_until_done.enter_context(Client(cluster))


@contextmanager
def _leaving_interrupts_to_us() -> Generator[None]:
    """Start processes that do not hear Ctrl-C: this one closes them, and they have nothing to say.

    Only the main thread of a program may say what becomes of signals.
    """
    if current_thread() is not main_thread():
        yield
        return
    before = signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)


@contextmanager
def scheduler_client(address: str) -> Generator[Client]:
    """Connect to a scheduler that runs already.

    Raises
    ------
    InputError
        When there is none at the address.
    """
    try:
        client = Client(address, timeout=CONNECT_SECONDS)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError(f"--scheduler {address}: no scheduler answers there ({error})") from None
    with client:
        yield client


def processors() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def solve_on(client: Client, plan: SweepPlan, chunks: Sequence[int], save: Save) -> None:
    """Solve chunks wherever there is room, and hand over each as it is done.

    What a worker had in hand when it died is solved by another. Chunks are given out as the
    results come in, so that a large sweep does not fill the scheduler.
    """
    waiting = iter(chunks)
    index_of: dict[Any, int] = {}

    def submit() -> Any:
        index = next(waiting, None)
        if index is None:
            return None
        future = client.submit(solve_chunk, plan.model, plan.keys, plan.chunk(index), pure=False)
        index_of[future.key] = index
        return future

    ahead = 4 * max(1, len(cast("dict[str, int]", client.nthreads())))
    first = [future for future in (submit() for _ in range(min(ahead, len(chunks)))) if future]
    done = as_completed(first)
    for future in done:
        save(index_of.pop(future.key), future.result())
        following = submit()
        if following is not None:
            done.add(following)
