"""Stand-ins for packages that such programs often use and this environment may lack: just enough for the run to go on.

A program that needs anything else cannot run here, which is no finding.
"""

import importlib.util
import sys
import types
from typing import Any

import numpy as np
from said import SAID
from tracked import Note, Tracked, note_of, plain


class Inert:
    """Takes every call and attribute, and does nothing."""

    def __init__(self, *_: Any, **__: Any) -> None:
        pass

    def __call__(self, *_: Any, **__: Any) -> Any:
        """Nothing."""
        return self

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def __iter__(self) -> Any:
        return iter(())


def _missing(name: str) -> bool:
    try:
        return name not in sys.modules and importlib.util.find_spec(name) is None
    except (ImportError, ValueError):
        return True


def _module(name: str, **members: Any) -> Any:
    made = types.ModuleType(name)
    vars(made).update(members)
    sys.modules[name] = made
    return made


def _inert(name: str) -> None:
    made = _module(name)
    made.__getattr__ = lambda attribute: Inert()  # type: ignore[method-assign]
    made.__path__ = []  # type: ignore[attr-defined]


class Space:
    """Stands in for a space of gymnasium."""

    def __init__(self, low: Any = 0, high: Any = 1, shape: Any = None, dtype: Any = np.float32, **_: Any) -> None:
        self.shape = tuple(shape) if shape is not None else np.shape(low)
        self.dtype = np.dtype(dtype)
        self.low, self.high = np.broadcast_to(low, self.shape), np.broadcast_to(high, self.shape)
        self.n = low if isinstance(low, int) else None
        self.np_random = np.random.default_rng(0)

    def seed(self, seed: Any = None) -> Any:
        """Seed it."""
        self.np_random = np.random.default_rng(seed)
        return [seed]

    def sample(self, *_: Any) -> Any:
        """One element."""
        low, high = np.maximum(self.low, -1e3), np.minimum(self.high, 1e3)
        return self.np_random.uniform(low, high).astype(self.dtype)

    def contains(self, _: Any) -> bool:
        """Whether the space holds a value; this one holds every value."""
        return True


class Env:
    """Stands in for an environment of gymnasium."""

    metadata: dict[str, Any] = {}
    render_mode: Any = None
    _random: Any = None

    @property
    def np_random(self) -> Any:
        """Its own generator."""
        if self._random is None:
            self._random = np.random.default_rng(0)
        return self._random

    @np_random.setter
    def np_random(self, value: Any) -> None:
        self._random = value

    @property
    def unwrapped(self) -> Any:
        """The environment itself."""
        return self

    def reset(self, *, seed: Any = None, options: Any = None) -> Any:
        """Seeds its generator."""
        if seed is not None or self._random is None:
            self._random = np.random.default_rng(seed if seed is not None else 0)

    def close(self) -> None:
        """Nothing."""


def _gym(name: str) -> None:
    spaces = _module(
        f"{name}.spaces", Box=Space, Discrete=Space, MultiBinary=Space, MultiDiscrete=Space, Dict=dict, Space=Space
    )
    utils = _module(f"{name}.utils")
    checker = _module(f"{name}.utils.env_checker", check_env=lambda *a, **k: None)
    made = _module(name, Env=Env, spaces=spaces, Space=Space, utils=utils, Wrapper=object, make=Inert())
    made.__path__ = utils.__path__ = []  # type: ignore[attr-defined]
    utils.env_checker = checker
    wrappers = _module(f"{name}.wrappers")
    wrappers.__getattr__ = lambda attribute: lambda env, *a, **k: env  # type: ignore[method-assign]


def _quaternion(value: Any, kind: str) -> Any:
    found = np.asarray(plain(value), float).view(Tracked)
    found.note = Note(kind=kind)
    return found


