"""Write the laws of the author's own that a plan names: what is imported from their files, made, and handed to `program.main`.

A law's file is read, never run. The draft hands over the object that stands at its top level (`balloon = Balloon(...)`), else makes
one of its class; what that takes comes from the plan's constants of the same names, and what no constant is called is left open.
"""

import ast
import re
from contextlib import suppress
from dataclasses import dataclass

from ..model import syntax
from ..model.plan.committed import Plan, SceneObject
from ..model.plan.declared_inputs import Intervention
from .python_text import Raw, call, comment, constant_name
from .requirements import Needs

SKIN = ("shape", "wall", "gas")
"""What `worldkit.skins.Skin` itself takes."""
PLAIN = {"object", "Law", "Protocol", "ABC"}
"""Bases that take nothing."""


@dataclass(frozen=True)
class Found:
    """What a law's file holds."""

    kind: str
    """The class."""
    made: str
    """An object of it at the top level; empty where there is none."""
    takes: tuple[str, ...]
    """What the class must be given."""
    skin: bool
    """It knows its own surface before it starts: `points` and `triangles`, as `worldkit.skins.Skin`, and `Moulded` and `Stirred` of `worldkit.matter` do."""
    grains: bool
    """It is a `worldkit.matter.Matter`, which knows its points, and how large each is drawn."""
    unknown: str = ""
    """A base whose arguments stand elsewhere."""


class Laws:
    """The laws of a plan, each with the name that stands for it in the program; none of a draft that stands alone."""

    def __init__(self, plan: Plan, needs: Needs, alone: bool) -> None:
        self._plan, self._needs = plan, needs
        acting = () if alone else plan.simulation_parameters.interventions
        rows = [row for row in acting if row.solver and row.solver.file]
        self._rows = [(row, _found(plan, row)) for row in rows]
        self._shows = {row.solver.shown_by: (row, found) for row, found in self._rows if row.solver}

    def moves(self, row: SceneObject) -> bool:
        """Whether a law moves what this object only shows; the parts of a compound may be the geoms that it moves."""
        return row.name in self._shows and row.primitive != "compound"

    def imports(self) -> str:
        """One line for each file."""
        lines = []
        for row, found in self._rows:
            if found is not None:
                lines.append(f"from {_module(row)} import {found.made or found.kind}")
        return "".join(f"{line}\n" for line in sorted(lines))

    def made(self) -> str:
        """The laws as constants of the program, with what is not known of them."""
        parts = []
        for row, found in self._rows:
            if found is None:
                parts.append(self._leave(row, "hand it over", f"write it, and give it in `laws=` below ({_file(row)})"))
            elif not found.made:
                known = {name: constant for name in found.takes if (constant := self._constant(row, name))}
                if unknown := [name for name in found.takes if name not in known]:
                    what = f"give {found.kind} its {', '.join(unknown)}: no constant that the row names is called so"
                    parts.append(self._leave(row, "make it", what))
                elif found.unknown:
                    parts.append(self._leave(row, "make it", f"give {found.kind} what {found.unknown} takes"))
                given = {name: Raw(constant_name(constant)) for name, constant in known.items()}
                parts.append(call(f"{_name(row)} = {found.kind}", indent=0, **given))
        return "".join(f"{part}\n" for part in parts)

    def surface(self, row: SceneObject) -> str:
        """The text of what a law moves, in place of a body."""
        by, found = self._shows[row.name]
        lines = [comment(note)] if (note := row.description or row.role) else []
        if found is not None and (found.skin or found.grains):
            self._needs.use("moved_shapes")
            law = found.made or _name(by)
            look: dict = {"look": row.look} if row.look else {}
            shape = (Raw(f"{law}.points"), Raw(f"{law}.{'triangles' if found.skin else 'radius'}"))
            shown = f"moved_shapes.{'surface' if found.skin else 'grains'}"
            return "\n".join([*lines, call(shown, Raw("spec"), row.name, *shape, **look)])
        its_look = f", look={row.look!r}" if row.look else ""
        what = (
            f"add what it moves, as it lies at the start: `moved_shapes.surface(spec, {row.name!r}, points, triangles{its_look})`, "
            f"or `moved_shapes.grains(spec, {row.name!r}, points, radius{its_look})`"
        )
        return "\n".join([*lines, self._leave(by, f"draw {row.name}", what, 4)])

    def handed(self) -> Raw | None:
        """What stands in `laws=`; None without a law whose file was found."""
        names = [found.made or _name(row) for row, found in self._rows if found is not None]
        return Raw(f"[{', '.join(names)}]") if names else None

    def _leave(self, row: Intervention, why: str, what: str, indent: int = 0) -> str:
        assert row.solver is not None
        self._needs.leave(f"the law {row.solver.name}: {why}", what)
        return comment(f"AUTHOR: the law {row.solver.name}: {what}.", indent)

    def _constant(self, row: Intervention, name: str) -> str:
        """The plan's constant that an argument is: of its name, else the only one that ends in it of those the row names."""
        constants = self._plan.simulation_parameters.constants
        said = {one for one in re.findall(r"constants\.(\w+)", f"{row.law} {row.source}") if one in constants}
        ends = [one for one in sorted(said) if one.endswith(f"_{name}")]
        return name if name in constants else ends[0] if len(ends) == 1 else ""


