"""The folder of a campaign: what stands on disk, and under which name.

| path | what |
|---|---|
| `campaign.json` | the campaign as it was begun, with the hashes of its plans (`Begun`) |
| `base/N/` | plan N with what belongs to it, as it was when the campaign began |
| `worlds/xx/<world>/` | the run folder of a world, whose first two digits are `xx` |
| `rows/xx/<world>.json` | its row: the proof that it is done, written last |
| `begun/xx/<world>` | one character each time that it is begun, written before anything is paid |
| `authors/xx/<world>/N/` | what its author said and cost, the Nth time (`world_author`) |
| `locks/xx/<world>` | held by whoever works on it |
| `driver.lock`, `cancel` | held by the live driver; asks it to stop |
| `table.parquet`, `table.csv`, `index.html` | what `report` writes |

Whoever works on a world (another process, another node that sees the same folder) asks here first and writes here last, each
time by a rename: a reader never sees half a row, and a row that is there is never paid again.
"""

import hashlib
import json
import shutil
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from pydantic import ValidationError

from worldkit.files import write_atomic, write_json

from ..model import companions, try_lock
from ..model.errors import NotFoundError, WorldwrightError
from ..model.evidence import pictures_of
from ..model.evidence.came import Came
from ..model.evidence.run import Run, sha256_file
from ..model.frozen import Frozen
from ..model.plan import taken_along
from ..model.storage import writing
from .campaign_file import Campaign, CampaignError, Given
from .world_row import Row

ABOUT = "campaign.json"
BEGINS_S, LOOK_S = 0.5, 0.02
"""Who asks whether a driver is at work holds its lock for a moment: a driver that begins waits so long for it, and looks so often."""
LIMITS = frozenset({"budget", "per_world", "workers"})
"""What may change while a driver is at work."""
FREE = LIMITS | {"hands", "address", "dashboard", "report", "name"}
"""What may be other when a campaign goes on: its worlds stay what they are."""
WRITES = {"harness", "model", "options"}
"""What another author is another world by."""
LONGEST_PROMPT = 20_000
"""Characters; a prompt is a sentence or a page, never a file of data."""


class Base(Frozen):
    """A plan of a campaign, as it was when that began."""

    source: str
    """As the campaign names it."""
    sha256: str = ""
    """Over the plan and all that belongs to it; empty where it cannot be read."""
    category: str = ""
    prompt: str = ""
    wrong: str = ""
    """Why no world can be made of it: each of its worlds then says so."""
    kind: str = ""
    """The code of that."""
    next_move: str = ""


class Begun(Frozen):
    """A campaign on disk."""

    campaign: Campaign
    bases: tuple[Base, ...]
    approved: bool = False
    """A person at the command line approves the plans of its worlds; else it is auto mode."""
    word: Came = Came(how="automation")
    """How that person's word came, as it was seen when it was given: whoever works on a world later sees a worker only."""


