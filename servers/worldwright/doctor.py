"""`worldwright doctor`: is everything a build needs really here? Each problem is printed with its fix.

Nothing is assumed: OpenGL is checked by rendering a frame, the sandbox by running something in it.
"""

import importlib
import os
import platform
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

import click

from . import expose

RENDER = """
import mujoco
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><light pos="0 0 3"/><geom size="1"/></worldbody></mujoco>')
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
with mujoco.Renderer(model, 32, 32) as renderer:
    renderer.update_scene(data)
    assert renderer.render().max() > 0, "the picture is black"
"""


@dataclass(frozen=True)
class Diagnosis:
    """One check's outcome."""

    name: str
    ok: bool
    found: str
    fix: str = ""
    essential: bool = True


def python() -> Diagnosis:
    """Python 3.11 or newer."""
    return Diagnosis("python", sys.version_info >= (3, 11), platform.python_version(), "install Python 3.11 or newer")


def simulator() -> Diagnosis:
    """MuJoCo 4 imports and reports its version."""
    code = "import mujoco; print(mujoco.__version__)"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60, check=False)
    found = done.stdout.strip() or _last_line(done.stderr)
    fix = f"{sys.executable} -m pip install --force-reinstall 'mujoco>=4,<5'"
    return Diagnosis("mujoco", done.returncode == 0 and found.startswith("4."), found, fix)


def wheels() -> Diagnosis:
    """The files of every wheel that can change a result are the ones the wheel came with."""
    import base64
    import hashlib
    from importlib.metadata import PackageNotFoundError, distribution

    from worldkit.lock import WHEELS

    changed, count = [], 0
    for name in WHEELS:
        try:
            files = distribution(name).files or []
        except PackageNotFoundError:
            continue
        for file in files:
            if file.hash is None or file.hash.mode != "sha256":
                continue
            path, count = Path(str(file.locate())), count + 1
            found = hashlib.sha256(path.read_bytes()).digest() if path.is_file() else b""
            if base64.urlsafe_b64encode(found).rstrip(b"=").decode() != file.hash.value:
                changed.append(f"{name}: {file}")
    found_text = f"changed since installed: {', '.join(changed[:3])}" if changed else f"{count} files as installed"
    fix = f"{sys.executable} -m pip install --force-reinstall --no-deps <the wheel named>"
    return Diagnosis("wheels", not changed, found_text, fix)


def opengl() -> Diagnosis:
    """A frame can be rendered without a display, with EGL or OSMesa."""
    tried = []
    for backend in ("egl", "osmesa"):
        environment = {**os.environ, "MUJOCO_GL": backend}
        call = [sys.executable, "-c", RENDER]
        done = subprocess.run(call, env=environment, capture_output=True, text=True, timeout=120, check=False)
        if done.returncode == 0:
            return Diagnosis("opengl", True, f"renders with {backend}")
        tried.append(f"{backend}: {_last_line(done.stderr)}")
    fix = "sudo apt-get install -y libegl1 libegl-mesa0 libgl1 libosmesa6"
    return Diagnosis("opengl", False, "; ".join(tried), fix)


def sandbox() -> Diagnosis:
    """The strongest level of the sandbox ladder that really confines here."""
    from .stage.sandbox import CONFINING, LADDER, level, unusable

    strongest = level()
    facts = ", ".join(f"{name} {value}" for name, value in LADDER[strongest].facts().items())
    proof = "a program inside tried to get out and failed" if strongest in CONFINING else "limits accidents only"
    weaker = "; ".join(f"{name}: {reason}" for name in LADDER if (reason := unusable(name)))
    found = f"{strongest} ({'; '.join(part for part in (facts, proof, weaker) if part)})"
    ok = strongest == "bubblewrap"
    return Diagnosis("sandbox", ok, found, "sudo apt-get install -y bubblewrap", essential=False)


def servers() -> Diagnosis:
    """Every server's tools import."""
    broken = []
    for name in expose.SERVERS:
        try:
            importlib.import_module(f"worldwright.{name}.tools")
        except Exception as cause:
            broken.append(f"{name}: {type(cause).__name__}: {cause}")
    count = len(expose.SERVERS)
    fix = f"{sys.executable} -m pip install --editable ."
    return Diagnosis("servers", not broken, "; ".join(broken) or f"all {count} import", fix)


def catalog() -> Diagnosis:
    """The asset catalog is where programs will look for it."""
    from worldkit import assets

    try:
        keys = assets.keys()
    except Exception as cause:
        return Diagnosis("catalog", False, str(cause), "set WORLDWRIGHT_CATALOG to the folder that holds the assets")
    return Diagnosis("catalog", bool(keys), f"{len(keys)} assets", "set WORLDWRIGHT_CATALOG to the catalog folder")


def disk() -> Diagnosis:
    """Room for recordings and films."""
    free_gb = shutil.disk_usage(Path.cwd()).free / 1e9
    return Diagnosis("disk", free_gb > 2, f"{free_gb:.0f} GB free here", "free some space: a run needs up to 2 GB")


CHECKS: tuple[Callable[[], Diagnosis], ...] = (python, simulator, wheels, opengl, sandbox, servers, catalog, disk)


def diagnose() -> Iterator[Diagnosis]:
    """Run every check; one that itself fails is a problem like any other."""
    for check in CHECKS:
        try:
            yield check()
        except Exception as cause:
            yield Diagnosis(
                check.__name__, False, f"{type(cause).__name__}: {cause}", "run `make demo` again to set up"
            )


def _last_line(text: str) -> str:
    return (text.strip().splitlines() or ["no message"])[-1]


@click.command("doctor")
@click.option(
    "--lock", type=click.Path(path_type=Path), help="Only pin a run to this environment: write its lock here."
)
def command(lock: Path | None) -> None:
    """Check Python, wheels, OpenGL, the sandbox and the servers; name a fix for each problem."""
    if lock is not None:
        from worldkit.files import write_json
        from worldkit.lock import observe

        from .stage.sandbox.confinement import gl_backend

        write_json(lock, observe(gl_backend()))
        click.echo(f"{lock}: a run that holds it runs in this environment or not at all")
        return
    broken = False
    for diagnosis in diagnose():
        mark = "ok  " if diagnosis.ok else "FAIL" if diagnosis.essential else "weak"
        click.echo(f"{mark} {diagnosis.name:<9} {diagnosis.found}")
        if not diagnosis.ok:
            click.echo(f"     fix: {diagnosis.fix}")
            broken = broken or diagnosis.essential
    sys.exit(1 if broken else 0)
