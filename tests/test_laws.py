"""The two laws of the house, and the third: servers share data, not engines."""

import ast
from pathlib import Path

import pytest

SERVERS = Path(__file__).parents[1] / "servers"
SIX = ("retrieve", "lint", "place", "stage", "scan", "stamp")


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


def test_the_walk_sees_the_house():
    assert len(modules("worldkit")) > 5
    seen = imports(SERVERS / "worldwright/model/run.py")
    assert {"worldkit.files.write_json", "worldwright.model.evidence.EvidenceKey"} <= seen


@pytest.mark.parametrize("path", modules("worldkit"), ids=str)
def test_worldkit_never_imports_worldwright(path):
    assert not {name for name in imports(path) if name.split(".")[0] == "worldwright"}


@pytest.mark.parametrize("path", modules("worldwright/model"), ids=str)
def test_the_model_imports_nothing_above_itself(path):
    above = {n for n in imports(path) if n.startswith("worldwright.") and not n.startswith("worldwright.model")}
    assert not above


@pytest.mark.parametrize("server", SIX)
def test_a_server_never_imports_another_servers_engine(server):
    for path in modules(f"worldwright/{server}"):
        for name in imports(path):
            parts = name.split(".")
            if parts[0] == "worldwright" and len(parts) > 1 and parts[1] in SIX and parts[1] != server:
                assert parts[2:3] == ["tools"], f"{path} imports {name}"


@pytest.mark.parametrize("server", SIX)
def test_tools_import_nothing_heavy(server):
    import subprocess
    import sys

    heavy = ("mujoco", "cv2", "pyarrow", "av", "trimesh", "mcp", "matplotlib", "lancedb", "torch", "numpy")
    code = f"import sys, worldwright.{server}.tools; print([m for m in {heavy!r} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


def test_the_top_level_is_what_the_customer_fixed():
    import subprocess

    root = SERVERS.parent
    tracked = subprocess.run(["git", "ls-files"], cwd=root, capture_output=True, text=True, check=False)
    if tracked.returncode:
        pytest.skip("not a git checkout")
    top = {line.split("/")[0] for line in tracked.stdout.splitlines()}
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
