"""Names in a plan: unique, safe to use as file and model names, and never dangling.

It works on the plain data of the sections, so that dangling names are reported together with all other problems.
"""

import re
from collections.abc import Collection, Iterator, Mapping
from difflib import get_close_matches
from typing import Any

from .plan_problems import Path, Problem, dotted

BASE = "base"
"""The ground at the world's origin, as a reference object of predicates."""
WORLD = "world"
GROUND = "ground"
"""The ground plane's geom, and the material of the ground."""
_RESERVED = (BASE, WORLD, GROUND)
_ACTED_ON = "acted on"
_WORDS = {"reference": "object", "mover": "object", "parent": "object", "side": "object", "object or row": "object"} | {
    _ACTED_ON: "object, joint, tendon or actuator"
}
WITH_PARTS = ("mjcf", "urdf", "sculpt", "vehicle", "plant")
"""Types of assets whose parts have names of their own, behind the asset's and `_`."""
_SAFE = re.compile(r"[A-Za-z_][A-Za-z0-9_-]{0,62}")


def reference_problems(data: dict[str, Any], unread: Collection[str] = ()) -> list[Problem]:
    """Duplicate, unsafe and dangling names.

    Args:
        data: the sections that could be read, by name, as plain data.
        unread: sections that are missing or cannot be read; names that they may declare are not called unknown.
    """
    return [*_declared(data), *_twice(data, unread), *_dangling(data, unread)]


def _twice(data: dict[str, Any], unread: Collection[str]) -> Iterator[Problem]:
    """Rows that let a thing overlap itself; of one with copies they speak of any two."""
    if "scene_objects" in unread:  # nobody knows which have copies
        return
    copied = [row.get("name") for row, _ in _rows(data, "scene_objects") if row.get("count") not in (None, 1)]
    for row, path in _rows(data, "topology", "overlaps"):
        names = [name for name, _ in _list(row, path, "between")]
        if len(names) == 2 and names[0] == names[1] and names[0] not in copied:
            said, remedy = f"`{names[0]}` is named twice", "name the two different objects that overlap"
            yield Problem("WP012", "duplicate_name", (*path, "between"), said, remedy)


def _declared(data: dict[str, Any]) -> Iterator[Problem]:
    """Problems of the names where they are given."""
    first: dict[str, Path] = {}
    for name, path in (*_objects(data), *_instances(data)):
        if name in _RESERVED:
            yield Problem(
                "WP014",
                "unsafe_name",
                path,
                f"`{name}` is the name of the ground itself",
                "give the object another name",
            )
        if name in first:
            yield Problem(
                "WP012",
                "duplicate_name",
                path,
                f"there is already an object `{name}` ({dotted(first[name])})",
                "give each object a name of its own; an asset with count N is named name_1 … name_N",
            )
        first.setdefault(name, path)
    seen: dict[str, Path] = {}
    for name, path in _named(data, "topology", "joints"):
        if name in seen or name in first:
            other = dotted(seen.get(name) or first[name])
            yield Problem(
                "WP012", "duplicate_name", path, f"`{name}` is already the name of {other}", "rename the joint"
            )
        seen.setdefault(name, path)
    for kind in ("tendons", "actuators"):
        for name, path in _named(data, "topology", kind):
            if name in seen or name in first:
                other = dotted(seen.get(name) or first[name])
                yield Problem("WP012", "duplicate_name", path, f"`{name}` is already the name of {other}", "rename it")
            seen.setdefault(name, path)
    cameras: dict[str, Any] = {}
    for name, path, row in _cameras(data):
        if name in cameras and cameras[name] != row:
            yield Problem(
                "WP012",
                "duplicate_name",
                path,
                f"camera `{name}` is described differently in an earlier step",
                "give it another name, or repeat it unchanged",
            )
        cameras.setdefault(name, row)
    materials = [
        (key, ("simulation_parameters", "materials", key)) for key in _at(data, "simulation_parameters", "materials")
    ]
    for name, path in (
        *_objects(data),
        *_named(data, "assets"),
        *_named(data, "topology", "joints"),
        *_named(data, "topology", "tendons"),
        *_named(data, "topology", "actuators"),
        *((name, path) for name, path, _ in _cameras(data)),
        *_part_names(data),
        *materials,
    ):
        if not _SAFE.fullmatch(name):
            yield Problem(
                "WP014",
                "unsafe_name",
                path,
                f"`{name}` cannot be used as a name: it becomes a body, a variable or a file",
                "use letters, digits, _ and -, starting with a letter, at most 63",
            )


