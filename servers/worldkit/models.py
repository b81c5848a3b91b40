"""A URDF or MJCF model as an object of a world: its text, attached at a planned pose under a planned name.

    ARM = '<robot name="arm"> … </robot>'
    models.attach(spec, ARM, name="arm", pos=(0, 0, 1.05), fixed=True)

The text is part of the program, so that the program's evidence covers it. Its root body becomes `arm`; everything else in it
is called `arm_` and its own name: joint `shoulder` is `arm_shoulder`. `pos` is the centre of the box around the model in its
own rest pose, as for every object of a plan.
"""

import sys
import xml.etree.ElementTree as ElementTree
from collections.abc import Collection, Sequence
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import beside_program, model_box, model_files
from .bodies import pose_below
from .joints import Joint
from .joints import attach as attach_joint
from .model_looks import dress
from .model_references import outside
from .shared_meshes import share

if TYPE_CHECKING:
    import mujoco

Vec3 = tuple[float, float, float]
MOST_BYTES = 2_000_000
MOST_MEMORY = 6 << 30
"""Address space in which `main` reads a model, bytes."""
_TAGS = """robot link joint inertial visual collision geometry origin mass inertia box sphere cylinder capsule mesh material
color texture parent child axis limit dynamics mimic safety_controller calibration mujoco transmission gazebo"""
URDF_TAGS = frozenset(_TAGS.split())
"""Elements that a URDF may have; MuJoCo ignores any other silently."""


def attach(
    spec: "mujoco.MjSpec",
    text: str,
    *,
    name: str,
    pos: Vec3,
    yaw_deg: float = 0.0,
    fixed: bool = False,
    surface: dict[str, Any] | None = None,
    look: str | None = None,
    folder: str | None = None,
    files: Sequence[str] = (),
    actuators: Collection[str] | None = None,
    parent: str | None = None,
    joint: Joint | None = None,
) -> "mujoco.MjsBody":
    """Add the model of `text` to the world and return its root body, which is called `name`.

    Only the root body and what hangs on it come along, with their actuators, sensors, tendons and equalities; floors,
    lights, cameras, keyframes and options stay behind: the world has its own.

    Args:
        spec: the world under construction.
        text: a URDF (`<robot>`) or MJCF (`<mujoco>`) model with exactly one root body.
        name: of the root body; everything else is called `name_` and its own name.
        pos: world position of the centre of the box around it in its rest pose, metres.
        yaw_deg: rotation about world z, degrees counter-clockwise from +X.
        fixed: it stands where it is put: a free joint of its root is taken away. Otherwise a root without a joint gets a
            free one. Links next to a fixed root do not collide with it, as they would not with a free one.
        surface: contact properties of all its colliding geoms, from `worldkit.contacts.surface`; None: its own.
        look: of geoms without a material of their own; None: `plastic_white`.
        folder: folder of the catalog in which its mesh and texture files lie.
        files: instead, the files beside the program that it reads, as its text names them (`worldkit.model_files.whole`).
        actuators: its own names of those that come along; None: all of them.
        parent: name of the body its root belongs to; None is the world.
        joint: how its root moves against its parent, besides joints of its own.

    Raises:
        ValueError: the text is no model, has several roots, or names files that are in neither `folder` nor `files`; the message says which.
    """
    import mujoco

    child = parsed(text, name, folder, files)
    rest = model_box.of(text, child, lambda: parsed(text, name, folder, files), name)
    root = model_box.root(child, name)
    model_box.adopt(child, spec)
    _strip(child, root, fixed or parent is not None or joint is not None)
    for actuator in [] if actuators is None else [a for a in child.actuators if a.name not in actuators]:
        child.delete(actuator)
    for number, tie in enumerate(child.equalities):
        tie.name = tie.name or f"tie_{number}"  # a plan's own world has it too, and is compared with this one by names
    before = root.name
    owner, pose, quat = pose_below(spec, name, pos, yaw_deg, parent)
    body = owner.add_frame().attach_body(root, f"{name}_", "")
    model_box.put(body, rest, pose, quat)
    if joint is not None:
        attach_joint(body, joint)
    elif not fixed and parent is None and not body.joints:
        body.add_freejoint()
    for own in body.joints:
        if own.type == mujoco.mjtJoint.mjJNT_FREE:
            own.name = name
    _rename(spec, f"{name}_{before}", body, name)
    share(spec, f"{name}_")
    for part in (body, *_below(body)):
        _seen_once(part)
        for number, geom in enumerate(part.geoms):
            geom.name = geom.name or f"{part.name}/{number}"
            dress(spec, geom, f"{name}_", look, surface)
    if fixed:
        for part in body.bodies:
            spec.add_exclude(bodyname1=name, bodyname2=part.name)
    return body


