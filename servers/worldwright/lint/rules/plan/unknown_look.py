"""A look does not exist.

What it does: compares `look` of objects, of their parts, of assets and of ropes, and the `floor`, with worldkit's
library and the forms `#rrggbb` and `clear #rrggbb 10mm`.

Why is this bad: building the world fails at that object.

Use instead: a look of the library, a colour, or something clear that has a colour at a depth.
"""

from collections.abc import Iterable, Iterator
from difflib import get_close_matches
from typing import Any

from ...case import Changes
from ...harm import Measured
from ...plan_view import Place, PlanView
from ...problem import Problem

CODE = "WP122"
SEVERITY = "error"
GOOD: Changes = ({"assets": [{"name": "mug", "filename": "mug", "look": "#2f6f73"}]}, {})
BAD: Changes = (
    {"assets": [{"name": "mug", "filename": "mug", "look": "shiny-ish"}]},
    {"visualization": {"floor": "wood_plank"}},
    {"topology": {"tendons": [{"name": "leash", "ends": [{"body": "crate"}, {"body": "ramp"}], "look": "bogus"}]}},
    {"assets": [{"name": "mug", "filename": "mug", "look": "#2f6"}]},
    {"assets": [{"name": "mug", "filename": "mug", "look": "clear amber"}]},
    {
        "scene_objects": [
            {"name": "ramp", "primitive": "box", "size": [2.0, 1.0, 0.2], "fixed": True, "dynamic": False},
            {
                "name": "crate",
                "primitive": "compound",
                "material": "wood",
                "parts": [{"name": "lid", "primitive": "box", "size": [0.4, 0.3, 0.2], "look": "wood_oka"}],
            },
        ]
    },
)


def _is_made(change: dict[str, Any]) -> float:
    """1 when worldkit makes the look of the case's asset, else 0."""
    import mujoco

    from worldkit import materials

    try:
        materials.add(mujoco.MjSpec(), change["assets"][0]["look"])
    except ValueError:
        return 0.0
    return 1.0


EVIDENCE = Measured("worldkit refuses the look", _is_made, 0.5)


def check(view: PlanView) -> Iterator[Problem]:
    """Check looks of objects, of parts, of assets, of ropes, of the floor."""
    from worldkit.materials import LOOKS

    used: list[tuple[Place, str | None]] = [
        *((("scene_objects", i, "look"), row.look) for i, row in enumerate(view.plan.scene_objects)),
        *(
            (("scene_objects", i, "parts", k, "look"), part.look)
            for i, row in enumerate(view.plan.scene_objects)
            for k, part in enumerate(row.parts)
        ),
        *((("assets", i, "look"), row.look) for i, row in enumerate(view.plan.assets)),
        *((("topology", "tendons", i, "look"), row.look) for i, row in enumerate(view.plan.topology.tendons)),
        (("visualization", "floor"), view.plan.visualization.floor),
    ]
    for place, look in used:
        if look is not None and not _there(look):
            near = _similar_looks(look, LOOKS) or get_close_matches(look, list(LOOKS), n=3, cutoff=0.55)
            fix = (
                "did you mean " + ", ".join(near) + "?"
                if near
                else f"or #rrggbb, or `clear #rrggbb 10mm`; kinds: {_kinds(LOOKS)} (all: worldwright retrieve read worldkit/materials/catalogue.py)"
            )
            yield view.at(place, f"there is no look `{look}`", fix)


def _there(look: str) -> bool:
    """Whether worldkit makes it."""
    from worldkit import materials

    try:
        materials.look(look)
    except ValueError:
        return False
    return True


def _similar_looks(look: str, looks: Iterable[str]) -> list[str]:
    """Looks that share a word with this one: `wood_oak` with `oak`, `felt_green` with `green_felt`."""
    words = set(look.lower().replace("-", "_").split("_"))
    shared = {name: len(words & set(name.split("_"))) for name in looks}
    return [name for name in sorted(shared, key=lambda name: -shared[name]) if shared[name]][:3]


def _kinds(looks: Iterable[str]) -> str:
    """The first words of all looks."""
    return ", ".join(dict.fromkeys(name.partition("_")[0] for name in looks))
