"""Run the processes of one job, pass by pass: the author builds and answers, the engine simulates and films."""

import json
import os
import sys
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from worldkit import channel
from worldkit.files import write_json
from worldkit.film_files import ARRAYS, DESCRIPTION

from ..model import companions
from ..model.errors import WorldwrightError
from ..model.evidence import assets_used, environment
from ..model.evidence.run import Run, sha256_file
from . import authoring, family, kept_sculpts, plain, refined
from .crew import Crew, Member
from .gates import folder_name
from .job import Job, Spec
from .limits import failed

WORLD, FACTS, INPUTS = "world.mjz", "program.json", "inputs.json"
"""The engine's files: the built world, the program's facts, the plan's declared inputs."""
DRIVEN = ("inputs.arrows", "edits.arrows", "media.arrows", "balances.arrows")
"""The files of a recording that drove it."""
PASS = {
    "bundle": "bundle",
    "physics": "physics",
    "storyboard": "storyboard",
    "stills": "still",
    "video": "video",
    "final": "final",
}
REFUSED = ("program", "film")
"""How a film is refused that was described, before anything is drawn; the house's own is made then."""
UNTOLD = (*REFUSED, "crashed", "no_result", "timed_out", "file_too_large", "out_of_memory", "killed")
"""How a film fails to be described by its own fault; the house's own is made then, too."""
MB = 1 << 20
FAREWELL_S = 3.0
"""The author's process may take so long to end after the engine has ended, s."""
MOST_STRAYS = MOST_ROUNDED = 40


@dataclass(frozen=True)
class Ended:
    """How a job's processes ended."""

    failure: dict[str, str] | None
    """Code, message, place and next move; None when all went well."""
    summary: dict[str, Any] = field(default_factory=dict)
    """What the engine reported."""
    kept: tuple[Path, ...] = ()
    """Files for the evidence that the engine did not write."""


