"""What a graphics driver has compiled once, laid into the throw-away home of each job that draws.

A job's home is empty, so that a driver that compiles shaders for the processor spends seconds on it in each job, and then
draws in milliseconds. What is laid there comes from a confined process of our own code, on things of ours alone
(`shader_sampler`); a driver takes from it what fits itself and compiles the rest. Each job has a copy: what it writes there
goes with it, so no world reaches another's pictures.

What our engine compiled for a run's own pictures is kept for the next pictures of that run (`keep`), of no other: a film's lamps,
glass and cloth take seconds to compile, and a film is looked at many times. What acceptance and proof draw again they draw without it.
"""

import contextlib
import hashlib
import io
import json
import os
import re
import sys
import zipfile
import zlib
from pathlib import Path

from worldkit import lock
from worldkit.files import write_atomic

from ..model.evidence import environment
from ..model.evidence.file_hashes import cache_folder
from . import confined, plain, shader_sampler
from .sandbox.confinement import gl_backend

DRIVERS = ("dri/*_dri.so", "libgallium*.so", "libEGL_*.so*", "libOSMesa.so*", "libLLVM*.so*")
"""Files of the system's libraries whose change makes a driver compile anew."""
MOST_BYTES, MOST_RUNS = 32 << 20, 40
"""What is kept of a run at most, and of how many runs; 163 shaders of a film with hands and glass were 3 MB."""
PLAIN_NAME = re.compile(r"[\w.-]+(/[\w.-]+)*")


def lay(home: Path, run: Path | None = None) -> None:
    """Lay the compiled shaders into a job's home, those of a run, too; where there are none the driver compiles them there."""
    state = _state()
    path = cache_folder() / f"shaders-{state}.zip"
    _unpack(_kept(path), path, home)
    if run is not None:
        own = _of(run, state)
        with contextlib.suppress(OSError):
            _unpack(own.read_bytes(), own, home)


def keep(home: Path, run: Path) -> None:
    """Keep what a job of our engine, which has ended, compiled in its home, for the next pictures of the same run."""
    state = _state()
    found: dict[str, bytes] = {}
    with contextlib.suppress(OSError, zipfile.BadZipFile):
        with zipfile.ZipFile(cache_folder() / f"shaders-{state}.zip") as archive:
            common = set(archive.namelist())
        for top in (home / name for name in shader_sampler.CACHES):
            if top.is_symlink():  # the one link that a walk would follow
                continue
            for folder, _, names in os.walk(top):
                for path in (Path(folder) / name for name in names):
                    name = path.relative_to(home).as_posix()
                    if name not in common and PLAIN_NAME.fullmatch(name) and (data := plain.read(path, MOST_BYTES)):
                        found[name] = data
        own = _of(run, state)
        if not found or sum(map(len, found.values())) > MOST_BYTES or set(found) <= _names(own):
            return
        packed = io.BytesIO()
        with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
            for name, data in sorted(found.items()):
                archive.writestr(name, data)
        write_atomic(own, packed.getvalue())
        others = sorted(own.parent.glob("*.zip"), key=lambda one: -one.stat().st_mtime)
        for old in others[MOST_RUNS:]:
            old.unlink(missing_ok=True)


def _of(run: Path, state: str) -> Path:
    """Where those of a run are kept: beside the others, where nobody who may write in the run can."""
    name = hashlib.sha256(f"{state} {run.absolute()}".encode()).hexdigest()[:32]
    return cache_folder() / "shaders-of-runs" / f"{name}.zip"


def _names(path: Path) -> set[str]:
    with contextlib.suppress(OSError, zipfile.BadZipFile), zipfile.ZipFile(path) as archive:
        return set(archive.namelist())
    return set()


def _unpack(content: bytes, path: Path, home: Path) -> None:
    """Unpack what was kept at a path; what is damaged is thrown away, and made anew by the next job."""
    if not content:
        return
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            archive.extractall(home)
    except (zipfile.BadZipFile, EOFError, ValueError, NotImplementedError, zlib.error):
        with contextlib.suppress(OSError):
            path.unlink(missing_ok=True)


def _kept(path: Path) -> bytes:
    """The packed files, made on first use; empty where nothing can be drawn here."""
    with contextlib.suppress(OSError):
        if content := path.read_bytes():
            return content
    script = Path(shader_sampler.__file__)
    call = [sys.executable, "-s", str(script), "{out}"]
    done = confined.run(call, reads=[script], wanted=[shader_sampler.PACKED], wall_s=120.0, memory_mb=4096)
    content = done.files.get(shader_sampler.PACKED, b"")
    if done.status == "ended" and done.exit_code == 0 and content:  # else another try may go better
        with contextlib.suppress(OSError):  # a read-only home costs time, not pictures
            write_atomic(path, content)
    return content


def _state() -> str:
    """A hash of everything that decides what a driver compiles."""
    libraries = [path for folder in ("/usr/lib", "/usr/lib64") for path in _drivers(Path(folder))]
    seen = [(str(path), stat.st_size, stat.st_mtime_ns) for path in libraries for stat in (path.stat(),)]
    facts = [environment.film().sha256, gl_backend(), lock.cpu_features(), seen]
    facts.append(hashlib.sha256(Path(shader_sampler.__file__).read_bytes()).hexdigest())
    return hashlib.sha256(json.dumps(facts).encode()).hexdigest()[:24]


def _drivers(folder: Path) -> list[Path]:
    """The graphics drivers in a folder of libraries and the folders of its architectures."""
    return sorted(
        path for part in ("", "*/") for name in DRIVERS for path in folder.glob(part + name) if path.is_file()
    )
