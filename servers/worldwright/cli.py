"""The command line: `worldwright <server> <verb> …`, and the few commands that span servers.

A server's verbs are its tool functions. Only the called group is imported, so `--help` and a lint run start
fast. Exit codes: 0 yes, 1 the answer is no (findings, a failed pass), 2 the call could
not be answered (its cause and the next move are printed), 3 `stamp verify` proved the world, but nobody who is known here
vouches for it, 70 a defect of ours (as in `sysexits.h`).
"""

import functools
import inspect
import json
import os
import sys
import types
import typing
from collections.abc import Callable
from pathlib import Path
from typing import Any

import click

from . import expose, picture_files
from .model import printable
from .model.errors import WorldwrightError
from .model.evidence import came

COMMANDS = {
    "go": (
        "worldwright.go",
        "Advance a run as far as it goes without a decision; with --accept from a plan to an accepted world.",
    ),
    "campaign": (
        "worldwright.campaign.command",
        "Many worlds at once: sweeps of one plan, or many plans, and a table of what came of them.",
    ),
    "judge": (
        "worldwright.judge.command",
        "Score films against a benchmark's criteria, by a judge that nobody who builds hears: run, calibrate, report.",
    ),
    "plan": ("worldwright.planning", "Begin a plan from the nearest accepted world; complete one from what is built."),
    "sculpt": ("worldwright.sculpting", "See something sculpted from four sides: `sculpt sheet FILE.py[:NAME]`."),
    "asset": (
        "worldwright.intake.command",
        "Make an asset of a mesh file of yours; list the assets of every source; show one.",
    ),
    "watch": ("worldwright.kept_open", "Look at a run and leave it open: redrawn when a file of it is saved."),
    "live": (
        "worldwright.live",
        "Drive a world live from a browser: keys, gamepad, sliders; kept, filmed, proved by replay.",
    ),
    "drive": ("worldwright.driven_worlds", "What is left of live drives: list them, prove one again, film it."),
    "hand-in": (
        "worldwright.handing_in",
        "Hand in a film of a run that you drew yourself: shown as its author's, never evidence.",
    ),
    "report": ("worldwright.report.command", "Write a run's self-contained report.html."),
    "export": ("worldwright.exported", "Write the recorded motion as glTF, USD, or MCAP in ROS 2's messages."),
    "gc": (
        "worldwright.freeing",
        "Free what can be made again of runs: pictures, recordings and jobs of earlier programs.",
    ),
    "gallery": (
        "worldwright.gallery.command",
        "The accepted worlds under examples/: keep one, prove, build or accept all.",
    ),
    "versions": (
        "worldwright.accepted_versions",
        "What was accepted of a run: list it, compare two versions, bring an earlier one back.",
    ),
    "keys": ("worldwright.stamp.keys", "The key that signs what is accepted here, and the keys that are known."),
    "contract": ("worldwright.contract.command", "The roles of a run in each harness's own files: sync, check, show."),
    "lessons": (
        "worldwright.contract.lessons",
        "Root causes in runs' journals, and the skill or rule to write them into.",
    ),
    "new": (
        "worldwright.scaffolds.new_entry",
        "Scaffold an entry of any shelf: rule, check, expectation, predicate, relation, gate, section.",
    ),
    "new-rule": (
        "worldwright.new_rule",
        "Scaffold a lint rule from a failed iteration in a run's journal: what one run met, no other should.",
    ),
    "doctor": (
        "worldwright.doctor",
        "Check Python, OpenGL, the sandbox, the servers and the harnesses; name a fix for each problem.",
    ),
    "index": (
        "worldwright.retrieve.command",
        "Build what `retrieve` searches ahead of time; add folders and forum exports of yours.",
    ),
    "export-forum": (
        "worldwright.retrieve.forum_export",
        "Write a repository's issues and discussions to a file that `index --add` makes searchable.",
    ),
    "serve": ("worldwright.serve", "Run one MCP server over stdio or streamable HTTP."),
}


class Root(click.Group):
    """Commands by name, imported when called."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Every server and every spanning command."""
        return [*COMMANDS, *expose.SERVERS]

    def get_command(self, ctx: click.Context, name: str) -> click.Command | None:
        """Import one command."""
        if name in expose.SERVERS:
            return Verbs(name)
        if name in COMMANDS:
            import importlib

            return importlib.import_module(COMMANDS[name][0]).command
        return None

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands without importing them."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, help_text) for name, (_, help_text) in COMMANDS.items()])
        with formatter.section("Servers (each verb is also an MCP tool)"):
            formatter.write_dl(list(expose.SERVERS.items()))

    def resolve_command(
        self, ctx: click.Context, args: list[str]
    ) -> tuple[str | None, click.Command | None, list[str]]:
        """List the known commands when an unknown one is typed; `stage.take_one`, as agents say, is `stage take-one`."""
        args = [*args[0].split(".", 1), *args[1:]] if args and args[0].split(".")[0] in expose.SERVERS else args
        if len(args) > 1 and args[0] in expose.SERVERS:
            args = [args[0], args[1].replace("_", "-"), *args[2:]]
        if args and args[0] not in self.list_commands(ctx) and not args[0].startswith("-"):
            ctx.fail(f"there is no command '{args[0]}'; known: {', '.join(self.list_commands(ctx))}")
        return super().resolve_command(ctx, args)


