"""Take over pictures that an earlier pass drew of the same things, in place of drawing them again.

What a camera shows of a recording is decided by the rows, the compiled model without its other cameras, how that camera is
aimed, size, frame rate and quality, and the code that draws. One hash says all of it, so a changed text, claim or threshold
costs no picture, and a changed camera only its own. A renderer may let its other cameras matter (how far a room reaches):
`Drawing.shared` says so; where it does not say, any change of any camera counts.

An earlier file must hash as the pass that drew it said, or it is drawn again.
"""

import hashlib
import json
import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco

    from ..recording.stored import Recording

CAMERAS = ("cam_", "name_", "names", "text_", "numeric_", "paths")
COUNTS = {
    "ncam",
    "nnames",
    "npaths",
    "ntext",
    "ntextdata",
    "nnumeric",
    "nnumericdata",
    "nuser_cam",
    "nbuffer",
    "narena",
}
OF_CAMERAS = "worldkit.camera."


class Known:
    """The pictures of earlier passes, for one pass that draws a recording.

    Args:
        model: compiled, its cameras aimed.
        recording: whose rows are shown.
        facts: what else decides (quality, size, frame rate); must be JSON.
        earlier: folders of passes whose pictures may fit, each with `result.json`.
        shared: what all cameras together add to each picture.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        recording: "Recording",
        facts: dict[str, Any],
        earlier: Sequence[Path] = (),
        shared: bytes = b"",
    ) -> None:
        from . import renderers
        from .identity import identity

        self._model, self._earlier = model, tuple(earlier)
        told = [facts, identity(renderers.wanted()).sha256, recording.shown_sha256]
        self.about = json.dumps(told, sort_keys=True)
        """The facts, the renderer and the motion, in one text."""
        self._common = hashlib.sha256(self.about.encode() + drawn(model) + shared)
        self.keys: dict[str, str] = {}
        """The hash of each picture or film asked for, by the name of its file; goes into the result."""
        self.taken: dict[str, str] = {}
        """The earlier pass, by its folder under `evidence/`, that each was taken from."""

    def camera(self, name: str, suffix: str, out: Path) -> bool:
        """Whether `<name><suffix>` could be copied to `out`: what a camera of the model shows."""
        return self._take(name + suffix, of_camera(self._model, name), out) is not None

    def film(self, description: Path, name: str, out: Path) -> dict[str, Any] | None:
        """Copy an author's film of this description (a folder); returns what the pass that drew it reported, or None."""
        content = [path.name.encode() + b"\0" + path.read_bytes() for path in sorted(description.iterdir())]
        cameras = [getattr(self._model, field).tobytes() for field in ("cam_pos", "cam_quat", "cam_fovy")]
        return self._take(name, hashlib.sha256(b"".join([*content, *cameras])).digest(), out)

    def _take(self, name: str, what: bytes, out: Path) -> dict[str, Any] | None:
        digest = self._common.copy()
        digest.update(what)
        self.keys[name] = key = digest.hexdigest()
        for folder, result in results(self._earlier):
            summary = result.get("summary") or {}
            if (summary.get("pictures") or {}).get(name) != key:
                continue
            try:
                shutil.copyfile(folder / name, out / name)
                with (out / name).open("rb") as stream:
                    same = hashlib.file_digest(stream, "sha256").hexdigest() == (result.get("files") or {}).get(name)
            except OSError:
                same = False
            if same:
                self.taken[name] = str((summary.get("taken") or {}).get(name) or folder.parent.name)
                return summary
            (out / name).unlink(missing_ok=True)
        return None

    def told(self, renderer: dict[str, str]) -> dict[str, Any]:
        """What the result says of it; pictures of a renderer that had to step in are not offered to later passes."""
        offered = {} if "instead_of" in renderer else self.keys
        return {"pictures": offered} | ({"taken": self.taken} if self.taken else {})


def drawn(model: "mujoco.MjModel") -> bytes:
    """A hash of everything of a model that any picture may show, but its cameras."""
    import mujoco
    import numpy as np

    from worldkit.alike import kind_names

    digest = hashlib.sha256()

    def add(holder: object, prefix: str) -> None:
        for name in sorted(n for n in dir(holder) if n[0].islower()):
            if not prefix and (name.startswith(CAMERAS) or name in COUNTS or name == "signature"):
                continue
            value = getattr(holder, name)
            if isinstance(value, np.ndarray):
                digest.update(f"{prefix}{name}{value.dtype}{value.shape}".encode() + value.tobytes())
            elif isinstance(value, bool | int | float | np.generic):
                digest.update(f"{prefix}{name}={value!r};".encode())
            elif name in ("opt", "vis", "stat") or (prefix == "vis." and not callable(value)):
                add(value, f"{prefix}{name}.")

    add(model, "")
    kinds = {**kind_names(model), **kind_names(model, ("mat", "tex", "skin", "light"))}
    digest.update(json.dumps(kinds, sort_keys=True).encode())
    for kind, count in ((mujoco.mjtObj.mjOBJ_TEXT, model.ntext), (mujoco.mjtObj.mjOBJ_NUMERIC, model.nnumeric)):
        for index in range(count):
            name = mujoco.mj_id2name(model, kind, index) or ""
            if not name.startswith(OF_CAMERAS):
                digest.update(name.encode() + b"\0" + _content(model, kind, index))
    return digest.digest()


def of_camera(model: "mujoco.MjModel", camera: str) -> bytes:
    """Everything of one camera: where it stands after aiming, its lens, what it is meant for."""
    import mujoco

    index = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_CAMERA, camera)
    found = [camera.encode()]
    for name in sorted(n for n in dir(model) if n.startswith("cam_")):
        found.append(f"{name} ".encode() + getattr(model, name)[index].tobytes())
    for kind in (mujoco.mjtObj.mjOBJ_TEXT, mujoco.mjtObj.mjOBJ_NUMERIC):
        at = mujoco.mj_name2id(model, kind, OF_CAMERAS + camera)
        found.append(_content(model, kind, at) if at >= 0 else b"")
    return b"\n".join(found)


def _content(model: "mujoco.MjModel", kind: "mujoco.mjtObj", index: int) -> bytes:
    import mujoco

    if kind == mujoco.mjtObj.mjOBJ_TEXT:
        start, size = int(model.text_adr[index]), int(model.text_size[index])
        return bytes(model.text_data[start : start + size])
    start, size = int(model.numeric_adr[index]), int(model.numeric_size[index])
    return bytes(model.numeric_data[start : start + size].tobytes())


def results(earlier: Sequence[Path]) -> Iterator[tuple[Path, dict[str, Any]]]:
    """The passes that succeeded, each with its result."""
    for folder in earlier:
        if (result := _json(folder / "result.json")).get("ok"):
            yield folder, result


def _json(path: Path) -> dict[str, Any]:
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}
