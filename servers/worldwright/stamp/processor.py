"""The processor family: on the same build and family a trajectory repeats bit for bit; elsewhere it need not."""

import platform
from pathlib import Path

FIELDS = ("vendor_id", "cpu family", "model", "CPU implementer", "CPU part")


def cpu() -> str:
    """E.g. `x86_64 GenuineIntel family 6 model 143`; only the architecture where the kernel does not say."""
    found: dict[str, str] = {}
    try:
        for line in Path("/proc/cpuinfo").read_text(encoding="utf-8", errors="replace").split("\n"):
            name, _, value = line.partition(":")
            if name.strip() in FIELDS:
                found.setdefault(name.strip(), value.strip())
    except OSError:
        pass
    known = [field for field in FIELDS if field in found]
    words = [found[f] if f == "vendor_id" else f"{f.removeprefix('cpu ')} {found[f]}" for f in known]
    return " ".join([platform.machine(), *words])