class Verbs(click.Group):
    """The verbs of one server."""

    def __init__(self, server: str) -> None:
        super().__init__(name=server, help=expose.SERVERS[server], no_args_is_help=True)
        for function in expose.tools(server):
            self.add_command(verb(function))


def verb(function: Callable[..., Any]) -> click.Command:
    """One tool function as a command."""
    annotations = expose.hints(function)
    listener = expose.progress_parameter(function)
    parameters = [
        _parameter(parameter, annotations[parameter.name])
        for parameter in inspect.signature(function).parameters.values()
        if parameter.name != listener
    ]
    limit = getattr(function, "waits", None)
    for own in (p for p in parameters if p.name == limit and isinstance(p, click.Option)):
        own.default, own.show_default = None, "when all is done"
    batch = getattr(function, "batch", None)
    if batch:
        next(p for p in parameters if p.name == batch[0]).required = False
        text = f"A file with one {batch[0]} a line (- is standard input); prints one JSON line each."
        parameters.append(
            click.Option(["--batch", "_batch"], type=click.Path(path_type=Path, allow_dash=True), help=text)
        )
    many = getattr(function, "several", None)
    if many:
        parameters = [
            click.Argument([many], type=p.type, nargs=-1, required=True) if p.name == many else p for p in parameters
        ]
    if picture_files.illustrated(annotations.get("return")) and "out" not in annotations:
        text = "A folder to write the pictures into; without it, `out` of the run."
        parameters.append(
            click.Option(["--save", "_save"], type=click.Path(path_type=Path, file_okay=False), help=text)
        )
        parameters.append(click.Option(["--png", "_png"], is_flag=True, help="Write them as PNG, not as JPEG."))
    choices = click.Choice(["text", "json", *getattr(function, "formats", ())])
    parameters.append(click.Option(["--format", "_format"], type=choices, default="text", help="How to print."))

    def run(_format: str, _batch: Path | None = None, _save: Path | None = None, **values: Any) -> None:
        as_png = values.pop("_png", False)
        arguments = {limit: float("inf")} if limit else {}
        arguments |= {name: _value(annotations[name], value) for name, value in values.items() if value is not None}
        if _batch is not None:
            sys.exit(report_errors(lambda: _each(function, _batch, arguments), _format))
        if many:
            sys.exit(_one_by_one(function, many, arguments, _format, listener is not None))
        if batch and batch[0] not in arguments:
            raise click.UsageError(f"give a {batch[0]}, or --batch FILE with one a line")
        result = report_errors(lambda: _call(function, arguments, listener is not None), _format)
        show(result, _format)
        if "out" not in annotations:
            aside = functools.partial(picture_files.beside, function.__name__, arguments)
            picture_files.write(result, _save, _format, as_png, aside)
        sys.exit(expose.exit_code(result))

    return click.Command(
        function.__name__.replace("_", "-"),
        callback=run,
        params=parameters,
        help=expose.description(function),
    )


def _call(function: Callable[..., Any], arguments: dict[str, Any], listens: bool) -> Any:
    from .contract import harnesses
    from .report.bar import shown

    with came.entered(came.by_command(harnesses.around())), shown(listens, hasattr(function, "waits")) as progress:
        return expose.call(function, arguments, progress)


def _one_by_one(
    function: Callable[..., Any], parameter: str, arguments: dict[str, Any], style: str, listens: bool
) -> int:
    """Call a tool for every value of a parameter; the exit code is the worst one. A failure does not stop the rest."""
    worst = 0
    for value in arguments[parameter]:
        try:
            one = functools.partial(_call, function, {**arguments, parameter: value}, listens)
            result = report_errors(one, style)
        except SystemExit as refused:
            worst = max(worst, int(refused.code or 0))
            continue
        worst = max(worst, expose.exit_code(result))
        if style == "json":
            click.echo(_line(result))
        else:
            if len(arguments[parameter]) > 1:
                click.echo(f"{value}:")
            show(result, style)
    return worst


def _line(result: Any) -> str:
    return json.dumps(json.loads(expose.to_json(result)), ensure_ascii=False, separators=(",", ":"))


def _each(function: Callable[..., Any], lines: Path, arguments: dict[str, Any]) -> int:
    """Call a tool for every line of a file; the exit code is the worst one."""
    from .report.bar import bar

    parameter, before = function.batch  # type: ignore[attr-defined]
    try:
        with click.open_file(str(lines), encoding="utf-8", errors="replace") as handle:
            values = [line.strip() for line in handle if line.strip()]
    except OSError as cause:
        raise WorldwrightError(
            f"the batch cannot be read: {cause.strerror}", place=str(lines), next_move="name a text file"
        ) from cause
    if before is not None:
        with bar() as progress:
            before(progress)
    worst = 0
    for value in values:
        result = expose.call(function, {**arguments, parameter: value})
        worst = max(worst, expose.exit_code(result))
        click.echo(_line(result))
    return worst


