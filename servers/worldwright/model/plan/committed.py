"""The committed plan: thirteen sections, the single source of truth of a run.

Every number has one owner: sizes live in `scene_objects[].size` and `asset_dimensions`, poses are resolved from
`topology.scene_predicates` and `geometry_relations`, physical constants live in `simulation_parameters`.

Frame: z up, +X front, +Y left, metres, kilograms, seconds, degrees. Sizes are full extents, positions are centres of
the axis-aligned bounding box. Source: the reference paper's appendix "Plan Format" and "Scene Coordinate System".
"""

from collections.abc import Collection, Iterator
from enum import StrEnum
from functools import cached_property
from pathlib import Path
from typing import Any, Literal

from pydantic import Field, field_validator, model_validator

from ..frozen import Frozen
from . import breakage, copies, robots_declared, soft_rows, vehicle_rows
from .declared_inputs import Constant, Intervention
from .drives import Actuator, Tendon
from .implementation_steps import CameraRow, Step, seen_as_in_image
from .joint_rows import Joint
from .observation import ImageObservation
from .pairings import Medium, Overlap, PairSurface, SurfaceConstants, least_said, yielded
from .scene_objects import AssetRow, SceneObject, Vec3
from .spread import Spread
from .visualization import RecordingMode, Visualization

TO_CLARIFY = "TO_CLARIFY"
Unresolved = Literal["TO_CLARIFY"]
TO_CHANGE = "TO_CHANGE"
"""Marks what stands as it was copied from another world."""

SECTIONS = (
    "plan_type",
    "simulation_parameters",
    "objectives",
    "implementation_steps",
    "scene_objects",
    "assets",
    "asset_dimensions",
    "layout_density",
    "topology",
    "visualization",
    "recording_mode",
    "clarifications_needed",
    "geometry_relations",
)


class PlanType(StrEnum):
    """The four kinds of plan."""

    SCENE = "scene"
    MBS = "mbs"
    MBS_IN_SCENE = "mbs_in_scene"
    FSI_IN_SCENE = "fsi_in_scene"


class InitialMotion(Frozen):
    """Velocity of a free body, or of a joint, at t = 0, in the world frame."""

    linear: Vec3 = (0.0, 0.0, 0.0)
    """m/s."""
    angular: Vec3 = (0.0, 0.0, 0.0)
    """rad/s."""
    joint_position: float | None = None
    """Starting coordinate of a hinge (degrees) or slide (m), when the name is a joint's."""
    joint_velocity: float | None = None
    """Starting speed of a hinge (rad/s) or slide (m/s)."""


class SimulationParameters(Frozen):
    """Section `simulation_parameters`: user-owned numbers and all physical constants."""

    time_step: float | Unresolved
    """s. User-owned, never silently defaulted."""
    simulation_duration: float | Unresolved
    """s. User-owned, never silently defaulted."""
    gravity: float | Vec3 = -9.81
    """m/s^2: a float is the acceleration along +z."""
    integrator: Literal["euler", "implicit", "implicitfast", "rk4", "discrete"] = "implicitfast"
    impratio: float | None = Field(None, ge=1)
    """How much harder friction holds than the normal force, as a ratio of impedances; 10 keeps a leaning ladder's feet from
    creeping. None: 1, the engine's own."""
    seed: int = 0
    materials: dict[str, SurfaceConstants] = {}
    medium: Medium | None = None
    """The air or water that everything moves in; None: a vacuum."""
    pairs: tuple[PairSurface, ...] = ()
    """What rubs and rebounds otherwise than its materials say: waxed skis on snow, a brake pad on its disc."""
    masses: dict[str, float] = {}
    """kg, by object name; overrides a material's density."""
    initial_motion: dict[str, InitialMotion] = {}
    """By object (free bodies) or joint name."""
    constants: dict[str, Constant] = {}
    interventions: tuple[Intervention, ...] = ()
    inferred: tuple[str, ...] = ()
    """Dotted names of values that the planner chose conservatively, for the user to audit."""

    @field_validator("time_step", "simulation_duration")
    @classmethod
    def _positive(cls, value: float | str) -> float | str:
        if not isinstance(value, str) and not 0 < value < float("inf"):
            raise ValueError(f"must be a positive, finite number of seconds, got {value}")
        return value

    def yielding(self, used: Collection[str]) -> "SimulationParameters":
        """The same, with frictions that rows leave unsaid no larger than what the `used` materials say: one that nothing is made of
        says nothing of how other things rub."""
        least = least_said(row for name, row in self.materials.items() if name in used)
        told = {
            "materials": {name: yielded(row, least) for name, row in self.materials.items()},
            "pairs": tuple(yielded(row, least) for row in self.pairs),
        }
        return self.model_copy(update=told)

    @property
    def gravity_vector(self) -> Vec3:
        """Gravity as a world-frame vector, m/s^2."""
        return self.gravity if isinstance(self.gravity, tuple) else (0.0, 0.0, self.gravity)