class Acting:
    """The processes of one job in their order."""

    def __init__(self, job: Job, run: Run, crew: Crew, tick: Callable[[float], bool]) -> None:
        self.job, self.run, self.crew, self.tick = job, run, crew, tick
        self.spec: Spec = job.spec
        self.log = f"worldwright stage log {run.folder} --job {self.spec.job}"

    def act(self) -> Ended:
        """Run the pass to its end."""
        if self.spec.given:
            if failure := self.take(Path(self.spec.given)):
                return Ended(failure)
        elif self.spec.stage in ("bundle", "physics") and not self.spec.variant:
            if not (self.spec.stage == "physics" and self.bundled()) and (failure := self.build()):
                return Ended(failure)
        elif failure := self.fetch(self.physics):
            return Ended(failure)
        if self.spec.stage == "bundle":
            return self.bundle()
        return self.simulate() if self.spec.stage == "physics" else self.film()

    @property
    def physics(self) -> Path:
        """The evidence that holds the world of this key."""
        return self.run.evidence(self.spec.key) / folder_name("physics")

    # -- the world ---------------------------------------------------------------------------------------------------

    def author(self, what: str, folder: str, *more: str, descriptors: tuple[int, ...] = ()) -> Member:
        """Start the program's own process, in a folder that is thrown away."""
        program, out = self.job.inputs / "simulation.py", self.job.author / folder
        call = [sys.executable, "-s", str(program), "--pass", what, "--out", str(out), *more]
        reads = (self.job.inputs, *map(Path, self.spec.reads))
        sculpts = kept_sculpts.NOTHING if self.spec.fresh else sculpted(program)
        return self.crew.start("author", call, out, reads, descriptors, sculpts)

    def build(self) -> dict[str, str] | None:
        """Have the program build its world, and take the file out of its folder."""
        if not self.spec.fresh:
            from ..model.plan.plan_text import read_plan
            from .sculpting_step import prepare

            # No plan, or one that is not read here; what a file does not make the program's own process tells, if it needs it.
            with suppress(WorldwrightError):
                prepare(read_plan(self.job.inputs / "plan.md").plan, self.cancelled)
            if self.crew.cancelled():
                return self.job.asked_to_end()
        member = self.author("build", "build")
        if failure := self.ended(member):
            return failure
        for name, limit in ((WORLD, self.spec.file_mb * MB), (FACTS, MB)):
            if not plain.take(member.out / name, self.job.inputs / name, limit):
                message = f"it left no {name}: does it hand its world to worldkit's program.main?"
                return {
                    "code": "no_result",
                    "message": message,
                    "next_move": "end the file with program.main(build, …)",
                }
        write_json(self.job.inputs / INPUTS, declared(self.job.inputs / self.run.source.name))
        return self.unnamed()

    def cancelled(self) -> bool:
        """Whether the job is to end; says on the way that it is still at work."""
        self.tick(self.crew.elapsed())
        return self.crew.cancelled()

    def unnamed(self) -> dict[str, str] | None:
        """Refuse a world with assets that no text names, since its evidence would not depend on them."""
        said = plain.read_json(self.job.inputs / FACTS).get("assets")
        taken = [name for name in said if isinstance(name, str)] if isinstance(said, list) else []
        inputs = self.job.inputs
        found = assets_used.unnamed(taken, inputs / self.run.source.name, inputs / "simulation.py")
        if not found:
            return None
        return {
            "code": "unnamed_asset",
            "message": f"the world takes {', '.join(found)} of the catalog, which neither plan nor program names",
            "next_move": "write each asset's key as a whole word in the program, so that its evidence depends on it",
        }

    def take(self, given: Path) -> dict[str, str] | None:
        """Take an existing world with its recorded inputs."""
        for name in (WORLD, FACTS, INPUTS):
            if not plain.take(given / name, self.job.inputs / name, self.spec.file_mb * MB):
                return {"code": "no_result", "message": f"there is no {name} to simulate", "next_move": "build it anew"}
        return None

    def bundled(self) -> bool:
        """Whether the bundle pass has made the world already, and it could be taken."""
        folder = self.run.evidence(self.spec.key) / folder_name("bundle")
        known = not self.spec.force and plain.read_json(folder / "result.json").get("ok")
        return bool(known) and self.fetch(folder) is None

    def bundle(self) -> Ended:
        """Keep the built world, once a process that never saw its program has compiled and described it."""
        if failure := self.ended(self.engine()):
            return Ended(failure)
        kept = tuple(self.job.inputs / name for name in (WORLD, FACTS, INPUTS))
        summary = plain.read_json(self.job.out / "result.json")
        return Ended(None, {**summary, "world_sha256": sha256_file(kept[0]), **self.rounded()}, kept)

    def rounded(self) -> dict[str, Any]:
        """What of the built world the file holds rounded, as its builder said; empty when it is the same bit for bit."""
        said = plain.read_json(self.job.inputs / FACTS).get("rounded")
        rows = list(said.items())[:MOST_ROUNDED] if isinstance(said, dict) else []
        found = {str(name)[:80]: float(apart) for name, apart in rows if isinstance(apart, int | float)}
        return {"rounded": found} if found else {}

    def fetch(self, folder: Path) -> dict[str, str] | None:
        """Take the world out of a pass's evidence, checked against the hashes in its result."""
        vouched = plain.read_json(folder / "result.json").get("files") or {}
        for name in (WORLD, FACTS, INPUTS):
            copy = self.job.inputs / name
            there = name in vouched and plain.take(folder / name, copy, self.spec.file_mb * MB)
            if not there or sha256_file(copy) != vouched[name]:
                message = f"the world of the {folder.name} pass is not there as it was ({name})"
                again = f"worldwright stage start {self.run.folder} --stage physics --force"
                return {"code": "no_result", "message": message, "next_move": again}
        return None

    # -- the engine --------------------------------------------------------------------------------------------------

    def engine(self, *more: str, reads: tuple[Path, ...] = (), descriptors: tuple[int, ...] = ()) -> Member:
        """Start the process that owns the world."""
        inputs = self.job.inputs
        given = [inputs / WORLD, inputs / FACTS, inputs / INPUTS]
        words = [PASS[self.spec.stage], "--world", str(given[0]), "--program", str(given[1]), "--inputs", str(given[2])]
        call = [sys.executable, "-s", "-P", "-m", "worldengine", *words, "--out", str(self.job.out), *more]
        return self.crew.start("engine", call, self.job.out, (*given, self.job.lock, *reads), descriptors)

    def film(self) -> Ended:
        """Draw the recording, and the run's film; where its author's is refused, the house's own, and say why."""
        final = self.spec.stage == "final"
        program = self.job.filming / authoring.PROGRAM
        if not (final or program.is_file()):
            return Ended(*self.drawn([]))
        if not program.is_file():
            return Ended(*self.told(authoring.UNASKED))
        failure = self.describe(program)
        faults = UNTOLD if failure else REFUSED
        if failure is None:
            failure, said = self.shown()
            if failure is None:
                return Ended(None, said if final else {**said, "drawn_by": environment.film().sha256})
        if failure.get("code") in faults and not self.crew.cancelled():
            (self.job.out / "error.json").unlink(missing_ok=True)
            instead, _ = self.told(authoring.UNASKED)
            if instead is None:
                name = "final.mp4" if final else "film.mp4"
                where = f"the film that nobody asked for is {self.job.out / name}"
                failure = {**failure, "message": f"{failure['message']}; until then, {where}"}
        return Ended(failure)

    def told(self, program: Path) -> tuple[dict[str, str] | None, dict[str, Any]]:
        """Have a film described by its program, and draw it."""
        failure = self.describe(program)
        return (failure, {}) if failure else self.shown()

    def shown(self) -> tuple[dict[str, str] | None, dict[str, Any]]:
        """Draw the film that was described last; a final pass goes on with the frames that an earlier one drew of it."""
        described = self.job.inputs / authoring.FOLDER
        if self.spec.stage == "final":
            refined.carry_over(self.run, self.job, described, self.physics / "trajectory", self.job.inputs / WORLD)
        return self.drawn([described])

    def drawn(self, film: list[Path]) -> tuple[dict[str, str] | None, dict[str, Any]]:
        """Draw the recording, and the films described in these folders; returns the failure and what the engine says."""
        recording, earlier = self.physics / "trajectory", tuple(map(Path, self.spec.reuse))
        more = [*self.spec.arguments, *(word for path in earlier for word in ("--reuse", str(path)))]
        more += [word for folder in film for word in ("--film", str(folder))]
        room = ("--room-mb", str(self.spec.memory_mb)) if self.spec.stage == "video" else ()
        member = self.engine("--from", str(recording), *more, *room, reads=(recording, *earlier, *film))
        failure = self.ended(member)
        return failure, plain.read_json(self.job.out / "result.json")

    def describe(self, program: Path) -> dict[str, str] | None:
        """Let a film's program describe what is shown, in the author's sandbox, and take the description out."""
        inputs, given, out = self.job.inputs, self.job.filming, self.job.author / f"{authoring.FOLDER}-{program.stem}"
        motion = given / authoring.MOTION
        authoring.lay_out(self.physics / "trajectory", inputs / FACTS, motion, inputs / self.run.source.name)
        call = authoring.call(program, motion, out)
        sculpts = sculpted(program) if program.parent == given else None  # the house's own film sculpts nothing
        member = self.crew.start("author", call, out, (given, self.job.lock), sculpts=sculpts)
        if failure := self.ended(member):
            self.crew.end()  # where a limit stopped it, it still runs, and another film may be made now
            return failure
        for name in (DESCRIPTION, ARRAYS):
            if not plain.take(member.out / name, inputs / authoring.FOLDER / name, self.spec.file_mb * MB):
                return {"code": "no_result", "message": f"film.py left no {name}", "next_move": "write film(film)"}
        return None

    def simulate(self) -> Ended:
        """Simulate the world; if it has declared inputs, beside the process that answers for them."""
        source = self.job.inputs / "simulation.py"
        reuse = tuple(map(Path, self.spec.reuse))
        more = [*self.spec.arguments, *(word for path in reuse for word in ("--reuse", str(path)))]
        code, modules = self.code(source)
        more += code
        reads = (source, *modules, *reuse)
        author: Member | None = None
        silent = tuple(self.spec.arguments) == ("--without", "control") and not self.laws()
        if self.spec.given:
            if driven := [Path(self.spec.given) / name for name in DRIVEN if (Path(self.spec.given) / name).is_file()]:
                more += ["--replay", self.spec.given]
            engine = self.engine(*more, reads=(*reads, *driven))
        elif self.asks() and not silent:
            ours, theirs = channel.pair()
            try:
                words = ("--channel", ",".join(map(str, theirs)))
                author = self.author("control", "control", *words, descriptors=theirs)
                more += ["--channel", ",".join(map(str, ours))]
                engine = self.engine(*more, reads=reads, descriptors=ours)
            finally:
                for descriptor in (*ours, *theirs):
                    os.close(descriptor)
        else:
            engine = self.engine(*more, reads=reads)
        stopped = self.crew.watch(engine, self.tick)
        said = plain.read_json(self.job.out / "error.json") if not stopped else {}
        failure = stopped or self.ended(engine)
        summary = plain.read_json(self.job.out / "result.json")
        if author is not None and not stopped:
            self.farewell(author)
            # The engine only knows that the author's process ended; that process itself says why.
            if failure and said.get("code") == "author":
                failure = self.ended(author) or failure
            if strays := _strays(plain.read_json(author.out / "result.json")):
                summary["went_nowhere"] = strays
        summary |= self.rounded()
        if author is None and not silent and not self.spec.given and self.controls():
            summary["not_asked"] = True
        names = (WORLD, FACTS, INPUTS) if not self.spec.variant else ()
        return Ended(failure, summary, tuple(self.job.inputs / name for name in names))

    def code(self, source: Path) -> tuple[list[str], list[Path]]:
        """The engine's options that name all code which may decide the motion, and the modules that it reads for it."""
        found = companions.of(source)
        modules = [name for name in found if name.endswith(".py")]
        data = companions.digest_of({name: content for name, content in found.items() if name not in modules})
        words = ["--source", str(source), "--beside", data, *(word for name in modules for word in ("--module", name))]
        return words, [source.parent / name for name in modules]

    def asks(self) -> bool:
        """Whether the program has a control and the plan declares anything that it may control."""
        rows = json.loads(plain.read(self.job.inputs / INPUTS, MB) or b"[]")
        return self.controls() and any("solver" not in row for row in rows)

    def controls(self) -> bool:
        """Whether the program has a control, or a law of its own."""
        return bool(plain.read_json(self.job.inputs / FACTS).get("control")) or self.laws()

    def laws(self) -> bool:
        """Whether the program has a law of its own, which acts without a control too."""
        return bool(plain.read_json(self.job.inputs / FACTS).get("laws"))

    def farewell(self, author: Member) -> None:
        """Let the author's process end by itself, as it does when the engine hangs up."""
        family.ends_within(author.process, FAREWELL_S)

    def ended(self, member: Member) -> dict[str, str] | None:
        """How a process failed or was stopped; None when neither happened."""
        stopped = self.crew.watch(member, self.tick)
        status = member.process.returncode
        if stopped or status is None:
            return stopped or {"code": "killed", "message": "it did not end"}
        summary, error = (plain.read_json(member.out / name) for name in ("result.json", "error.json"))
        return failed(status, summary, error, self.log) or self.crew.look()


def sculpted(program: Path) -> kept_sculpts.Given:
    """What was sculpted earlier by a program with the files that belong to it."""
    return kept_sculpts.given(companions.of(program) | {program.name: program.read_bytes()})


def declared(source: Path) -> list[dict[str, Any]]:
    """Kind and names of every input that a plan declares; none without a plan."""
    from ..model.plan.plan_text import read_plan  # a third of a supervisor's start, and most passes never ask

    try:
        plan = read_plan(source).plan
    except (WorldwrightError, OSError):
        return []
    parameters = plan.simulation_parameters
    return [
        {"kind": row.kind, "bodies": list(row.bodies), **row.beside(parameters.constants)}
        for row in parameters.interventions
    ]


def _strays(result: dict[str, Any]) -> list[dict[str, Any]]:
    """What the control wrote without effect, by the word of the author's process."""
    rows = result.get("went_nowhere")
    found = []
    for row in rows[:MOST_STRAYS] if isinstance(rows, list) else ():
        if isinstance(row, dict) and isinstance(row.get("line"), int):
            found.append({"array": str(row.get("array", ""))[:80], "line": row["line"]})
    return found
