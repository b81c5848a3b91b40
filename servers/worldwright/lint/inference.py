"""Infer which class of the simulator an expression is an instance of, where the source leaves no doubt."""

import ast
from functools import cached_property

from ..simulator.symbols import Symbols
from . import worldkit_api
from .scopes import Scopes


class Inference:
    """Infers `MjSpec`, `MjsBody`, `MjData` … for expressions; None means: not known."""

    def __init__(self, scopes: Scopes, symbols: Symbols, control: ast.AST | None = None) -> None:
        self.scopes = scopes
        self.symbols = symbols
        self.control = control
        self._cache: dict[ast.AST, str | None] = {}

    def type_of(self, node: ast.AST | None, depth: int = 0) -> str | None:
        """The class name, e.g. `MjsBody`."""
        if node is None or depth > 30:
            return None
        if node not in self._cache:
            self._cache[node] = None  # cuts `a = a.parent` loops
            self._cache[node] = self._infer(node, depth)
        return self._cache[node]

    def _infer(self, node: ast.AST, depth: int) -> str | None:
        if isinstance(node, ast.Name):
            return self._name(node, depth)
        if isinstance(node, ast.Attribute):
            owner = self.type_of(node.value, depth + 1)
            if owner is None:
                return self._of_self(node, depth)
            member = self.symbols.member(owner, node.attr)
            if member is not None and member["kind"] == "field":
                return self.symbols.class_name(member.get("returns"))
            return None
        if isinstance(node, ast.Call):
            return self._call(node, depth)
        if isinstance(node, ast.IfExp):
            one, other = self.type_of(node.body, depth + 1), self.type_of(node.orelse, depth + 1)
            return one if one == other else None
        return None

    def _of_self(self, node: ast.Attribute, depth: int) -> str | None:
        """`self.data`, when every assignment to it in the class agrees."""
        around = self._class_of_self(node.value)
        if around is None:
            return None
        bound = self._attributes.get((around, node.attr), [])
        found = {None if value is None else self.type_of(value, depth + 1) for value in bound}
        return found.pop() if len(found) == 1 else None

    def _class_of_self(self, node: ast.AST) -> ast.ClassDef | None:
        """The class whose instance a name is: the first parameter of one of its methods."""
        if not isinstance(node, ast.Name):
            return None
        method = self.scopes.scope_of(node)
        if not isinstance(method, ast.FunctionDef | ast.AsyncFunctionDef):
            return None
        around = self.scopes.parents.get(method)
        first = next(iter([*method.args.posonlyargs, *method.args.args]), None)
        if not isinstance(around, ast.ClassDef) or first is None or first.arg != node.id:
            return None
        return (
            None if any(isinstance(d, ast.Name) and d.id == "staticmethod" for d in method.decorator_list) else around
        )

    @cached_property
    def _attributes(self) -> dict[tuple[ast.ClassDef, str], list[ast.expr | None]]:
        """What the methods of each class assign to its attributes; None stands for something unknown."""
        found: dict[tuple[ast.ClassDef, str], list[ast.expr | None]] = {}
        for kind in (ast.Assign, ast.AnnAssign, ast.AugAssign):
            for statement in self.scopes.nodes.get(kind, []):
                targets = statement.targets if isinstance(statement, ast.Assign) else [statement.target]  # type: ignore[attr-defined]
                for target in targets:
                    for one in target.elts if isinstance(target, ast.Tuple | ast.List) else [target]:
                        if not isinstance(one, ast.Attribute) or (around := self._class_of_self(one.value)) is None:
                            continue
                        value = statement.value if one is target and kind is not ast.AugAssign else None  # type: ignore[attr-defined]
                        found.setdefault((around, one.attr), []).append(value)
        return found

    def _call(self, node: ast.Call, depth: int) -> str | None:
        full = self.scopes.dotted(node.func)
        if full is not None:
            return self._imported(full)
        if isinstance(node.func, ast.Attribute):
            owner = self.type_of(node.func.value, depth + 1)
            member = self.symbols.member(owner, node.func.attr) if owner else None
            if member is None or member["kind"] != "function":
                return None
            if (owner, node.func.attr) == ("MjSpec", "compile"):
                return "MjModel"  # declared as `object`; the manual says it returns the compiled MjModel
            return self.symbols.class_name(member.get("returns"))
        if isinstance(node.func, ast.Name):
            function = self.scopes.functions.get(node.func.id)
            if function is not None and self.scopes.scope_of(node.func) is None:
                return self._returned(function, depth)
        return None

    def _imported(self, full: str) -> str | None:
        package, _, rest = full.partition(".")
        parts = rest.split(".")
        if package == "worldkit" and len(parts) == 2:
            known = worldkit_api.callee(parts[0], parts[1])
            return self.annotation(known.returns) if known else None
        if package != "mujoco" or not rest:
            return None
        entry = self.symbols.top(parts[0])
        if entry is None:
            return None
        if len(parts) == 1:
            return parts[0] if entry["kind"] == "class" else self.symbols.class_name(entry.get("returns"))
        member = self.symbols.member(parts[0], parts[1]) if len(parts) == 2 else None
        return self.symbols.class_name(member.get("returns")) if member else None

    def _returned(self, function: ast.FunctionDef | ast.AsyncFunctionDef, depth: int) -> str | None:
        if function.returns is not None:
            return self.annotation(_text(function.returns))
        found = {
            self.type_of(n.value, depth + 1)
            for n in self.scopes.nodes.get(ast.Return, [])
            if isinstance(n, ast.Return) and self.scopes.owner[n] is function
        }
        return found.pop() if len(found) == 1 else None

    def _name(self, node: ast.Name, depth: int) -> str | None:
        scope = self.scopes.scope_of(node)
        if scope is False:
            return None
        if isinstance(scope, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            arguments = [*scope.args.posonlyargs, *scope.args.args, *scope.args.kwonlyargs]
            for position, parameter in enumerate(arguments):
                if parameter.arg == node.id and len(self.scopes.bound(node)) == 1:
                    if parameter.annotation is not None:
                        return self.annotation(_text(parameter.annotation))
                    if scope is self.control and position < 2:  # worldkit calls it with (model, data)
                        return ("MjModel", "MjData")[position]
                    return None
        bound = self.scopes.bound(node)
        found = {None if value is None else self.type_of(value, depth + 1) for value in bound}
        return found.pop() if len(found) == 1 else None

    def annotation(self, text: str) -> str | None:
        """The class an annotation names."""
        text = text.strip().strip("\"'")
        alias, _, name = text.rpartition(".")
        if alias and self.scopes.imports[None].get(alias, alias) != "mujoco":
            return None
        if not alias and self.scopes.imports[None].get(name) != f"mujoco.{name}":
            return None
        return self.symbols.class_name(name)


def _text(node: ast.expr) -> str:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
        return f"{node.value.id}.{node.attr}"
    return ""
