"""Each check finds what it is for, at its size, and leaves a sound layout alone."""

from types import SimpleNamespace

import mujoco
import pytest
import trimesh

from worldkit import models
from worldwright.lint import tools as lint
from worldwright.model.plan.committed import Plan
from worldwright.model.plan.implementation_steps import CameraRow
from worldwright.model.plan.observation import Viewpoint
from worldwright.place import categories
from worldwright.place.checks import check, framing, penetration
from worldwright.place.engine import resolve

TABLE = {"name": "table", "primitive": "box", "size": [1.2, 0.8, 0.75], "fixed": True}
ON_GROUND = {"subject": "table", "predicate": "PLACE-ON-BASE", "params": {"x": 0, "y": 0}}


def report(objects, rows, *, exact=False, topology=None, folder=None, **changes):
    """What `check` says about a plan of scene objects; a row is (subject, predicate, object, params) or a mapping."""
    listed = [
        r if isinstance(r, dict) else dict(zip(("subject", "predicate", "object", "params"), r, strict=True))
        for r in rows
    ]
    plan = Plan.model_validate(
        {
            "plan_type": "scene",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 1.0},
            "objectives": [{"claim": "everything stands"}],
            "scene_objects": objects,
            "topology": {"scene_predicates": listed, **(topology or {})},
            **changes,
        }
    )
    plan = plan if folder is None else plan.read_from(folder)
    resolution = resolve(plan)
    assert resolution.scene.ok, resolution.scene.findings
    return check(plan, resolution, locate=lambda *path: None, exact=exact)


def codes(found) -> dict[str, list[str]]:
    told: dict[str, list[str]] = {}
    for finding in found.findings:
        told.setdefault(finding.code, []).append(finding.message)
    return told


def box(name, *size, **more):
    return {"name": name, "primitive": "box", "size": list(size), **more}


def on(name, where, x=0.0, y=0.0, **params):
    return (name, "PLACE-ON", where, {"offset": [x, y], **params})


def test_a_sound_layout_has_no_findings():
    found = report([TABLE, box("mug", 0.08, 0.08, 0.1)], [ON_GROUND, on("mug", "table", 0.2, 0.1)], exact=True)
    assert not found.findings
    assert found.ok


LID = [box("jar", 0.1, 0.1, 0.2, fixed=True), box("lid", 0.1, 0.1, 0.02, fixed=True)]
SUNK = [("jar", "PLACE-ON-BASE", None, {"x": 0, "y": 0})]


@pytest.mark.parametrize("exact", [False, True])
@pytest.mark.parametrize(("up_to_m", "code"), [(None, "WP302"), (0.004, None), (0.002, "WP302"), (0.02, "WP327")])
def test_what_belongs_together_may_overlap_as_far_as_the_plan_says(up_to_m, code, exact):
    rows = [] if up_to_m is None else [{"between": ["lid", "jar"], "up_to_m": up_to_m, "why": "the rim of the lid"}]
    topology = {"body_positions": {"lid": {"x": 0, "y": 0, "z": 0.207}}, "overlaps": rows}
    found = codes(report(LID, SUNK, exact=exact, topology=topology))
    told = {c: messages for c, messages in found.items() if c in ("WP302", "WP327")}
    assert set(told) == ({code} if code else set()), found
    if up_to_m == 0.002:
        assert "0.003 m, 0.001 m more than `topology.overlaps`" in told["WP302"][0]


@pytest.mark.parametrize("between", [["peg", "plate"], ["peg", "peg"]])
def test_a_row_that_lets_copies_overlap_too_far_is_told_once(between):
    row = {"between": between, "up_to_m": 0.06, "why": "a tight fit"}
    fine = {"between": ["plate", "peg"], "up_to_m": 0.01, "why": "another"}
    places = {f"peg_{k + 1}": {"x": 0.5 * k, "y": 1, "z": 0.05} for k in range(3)} | {
        "plate": {"x": 0, "y": 0, "z": 0.05}
    }
    found = report(
        [box("peg", 0.1, 0.1, 0.1, count=3, fixed=True), box("plate", 0.1, 0.1, 0.1, fixed=True)], [],
        topology={"body_positions": places, "overlaps": [fine, row]},
    )  # fmt: skip
    assert codes(found)["WP327"] == [
        f"`topology.overlaps` lets peg and {between[1]} overlap by 0.06 m, more than half of `peg` (0.1 m)"
    ]


