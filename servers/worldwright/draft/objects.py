"""The things of a world, each with its pose, mass, look, surface and joint: primitives here, assets in `imports`."""

from dataclasses import fields

from ..model.errors import PlanError
from ..model.plan import AssetRow, Joint, Plan, SceneObject
from ..model.scene import PlacedObject, Scene
from . import imports
from .needs import Needs
from .source import Raw, call, comment, constant_name


class Objects:
    """Writes the objects of a plan, parents before children, otherwise in plan order."""

    def __init__(self, plan: Plan, scene: Scene, needs: Needs) -> None:
        self.plan = plan
        self.scene = scene
        self.needs = needs
        self.parameters = plan.simulation_parameters
        self.joint_of: dict[str, Joint] = {}
        self.loops = plan.topology.loops()
        for joint in plan.topology.joints:
            self.joint_of.setdefault(joint.child, joint)
            needs.joint_kinds[joint.name] = joint.type

    def written(self) -> str:
        """Every scene object and asset."""
        parts = [
            self.scene_object(item) if isinstance(item, SceneObject) else imports.written(self, item)
            for item in self.ordered()
        ]
        parts += [self.loop(joint) for joint in self.loops]
        if self.plan.plan_type == "fsi_in_scene":
            self.needs.leave("the plan couples a fluid with solids", "the fluid's medium and its coupling")
            parts.append(comment("AUTHOR: add the fluid and its coupling to the solids here."))
        return "\n".join(part for part in parts if part)

    def ordered(self) -> list[SceneObject | AssetRow]:
        """Plan order, except that a joint's parent comes before its child."""
        rows: list[SceneObject | AssetRow] = [*self.plan.scene_objects, *self.plan.assets]
        by_name = {name: row for row in rows for name in getattr(row, "instances", (row.name,))}
        done: dict[str, SceneObject | AssetRow] = {}

        def visit(row: SceneObject | AssetRow, trail: tuple[str, ...]) -> None:
            if row.name in done:
                return
            for name in getattr(row, "instances", (row.name,)):
                joint = self.joint_of.get(name)
                parent = by_name.get(joint.parent) if joint is not None else None
                if parent is None or parent is row:
                    continue
                if parent.name in trail:
                    cycle = " -> ".join((*trail, parent.name))
                    raise PlanError(f"the joints form a cycle: {cycle}", next_move="make one of its bodies the root")
                visit(parent, (*trail, parent.name))
            done[row.name] = row

        for row in rows:
            visit(row, (row.name,))
        return list(done.values())

    def scene_object(self, row: SceneObject) -> str:
        """One primitive, or one compound of several."""
        self.needs.use("bodies")
        placed = self.scene[row.name]
        x, _, z = row.size
        shapes: dict[str, tuple[str, dict]] = {
            "box": ("box", {"size": row.size}),
            "plane": ("box", {"size": row.size}),
            "sphere": ("sphere", {"diameter": x}),
            "cylinder": ("cylinder", {"diameter": x, "height": z}),
            "capsule": ("capsule", {"diameter": x, "height": z}),
            "ellipsoid": ("ellipsoid", {"size": row.size}),
            "compound": ("compound", {"parts": Raw(f"{constant_name(row.name).lower()}_parts")}),
            "box_container": ("container", {"size": row.size, "wall": row.wall_thickness}),
        }
        function, keywords = shapes[row.primitive]
        keywords |= self.common(row.name, placed)
        if row.deg_x:
            keywords["tilt_deg"] = row.deg_x
        if row.hollow:
            keywords["hollow"] = True
        if row.look:
            keywords["look"] = row.look
        if row.material:
            keywords["surface"] = Raw(constant_name(row.material))
        if row.visual_only:
            keywords["visual_only"] = True
        elif row.fixed or not row.dynamic:
            keywords["fixed"] = True
        keywords |= self.joint(row.name)
        note = row.description or row.role
        lines = [comment(note)] if note else []
        if row.parts:
            lines.append(self.parts(row))
        return "\n".join([*lines, call(f"bodies.{function}", Raw("spec"), row.name, **keywords)])

    def parts(self, row: SceneObject) -> str:
        """The parts of a compound as a table of their own."""
        self.needs.use("parts")
        lines = [f"    {constant_name(row.name).lower()}_parts = ("]
        for part in row.parts:
            made = part.part()
            keywords: dict = {"size": made.size}
            for item in fields(made):
                value = getattr(made, item.name)
                if item.name not in ("name", "shape", "size") and value != item.default:
                    keywords[item.name] = value
            if part.look:
                keywords["look"] = part.look
            if part.material:
                keywords["surface"] = Raw(constant_name(part.material))
            lines.append(call("parts.Part", made.name, made.shape, indent=8, tail=",", **keywords))
        return "\n".join([*lines, "    )"])

    def common(self, name: str, placed: PlacedObject) -> dict:
        """Pose and mass, the same for every kind of object."""
        keywords: dict = {"pos": tuple(float(v) for v in placed.position)}
        if placed.deg_z:
            keywords["yaw_deg"] = float(placed.deg_z)
        if name in self.parameters.masses:
            keywords["mass"] = self.parameters.masses[name]
        return keywords

    def loop(self, row: Joint) -> str:
        """A joint that closes a loop, as constraints between bodies that are there."""
        extras = [key for key in ("range", "stiffness", "damping", "frictionloss") if getattr(row, key)]
        if row.type == "slide" or extras:
            why = f"a slide joint or one with {' and '.join(extras)}" if extras else "a slide joint"
            self.needs.leave(
                f"joint {row.name} closes a loop on {row.child} as {why}, which no constraint of the engine is",
                f"list it before the other joint of {row.child}, so that this other one closes the loop",
            )
            return comment(
                f"AUTHOR: joint {row.name} closes a loop as {why}: list it first in the plan, or build it here."
            )
        self.needs.use("loops")
        keywords: dict = {"child": row.child} | ({} if row.parent == "world" else {"parent": row.parent})
        if row.type != "weld" and row.anchor is not None:
            keywords["anchor"] = row.anchor
        if row.type == "hinge":
            keywords["axis"] = row.axis
        return call(f"loops.{row.type}", Raw("spec"), row.name, **keywords)

    def joint(self, name: str) -> dict:
        """How an object is attached, when the plan says so."""
        row = self.joint_of.get(name)
        if row is None:
            return {}
        parent = {} if row.parent == "world" else {"parent": row.parent}
        if row.type == "weld":
            return {**parent, "fixed": True}
        self.needs.use("joints")
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
        made = call(f"joints.{row.type.capitalize()}", row.name, indent=0, **keywords)
        return {**parent, "joint": Raw(" ".join(made.split()).replace("( ", "(").replace(", )", ")"))}
