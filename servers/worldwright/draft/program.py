"""A resolved plan as a program a person would be glad to read.

The module's constants carry the plan's numbers; `build()` adds the objects in plan order, then the cameras, then the
initial motion. Same plan in, same bytes out.
"""

import math
from dataclasses import dataclass

from ..model.drives import Actuator, End
from ..model.errors import PlanError
from ..model.plan import AssetRow, Joint, Plan, SceneObject, Vec3
from ..model.scene import PlacedObject, Scene
from .source import Raw, bullet, call, comment, constant_name, literal, plain, slug


@dataclass(frozen=True)
class Draft:
    """A drafted program and what it leaves to its author."""

    source: str
    open_places: tuple[str, ...]
    """What must still be written by hand; empty when the draft is complete."""

    @property
    def complete(self) -> bool:
        """Nothing is left to an author."""
        return not self.open_places


def draft(plan: Plan, scene: Scene) -> Draft:
    """Draft the program of a plan.

    Args:
        plan: a valid plan with nothing left to clarify.
        scene: its resolved layout.

    Raises:
        PlanError: something is still TO_CLARIFY, or an object has no resolved pose.
    """
    if unresolved := list(plan.unresolved()):
        raise PlanError(
            f"the plan still has open questions: {'; '.join(unresolved)}",
            next_move="answer them in plan.md, then build again",
        )
    if missing := [n for n in plan.object_names() if n not in {o.name for o in scene.objects}]:
        raise PlanError(
            f"no pose was resolved for {', '.join(missing)}",
            next_move="add rows for them under topology.scene_predicates, then `worldwright place resolve`",
        )
    writer = _Writer(plan, scene)
    return Draft(writer.program(), tuple(writer.open_places))


