"""The meaning of the engine's arrays by the declarations of the installed build: what orders them and what they hold."""

import re
from typing import Any

import mujoco
import numpy as np
from mujoco.introspect import structs

KIND_OF_SIZE = {
    "nq": "qpos", "nv": "dof", "nu": "ctrl", "na": "act", "nbody": "body", "njnt": "joint", "ngeom": "geom",
    "nsite": "site", "ncam": "camera", "nlight": "light", "ntendon": "tendon", "nactuator": "actuator",
    "nout": "actuator output", "nsensor": "sensor", "nsensordata": "sensordata", "nmocap": "mocap", "neq": "equality",
    "nkey": "keyframe", "ncon": "contact", "nefc": "constraint row", "nmesh": "mesh", "nmat": "material",
    "ntex": "texture", "nhfield": "hfield", "nflex": "flex", "nflexvert": "flex vertex", "npair": "pair",
    "ntree": "tree", "nplastic": "plastic",
}  # fmt: skip
"""The kind of index that counts an array of such a length."""
_WORDS = {
    "body": "body", "root": "body", "parent": "body", "weld": "body", "targetbody": "body", "jnt": "joint", "geom": "geom",
    "site": "site", "cam": "camera", "mocap": "mocap", "mat": "material", "mesh": "mesh", "tendon": "tendon",
    "qpos": "qpos", "dof": "dof", "ctrl": "ctrl", "act": "act", "out": "actuator output", "actuator": "actuator",
    "tree": "tree", "plastic": "plastic", "efc": "constraint row",
}  # fmt: skip


def _extents(struct: str) -> dict[str, tuple[Any, ...]]:
    found = {}
    for field in structs.STRUCTS[struct].fields:
        extent = getattr(field, "array_extent", None)
        if extent is not None:
            found[field.name] = tuple(extent)
    return found


DATA, MODEL = _extents("mjData"), _extents("mjModel")
DOCS = {f.name: str(getattr(f, "doc", "")) for s in ("mjData", "mjModel") for f in structs.STRUCTS[s].fields}
ORDER = {name: KIND_OF_SIZE.get(extent[0]) for name, extent in {**MODEL, **DATA}.items()}
"""For each array: what its first index counts."""


def _holds(name: str) -> str | None:
    if name == "sensor_adr":
        return "sensordata"
    if name == "dof_parentid":
        return "dof"
    match = re.search(r"_([a-z]+?)(?:id|adr)$", name)
    return _WORDS.get(match[1]) if match else None


HOLDS = {name: _holds(name) for name in (*MODEL, *DATA)}
"""For each array of integers: what its numbers count."""
OF_OBJECT = {
    "BODY": "body", "XBODY": "body", "JOINT": "joint", "DOF": "dof", "GEOM": "geom", "SITE": "site", "CAMERA": "camera",
    "LIGHT": "light", "MESH": "mesh", "HFIELD": "hfield", "TEXTURE": "texture", "MATERIAL": "material", "PAIR": "pair",
    "EQUALITY": "equality", "TENDON": "tendon", "ACTUATOR": "actuator", "SENSOR": "sensor", "KEY": "keyframe",
}  # fmt: skip
ADDRESSES = {"qpos", "dof", "ctrl", "act", "sensordata", "constraint row", "actuator output", "plastic"}
"""Kinds from which a program may count on: an address, and what follows it."""
WORLD = {
    name for name, extent in DATA.items() if extent[1:] == (3,) and "Cartesian" in DOCS[name]
} | {"subtree_com", "subtree_linvel", "subtree_angmom", "mocap_pos", "xaxis", "xanchor"}  # fmt: skip
"""Vectors given in the world frame."""
TURNS = {"xmat": "body", "ximat": "inertia", "geom_xmat": "geom", "site_xmat": "site", "cam_xmat": "camera"}
"""Matrices that turn a local frame's vectors into the world's."""
PER_DOF = {name for name, extent in DATA.items() if extent == ("nv",) and not name.startswith(("map_", "efm_"))}
QUATERNIONS = {name for name in (*DATA, *MODEL) if name.endswith("quat") and name != "geom_quat_"}
LOCAL_SENSORS = {
    int(getattr(mujoco.mjtSensor, f"mjSENS_{n}"))
    for n in ("ACCELEROMETER", "VELOCIMETER", "GYRO", "FORCE", "TORQUE", "MAGNETOMETER")
}
FREE, BALL = int(mujoco.mjtJoint.mjJNT_FREE), int(mujoco.mjtJoint.mjJNT_BALL)
RADIANS = {"jnt_range", "actuator_ctrlrange", "qpos", "qpos0", "key_qpos"}