class Objective(Frozen):
    """One claim about the world, with the measurements that would prove it."""

    claim: str
    expect: tuple[dict[str, Any], ...] = ()
    """Expectations over recorded state: each a mapping with one key, the expectation's name, and its arguments."""
    visual_only: str | None = None
    """Why the claim cannot be measured, when it cannot."""
    cause: tuple[str, ...] = ()
    """What the claim is an effect of: bodies, actuators, joints, tendons, constraints, `gravity`, `wind`, `friction` (of
    all contacts; `top.friction`: of one thing's), or an intervention such as `force:rocket`. Without it, `expect` must fail (`scan --causes`)."""
    effect: str = ""
    """The effect in words, or a list of expectations; where it names expectations, those are the effect."""

    @field_validator("cause", mode="before")
    @classmethod
    def _one_cause(cls, value: Any) -> Any:
        return (value,) if isinstance(value, str) else tuple(value) if isinstance(value, list) else value

    @field_validator("effect", mode="before")
    @classmethod
    def _one_text(cls, value: Any) -> Any:
        several = isinstance(value, list | tuple) and all(isinstance(name, str) for name in value)
        return ", ".join(value) if several else value


class Position(Frozen):
    """World-frame centre, metres."""

    x: float
    y: float
    z: float

    @property
    def vector(self) -> Vec3:
        """The centre as a tuple."""
        return (self.x, self.y, self.z)


class Orientation(Frozen):
    """Yaw about world z, degrees counter-clockwise from +X."""

    deg_z: float


class PredicateRow(Frozen):
    """One symbolic placement and the numeric pose it resolved to."""

    subject: str
    predicate: str
    object: str | None = None
    params: dict[str, Any] = {}
    spread: Spread | None = None
    """How the copies of a subject with a `count` stand around the place that the row gives."""
    position: Position | Unresolved | None = None
    """The subject's final centre; written by the resolver."""
    orientation: Orientation | Unresolved | None = None
    provenance: str | None = None
    """The formula this row contributed, with its numbers; written by the resolver."""
    description: str = ""


class SettledOffset(Frozen):
    """How far an object came from where its rows put it when it was let go: added to its resolved pose."""

    x: float = 0.0
    y: float = 0.0
    z: float = 0.0
    deg_z: float = 0.0


