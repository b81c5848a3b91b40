"""Real harnesses from npm at pinned versions, in an empty home, with dummy keys, against a scripted model on loopback."""

import os
import platform
import shutil
import subprocess
from pathlib import Path

import pytest

from worldwright.simulator.cache import cache_folder

REPO = Path(__file__).parents[2]
PACKAGES = ("@anthropic-ai/claude-code@2.1.329", "@openai/codex@0.169.0", "opencode-ai@1.18.33")
FOLDER = REPO / ".venv" / "harnesses"
MACHINE = "x64" if platform.machine() == "x86_64" else "arm64"
TRIPLE = f"{'x86_64' if MACHINE == 'x64' else 'aarch64'}-unknown-linux-musl"
BINARIES = {
    "claude": FOLDER / f"node_modules/@anthropic-ai/claude-code-linux-{MACHINE}/claude",
    "codex": FOLDER / f"node_modules/@openai/codex-linux-{MACHINE}/vendor/{TRIPLE}/bin/codex",
    "opencode": FOLDER / f"node_modules/opencode-linux-{MACHINE}/bin/opencode",
}


# Their own target (`make test-harness`): the harnesses are large and come from npm.
collect_ignore_glob = [] if os.environ.get("WORLDWRIGHT_HARNESSES") else ["test_*.py"]


@pytest.fixture(scope="session")
def harnesses() -> dict[str, Path]:
    """The harnesses' programs, installed once."""
    if not all(path.is_file() for path in BINARIES.values()):
        if shutil.which("npm") is None:
            pytest.fail("the harnesses come from npm: run `bash .ci/system.sh suites`, or leave this target out")
        FOLDER.mkdir(parents=True, exist_ok=True)
        (FOLDER / "package.json").write_text("{}")
        command = ["npm", "install", "--ignore-scripts", "--no-audit", "--no-fund", *PACKAGES]
        done = subprocess.run(command, cwd=FOLDER, capture_output=True, text=True)
        if done.returncode:
            pytest.fail(f"npm could not install the harnesses: {done.stderr[-300:]}")
    return BINARIES


@pytest.fixture
def project(tmp_path: Path) -> Path:
    """A copy of the project as it stands, with the environment of this checkout."""
    folder = tmp_path / "project"
    listed = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard"],
        cwd=REPO,
        capture_output=True,
        text=True,
        check=True,
    )
    for name in listed.stdout.splitlines():
        source, target = REPO / name, folder / name
        if name.startswith("examples/") or not (source.is_file() or source.is_symlink()):
            continue
        target.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(source, target, follow_symlinks=False)
    (folder / ".venv").mkdir()  # a folder as in a checkout: Codex protects none that is itself a link
    for entry in (REPO / ".venv").iterdir():
        (folder / ".venv" / entry.name).symlink_to(entry)
    (folder / "runs").mkdir()
    subprocess.run(["git", "init", "-q"], cwd=folder, check=True)
    return folder


@pytest.fixture(scope="session")
def cache(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What every home may share: tables of the installed packages, which are minutes of work to make for each anew.

    What the corpus means was embedded when this checkout was set up, and is copied: a server that lacks it has all of it
    embedded beside the tests, which takes both cores for minutes.
    """
    folder = tmp_path_factory.mktemp("cache")
    for vectors in cache_folder().glob("vectors-*.sqlite"):
        shutil.copy(vectors, folder)
    return folder


@pytest.fixture
def clean(tmp_path: Path, cache: Path) -> dict[str, str]:
    """An environment with nothing of this machine's settings: an empty home, a path, dummy keys."""
    home, scratch = tmp_path / "home", tmp_path / "scratch"
    (home / ".cache").mkdir(parents=True)
    (home / ".cache" / "worldwright").symlink_to(cache)  # a variable would not reach the servers that Codex starts
    scratch.mkdir()
    return {
        "HOME": str(home),
        "TMPDIR": str(scratch),  # Codex refuses a home below the folder for temporary files
        "PATH": os.environ["PATH"],
        "MUJOCO_GL": os.environ.get("MUJOCO_GL", "egl"),
        "ANTHROPIC_API_KEY": "dummy",
        "OPENAI_API_KEY": "dummy",
        "IS_SANDBOX": "1",
        # Offline: whatever looks beyond loopback finds a closed door.
        "HTTP_PROXY": "http://127.0.0.1:9",
        "HTTPS_PROXY": "http://127.0.0.1:9",
        "NO_PROXY": "127.0.0.1,localhost",
        "npm_config_registry": "http://127.0.0.1:9",
        "npm_config_fetch_retries": "0",  # OpenCode waits for an npm package of its own before it loads plugins
    }


@pytest.fixture
def small_plan() -> str:
    """The plan of the suite's own small world."""
    return (REPO / "tests/worldwright/world/dropped-ball.md").read_text(encoding="utf-8")