class Rotation:
    """Stands in for scipy's rotations, whose quaternions are (x, y, z, w)."""

    def __init__(self, wxyz: Any) -> None:
        wxyz = np.asarray(wxyz, float)
        self.wxyz = wxyz / np.linalg.norm(wxyz, axis=-1, keepdims=True)

    @classmethod
    def from_quat(cls, quat: Any, scalar_first: bool = False) -> "Rotation":
        """A rotation from (x, y, z, w)."""
        import uses

        note = note_of(quat)
        if not scalar_first and note is not None and uses.is_quaternion(quat):
            SAID.event("quaternion_order", name="from_quat")
        quat = np.asarray(plain(quat), float)
        return cls(quat if scalar_first else np.roll(quat, 1, axis=-1))

    @classmethod
    def from_matrix(cls, matrix: Any) -> "Rotation":
        """A rotation from a 3 x 3 matrix."""
        import owners

        out = np.zeros(4)
        owners.CALL["mju_mat2Quat"](out, np.ascontiguousarray(plain(matrix), float).reshape(9))
        return cls(out)

    @classmethod
    def from_rotvec(cls, vector: Any, degrees: bool = False) -> "Rotation":
        """A rotation from axis times angle, rad."""
        vector = np.asarray(plain(vector), float) * (np.pi / 180 if degrees else 1)
        angle = np.linalg.norm(vector)
        axis = vector / angle if angle else np.array([1.0, 0, 0])
        return cls(np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * axis]))

    @classmethod
    def from_euler(cls, axes: str, angles: Any, degrees: bool = False) -> "Rotation":
        """A rotation from turns about axes; capitals mean the turned axes."""
        angles = np.atleast_1d(np.asarray(plain(angles), float)) * (np.pi / 180 if degrees else 1)
        made = cls([1.0, 0, 0, 0])
        for axis, angle in zip(axes, angles, strict=True):
            turn = cls.from_rotvec(angle * np.eye(3)["xyz".index(axis.lower())])
            made = made * turn if axis.isupper() else turn * made
        return made

    @classmethod
    def identity(cls) -> "Rotation":
        """The rotation that turns nothing."""
        return cls([1.0, 0, 0, 0])

    @classmethod
    def random(cls, num: Any = None, rng: Any = None, random_state: Any = None) -> "Rotation":
        """Some rotation."""
        generator = np.random.default_rng(rng if rng is not None else random_state)
        return cls(generator.normal(size=4))

    def as_quat(self, canonical: bool = False, scalar_first: bool = False) -> Any:
        """The rotation as (x, y, z, w)."""
        return _quaternion(self.wxyz, "wxyz") if scalar_first else _quaternion(np.roll(self.wxyz, -1, axis=-1), "xyzw")

    def as_matrix(self) -> Any:
        """The rotation as a 3 x 3 matrix."""
        import owners

        out = np.zeros(9)
        owners.CALL["mju_quat2Mat"](out, self.wxyz)
        return out.reshape(3, 3)

    def as_rotvec(self, degrees: bool = False) -> Any:
        """The rotation as axis times angle, rad."""
        w = self.wxyz if self.wxyz[0] >= 0 else -self.wxyz
        length = np.linalg.norm(w[1:])
        angle = 2 * np.arctan2(length, w[0]) * (180 / np.pi if degrees else 1)
        return w[1:] / length * angle if length else np.zeros(3)

    def as_euler(self, axes: str, degrees: bool = False) -> Any:
        """The rotation as turns about x, y and z."""
        m = self.as_matrix()
        angles = np.array(
            [np.arctan2(m[2, 1], m[2, 2]), -np.arcsin(np.clip(m[2, 0], -1, 1)), np.arctan2(m[1, 0], m[0, 0])]
        )
        if axes.lower() == "zyx":
            angles = angles[::-1]
        return angles * (180 / np.pi if degrees else 1)

    def apply(self, vectors: Any, inverse: bool = False) -> Any:
        """Turn vectors."""
        matrix = self.as_matrix()
        return np.asarray(plain(vectors), float) @ (matrix if inverse else matrix.T)

    def inv(self) -> "Rotation":
        """The inverse."""
        return Rotation(self.wxyz * [1, -1, -1, -1])

    def magnitude(self) -> float:
        """The angle, rad."""
        return float(np.linalg.norm(self.as_rotvec()))

    def __mul__(self, other: "Rotation") -> "Rotation":
        import owners

        out = np.zeros(4)
        owners.CALL["mju_mulQuat"](out, self.wxyz, other.wxyz)
        return Rotation(out)


class Viewer(Inert):
    """Stands in for a viewer whose window is closed after a while."""

    left = 300

    def is_running(self) -> bool:
        """Whether the window is open: it is for some frames."""
        self.left -= 1
        return self.left > 0


def install() -> None:
    """Install the stand-ins where the real packages are missing."""
    for name in ("gymnasium", "gym"):
        if _missing(name):
            _gym(name)
    if _missing("scipy"):
        spatial = _module("scipy.spatial", __path__=[])
        spatial.transform = _module("scipy.spatial.transform", Rotation=Rotation)
        _module("scipy", spatial=spatial, __path__=[])
    for name in ("imageio", "imageio.v2", "imageio.v3", "mediapy", "cv2", "tqdm", "pygame"):
        if _missing(name.split(".")[0]) or "." in name:
            _inert(name)
    if isinstance(sys.modules.get("tqdm"), types.ModuleType) and not hasattr(sys.modules["tqdm"], "__file__"):
        sys.modules["tqdm"].tqdm = lambda it=(), *a, **k: it  # type: ignore[attr-defined]
        sys.modules["tqdm"].trange = lambda *a, **k: range(*a)  # type: ignore[attr-defined]
    import mujoco

    viewer = _module("mujoco.viewer", launch=Inert(), launch_passive=lambda *a, **k: Viewer(), launch_from_path=Inert())
    mujoco.viewer = viewer  # type: ignore[attr-defined]