class _Writer:
    """Writes one program; collects what it had to leave open."""

    def __init__(self, plan: Plan, scene: Scene) -> None:
        self.plan = plan
        self.scene = scene
        self.name = slug(plan.title) or "world"
        self.open_places: list[str] = []
        self.modules = {"program", "scene"}
        self.parameters = plan.simulation_parameters
        self.joint_of: dict[str, Joint] = {}
        self.loops: list[Joint] = []
        for joint in plan.topology.joints:
            if joint.child in self.joint_of:
                self.loops.append(joint)
            else:
                self.joint_of[joint.child] = joint

    def program(self) -> str:
        """The whole file."""
        body = "\n\n".join(
            part for part in (self.objects(), self.tendons(), self.actuators(), self.cameras(), self.motion()) if part
        )
        surfaces = self.surfaces()
        control = self.control()
        entry = self.entry(bool(control))
        imports = "import math\n\n" if "math." in body else ""
        return "\n".join(
            part
            for part in (
                self.docstring(),
                f"{imports}import mujoco\n",
                f"from worldkit import {', '.join(sorted(self.modules))}\n",
                self.constants(),
                surfaces,
                self.build_head(),
                body,
                "\n    return spec\n",
                control,
                entry,
            )
            if part
        )

    def summary(self) -> str:
        """One sentence on what the world holds."""
        count = len(self.plan.object_names())
        movers = ", ".join(self.plan.movers())
        return f"{count} object{'s' if count != 1 else ''}" + (f"; {movers} should move" if movers else "")

    def docstring(self) -> str:
        """The module's docstring: the claims it has to make true."""
        lines = [
            f'"""{_sentence(self.plan.title or self.name)}',
            "",
            "What the plan claims of it:",
            *(bullet(objective.claim) for objective in self.plan.objectives),
            "",
            "Drafted from plan.md, which owns every number of the world: change it there and draft again, or patch this file.",
            "Frame: z up, +X front; metres, kilograms, seconds. Positions are centres, sizes are full extents.",
            '"""',
            "",
        ]
        return "\n".join(lines)

    def constants(self) -> str:
        """The user-owned numbers and named constants of `simulation_parameters`."""
        p = self.parameters
        lines = [
            f"TIME_STEP = {literal(p.time_step)}  # s",
            f"DURATION = {literal(p.simulation_duration)}  # s",
            f"GRAVITY = {literal(tuple(float(g) for g in p.gravity_vector))}  # m/s^2",
        ]
        for name, constant in p.constants.items():
            note = f"{constant.unit}; {constant.source}" if constant.source else constant.unit
            lines.append(f"{constant_name(name)} = {literal(constant.value)}  # {' '.join(note.split())}")
        return "\n".join(lines) + "\n"

    def surfaces(self) -> str:
        """One constant per material the objects refer to."""
        if not self.parameters.materials:
            return ""
        self.modules.add("contacts")
        lines = []
        for name, m in self.parameters.materials.items():
            if m.source:
                lines.append(comment(f"{name}: {m.source}", 0))
            keywords: dict = {"friction": m.friction, "torsional": m.torsional_friction, "rolling": m.rolling_friction}
            if m.restitution is not None:
                keywords["restitution"] = m.restitution
                # The stiffest contact this time step resolves: the least overlap, the firmest grip. The damping is chosen
                # for that constant, so the stated restitution holds.
                keywords["time_constant"] = Raw("4 * TIME_STEP")
            if m.density is not None:
                keywords["density"] = m.density
            target = f"{constant_name(name)} = contacts.surface"
            lines.append(call(target, indent=0, **keywords))
        return "\n".join(lines) + "\n"

    def build_head(self) -> str:
        """`def build()` up to the empty world."""
        show = self.plan.visualization
        keywords: dict = {
            "time_step": Raw("TIME_STEP"),
            "gravity": Raw("GRAVITY"),
            "integrator": self.parameters.integrator,
            "setting": show.setting,
        }
        if show.floor:
            keywords["floor"] = show.floor
        if "ground" in self.parameters.materials:
            keywords["floor_surface"] = Raw("GROUND")
        head = f'\ndef build() -> mujoco.MjSpec:\n    """The world at t = 0: {self.summary()}."""\n'
        return head + call("spec = scene.new", self.name, **keywords)

    def objects(self) -> str:
        """Every scene object and asset, parents before children, otherwise in plan order."""
        parts = [
            self.scene_object(item) if isinstance(item, SceneObject) else self.asset(item) for item in self.ordered()
        ]
        for joint in self.loops:
            self.leave(
                f"joint {joint.name} closes a loop on {joint.child}", "spec.add_equality(...) between its bodies"
            )
            parts.append(comment(f"AUTHOR: joint {joint.name} closes a loop: add an equality constraint for it."))
        if self.plan.plan_type == "fsi_in_scene":
            self.leave("the plan couples a fluid with solids", "the fluid's medium and its coupling")
            parts.append(comment("AUTHOR: add the fluid and its coupling to the solids here."))
        return "\n".join(part for part in parts if part)

    def ordered(self) -> list[SceneObject | AssetRow]:
        """Plan order, except that a joint's parent comes before its child."""
        rows: list[SceneObject | AssetRow] = [*self.plan.scene_objects, *self.plan.assets]
        by_name = {row.name: row for row in rows}
        done: dict[str, SceneObject | AssetRow] = {}

        def visit(row: SceneObject | AssetRow, trail: tuple[str, ...]) -> None:
            if row.name in done:
                return
            joint = self.joint_of.get(row.name)
            if joint is not None and joint.parent in by_name:
                if joint.parent in trail:
                    cycle = " -> ".join((*trail, joint.parent))
                    raise PlanError(f"the joints form a cycle: {cycle}", next_move="make one of its bodies the root")
                visit(by_name[joint.parent], (*trail, row.name))
            done[row.name] = row

        for row in rows:
            visit(row, (row.name,))
        return list(done.values())

    def scene_object(self, row: SceneObject) -> str:
        """One primitive."""
        self.modules.add("bodies")
        placed = self.scene[row.name]
        x, _, z = row.size
        shapes: dict[str, tuple[str, dict]] = {
            "box": ("box", {"size": row.size}),
            "plane": ("box", {"size": row.size}),
            "sphere": ("sphere", {"diameter": x}),
            "cylinder": ("cylinder", {"diameter": x, "height": z}),
            "capsule": ("capsule", {"diameter": x, "height": z}),
            "ellipsoid": ("ellipsoid", {"size": row.size}),
            "box_container": ("container", {"size": row.size, "wall": row.wall_thickness}),
        }
        function, keywords = shapes[row.primitive]
        keywords |= self.common(row.name, placed)
        if row.deg_x:
            keywords["tilt_deg"] = row.deg_x
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
        return "\n".join([*lines, call(f"bodies.{function}", Raw("spec"), row.name, **keywords)])

    def common(self, name: str, placed: PlacedObject) -> dict:
        """Pose and mass, the same for every kind of object."""
        keywords: dict = {"pos": tuple(float(v) for v in placed.position)}
        if placed.deg_z:
            keywords["yaw_deg"] = float(placed.deg_z)
        if name in self.parameters.masses:
            keywords["mass"] = self.parameters.masses[name]
        return keywords

    def joint(self, name: str) -> dict:
        """How an object is attached, when the plan says so."""
        row = self.joint_of.get(name)
        if row is None:
            return {}
        parent = {} if row.parent == "world" else {"parent": row.parent}
        if row.type == "weld":
            return {**parent, "fixed": True}
        self.modules.add("joints")
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

    def asset(self, row: AssetRow) -> str:
        """A catalog asset; several instances become a table of poses and one loop."""
        if row.type != "mesh" or any(name in self.joint_of for name in row.instances):
            what = f"a {row.type} asset" if row.type != "mesh" else "an asset on a joint"
            self.leave(f"{row.name} is {what}", "import it and attach it to the world")
            return comment(f"AUTHOR: add {row.name} ({row.filename}): {what} is not drafted.")
        self.modules.add("assets")
        keywords: dict = {"height": self.plan.asset_dimensions[row.name]}
        if row.material:
            keywords["surface"] = Raw(constant_name(row.material))
        if row.look:
            keywords["look"] = row.look
        if row.fixed or not row.is_dynamic:
            keywords["fixed"] = True
        if row.count == 1:
            pose = self.common(row.name, self.scene[row.name])
            return call("assets.add", Raw("spec"), row.filename, name=row.name, **pose, **keywords)
        table = constant_name(row.name).lower() + "_poses"
        lines = [f"    {table} = {{  # name: (centre, yaw in degrees)"]
        for name in row.instances:
            placed = self.scene[name]
            lines.append(
                f"        {literal(name)}: ({literal(tuple(map(float, placed.position)))}, {float(placed.deg_z)}),"
            )
        lines += ["    }", f"    for name, (pos, yaw_deg) in {table}.items():"]
        masses = {self.parameters.masses.get(n, self.parameters.masses.get(row.name)) for n in row.instances}
        if len(masses) == 1 and (mass := masses.pop()) is not None:
            keywords["mass"] = mass
        pose = {"name": Raw("name"), "pos": Raw("pos"), "yaw_deg": Raw("yaw_deg")}
        lines.append(call("assets.add", Raw("spec"), row.filename, indent=8, **pose, **keywords))
        return "\n".join(lines)

    def tendons(self) -> str:
        """Ropes and springs, between points of the bodies where they were placed."""
        lines = []
        for row in self.plan.topology.tendons:
            self.modules.add("tendons")
            ends = [(end.body, self.point(end)) for end in row.ends]
            keywords: dict = {"stiffness": row.stiffness} if row.stiffness else {}
            keywords |= {k: getattr(row, k) for k in ("length", "slack", "damping") if getattr(row, k)}
            keywords |= {"diameter": row.diameter} | ({"look": row.look} if row.look else {})
            made = "tendons.spring" if row.stiffness else "tendons.rope"
            lines.append(call(made, Raw("spec"), row.name, ends, **keywords))
        return "\n".join(lines)

    def point(self, end: End) -> Vec3:
        """Where an end is fastened, world frame."""
        if end.body == "world":
            return end.offset
        placed = self.scene[end.body]
        sides = {"front": (1, 0, 0), "left": (0, 1, 0), "top": (0, 0, 1)}
        sides |= {"back": (-1, 0, 0), "right": (0, -1, 0), "bottom": (0, 0, -1), "center": (0, 0, 0)}
        own = [
            side * extent / 2 + more for side, extent, more in zip(sides[end.at], placed.size, end.offset, strict=True)
        ]
        yaw = math.radians(placed.deg_z)
        turned = (
            own[0] * math.cos(yaw) - own[1] * math.sin(yaw),
            own[0] * math.sin(yaw) + own[1] * math.cos(yaw),
            own[2],
        )
        x, y, z = (round(float(c) + t, 9) + 0.0 for c, t in zip(placed.position, turned, strict=True))
        return x, y, z

    def actuators(self) -> str:
        """Motors and servos on the joints."""
        lines = []
        for row in self.plan.topology.actuators:
            self.modules.add("actuators")
            keywords: dict = {"joint": row.joint}
            keywords |= {k: getattr(row, k) for k in ("gain", "damping", "limit") if getattr(row, k)}
            lines.append(call(f"actuators.{row.kind}", Raw("spec"), row.name, **keywords))
        return "\n".join(lines)

    def cameras(self) -> str:
        """The cameras of every step."""
        rows = self.plan.cameras()
        if not rows:
            return ""
        self.modules.add("cameras")
        lines = []
        shots = {shot.name: shot for shot in self.scene.cameras}
        for row in rows:
            keywords: dict = {}
            if row.name in shots:  # a relation template placed it
                keywords |= {"position": shots[row.name].position, "target": shots[row.name].target}
            elif row.position is not None:
                keywords |= {"position": row.position}
                if row.target is not None:
                    keywords |= {"target": row.target}
            elif row.view is not None:
                keywords["view"] = row.view
            subjects = row.subjects or self.plan.movers()
            if subjects:
                keywords["subjects"] = tuple(subjects)
            if row.fovy != type(row).model_fields["fovy"].default:
                keywords["fovy"] = row.fovy
            if row.follow:
                keywords["follow"] = True
            lines.append(call("cameras.add", Raw("spec"), row.name, **keywords))
        return "\n".join(lines)

    def motion(self) -> str:
        """Initial velocities and joint coordinates."""
        if not self.parameters.initial_motion:
            return ""
        self.modules.add("motion")
        kinds = {joint.name: joint.type for joint in self.plan.topology.joints}
        lines = ["    motion.launch(", "        spec,", "        {"]
        for name, start in self.parameters.initial_motion.items():
            keywords: dict = {}
            if any(start.linear):
                keywords["linear"] = start.linear
            if any(start.angular):
                keywords["angular"] = start.angular
            if start.joint_position is not None:
                degrees = kinds.get(name) == "hinge"
                value = literal(start.joint_position)
                keywords["position"] = Raw(f"math.radians({value})") if degrees else start.joint_position
            if start.joint_velocity is not None:
                keywords["velocity"] = start.joint_velocity
            lines.append(f"            {literal(name)}: {call('motion.Launch', indent=0, **keywords)},")
        return "\n".join([*lines, "        },", "    )"])

    def control(self) -> str:
        """The `control` function: constant controls of the plan's actuators; what else it declares is marked."""
        driven = {row.name: row for row in self.plan.topology.actuators if row.control is not None}
        if not self.parameters.interventions and not driven:
            return ""
        lines = ["\ndef control(model: mujoco.MjModel, data: mujoco.MjData) -> None:"]
        lines.append('    """What the plan declares to act on the state besides the engine."""')
        for name, row in driven.items():
            value = constant_name(row.control) if isinstance(row.control, str) else literal(row.control)
            lines.append(f"    data.actuator({literal(name)}).ctrl[0] = {value}")
        for item in self.parameters.interventions:
            text = (
                f"{item.kind} on {', '.join(item.bodies)}: {item.law} (trigger: {item.trigger}; source: {item.source})"
            )
            if item.kind == "control" and driven and set(item.bodies) <= self.driven_names(driven):
                lines.insert(2, comment(text))
                continue
            self.leave(f"declared intervention: {text}", "its law, in control()")
            lines.append(comment(f"AUTHOR: {text}"))
        return "\n".join(lines) + "\n"

    def driven_names(self, driven: dict[str, Actuator]) -> set[str]:
        """The actuators whose control the plan gives, their joints, and the bodies on those."""
        joints = {row.joint for row in driven.values()}
        children = {joint.child for joint in self.plan.topology.joints if joint.name in joints}
        return {*driven, *joints, *children}

    def entry(self, control: bool) -> str:
        """The call that hands the world to the runtime."""
        recording = self.plan.recording_mode
        keywords: dict = {"duration": Raw("DURATION"), "fps": recording.fps, "size": recording.size}
        if movers := self.plan.movers():
            keywords["movers"] = tuple(movers)
        if self.parameters.seed:
            keywords["seed"] = self.parameters.seed
        if drawn := tuple(o.name for o in self.plan.scene_objects if o.visual_only):
            keywords["visual_only"] = drawn
        handed = (Raw("build"), Raw("control")) if control else (Raw("build"),)
        return '\nif __name__ == "__main__":\n' + call("program.main", *handed, **keywords) + "\n"

    def leave(self, why: str, what: str) -> None:
        """Note a place for the author."""
        self.open_places.append(f"{why}: {what}")


def _sentence(text: str) -> str:
    text = plain(text)
    return text if text.endswith((".", "!", "?")) else text + "."