def report_errors(action: Callable[[], Any], style: str = "text") -> Any:
    """Run `action`; a `WorldwrightError` is printed with its cause, place and next move, and ends with status 2."""
    try:
        return action()
    except WorldwrightError as error:
        if style == "json":
            click.echo(json.dumps(error.to_dict(), ensure_ascii=False, indent=2))
        else:
            for finding in getattr(error, "findings", ()):
                click.echo(printable.words(str(finding)), err=True)
            click.echo(printable.words(f"{error.code}: {error}"), err=True)
        sys.exit(2)
    except Exception as error:  # it is a defect of ours; the traceback is for those who ask
        if os.environ.get("WORLDWRIGHT_DEBUG"):
            raise
        click.echo(printable.words(f"internal: {type(error).__name__}: {error}"), err=True)
        click.echo(
            "  next: this is a defect of ours; WORLDWRIGHT_DEBUG=1 shows where. Your files are untouched.", err=True
        )
        sys.exit(70)
    except KeyboardInterrupt:
        click.echo("interrupted; what was finished is kept", err=True)
        sys.exit(130)


def show(result: Any, style: str) -> None:
    """Print a result: JSON, a format of its own, or its `text()`, in colours on a terminal."""
    if style == "json":
        click.echo(printable.words(expose.to_json(result)))
        return
    data = getattr(result, "data", result)
    if style != "text":
        click.echo(getattr(data, style)())
        return
    if sys.stdout.isatty() and "NO_COLOR" not in os.environ and hasattr(data, "rich"):
        from rich.console import Console

        Console(soft_wrap=True, highlight=False).print(data.rich())
        return
    click.echo(printable.words(data.text()) if hasattr(data, "text") else expose.to_json(data))


def _parameter(parameter: inspect.Parameter, annotation: Any) -> click.Parameter:
    kind, help_text = _unwrap(annotation)
    many = typing.get_origin(kind) in (list, tuple)
    item = typing.get_args(kind)[0] if many else kind
    required = parameter.default is inspect.Parameter.empty
    default = None if required else parameter.default
    if required:
        metavar = f"{parameter.name.upper()}(JSON|@FILE)" if _structured(kind) else None
        nargs = -1 if many else 1
        return click.Argument([parameter.name], type=_click_type(item), nargs=nargs, required=True, metavar=metavar)
    if any(isinstance(mark, expose.Positional) for mark in typing.get_args(annotation)[1:]):
        if many:  # click takes no default for a variadic argument: without values it gives an empty list
            return click.Argument([parameter.name], type=_click_type(item), nargs=-1, required=False)
        return click.Argument([parameter.name], type=_click_type(item), required=False, default=default)
    flag = ("--" if len(parameter.name) > 1 else "-") + parameter.name.replace("_", "-")
    if item is bool:
        return click.Option([f"{flag}/--no-{flag[2:]}", parameter.name], default=default, help=help_text)
    also = [mark.flag for mark in typing.get_args(annotation)[1:] if isinstance(mark, expose.Also)]
    shown = default is not None
    given: dict[str, Any] = {"multiple": many, "default": default, "help": help_text, "show_default": shown}
    return click.Option([flag, *also, parameter.name], type=_click_type(item), **given)


def _unwrap(annotation: Any) -> tuple[Any, str]:
    """Strip `Annotated` and `| None`; returns the bare type and the field's description."""
    help_text = ""
    if typing.get_origin(annotation) is typing.Annotated:
        annotation, *metadata = typing.get_args(annotation)
        help_text = next((m.description or "" for m in metadata if hasattr(m, "description")), "")
    if typing.get_origin(annotation) in (typing.Union, types.UnionType):
        annotation = next(a for a in typing.get_args(annotation) if a is not type(None))
    return annotation, help_text


def _click_type(kind: Any) -> Any:
    if typing.get_origin(kind) is typing.Literal:
        return click.Choice([str(value) for value in typing.get_args(kind)])
    if kind is Path:
        return click.Path(path_type=Path)
    return {int: click.INT, float: click.FLOAT, bool: click.BOOL}.get(kind, click.STRING)


def _structured(kind: Any) -> bool:
    return typing.get_origin(kind) is dict or (inspect.isclass(kind) and issubclass(kind, expose.BaseModel))


def _value(annotation: Any, value: Any) -> Any:
    """Turn a value from click into the function's argument; models arrive as JSON text or as @file."""
    from pydantic import TypeAdapter, ValidationError

    kind, _ = _unwrap(annotation)
    origin = typing.get_origin(kind)
    if _structured(kind) and isinstance(value, str):
        try:
            text = Path(value[1:]).read_text(encoding="utf-8") if value.startswith("@") else value
            return TypeAdapter(kind).validate_json(text)
        except (OSError, ValidationError) as cause:
            raise click.BadParameter(f"{cause} (give JSON, or @file.json)") from cause
    return list(value) if origin in (list, tuple) else value


@click.group(cls=Root, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="worldwright")
def main() -> None:
    """Turn a sentence into a physically grounded, executable world."""


if __name__ == "__main__":
    main()