def facts(text: str, name: str, folder: str | None = None, files: Sequence[str] = (), root: str = "") -> dict[str, Any]:
    """What a plan needs to know of a model, with the names that it gets in the world; its `files` lie below `root`.

    Returns:
        `extents` (3, m, of its rest pose), `mass` (kg), `bodies`, `actuators` and `geoms` (names), `joints` (name to kind:
        hinge, slide, ball, free), `moves` (whether any part moves against its root).
    """
    with beside_program.below(Path(root)) if root else nullcontext():
        return _facts(text, name, folder, files)


def _facts(text: str, name: str, folder: str | None, files: Sequence[str]) -> dict[str, Any]:
    import mujoco

    spec = mujoco.MjSpec()
    body = attach(spec, text, name=name, pos=(0, 0, 0), folder=folder, files=files)
    model = spec.compile()
    rest = model_box.of(text, parsed(text, name, folder, files), lambda: parsed(text, name, folder, files), name)
    kinds = {mujoco.mjtJoint(k): word for k, word in enumerate(("free", "ball", "slide", "hinge"))}
    joints = {model.joint(j).name: kinds[mujoco.mjtJoint(model.jnt_type[j])] for j in range(model.njnt)}
    return {
        "extents": [round(float(v), 6) for v in rest.extents],
        "mass": float(model.body_subtreemass[model.body(body.name).id]),
        "bodies": [model.body(b).name for b in range(1, model.nbody)],
        "geoms": [model.geom(g).name for g in range(model.ngeom)],
        "actuators": [model.actuator(a).name for a in range(model.nu)],
        "joints": joints,
    }


def parsed(text: str, name: str, folder: str | None = None, files: Sequence[str] = ()) -> "mujoco.MjSpec":
    """The model as a spec of its own, its files found in the catalog or beside the program.

    Raises:
        ValueError: it is not a model, has a tag that is none, or names files that are not there.
    """
    import mujoco

    _checked(text, name)
    try:
        child = mujoco.MjSpec.from_string(text)
    except ValueError as error:
        raise ValueError(f"model {name}: {' '.join(str(error).split())}") from error
    for item in (*child.meshes, *child.textures, *child.hfields):
        if not item.file:
            continue
        if item.file in files:
            beside_program.give(item, name)
        elif folder is None:
            raise ValueError(
                f"model {name}: it reads the file {item.file!r}, which is not among its `files`: "
                "use primitives, or `worldkit.model_files.whole`, which finds and names them"
            )
        else:
            item.file = str(_found(item.file, child, name, folder))
    return child


def standing(file: str, root: str = "") -> "mujoco.MjSpec":
    """A URDF file as a world of its own, with its meshes wherever they lie below a folder (default: the one above its own).

    Raises:
        ValueError: it is no model, or a file of it is missing.
    """
    path = Path(file)
    home = Path(root) if root else path.parent.parent
    made = model_files.whole(path, home)
    with beside_program.below(home.resolve()):
        return parsed(made.text, path.stem, files=made.files)


def _checked(text: str, name: str) -> None:
    """Refuse what the engine would ignore silently, or read from elsewhere."""
    if len(text.encode()) > MOST_BYTES:
        raise ValueError(f"model {name}: it is larger than {MOST_BYTES // 1_000_000} MB")
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise ValueError(f"model {name}: it declares a document type; remove it")
    try:
        tree = ElementTree.fromstring(text.strip())
    except ElementTree.ParseError as error:
        raise ValueError(f"model {name}: it is not XML: {error}") from error
    if tree.tag not in ("robot", "mujoco"):
        raise ValueError(f"model {name}: its root is <{tree.tag}>; a URDF starts with <robot>, an MJCF with <mujoco>")
    for line, found in outside(text):
        raise ValueError(
            f"model {name}: line {line}: {found} reads another file; write its content there. Files are named by the `file` of "
            "<mesh>, <texture> and <hfield> alone, and lie in the catalog"
        )
    waiting = [tree] if tree.tag == "robot" else []
    while waiting:
        node = waiting.pop()
        if node.tag not in URDF_TAGS:
            known = ", ".join(sorted(URDF_TAGS))
            raise ValueError(f"model {name}: a URDF has no element <{node.tag}>; known: {known}")
        if node.tag not in ("transmission", "gazebo", "mujoco"):  # not read, or the engine's own
            waiting += list(node)


