"""The driver of a campaign: hands out worlds, keeps to the budgets, and outlives its workers.

It holds no list of worlds: the next one is made from its number, and skipped when its row stands. So its memory does not grow
with the campaign, and starting again is all that resuming takes.
"""

import os
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from ..model.frozen import Frozen
from . import on_ray, world_author
from .campaign_file import Campaign, CampaignError
from .campaign_store import Begun, Store
from .one_world import Task, gave_up, perform, stop_jobs, task
from .worker_processes import Ended, Hands, Processes, Work
from .world_row import Row

LOOK_S = 0.5
"""How often the driver looks whether it was cancelled."""
GRACE_S = 60.0
"""So much longer than its own limit a world may take before its worker is ended: it first ends by itself, with all it knows."""
Say = Callable[[str], None]
Watch = Callable[["Standing", Row | None], None]


class Standing(Frozen):
    """How far a campaign is."""

    name: str
    folder: str
    worlds: int
    done: int
    outcomes: dict[str, int] = {}
    causes: dict[str, int] = {}
    """Of what is not as asked, by kind."""
    at_work: bool = False
    seconds: float = 0.0
    """Of all workers together."""
    runs: int = 0
    usd: float = 0.0
    """US dollars of authors, as far as they are known."""
    tokens: int = 0
    uncounted: str = ""
    """What `usd` and `tokens` leave out; empty where they are of all."""
    rate_per_minute: float | None = None
    left_s: float | None = None
    """At the rate of this driver; where that is not known (yet), by what such worlds took before."""
    stopped: str = ""
    """Why no further world is begun, though some are left."""
    next_move: str = ""

    @property
    def ok(self) -> bool:
        """Whether every world is done, or the campaign is at work."""
        return self.at_work or self.done >= self.worlds

    def text(self) -> str:
        """A screen of it."""
        share = self.done / self.worlds if self.worlds else 1.0
        filled = round(30 * share)
        lines = [f"{self.name}: {'█' * filled}{'·' * (30 - filled)} {self.done} of {self.worlds} worlds"]
        rate = [] if self.rate_per_minute is None else [f"{self.rate_per_minute:.1f} a minute"]
        left = [] if self.left_s is None else [f"about {self.left_s / 60:.0f} min left"]
        lines += [f"  {', '.join(rate + left)}"] if rate or left else []
        if self.outcomes:
            lines.append("  " + ", ".join(f"{count} {name}" for name, count in self.outcomes.items()))
        lines += [f"  {count} x {kind}" for kind, count in self.causes.items()]
        lines.append(
            f"  {self.seconds:.0f} s of workers, {self.runs} physics passes; {'at work' if self.at_work else 'not at work'}"
        )
        if self.tokens or self.usd:
            lines.append(f"  authors: {self.tokens:,} tokens, {self.usd:.2f} US dollars")
            lines += [f"  {self.uncounted}"] if self.uncounted else []
        lines += [f"  stopped: {self.stopped}"] if self.stopped else []
        return "\n".join(lines + ([f"  next: {self.next_move}"] if self.next_move else []))


@dataclass
class Count:
    """What a campaign adds up to: its rows, and what authors took of worlds that have none (any more).

    As long as the vocabulary and the worlds that were taken back, not as the campaign.
    """

    done: int = 0
    outcomes: Counter[str] = field(default_factory=Counter)
    causes: Counter[str] = field(default_factory=Counter)
    seconds: float = 0.0
    runs: int = 0
    usd: float = 0.0
    tokens: int = 0
    memory_mb: float = 0.0
    cores: float = 0.0
    """Processors that the hungriest world kept at work, all its time taken together."""
    without_row: dict[str, tuple[float, int]] = field(default_factory=dict)
    """US dollars and tokens of these, by world; its row tells them again."""

    def paid(self, world: str, usd: float, tokens: int) -> None:
        """What was paid so far for a world that has no row."""
        before = self.without_row.get(world, (0.0, 0))
        self.without_row[world] = (usd, tokens)
        self.usd += usd - before[0]
        self.tokens += tokens - before[1]

    def add(self, row: Row) -> None:
        """One row more."""
        self.done += 1
        self.outcomes[row.outcome] += 1
        if row.cause is not None:
            self.causes[row.cause.kind] += 1
        self.seconds += row.seconds
        self.runs += row.runs
        usd, tokens = self.without_row.pop(row.world, (0.0, 0))
        self.usd += (row.usd or 0.0) - usd
        self.tokens += row.tokens_read + row.tokens_written - tokens
        self.memory_mb = max(self.memory_mb, row.memory_mb)
        self.cores = max(self.cores, row.cpu_seconds / row.seconds if row.seconds else 0.0)