def test_what_is_welded_may_lie_in_each_other_and_every_other_pair_is_told_at_once():
    leaf = [box(name, 0.07, 0.025, 0.001) for name in ("leaf", "lee", "tip")]
    twig = [box(name, 0.01, 0.01, 0.13) for name in ("one", "two", "three")]
    pairs = [("leaf", "lee"), ("leaf", "tip"), ("one", "two"), ("two", "three")]
    found = report(
        [*leaf, *twig], [],
        topology={
            "body_positions": {row["name"]: {"x": 0.1 * k, "y": 1, "z": 0.5} for k, row in enumerate((*leaf, *twig))},
            "joints": [
                {"name": "midrib", "type": "weld", "parent": "leaf", "child": "lee"},
                {"name": "stalk", "type": "weld", "parent": "lee", "child": "tip"},
                {"name": "bend", "type": "hinge", "parent": "one", "child": "two", "axis": [0, 1, 0]},
            ],
            "overlaps": [{"between": list(pair), "up_to_m": 0.02, "why": "one grown thing"} for pair in pairs],
        },
    )  # fmt: skip
    told = [finding for finding in found.findings if finding.code == "WP327"]
    assert [finding.message.split(" lets ")[1].split(" overlap")[0] for finding in told] == [
        "one and two",
        "two and three",
    ]
    assert "what joint `bend` joins does not collide" in told[0].fix and "weld them" in told[1].fix


def test_many_things_are_not_all_measured_in_every_picture(monkeypatch):
    layout = SimpleNamespace(
        plan=SimpleNamespace(
            cameras=lambda: (CameraRow(name="one"), CameraRow(name="two")),
            movers=lambda: ["mug"],
            recording_mode=SimpleNamespace(size=(640, 360)),
        ),
        placed=dict.fromkeys(("mug", "a", "b", "c")),
        scene=SimpleNamespace(cameras=()),
    )
    monkeypatch.setattr(framing.in_view, "spoken_of", lambda plan: ("mug", "a", "b", "c"))
    monkeypatch.setattr(framing, "MOST_MEASURED", 4)
    assert framing._camera(layout, CameraRow(name="one"))["measured"] == ["mug", "a"]
    other = framing._camera(layout, CameraRow(name="two", subjects=("c",)))
    assert other["measured"] == ["c", "mug", "a"], "what one picture is asked about, each is"


def test_an_overlap_with_what_has_no_place_says_that_its_size_is_unknown():
    row = SimpleNamespace(between=("jar", "cloth"), up_to_m=0.01, why="it lies on it")
    told = []
    layout = SimpleNamespace(
        plan=SimpleNamespace(topology=SimpleNamespace(overlaps=(row,), joints=()), families={}),
        placed={"jar": SimpleNamespace(size=(0.1, 0.1, 0.1))},
        problems=SimpleNamespace(add=lambda *said, severity: told.append((said[0], said[2], severity))),
    )
    penetration._too_much(layout)
    assert [(code, severity) for code, _, severity in told] == [("WP327", "warning")] and "`cloth`" in told[0][1]


# --- hills ----------------------------------------------------------------------------------------------------------

SLOPE = 0.25
HILLS = {
    "hfield": """<mujoco><asset><hfield name="h" nrow="2" ncol="2" size="5 5 2.5 1" elevation="0 1 0 1"/></asset>
      <worldbody><body name="hill"><geom type="hfield" hfield="h"/></body></worldbody></mujoco>""",
    "off_centre": """<mujoco><asset><hfield name="h" nrow="2" ncol="2" size="5 5 2.5 1" elevation="0 1 0 1"/></asset>
      <worldbody><body name="hill"><geom type="hfield" hfield="h" pos="2 -1 -3"/></body></worldbody></mujoco>""",
    "mesh": """<mujoco><asset><mesh name="h" vertex="-5 -5 -1 -5 5 -1 5 -5 -1 5 5 -1 -5 -5 0 -5 5 0 5 -5 2.5 5 5 2.5"/></asset>
      <worldbody><body name="hill"><geom type="mesh" mesh="h"/></body></worldbody></mujoco>""",
}


@pytest.fixture(params=sorted(HILLS))
def on_a_hill(request, tmp_path):
    """What is found of a ball of 0.4 m whose surface is so far from a slope, straight up."""
    (tmp_path / "hill.xml").write_text(HILLS[request.param])

    def found(above):
        place = {"x": 1.0, "y": 0.3, "z": 1.0 + SLOPE * 6.0 + 0.2 * (1 + SLOPE**2) ** 0.5 + above}
        return codes(
            report(
                [{"name": "ball", "primitive": "sphere", "size": [0.4] * 3}],
                [("hill", "PLACE-ON-BASE", None, {"x": 0, "y": 0})],
                assets=[{"name": "hill", "type": "mjcf", "filename": "hill.xml", "fixed": True}],
                topology={"body_positions": {"ball": place}},
                exact=True,
                folder=tmp_path,
            )
        )

    return found


def test_what_stands_on_a_hill_stands(on_a_hill):
    assert not on_a_hill(0.0003)


@pytest.mark.parametrize("above", [0.005, 0.4])
def test_what_is_above_a_hill_falls_as_far_as_the_hill_is_below(on_a_hill, above):
    (said,) = on_a_hill(above)["WP304"]
    assert "above `hill`" in said
    assert float(said.split("starts ")[1].split(" m")[0]) == pytest.approx(above, abs=2e-3)


