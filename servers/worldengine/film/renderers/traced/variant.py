"""Choose how Mitsuba computes: on NVIDIA's card, else compiled by LLVM, else plainly and 3 to 5 times slower.

Measured, 1280x720 with twenty things, noise taken out: on an H100 0.2 s a picture at 3 samples, 0.4 to 0.6 s at 64, 1 to 2 s
at 256; the preview's pictures take 13 to 16 ms there (OpenGL through EGL).
"""

import ctypes
import os
import platform
from functools import cache
from pathlib import Path

from worldkit.errors import WorldkitError

LIBRARY = "DRJIT_LIBLLVM_PATH"
LEAST = 17
"""Versions 15 and 16 stop with `Cannot select fminimum`."""
FOLDERS = (Path("/usr/lib"), Path("/usr/lib64"), Path("/usr/local/lib"), Path("/opt/homebrew/opt/llvm/lib"))
GPU, COMPILED, PLAIN = "cuda_ad_rgb", "llvm_ad_rgb", "scalar_rgb"
INSTALL = "pip install 'worldwright[film]' (in a clone: make .venv/.dev)"


class MissingRendererError(WorldkitError):
    """A renderer's packages are not installed, or cannot be loaded."""

    code = "missing_renderer"


@cache
def choose() -> str:
    """Load Mitsuba, once in a process, and answer its variant.

    Raises:
        MissingRendererError: it is not installed; the error names the command.
    """
    found = os.environ.get(LIBRARY) or library()
    if found:
        os.environ[LIBRARY] = found
    try:
        import mitsuba
    except (ImportError, OSError) as cause:
        raise MissingRendererError(f"the traced renderer needs Mitsuba: {cause}", "mitsuba", INSTALL) from cause
    for name in candidates(nvidia(), bool(found)):
        try:
            mitsuba.set_variant(name)
            if name != PLAIN:
                import drjit

                drjit.eval(drjit.arange(mitsuba.Float, 4) + 1.0)
        except (ImportError, RuntimeError, OSError):
            continue
        mitsuba.set_log_level(mitsuba.LogLevel.Error)
        return name
    raise MissingRendererError("no variant of Mitsuba can be loaded here", "mitsuba", INSTALL)


def compiled() -> bool:
    """Whether the variant that is set computes many paths at once."""
    import mitsuba

    return str(mitsuba.variant()) != PLAIN


def candidates(gpu: bool, llvm: bool) -> tuple[str, ...]:
    """The variants to try, the fastest first."""
    return (GPU,) * gpu + (COMPILED,) * llvm + (PLAIN,)


def nvidia() -> bool:
    """Whether a graphics card of NVIDIA's is there, and its driver answers."""
    count = ctypes.c_int(0)
    try:
        driver = ctypes.CDLL("libcuda.so.1")
        return driver.cuInit(0) == 0 and driver.cuDeviceGetCount(ctypes.byref(count)) == 0 and count.value > 0
    except (OSError, AttributeError):
        return False


def library() -> str:
    """The newest LLVM library of a version that works; empty when there is none."""
    places = [folder for top in FOLDERS for folder in (top, top / f"{platform.machine()}-linux-gnu")]
    places += sorted(Path("/usr/lib").glob("llvm-*/lib"))
    found = {}
    for path in (path for place in places for path in place.glob("libLLVM*")):
        number = next((int(w) for w in path.name.replace("-", ".").split(".") if w.isdecimal()), 0)
        if number >= LEAST:
            found[number, path.name] = str(path)
    return found[max(found)] if found else ""
