"""A packaged model with the actuators that its control needs: servos in a home pose, torque motors, or rotors.

One that walks stands in its home pose, which is also what its joints' angles are counted from.
"""

import math
import re
import xml.etree.ElementTree as ElementTree

from .arms import ARMS, Arm
from .drones import DRONES, Drone
from .gaits import GAITS, Gait

PLAIN = frozenset(("fromto", "euler", "axisangle", "xyaxes", "zaxis"))
"""What a geom may not say of its pose, for it to be carried to another body."""
TEAM = "team"
"""The material of what wears a team's colour: without it, it has the look of the plan's row."""
TURNS = ("euler", "axisangle", "xyaxes", "zaxis")


def model(key: str, text: str) -> str:
    """The MJCF of a robot with what drives it; of one that nothing here drives, as it is.

    Args:
        key: of the robot.
        text: its MJCF, whole.

    Raises:
        ValueError: a joint or a site that is to be driven is not there.
    """
    tree = ElementTree.fromstring(text)
    if key in GAITS:
        _standing(tree, GAITS[key])
    elif key in ARMS:
        _armed(tree, ARMS[key])
    elif key in DRONES:
        _rotored(tree, DRONES[key])
    else:
        return text
    ElementTree.indent(tree, " ")
    return ElementTree.tostring(tree, encoding="unicode") + "\n"


def _standing(tree: ElementTree.Element, gait: Gait) -> None:
    """The model in its home pose, with the gait's servos in place of the motors that it has."""
    unit = 1.0 if any(one.get("angle") == "radian" for one in tree.iter("compiler")) else math.degrees(1.0)
    axes = _axes(tree)
    joints = dict(zip(gait.joints, zip(gait.home, gait.servos, strict=True), strict=True))
    seen = set()
    for body in tree.iter("body"):
        for joint in body.findall("joint"):
            name = joint.get("name", "")
            if name not in joints:
                continue
            angle, servo = joints[name]
            seen.add(name)
            joint.set("ref", f"{angle * unit:.9g}")
            for key, value in (("armature", servo.armature), ("frictionloss", servo.friction), ("damping", 0.0)):
                joint.set(key, f"{value:g}")
            if any(key in body.attrib for key in TURNS) or (joint.get("pos") or "0 0 0").split() != ["0"] * 3:
                raise ValueError(f"body {body.get('name')} is turned itself, which is not read here")
            body.set("quat", _turned(body.get("quat", "1 0 0 0"), axes[name], angle))
    if missing := sorted(set(joints) - seen):
        raise ValueError(f"it has no joint {missing[0]}")
    for geom in tree.iter("geom"):
        if geom.get("material") == TEAM:
            del geom.attrib["material"]
        geom.attrib.pop("solimp", None)  # so soft in some that a foot sinks in by more than its radius
    servos = _emptied(tree)
    for name, (_, servo) in joints.items():
        ElementTree.SubElement(
            servos, "position", name=gait.servo(name), joint=name, kp=f"{servo.gain:g}", kv=f"{servo.damping:g}",
            forcerange=f"{-servo.limit:g} {servo.limit:g}",
        )  # fmt: skip


def _turned(quat: str, axis: tuple[float, ...], angle: float) -> str:
    """A body's turn followed by that of its joint."""
    import mujoco
    import numpy as np

    turn, made = np.zeros(4), np.zeros(4)
    mujoco.mju_axisAngle2Quat(turn, np.array(axis, dtype=float), angle)
    mujoco.mju_mulQuat(made, np.array(quat.split(), dtype=float), turn)
    return " ".join(f"{part:.9g}" for part in made)


def _armed(tree: ElementTree.Element, arm: Arm) -> None:
    """The model with a torque motor at each joint and at the first finger."""
    for body in tree.findall("worldbody/body"):
        _fused(body)
    joints = {joint.get("name"): joint for joint in tree.iter("joint") if joint.get("name")}
    motors = _emptied(tree)
    for name, limit, armature in zip(arm.driven, arm.limits, arm.armatures, strict=True):
        if name not in joints:
            raise ValueError(f"it has no joint {name}")
        joints[name].set("armature", f"{armature:g}")
        most = f"{-limit:g} {limit:g}"
        ElementTree.SubElement(motors, "motor", name=arm.motor(name), joint=name, forcerange=most)
    for compiler in tree.findall("compiler"):
        compiler.set("autolimits", "true")