def counted(store: Store) -> Count:
    """What all rows add up to, and what was paid for worlds without one."""
    count, begun = Count(), store.begun
    for row in store.rows():
        count.add(row)
    for world in world_author.worlds(store) if begun.campaign.author else ():
        if store.row(world) is None:
            _count_paid(count, store, begun, world)
    return count


def _count_paid(count: Count, store: Store, begun: Begun, world: str) -> None:
    """Count what an author took for a world without a row, by what it printed."""
    written = world_author.written(store, begun, world)
    count.paid(world, written.usd or 0.0, written.tokens_read + written.tokens_written)


def standing(store: Store, count: Count | None = None) -> Standing:
    """How far a campaign is, by its files; `count`: what its rows add up to, by whoever has just read them."""
    begun = store.begun
    if count is None:
        count = counted(store)
    cancelled = "cancelled" if store.cancelled.exists() and count.done < begun.campaign.size else ""
    return told(store, begun, count, at_work=store.driven, stopped=cancelled)


def told(
    store: Store,
    begun: Begun,
    count: Count,
    *,
    at_work: bool,
    since: tuple[float, int] | None = None,
    stopped: str = "",
) -> Standing:
    """The standing of what was counted; `since` when a driver began, monotonic s, and how many were done then."""
    total, rate, left = begun.campaign.size, None, None
    if since and count.done > since[1]:
        rate = 60 * (count.done - since[1]) / max(time.monotonic() - since[0], 1e-9)
        left = 60 * (total - count.done) / rate
    elif (
        at_work
        and count.done
        and (workers := begun.campaign.workers or (0 if begun.campaign.address else _processors()))
    ):
        left = (total - count.done) * count.seconds / count.done / workers  # as such worlds took before
    place = store.folder.name
    going = f"worldwright campaign {'status' if at_work else 'resume'} {place}"
    return Standing(
        name=begun.campaign.name or place,
        folder=str(store.folder),
        worlds=total,
        done=count.done,
        outcomes=dict(sorted(count.outcomes.items())),
        causes=dict(count.causes.most_common(12)),
        at_work=at_work,
        seconds=round(count.seconds, 1),
        runs=count.runs,
        usd=round(count.usd, 6),
        tokens=count.tokens,
        uncounted=begun.campaign.author.uncounted if begun.campaign.author else "",
        rate_per_minute=rate,
        left_s=left,
        stopped=stopped,
        next_move=going if count.done < total else f"worldwright campaign report {place}",
    )


def crew_of(campaign: Campaign, work: Work, before: Count, say: Say) -> Processes | on_ray.Tasks:
    """Who does the work: Ray where it is installed or asked for, else our own processes, which is said once."""
    limit = campaign.per_world.seconds + GRACE_S
    if campaign.hands == "ray" or campaign.address or (campaign.hands == "auto" and on_ray.installed()):
        known = before.memory_mb, before.cores
        tasks = on_ray.Tasks(campaign.workers, work, limit, campaign.address, *known, campaign.dashboard)
        if tasks.dashboard:
            say(f"Ray's dashboard: http://{tasks.dashboard}")
        return tasks
    count = campaign.workers or _processors()
    if campaign.hands == "auto":
        say(
            f"Ray is not installed: {count} worker processes on this machine do the work (`pip install ray` for a cluster)"
        )
    return Processes(count, work, limit)


def conduct(store: Store, work: Work = perform, say: Say = lambda _: None, watch: Watch = lambda *_: None) -> Standing:
    """Do what is left of a campaign, until it is done, its budget is used up, or it is cancelled.

    Args:
        store: a campaign that was begun.
        work: what is done with each world.
        say: told what a person should know.
        watch: told the standing, with each row as it comes.

    Raises:
        CampaignError: another driver is at work, or nobody can do the work.
    """
    with store.driving():
        begun, count = store.begun, counted(store)
        crew = crew_of(begun.campaign, work, count, say)
        try:
            return _Conducting(store, begun, count, crew, watch).go()
        finally:
            for left in crew.drop():
                store.not_begun(left.world)
                stop_jobs(store, left.world)
            crew.close()


