"""Ray's tasks as the hands of a campaign: on this machine, or on a cluster by its address.

A task is one world and hands back its name alone: rows and recordings lie in the campaign's folder, which every node must see
under the same path, with the same environment installed. Ray repeats nothing by itself (`max_retries=0`): a world whose worker
died is begun again by the driver, which counts how often. A task asks for the processors that such worlds kept at work before, and
for the memory that they took; results are far below the size that goes through the object store, which is therefore kept small.
"""

import contextlib
import os
import time
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.util import find_spec
from typing import Any

from .campaign_file import CampaignError
from .one_world import Task
from .worker_processes import Ended, Work, alone

STORE_MB = 128
"""Of Ray's object store, started here: nothing of ours lies in it."""
FIRST_MB, SPARE_MB = 1024.0, 512.0
"""Memory that a world asks for before any was seen; what its pass, a process of its own, takes beside its worker."""
NICENESS = "RAY_worker_niceness"
"""The variable by which Ray's nodes are told how far their workers, and the passes that these start, stand behind others."""


def installed() -> bool:
    """Whether Ray is here."""
    return find_spec("ray") is not None


@dataclass
class _Under:
    task: Task
    began: float
    deadline: float
    cancelled: bool = False


class Tasks:
    """Hands that are Ray's tasks; see `Hands`.

    Args:
        count: worlds at work at once; None: as many as the cluster has processors, less one where there are more than two; never
            more than its nodes, as they are now, have processors and memory for.
        work: what is done with a task.
        seconds: a world that takes longer is ended.
        address: of the cluster, `host:port`; empty: Ray is started here.
        memory_mb: the largest that such worlds took before; 0: nothing is known.
        cores: the most processors that one of them kept at work; asked for are whole ones, and never less than one, since a world
            that had to wait for its processor looks as if it needed less.
        dashboard: open Ray's own page where Ray is started here and has one (`ray[default]`). It asks nobody for a password, and whoever
            reaches it may have Ray run anything.

    Raises:
        CampaignError: Ray is not installed, or no cluster answers there.
    """

    def __init__(
        self,
        count: int | None,
        work: Work,
        seconds: float = float("inf"),
        address: str = "",
        memory_mb: float = 0.0,
        cores: float = 0.0,
        dashboard: bool = False,
    ) -> None:
        if not installed():
            raise CampaignError(
                "Ray is not installed here",
                next_move="`pip install ray` (the extra `cluster`), or `--hands processes`",
            )
        import ray

        self._ray: Any = ray
        self._seconds = seconds
        self._under: dict[Any, _Under] = {}
        self.dashboard = ""
        """Where Ray's own page is, `host:port`, if it was started here and has one."""
        # Ray looks for its processes by this; nothing is told to its makers.
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
        self._started = not ray.is_initialized()
        if self._started:
            self._connect(count and count * max(1, round(cores)), address, dashboard)
        nodes = [node["Resources"] for node in ray.nodes() if node["Alive"]]
        processors = int(sum(node.get("CPU", 0) for node in nodes))
        asked = (memory_mb + SPARE_MB if memory_mb else FIRST_MB) * (1 << 20)
        memory = [node.get("memory", float("inf")) for node in nodes if node.get("CPU")]
        asked = min(asked, max(memory, default=float("inf")) / 2)
        # What only waits in Ray's queue would be taken for slow, so no more is handed out than the nodes hold at once.
        each = max(1, min(round(cores), int(max((node.get("CPU", 0) for node in nodes), default=1))))
        fit = sum(int(min(node.get("CPU", 0) // each, node.get("memory", float("inf")) / asked)) for node in nodes)
        self._count = max(1, min(count or processors - (processors > 2), fit))
        self._remote = ray.remote(num_cpus=each, memory=int(asked), max_retries=0, max_calls=200)(_alone(work))

    def _connect(self, processors: int | None, address: str, dashboard: bool) -> None:
        quiet: dict[str, Any] = {"log_to_driver": False, "logging_level": "ERROR", "configure_logging": True}
        try:
            if address:
                self._ray.init(address=address, **quiet)
            else:
                # As our own processes are: at Ray's niceness of 15 a world starves beside whatever else is at work, while its time runs.
                os.environ.setdefault(NICENESS, "0")
                began = self._ray.init(
                    address="local",
                    num_cpus=processors,
                    include_dashboard=dashboard,  # without a word Ray opens it wherever it is installed
                    object_store_memory=STORE_MB << 20,
                    **quiet,
                )
                self.dashboard = getattr(began, "dashboard_url", "") or ""
        except Exception as cause:  # Ray raises many kinds, each with its own words
            raise CampaignError(
                f"Ray does not answer: {str(cause).splitlines()[0] if str(cause) else type(cause).__name__}",
                place=address or "this machine",
                next_move="`ray status --address HOST:PORT` tells whether it is up; or `--hands processes`",
            ) from cause

    def free(self) -> int:
        """See `Hands`."""
        return self._count - len(self._under)

    def take(self, task: Task) -> None:
        """See `Hands`."""
        now = time.monotonic()
        self._under[self._remote.remote(task)] = _Under(task, now, now + self._seconds)

    def ended(self, timeout_s: float) -> Iterator[Ended]:
        """See `Hands`; with Ray, a world's seconds begin when it is handed out."""
        if not self._under:
            return
        patience = max(0.0, min(timeout_s, min(u.deadline for u in self._under.values()) - time.monotonic()))
        ready, _ = self._ray.wait(list(self._under), num_returns=1, timeout=patience)
        for reference in ready:
            under = self._under.pop(reference)
            try:
                answered = self._ray.get(reference) == under.task.world
                yield Ended(task=under.task, died="" if answered else "it answered something else")
            except Exception as error:  # the worker's death, its node's, lack of memory: Ray says which
                said = str(error).strip().splitlines()
                died = f"{type(error).__name__}: {said[0] if said else 'no word'}"
                spent = time.monotonic() - under.began
                yield Ended(
                    task=under.task,
                    died="" if under.cancelled else died,
                    over_time=under.cancelled,
                    seconds=spent,
                )
        for reference, under in list(self._under.items()):
            if under.deadline <= time.monotonic():
                under.cancelled, under.deadline = True, time.monotonic() + self._seconds
                self._ray.cancel(reference, force=True)

    def drop(self) -> list[Task]:
        """See `Hands`."""
        left = [under.task for under in self._under.values()]
        for reference in self._under:
            with contextlib.suppress(Exception):
                self._ray.cancel(reference, force=True)
        self._under.clear()
        return left

    def close(self) -> None:
        """Leave the cluster; end Ray where it was started here."""
        if self._started:
            self._ray.shutdown()


def _alone(work: Work) -> Any:
    """The work as a task of Ray: nothing beside it, and the world's name handed back."""

    def world(task: Task) -> str:
        alone()
        work(task)
        return task.world

    return world
