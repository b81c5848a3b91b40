"""What must be true of any layout: over the whole vocabulary, and for plans that make no sense."""

import math

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from worldwright.model.plan.committed import Plan
from worldwright.place.anchors import Box, wrap
from worldwright.place.engine import resolve
from worldwright.place.vocabulary import PREDICATES, RELATIONS

thrifty = settings(max_examples=60, deadline=None)
sizes_of = st.tuples(*[st.floats(0.05, 2).map(lambda v: round(v, 3))] * 3)
metres = st.floats(-2, 2).map(lambda v: round(v, 3))
gaps = st.floats(0, 1).map(lambda v: round(v, 3))
degrees = st.sampled_from([0, 0, 0, 90, -90, 180, 30, -57.5])
BODY_RELATIONS = [code for code, entry in RELATIONS.items() if entry.FAMILY != "Camera templates"]


def plan(objects, rows, relations=(), **changes) -> Plan:
    """Rows: (subject, predicate, object or None, params); relations: (name, body_a, body_b, parameters)."""
    return Plan.model_validate(
        {
            "plan_type": "scene",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 1.0, "seed": 3},
            "objectives": [{"claim": "it stands"}],
            "scene_objects": objects,
            "topology": {
                "scene_predicates": [{"subject": s, "predicate": p, "object": o, "params": q} for s, p, o, q in rows]
            },
            "geometry_relations": [
                {"relation_name": n, "body_a": a, "body_b": b, "parameters": q} for n, a, b, q in relations
            ],
            **changes,
        }
    )


def box(name, size):
    return {"name": name, "primitive": "box", "size": list(size)}


@st.composite
def worlds(draw, most=7):
    """Objects, rows and relations: each object is placed by one of the ways that the vocabulary has."""
    objects = [
        {"name": "tub", "primitive": "box_container", "size": [3, 2, 1], "wall_thickness": 0.1},
        box("o0", draw(sizes_of)),
    ]
    rows = [
        ("tub", "PLACE-ON-BASE", None, {"x": 0, "y": 0}),
        ("o0", "PLACE-ON-BASE", None, {"x": draw(metres), "y": 4}),
    ]
    relations, leaders = [], set()
    for index in range(1, draw(st.integers(2, most))):
        name, ref = f"o{index}", f"o{draw(st.integers(0, index - 1))}"
        size = draw(sizes_of)
        offset = [draw(metres), draw(metres)]
        way = draw(st.sampled_from(["on", "in", "any", "copy", "mirror", "relation", "beside"]))
        if way == "copy" and ref in leaders:
            way = "on"  # one group each
        if way == "copy":
            leaders |= {ref, name}
            size = next(o["size"] for o in objects if o["name"] == ref)
        objects.append(box(name, size))
        if way == "on":
            rows.append((name, "PLACE-ON", ref, {"offset": offset}))
        elif way == "in":
            rows.append((name, "PLACE-IN", "tub", {"offset": offset, "gap": draw(gaps)}))
        elif way == "any":
            rows.append((name, "PLACE-ANYWHERE", "base", {"area": [20, 20], "center": [0, -20], "spacing": draw(gaps)}))
        elif way == "mirror":
            rows.append(
                (name, "SYMMETRY-ALONG", "tub", {"of": ref, "axis": draw(st.sampled_from(["LR", "FB", "both"]))})
            )
            rows.append((name, "HEIGHT", None, {"bottom": draw(gaps)}))
        elif way == "beside":
            rows.append((name, "PLACE-ON-BASE", None, {}))
            rows.append((name, draw(st.sampled_from(["LEFT-OF", "RIGHT-OF"])), ref, {"gap": draw(gaps)}))
            rows.append((name, draw(st.sampled_from(["ALIGN-FRONT", "ALIGN-BACK", "ALIGN-CENTER-FB"])), ref, {}))
        elif way == "copy":
            member = f"m{index}"
            objects += [box(f"{member}a", (0.1, 0.1, 0.1)), box(f"{member}b", (0.1, 0.1, 0.1))]
            rows.append((f"{member}a", "PLACE-ON", ref, {"offset": [0.0, 0.0]}))
            rows.append((ref, "GROUP", None, {"members": [f"{member}a"]}))
            rows.append(
                (name, "COPY-GROUP", ref, {"members": [f"{member}b"], "offset": offset, "turn_deg": draw(degrees)})
            )
        else:
            code = draw(
                st.sampled_from([c for c in BODY_RELATIONS if c.startswith("adjacent") or c == "centered_on_ref"])
            )
            relations.append((code, name, ref, {"gap": draw(gaps)} if code.startswith("adjacent") else {}))
        if way != "copy" and draw(st.booleans()):
            turn = draw(
                st.sampled_from(["FACING-LEFT", "FACING-SAME-AS", "FACING-OPPOSITE-TO", "RANDOM-ROT", "FACING-TO"])
            )
            params = {"min_deg": -90, "max_deg": 90} if turn == "RANDOM-ROT" else {}
            rows.append((name, turn, None if turn in ("FACING-LEFT", "RANDOM-ROT") else "o0", params))
    return objects, rows, relations


