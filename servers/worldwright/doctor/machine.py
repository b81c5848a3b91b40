"""Check what a build needs of the machine: Python, intact wheels, OpenGL that draws, a sandbox that confines.

Nothing is assumed: OpenGL is checked by rendering a frame, the sandbox by running something in it.
"""

import os
import platform
import shutil
import subprocess
import sys
from pathlib import Path

from .diagnosis import Diagnosis, last_line

RENDER = """
import mujoco
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><light pos="0 0 3"/><geom size="1"/></worldbody></mujoco>')
data = mujoco.MjData(model)
mujoco.mj_forward(model, data)
with mujoco.Renderer(model, 32, 32) as renderer:
    renderer.update_scene(data)
    assert renderer.render().max() > 0, "the picture is black"
"""


def python() -> Diagnosis:
    """Check for Python 3.11 or newer."""
    return Diagnosis("python", sys.version_info >= (3, 11), platform.python_version(), "install Python 3.11 or newer")


def simulator() -> Diagnosis:
    """Check that MuJoCo 4 imports and reports its version."""
    code = "import mujoco; print(mujoco.__version__)"
    done = subprocess.run([sys.executable, "-P", "-c", code], capture_output=True, text=True, timeout=60, check=False)
    found = done.stdout.strip() or last_line(done.stderr)
    fix = f"{sys.executable} -m pip install --force-reinstall 'mujoco>=4,<5'"
    return Diagnosis("mujoco", done.returncode == 0 and found.startswith("4."), found, fix)


def wheels() -> Diagnosis:
    """Check that every wheel that can change a result still has its original files."""
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
    """Check that a frame can be rendered without a display, with EGL or OSMesa."""
    tried = []
    for backend in ("egl", "osmesa"):
        environment = {**os.environ, "MUJOCO_GL": backend}
        call = [sys.executable, "-P", "-c", RENDER]
        done = subprocess.run(call, env=environment, capture_output=True, text=True, timeout=120, check=False)
        if done.returncode == 0:
            return Diagnosis("opengl", True, f"renders with {backend}")
        tried.append(f"{backend}: {last_line(done.stderr)}")
    fix = "sudo apt-get install -y libegl1 libegl-mesa0 libgl1 libosmesa6"
    return Diagnosis("opengl", False, "; ".join(tried), fix)


def sandbox() -> Diagnosis:
    """Check which level of the sandbox ladder is the strongest that really confines here."""
    from ..stage.sandbox import CONFINING, LADDER, level, unusable

    strongest = level()
    facts = ", ".join(f"{name} {value}" for name, value in LADDER[strongest].facts().items())
    proof = "a program inside tried to get out and failed" if strongest in CONFINING else "limits accidents only"
    weaker = "; ".join(f"{name}: {reason}" for name in LADDER if (reason := unusable(name)))
    found = f"{strongest} ({'; '.join(part for part in (facts, proof, weaker) if part)})"
    ok = strongest == "bubblewrap"
    return Diagnosis("sandbox", ok, found, "sudo apt-get install -y bubblewrap", essential=False)


def catalog() -> Diagnosis:
    """Check that the asset catalog is where programs look for it."""
    from worldkit import assets

    try:
        keys = assets.keys()
    except Exception as cause:
        return Diagnosis("catalog", False, str(cause), "set WORLDWRIGHT_CATALOG to the folder that holds the assets")
    return Diagnosis("catalog", bool(keys), f"{len(keys)} assets", "set WORLDWRIGHT_CATALOG to the catalog folder")


def matter() -> Diagnosis:
    """Check that numba is here, and that what flows and heaps up is compiled: else the first run of such a law waits for it."""
    from worldkit import kept_kernels

    if not (found := kept_kernels.numba()):
        fix = f"{sys.executable} -m pip install 'worldwright[matter]'"
        return Diagnosis("matter", False, "numba is not installed: no liquid, sand or snow", fix, essential=False)
    compiled = kept_kernels.compiled()
    told = "compiled" if compiled else "not compiled yet: the first run of a liquid, sand or snow waits for it"
    if not compiled and not kept_kernels.may_be_kept():
        told = "not compiled, and only who may write the installation can: each run of a liquid, sand or snow compiles"
    return Diagnosis("matter", compiled, f"numba {found}, {told}", " ".join(kept_kernels.CALL), essential=False)


def ros() -> Diagnosis:
    """Check that what speaks ROS 2 is here, and that its own library loads."""
    from importlib import import_module
    from importlib.metadata import PackageNotFoundError, version

    try:
        found = ", ".join(f"{name} {version(name)}" for name in ("cyclonedds", "rosbags"))
        import_module("cyclonedds.domain")
    except (PackageNotFoundError, ImportError) as cause:
        fix = f"{sys.executable} -m pip install 'worldwright[ros]'"
        return Diagnosis("ros", False, f"no ROS 2 network, no rosbag2: {cause}", fix, essential=False)
    return Diagnosis("ros", True, found)


def disk() -> Diagnosis:
    """Check that there is room for recordings and films."""
    free_gb = shutil.disk_usage(Path.cwd()).free / 1e9
    return Diagnosis("disk", free_gb > 2, f"{free_gb:.0f} GB free here", "free some space: a run needs up to 2 GB")


CHECKS = (python, simulator, wheels, opengl, sandbox, catalog, matter, ros, disk)
