"""One typed function becomes one MCP tool and one command-line verb.

A server is a package `worldwright.<name>` whose `tools.py` lists its public functions in `TOOLS`. A function takes
typed arguments (`Annotated[Path, Field(description=…)]`; a pydantic model arrives as JSON), may take a `Progress`, and
returns a pydantic model, or `Illustrated` when it shows pictures. Failures are `WorldwrightError`s. Nothing here knows
what any server does.

Pictures are sent as a list of text and images without structured content, the only form that every coding harness passes
on to its model.
"""

import contextlib
import functools
import gc
import importlib
import inspect
import logging
import time
import typing
from collections.abc import Callable
from typing import TYPE_CHECKING, Annotated, Any

from pydantic import BaseModel, Field, ValidationError, create_model
from pydantic_core import to_json as to_json_bytes

from . import arguments as arguments_of
from .model import call_time
from .model.errors import WorldwrightError
from .model.evidence import came
from .model.picture import Illustrated
from .model.progress import Progress, silent
from .paging import fit, lists
from .schema import plain
from .wire import streams

if TYPE_CHECKING:
    from mcp.server import MCPServer
    from mcp_types import Tool

SERVERS = {
    "retrieve": "What do the installed simulator, its manual and the catalog say about this?",
    "lint": "May this plan be committed; may this program run?",
    "place": "Where does everything go, and why?",
    "stage": "Run it: physics, stills, video.",
    "scan": "Is the motion plausible, and does it do what the plan claims?",
    "stamp": "What has been proven so far, and is it enough?",
}


LENT = {
    "stage": ("worldwright.rehearsing", "worldwright.campaign.tools"),
    "retrieve": ("worldwright.adding_assets",),
}
"""Modules with more tools of a server: such as need servers that stand on it, and which it may therefore not import."""
BEAT_S = 10.0
"""A call is silent for at most twice so long, s: a client that counts its patience anew at each word waits 30 s."""


def tools(server: str) -> tuple[Callable[..., Any], ...]:
    """The public functions of a server, with those that it is lent, imported when asked for."""
    modules = (f"worldwright.{server}.tools", *LENT.get(server, ()))
    return tuple(tool for module in modules for tool in importlib.import_module(module).TOOLS)


def hints(function: Callable[..., Any]) -> dict[str, Any]:
    """A function's annotations with their metadata."""
    return typing.get_type_hints(function, include_extras=True)


def progress_parameter(function: Callable[..., Any]) -> str | None:
    """The name of the parameter that takes a `Progress`, if any."""
    return next((name for name, kind in hints(function).items() if kind is Progress), None)


def build_server(name: str) -> "MCPServer":
    """An MCP server with one tool per function of `worldwright.<name>.tools`."""
    from mcp.server import MCPServer
    from mcp_types import ToolAnnotations

    from . import __version__

    class Server(MCPServer):
        async def list_tools(self) -> "list[Tool]":
            return [_plain(tool) for tool in await super().list_tools()]

        async def call_tool(self, name: str, arguments: dict[str, Any], context: Any = None) -> Any:
            from mcp.server.mcpserver.exceptions import ToolError

            known = {tool.name: tool.input_schema for tool in await self.list_tools()}
            try:
                arguments_of.check(name, arguments, known)
                return await super().call_tool(name, arguments, context)
            except arguments_of.ArgumentError as error:
                return _refusal(error)
            except ToolError as error:
                if isinstance(error.__cause__, ValidationError):
                    return _refusal(arguments_of.invalid(name, error.__cause__, known[name]))
                raise

        async def run_stdio_async(self) -> None:
            async with streams() as (incoming, outgoing):
                inner = self._lowlevel_server
                await inner.run(incoming, outgoing, inner.create_initialization_options())

    server = Server(f"worldwright-{name}", instructions=SERVERS[name], version=__version__, log_level="WARNING")
    for function in tools(name):
        read_only = bool(getattr(function, "read_only", False))
        server.add_tool(
            _as_tool(function),
            name=function.__name__,
            description=description(function),
            annotations=ToolAnnotations(read_only_hint=read_only, open_world_hint=False, destructive_hint=False),
        )
    return server


def _plain(tool: "Tool") -> "Tool":
    output = plain(tool.output_schema) if tool.output_schema else None
    return tool.model_copy(update={"input_schema": plain(tool.input_schema, optional=True), "output_schema": output})


class Positional:
    """Marks a parameter that may be left out and yet has a place on the command line."""