@given(worlds())
@settings(max_examples=120, deadline=None)
def test_whatever_is_accepted_holds(world):
    resolution = resolve(plan(*world))
    told = {f.code for f in resolution.scene.findings}
    assert told <= {"WP202", "WP204", "WP206", "WP208", "WP301"}, resolution.scene.findings
    if not resolution.scene.ok:
        return
    assert {o.name for o in resolution.scene.objects} == {o["name"] for o in world[0]}
    for row in resolution.statements:
        margin = row.entry.holds(resolution.boxes[row.subject], resolution.reference(row), row.params)
        assert margin >= 0, row
    for placed in resolution.scene.objects:
        assert {f.split(" = ")[0] for f in placed.provenance} >= {"x", "y", "z"}


@given(worlds(), st.randoms(use_true_random=False))
@thrifty
def test_the_order_of_rows_does_not_matter(world, random):
    objects, rows, relations = world
    mixed = random.sample(rows, len(rows))
    one, other = (
        resolve(plan(*world)).scene,
        resolve(plan(objects, mixed, random.sample(relations, len(relations)))).scene,
    )
    assert {f.code for f in one.findings} == {f.code for f in other.findings}
    assert {(o.name, o.position, o.deg_z) for o in one.objects} == {
        (o.name, o.position, o.deg_z) for o in other.objects
    }


QUARTER = {
    "FRONT-OF": "LEFT-OF", "LEFT-OF": "BACK-OF", "BACK-OF": "RIGHT-OF", "RIGHT-OF": "FRONT-OF",
    "ALIGN-FRONT": "ALIGN-LEFT", "ALIGN-LEFT": "ALIGN-BACK", "ALIGN-BACK": "ALIGN-RIGHT", "ALIGN-RIGHT": "ALIGN-FRONT",
    "ALIGN-CENTER-FB": "ALIGN-CENTER-LR", "ALIGN-CENTER-LR": "ALIGN-CENTER-FB",
    "FACING-FRONT": "FACING-LEFT", "FACING-LEFT": "FACING-BACK", "FACING-BACK": "FACING-RIGHT", "FACING-RIGHT": "FACING-FRONT",
}  # fmt: skip
"""Each predicate's name when the world is turned by 90 degrees."""
ALONG_Y = ("ALIGN-LEFT", "ALIGN-RIGHT", "ALIGN-CENTER-LR")
SIDES = {"plus_x": "plus_y", "plus_y": "minus_x", "minus_x": "minus_y", "minus_y": "plus_x"}