@pytest.mark.parametrize("deep", [0.05, 0.35])
def test_what_sinks_into_a_hill_is_as_deep_as_geometry_says(on_a_hill, deep):
    told = on_a_hill(-deep)
    assert set(told) == {"WP302"}
    depth = float(told["WP302"][0].split("by ")[1].split(" m")[0])
    assert depth == pytest.approx(deep / (1 + SLOPE**2) ** 0.5, abs=3e-3)


def test_a_model_beside_the_plan_stands_there_with_the_meshes_that_it_reads(tmp_path):
    """The block of its file is 0.2 m high, and what is put into it by 5 cm sinks in by so much."""
    block = trimesh.creation.box((1, 1, 0.2))
    (tmp_path / "parts").mkdir()
    block.export(tmp_path / "parts/block.stl")
    block = '<mujoco><asset><mesh name="b" file="parts/block.stl"/></asset><worldbody><body name="block"><geom type="mesh" mesh="b"/></body></worldbody></mujoco>'
    (tmp_path / "block.xml").write_text(block)
    told = codes(
        report(
            [{"name": "ball", "primitive": "sphere", "size": [0.4] * 3}],
            [("block", "PLACE-ON-BASE", None, {"x": 0, "y": 0})],
            assets=[{"name": "block", "type": "mjcf", "filename": "block.xml", "fixed": True}],
            topology={"body_positions": {"ball": {"x": 0.0, "y": 0.0, "z": 0.35}}},
            exact=True,
            folder=tmp_path,
        )
    )
    assert float(told["WP302"][0].split("by ")[1].split(" m")[0]) == pytest.approx(0.05, abs=2e-3)


@pytest.mark.parametrize("low", [0.0, -0.4])
@pytest.mark.parametrize("kind", ["hfield", "off_centre"])
def test_a_hill_reaches_below_the_ground_as_far_as_its_base_does(kind, low, tmp_path):
    """The base is one metre thick and the hill 2.5 m high, so its middle lies 1.75 m above its lowest point."""
    (tmp_path / "hill.xml").write_text(HILLS[kind])
    told = codes(
        report(
            [],
            [],
            assets=[{"name": "hill", "type": "mjcf", "filename": "hill.xml", "fixed": True}],
            topology={"body_positions": {"hill": {"x": 0, "y": 0, "z": 1.75 + low}}},
            folder=tmp_path,
        )
    )
    assert ("WP303" in told) is (low < 0)
    if low < 0:
        assert "reaches 0.4 m below the ground" in told["WP303"][0]


@pytest.mark.parametrize("kind", ["hfield", "off_centre"])
@pytest.mark.parametrize("deep", [-0.002, 0.05])
def test_the_compiled_hill_is_where_the_plan_has_it(kind, deep, tmp_path):
    """A ball of 0.4 m over the slope's place x = 1 m, straight up: WM112 where it is sunk, and only there."""
    spec = mujoco.MjSpec()
    models.attach(spec, HILLS[kind], name="hill", pos=(0, 0, 1.75), fixed=True)
    height = 1.0 + SLOPE * 6.0 + 0.2 * (1 + SLOPE**2) ** 0.5 - deep
    ball = spec.worldbody.add_body(name="ball", pos=(1.0, 0.3, height))
    ball.add_freejoint()
    ball.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=(0.2, 0, 0))
    spec.compile()
    (tmp_path / "world.xml").write_text(spec.to_xml())
    found = [f for f in lint.check_program([tmp_path / "world.xml"]).findings if f.code == "WM112"]
    assert bool(found) is (deep > 0)
    assert all("hill" in f.message and "ball" in f.message for f in found)


# --- held by a constraint -------------------------------------------------------------------------------------------

PINS = {"kind": "constraint", "bodies": ["cloth"], "law": "two edges are held fast", "source": "the prompt"}


@pytest.mark.parametrize(("pins", "falls"), [([], True), ([PINS], False)])
def test_a_pinned_cloth_does_not_fall(pins, falls):
    told = codes(
        report(
            [box("cloth", 1.0, 1.0, 0.01)],
            [],
            topology={"body_positions": {"cloth": {"x": 0, "y": 0, "z": 0.305}}},
            simulation_parameters={"time_step": 0.002, "simulation_duration": 1.0, "interventions": pins},
        )
    )
    assert ("WP304" in told) is falls


# --- support --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("x", "tips"), [(0.55, False), (0.599, False), (0.602, True)])
def test_the_centre_of_mass_decides_what_tips(x, tips):
    """A plank of 0.4 m across the table's edge at 0.6 m: it tips when its middle is beyond the edge."""
    rows = [ON_GROUND, {"subject": "board", "predicate": "HEIGHT", "params": {"bottom": 0.75}},
            ("board", "ALIGN-CENTER-FB", "table", {"offset": x}), ("board", "ALIGN-CENTER-LR", "table", {})]  # fmt: skip
    told = codes(report([TABLE, box("board", 0.4, 0.1, 0.02)], rows))
    assert ("WP307" in told) is tips
    if tips:
        assert "0.002 m beyond the edge" in told["WP307"][0]


