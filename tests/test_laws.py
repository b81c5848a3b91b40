"""The laws of the house: which room may import which, no circles, no name twice, nothing too long, a small clone."""

import ast
import subprocess
from collections import Counter
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

SERVERS = Path(__file__).parents[1] / "servers"
SIX = ("retrieve", "lint", "place", "stage", "scan", "stamp")
MODEL_FLOORS = ("plan", "recording", "evidence")
"""Rooms of the model, bottom up; the files beside them lie below all three."""
CONVENTIONS = {"__init__", "tools", "engine", "errors", "reference", "command"}
"""Names that say which part a module plays in its folder, and may therefore occur in many."""


@cache
def imports(path: Path) -> set[str]:
    """Absolute names of everything a module imports, at any depth."""
    package = path.relative_to(SERVERS).with_suffix("").parts[:-1]
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = list(package[: len(package) - node.level + 1]) if node.level else []
            module = ".".join([*base, *(node.module or "").split(".")]).strip(".")
            found |= {f"{module}.{alias.name}" for alias in node.names}
    return found


def modules(folder: str) -> list[Path]:
    return sorted((SERVERS / folder).rglob("*.py"))


def dotted(path: Path) -> str:
    return ".".join(path.relative_to(SERVERS).with_suffix("").parts).removesuffix(".__init__")


@cache
def graph() -> dict[str, set[str]]:
    """Every module with the modules it imports, wherever in its text it does so."""
    known = {dotted(path) for path in SERVERS.rglob("*.py")}
    found: dict[str, set[str]] = {}
    for path in SERVERS.rglob("*.py"):
        here = dotted(path)
        named = {name if name in known else name.rsplit(".", 1)[0] for name in imports(path)}
        found[here] = (named & known) - {here}
    return found


def test_the_walk_sees_the_house():
    assert len(modules("worldkit")) > 5
    seen = imports(SERVERS / "worldwright/model/evidence/run.py")
    assert {"worldkit.files.write_json", "worldwright.model.evidence.reports.EvidenceKey"} <= seen


@pytest.mark.parametrize("path", modules("worldkit"), ids=str)
def test_worldkit_never_imports_worldwright(path):
    assert not {name for name in imports(path) if name.split(".")[0] == "worldwright"}


def test_what_a_program_imports_brings_neither_the_engine_nor_the_suite():
    """At import time; what a program hands over, it hands to another process."""
    import sys

    listed = [p.relative_to(SERVERS).with_suffix("").as_posix().replace("/", ".") for p in modules("worldkit")]
    wanted = [name for name in listed if not name.endswith(("__init__", "__main__"))]
    code = "import sys\n" + "".join(f"import {name}\n" for name in wanted)
    code += "print([m for m in sys.modules if m.split('.')[0] in ('worldengine', 'worldwright')])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, cwd=SERVERS)
    assert done.stdout.strip() == "[]"


@pytest.mark.parametrize("path", modules("worldkit"), ids=str)
def test_worldkit_never_imports_the_engine(path):
    assert not {name for name in imports(path) if name.split(".")[0] == "worldengine"}


@pytest.mark.parametrize("path", modules("worldengine"), ids=str)
def test_the_engine_never_imports_the_suite_nor_loads_a_program(path):
    found = imports(path)
    assert not {name for name in found if name.split(".")[0] in ("worldwright", "runpy")}
    assert not {name for name in found if name.startswith("importlib.") and name != "importlib.metadata"}
    called = {
        n.func.id
        for n in ast.walk(ast.parse(path.read_text()))
        if isinstance(n, ast.Call) and isinstance(n.func, ast.Name)
    }
    assert not called & {"exec", "eval", "compile", "__import__"}


@pytest.mark.parametrize("path", modules("worldwright/model"), ids=str)
def test_the_model_imports_nothing_above_itself(path):
    above = {n for n in imports(path) if n.startswith("worldwright.") and not n.startswith("worldwright.model")}
    assert not above


def floor_of(module: str) -> int:
    room = module.split(".")[2]
    return MODEL_FLOORS.index(room) + 1 if room in MODEL_FLOORS else 0


@pytest.mark.parametrize("path", modules("worldwright/model"), ids=str)
def test_a_room_of_the_model_imports_only_what_lies_below_it(path):
    own = dotted(path)
    if own == "worldwright.model":
        return
    of_the_model = {name for name in graph()[own] if name.startswith("worldwright.model.")}
    assert {name for name in of_the_model if floor_of(name) > floor_of(own)} == set()


def test_no_import_circle():
    try:
        TopologicalSorter(graph()).prepare()
    except CycleError as found:
        pytest.fail("an import circle: " + " -> ".join(reversed(found.args[1])))


def test_a_circle_would_be_seen():
    circle = graph() | {"worldkit.files": {"worldkit.bodies"}, "worldkit.joints": {"worldkit.files"}}
    with pytest.raises(CycleError):
        TopologicalSorter(circle).prepare()


def test_no_name_of_a_module_occurs_twice():
    stems = Counter(path.stem for path in SERVERS.rglob("*.py"))
    twice = {stem for stem, count in stems.items() if count > 1} - CONVENTIONS
    assert {stem: [dotted(p) for p in SERVERS.rglob(f"{stem}.py")] for stem in twice} == {}


@pytest.mark.parametrize("server", SIX)
def test_a_server_never_imports_another_servers_engine(server):
    for path in modules(f"worldwright/{server}"):
        for name in imports(path):
            parts = name.split(".")
            if parts[0] == "worldwright" and len(parts) > 1 and parts[1] in SIX and parts[1] != server:
                assert parts[2:3] == ["tools"], f"{path} imports {name}"