@st.composite
def square_worlds(draw):
    """Rows about world axes only, every heading said."""
    objects = [box("o0", draw(sizes_of))]
    rows = [("o0", "PLACE-ON-BASE", None, {"x": draw(metres), "y": draw(metres)}), ("o0", "FACING-FRONT", None, {})]
    relations = []
    for index in range(1, draw(st.integers(2, 7))):
        name, ref = f"o{index}", f"o{draw(st.integers(0, index - 1))}"
        objects.append(box(name, draw(sizes_of)))
        rows.append(
            (
                name,
                draw(st.sampled_from(["FACING-FRONT", "FACING-LEFT", "FACING-BACK"])),
                None,
                {"turn_deg": draw(degrees)},
            )
        )
        way = draw(st.sampled_from(["rows", "on", "adjacent"]))
        if way == "on":
            rows.append((name, "PLACE-ON", ref, {"offset": [draw(metres) / 8, draw(metres) / 8]}))
        elif way == "adjacent":
            level = draw(st.sampled_from(["top_flush", "bottom_flush", "centers"]))
            relations.append((f"adjacent_{draw(st.sampled_from(list(SIDES)))}_{level}", name, ref, {"gap": draw(gaps)}))
        else:
            rows.append((name, "PLACE-ON-BASE", None, {"gap": draw(gaps)}))
            for choice in (("FRONT-OF", "BACK-OF", "ALIGN-FRONT", "ALIGN-BACK", "ALIGN-CENTER-FB"),
                           ("LEFT-OF", "RIGHT-OF", "ALIGN-LEFT", "ALIGN-RIGHT", "ALIGN-CENTER-LR")):  # fmt: skip
                code = draw(st.sampled_from(choice))
                rows.append(
                    (name, code, ref, {"gap": draw(gaps)} if code.endswith("-OF") else {"offset": draw(metres)})
                )
    return objects, rows, relations


def turned_row(row):
    name, code, ref, params = row
    params = dict(params)
    if code == "PLACE-ON-BASE" and "x" in params:
        params["x"], params["y"] = -params["y"], params["x"]
    if code in ALONG_Y:
        params["offset"] = -params["offset"]
    return name, QUARTER.get(code, code), ref, params


@given(square_worlds())
@thrifty
def test_a_world_turned_by_ninety_degrees(world):
    objects, rows, relations = world
    turned_relations = []
    for code, a, b, params in relations:
        side = next(s for s in SIDES if f"adjacent_{s}_" in code)
        turned_relations.append((code.replace(side, SIDES[side]), a, b, params))
    one = resolve(plan(*world)).scene
    other = resolve(plan(objects, [turned_row(r) for r in rows], turned_relations)).scene
    assert [o.name for o in one.objects] == [o.name for o in other.objects]
    for before, after in zip(one.objects, other.objects, strict=True):
        x, y, z = before.position
        assert after.position == pytest.approx((-y, x, z), abs=2e-5)
        assert wrap(after.deg_z - before.deg_z - 90) == pytest.approx(0, abs=1e-4)


@given(worlds(), metres, metres)
@thrifty
def test_a_world_moved_as_a_whole(world, dx, dy):
    """Everything hangs on the tub and the first box; what is drawn on the base is not part of it."""
    objects, rows, relations = world
    assume(not any(code == "PLACE-ANYWHERE" for _, code, _, _ in rows))

    def at(x, y):
        moved = []
        for name, code, ref, params in rows:
            if code == "PLACE-ON-BASE" and "x" in params:
                params = {"x": params["x"] + x, "y": params["y"] + y}
            moved.append((name, code, ref, params))
        return resolve(plan(objects, moved, relations)).scene

    here, there = at(0, 0), at(dx, dy)
    assert [f.code for f in here.findings] == [f.code for f in there.findings] or any(
        f.code == "WP301" for f in (*here.findings, *there.findings)
    )
    for before, after in zip(here.objects, there.objects, strict=True):
        x, y, z = before.position
        assert after.position == pytest.approx((x + dx, y + dy, z), abs=2e-5)


placed_boxes = st.builds(
    lambda size, x, y, yaw: Box("b", size, x=x, y=y, z=size[2] / 2, yaw=yaw),
    sizes_of,
    metres,
    metres,
    st.floats(-180, 180),
)


