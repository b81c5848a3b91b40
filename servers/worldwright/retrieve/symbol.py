"""Looking up a name in the installed build: a Python symbol, a C struct's field, an MJCF element or attribute."""

import re
from collections.abc import Iterator
from difflib import get_close_matches
from typing import Any

from ..simulator import changelog, mjcf
from ..simulator.symbols import Symbols, load
from . import runtime_names
from .answers import Definition, SymbolAnswer
from .index import Index, Piece

MAX_DEFINITIONS = 6
MAX_MEMBERS = 120
MAX_WORDS = 1200


def look_up(index: Index, name: str) -> SymbolAnswer:
    """Everything that the name stands for; when it does not exist, the nearest names and what became of it by the changelog."""
    table = load()
    asked = name.strip()
    found = [*_mjcf(asked), *_python(table, asked)]
    found = [_with_manual(index, one) for one in found[:MAX_DEFINITIONS]]
    if not found:
        found = (list(_runtime(index, asked)) or list(_imported(index, asked)))[:MAX_DEFINITIONS]
    word = re.split(r"[./\s<>]+", asked.strip("<>/ \t"))[-1].split("=")[0]
    changes = [row for row in changelog.find(word) if row.weight(word) >= 2][:3]
    return SymbolAnswer(
        symbol=asked,
        version=table.version,
        exists=bool(found),
        definitions=tuple(found),
        nearest=() if found else tuple(_nearest(table, asked, word)),
        changes=tuple(changes),
    )


def _python(table: Symbols, asked: str) -> Iterator[Definition]:
    if not re.fullmatch(r"[\w.]+(\(.*\))?", asked):
        return
    path = re.sub(r"\(.*\)$", "", asked).split(".")
    while len(path) > 1 and path[0] in ("mujoco", "mj", "m"):
        path = path[1:]
    first = _class(table, path[0])
    if len(path) == 1:
        entry = table.top(first)
        if entry is not None:
            yield _definition(first, entry, table)
        if path[0] in table.enum_of_value:
            owner = table.enum_of_value[path[0]]
            value = table.names[owner]["members"][path[0]]
            yield Definition(kind="enum value", name=f"mujoco.{owner}.{path[0]}", signature=f"= {value}")
        for owner in table.owners.get(path[0], []):
            yield _definition(f"{owner}.{path[0]}", table.names[owner]["members"][path[0]], table)
        return
    if (entry := table.top(first)) is not None and entry["kind"] == "module":
        if table.in_submodule(first, path[1]):
            yield Definition(kind="name", name=f"mujoco.{first}.{path[1]}")
        return
    owner = first
    for part in path[1:-1]:  # e.g. MjSpec.worldbody.add_geom
        member = table.member(owner, part)
        owner = table.class_name(member.get("returns")) or "" if member else ""
    member = table.member(owner, path[-1]) if owner else None
    if member is not None:
        yield _definition(f"{owner}.{path[-1]}", member, table)


def _runtime(index: Index, asked: str) -> Iterator[Definition]:
    """Names of worldkit, which programs import beside the simulator: `worldkit.contacts.surface`, `joints.Slide`."""
    path = re.sub(r"\(.*\)$", "", asked).split(".")
    if len(path) == 1:  # a bare word is looked up in the simulator
        return
    path = path[1:] if path[0] == "worldkit" else path
    if not 1 <= len(path) <= 3 or not all(re.fullmatch(r"\w+", part) for part in path):
        return
    module, name = "/".join(path[:-1]), path[-1]
    for piece in index.labelled(name):
        inside = piece.path.removeprefix("worldkit/")
        if piece.part != "python" or inside == piece.path or piece.anchor.split(".")[-1] != name:
            continue
        if module and inside not in (f"{module}.py", f"{module}/__init__.py"):
            continue
        words = piece.text[:MAX_WORDS]
        steps = [*inside.removesuffix(".py").removesuffix("/__init__").split("/"), name]
        steps = steps[:-1] if steps[-2] == name else steps
        dotted = ".".join(("worldkit", *steps))
        kind = "module" if dotted.count(".") == len(inside.removesuffix("/__init__.py").split("/")) else "name"
        if "**common" in words.partition("\n")[0]:
            words += "\n" + _common(index, inside)
        yield Definition(kind=kind, name=dotted, documentation=words, citations=(piece.citation,))


def _imported(index: Index, asked: str) -> Iterator[Definition]:
    """The same by import: what packages hand on, and methods, as programs name them."""
    path = re.sub(r"\(.*\)$", "", asked).split(".")
    if len(path) == 1 or not all(re.fullmatch(r"\w+", part) for part in path):
        return
    one = runtime_names.find(path[1:] if path[0] == "worldkit" else path)
    if one is None:
        return
    pieces = [piece for piece in index.labelled(one.anchor) if piece.path == one.path]
    yield Definition(
        kind=one.kind,
        name=one.dotted,
        signature=one.signature,
        documentation=one.documentation[:MAX_WORDS],
        members=one.members[:MAX_MEMBERS],
        citations=tuple(piece.citation for piece in pieces[:1]),
    )


def _common(index: Index, inside: str) -> str:
    """What `**common` stands for: the paragraph of the module's docstring about it."""
    module = inside.removesuffix(".py").removesuffix("/__init__").rsplit("/", 1)[-1]
    for piece in index.labelled(module):
        if piece.path.endswith(inside) and piece.part == "python":
            found = re.search(r"^Common arguments:\n(?:[ \t]+.*\n?)+", piece.text, re.MULTILINE)
            if found:
                return found[0].rstrip()
    return ""