def _found(plan: Plan, row: Intervention) -> Found | None:
    """The class in the file that a row names, or an object of it; None where the file is not there or holds none."""
    assert row.solver is not None
    if plan.folder is None:
        return None
    body: list[ast.stmt] = []
    with suppress(OSError, ValueError, SyntaxError, RecursionError):
        body = syntax.module((plan.folder / row.solver.file).read_bytes()).body
    classes = [node for node in body if isinstance(node, ast.ClassDef)]
    called = [node for node in classes if row.solver.name in _names(node)] or [
        node for node in classes if any(isinstance(one, ast.FunctionDef) and one.name == "step" for one in node.body)
    ]
    if len(called) != 1:
        return None
    kind = called[0]
    bases = [ast.unparse(base).rpartition(".")[2] for base in kind.bases]
    takes, unknown = _takes(kind), next((base for base in bases if base not in {*PLAIN, "Skin"}), "")
    if takes is not None:
        unknown = ""
    elif "Skin" in bases:
        takes = SKIN
    made = [
        node.targets[0].id
        for node in body
        if isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name)
        and isinstance(node.value, ast.Call) and ast.unparse(node.value.func) == kind.name
    ]  # fmt: skip
    skin = not {"Skin", "Moulded", "Stirred"}.isdisjoint(bases) or any(
        ast.unparse(target) == "self.triangles" for target in _assigned(kind)
    )
    made_one = made[0] if len(made) == 1 else ""
    return Found(kind.name, made_one, takes or (), skin, "Matter" in bases, unknown)


def _names(kind: ast.ClassDef) -> set[object]:
    """The literals that `name` is set to in a class."""
    found: set[object] = set()
    for node in ast.walk(kind):
        for target in node.targets if isinstance(node, ast.Assign) else ():
            assert isinstance(node, ast.Assign)
            many = isinstance(target, ast.Tuple) and isinstance(node.value, ast.Tuple)
            pairs = zip(target.elts, node.value.elts, strict=False) if many else [(target, node.value)]  # type: ignore[attr-defined]
            found |= {
                value.value
                for one, value in pairs
                if ast.unparse(one) in ("name", "self.name") and isinstance(value, ast.Constant)
            }
    return found


def _assigned(kind: ast.ClassDef) -> list[ast.expr]:
    """What a class assigns to, in all of its functions, tuples taken apart."""
    targets = [target for node in ast.walk(kind) if isinstance(node, ast.Assign) for target in node.targets]
    return [one for target in targets for one in (target.elts if isinstance(target, ast.Tuple) else [target])]


def _takes(kind: ast.ClassDef) -> tuple[str, ...] | None:
    """What a class must be given; None where it does not say so itself."""
    for node in kind.body:
        if isinstance(node, ast.FunctionDef) and node.name == "__init__":
            positional = [*node.args.posonlyargs, *node.args.args][1:]
            free = positional[: len(positional) - len(node.args.defaults)]
            named = [
                one for one, given in zip(node.args.kwonlyargs, node.args.kw_defaults, strict=True) if given is None
            ]
            return tuple(one.arg for one in (*free, *named))
    if any("dataclass" in ast.unparse(one) for one in kind.decorator_list):
        return tuple(ast.unparse(n.target) for n in kind.body if isinstance(n, ast.AnnAssign) and n.value is None)
    return None


def _file(row: Intervention) -> str:
    assert row.solver is not None
    return row.solver.file


def _module(row: Intervention) -> str:
    return _file(row).removesuffix(".py").replace("/", ".")


def _name(row: Intervention) -> str:
    assert row.solver is not None
    return f"{constant_name(row.solver.name)}_LAW"