def _fused(body: ElementTree.Element) -> None:
    """Give a body the geoms of those that are fixed to it without an `inertial`: what touches is then what is seen.

    Where the body has an `inertial`, that holds all of the weight, and shapes made to be touched no longer add theirs.
    """
    for part in list(body.findall("body")):
        _fused(part)
        if {child.tag for child in part} <= {"geom", "camera"} and all(PLAIN.isdisjoint(geom.attrib) for geom in part):
            for geom in part.findall("geom"):
                _carried(geom, part)
                body.append(geom)
            body.remove(part)


def _carried(geom: ElementTree.Element, part: ElementTree.Element) -> None:
    """Pose a geom in the frame of the body that its own is in."""
    import mujoco
    import numpy as np

    (at, turn), (inner, own) = (
        [np.array(one.get(key, usual).split(), dtype=float) for key, usual in (("pos", "0 0 0"), ("quat", "1 0 0 0"))]
        for one in (part, geom)
    )
    mujoco.mju_normalize4(turn)
    mujoco.mju_normalize4(own)
    moved, turned = np.zeros(3), np.zeros(4)
    mujoco.mju_rotVecQuat(moved, inner, turn)
    mujoco.mju_mulQuat(turned, turn, own)
    geom.set("pos", " ".join(f"{value:.9g}" for value in at + moved))
    geom.set("quat", " ".join(f"{value:.9g}" for value in turned))


def _rotored(tree: ElementTree.Element, drone: Drone) -> None:
    """The model with a thrust at each rotor, and the torque of its drag, in place of what it has."""
    rotors = _emptied(tree)
    sites = {site.get("name") for site in tree.iter("site")}
    for rotor in drone.rotors:
        if rotor.site not in sites:
            raise ValueError(f"it has no site {rotor.site}")
        ElementTree.SubElement(
            rotors, "motor", name=rotor.name, site=rotor.site, gear=f"0 0 1 0 0 {rotor.spin * drone.drag_m:g}",
            ctrlrange=f"0 {drone.most_n:g}",
        )  # fmt: skip
    for body in tree.iter("body"):
        for geom in list(body.findall("geom")):
            if (geom.get("name") or "").startswith("led_") or geom.get("name") == "col_sphere":
                body.remove(geom)  # lights that are off; a sphere that reaches far below what is seen
            elif geom.get("name") == "col_box":
                geom.set("contype", "1")
                geom.set("conaffinity", "1")
                geom.set("condim", "3")
            geom.set("mass", "0")  # its `inertial` holds all of it


def _emptied(tree: ElementTree.Element) -> ElementTree.Element:
    """A section for actuators, in place of the model's own; its keyframes, which count those, go too."""
    for section in (*tree.findall("actuator"), *tree.findall("keyframe")):
        tree.remove(section)
    return ElementTree.SubElement(tree, "actuator")


def _axes(tree: ElementTree.Element) -> dict[str, tuple[float, ...]]:
    """The axis of each joint, as its classes say: the engine is asked, without the meshes."""
    import mujoco

    bare = ElementTree.fromstring(ElementTree.tostring(tree))
    for parent in list(bare.iter()):
        for child in list(parent):
            if child.tag in ("mesh", "texture", "material", "sensor", "actuator", "keyframe", "contact") or child.get(
                "mesh"
            ):
                parent.remove(child)
            elif "material" in child.attrib:
                del child.attrib["material"]
    text = re.sub(r' type="mesh"', "", ElementTree.tostring(bare, encoding="unicode"))
    spec = mujoco.MjSpec.from_string(text)
    return {joint.name: tuple(map(float, joint.axis)) for joint in spec.joints}
