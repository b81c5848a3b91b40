"""Prove, build or accept anew one world of the gallery, each in a process of its own."""

import json
import time
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from worldkit.files import write_json

from ..model.errors import WorldwrightError
from ..model.evidence import environment
from ..model.evidence.run import sha256_file
from ..model.frozen import Frozen
from . import worlds


class Made(Frozen):
    """The result for one world."""

    slug: str
    ok: bool
    detail: str
    """One line for success, several for a failure."""
    seconds: float = 0.0


def prove(slug: str) -> Made:
    """Prove a world again from its small form alone."""
    from ..stamp.tools import verify

    anybody = not worlds.vouched()
    found = verify(str(worlds.EXAMPLES / slug), timeout_s=600, anybody=anybody)
    while found.state == "running":
        found = verify(str(worlds.EXAMPLES / slug), timeout_s=600, anybody=anybody)
    first = found.text().splitlines()[0].split(": ", 1)[1]
    return Made(slug=slug, ok=found.ok, detail=first if found.ok else found.text())


def build(slug: str) -> Made:
    """Prove a world and build what its small form leaves out, except what an earlier call has built already."""
    from ..go import Options
    from ..go import go as run_steps

    run = worlds.seeded(slug)
    proof, about = run.folder.parent / f"{slug}.proof.json", _identity(slug)
    proved = _remembered(proof, about) or prove(slug)
    if not proved.ok:
        return proved
    write_json(proof, {"about": about, "detail": proved.detail})
    told: list[str] = []
    ok = run_steps(run, Options(), lambda *said: told.append(" ".join(said)))
    return Made(slug=slug, ok=ok, detail=f"{proved.detail}; {run.report}" if ok else "\n".join(told))


def accept(slug: str, redraft: bool = False) -> Made:
    """Build a world from its plan and program, accept it, and write its small form in place of the older one.

    With `redraft`, a program that was drafted is drafted again by the present code. Its plan is approved as for the older stamp: in auto mode, or in the name of the person who gives the command.
    """
    from ..go import Options
    from ..go import go as run_steps
    from ..stamp import small_form
    from ..stamp.state import State

    run = worlds.restarted(slug, redraft)
    told: list[str] = []
    before = State.find(str(worlds.EXAMPLES / slug)).stamp.value
    auto = before is None or before.predicate.approval.auto
    if not run_steps(run, Options(approve=not auto, auto=auto, accept=True), lambda *said: told.append(" ".join(said))):
        return Made(slug=slug, ok=False, detail="\n".join(told))
    files = small_form.write(run, (worlds.EXAMPLES / slug).resolve())
    return Made(slug=slug, ok=True, detail=f"accepted anew, {len(files)} files kept")


def redraft(slug: str) -> Made:
    """See `accept`."""
    return accept(slug, redraft=True)


WORK: dict[str, Callable[[str], Made]] = {"prove": prove, "build": build, "accept": accept, "redraft": redraft}


def one(work: str, slug: str) -> Made:
    """Do one piece of work; an error of one world does not end the others."""
    began = time.monotonic()
    try:
        made = WORK[work](slug)
    except WorldwrightError as error:
        made = Made(slug=slug, ok=False, detail=str(error))
    return made.model_copy(update={"seconds": time.monotonic() - began})


def each(work: str, slugs: Sequence[str], jobs: int) -> Iterator[Made]:
    """Do one piece of work for every world, `jobs` at a time, and yield each result at once."""
    from concurrent.futures import ProcessPoolExecutor, as_completed
    from multiprocessing import get_context

    with ProcessPoolExecutor(max_workers=jobs, mp_context=get_context("spawn"), max_tasks_per_child=1) as pool:
        for done in as_completed([pool.submit(one, work, slug) for slug in slugs]):
            yield done.result()


def _identity(slug: str) -> list[str]:
    """The identity of a proof: the stamp, and the environment in which it was proved."""
    return [sha256_file(worlds.EXAMPLES / slug / "stamp.json"), environment.current().sha256()]


def _remembered(path: Path, about: list[str]) -> Made | None:
    """The proof of an earlier call, if it has the same stamp and environment."""
    try:
        kept = json.loads(path.read_bytes())
        if kept["about"] == about:
            return Made(slug=path.name.removesuffix(".proof.json"), ok=True, detail=str(kept["detail"]))
    except (OSError, ValueError, KeyError, TypeError):
        pass
    return None