class Store:
    """One campaign's folder."""

    def __init__(self, folder: Path | str) -> None:
        self.folder = Path(folder).resolve()
        self.cancelled = self.folder / "cancel"

    @classmethod
    def find(cls, name: Path | str) -> "Store":
        """The campaign at a path, or named under ./runs."""
        for candidate in (Path(name), Path("runs") / name):
            if (candidate / ABOUT).is_file():
                return cls(candidate)
        known = sorted(path.parent.name for path in Path("runs").glob(f"*/{ABOUT}"))
        raise NotFoundError(
            f"there is no campaign '{name}' (a folder with a {ABOUT})",
            place=str(name),
            next_move=f"name one of: {', '.join(known) or '(none yet)'}, or begin one: `worldwright campaign run FILE.yaml`",
        )

    @property
    def begun(self) -> Begun:
        """The campaign as it was begun."""
        path = self.folder / ABOUT
        try:
            return Begun.model_validate_json(path.read_bytes())
        except (OSError, ValidationError) as cause:
            raise CampaignError(
                f"the campaign cannot be read: {str(cause).splitlines()[0]}",
                place=str(path),
                next_move="begin it again in another folder; worlds that are done stand under worlds/",
            ) from cause

    def begin(self, campaign: Campaign, file: Path, word: Came | None = None) -> Begun:
        """Write down a campaign and copy its plans; one that is here already must be the same, but for its limits.

        Args:
            campaign: what its file says.
            file: that file; plans are named relative to it.
            word: how a person's word for its plans came; None: nobody gave it now, though one that stands is kept.

        Raises:
            CampaignError: the folder holds another campaign, one of its plans was edited since, or it is at work and more than
                its limits would change.
        """
        if (self.folder / ABOUT).is_file():
            before = self.begun
            self._check_same(before, campaign, file.parent)
            told = {"approved": True, "word": word} if word is not None and not before.approved else {}
            return self.change(before, before.model_copy(update={"campaign": campaign, **told}))
        bases = []
        with writing("the campaign", self.folder):
            for number, given in enumerate(campaign.given):
                base, found = _base(given, campaign, file.parent)
                for name, content in found.items():
                    write_atomic(self.base(number) / name, content)
                bases.append(base)
        word, approved = word or Came(how="automation"), word is not None
        return self._write(Begun(campaign=campaign, bases=tuple(bases), approved=approved, word=word))

    def _check_same(self, before: Begun, campaign: Campaign, beside: Path) -> None:
        if _without(before.campaign, FREE) != _without(campaign, FREE):
            raise CampaignError(
                "this folder holds another campaign",
                place=str(self.folder),
                next_move="name another folder (`--folder`), or go on with that one: `worldwright campaign resume`",
            )
        for base, given in zip(before.bases, campaign.given, strict=True):
            now, _ = _base(given, campaign, beside)
            if now.sha256 != base.sha256:
                raise CampaignError(
                    f"`{given.plan}`, or what belongs to it, is no longer what this campaign began with"
                    + (f": {now.wrong}" if now.wrong else ""),
                    place=str(beside / given.plan),
                    next_move="name another folder (`--folder`) for it as it is now, or go on with it as it was: "
                    f"`worldwright campaign resume {self.folder.name}`",
                )

    def change(self, before: Begun, now: Begun) -> Begun:
        """Write a campaign down as it is now; workers read it again for each world, so that while one drives only limits change.

        Raises:
            CampaignError: a driver is at work, and something else would change.
        """
        if now == before:
            return now
        fixed = [begun.model_copy(update={"campaign": _without(begun.campaign, LIMITS)}) for begun in (before, now)]
        if fixed[0] != fixed[1] and self.driven:
            raise CampaignError(
                f"the campaign is at work: until it ends, only its limits change ({', '.join(sorted(LIMITS))})",
                place=str(self.folder),
                next_move=f"`worldwright campaign cancel {self.folder.name}` first, or wait for its end",
            )
        return self._write(now)

    def _write(self, begun: Begun) -> Begun:
        with writing("the campaign", self.folder):
            write_json(self.folder / ABOUT, begun.model_dump(mode="json", by_alias=True))
        return begun

    def base(self, number: int) -> Path:
        """Folder of plan `number`."""
        return self.folder / "base" / str(number)

    def world(self, world: str) -> Path:
        """Run folder of a world."""
        return self.folder / "worlds" / world[:2] / world

    def author(self, world: str) -> Path:
        """Where what its author said is kept."""
        return self.folder / "authors" / world[:2] / world

    def row_path(self, world: str) -> Path:
        """The file of a world's row."""
        return self.folder / "rows" / world[:2] / f"{world}.json"

    def done(self, world: str) -> bool:
        """Whether its row stands, and can be read."""
        return self.row(world) is not None

    def row(self, world: str) -> Row | None:
        """Its row; None when it has none, or none that can be read, which is then made again."""
        try:
            return Row.model_validate_json(self.row_path(world).read_bytes())
        except (OSError, ValidationError):
            return None

    def keep(self, row: Row) -> Row:
        """Write a row, in one step."""
        with writing("the row", self.row_path(row.world)):
            write_atomic(self.row_path(row.world), row.model_dump_json() + "\n")
        return row

    def rows(self) -> Iterator[Row]:
        """Every row, one after the other, in the order of the worlds' hashes; one folder's names are held at a time."""
        for inner in sorted((self.folder / "rows").glob("*")):
            for path in sorted(inner.glob("*.json")):
                if (row := self.row(path.stem)) is not None:
                    yield row

    def forget(self, row: Row) -> None:
        """Take a row away, so that its world is begun again, as often as any other."""
        self._beginnings(row.world).unlink(missing_ok=True)
        self.row_path(row.world).unlink(missing_ok=True)

    def _beginnings(self, world: str) -> Path:
        return self.folder / "begun" / world[:2] / world

    def begun_before(self, world: str) -> int:
        """How often a world was begun."""
        try:
            return self._beginnings(world).stat().st_size
        except OSError:
            return 0

    def begin_world(self, world: str) -> int:
        """Note that a world is begun; returns how often it was now."""
        path = self._beginnings(world)
        with writing("the beginning of a world", path):
            path.parent.mkdir(parents=True, exist_ok=True)
            with path.open("ab") as stream:
                stream.write(b".")
        return self.begun_before(world)

    def not_begun(self, world: str) -> None:
        """Take back the last beginning: it was broken off from outside."""
        if count := self.begun_before(world):
            self._beginnings(world).write_bytes(b"." * (count - 1))

    @contextmanager
    def working(self, world: str) -> Iterator[bool]:
        """Hold a world within the block; gives False, and holds nothing, while somebody else does."""
        path = self.folder / "locks" / world[:2] / world
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("ab") as handle:
            yield _taken(handle.fileno())

    @contextmanager
    def driving(self) -> Iterator[None]:
        """Be the one driver within the block.

        Raises:
            CampaignError: another one is at work.
        """
        self.folder.mkdir(parents=True, exist_ok=True)
        with (self.folder / "driver.lock").open("ab") as handle:
            ends = time.monotonic() + BEGINS_S
            while not (mine := _taken(handle.fileno())) and time.monotonic() < ends:
                time.sleep(LOOK_S)
            if not mine:
                raise CampaignError(
                    "the campaign is at work already",
                    place=str(self.folder),
                    next_move="`worldwright campaign status` shows how far it is, `campaign cancel` stops it",
                )
            self.cancelled.unlink(missing_ok=True)
            yield

    @property
    def driven(self) -> bool:
        """Whether a driver is at work."""
        try:
            with (self.folder / "driver.lock").open("r+b") as handle:  # some file systems lock what can be written only
                return not _taken(handle.fileno())
        except OSError:
            return False


