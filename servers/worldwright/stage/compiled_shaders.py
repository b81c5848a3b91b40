"""What a graphics driver has compiled once, laid into the throw-away home of each job that draws.

A job's home is empty, so that a driver that compiles shaders for the processor spends seconds on it in each job, and then
draws in milliseconds. What is laid there comes from a confined process of our own code, on things of ours alone
(`shader_sampler`); a driver takes from it what fits itself and compiles the rest. Each job has a copy: what it writes there
goes with it, so no world reaches another's pictures.
"""

import contextlib
import hashlib
import io
import json
import sys
import zipfile
import zlib
from pathlib import Path

from worldkit import lock
from worldkit.files import write_atomic

from ..model.evidence import environment
from ..model.evidence.file_hashes import cache_folder
from . import confined, shader_sampler
from .sandbox.confinement import gl_backend

DRIVERS = ("dri/*_dri.so", "libgallium*.so", "libEGL_*.so*", "libOSMesa.so*", "libLLVM*.so*")
"""Files of the system's libraries whose change makes a driver compile anew."""


def lay(home: Path) -> None:
    """Lay the compiled shaders into a job's home; where there are none the driver compiles them there."""
    path = cache_folder() / f"shaders-{_state()}.zip"
    content = _kept(path)
    if content:
        try:
            with zipfile.ZipFile(io.BytesIO(content)) as archive:
                archive.extractall(home)
        except (zipfile.BadZipFile, EOFError, ValueError, NotImplementedError, zlib.error):  # made anew by the next job
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