@given(placed_boxes, placed_boxes)
@thrifty
def test_left_and_right_front_and_back_are_opposites(a, b):
    for one, other in (("LEFT-OF", "RIGHT-OF"), ("FRONT-OF", "BACK-OF")):
        forth, back = PREDICATES[one].holds(a, b, {}), PREDICATES[other].holds(b, a, {})
        assert forth == pytest.approx(back, abs=1e-9)
        assert not (forth > 2e-3 and PREDICATES[one].holds(b, a, {}) > 2e-3), "not both left of each other"


@given(placed_boxes, placed_boxes, st.sampled_from(["LR", "FB", "both"]))
@thrifty
def test_a_mirror_image_of_a_mirror_image_is_the_original(of, about, axis):
    mirror = PREDICATES["SYMMETRY-ALONG"]
    image = Box("image", of.size, yaw=0.0)
    again = Box("again", of.size, yaw=0.0)
    for dof in ("x", "y"):
        setattr(image, dof, mirror.resolve(dof, image, about, {"of": of, "axis": axis}).value)
    for dof in ("x", "y"):
        setattr(again, dof, mirror.resolve(dof, again, about, {"of": image, "axis": axis}).value)
    assert (again.x, again.y) == pytest.approx((of.x, of.y), abs=1e-9)


@given(placed_boxes, placed_boxes)
@thrifty
def test_two_that_face_each_other_face_opposite_ways(a, b):
    assume(math.hypot(a.x - b.x, a.y - b.y) > 1e-3)
    face = PREDICATES["FACING-TO"]
    forth, back = face.resolve("yaw", a, b, {}).value, face.resolve("yaw", b, a, {}).value
    assert abs(wrap(forth - back)) == pytest.approx(180, abs=1e-6)


anything = st.none() | st.booleans() | st.integers() | st.floats() | st.text(max_size=5) | st.lists(
    st.floats() | st.sampled_from(["a", "b", "c", "zz"]), max_size=3
) | st.sampled_from(["a", "b", "LR", "plus_x", "inside", "TO_CLARIFY"])  # fmt: skip
KEYS = sorted({key for shelf in (PREDICATES, RELATIONS) for entry in shelf.values() for key in entry.PARAMS})
params = st.dictionaries(st.sampled_from(KEYS), anything, max_size=4)
names = st.sampled_from(["a", "b", "c", "view", "zz"])
others = st.sampled_from([None, "a", "b", "c", "base", "zz", "the scene"])


@given(
    st.lists(st.tuples(names, st.sampled_from([*PREDICATES, "x"]), others, params), max_size=8),
    st.lists(st.tuples(st.sampled_from([*RELATIONS, "x"]), names, others, params), max_size=5),
)
@settings(max_examples=250, deadline=None)
def test_any_plan_gives_poses_or_typed_findings(rows, relations):
    objects = [
        box("a", (1, 1, 1)),
        {"name": "b", "primitive": "box_container", "size": [1, 1, 1], "wall_thickness": 0.1},
        box("c", (0.2, 0.3, 0.4)),
    ]
    steps = [{"description": "look", "cameras": [{"name": "view"}]}]
    scene = resolve(plan(objects, rows, relations, implementation_steps=steps)).scene
    placed = {o.name for o in scene.objects}
    assert placed == {"a", "b", "c"} or not scene.ok
    assert all(f.message and f.fix and f.code.startswith("WP") for f in scene.findings)
    for placed_object in scene.objects:
        assert all(map(math.isfinite, (*placed_object.position, placed_object.deg_z)))


def test_a_leader_leads_one_group():
    objects = [box(name, (0.1, 0.1, 0.1)) for name in ("a", "b", "c")]
    rows = [(name, "PLACE-ON-BASE", None, {"x": k, "y": 0}) for k, name in enumerate("abc")]
    rows += [("a", "GROUP", None, {"members": ["b"]}), ("a", "GROUP", None, {"members": ["c"]})]
    found = resolve(plan(objects, rows)).scene.findings
    assert [finding.code for finding in found] == ["WP212"] and "leads a group already" in found[0].message