def test_a_plank_on_two_posts_does_not_tip():
    objects = [box("a", 0.1, 0.1, 0.5, fixed=True), box("b", 0.1, 0.1, 0.5, fixed=True), box("beam", 1.0, 0.1, 0.02)]
    rows = [("a", "PLACE-ON-BASE", None, {"x": -0.4, "y": 0}), ("b", "PLACE-ON-BASE", None, {"x": 0.4, "y": 0}),
            {"subject": "beam", "predicate": "HEIGHT", "params": {"bottom": 0.5}},
            ("beam", "ALIGN-CENTER-FB", "base", {}), ("beam", "ALIGN-CENTER-LR", "base", {})]  # fmt: skip
    assert not report(objects, rows).findings
    assert "WP307" in codes(report(objects[1:], rows[1:]))


def test_what_floats_is_found_loose_or_fixed():
    rows = [{"subject": "sign", "predicate": "HEIGHT", "params": {"bottom": 1.2}},
            ("sign", "ALIGN-CENTER-FB", "base", {}), ("sign", "ALIGN-CENTER-LR", "base", {})]  # fmt: skip
    (message,) = codes(report([box("sign", 0.5, 0.1, 0.3)], rows))["WP304"]
    assert "1.2 m above the ground" in message
    (message,) = codes(report([box("sign", 0.5, 0.1, 0.3, fixed=True)], rows))["WP309"]
    assert "1.2 m up" in message
    post = box("post", 0.1, 0.1, 2.0, fixed=True)
    beside = [("post", "PLACE-ON-BASE", None, {"x": 0.3, "y": 0}), *rows]
    assert "WP309" not in codes(report([post, box("sign", 0.5, 0.1, 0.3, fixed=True)], beside)), "it touches a post"


def test_penetration_is_measured_with_exact_shapes():
    balls = [{"name": n, "primitive": "sphere", "size": [0.2] * 3, "dynamic": False, "fixed": True} for n in "ab"]
    apart = [("a", "PLACE-ON-BASE", None, {"x": 0, "y": 0}), ("b", "PLACE-ON-BASE", None, {"x": 0.15, "y": 0.15})]
    assert report(balls, apart, exact=False).findings[0].code == "WP302", "their boxes overlap"
    assert not report(balls, apart, exact=True).findings
    near = [apart[0], ("b", "PLACE-ON-BASE", None, {"x": 0.18, "y": 0})]
    (message,) = codes(report(balls, near, exact=True))["WP302"]
    assert "0.02 m" in message


# --- containment and clearance ---------------------------------------------------------------------------------------


def test_what_reaches_into_a_wall_is_not_contained():
    tank = {"name": "tank", "primitive": "box_container", "size": [1, 1, 0.5], "wall_thickness": 0.05, "fixed": True,
            "construction_source": "generated_boundary"}  # fmt: skip
    rows = [("tank", "PLACE-ON-BASE", None, {"x": 0, "y": 0}), on("brick", "tank", 0.42, 0.0)]
    (message,) = codes(report([tank, box("brick", 0.2, 0.1, 0.1)], rows))["WP310"]
    assert "0.07 m into its wall" in message
    assert "WP310" not in codes(report([tank, box("brick", 0.2, 0.1, 0.1)], [rows[0], on("brick", "tank", 0.3)]))


@pytest.mark.parametrize(("exact", "free"), [(False, 0.141421), (True, 0.2)])
def test_clearances_are_measured(exact, free):
    """Two balls of 0.2 m, 0.4 m apart along a diagonal: their boxes are nearer than they are."""
    d = 0.4 / 2**0.5
    balls = [{"name": n, "primitive": "sphere", "size": [0.2] * 3, "fixed": True} for n in "ab"]
    rows = [("a", "PLACE-ON-BASE", None, {"x": 0, "y": 0}), ("b", "PLACE-ON-BASE", None, {"x": d, "y": d})]
    density = {"clearance": [{"between": ["a", "b"], "min_m": 0.25}]}
    (message,) = codes(report(balls, rows, exact=exact, layout_density=density))["WP308"]
    measured = float(message.split(" is ")[1].split(" m ")[0])
    assert measured == pytest.approx(free if exact else 2**0.5 * (d - 0.2), abs=2e-4)
    assert not report(
        balls, rows, exact=True, layout_density={"clearance": [{"between": ["a", "b"], "min_m": 0.19}]}
    ).findings


def test_clearance_around_ignores_what_rests_on_it():
    objects = [TABLE, box("mug", 0.08, 0.08, 0.1), box("crate", 0.3, 0.3, 0.3), box("stool", 0.3, 0.3, 0.45)]
    rows = [ON_GROUND, on("mug", "table"), ("crate", "PLACE-ON-BASE", None, {"x": 1.0, "y": 0}),
            ("stool", "PLACE-ON-BASE", None, {"x": 0, "y": 0.6})]  # fmt: skip
    told = codes(
        report(objects, rows, layout_density={"clearance": [{"around": "table", "min_m": 0.3, "ignoring": ["stool"]}]})
    )
    assert [m.split("`")[1] for m in told["WP308"]] == ["crate"]


