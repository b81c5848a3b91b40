"""Print as JSON what `import mujoco` offers; `symbols.py` runs this in a process of its own.

Signatures come from the bindings' own docstrings, whose first line is the C++ signature in Python's notation. Only the
standard library and mujoco are imported, so that the caller stays free of both.
"""

import ast
import json
import pkgutil
import re
import sys
import types
from pathlib import Path

SKIP = {"_pybind11_conduit_v1_", "__class__", "__doc__", "__module__", "__dict__", "__weakref__"}


def matching(text: str, start: int) -> int:
    """Index of the bracket that closes the one at `start`."""
    depth = 0
    for index in range(start, len(text)):
        if text[index] in "([{":
            depth += 1
        elif text[index] in ")]}":
            depth -= 1
            if depth == 0:
                return index
    return len(text) - 1


def split_arguments(text: str) -> list[str]:
    """Split at the commas that stand outside every bracket."""
    parts, depth, current = [], 0, ""
    for character in text:
        depth += (character in "([{") - (character in ")]}")
        if character == "," and depth == 0:
            parts.append(current)
            current = ""
        else:
            current += character
    return [part.strip() for part in [*parts, current] if part.strip()]


def short_type(text: str) -> str:
    """A type in short form: `Sequence[float]` in place of what the bindings print."""
    text = text.replace("::", ".")
    text = re.sub(r"typing\.SupportsInt \| typing\.SupportsIndex", "int", text)
    text = re.sub(r"typing\.SupportsFloat \| typing\.SupportsIndex", "float", text)
    text = re.sub(
        r'typing\.Annotated\[numpy\.typing\.NDArray\[numpy\.(\w+)\], "\[(.*?)\]"(?:, "[^"]*")*\]', r"\1[\2]", text
    )
    text = re.sub(r"numpy\.typing\.NDArray\[numpy\.(\w+)\]", r"\1[]", text)
    return re.sub(r"\b(?:collections\.abc|typing|mujoco\._\w+|mujoco\.python)\.", "", text)


def overloads(name: str, doc: str) -> list[dict]:
    """Every signature in a docstring: parameter names, whether it takes any keyword, the returned type, the text."""
    found = []
    for match in re.finditer(rf"^(?:\d+\. )?{re.escape(name)}\(", doc, re.MULTILINE):
        start = match.end() - 1
        end = matching(doc, start)
        arguments = split_arguments(doc[start + 1 : end])
        if arguments == ["*args", "**kwargs"]:
            continue
        returned = re.match(r"\s*->\s*(.+)", doc[end + 1 :])
        named = [re.split(r"[:=]", argument)[0].strip() for argument in arguments]
        shown = ", ".join(short_type(a) for a in arguments if a.split(":")[0].strip() != "self")
        result = short_type(returned.group(1).strip()) if returned else ""
        found.append(
            {
                "parameters": [n for n in named if n not in ("self", "/", "*") and not n.startswith("*")],
                "open": any(n.startswith("*") and n != "*" for n in named),
                "returns": result,
                "text": f"{name}({shown})" + (f" -> {result}" if result else ""),
            }
        )
    return found


def function(name: str, thing: object) -> dict:
    """Describe a function or method."""
    doc = getattr(thing, "__doc__", None) or ""
    found = overloads(name, doc)
    entry: dict = {"kind": "function"}
    if found:
        if not any(one["open"] for one in found):
            entry["parameters"] = sorted({parameter for one in found for parameter in one["parameters"]})
        entry["signature"] = "\n".join(one["text"] for one in found)
        results = {one["returns"] for one in found}
        if len(results) == 1:
            entry["returns"] = results.pop()
        doc = re.sub(rf"^(?:\d+\. )?{re.escape(name)}\(.*$", "", doc, flags=re.MULTILINE)
        doc = doc.replace("Overloaded function.", "")
    elif isinstance(thing, types.FunctionType):
        code = thing.__code__
        count = code.co_argcount + code.co_kwonlyargcount
        if not code.co_flags & 0x0C:  # neither *args nor **kwargs
            entry["parameters"] = [n for n in code.co_varnames[:count] if n != "self"]
        entry["signature"] = f"{name}({', '.join(code.co_varnames[:count])})"
    if doc.strip():
        entry["doc"] = " ".join(doc.split())
    return entry


def member(name: str, thing: object) -> dict:
    """Describe one attribute of a class."""
    if isinstance(thing, property):
        doc = (thing.fget.__doc__ if thing.fget else "") or ""
        returned = re.search(r"->\s*(.+)", doc)
        entry: dict = {"kind": "field", "returns": short_type(returned.group(1).strip()) if returned else ""}
        if thing.fset is None:
            entry["read_only"] = True
        return entry
    if callable(thing):
        return function(name, thing)
    return {"kind": "field", "returns": ""}


