"""Write a resolved plan as a program that a person likes to read.

The module's constants carry the plan's numbers; `build()` adds the objects in plan order, then the cameras, then the
initial motion. The same plan gives the same bytes.
"""

import re
from dataclasses import dataclass

from ..model.errors import PlanError
from ..model.plan.committed import Plan
from ..model.plan.layout import Scene
from . import driving, robots_text, vehicles_text
from .crowds import Crowds
from .laws_text import Laws
from .objects import Objects
from .python_text import Raw, bullet, call, comment, constant_name, exact, literal, plain, slug
from .requirements import Needs


@dataclass(frozen=True)
class Draft:
    """A drafted program and what it leaves to its author."""

    source: str
    open_places: tuple[str, ...]
    """What must still be written by hand; empty when the draft is complete."""
    unread: tuple[str, ...] = ()
    """Constants of the plan that the program names and never reads: paper work behind other numbers, or what a step's
    description asks for and no field of the plan says."""

    @property
    def complete(self) -> bool:
        """Whether nothing is left to an author."""
        return not self.open_places


def draft(plan: Plan, scene: Scene, alone: bool = False) -> Draft:
    """Draft the program of a plan.

    Args:
        plan: a valid plan with nothing left to clarify.
        scene: its resolved layout.
        alone: import no law of the author's, so that nothing of it runs; bodies that are only drawn show what they move.

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
    writer = _Writer(plan, scene, alone)
    source = writer.program()
    unread = [name for name in writer.own if len(re.findall(rf"\b{constant_name(name)}\b", source)) == 1]
    return Draft(source, tuple(writer.needs.open_places), tuple(unread))


class _Writer:
    """Writes one program, and collects what it has to leave open."""

    def __init__(self, plan: Plan, scene: Scene, alone: bool) -> None:
        self.plan = plan
        self.scene = scene
        self.name = slug(plan.title) or "world"
        self.needs = Needs({"program", "scene"})
        self.crowds = Crowds(plan)
        self.laws = Laws(plan, self.needs, alone)
        self.parameters = plan.simulation_parameters
        solvers = [row.solver for row in self.parameters.interventions if row.solver]
        self.read = {name for solver in solvers for name in solver.constants.values()}
        """Constants of the plan that a solver beside the engine reads, by itself."""
        self.own = dict(self.parameters.constants)
        """Constants of the plan that the program has: less those of a solver that nothing else in it names, too."""

    def program(self) -> str:
        """The whole file."""
        plan, scene, needs = self.plan, self.scene, self.needs
        parts = (
            Objects(plan, scene, needs, self.laws).written(),
            self.pairs(),
            driving.tendons(plan, scene, needs),
            driving.actuators(plan, needs),
            driving.ties(plan, needs),
            self.light(),
            self.cameras(),
            self.motion(),
        )
        body = "\n\n".join(part for part in parts if part)
        surfaces = self.surfaces() + self.texts() + self.laws.made() + vehicles_text.made(plan, self.scene, needs)
        surfaces += robots_text.made(plan, needs)
        control = driving.control(plan, needs)
        entry = self.entry(bool(control))
        named = {*re.findall(r"\w+", f"{surfaces}\n{body}\n{control}\n{entry}")}
        self.own = {k: v for k, v in self.own.items() if k not in self.read or constant_name(k) in named}
        imports = "import math\n\n" if "math." in body else ""
        return "\n".join(
            part
            for part in (
                self.docstring(),
                f"{imports}import mujoco\n",
                f"{self.laws.imports()}from worldkit import {', '.join(sorted(self.needs.modules))}\n",
                self.constants(),
                surfaces,
                self.crowds.written(),
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
        family_of = {name: family for family, names in self.plan.families.items() for name in names}
        movers = ", ".join(dict.fromkeys(family_of.get(name, name) for name in self.plan.movers()))
        return f"{count} object{'s' if count != 1 else ''}" + (f"; {movers} should move" if movers else "")

    def docstring(self) -> str:
        """The module's docstring, with the claims that the program has to make true."""
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
            f"TIME_STEP = {exact(p.time_step)}  # s",
            f"DURATION = {exact(p.simulation_duration)}  # s",
            f"GRAVITY = {exact(tuple(float(g) for g in p.gravity_vector))}  # m/s^2",
        ]
        for name, constant in self.own.items():
            note = f"{constant.unit}; {constant.source}" if constant.source else constant.unit
            lines.append(f"{constant_name(name)} = {exact(constant.value)}  # {' '.join(note.split())}")
        return "\n".join(lines) + "\n"

    def surfaces(self) -> str:
        """One constant per material the objects refer to."""
        if not self.parameters.materials:
            return ""
        self.needs.use("contacts")
        lines = []
        for name, m in self.parameters.materials.items():
            if m.source:
                lines.append(comment(f"{name}: {m.source}", 0))
            keywords: dict = {
                "friction": exact(m.friction),
                "torsional": exact(m.torsional_friction),
                "rolling": exact(m.rolling_friction),
            }
            if m.adhesion:
                keywords["adhesion"] = exact(m.adhesion)
            if m.restitution is not None:
                keywords["restitution"] = m.restitution
                keywords["onset"] = Raw("contacts.QUIET_ONSET")  # or what has come to rest hops on a slope
            # Little overlap and a firm grip, also where no rebound is stated; the damping is chosen for this constant, so
            # that a stated restitution holds.
            keywords["time_constant"] = Raw("4 * TIME_STEP")
            if m.density is not None:
                keywords["density"] = m.density
            target = f"{constant_name(name)} = contacts.surface"
            lines.append(call(target, indent=0, **keywords))
        return "\n".join(lines) + "\n"

    def pairs(self) -> str:
        """What rubs otherwise than its materials say."""
        lines = []
        for row in self.parameters.pairs:
            self.needs.use("contacts")
            if row.source:
                lines.append(comment(row.source))
            keywords: dict = {
                "friction": row.friction, "torsional": row.torsional_friction, "rolling": row.rolling_friction,
            }  # fmt: skip
            if row.restitution is not None:
                keywords["restitution"] = row.restitution
                keywords["onset"] = Raw("contacts.QUIET_ONSET")
            keywords["time_constant"] = Raw("4 * TIME_STEP")
            lines.append(call("contacts.pair", Raw("spec"), *row.between, **keywords))
        return "\n".join(lines)

    def texts(self) -> str:
        """The models that the plan brings in, as they are, and the files that they read."""
        made = []
        for name, text in self.needs.texts.items():
            if isinstance(text, tuple):
                made.append("\n".join([f"{name} = (", *(f"    {literal(file)}," for file in text), ")"]))
                continue
            plain_text = "\\" not in text and '"' * 3 not in text
            made.append(f'{name} = """{text}"""' if plain_text else f"{name} = {literal(text)}")
        return "".join(f"\n{line}\n" for line in made)

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
        made = head + call("spec = scene.new", self.name, **keywords)
        if self.parameters.impratio is not None:
            made += f"\n    spec.option.impratio = {literal(self.parameters.impratio)}"
        if (medium := self.parameters.medium) is not None:
            made += (
                f"\n    spec.option.density, spec.option.viscosity = {exact(medium.density)}, {exact(medium.viscosity)}"
            )
            if any(medium.wind):
                made += f"\n    spec.option.wind = {exact(medium.wind)}"
        return made

    def light(self) -> str:
        """Light, sky and lamps, where the plan states any."""
        show = self.plan.visualization
        lines = [call("lights.add", Raw("spec"), **show.light)] if show.light else []
        for title, lamp, name in show.hung(self.plan.families):
            keywords: dict = {"colour": lamp.colour, "strength": lamp.strength} | ({"to": name} if name else {})
            lines.append(call("lights.lamp", Raw("spec"), title, lamp.at, **keywords))
        if lines:
            self.needs.use("lights")
        return "\n".join(lines)

    def cameras(self) -> str:
        """The cameras of every step."""
        rows = self.plan.cameras()
        if not rows:
            return ""
        self.needs.use("cameras")
        lines = []
        shots = {shot.name: shot for shot in self.scene.cameras}
        for row in rows:
            keywords: dict = {}
            if row.name in shots:  # a relation template placed this camera
                keywords |= {"position": shots[row.name].position, "target": shots[row.name].target}
            elif row.position is not None:
                keywords |= {"position": row.position}
                if row.target is not None:
                    keywords |= {"target": row.target}
            elif row.view is not None:
                keywords["view"] = row.view
            subjects = row.subjects or self.bodies_that_move()
            if subjects:
                keywords["subjects"] = self.crowds.listed(subjects)
            if row.fovy != type(row).model_fields["fovy"].default:
                keywords["fovy"] = row.fovy
            if row.follow:
                keywords["follow"] = True
            lines.append(call("cameras.add", Raw("spec"), row.name, **keywords))
        return "\n".join(lines)

    def bodies_that_move(self) -> tuple[str, ...]:
        """What some step expects to move; a soft thing is no body, its points are."""
        soft = {row.name for row in self.plan.scene_objects if row.soft is not None}
        return tuple(name for name in self.plan.movers() if name not in soft)

    def motion(self) -> str:
        """Initial velocities and joint coordinates."""
        if not self.parameters.initial_motion:
            return ""
        self.needs.use("motion")
        lines = ["    motion.launch(", "        spec,", "        {"]
        for name, start in self.parameters.initial_motion.items():
            keywords: dict = {}
            if any(start.linear):
                keywords["linear"] = start.linear
            if any(start.angular):
                keywords["angular"] = start.angular
            if start.joint_position is not None:
                degrees = self.needs.joint_kinds.get(name) == "hinge"
                value = literal(start.joint_position)
                keywords["position"] = Raw(f"math.radians({value})") if degrees else start.joint_position
            if start.joint_velocity is not None:
                keywords["velocity"] = start.joint_velocity
            lines.append(f"            {literal(name)}: {call('motion.Launch', indent=0, **keywords)},")
        return "\n".join([*lines, "        },", "    )"])

    def entry(self, control: bool) -> str:
        """The call that hands the world to the runtime."""
        recording = self.plan.recording_mode
        keywords: dict = {"duration": Raw("DURATION"), "fps": recording.fps, "size": recording.size}
        if movers := self.bodies_that_move():
            keywords["movers"] = self.crowds.listed(movers)
        if self.parameters.seed:
            keywords["seed"] = self.parameters.seed
        if drawn := tuple(o.name for o in self.plan.scene_objects if o.visual_only):
            keywords["visual_only"] = self.crowds.listed(drawn)
        if (laws := self.laws.handed()) is not None:
            keywords["laws"] = laws
        if control and (every := robots_text.asked_every(self.plan)) > 1:
            keywords["control_every"] = every
        handed = (Raw("build"), Raw("control")) if control else (Raw("build"),)
        return '\nif __name__ == "__main__":\n' + call("program.main", *handed, **keywords) + "\n"


def _sentence(text: str) -> str:
    text = plain(text)
    return text if text.endswith((".", "!", "?")) else text + "."