# --- density ---------------------------------------------------------------------------------------------------------


def test_density_targets():
    objects = [TABLE, *(box(f"mug_{i}", 0.1, 0.1, 0.1) for i in range(3)), box("lid", 0.1, 0.1, 0.01)]
    rows = [ON_GROUND, *(on(f"mug_{i}", "table", 0.2 * i) for i in range(3)), on("lid", "mug_0")]

    def told(**density):
        return codes(report(objects, rows, layout_density=density)).get("WP315", [])

    assert not told(table={"min_objects": 4, "max_objects": 4, "min_kinds": 2, "min_fill": 0.031, "max_fill": 0.032})
    assert "4 objects, fewer than 5" in told(table={"min_objects": 5})[0]
    assert "2 kinds" in told(table={"min_kinds": 3})[0]
    assert "3.1%" in told(table={"max_fill": 0.03})[0]
    assert not told(scene={"min_objects": 5, "area": [1.2, 0.8], "min_fill": 0.99, "envelope": [1.2, 0.8, 0.86]})
    assert "0.06 m out" in " ".join(told(scene={"envelope": [1.2, 0.8, 0.80]}))
    for wrong in (
        {"table": {"least": 3}},
        {"shelf": {"min_objects": 1}},
        {"table": {"surface": "inside"}},
        {"clearance": [3]},
    ):
        assert "WP320" in codes(report(objects, rows, layout_density=wrong)), wrong


# --- sizes -----------------------------------------------------------------------------------------------------------


def test_the_table_of_categories_is_sound():
    table = categories.table()
    assert len(table) >= 150
    for row in table.values():
        assert 0 < row.low_m < row.high_m
        assert row.kind in ("support", "seat", "container", "terrain", "large", "thing")
        assert row.rests_on in ("ground", "support", "any")
        assert len(row.source) > 10
        assert row.seat_share is None or 0 < row.seat_share[0] <= row.seat_share[1] <= 1


@pytest.mark.parametrize(
    ("name", "category"),
    [("dining_chair_2", "dining chair"), ("chair_leg", None), ("upperBook", "book"), ("books", "book"), ("toy_car", None),
     ("mug_left", "mug"), ("shelves_3", "shelf"), ("x9", None), ("poolTable", "pool table"), ("car_b", "car")],
)  # fmt: skip
def test_an_objects_category_is_its_head(name, category):
    found = categories.named(name)
    assert (found.name if found else None) == category


def test_heights_against_their_category():
    rows = [ON_GROUND]
    assert not report([TABLE], rows).findings
    (finding,) = report([{**TABLE, "size": [1.2, 0.8, 1.4]}], rows).findings
    assert (finding.code, finding.severity) == ("WP316", "warning")
    (finding,) = report([{**TABLE, "size": [1.2, 0.8, 7.5]}], rows).findings
    assert (finding.code, finding.severity) == ("WP316", "warning"), "its name alone says what it is"
    assert not report(
        [{**TABLE, "name": "toy_table", "size": [0.2, 0.1, 0.1]}], [{**ON_GROUND, "subject": "toy_table"}]
    ).findings


@pytest.mark.parametrize(("height", "severity"), [(0.3, "warning"), (1.5, "error")])
def test_the_height_of_a_model_whose_category_is_known(height, severity):
    mug = {"name": "mug", "type": "mesh", "filename": "mug"}
    found = report([TABLE], [ON_GROUND, on("mug", "table")], assets=[mug], asset_dimensions={"mug": height})
    assert [f.severity for f in found.findings if f.code == "WP316"] == [severity]


def test_a_bed_of_a_press_and_a_stove_that_is_a_plate_keep_no_plan_waiting():
    rows = [{**ON_GROUND, "subject": "bed"}, ("stove", "PLACE-ON-BASE", None, {"x": 2, "y": 0})]
    found = report([box("bed", 0.4, 0.4, 0.02, fixed=True), box("stove", 0.6, 0.5, 0.03, fixed=True)], rows)
    told = [f for f in found.findings if f.code == "WP316"]
    assert found.ok and len(told) == 2 and "if the name means something else" in told[0].fix


@pytest.mark.parametrize(("height", "severity"), [(0.85, None), (1.15, "warning"), (0.72, None)])
def test_a_seat_is_lower_than_its_table(height, severity):
    chair = box("dining_chair", 0.45, 0.45, height, fixed=True)
    rows = [ON_GROUND, ("dining_chair", "PLACE-ON-BASE", None, {"x": 0, "y": 0.7})]
    found = [f for f in report([TABLE, chair], rows).findings if f.code == "WP317"]
    assert [f.severity for f in found] == ([severity] if severity and height > 1.5 else [])
    tall = report([{**TABLE, "size": [1.2, 0.8, 0.4]}, chair], rows)
    assert any(f.code == "WP317" for f in tall.findings) is (0.42 * height > 0.25)


# --- completeness ----------------------------------------------------------------------------------------------------


