"""`worldwright judge`: films scored against a benchmark's criteria, by a judge that saw nothing of how they were built."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..cli import report_errors, show

if TYPE_CHECKING:
    from .entrants import Entrant
    from .hearing import Bench, Heard
    from .verdict_record import Records

COUNT = click.option("--count", is_flag=True, help="Only say how much would be sent, and where to.")
FORMAT = click.option("--format", "style", type=click.Choice(["text", "json"]), default="text", help="How to print.")
OUT = click.option("--out", type=click.Path(path_type=Path), help="Verdicts lie here; else in your data folder.")


@click.group("judge")
def command() -> None:
    """Score films against a benchmark's criteria; whoever builds sees no verdict."""


def _asking(function: Callable[..., Any]) -> Callable[..., Any]:
    """The options that say who judges and how."""
    for option in reversed(
        (
            click.option("--judge", "name", required=True, help="Which kind of judge: `judge judges` lists them."),
            click.option("--model", default="", help="As the judge's server or harness names it."),
            click.option(
                "--address", help="Where it listens, or the harness's program; else its environment variable."
            ),
            click.option(
                "--shows", type=click.Choice(["frames", "sheet", "film"]), default="frames", help="What it is shown."
            ),
            click.option(
                "--frames", type=click.IntRange(2, 64), default=8, show_default=True, help="So many of a film."
            ),
            click.option("--words", type=click.Path(path_type=Path), help="The question in your words, in a file."),
            click.option(
                "--votes", type=click.IntRange(1), default=1, show_default=True, help="Answers to each film; odd."
            ),
            click.option(
                "--silent-s", type=click.FloatRange(1), default=120.0, show_default=True, help="Its longest silence, s."
            ),
        )
    ):
        function = option(function)
    return function


@command.command()
@click.argument("films", type=click.Path(path_type=Path))
@click.option(
    "--criteria",
    type=click.Path(path_type=Path),
    required=True,
    help="The published data set's folder, or a file of it.",
)
@click.option("--camera", help="Which film of a run; else the author's, else the first by name.")
@OUT
@COUNT
@_asking
@FORMAT
def run(films: Path, criteria: Path, camera: str | None, out: Path | None, count: bool, style: str, **how: Any) -> None:
    """Put films before a judge. FILMS: a folder of `039.mp4`, of runs, a campaign, or a list {id: path}.

    Every vote is kept as it comes; the same command goes on where it ended.
    """

    def work() -> "Heard | None":
        _apart()
        from . import eighty, entrants, hearing, published_set
        from .verdict_record import Records

        set_of, errors = published_set.read(criteria)
        for error in errors[1:]:
            click.echo(f"{error.code}: {error}", err=True)
        if errors:
            raise errors[0]
        prompts = {id: list(one.prompts) for id, one in set_of.scenarios.items()}
        for one in eighty.prompts():
            prompts.setdefault(one.id, []).append(one.prompt)
        entered = entrants.find(films, prompts, camera)
        for line in entered.left_out:
            click.echo(f"left out: {line}", err=True)
        records, bench = Records.at(out, films.resolve().name), _bench(**how)
        if count:
            _counted(entered.entrants, bench)
            return None
        records.begin(bench.protocol, bench.words)
        return hearing.hear(records, set_of.scenarios, entered.entrants, bench, _say, films)

    _end(report_errors(work, style), out, films.resolve().name)


@command.command()
@click.argument("name_of_verdicts", metavar="[VERDICTS]", required=False)
@OUT
@COUNT
@_asking
@FORMAT
def calibrate(name_of_verdicts: str | None, out: Path | None, count: bool, style: str, **how: Any) -> None:
    """Show a judge films whose faults are known, and say whether it is fit. VERDICTS: the name of a judged folder.

    Its answers lie beside the verdicts whose protocol they share.
    """

    def work() -> Any:
        _apart()
        import tempfile

        from . import calibration, hearing, planted

        records, bench = _verdicts(out, name_of_verdicts or "calibration"), _bench(**how)
        if count:
            click.echo(f"{len(planted.scenarios()) * bench.votes} questions to {bench.protocol.address}")
            return None
        records.begin(bench.protocol, bench.words)
        records.calibration.begin(bench.protocol, bench.words)
        with tempfile.TemporaryDirectory(prefix="worldwright-planted-") as folder:
            made = planted.films(Path(folder))
            heard = hearing.hear(records.calibration, planted.scenarios(), made, bench, _say)
        if heard.ended is not None:
            raise heard.ended
        return calibration.calibrated(records.calibration.all())

    found = report_errors(work, style)
    if found is not None:
        show(found, style)
        sys.exit(0 if found.fit else 1)