class Also:
    """Another flag of a parameter on the command line.

    Args:
        flag: with its dashes.
    """

    def __init__(self, flag: str) -> None:
        self.flag = flag


def reads(function: Callable[..., Any]) -> Callable[..., Any]:
    """Mark a tool that changes nothing, so that clients may call it without asking."""
    function.read_only = True  # type: ignore[attr-defined]
    return function


def batched(parameter: str, before: Callable[[Progress], None] | None = None) -> Callable[..., Any]:
    """Give a tool's command `--batch FILE`: one value of `parameter` per line, one JSON result per line.

    Args:
        parameter: the tool's argument that each line fills.
        before: it is called once before the first line.
    """

    def mark(function: Callable[..., Any]) -> Callable[..., Any]:
        function.batch = (parameter, before)  # type: ignore[attr-defined]
        return function

    return mark


def several(parameter: str) -> Callable[..., Any]:
    """Let a tool's command take many values of `parameter`, with one call and one line of JSON for each."""

    def mark(function: Callable[..., Any]) -> Callable[..., Any]:
        function.several = parameter  # type: ignore[attr-defined]
        return function

    return mark


def waits(parameter: str) -> Callable[..., Any]:
    """Let a tool's command wait until all is done, and tell how far it is: a client of MCP has no patience, a shell has.

    Args:
        parameter: the tool's limit in seconds, which counts on the command line only where it is given.
    """

    def mark(function: Callable[..., Any]) -> Callable[..., Any]:
        function.waits = parameter  # type: ignore[attr-defined]
        return function

    return mark


def description(function: Callable[..., Any]) -> str:
    """The text that an agent reads about a tool: its docstring, unwrapped."""
    return inspect.cleandoc(function.__doc__ or "").strip()


def _as_tool(function: Callable[..., Any]) -> Callable[..., Any]:
    """Wrap a plain function for MCP: progress in, pictures, pages and errors out."""
    from anyio import create_task_group, from_thread, to_thread
    from mcp.server.mcpserver import Context, Image

    listener = progress_parameter(function)
    returns = hints(function).get("return")
    model = returns if inspect.isclass(returns) and issubclass(returns, BaseModel) else None
    fields = lists(model) if model else ()

    @functools.wraps(function)
    async def tool(*args: Any, ctx: Context, page: int = 1, **kwargs: Any) -> Any:
        heard = _Heard(ctx)
        async with create_task_group() as beside:
            beside.start_soon(heard.beat, function.__name__)
            try:
                return await to_thread.run_sync(functools.partial(answer, heard, ctx, page, *args, **kwargs))
            finally:
                beside.cancel_scope.cancel()

    def answer(heard: _Heard, ctx: Context, page: int, *args: Any, **kwargs: Any) -> Any:
        spoken = came.by_client(_client(ctx), function.__name__, kwargs)
        if listener:
            kwargs[listener] = functools.partial(_report, from_thread, heard)
        try:
            with came.entered(spoken), call_time.limited(call_time.CALL_S):
                return _answer(function(*args, **kwargs), fields, page)
        except WorldwrightError as error:
            return _refusal(error)
        except OSError as error:
            return _refusal(
                arguments_of.too_long(function.__name__, error, kwargs) or _failed(function.__name__, error)
            )
        except Exception as error:  # a defect of ours must not look like an answer, nor end the server
            return _refusal(_failed(function.__name__, error))

    signature = inspect.signature(function)
    parameters = [p for p in signature.parameters.values() if p.name != listener]
    annotations = {k: v for k, v in hints(function).items() if k != listener}
    if fields:
        annotations["page"] = Annotated[int, Field(description="Of a long answer, which page", ge=1)]
        parameters.append(inspect.Parameter("page", inspect.Parameter.KEYWORD_ONLY, default=1))
    parameters.append(inspect.Parameter("ctx", inspect.Parameter.KEYWORD_ONLY))
    annotations["ctx"] = Context
    if returns is Illustrated:
        annotations["return"] = list[str | Image]
    elif model:
        annotations["return"] = create_model(model.__name__, __base__=model, shortened=(str, ""))
    tool.__annotations__ = annotations
    tool.__signature__ = signature.replace(  # type: ignore[attr-defined]
        parameters=[p.replace(annotation=annotations[p.name]) for p in parameters],
        return_annotation=annotations.get("return", inspect.Signature.empty),
    )
    del tool.__wrapped__  # otherwise the SDK would read the original signature
    return tool