def test_implied_supports_and_what_is_only_spoken_of():
    plate = box("plate", 0.25, 0.25, 0.03)
    told = codes(report([plate], [("plate", "PLACE-ON-BASE", None, {"x": 0, "y": 0})]))
    assert "usually rests on something" in told["WP318"][0]
    rows = [ON_GROUND, on("plate", "table")]
    claim = [{"claim": "The plate slides off the table onto the sofa, along the edge of the table."}]
    (message,) = codes(report([TABLE, plate], rows, objectives=claim))["WP319"]
    assert "a sofa" in message
    assert not report([TABLE, plate], rows, objectives=[{"claim": "The plate lies on the bed of the table."}]).findings
    drawn = [claim[0] | {"visual_only": "the film draws it"}]
    assert "WP319" not in codes(report([TABLE, plate], rows, objectives=drawn))
    assert "WP319" in codes(report([TABLE, plate], rows, plan_type="fsi_in_scene"))


# --- the image -------------------------------------------------------------------------------------------------------


def seen(viewpoint, relations=(), facing=(), visible=()):
    return {"image_observation": {
        "viewpoint": viewpoint, "visible": list(visible),
        "relations": [dict(zip(("subject", "relation", "object"), r, strict=True)) for r in relations],
        "facing": list(facing)}}  # fmt: skip


CUPS = [TABLE, box("cup", 0.08, 0.08, 0.1), box("jug", 0.1, 0.1, 0.2), box("saucer", 0.15, 0.15, 0.02)]
LAID = [ON_GROUND, on("jug", "table", 0.3, 0.0), on("saucer", "table", -0.3, 0.1), on("cup", "saucer"),
        ("jug", "FACING-TO", "cup", {})]  # fmt: skip


@pytest.mark.parametrize(
    ("viewpoint", "true", "false"),
    [
        ("side_minus_y", [("cup", "left_of", "jug"), ("cup", "behind", "jug")], [("jug", "left_of", "cup")]),
        ("side_plus_y", [("cup", "right_of", "jug"), ("cup", "in_front_of", "jug")], [("cup", "behind", "jug")]),
        ("side_plus_x", [("cup", "right_of", "jug"), ("cup", "behind", "jug")], [("cup", "left_of", "jug")]),
        ("top_down", [("cup", "left_of", "jug"), ("cup", "behind", "jug")], [("jug", "behind", "cup")]),
        ("perspective", [("cup", "on", "saucer"), ("cup", "above", "saucer"), ("saucer", "on", "table")],
         [("jug", "on", "saucer"), ("jug", "inside", "table"), ("cup", "beside", "jug"), ("cup", "below", "table")]),
    ],
)  # fmt: skip
def test_relations_as_the_picture_shows_them(viewpoint, true, false):
    assert "WP321" not in codes(report(CUPS, LAID, topology=seen(viewpoint, true)))
    told = codes(report(CUPS, LAID, topology=seen(viewpoint, false)))["WP321"]
    assert len(told) == len(false)


def test_headings_and_names_as_the_picture_shows_them():
    facing = [
        {"subject": "jug", "direction": "left"},
        {"subject": "jug", "toward": "cup"},
        {"subject": "cup", "direction": "right"},
    ]
    assert not report(CUPS, LAID, topology=seen("side_minus_y", (), facing)).findings
    assert "WP321" in codes(report(CUPS, LAID, topology=seen("side_plus_y", (), facing[:1])))
    assert "WP322" in codes(report(CUPS, LAID, topology=seen("top_down", visible=["spoon"])))


def test_the_viewpoint_configures_the_first_camera():
    def cameras(*rows):
        steps = [{"description": "look", "cameras": list(rows)}]
        data = {"plan_type": "scene", "simulation_parameters": {"time_step": 0.01, "simulation_duration": 1},
                "objectives": [{"claim": "x"}], "implementation_steps": steps, "scene_objects": [TABLE],
                "topology": seen("side_plus_x", visible=["table"])}  # fmt: skip
        return [(c.name, c.view) for c in Plan.model_validate(data).cameras()]

    assert cameras() == [("reference_view", "side_plus_x")]
    assert cameras({"name": "a"}, "top_down") == [("a", "side_plus_x"), ("top_down", "top_down")]
    assert cameras("side_plus_x", "top_down") == [("side_plus_x", "side_plus_x"), ("top_down", "top_down")]
    assert cameras("top_down") == [("reference_view", "side_plus_x"), ("top_down", "top_down")]


def test_viewpoints_are_the_views_there_are():
    from typing import get_args

    from worldkit.cameras.views import VIEWS

    assert set(get_args(Viewpoint)) == set(VIEWS)


# --- cameras ---------------------------------------------------------------------------------------------------------


