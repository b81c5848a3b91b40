"""How an audit takes a cause or a declared intervention away: one repetition for each thing, by whatever names it goes.

An objective's `servo` and a declared control of `actuator:servo` are one thing. What a law, or a solver beside the engine, does
to its bodies is one declared intervention, and is taken away together.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from ...model.evidence.audits import Acting
from ...model.plan.committed import Intervention, Plan
from ...model.plan.declaration import declaration
from ...model.recording.trajectory import Trajectory
from ..anomalies.sign import Context
from .trials import label_of

TOGETHER = "+"
"""It joins names that only together are one cause, such as the four lines of a tent."""
KINDS = {
    "body": "bodies", "geom": "geoms", "joint": "joints", "actuator": "actuators", "equality": "equalities",
    "tendon": "tendons", "flex": "flexes",
}  # fmt: skip
"""Kinds of things that a name may mean, with where a recording lists them."""
BY_BODY = ("joint", "geom")
"""Where a body has the name of one of these, the body is meant."""
MOST = 8
"""Declared interventions that are switched off."""
Words = tuple[str, ...]
"""The program's options for one repetition."""


@dataclass(frozen=True)
class Switches:
    """What is taken away of one recording.

    Args:
        trajectory: the recording.
        plan: whose causes are named.
        acting: what acted in it.
        singly: as reports of before this module say it: each row by itself, and each name as it is written.
    """

    trajectory: Trajectory
    plan: Plan
    acting: tuple[Acting, ...]
    singly: bool = False

    def without(self, cause: str) -> Words:
        """The options that take a cause away."""
        return tuple(word for part in self._parts(cause) for word in ("--without", part))

    def weaker(self, cause: str, factor: float) -> Words:
        """The options that leave this share of a cause."""
        return tuple(word for part in self._parts(cause) for word in ("--weaken", f"{part}={factor:g}"))

    def groups(self) -> list[tuple[Words, tuple[Acting, ...]]]:
        """The declared interventions that are switched off: the options for it, and the rows that this leaves out."""
        found: dict[Words, list[Acting]] = {}
        for row in self.acting:
            if row.declared:
                found.setdefault(self._off(row), []).append(row)
        return [(words, tuple(rows)) for words, rows in list(found.items())[:MOST]]

    def made_singly(self, labels: Iterable[str]) -> bool:
        """Whether a report of these repetitions is of before this module; accepted worlds are proved as they were made."""
        told = set(labels)
        asked = {label_of(words) for words, _ in self.groups()}
        alone = Switches(self.trajectory, self.plan, self.acting, singly=True)
        return not asked <= told and {label_of(words) for words, _ in alone.groups()} <= told

    def _off(self, row: Acting) -> Words:
        """The options that leave an intervention out; they switch a motor off even if no control asks for it."""
        if row.kind == "control":
            known = [str(a["name"]) for a in self.trajectory.meta.get("actuators") or ()]
            name = next((n for n in known if row.target in (n, f"{row.body}/{n}")), row.target)
            return self.without(f"actuator:{name.partition('[')[0]}")
        law = None if self.singly else self._solver(row)
        if law is None:
            return "--without", f"{row.kind}:{row.target}"
        targets = dict.fromkeys(other.target for other in self.acting if self._solver(other) is law)
        return tuple(word for target in targets for word in ("--without", f"solver:{target}"))

    def _solver(self, row: Acting) -> Intervention | None:
        """The plan's row of a law or solver that declares what acted; None where another row does."""
        declared = Context.of(self.plan).of_recording(self.trajectory).interventions
        found = declaration(row.kind, row.target, declared) if row.kind in ("force", "torque") else None
        return found if found is not None and found.kind == "solver" else None

    def _parts(self, cause: str) -> list[str]:
        return [self._called(part.strip()) for part in cause.split(TOGETHER)]

    def _called(self, part: str) -> str:
        """The name by which the first of the plan's causes calls the same thing; the name itself where none does."""
        if self.singly:
            return part
        known = [p.strip() for o in self.plan.objectives for cause in o.cause for p in cause.split(TOGETHER)]
        return next((name for name in known if self._thing(name) == self._thing(part)), part)

    def _thing(self, name: str) -> tuple[str, str]:
        """(kind, name) of what is meant; of a name that means several things, or something else, an empty kind and itself."""
        kind, colon, target = name.partition(":")
        if colon:
            return (kind, target) if kind in KINDS and self._there(kind, target) else ("", name)
        kinds = [kind for kind in KINDS if self._there(kind, name)]
        kinds = [kind for kind in kinds if not ("body" in kinds and kind in BY_BODY)]
        return (kinds[0], name) if len(kinds) == 1 else ("", name)

    def _there(self, kind: str, name: str) -> bool:
        if kind == "body":
            return name in self.trajectory.names
        return any(str(row.get("name")) == name for row in self.trajectory.meta.get(KINDS[kind]) or ())
