"""Write what every object of a draft has, primitive or asset: its pose, its mass, and the joint that holds it."""

from ..model.plan.committed import Joint, Plan
from ..model.plan.layout import PlacedObject, Scene
from .python_text import Raw, call, exact
from .requirements import Needs


class Stances:
    """Keyword arguments of the calls that add the objects of a plan."""

    def __init__(self, plan: Plan, scene: Scene, needs: Needs) -> None:
        self.plan = plan
        self.scene = scene
        self.needs = needs
        self.parameters = plan.simulation_parameters
        self.joint_of: dict[str, Joint] = {}
        self.beside: dict[str, list[Joint]] = {}
        for joint in plan.topology.joints:
            self.joint_of.setdefault(joint.child, joint)
            if joint.beside:
                self.beside.setdefault(joint.child, []).append(joint)
            needs.joint_kinds[joint.name] = joint.type

    def common(self, name: str, placed: PlacedObject) -> dict:
        """Pose and mass, alike for every kind of object."""
        keywords: dict = {"pos": tuple(float(v) for v in placed.position)}
        if placed.deg_z:
            keywords["yaw_deg"] = float(placed.deg_z)
        if name in self.parameters.masses:
            keywords["mass"] = exact(self.parameters.masses[name])
        return keywords

    def joint(self, name: str) -> dict:
        """The attachment of an object, if the plan has one."""
        row = self.joint_of.get(name)
        if row is None:
            return {}
        parent = {} if row.parent == "world" else {"parent": row.parent}
        if row.type == "weld":
            return {**parent, "fixed": True}
        self.needs.use("joints")
        rows = list(dict.fromkeys((row, *self.beside.get(name, ()))))
        made = [self.one(joint) for joint in rows]
        return {**parent, "joint": made[0] if len(made) == 1 else Raw(f"({', '.join(made)})")}

    def one(self, row: Joint) -> Raw:
        """One joint, as `worldkit.joints` describes it."""
        keywords: dict = {}
        if row.anchor is not None:
            keywords["anchor"] = row.anchor
        if row.type != "ball":
            keywords["axis"] = row.axis
            unit = "deg" if row.type == "hinge" else "m"
            if row.range is not None:
                keywords[f"range_{unit}"] = row.range
            keywords |= {k: getattr(row, k) for k in ("stiffness", "frictionloss") if getattr(row, k)}
            if row.spring_rest:
                keywords[f"rest_{unit}"] = row.spring_rest
        if row.damping:
            keywords["damping"] = row.damping
        if row.stop is not None and row.type != "ball":
            stop = {"stop_s": row.stop.time_constant, "stop_restitution": row.stop.restitution}
            keywords |= {key: value for key, value in stop.items() if value is not None}
        made = call(f"joints.{row.type.capitalize()}", row.name, indent=0, **keywords)
        return Raw(" ".join(made.split()).replace("( ", "(").replace(", )", ")"))