class Layout:
    """What the coordinates of one model mean."""

    def __init__(self, model: Any, raw: Any) -> None:
        self.model = model
        get = lambda name: np.asarray(raw(model, name))  # noqa: E731
        kinds, qadr, dadr, bodies = get("jnt_type"), get("jnt_qposadr"), get("jnt_dofadr"), get("jnt_bodyid")
        self.quats: list[frozenset[int]] = []
        self.turning: dict[int, tuple[str, int]] = {}
        self.linear: set[int] = set()
        self.hinges = {int(q) for k, q in zip(kinds, qadr, strict=True) if k == 3}
        for kind, q, d, body in zip(kinds, qadr, dadr, bodies, strict=True):
            if kind in (FREE, BALL):
                first = int(q) + (3 if kind == FREE else 0)
                self.quats.append(frozenset(range(first, first + 4)))
                start = int(d) + (3 if kind == FREE else 0)
                self.turning.update({start + i: ("body", int(body)) for i in range(3)})
            if kind == FREE:
                self.linear.update(range(int(d), int(d) + 3))
        axes, pos0, low = get("jnt_axis"), get("body_pos"), get("qpos0")
        self.lifts = {
            int(q): float(pos0[b][2])
            for k, q, b, axis in zip(kinds, qadr, bodies, axes, strict=True)
            if k == 2 and abs(axis[2]) > 0.99 and abs(pos0[b][2]) > 0.05 and abs(low[q] - pos0[b][2]) > 0.05
        }
        """Vertical slide joints by address: the height of their body where they read zero, m."""
        self.in_quat = frozenset().union(*self.quats) if self.quats else frozenset()
        self.sensor_frame: dict[int, tuple[str, int]] = {}
        for kind, adr, dim, obj in zip(
            get("sensor_type"), get("sensor_adr"), get("sensor_dim"), get("sensor_objid"), strict=True
        ):
            if int(kind) in LOCAL_SENSORS:
                self.sensor_frame.update({int(adr) + i: ("site", int(obj)) for i in range(int(dim))})
        n = {kind: int(getattr_raw(model, size, raw)) for size, kind in KIND_OF_SIZE.items() if kind in _MAPPED}
        joint_of = get("actuator_trnid")[:, 0] if n["actuator"] else np.zeros(0, int)
        on_joint = bool((get("actuator_trntype") == 0).all()) if n["actuator"] else False
        self.maps: dict[tuple[str, str], Any] = {
            ("joint", "qpos"): qadr,
            ("joint", "dof"): dadr,
            ("actuator", "ctrl"): get("actuator_ctrladr"),
            ("actuator", "act"): get("actuator_actadr"),
            ("actuator", "actuator output"): get("actuator_outadr"),
            ("sensor", "sensordata"): get("sensor_adr"),
            ("body", "mocap"): get("body_mocapid"),
            ("qpos", "dof"): np.arange(n["qpos"]) if n["qpos"] == n["dof"] else np.zeros(n["qpos"]) - 1,
        }
        if on_joint and n["ctrl"] == n["actuator"]:
            self.maps[("ctrl", "dof")] = self.maps[("actuator", "dof")] = dadr[joint_of]
            self.maps[("ctrl", "qpos")] = self.maps[("actuator", "qpos")] = qadr[joint_of]
            self.maps[("ctrl", "joint")] = self.maps[("actuator", "joint")] = joint_of
            self.maps[("ctrl", "act")] = get("actuator_actadr")
            self.maps[("ctrl", "actuator output")] = get("actuator_outadr")

    def same(self, one: str, other: str) -> bool | None:
        """Whether two kinds number alike in this model, so that one may stand for the other; None if they never do."""
        found = self.maps.get((one, other), self.maps.get((other, one)))
        return None if found is None else bool(len(found)) and bool((np.asarray(found) == np.arange(len(found))).all())


_MAPPED = {"qpos", "dof", "ctrl", "actuator", "act", "joint"}


def getattr_raw(model: Any, name: str, raw: Any) -> int:
    """One of a model's sizes, unwatched."""
    return int(raw(model, name))