@pytest.mark.parametrize("server", SIX)
def test_tools_import_nothing_heavy(server):
    import sys

    heavy = ("mujoco", "cv2", "pyarrow", "av", "trimesh", "mcp", "matplotlib", "lancedb", "torch", "numpy")
    code = f"import sys, worldwright.{server}.tools; print([m for m in {heavy!r} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


TREE_BYTES = 28_000_000
WORLD_BYTES = 1_500_000
POSTER_BYTES = 60_000
KEPT = {
    "prompt.md", "plan.md", "simulation.py", "journal.jsonl", "motion.json", "poster.webp",
    "stamp.json", "stamp.dsse.json", "stamp.pub", "SHA256SUMS",
    "world.mjz", "world/program.json", "world/inputs.json", "world/inputs.arrows", "world/edits.arrows",
    "world/media.arrows", "world/balances.arrows",
}  # fmt: skip
MEDIA = (
    ".png", ".jpg", ".jpeg", ".webp", ".gif", ".mp4", ".webm", ".npz", ".npy", ".mjz", ".mjb", ".rrd", ".arrow", ".parquet",
)  # fmt: skip


def tracked() -> list[str]:
    """The files that version control keeps, relative to the root; a test outside a checkout is skipped."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=SERVERS.parent, capture_output=True, text=True, check=False)
    if listed.returncode:
        pytest.skip("not a git checkout")
    return [name for name in listed.stdout.split("\0") if name and (SERVERS.parent / name).is_file()]


def too_large(sizes):
    """What is wrong with the size of accepted worlds: bytes by name of the file, one line each."""
    worlds = {}
    for name, size in sizes.items():
        if name.startswith("examples/") and name.count("/") > 1:
            worlds.setdefault(name.split("/")[1], {})[name] = size
    for world, files in worlds.items():
        if sum(files.values()) > WORLD_BYTES:
            largest = max(files, key=files.__getitem__)
            yield f"examples/{world} has {sum(files.values()):,} B, more than {WORLD_BYTES:,}: {largest} {files[largest]:,} B"


def test_each_accepted_world_adds_little_to_a_clone():
    assert list(too_large({name: (SERVERS.parent / name).stat().st_size for name in tracked()})) == []
    sizes = {"examples/known_keys": 5_000_000, "examples/a/plan.md": 9_000, "examples/a/hull.stl": 1_499_000}
    assert list(too_large(sizes)) == [
        "examples/a has 1,508,000 B, more than 1,500,000: examples/a/hull.stl 1,499,000 B"
    ]


def test_a_clone_stays_small():
    sizes = {name: (SERVERS.parent / name).stat().st_size for name in tracked()}
    largest = sorted(sizes, key=sizes.__getitem__, reverse=True)[:5]
    said = ", ".join(f"{name} {sizes[name]:,} B" for name in largest)
    assert sum(sizes.values()) <= TREE_BYTES, f"the tree is larger than {TREE_BYTES:,} B; its largest files: {said}"


def test_no_file_of_an_example_is_one_that_a_build_makes():
    for name in tracked():
        if name.startswith("examples/") and name != "examples/known_keys":
            inside = Path(*Path(name).parts[2:])
            beside = inside.suffix in (".xml", ".urdf", ".obj", ".stl", ".py")  # files that a plan names
            assert str(inside) in KEPT or beside, f"{name} is built, not kept: `worldwright gallery keep` leaves it out"
            if inside.name == "poster.webp":
                assert (SERVERS.parent / name).stat().st_size <= POSTER_BYTES, f"{name} is larger than a poster may be"


def test_no_picture_or_recording_lies_elsewhere_than_where_it_is_used():
    media = [name for name in tracked() if name.endswith(MEDIA)]
    allowed = ("catalog/", "skills/layouts/references/")  # textures and layout sketches
    kept = ("poster.webp", "world.mjz")  # of an accepted world
    assert [
        m for m in media if not m.startswith(allowed) and not (m.startswith("examples/") and Path(m).name in kept)
    ] == []


def test_no_python_that_we_start_imports_from_where_it_is_started():
    """`-c` and `-m` put the working folder first: one that agents write, such as a run's, would bring its own `mujoco`."""
    found, checked = [], 0
    texts = ((path, path.read_text(encoding="utf-8")) for path in SERVERS.rglob("*.py"))
    for path, text in ((path, text) for path, text in texts if "executable" in text):
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.List) and node.elts and ast.unparse(node.elts[0]) == "sys.executable":
                words = {word.value for word in node.elts if isinstance(word, ast.Constant)}
                checked += 1
                if words & {"-c", "-m"} and not words & {"-P", "-I"}:
                    found.append(f"{path.relative_to(SERVERS)}:{node.lineno}")
    assert checked > 10 and not found, f"add -P: {', '.join(found)}"


def test_the_top_level_is_what_the_customer_fixed():
    top = {name.split("/")[0] for name in tracked()}
    fixed = {
        "pyproject.toml",
        "servers",
        "skills",
        "commands",
        "AGENTS.md",
        "CLAUDE.md",
        "catalog",
        "tests",
        "examples",
    }
    allowed = fixed | {"README.md", "LICENSE", "Makefile"}
    assert {name for name in top if not name.startswith(".")} == allowed


def test_no_module_is_too_long_to_read_at_once():
    lengths = {path: len(path.read_text(encoding="utf-8").splitlines()) for path in SERVERS.rglob("*.py")}
    assert {str(path.relative_to(SERVERS)): n for path, n in lengths.items() if n > 400} == {}
