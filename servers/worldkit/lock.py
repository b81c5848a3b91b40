"""The environment contract, checked from inside: a run's interpreter, wheels, engine, renderer and processor.

Whoever starts a program writes down what it is meant to run in (`WORLDKIT_LOCK` names the file); importing worldkit
compares that with what is really there and refuses to go on when they differ, naming each difference. Nothing is
imported to find out, so a wrong engine is refused before its first line runs.
"""

import hashlib
import importlib.util
import json
import os
import platform
import sys
from collections.abc import Mapping
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path

from .wheels import version_of

WHEELS = ("mujoco", "mujoco-core", "numpy", "pyarrow", "av", "opencv-python-headless")
"""Everything installed that can change a trajectory or a picture."""
VARIABLE = "WORLDKIT_LOCK"
CONFIGURATION_ERROR = 78
"""EX_CONFIG of sysexits.h."""


def observe(gl: str | None = None) -> dict[str, str]:
    """What a program would run in here, as text by name.

    Args:
        gl: the OpenGL backend; `MUJOCO_GL` when None.
    """
    facts = {
        "python": f"{platform.python_implementation()} {platform.python_version()}",
        "machine": f"{platform.system()}-{platform.machine()}",
        "gl": os.environ.get("MUJOCO_GL", "") if gl is None else gl,
        "cpu features": cpu_features(),
    }
    for name in WHEELS:
        try:
            found = distribution(name)
        except PackageNotFoundError:
            continue
        record = found.read_text("RECORD") or ""
        facts[f"wheel {name}"] = f"{version_of(found)} {hashlib.sha256(record.encode()).hexdigest()}"
        for library in _engine(found) if name.startswith("mujoco") else ():
            with library.open("rb") as stream:
                facts["engine"] = f"{library.name} {hashlib.file_digest(stream, 'sha256').hexdigest()}"
    for module in ("mujoco", "numpy"):
        spec = importlib.util.find_spec(module)
        facts[f"origin of {module}"] = str(spec.origin) if spec else "missing"
    return facts


def differences(locked: Mapping[str, str], here: Mapping[str, str]) -> list[str]:
    """What differs, one line each; for lists of words only the words."""
    lines = []
    for name in dict.fromkeys((*locked, *here)):
        wanted, found = locked.get(name, "missing"), here.get(name, "missing")
        if wanted == found:
            continue
        if name == "cpu features":
            lost, won = set(wanted.split()) - set(found.split()), set(found.split()) - set(wanted.split())
            parts = [f"without {' '.join(sorted(lost))}"] * bool(lost) + [f"also {' '.join(sorted(won))}"] * bool(won)
            lines.append(f"{name}: {'; '.join(parts)}")
        else:
            lines.append(f"{name}: {found} (locked: {wanted})")
    return lines


def verify() -> None:
    """Compare with the lock that `WORLDKIT_LOCK` names, if any; on a mismatch leave `error.json` and end the program."""
    path = os.environ.get(VARIABLE)
    if not path:
        return
    found = differences(json.loads(Path(path).read_text(encoding="utf-8")), observe())
    os.environ[VARIABLE] = ""  # a program's own helpers run in an environment that was checked already
    if not found:
        return
    from .files import write_json

    message = "; ".join(found)
    advice = "install what the lock names (`pip install -c .ci/constraints.txt …`), or start again to lock what is here"
    facts = {"type": "EnvironmentMismatch", "message": message, "code": "environment", "next_move": advice}
    try:
        write_json("error.json", facts)  # a job's working directory is its results folder
    except OSError as also:
        sys.stderr.write(f"{also}\n")
    sys.stderr.write(f"this is not the environment the run was locked to: {message}\n  next: {advice}\n")
    raise SystemExit(CONFIGURATION_ERROR)


def _engine(package: Distribution) -> list[Path]:
    """The engine's shared library, in the wheel that carries it."""
    files = package.files or []
    return [Path(str(f.locate())) for f in files if f.name.startswith("libmujoco") or f.name == "mujoco.dll"]


def cpu_features() -> str:
    """Instruction sets of the first processor, sorted and in one line; empty where the system does not say."""
    try:
        text = Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace")
    except OSError:
        return ""
    for line in text.splitlines():
        name, _, value = line.partition(":")
        if name.strip() in ("flags", "Features"):
            return " ".join(sorted(value.split()))
    return ""