class _Conducting:
    def __init__(self, store: Store, begun: Begun, count: Count, crew: Hands, watch: Watch) -> None:
        self.store, self.begun, self.count, self.crew, self.watch = store, begun, count, crew, watch
        self.since = (time.monotonic(), count.done)
        self.again: deque[Task] = deque()
        self.deaths: Counter[str] = Counter()
        self.spent: dict[str, float] = {}
        """Seconds of workers that left no row, by world."""
        self.under_way: set[str] = set()
        self.fresh = self._left()

    def go(self) -> Standing:
        """Hand out and take in; returns how far it came."""
        self.watch(self.told(), None)
        while not self.store.cancelled.exists():
            while self.crew.free() > 0 and not self._used_up(len(self.under_way)) and (one := self._next()) is not None:
                self.under_way.add(one.world)
                self.crew.take(one)
            if not self.under_way:
                left = self.count.done < self.begun.campaign.size
                return self.told(at_work=False, stopped=self._used_up() if left else "")
            for ended in self.crew.ended(LOOK_S):
                self._take_in(ended)
        return self.told(at_work=False, stopped="cancelled")

    def told(self, at_work: bool = True, stopped: str = "") -> Standing:
        """How far it is."""
        return told(self.store, self.begun, self.count, at_work=at_work, since=self.since, stopped=stopped)

    def _left(self) -> Iterator[Task]:
        """The worlds without a row."""
        for number in range(self.begun.campaign.size):
            one = task(self.store, self.begun, number)
            if not self.store.done(one.world):
                yield one

    def _next(self) -> Task | None:
        return self.again.popleft() if self.again else next(self.fresh, None)

    def _used_up(self, under_way: int = 0) -> str:
        """Which budget is used up, or would be by what is under way; empty while there is room."""
        budget = self.begun.campaign.budget
        if budget.runs is not None and self.count.runs + under_way >= budget.runs:
            return f"the budget of {budget.runs} runs is used up"
        if budget.seconds is not None and self.count.seconds >= budget.seconds:
            return f"the budget of {budget.seconds:g} s is used up"
        kept = under_way * (self.begun.campaign.per_world.usd or 0.0)  # what is under way may still cost so much
        if budget.usd is not None and self.count.usd + kept >= budget.usd:
            return f"the budget of {budget.usd:g} US dollars is used up"
        return ""

    def _take_in(self, ended: Ended) -> None:
        """A row, or the beginning of another try."""
        one = ended.task
        self.under_way.discard(one.world)
        row = self.store.row(one.world)
        spent = self.spent.pop(one.world, 0.0) + ended.seconds
        if row is None and ended.over_time:
            seconds = self.begun.campaign.per_world.seconds
            said = f"it was not done within {seconds:g} s, nor did it end by itself"
            row = gave_up(self.store, one, "over_time", said, "raise per_world.seconds, or see its folder", spent)
        elif row is None:
            self.deaths[one.world] += 1  # a worker that dies before it notes that it began is counted here alone
            times = max(self.deaths[one.world], self.store.begun_before(one.world))
            if times < self.begun.campaign.per_world.begun:
                self.again.append(one)
                self.spent[one.world] = spent
                _count_paid(self.count, self.store, self.begun, one.world)
                return
            said = f"it was begun {times} times; the last time {ended.died or 'it left no row'}"
            move = "see its folder; `worldwright campaign resume --again worker_died` begins it once more"
            row = gave_up(self.store, one, "worker_died", said, move, spent)
        self.count.add(row)
        self.watch(self.told(), row)


def forget(store: Store, what: str) -> int:
    """Take away the rows of one outcome or one kind of cause, so that these worlds are begun again; how many.

    Raises:
        CampaignError: nothing is of that name, or a driver is at work, which counted these rows.
    """
    with store.driving():
        return _forgotten(store, what)


def _forgotten(store: Store, what: str) -> int:
    found = [row for row in store.rows() if what in (row.outcome, row.cause.kind if row.cause else "")]
    if not found:
        count = standing(store)
        known = sorted({*count.outcomes, *count.causes})
        raise CampaignError(
            f"no world ended as `{what}`", place=str(store.folder), next_move=f"known: {', '.join(known)}"
        )
    for row in found:
        store.forget(row)
    return len(found)


def _processors() -> int:
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