def address(base: Base, number: int, values: dict[str, float], campaign: Campaign) -> str:
    """The hash that addresses world `number`: its plan with all that belongs to it, what is set in it, how far it is taken.

    Two draws of equal values are two worlds, and so are two plans of equal content: each has its row.
    """
    sweep = campaign.sweep
    which = number if sweep is None else number % sweep.draws
    walk: list[object] = [campaign.until, campaign.pictures, campaign.refine]
    walk += [campaign.author.model_dump(mode="json", include=WRITES)] if campaign.author else []
    told = json.dumps([base.sha256 or base.source, which, values, walk], sort_keys=True)
    return hashlib.sha256(told.encode()).hexdigest()[:16]


def seed(base: Path, target: Path) -> None:
    """Copy what a base holds into the folder of a world; what stands there is kept."""
    for path in sorted(base.rglob("*")):
        inside = target / path.relative_to(base)
        if path.is_file() and not inside.exists():
            inside.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(path, inside)


def _without(campaign: Campaign, free: frozenset[str]) -> Campaign:
    """A campaign with these words, and what its author's tokens cost, as if its file did not say them."""
    author = campaign.author and campaign.author.model_copy(update={"prices": None})
    return campaign.model_copy(update={n: Campaign.model_fields[n].default for n in free} | {"author": author})


def _base(given: Given, campaign: Campaign, beside: Path) -> tuple[Base, dict[str, bytes]]:
    """One plan, with its prompt, its author's program and film, and the files that these name, by path."""
    about = Base(source=given.plan, category=given.category or campaign.category)
    try:
        found = _asked(given, beside) if campaign.author else _content(beside / given.plan, given)
    except WorldwrightError as error:
        wrong = {"wrong": str(error.cause), "kind": error.code, "next_move": error.next_move}
        return about.model_copy(update=wrong), {}
    digest = hashlib.sha256()
    for name, content in sorted(found.items()):
        digest.update(f"{name}\n{hashlib.sha256(content).hexdigest()}\n".encode())
    prompt = found.get("prompt.md", b"").decode(errors="replace").strip()
    return about.model_copy(update={"sha256": digest.hexdigest(), "prompt": " ".join(prompt.split())[:400]}), found


def _content(path: Path, given: Given) -> dict[str, bytes]:
    """A plan and what belongs to it, by path relative to its folder."""
    plan = path / "plan.md" if path.is_dir() else path
    if not plan.is_file():
        raise NotFoundError("there is no such plan", place=str(path), next_move="name a plan.md, or its folder")
    run = Run(plan.parent)
    found = {"plan.md": plan.read_bytes()}
    prompt = given.prompt if given.prompt is not None else _text(run.prompt)
    if prompt is not None:
        _check(prompt, str(run.prompt))
        found["prompt.md"] = prompt.encode()
    if plan.name != "plan.md":
        return found
    found |= taken_along.of(run.folder)
    if run.program.is_file() and not _drafted(run):
        found |= {**companions.of(run.program), **pictures_of.files(run), "simulation.py": run.program.read_bytes()}
    return found


def _asked(given: Given, beside: Path) -> dict[str, bytes]:
    """A prompt, in the campaign's own file or in one beside it."""
    prompt, place = given.prompt, str(beside / given.plan)
    if prompt is None:
        try:
            with Path(place).open(encoding="utf-8", errors="replace") as stream:
                prompt = stream.read(LONGEST_PROMPT + 1)
        except OSError as cause:
            move = "name a text file beside the campaign's"
            raise NotFoundError(f"its prompt cannot be read: {cause.strerror}", place=place, next_move=move) from cause
    _check(prompt, place)
    return {"prompt.md": prompt.encode(errors="replace")}


def _check(prompt: str, place: str) -> None:
    if not prompt.strip():
        error = CampaignError(
            "its prompt is empty", place=place, next_move="write the sentence that the world is built from"
        )
        error.code = "empty_prompt"
        raise error
    if len(prompt) > LONGEST_PROMPT:
        error = CampaignError(
            f"its prompt has more than {LONGEST_PROMPT:,} characters",
            place=place,
            next_move="shorten it",
        )
        error.code = "long_prompt"
        raise error


def _text(path: Path) -> str | None:
    try:
        return path.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return None


def _drafted(run: Run) -> bool:
    """Whether, by the journal, the program is still the draft, which each world then drafts from its own plan."""
    present = sha256_file(run.program)
    return any(e.get("action") == "draft" and e.get("program_sha256") == present for e in run.entries())


def _taken(handle: int) -> bool:
    try:
        return try_lock.taken(handle)
    except OSError:  # a file system without locks: rows are still written in one step, and looked for first
        return True
