"""The view of a program rule: the tree, resolved names, folded values, inferred classes, MJCF and the plan."""

import ast
import re
from collections.abc import Iterator
from contextlib import suppress
from functools import cached_property
from pathlib import Path
from typing import Any

from ..model import companions
from ..model.companions import CompanionError
from ..model.plan.committed import Plan
from ..simulator import symbols as installed_symbols
from ..simulator.symbols import Symbols
from . import mjcf_text
from .folding import UNKNOWN, Folder
from .inference import Inference
from .problem import Edit
from .scopes import Scopes
from .source import Source

__all__ = ["UNKNOWN", "Program"]

MOST_BESIDE = 1 << 20
"""Bytes of a file beside a program in which names are looked for."""
Caller = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda


class Program:
    """One parsed program (or bare MJCF file), with everything the rules share, computed when first asked for."""

    def __init__(self, source: Source, plan: Plan | None = None, contract: bool | None = None) -> None:
        self.source = source
        self.path = source.path
        self.lines = source.lines
        self.tree = source.tree or ast.Module([], [])
        self.plan = plan
        self._contract = contract

    @property
    def films(self) -> bool:
        """Whether it is the film of a world, not the program that makes one."""
        return Path(self.path).name == "film.py"

    @cached_property
    def contract(self) -> bool:
        """Whether the program is one of ours: it imports worldkit, or it was written for a plan."""
        if self._contract is not None:
            return self._contract
        return self.plan is not None or any(
            full.split(".")[0] == "worldkit" for table in self.scopes.imports.values() for full in table.values()
        )

    @cached_property
    def scopes(self) -> Scopes:
        """Name resolution."""
        return Scopes(self.tree)

    @cached_property
    def symbols(self) -> Symbols:
        """The installed simulator's names."""
        return installed_symbols.load()

    @cached_property
    def inference(self) -> Inference:
        """Class inference."""
        return Inference(self.scopes, self.symbols, self.control)

    @cached_property
    def folder(self) -> Folder:
        """Constant folding: a name counts when its scope binds it exactly once."""

        def binding(node: ast.Name) -> ast.expr | None:
            bound = self.scopes.bound(node)
            return bound[0] if len(bound) == 1 else None

        return Folder(binding, self.scopes.dotted)

    def nodes(self, *types: type[ast.AST]) -> Iterator[Any]:
        """Every node of the given types, in source order within a type."""
        for kind in types:
            yield from self.scopes.nodes.get(kind, ())

    def parent(self, node: ast.AST) -> ast.AST | None:
        """The node that contains this one."""
        return self.scopes.parents.get(node)

    def ancestors(self, node: ast.AST) -> Iterator[ast.AST]:
        """The nodes around this one, innermost first."""
        current = self.scopes.parents.get(node)
        while current is not None:
            yield current
            current = self.scopes.parents.get(current)

    def dotted(self, node: ast.AST | None) -> str | None:
        """The full path of a name that leads to an import."""
        return self.scopes.dotted(node)

    def value(self, node: ast.AST | None) -> Any:
        """The value of an expression, or UNKNOWN."""
        return self.folder.value(node)

    def type_of(self, node: ast.AST | None) -> str | None:
        """The simulator class an expression is an instance of."""
        return self.inference.type_of(node)

    @cached_property
    def calls_by_name(self) -> dict[str, list[ast.Call]]:
        """Calls of imported functions by full path."""
        found: dict[str, list[ast.Call]] = {}
        for call in self.nodes(ast.Call):
            full = self.dotted(call.func)
            if full is not None:
                found.setdefault(full, []).append(call)
        return found

    def calls(self, *names: str) -> Iterator[tuple[str, ast.Call]]:
        """Calls of the named functions; a name ending in `.` matches everything inside it."""
        for full, calls in self.calls_by_name.items():
            if any(full == name or (name.endswith(".") and full.startswith(name)) for name in names):
                for call in calls:
                    yield full, call

    def method_calls(self, *names: str) -> Iterator[ast.Call]:
        """Calls of methods by bare name on anything that is not an imported module."""
        for call in self.nodes(ast.Call):
            if isinstance(call.func, ast.Attribute) and call.func.attr in names and self.dotted(call.func) is None:
                yield call

    def argument(self, call: ast.Call, name: str, position: int | None = None) -> ast.expr | None:
        """An argument by keyword, or by position when it is passed that way."""
        for keyword in call.keywords:
            if keyword.arg == name:
                return keyword.value
        if position is not None and position < len(call.args):
            before = call.args[: position + 1]
            if not any(isinstance(argument, ast.Starred) for argument in before):
                return call.args[position]
        return None

    def stores(self) -> Iterator[tuple[ast.expr, ast.expr | None, ast.stmt]]:
        """Every assignment as (target, value, statement); an augmented one has value None; tuples are taken apart."""
        for node in self.nodes(ast.Assign):
            for target in node.targets:
                for one in target.elts if isinstance(target, ast.Tuple | ast.List) else [target]:
                    yield one, node.value if one is target else None, node
        for node in self.nodes(ast.AugAssign):
            yield node.target, None, node
        for node in self.nodes(ast.AnnAssign):
            if node.value is not None:
                yield node.target, node.value, node

    @cached_property
    def entry(self) -> ast.Call | None:
        """The call of `worldkit.program.main`."""
        return next((call for _, call in self.calls("worldkit.program.main")), None)

    @cached_property
    def control(self) -> Caller | None:
        """The function handed to `program.main` as `control`."""
        return self._passed("control", 1)

    @cached_property
    def build(self) -> Caller | None:
        """The function handed to `program.main` as `build`, else the module's own `build`."""
        return self._passed("build", 0) or self.scopes.functions.get("build")

    @property
    def built_elsewhere(self) -> bool:
        """Whether the world is built by a function that comes from a module of its own."""
        given = self.argument(self.entry, "build", 0) if self.entry is not None else None
        return self.dotted(given) is not None

    @cached_property
    def words_beside(self) -> frozenset[str]:
        """Words of the files beside it that belong to it: what they build and hold is named there."""
        path = Path(self.path).absolute()
        with suppress(OSError, CompanionError):
            texts = companions.of(path).values() if path.is_file() else ()
            return frozenset(w.decode() for text in texts for w in re.findall(rb"[A-Za-z_][\w-]*", text[:MOST_BESIDE]))
        return frozenset()

    def beside(self, name: str) -> bool:
        """Whether files beside it name a thing, or the family that it is a numbered one of."""
        stem = re.sub(r"\d+$", "", name)
        return name in self.words_beside or (stem != name and stem in self.words_beside)

    def _passed(self, name: str, position: int) -> Caller | None:
        node = self.argument(self.entry, name, position) if self.entry is not None else None
        if isinstance(node, ast.Lambda):
            return node
        if isinstance(node, ast.Name):
            named = [f for f in self.nodes(ast.FunctionDef) if f.name == node.id]
            return self.scopes.functions.get(node.id) or (named[0] if len(named) == 1 else None)
        return None

    @cached_property
    def running(self) -> set[ast.AST]:
        """The functions that run every step: `control`, simulator callbacks, and what they call in this module."""
        found: set[ast.AST] = set()
        waiting: list[ast.AST] = [self.control] if self.control is not None else []
        for full, call in self.calls("mujoco."):
            if full.startswith("mujoco.set_mjcb_") and call.args and isinstance(call.args[0], ast.Name):
                waiting += filter(None, [self.scopes.functions.get(call.args[0].id)])
        while waiting:
            function = waiting.pop()
            if function in found:
                continue
            found.add(function)
            for node in ast.walk(function):
                if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                    called = self.scopes.functions.get(node.func.id)
                    if called is not None:
                        waiting.append(called)
        return found

    def runs_every_step(self, node: ast.AST) -> bool:
        """Whether a node is in a function that runs every step."""
        return any(function in self.running for function in self.scopes.chain(node) if function is not None)

    def is_guarded(self, node: ast.AST) -> bool:
        """Whether the program itself asks if a name exists before using it (`hasattr`, `try … except AttributeError`)."""
        for around in self.ancestors(node):
            if isinstance(around, ast.Try) and any(_catches_missing(handler) for handler in around.handlers):
                return True
            if isinstance(around, ast.If | ast.IfExp):
                asked = {
                    n.func.id for n in ast.walk(around.test) if isinstance(n, ast.Call) and isinstance(n.func, ast.Name)
                }
                if asked & {"hasattr", "getattr"}:
                    return True
        return False

    @cached_property
    def documents(self) -> list[mjcf_text.Document]:
        """The MJCF documents in the program's strings, or the file itself."""
        if self.source.is_mjcf:
            return [mjcf_text.parse(self.source.text)] if self.source.text else []
        texts = [n for n in self.nodes(ast.Constant, ast.JoinedStr) if not isinstance(self.parent(n), ast.JoinedStr)]
        return mjcf_text.documents(texts, self.lines, self._changed_texts)

    @cached_property
    def _changed_texts(self) -> set[ast.AST]:
        """String expressions, under any name, that the program fills in, changes in part or joins with others."""
        changed: set[ast.AST] = set()
        for node in self.nodes(ast.Attribute, ast.BinOp):
            parts = [node.value] if isinstance(node, ast.Attribute) else [node.left, node.right]
            if isinstance(node, ast.Attribute) and node.attr not in ("replace", "format", "format_map", "join"):
                continue
            for part in parts:
                changed.add(part)
                if isinstance(part, ast.Name):
                    changed |= {bound for bound in self.scopes.bound(part) if bound is not None}
        return changed

    def tags(self) -> Iterator[mjcf_text.Tag]:
        """Every MJCF element of every document."""
        stack = [document.root for document in self.documents if document.root is not None]
        while stack:
            tag = stack.pop()
            yield tag
            stack += reversed(tag.children)

    def edit(self, node: ast.AST, text: str) -> Edit:
        """An edit that writes `text` in a node's place."""
        first, last = getattr(node, "lineno", 1), getattr(node, "end_lineno", 1)
        return Edit(
            first,
            self._characters(first, getattr(node, "col_offset", 0)) + 1,
            last,
            self._characters(last, getattr(node, "end_col_offset", 0)) + 1,
            text,
        )

    def insertion_after(self, node: ast.AST, text: str) -> Edit:
        """An edit that writes `text` behind a node."""
        whole = self.edit(node, text)
        return Edit(whole.end_line, whole.end_column, whole.end_line, whole.end_column, text)

    def word_edit(self, line: int, old: str, new: str) -> Edit | None:
        """An edit of one word of a line; None unless it stands there exactly once."""
        text = self.lines[line - 1] if 0 < line <= len(self.lines) else ""
        found = list(re.finditer(rf"(?<![\w.-]){re.escape(old)}(?![\w.-])", text))
        if len(found) != 1:
            return None
        return Edit(line, found[0].start() + 1, line, found[0].end() + 1, new)

    def literal(self, node: ast.AST | None) -> ast.Constant | None:
        """The number that an expression stands for, itself or by a name bound once; None if it is computed."""
        if isinstance(node, ast.Name):
            bound = self.scopes.bound(node)
            node = bound[0] if len(bound) == 1 else None
        return node if isinstance(node, ast.Constant) else None

    def _characters(self, line: int, offset: int) -> int:
        """The column in characters, as editors count, of an offset in bytes, as the syntax tree counts."""
        text = self.lines[line - 1] if 0 < line <= len(self.lines) else ""
        return offset if text.isascii() else len(text.encode()[:offset].decode(errors="replace"))

    @cached_property
    def whole_model(self) -> bool:
        """Whether the whole model stands in this source: no files, nothing computed, nothing generated."""
        loads = ("from_xml_path", "from_file", "from_binary_path", "from_zip", "attach", "attach_body", "attach_frame")
        if any(True for _ in self.method_calls(*loads)) or any(
            full.rsplit(".", 1)[-1] in loads for full in self.calls_by_name
        ):
            return False
        if any(full.startswith("worldkit.") for full in self.calls_by_name):
            return False
        generated = {"include", "attach", "replicate", "flexcomp", "composite"}
        return not any(document.computed for document in self.documents) and not any(
            tag.name in generated for tag in self.tags()
        )

    @cached_property
    def strings(self) -> set[str]:
        """Every string constant of the program, and every name in its MJCF."""
        found = {n.value for n in self.nodes(ast.Constant) if isinstance(n.value, str) and len(n.value) < 200}
        for tag in self.tags():
            if "name" in tag.attributes:
                found.add(tag.attributes["name"])
        return found


def _catches_missing(handler: ast.ExceptHandler) -> bool:
    if handler.type is None:
        return True
    names = {n.id for n in ast.walk(handler.type) if isinstance(n, ast.Name)}
    return bool(names & {"AttributeError", "ImportError", "ModuleNotFoundError", "Exception", "TypeError"})
