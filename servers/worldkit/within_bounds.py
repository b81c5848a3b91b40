"""Refusing a world that is too large for a file, before the engine's compiler begins to take memory for it."""

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .closed_archive import MOST_BYTES
from .errors import ProgramError

if TYPE_CHECKING:
    import mujoco

DIGITS = 20
"""Bytes of a number in the world's text, about."""
ARRAYS = {
    "meshes": ("uservert", "usernormal", "usertexcoord", "userface"),
    "hfields": ("userdata",),
    "skins": ("vert", "texcoord", "face", "bindpos"),
    "flexes": ("vert", "texcoord", "elem"),
}


def check(spec: "mujoco.MjSpec") -> None:
    """Raise a `ProgramError` that names the largest part, if the world's file would unpack to more than `MOST_BYTES`."""
    sizes = sorted(_sizes(spec), reverse=True)
    total = sum(size for size, _ in sizes)
    if total > MOST_BYTES:
        raise ProgramError(
            f"its meshes, pictures and fields take {total >> 20} MB, and a world's file at most {MOST_BYTES >> 20} MB",
            "build()",
            f"make the largest coarser: {sizes[0][1]} takes {sizes[0][0] >> 20} MB",
        )


def _sizes(spec: "mujoco.MjSpec") -> Iterator[tuple[int, str]]:
    """(bytes in the archive, name) of everything large; a file that is not there counts nothing, as another error names it."""
    folder = Path(spec.modelfiledir or ".")
    held = {name: len(content) for name, content in spec.assets.items()}
    seen: set[str] = set()
    for kind in ("meshes", "hfields", "skins", "textures", "flexes"):
        for element in getattr(spec, kind):
            yield sum(DIGITS * len(getattr(element, name)) for name in ARRAYS.get(kind, ())), element.name
            if kind == "textures":
                yield len(element.data), element.name
            file: Any = getattr(element, "file", "")
            if file and file not in seen:
                seen.add(file)
                base = folder / ((spec.texturedir if kind == "textures" else spec.meshdir) or "")
                yield held.get(file) or _stat(base / file), f"{element.name or kind} ({Path(file).name})"


def _stat(path: Path) -> int:
    try:
        return path.stat().st_size
    except OSError:
        return 0