class Topology(Frozen):
    """Section `topology`: the frame, the joints and the placement rows."""

    gravity_axis: Literal["-z"] = "-z"
    working_plane: Literal["xy"] = "xy"
    orientation_convention: Literal["z_up_native"] = "z_up_native"
    reference_heights: tuple[float, ...] | dict[str, float] = ()
    """Shared z layers, metres."""
    body_positions: dict[str, Position | Unresolved] = {}
    """Absolute centres (pure multibody plans)."""
    joints: tuple[Joint, ...] = ()
    tendons: tuple[Tendon, ...] = ()
    actuators: tuple[Actuator, ...] = ()
    scene_predicates: tuple[PredicateRow, ...] = ()
    overlaps: tuple[Overlap, ...] = ()
    """What belongs together and may be inside each other, how far, and why (`belonging`); contacts act as elsewhere."""
    image_observation: ImageObservation | None = None
    """What the reference image shows, when there is one."""
    settled: dict[str, SettledOffset] = {}
    """Small displacements that `place settle --write` found, by object."""

    def loops(self) -> tuple[Joint, ...]:
        """Joints whose child hangs on an earlier one already: each closes a loop, and is a constraint without coordinate."""
        hung: set[str] = set()
        found = []
        for joint in self.joints:
            if joint.child in hung and not joint.beside:
                found.append(joint)
            hung.add(joint.child)
        return tuple(found)


class RelationRow(Frozen):
    """A named relation pattern binding a body (or a camera) to a reference."""

    relation_name: str
    body_a: str
    body_b: str | None = None
    parameters: dict[str, Any] | Unresolved = {}
    built: bool = False
    """Written down from the program's world."""


