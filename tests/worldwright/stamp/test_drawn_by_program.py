"""What a program draws beside the plan's bodies is listed by name, and said to be as large as one where it is."""

from worldwright.lint.case import plan_with
from worldwright.lint.rules.model.acting._twins import PLAN
from worldwright.stamp import drawn_by_program


def geom(name, body, *half, visible=True, collides=False):
    return {"name": name, "body": body, "aabb": [0, 0, 0, *half], "visible": visible, "collides": collides}


def test_a_drawn_twin_of_a_planned_body_is_listed_and_what_is_on_a_body_is_not():
    crate = (0.2, 0.15, 0.1)
    meta = {
        "bodies": [{"name": "crate", "parent": "world"}, {"name": "twin", "parent": "world"}]
        + [{"name": name, "parent": "world"} for name in ("crate_2", "crate_ghost")],
        "geoms": [
            geom("ground", "world", 9, 9, 9, collides=True),
            geom("crate", "crate", *crate, visible=False, collides=True),
            geom("dot", "crate", 0.001, 0.001, 0.001),
            geom("scenery", "world", 0.1, 0.2, 0.15),
            geom("", "twin", *crate),
            geom("", "crate_2", *crate),
            geom("", "crate_ghost", *crate),
            geom("", "world", 0.5, 0.5, 0.01),
            geom("stop", "world", 1, 1, 1, visible=False),
        ],
    }
    assert drawn_by_program.listed(meta, plan_with(PLAN)) == (
        "scenery (0.4 m, as large as crate)",
        "twin (0.4 m, as large as crate)",
        "crate_ghost (0.4 m, as large as crate)",
        "a shape without a name (1 m)",
    )
