"""Write the things of a world, each with pose, mass, look, surface and joint: primitives here, assets in `imports`."""

import textwrap
from dataclasses import fields

from ..model.errors import PlanError
from ..model.plan.committed import AssetRow, Joint, Plan, SceneObject
from ..model.plan.declared_inputs import Beside
from ..model.plan.formed import arguments
from ..model.plan.layout import Scene
from . import breakables_text, imports, softs_text
from .laws_text import Laws
from .python_text import Raw, call, comment, constant_name, literal
from .requirements import Needs
from .stances import Stances


class Objects(Stances):
    """Writes the objects of a plan, parents before children, otherwise in plan order."""

    def __init__(self, plan: Plan, scene: Scene, needs: Needs, laws: Laws) -> None:
        super().__init__(plan, scene, needs)
        self.loops = plan.topology.loops()
        self.laws = laws
        beside = [row.solver for row in self.parameters.interventions if row.solver]
        self.waters = {water.shown_by: water for water in beside if water.container and water.shown_by}
        """What shows the water in a container, by its name."""
        self.alike = {name: family for family, names in plan.families.items() if self.equal(names) for name in names}
        """The family of each copy that differs from the others by its name and pose alone."""

    def written(self) -> str:
        """The text of every scene object and asset."""
        parts, looped = [], set()
        of = {name: whole for whole in self.plan.broken for name in self.plan.families[whole]}
        for item in self.ordered():
            if not isinstance(item, SceneObject):
                parts.append(imports.written(self, item))
            elif item.name in self.waters:
                continue
            elif self.laws.moves(item):
                parts.append(self.laws.surface(item))
            elif (broken := of.get(item.name)) is not None:
                if broken not in looped:
                    looped.add(broken)
                    parts.append(breakables_text.written(self.plan, self.scene, self.needs, self.plan.broken[broken]))
            elif item.soft is not None:
                parts.append(softs_text.written(self, item))
            elif (family := self.alike.get(item.name)) is None:
                parts.append(self.scene_object(item))
            elif family not in looped:
                looped.add(family)
                parts.append(self.copies(item, family))
        # What is filled is there before, wherever its row stands.
        parts += [self.filled(row, self.waters[row.name]) for row in self.plan.scene_objects if row.name in self.waters]
        parts += [self.loop(joint) for joint in self.loops]
        if self.plan.plan_type == "fsi_in_scene":
            self.needs.leave("the plan couples a fluid with solids", "the fluid's medium and its coupling")
            parts.append(comment("AUTHOR: add the fluid and its coupling to the solids here."))
        return "\n".join(part for part in parts if part)

    def filled(self, row: SceneObject, water: Beside) -> str:
        """The text of the water in a container."""
        self.needs.use("waters")
        constant = self.parameters.constants.get(water.constants.get("level", ""))
        level = None if constant is None else Raw(constant_name(water.constants["level"]))
        keywords: dict = {"container": water.container, "level": level}
        if row.look:
            keywords["look"] = row.look
        note = row.description or row.role
        lines = [comment(note)] if note else []
        return "\n".join([*lines, call("waters.fill", Raw("spec"), row.name, **keywords)])

    def equal(self, names: tuple[str, ...]) -> bool:
        """Whether copies are loose or fixed bodies of one mass, on which nothing hangs by name before they are there."""
        joined = {body for row in self.plan.topology.joints for body in (row.child, row.parent)}
        return not joined & {*names} and len({self.parameters.masses.get(name) for name in names}) == 1

    def copies(self, row: SceneObject, family: str) -> str:
        """The copies of an object as a loop over their names and poses."""
        placed = [(name, self.scene[name]) for name in self.plan.families[family]]
        poses = [(name, tuple(float(v) for v in p.position), float(p.deg_z)) for name, p in placed]
        table = [f"        {literal(pose)}," for pose in poses]
        return "\n".join(["    for name, pos, yaw_deg in (", *table, "    ):", self.scene_object(row, family)])

    def ordered(self) -> list[SceneObject | AssetRow]:
        """The objects in plan order, except that a joint's parent comes before its child."""
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

    def scene_object(self, row: SceneObject, family: str = "") -> str:
        """The text of one primitive, form or compound; for a family as the body of the loop over its copies."""
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
            "compound": ("compound", {"parts": Raw(f"{constant_name(family or row.name).lower()}_parts")}),
            "box_container": ("container", {"size": row.size, "wall": row.wall_thickness}),
        }
        if row.formed:
            self.needs.use("forms")
            made = call(f"forms.{row.primitive}", indent=0, **arguments(row.primitive, vars(row)))
            shapes[row.primitive] = (
                "formed",
                {"form": Raw(" ".join(made.split()).replace("( ", "(").replace(", )", ")"))},
            )
        function, keywords = shapes[row.primitive]
        keywords |= self.common(row.name, placed)
        if family:
            keywords |= {"pos": Raw("pos"), "yaw_deg": Raw("yaw_deg")}
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
        indent = 8 if family else 4
        lines = [comment(note, indent)] if note else []
        if row.parts:
            table = self.parts(row, family or row.name)
            lines.append(textwrap.indent(table, "    ") if family else table)
        name = Raw("name") if family else row.name
        return "\n".join([*lines, call(f"bodies.{function}", Raw("spec"), name, indent=indent, **keywords)])

    def parts(self, row: SceneObject, name: str) -> str:
        """The text of a compound's parts, as a table of their own."""
        self.needs.use("parts")
        lines = [f"    {constant_name(name).lower()}_parts = ("]
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

    def loop(self, row: Joint) -> str:
        """The text of a joint that closes a loop: constraints between existing bodies."""
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
