"""The engine's own description of its C interface (`mujoco.introspect`): one piece a function, struct or enum.

The files are generated Python literals; they are read with `ast`, so that a piece knows its lines.
"""

import ast
from collections.abc import Iterator

from .chunk import MAX_CHARACTERS, Chunk
from .rule_chunks import parse


def chunks(text: str, name: str) -> Iterator[Chunk]:
    """Cut `functions.py`, `structs.py` or `enums.py`."""
    tree = parse(text)
    if tree is None:
        return
    for node in _tuples(tree):
        if isinstance(node, ast.Tuple) and len(node.elts) == 2 and isinstance(node.elts[1], ast.Call):
            key, call = node.elts
            kind = _called(call)
            if isinstance(key, ast.Constant) and kind in _SAY:
                name_of = str(key.value)
                shown = _SAY[kind](name_of, _fields(call))
                last = node.end_lineno or node.lineno
                yield Chunk(name_of, f"introspect {name} > {name_of}", node.lineno, last, shown[:MAX_CHARACTERS])


def _tuples(tree: ast.Module) -> Iterator[ast.expr]:
    """The entries of the module's tables, `dict([(name, declaration), …])`."""
    for statement in tree.body:
        table = getattr(statement, "value", None)
        if isinstance(table, ast.Call) and table.args and isinstance(table.args[0], ast.List):
            yield from table.args[0].elts


def _called(node: ast.expr) -> str:
    return node.func.id if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) else ""


def _fields(node: ast.expr) -> dict[str, ast.expr]:
    return {k.arg or "": k.value for k in node.keywords} if isinstance(node, ast.Call) else {}


def _text(node: ast.expr | None) -> str:
    return str(node.value) if isinstance(node, ast.Constant) else ""


def _type(node: ast.expr | None) -> str:
    """A C type as C spells it."""
    kind, parts = (_called(node), _fields(node)) if node is not None else ("", {})
    if kind == "ValueType":
        const = "const " if "is_const" in parts else ""
        return const + _text(parts.get("name"))
    if kind == "PointerType":
        return _type(parts.get("inner_type")) + "*"
    if kind == "ArrayType":
        extents = parts.get("extents")
        sizes = [_text(e) for e in extents.elts] if isinstance(extents, ast.Tuple) else []
        return _type(parts.get("inner_type")) + "".join(f"[{size}]" for size in sizes)
    return "struct"


def _function(name: str, parts: dict[str, ast.expr]) -> str:
    listed = parts.get("parameters")
    given = [_fields(p) for p in listed.elts] if isinstance(listed, ast.Tuple) else []
    arguments = ", ".join(f"{_type(p.get('type'))} {_text(p.get('name'))}" for p in given)
    return f"{_type(parts.get('return_type'))} {name}({arguments})\n{_text(parts.get('doc'))}"


def _struct(name: str, parts: dict[str, ast.expr]) -> str:
    listed = parts.get("fields")
    rows = [_fields(f) for f in listed.elts] if isinstance(listed, ast.Tuple) else []
    body = (f"{_text(r.get('name'))}: {_type(r.get('type'))}  {_text(r.get('doc'))}".rstrip() for r in rows)
    return f"struct {name}\n" + "\n".join(body)


def _enum(name: str, parts: dict[str, ast.expr]) -> str:
    values = parts.get("values")
    pairs = values.args[0].elts if isinstance(values, ast.Call) and isinstance(values.args[0], ast.List) else []
    rows = [f"{_text(p.elts[0])} = {_text(p.elts[1])}" for p in pairs if isinstance(p, ast.Tuple)]
    return f"enum {name}\n" + "\n".join(rows)


_SAY = {"FunctionDecl": _function, "StructDecl": _struct, "EnumDecl": _enum}