def _answer(result: Any, fields: tuple[str, ...], page: int) -> Any:
    """A result as every client passes it on: pictures without structured content, data with it, neither too long."""
    from mcp.server.mcpserver import Image
    from mcp_types import CallToolResult, TextContent

    if isinstance(result, Illustrated):
        content: list[Any] = [_line(fit(result.data.model_dump(mode="json", exclude_defaults=True)))]
        for picture in result.pictures:
            content += [picture.caption, Image(data=picture.data, format=picture.format)]
        return content
    if not isinstance(result, BaseModel):
        return result
    data = fit(result.model_dump(mode="json", by_alias=True), fields, page)
    return CallToolResult(content=[TextContent(type="text", text=_line(data))], structured_content=data)


def _line(data: Any) -> str:
    """JSON without spaces, for which a client's model would pay."""
    return to_json_bytes(data, inf_nan_mode="null").decode()


class _Heard:
    """What the client of one call has heard: progress that grows as long as its total stays, and a word now and then."""

    def __init__(self, ctx: Any) -> None:
        self.ctx, self.done, self.total, self.at = ctx, 0.0, 0.0, time.monotonic()

    async def tell(self, done: float, total: float, message: str) -> None:
        """Report to the client."""
        self.done = max(done, self.done) if total == self.total else done  # another total is another piece of work
        self.total, self.at = total, time.monotonic()
        with contextlib.suppress(Exception):  # a client that stopped listening must not stop the work
            await self.ctx.report_progress(self.done, total or None, message or None)

    async def beat(self, name: str) -> None:
        """Say of a silent call that it is at work, until it is cancelled; what is done hardly grows by it."""
        from anyio import sleep

        began = time.monotonic()
        while True:
            await sleep(BEAT_S)
            if (now := time.monotonic()) - self.at >= BEAT_S:
                await self.tell(self.done + 1e-6, self.total, f"{name}: at work for {now - began:.0f} s")


def _report(from_thread: Any, heard: _Heard, done: float, total: float, message: str = "") -> None:
    with contextlib.suppress(Exception):  # the call has ended
        from_thread.run(heard.tell, done, total, message)


def _client(ctx: Any) -> str:
    """The name that the client gave itself; empty when it gave none."""
    try:
        return str(ctx.session.client_params.client_info.name)[:80]
    except AttributeError:
        return ""


def _failed(name: str, error: Exception) -> WorldwrightError:
    logging.getLogger(__name__).exception("%s failed", name)  # noqa: LOG004 - its caller handles one
    return WorldwrightError(
        f"{name} failed inside Worldwright: {type(error).__name__}: {error}",
        next_move="this is a defect of ours, not of your input: report it with the traceback on standard error",
    )


def _refusal(error: WorldwrightError) -> Any:
    """An error result, both as text and as structured content, since clients read only one of them."""
    from mcp_types import CallToolResult, TextContent

    facts = error.to_dict()
    text = TextContent(type="text", text=_line(facts))
    return CallToolResult(content=[text], structured_content=facts, is_error=True)


def serve(name: str, transport: str = "stdio", host: str = "127.0.0.1", port: int = 8000) -> None:
    """Run one server until its client leaves."""
    gc.disable()  # what is loaded stays: looking for garbage in it takes a sixth of the start, and finds none
    server = build_server(name)
    gc.freeze()
    gc.enable()
    if transport == "http":
        server.run("streamable-http", host=host, port=port)
        return
    server.run("stdio")


def call(function: Callable[..., Any], arguments: dict[str, Any], progress: Progress = silent) -> Any:
    """Call a tool function as the command line does."""
    listener = progress_parameter(function)
    try:
        return function(**arguments, **({listener: progress} if listener else {}))
    except OSError as error:
        refused = arguments_of.too_long(function.__name__, error, arguments)
        if refused is None:
            raise
        raise refused from error


def exit_code(result: Any) -> int:
    """0 when the answer is yes; a result with `ok` false is 1, or the `exit_code` that it gives itself."""
    data = result.data if isinstance(result, Illustrated) else result
    return 0 if getattr(data, "ok", True) else int(getattr(data, "exit_code", 1))


def to_json(result: Any) -> str:
    """A result as JSON text."""
    data = result.data if isinstance(result, Illustrated) else result
    return data.model_dump_json(indent=2) if isinstance(data, BaseModel) else str(data)