def _dangling(data: dict[str, Any], unread: Collection[str]) -> Iterator[Problem]:
    """Problems of the names where they are used."""
    objects = [name for name, _ in (*_objects(data), *_instances(data))]
    whole = [*objects, *_families(data), *_families(data, "assets")]
    rows = [name for name, _ in _named(data, "assets")]
    joints = [name for name, _ in _named(data, "topology", "joints")]
    moved = [name for kind in ("joints", "tendons", "actuators") for name, _ in _named(data, "topology", kind)]
    cameras = [name for name, _, _ in _cameras(data)]
    constants = list(_at(data, "simulation_parameters", "constants"))
    materials = list(_at(data, "simulation_parameters", "materials"))
    scene = [*(name for name, _ in _objects(data)), *_families(data)]
    kinds: dict[str, tuple[list[str], str]] = {
        "object": (whole, "scene_objects or assets"),
        "mover": (whole, "scene_objects or assets"),
        "scene object": (scene, "scene_objects"),
        "asset": ([*rows, *(n for n in objects if n not in scene)], "assets"),
        "asset row": (rows, "assets"),
        "road": ([str(row.get("name")) for row, _ in _rows(data, "assets") if row.get("type") == "road"], "assets"),
        "material": (materials, "simulation_parameters.materials"),
        "object or row": ([*whole, *rows], "scene_objects or assets"),
        "object or joint": ([*whole, *joints], "scene_objects, assets or topology.joints"),
        _ACTED_ON: ([*whole, *moved], "scene_objects, assets or topology"),
        "joint": (joints, "topology.joints"),
        "constant": (constants, "simulation_parameters.constants"),
        "body or camera": ([*objects, *cameras], "scene_objects, assets or the cameras of implementation_steps"),
        "reference": ([*objects, BASE], "scene_objects or assets"),
        "parent": ([*whole, WORLD], "scene_objects or assets"),
        "side": ([*objects, *cameras, BASE, WORLD, GROUND], "scene_objects or assets"),
    }
    inner = tuple(
        f"{name}_"
        for row, _ in _rows(data, "assets")
        if row.get("type") in WITH_PARTS and isinstance(name := row.get("name"), str)
    )
    sets = {kind: frozenset(known) for kind, (known, _) in kinds.items()}
    for kind, name, path in _uses(data):
        known, owner = kinds[kind]
        if isinstance(name, str) and name not in sets[kind] and not any(section in owner for section in unread):
            if kind in ("joint", "object or joint", "mover") and name.startswith(inner):
                continue  # of a model that the plan brings in: the linter opens its file
            # An actuator, a weld or a tendon is named by the program alone; what is all but a name of the plan is a slip.
            near = get_close_matches(name, known, n=1, cutoff=0.88 if kind == _ACTED_ON else 0.6)
            if kind == _ACTED_ON and not near:
                continue
            word = _WORDS.get(kind, kind)
            yield Problem(
                "WP013",
                "unknown_reference",
                path,
                f"`{dotted(path)}` names the {word} `{name}`, which the plan does not have",
                _other_list(kind, name, sets)
                or (f"did you mean `{near[0]}`? " if near else f"add it under {owner}, or name one of the known: ")
                + ("known: " if near else "")
                + _shortened(list(dict.fromkeys(known))),
            )


def _other_list(kind: str, name: str, sets: Mapping[str, Collection[str]]) -> str:
    """What to do with a name of a step that stands in the wrong one of its two lists; empty for any other."""
    lists = {"scene object": ("asset", "assets"), "asset": ("scene object", "scene_objects")}
    other, key = lists.get(kind, ("", ""))
    if name not in sets.get(other, ()):
        return ""
    return f"`{name}` is one of the plan's {key}: name it in this step's `{key}: [{name}]`, and not here"


def _shortened(names: list[str]) -> str:
    """The first dozens of a list of names."""
    rest = len(names) - 40
    return (", ".join(names[:40]) or "(none)") + (f" … and {rest} more" if rest > 0 else "")