class Plan(Frozen):
    """All thirteen sections."""

    title: str = ""
    """The document's level-one heading."""
    plan_type: PlanType
    simulation_parameters: SimulationParameters
    objectives: tuple[Objective, ...] = Field(min_length=1)
    implementation_steps: tuple[Step, ...] = ()
    scene_objects: tuple[SceneObject, ...] = ()
    assets: tuple[AssetRow, ...] = ()
    asset_dimensions: dict[str, float] = {}
    """Real-world height in metres by asset row name: the single source of metric scale (a model file has its own)."""
    layout_density: dict[str, Any] = {}
    topology: Topology = Topology()
    visualization: Visualization = Visualization()
    recording_mode: RecordingMode = RecordingMode()
    clarifications_needed: tuple[str, ...] = ()
    geometry_relations: tuple[RelationRow, ...] = ()

    @cached_property
    def folder(self) -> Path | None:
        """Where the plan was read from, and where the files lie that its assets name; None for a plan made in memory.

        No part of the plan: two are equal wherever they lie.
        """
        return None

    @cached_property
    def families(self) -> dict[str, tuple[str, ...]]:
        """Names of the copies of each object with a `count`, by the name that the plan gives it."""
        return {}

    @cached_property
    def broken(self) -> dict[str, SceneObject]:
        """The objects that break, as they are written, by their names; their pieces stand in their place."""
        return {}

    @cached_property
    def source_rows(self) -> tuple[int, ...]:
        """The row of `scene_objects`, as it is written, of each scene object; empty where none has a `count`."""
        return ()

    @cached_property
    def made_of(self) -> frozenset[str]:
        """Names of the materials of things, and of the ground."""
        parts = [part.material for row in self.scene_objects for part in row.parts]
        rows = [row.material for row in self.scene_objects] + [row.material for row in self.assets]
        return frozenset(name for name in ("ground", *rows, *parts) if name)

    @model_validator(mode="after")
    def _copied(self) -> "Plan":
        self.__dict__["simulation_parameters"] = self.simulation_parameters.yielding(self.made_of)
        soft_rows.check(self)
        robots_declared.check(self)
        if copied := copies.families(self):
            breakage.check(self)
            broken = {row.name: row for row in self.scene_objects if row.breaks is not None}
            self.__dict__.update(copies.changes(self, copied), families=copied, broken=broken)
        if any(row.vehicle is not None for row in self.assets):
            self.__dict__["simulation_parameters"] = vehicle_rows.parameters(self)
        if any(robots_declared.does(row) is not None for row in self.assets):
            self.__dict__["topology"] = self.topology.model_copy(update={"actuators": robots_declared.actuators(self)})
            acting = {"interventions": robots_declared.interventions(self)}
            self.__dict__["simulation_parameters"] = self.simulation_parameters.model_copy(update=acting)
        self.visualization.hung(self.families)
        return self

    def read_from(self, folder: Path) -> "Plan":
        """The same plan, knowing its folder."""
        self.__dict__["folder"] = folder
        return self

    @cached_property
    def copied(self) -> tuple[int | str, ...]:
        """Where TO_CHANGE stands: 1-based lines of the file, comments included; of a plan made in memory the paths of values.

        No part of the plan.
        """
        return tuple(".".join(map(str, path)) for path in _marked((), self.model_dump(), TO_CHANGE))

    def copied_at(self, lines: tuple[int, ...]) -> None:
        """Know the lines of the text that still stand as they were copied."""
        self.__dict__["copied"] = lines

    @cached_property
    def open_lines(self) -> tuple[tuple[str, int, str], ...]:
        """Section, 1-based line and text of each line that holds TO_CLARIFY and belongs to no value. No part of the plan."""
        return ()

    def left_open_at(self, lines: tuple[tuple[str, int, str], ...]) -> None:
        """Know the lines of the text that nobody reads and that are still to clarify."""
        self.__dict__["open_lines"] = lines

    def declared(self) -> tuple[Intervention, ...]:
        """What may act besides the engine's step: the declared interventions, and joints that are set before it begins."""
        parameters = self.simulation_parameters
        return parameters.interventions + tuple(
            Intervention(
                kind="pose",
                bodies=(name,),
                law=f"{name} begins at {motion.joint_position:g} (degrees or m)",
                trigger="at t = 0 s",
                source=f"simulation_parameters.initial_motion.{name}",
            )
            for name, motion in parameters.initial_motion.items()
            if motion.joint_position
        )

    def object_names(self) -> tuple[str, ...]:
        """Every placed thing: scene objects, then asset instances, in plan order."""
        return tuple(o.name for o in self.scene_objects) + tuple(n for a in self.assets for n in a.instances)

    def cameras(self) -> tuple[CameraRow, ...]:
        """Every camera of every step, once, in plan order; the first one looks from the reference image's viewpoint."""
        seen: dict[str, CameraRow] = {}
        for step in self.implementation_steps:
            for camera in step.cameras:
                row = CameraRow(name=camera, view=camera) if isinstance(camera, str) else camera
                seen.setdefault(row.name, row)
        placed = {relation.body_a: relation.relation_name for relation in self.geometry_relations}
        observed = self.topology.image_observation
        return seen_as_in_image(tuple(seen.values()), observed, placed, self.object_names())

    def movers(self) -> tuple[str, ...]:
        """Objects that some step expects to move."""
        return tuple(dict.fromkeys(n for step in self.implementation_steps for n in step.motion_expectations))

    def unresolved(self) -> Iterator[str]:
        """Every open clarification, and every value or line of the text in which TO_CLARIFY stands: each blocks code."""
        yield from self.open_values()
        yield from (f"{section}: line {line}, `{text}`" for section, line, text in self.open_lines)

    def open_values(self) -> Iterator[str]:
        """Every open clarification, and the path of every value, anywhere in the plan, in which TO_CLARIFY stands."""
        yield from (f"clarifications_needed: {text}" for text in self.clarifications_needed)
        for path in _marked((), self.model_dump(exclude={"clarifications_needed"})):
            yield ".".join(map(str, path))


def _marked(path: tuple[str | int, ...], value: Any, mark: str = TO_CLARIFY) -> Iterator[tuple[str | int, ...]]:
    """Paths of the texts in which a mark stands, keys of mappings included."""
    if isinstance(value, str) and mark in value:
        yield path
    elif isinstance(value, dict):
        for key, item in value.items():
            if isinstance(key, str) and mark in key:
                yield (*path, key)
            yield from _marked((*path, key), item, mark)
    elif isinstance(value, list | tuple):
        for index, item in enumerate(value):
            yield from _marked((*path, index), item, mark)