def test_what_cameras_see():
    objects = [box("wall", 0.1, 3.0, 2.0, fixed=True), box("crate", 0.5, 0.5, 0.5), box("dot", 0.01, 0.01, 0.01)]
    rows = [("wall", "PLACE-ON-BASE", None, {"x": 1.0, "y": 0}), ("crate", "PLACE-ON-BASE", None, {"x": 0, "y": 0}),
            ("dot", "PLACE-ON-BASE", None, {"x": -1.0, "y": 1.0})]  # fmt: skip
    at = {"target": [0, 0, 0.25], "subjects": ["crate"], "fovy": 45}
    cameras = [
        {"name": "clear", "position": [-3, 0, 0.25], **at},
        {"name": "walled", "position": [4, 0, 0.25], **at},
        {"name": "away", **at, "position": [-3, 0, 0.25], "target": [-6, 0, 0.25]},
        {"name": "far", "position": [-9, 0, 0.5], **at, "subjects": ["dot"]},
    ]
    found = report(objects, rows, exact=True, implementation_steps=[{"description": "look", "cameras": cameras}])
    by = {v.camera: v for v in found.views}
    assert by["clear"].hidden == 0
    assert by["clear"].in_frame == 1
    # a face of 0.5 m at 2.75 m: 720 px of 2 * 2.75 tan(22.5 deg) = 2.278 m
    assert by["clear"].pixels == pytest.approx((0.5 / 2.278 * 720) ** 2, rel=0.01)
    assert by["walled"].hidden == 1
    told = {f.code: f for f in found.findings}
    assert "walled" in told["WP313"].message
    assert "away" in told["WP312"].message
    assert told["WP312"].severity == "error"
    assert "far" in told["WP314"].message


def test_what_a_claim_is_about_is_large_enough_in_some_picture_or_a_camera_is_told_where_to_go():
    pea, post = box("pea", 0.02, 0.02, 0.02, fixed=True), box("post", 0.1, 0.1, 2.0, fixed=True)
    claim = {"claim": "It stays.", "expect": [{"stays": {"body": "pea"}}]}
    far = {"name": "side", "position": [-3, 0, 0.4], "target": [0, 0, 0.01], "fovy": 45, "subjects": ["pea"]}

    def looked(camera):
        step = {"description": "look", "cameras": [camera]}
        rows = [("pea", "PLACE-ON-BASE", None, {"x": 0, "y": 0}), ("post", "PLACE-ON-BASE", None, {"x": 0, "y": 2})]
        return report([pea, post], rows, exact=True, implementation_steps=[step], objectives=[claim])

    found = looked(far)
    (small,) = [f for f in found.findings if f.code in ("WP328", "WP314")]
    # 2 cm at 3.03 m: 720 px of 2 * 3.03 tan(22.5 deg) = 2.51 m, its sides a little aslant
    assert found.views[0].length_px == pytest.approx(0.02 / 2.51 * 720, abs=1.5)
    assert small.code == "WP328" and "camera side" in small.message and found.smallest.startswith("`pea` is ")
    place = small.fix.split("position: [")[1].split("]")[0]
    near = looked({**far, "position": [float(value) for value in place.split(", ")]})
    assert not [f for f in near.findings if f.code in ("WP328", "WP314")], near.findings
    assert near.views[0].length_px == pytest.approx(1.1 * 1280 / 40, abs=3.5)
    follows = looked({"name": "side", "view": "side_minus_y", "subjects": ["pea", "post"], "fovy": 45, "follow": True})
    (small,) = [f for f in follows.findings if f.code == "WP328"]
    assert "position:" not in small.fix and "subjects: [pea], follow: true}" in small.fix


FAR = {"name": "side", "position": [-3, 0, 0.4], "target": [0, 0, 0.01], "fovy": 45}


def peas(cameras):
    """What is said of three peas, 10 cm from one to the next, that should move, in the pictures of some cameras."""
    places = {f"pea_{k + 1}": {"x": 0.0, "y": 0.1 * k, "z": 0.01} for k in range(3)}
    step = {"description": "look", "cameras": cameras, "motion_expectations": ["pea"]}
    topology = {"body_positions": places}
    found = report(
        [box("pea", 0.02, 0.02, 0.02, count=3)], [], exact=True, topology=topology, implementation_steps=[step]
    )
    return [f for f in found.findings if f.code in ("WP328", "WP314")]


def test_copies_that_are_too_small_are_told_once():
    (small,) = peas([FAR])
    assert small.code == "WP328" and "(and 2 more of `pea` are too small)" in small.message


def test_only_what_every_picture_was_asked_about_is_called_too_small(monkeypatch):
    near = {"name": "near", "position": [-0.4, 0.1, 0.2], "target": [0, 0.1, 0.01], "fovy": 45}
    every = [{**FAR, "subjects": ["pea_1", "pea_2", "pea_3"]}, near]
    assert not [f for f in peas(every) if f.code == "WP328"]
    monkeypatch.setattr(framing, "MOST_MEASURED", 0)
    both = [{**FAR, "subjects": ["pea_1"]}, {**near, "subjects": ["pea_2"]}]
    assert not [f for f in peas(both) if f.code == "WP328"]