def _class(table: Symbols, name: str) -> str:
    """C names as Python spells them: `mjModel` -> `MjModel`."""
    return "M" + name[1:] if name.startswith("mj") and "M" + name[1:] in table.names else name


def _definition(name: str, entry: dict[str, Any], table: Symbols) -> Definition:
    kind = entry["kind"]
    signature = entry.get("signature", "")
    if kind == "field":
        signature = f"{name}: {entry.get('returns') or 'object'}" + (" (read-only)" if entry.get("read_only") else "")
    elif kind == "enum value":
        signature = f"= {entry['value']}"
    members: tuple[str, ...] = ()
    if kind in ("class", "enum"):
        members = tuple(m for m in entry["members"] if not m.startswith("_"))[:MAX_MEMBERS]
        init = entry["members"].get("__init__") if kind == "class" else None
        signature = init.get("signature", "").replace("__init__", name) if init else ""
    shown = name if name.split(".")[0] in table.submodules else f"mujoco.{name}"
    what = "method" if kind == "function" and "." in name else kind
    doc = entry.get("doc", "")
    return Definition(kind=what, name=shown, signature=signature, documentation=doc[:1500], members=members)


def _mjcf(asked: str) -> Iterator[Definition]:
    """`<geom surfacevel="…">`, `<geom>`, `geom/surfacevel`, `body/geom/friction`."""
    tag = re.match(r"^<\s*/?\s*(\w+)\s*([\w:]+)?", asked)
    path = re.fullmatch(r"(?:\w+/)*?(\w+)/(\w+)", asked)
    schema = mjcf.load()
    if tag:
        element, attribute = tag[1], tag[2] or ""
    elif path and path[1] in schema.by_tag:
        element, attribute = path[1], path[2]
        if any(attribute in place.children for place in schema.by_tag[element]):
            element, attribute = attribute, ""
    elif asked in schema.by_tag:
        element, attribute = asked, ""
    else:
        return
    places = schema.by_tag.get(element, [])
    if not places or (attribute and not any(attribute in place.attributes for place in places)):
        return
    if attribute:
        labels = mjcf.anchors().get((element, attribute), ())
        words = next((mjcf.keywords()[label] for label in labels if label in mjcf.keywords()), ())
        yield Definition(
            kind="attribute",
            name=f"<{element} {attribute}>",
            signature="one of " + ", ".join(words) if words else "",
        )
        return
    children = sorted({child for place in places for child in place.children})
    attributes = sorted({a for place in places for a in place.attributes})
    yield Definition(
        kind="element",
        name=f"<{element}>",
        signature="inside " + ", ".join(f"<{p}>" for p in schema.parents(element)) if schema.parents(element) else "",
        members=(*attributes, *(f"<{child}>" for child in children))[:MAX_MEMBERS],
    )


def _with_manual(index: Index, one: Definition) -> Definition:
    """Add where the manual describes it, and its words when the build itself has none."""
    pieces = _described(index, one)
    words = one.documentation or (pieces[0].text[:MAX_WORDS] if pieces and one.kind != "enum value" else "")
    return one.model_copy(update={"citations": tuple(p.citation for p in pieces), "documentation": words})


def _described(index: Index, one: Definition) -> list[Piece]:
    """The manual's entries about it."""
    labels: list[str] = []
    if one.kind in ("element", "attribute"):
        parts = one.name.strip("<>").split()
        key = (parts[0], parts[1] if len(parts) > 1 else "")
        known = mjcf.anchors().get(key) or mjcf.anchors().get((f"(world){parts[0]}", key[1])) or ()
        labels = sorted(known, key=lambda label: label.startswith("default-"))
        if not labels:
            labels = ["-".join(parts)]
    else:
        path = one.name.removeprefix("mujoco.").split(".")
        c_name = path[0].replace("Mj", "mj", 1) if path[0].startswith("Mj") else path[0]
        labels = [f"{path[0]}.{path[-1]}", path[-1], c_name] if len(path) > 1 else [path[0], c_name]
    for label in labels:
        # In other packages, a name like `joint` or `target` has nothing to do with the simulator's.
        of_python = one.kind not in ("element", "attribute")
        found = [
            piece
            for piece in index.labelled(label)
            if label in piece.anchor
            and piece.root.startswith("mujoco")
            and not (of_python and ("XMLreference" in piece.path or piece.path.startswith("rendering/")))
        ]
        if found:
            return found[:3]
    return []


def _nearest(table: Symbols, asked: str, word: str) -> list[str]:
    if asked.startswith("<"):
        schema = mjcf.load()
        tag = re.match(r"^<\s*/?\s*(\w+)", asked)
        places = schema.by_tag.get(tag[1], []) if tag else []
        attributes = sorted({a for place in places for a in place.attributes})
        if attributes and tag:
            return [f"<{tag[1]} {a}>" for a in get_close_matches(word, attributes, n=4, cutoff=0.5)]
        return [f"<{name}>" for name in schema.nearest_element(tag[1] if tag else word)]
    path = [part for part in asked.split(".") if part not in ("mujoco", "mj")]
    owner = _class(table, path[0]) if len(path) > 1 else None
    near = table.nearest(word, owner if owner in table.names else None)
    near = [f"{owner}.{n}" if owner in table.names else f"mujoco.{n}" for n in near]
    if not near or owner is None:
        members = get_close_matches(word, list(table.owners), n=3, cutoff=0.7)
        near += [f"{table.owners[m][0]}.{m}" for m in members]
        near += [f"<{name}>" for name in mjcf.load().nearest_element(word)]
        values = get_close_matches(word, list(table.enum_of_value), n=2, cutoff=0.7)
        near += [f"mujoco.{table.enum_of_value[v]}.{v}" for v in values]
    return near[:6]