def _found(file: str, child: "mujoco.MjSpec", name: str, folder: str) -> Path:
    """A file of a model in the catalog, or in the user's own folder of assets."""
    from .assets.catalog import take
    from .data_folders import catalog_root, own_root

    stem = file.removeprefix("package://")
    for root in (catalog_root(), own_root()):
        home = (root / folder).resolve()
        for place in (home / (child.meshdir or "") / stem, home / stem, home / Path(stem).name):
            path = place.resolve()
            if path.is_file() and path.is_relative_to(home):
                if path.suffix.lower() not in (".obj", ".png"):
                    raise ValueError(
                        f"model {name}: {file} is neither .obj nor .png, which are all that evidence covers: convert it"
                    )
                take(path.relative_to(root.resolve()).parts[0])
                return path
    raise ValueError(f"model {name}: its file {file!r} is not in the catalog's folder {folder!r}")


def _below(body: "mujoco.MjsBody") -> "list[mujoco.MjsBody]":
    return [found for part in body.bodies for found in (part, *_below(part))]


def _seen_once(part: "mujoco.MjsBody") -> None:
    """Where a URDF's link has shapes to be seen, those to be touched are not drawn over them."""
    if any(geom.group == 1 and not geom.contype and not geom.conaffinity for geom in part.geoms):
        for geom in part.geoms:
            if geom.group == 0 and (geom.contype or geom.conaffinity):
                geom.group = 3


def _strip(child: "mujoco.MjSpec", root: "mujoco.MjsBody", fixed: bool) -> None:
    """Remove cameras, lights and keyframes, which the world has of its own, and the free joint of a fixed root."""
    import mujoco

    for item in (*child.cameras, *child.lights, *child.keys):
        child.delete(item)
    for joint in list(root.joints) if fixed else []:
        if joint.type == mujoco.mjtJoint.mjJNT_FREE:
            child.delete(joint)


def _rename(spec: "mujoco.MjSpec", before: str, body: "mujoco.MjsBody", after: str) -> None:
    """Give the root its planned name, wherever it is referred to."""
    import mujoco

    body.name = after
    bodies = (mujoco.mjtObj.mjOBJ_BODY, mujoco.mjtObj.mjOBJ_XBODY)
    referring: list[tuple[Any, tuple[str, ...]]] = [(item, ("bodyname1", "bodyname2")) for item in spec.excludes]
    referring += [(item, ("name1", "name2")) for item in spec.equalities if item.objtype in bodies]
    referring += [(item, ("objname",)) for item in spec.sensors if item.objtype in bodies]
    referring += [(item, ("refname",)) for item in spec.sensors if item.reftype in bodies]
    referring += [(item, ("target",)) for item in spec.actuators if item.trntype == mujoco.mjtTrn.mjTRN_BODY]
    for item, keys in referring:
        for key in keys:
            if getattr(item, key) == before:
                setattr(item, key, after)


def _limit_memory() -> None:
    """Let meshes of a stranger end this process, not the machine; where there is no such limit, it stays as it is."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        _, most = resource.getrlimit(resource.RLIMIT_AS)
        resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY if most < 0 else min(MOST_MEMORY, most), most))


def main() -> None:
    """Read the arguments of `facts` as JSON on standard input, and write its result on standard output."""
    import json
    import warnings

    warnings.simplefilter("ignore")
    _limit_memory()
    try:
        answer = facts(**json.load(sys.stdin))
    except ValueError as error:
        answer = {"error": str(error)}
    except MemoryError:
        answer = {"error": f"it needs more than {MOST_MEMORY >> 30} GB of memory; reduce its meshes"}
    json.dump(answer, sys.stdout)


if __name__ == "__main__":
    main()