def describe_class(cls: type) -> dict:
    """Describe a class with every public member, or an enum with its values."""
    if "__members__" in dir(cls):
        values = {name: int(value) for name, value in getattr(cls, "__members__", {}).items()}
        return {"kind": "enum", "members": values}
    members = {}
    for name in dir(cls):
        if name in SKIP or (name.startswith("__") and name != "__init__"):
            continue
        raw = next((base.__dict__[name] for base in cls.__mro__ if name in base.__dict__), None)
        thing = raw if isinstance(raw, property) else getattr(cls, name)
        if name == "__init__" and "__init__" not in vars(cls):
            continue
        members[name] = member(name, thing)
    entry: dict = {"kind": "class", "members": members}
    if type(cls).__name__ != "pybind11_type":
        entry["open"] = True  # instances of a class written in Python may hold more than the class tells
    if words := (cls.__doc__ or "").split():
        entry["doc"] = " ".join(words)
    return entry


def value(name: str, thing: object) -> dict | None:
    """Describe one name of the package."""
    if isinstance(thing, types.ModuleType):
        return {"kind": "module"}
    if isinstance(thing, type):
        return describe_class(thing)
    if callable(thing):
        return function(name, thing)
    return {"kind": "constant", "doc": repr(thing)[:200]}


def add_struct_documentation(names: dict[str, dict]) -> None:
    """Give fields and functions the words of the C headers, which the package's `introspect` module carries."""
    from mujoco.introspect.structs import STRUCTS

    for struct, declared in STRUCTS.items():
        entry = names.get("Mj" + struct[2:], {})
        if entry.get("kind") != "class":
            continue
        if getattr(declared, "doc", ""):
            entry.setdefault("doc", declared.doc)
        for field in declared.fields:
            member_entry = entry["members"].get(str(getattr(field, "name", None)))
            words = str(getattr(field, "doc", None) or "")
            if member_entry is not None and words:
                shape: tuple | None = getattr(field, "array_extent", None)
                member_entry["doc"] = words + (f" ({' x '.join(map(str, shape))})" if shape else "")


def submodules(folder: Path) -> dict[str, list[str] | None]:
    """Names bound at the top of every pure Python submodule; None for one that cannot be read."""
    found: dict[str, list[str] | None] = {}
    for info in pkgutil.iter_modules([str(folder)]):
        if info.name.endswith("_test") or info.name.startswith("__"):
            continue
        path = folder / info.name / "__init__.py" if info.ispkg else folder / f"{info.name}.py"
        found[info.name] = top_names(path) if path.is_file() else None
        if info.ispkg and found[info.name] is not None:
            inside = [i.name for i in pkgutil.iter_modules([str(path.parent)])]
            found[info.name] = sorted({*found[info.name], *inside})  # type: ignore[misc]
    return found


def top_names(path: Path) -> list[str] | None:
    """What a module binds at its top level, or None when it hides that behind a star import or `__getattr__`."""
    return bound(ast.parse(path.read_text(encoding="utf-8")), path.name == "__init__.py")


def bound(tree: ast.Module, of_package: bool) -> list[str] | None:
    """`top_names` of a module that is parsed already."""
    names: set[str] = set()
    stack: list[ast.AST] = list(tree.body)
    called = {n.func.id for n in ast.walk(tree) if isinstance(n, ast.Call) and isinstance(n.func, ast.Name)}
    if called & {"globals", "setattr"} and of_package:
        return None  # it binds names while it is imported
    while stack:
        node = stack.pop()
        if isinstance(node, ast.FunctionDef | ast.ClassDef | ast.AsyncFunctionDef):
            if node.name == "__getattr__":
                return None
            names.add(node.name)
        elif isinstance(node, ast.Import | ast.ImportFrom):
            if any(alias.name == "*" for alias in node.names):
                return None
            names.update((alias.asname or alias.name).split(".")[0] for alias in node.names)
        elif isinstance(node, ast.Assign | ast.AnnAssign | ast.AugAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            names.update(n.id for target in targets for n in ast.walk(target) if isinstance(n, ast.Name))
        else:
            stack += [child for child in ast.iter_child_nodes(node) if isinstance(child, ast.stmt | ast.excepthandler)]
    return sorted(names)


def table() -> dict:
    """Describe the whole package."""
    import mujoco

    public = {name: getattr(mujoco, name) for name in dir(mujoco)}
    names = {}
    for name, thing in public.items():
        if name.startswith("__"):
            continue
        if (described := value(name, thing)) is not None:
            names[name] = described
    for module in (mujoco._structs, mujoco._specs):  # views such as `_MjDataBodyViews` are only reachable here
        for name in dir(module):
            if name not in names and isinstance(getattr(module, name), type):
                names[name] = {**describe_class(getattr(module, name)), "private": True}
    add_struct_documentation(names)
    folder = Path(mujoco.__file__).parent
    return {
        "version": mujoco.__version__,
        "names": names,
        "submodules": submodules(folder),
        "schema": mujoco.mj_printSchema(False, True),
    }


if __name__ == "__main__":
    json.dump(table(), sys.stdout)