ARM = """<mujoco><worldbody><body name="foot"><geom type="box" size="0.01 0.01 0.01"/><body name="upper" pos="0 0 0.01">
  <joint type="hinge"/><geom type="box" size="0.01 0.01 0.25" pos="0 0 0.25"/></body></body></worldbody></mujoco>"""


def test_of_a_model_the_whole_is_seen(tmp_path):
    (tmp_path / "arm.xml").write_text(ARM)
    step = {"description": "look", "cameras": [{**FAR, "subjects": ["arm"]}], "motion_expectations": ["arm"]}
    found = report(
        [], [("arm", "PLACE-ON-BASE", None, {"x": 0, "y": 0})], exact=True, folder=tmp_path, implementation_steps=[step],
        assets=[{"name": "arm", "type": "mjcf", "filename": "arm.xml", "fixed": True}],
    )  # fmt: skip
    # 0.52 m at 3 m: 720 px of 2 * 3.03 tan(22.5 deg) = 2.51 m
    assert found.views[0].length_px == pytest.approx(0.52 / 2.51 * 720, rel=0.03)
    assert not [f for f in found.findings if f.code == "WP328"]


@pytest.mark.parametrize(
    ("level", "says"),
    [
        (0.2, ""),
        (0.3, "would stand at 0.3 m, 0 m over the rim; it reaches from 0 m to 0.3 m"),
        (0.45, "would stand at 0.45 m, 0.15 m over the rim"),
        (-0.1, "would stand at -0.1 m, 0.1 m under the bottom"),
    ],
)
def test_water_that_no_wall_holds_is_named_with_its_number(level, says):
    tub = {"name": "tub", "primitive": "box_container", "size": [0.6, 0.4, 0.3], "wall_thickness": 0.02, "fixed": True}
    said = {"name": "water", "constants": {"level": "tub_level"}, "container": "tub"}
    row = {"kind": "solver", "bodies": [], "law": "Airy", "source": "the prompt's tub", "solver": said}
    constant = {"value": level, "unit": "m", "source": "the prompt's tub"}
    asked = {
        "time_step": 0.002,
        "simulation_duration": 1.0,
        "interventions": [row],
        "constants": {"tub_level": constant},
    }
    found = report([tub], [("tub", "PLACE-ON-BASE", None, {"x": 0, "y": 0})], simulation_parameters=asked)
    told = codes(found).get("WP329", [])
    assert [says in one for one in told] == ([True] if says else [])
    if says:
        (finding,) = [one for one in found.findings if one.code == "WP329"]
        assert finding.severity == "error" and "`tub_level`" in finding.fix


def test_water_without_a_container_or_a_level_is_no_matter_of_its_rim():
    tub = {"name": "tub", "primitive": "box_container", "size": [0.6, 0.4, 0.3], "wall_thickness": 0.02, "fixed": True}
    for said in ({"constants": {}, "container": "tub"}, {"constants": {"level": "high"}, "container": "lake"}):
        row = {"kind": "solver", "bodies": [], "law": "Airy", "source": "s", "solver": {"name": "water", **said}}
        asked = {
            "time_step": 0.002, "simulation_duration": 1.0, "interventions": [row],
            "constants": {"high": {"value": 9.0, "unit": "m", "source": "s"}},
        }  # fmt: skip
        found = report([tub], [("tub", "PLACE-ON-BASE", None, {"x": 0, "y": 0})], simulation_parameters=asked)
        assert "WP329" not in codes(found)


def test_of_frictions_that_differ_the_one_in_force_is_told():
    def told(materials, pairs=()):
        given = {"time_step": 0.002, "simulation_duration": 1.0, "materials": materials, "pairs": pairs}
        tables = [TABLE | {"material": "oak"}, TABLE | {"name": "top", "material": "maple"}]
        rows = [ON_GROUND, ON_GROUND | {"subject": "top", "params": {"x": 3, "y": 0}}]
        claims = [{"claim": "they meet", "expect": [{"touches": {"bodies": ["top", "table"]}}]}]
        found = report(tables, rows, simulation_parameters=given, objectives=claims)
        return [line for line in found.at_start if "friction" in line]

    maple = {"friction": 0.3, "torsional_friction": 0.0015, "source": "a table"}
    oak = {"friction": 0.4, "torsional_friction": 0.003, "source": "a table"}
    (line,) = told({"oak": oak, "maple": maple})
    assert line.startswith("maple on oak: ")
    assert "friction 0.4, torsional friction 0.003 m, rolling friction 0.0001 m" in line
    assert line.endswith("of two the larger acts: friction of oak, torsional friction of oak")
    pair = {"between": ["top", "table"], "friction": 0.1, "torsional_friction": 0.002}
    said = "top on table: friction 0.1, torsional friction 0.002 m, rolling friction 0.0001 m, as its pair says"
    assert said in told({"oak": maple, "maple": maple}, (pair,))
    (line,) = told({"oak": {"friction": 0.3}, "maple": maple | {"rolling_friction": 0.0, "torsional_friction": 0.005}})
    assert line == "oak: rolling friction 0 m, unsaid, by the word of maple (else 0.0001 m)"