def _uses(data: dict[str, Any]) -> Iterator[tuple[str, Any, Path]]:
    """Every use of a name: its kind, the name, and where."""
    parameters = "simulation_parameters"
    for key in _at(data, parameters, "masses"):
        yield "object or row", key, (parameters, "masses", key)
    for key in _at(data, parameters, "initial_motion"):
        yield "object or joint", key, (parameters, "initial_motion", key)
    for row, path in _rows(data, parameters, "pairs"):
        for name, place in _list(row, path, "between"):
            if name != GROUND:
                yield "object", name, place
    for row, path in _rows(data, parameters, "interventions"):
        yield from _each(_ACTED_ON, row, path, "bodies")
    for row, path in _rows(data, "implementation_steps"):
        yield from _each("asset", row, path, "assets")
        yield from _each("scene object", row, path, "scene_objects")
        yield from _each("mover", row, path, "motion_expectations")
        for camera, place in _list(row, path, "cameras"):
            if isinstance(camera, dict):
                yield from _each("object", camera, place, "subjects")
    for section in ("scene_objects", "assets"):
        for row, path in _rows(data, section):
            yield from _one("material", row, path, "material")
            for part, place in _parts(row, path):
                yield from _one("material", part, place, "material")
            follows = _dict(_dict(row.get("vehicle")).get("follows"))
            if follows.get("road"):
                yield "road", follows["road"], (*path, "vehicle", "follows", "road")
            for key in ("thing", "places_on"):
                if isinstance(picks := row.get("picks"), dict):
                    yield from _one("object", picks, (*path, "picks"), key)
            if plays := _dict(_dict(row.get("walks")).get("plays")):
                yield from _one("object", plays, (*path, "walks", "plays"), "ball")
    for key in _dict(data.get("asset_dimensions")):
        yield "asset row", key, ("asset_dimensions", key)
    for key in _at(data, "topology", "body_positions"):
        yield "object", key, ("topology", "body_positions", key)
    for row, path in _rows(data, "topology", "joints"):
        yield from _one("parent", row, path, "parent")
        yield from _one("object", row, path, "child")
    for row, path in _rows(data, "topology", "tendons"):
        for end, place in _list(row, path, "ends"):
            if isinstance(end, dict):
                yield from _one("parent", end, place, "body")
    for row, path in _rows(data, "topology", "overlaps"):
        yield from _each("object", row, path, "between")
    for row, path in _rows(data, "topology", "actuators"):
        yield from _one("joint", row, path, "joint")
        if isinstance(row.get("control"), str):
            yield "constant", row["control"], (*path, "control")
    for row, path in _rows(data, "topology", "scene_predicates"):
        yield from _one("object", row, path, "subject")
        yield from _one("reference", row, path, "object")
    for row, path in _rows(data, "visualization", "lamps"):
        yield from _one("object", row, path, "on")
    for row, path in _rows(data, "geometry_relations"):
        yield from _one("body or camera", row, path, "body_a")
        yield from _one("side", row, path, "body_b")


def _one(kind: str, row: dict[str, Any], path: Path, key: str) -> Iterator[tuple[str, Any, Path]]:
    if row.get(key) is not None:
        yield kind, row[key], (*path, key)


def _each(kind: str, row: dict[str, Any], path: Path, key: str) -> Iterator[tuple[str, Any, Path]]:
    for name, place in _list(row, path, key):
        yield kind, name, place


def _list(row: dict[str, Any], path: Path, key: str) -> Iterator[tuple[Any, Path]]:
    value = row.get(key)
    for index, item in enumerate(value if isinstance(value, list) else ()):
        yield item, (*path, key, index)


def _dict(value: Any) -> dict[str, Any]:
    return value if isinstance(value, dict) else {}


def _at(data: dict[str, Any], *path: str) -> dict[str, Any]:
    value: Any = data
    for part in path:
        value = _dict(value).get(part)
    return _dict(value)


def _rows(data: dict[str, Any], *path: str) -> Iterator[tuple[dict[str, Any], Path]]:
    """The mappings of a list."""
    value: Any = data
    for part in path:
        value = _dict(value).get(part)
    for index, row in enumerate(value if isinstance(value, list) else ()):
        if isinstance(row, dict):
            yield row, (*path, index)


def _named(data: dict[str, Any], *path: str) -> Iterator[tuple[str, Path]]:
    for row, place in _rows(data, *path):
        if isinstance(row.get("name"), str):
            yield row["name"], (*place, "name")


def _objects(data: dict[str, Any]) -> Iterator[tuple[str, Path]]:
    return _instances(data, "scene_objects")


def _families(data: dict[str, Any], section: str = "scene_objects") -> list[str]:
    """Names of objects with a `count`: what is said of one is said of each of its copies."""
    own = {name for name, _ in _instances(data, section)}
    return [name for name, _ in _named(data, section) if name not in own]


def _parts(row: dict[str, Any], path: Path) -> Iterator[tuple[dict[str, Any], Path]]:
    """The parts of a compound object."""
    return ((part, place) for part, place in _list(row, path, "parts") if isinstance(part, dict))


def _part_names(data: dict[str, Any]) -> Iterator[tuple[str, Path]]:
    for row, path in _rows(data, "scene_objects"):
        for part, place in _parts(row, path):
            if isinstance(part.get("name"), str):
                yield part["name"], (*place, "name")


def _instances(data: dict[str, Any], section: str = "assets") -> Iterator[tuple[str, Path]]:
    for row, path in _rows(data, section):
        breaks = row.get("breaks")
        name, count = row.get("name"), breaks.get("pieces", 1) if isinstance(breaks, dict) else row.get("count", 1)
        if not isinstance(name, str):
            continue
        if isinstance(count, int) and 1 < count <= 100_000:
            for index in range(count):
                yield f"{name}_{index + 1}", (*path, "name")
        else:
            yield name, (*path, "name")


def _cameras(data: dict[str, Any]) -> Iterator[tuple[str, Path, Any]]:
    for row, path in _rows(data, "implementation_steps"):
        for camera, place in _list(row, path, "cameras"):
            if isinstance(camera, str):
                yield camera, place, {"name": camera, "view": camera}
            elif isinstance(camera, dict) and isinstance(camera.get("name"), str):
                yield camera["name"], (*place, "name"), camera