@command.command()
@click.argument("verdicts", nargs=-1)
@click.option("--to", type=click.Path(path_type=Path), help="Write scores.md, scores.csv and scores.html here.")
@click.option("--given-only", is_flag=True, help="Count the films that were given, not the eighty of the set.")
@FORMAT
def report(verdicts: tuple[str, ...], to: Path | None, given_only: bool, style: str) -> None:
    """The table: published figures, and each judged folder that is named. VERDICTS: folders, or names in your data folder.

    Without any it is the published figures alone.
    """

    def work() -> Any:
        from . import scored_report
        from .verdict_record import outside

        if verdicts:
            _apart()

        made = scored_report.Report(
            own=tuple(scored_report.of(_verdicts(None, name), everything=not given_only) for name in verdicts)
        )
        if to is not None:
            folder = outside(to) if verdicts else to
            for path in scored_report.write(made, folder):
                click.echo(str(path), err=True)
        return made

    made = report_errors(work, style)
    if to is None:
        show(made, style)
    sys.exit(0 if made.ok else 1)


@command.command()
@click.argument("folder", type=click.Path(path_type=Path))
def criteria(folder: Path) -> None:
    """Read a folder of criteria, and say what is in it and what is wrong."""

    def work() -> int:
        from . import eighty, published_set

        found, errors = published_set.read(folder)
        wanted = {one.id for one in eighty.prompts()}
        click.echo(
            f"{len(found.scenarios)} scenarios, {len(wanted & found.scenarios.keys())} of the set's {len(wanted)}, "
            f"{sum(len(one.criteria.standards) for one in found.scenarios.values())} key standards"
        )
        for error in errors:
            click.echo(f"{error.code}: {error}", err=True)
        return 2 if errors else 0

    sys.exit(report_errors(work))


@command.command()
def judges() -> None:
    """Every kind of judge, and how one comes by it."""

    def work() -> None:
        from .judges import SEAM

        for name in SEAM.names():
            one = SEAM.find(name)
            shown = "pictures, films" if one.LIMITS.films else "pictures"
            click.echo(f"{name} ({shown}; {one.ADDRESS}): {one.starting()}")

    report_errors(work)


@command.command()
@FORMAT
def prompts(style: str) -> None:
    """The eighty prompts of the reference's set, one a line; none of the criteria."""

    def work() -> None:
        from . import eighty

        for one in eighty.prompts():
            click.echo(one.model_dump_json() if style == "json" else f"{one.id} [{one.category}] {one.prompt}")

    report_errors(work, style)


def _verdicts(out: Path | None, name: str) -> "Records":
    from worldkit.data_folders import data_root

    from ..contract.users_data import JUDGED
    from .verdict_record import PROTOCOL, Records, outside

    if out is None and (Path(name) / PROTOCOL).is_file():
        return Records(outside(Path(name)))
    return Records.at(out, Path(name).name) if out is not None else Records(outside(data_root() / JUDGED / name))


def _apart() -> None:
    """Refuse an agent's shell: who builds neither asks the judge nor hears it.

    Raises:
        GateError: this command began in a harness.
    """
    from ..contract import harnesses
    from ..model.errors import GateError

    if harness := harnesses.around():
        raise GateError(
            f"this shell is {harness}'s, and nobody who builds hears a verdict", place="worldwright judge",
            next_move="a person runs it, in a terminal of theirs",
        )  # fmt: skip


def _bench(
    name: str, model: str, address: str | None, shows: Any, frames: int, words: Path | None, votes: int,
    silent_s: float,
) -> "Bench":  # fmt: skip
    import hashlib
    import os

    from ..model.errors import NotFoundError
    from . import judging_prompt, one_call
    from .hearing import Bench, odd
    from .judges import SEAM
    from .verdict_record import Protocol

    if name not in SEAM.names():
        raise NotFoundError(
            f"no judge is called {name!r}", place="--judge", next_move=f"name one of: {', '.join(SEAM.names())}"
        )
    judge = SEAM.find(name)
    where = address or os.environ.get(judge.ADDRESS, "")
    if not where:
        raise NotFoundError(
            f"nothing says where the judge {name} is: films leave this machine only for an address that you name",
            place=f"--address, or {judge.ADDRESS}", next_move=judge.starting(),
        )  # fmt: skip
    text = judging_prompt.template(words)
    protocol = Protocol(
        judge=name, model=model, address=one_call.place_of(where) if "://" in where else where, form=shows,
        frames=0 if shows == "film" else frames, words_sha256=hashlib.sha256(text.encode()).hexdigest(),
        own_words=words is None,
    )  # fmt: skip
    return Bench(protocol, text, where, odd(votes), silent_s)


def _counted(entrants: "dict[str, Entrant]", bench: "Bench") -> None:
    from .hearing import size

    questions, sent = size(entrants, bench)
    click.echo(
        f"{questions} questions about {len(entrants)} films, some {sent / 1e6:.1f} MB, to {bench.protocol.address}"
    )


def _say(line: str) -> None:
    click.echo(line, err=True)


def _end(heard: "Heard | None", out: Path | None, name: str) -> None:
    """Exit code 0: every film is decided; 1: some are not; 2: the judge could not be asked."""
    if heard is None:
        return
    click.echo(f"{heard.decided} films decided, {len(heard.undecided)} not; {heard.asked} questions asked now")
    for id, why in heard.undecided.items():
        click.echo(f"  {id}: {why}", err=True)
    if heard.ended is not None:
        click.echo(f"{heard.ended.code}: {heard.ended}", err=True)
        sys.exit(2)
    click.echo(f"  next: worldwright judge report {out or name}")
    sys.exit(1 if heard.undecided else 0)
