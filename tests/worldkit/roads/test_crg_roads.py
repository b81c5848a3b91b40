"""OpenCRG roads: every encoding gives the same road, what is broken is told, and a car keeps to one over its hills."""

from dataclasses import replace

import mujoco
import numpy as np
import pytest

from worldkit import contacts, motion, portable, roads, scene, vehicles
from worldkit.roads.crg_file import read_crg
from worldkit.roads.road_tiles import tiles

LIFTED_M = 1.2
"""So high lies the road above the ground of the scene, below which it would dip."""
STEP_M, SECTIONS = 0.5, (-3.0, -1.0, 0.0, 1.0, 3.0)


def table(length=120.0, radius=60.0):
    """phi, banking, slope and five heights a row: a bend to the left over a hill, banked by 3 %."""
    u = np.arange(round(length / STEP_M) + 1) * STEP_M
    phi, bank, slope = u / radius, np.full(len(u), 0.03), 0.05 * np.cos(2 * np.pi * u / length)
    return np.column_stack([phi, bank, slope, *(np.zeros(len(u)) for _ in SECTIONS)])


def written(path, rows, encoding="KRBI", head="", cut=0, length=None):
    """A file of these rows."""
    end = (len(rows) - 1) * STEP_M if length is None else length
    text = (
        f"$CT\na test\n$ROAD_CRG\nreference_line_start_u = 0\nREFERENCE_LINE_END_U = {end} ! m\n"
        f"reference_line_increment = {STEP_M}\n{head}$KD_Definition\n#:{encoding}\nU:reference line u,m,0,{STEP_M}\n"
        "D:reference line phi,rad\nD:reference line banking,m/m\nD:reference line slope,m/m\n"
    )
    text += "".join(f"D:long section at v = {v:.3f},m\n" for v in SECTIONS) + "$" * 80 + "\n"
    if encoding[0] == "K":
        body = np.asarray(rows, ">f4" if encoding[1] == "R" else ">f8").tobytes()
    else:
        width = 10 if encoding[1] == "R" else 20
        each = 80 // width
        said = [["*missing*".rjust(width) if np.isnan(v) else f"{v:{width}.6f}" for v in row] for row in rows]
        lines = ["".join(row[i : i + each]) for row in said for i in range(0, len(row), each)]
        body = ("\n".join(lines) + "\n").encode()
    path.write_bytes(text.encode() + body[: len(body) - cut])
    return path


@pytest.mark.parametrize("encoding", ["KRBI", "KDBI", "LRFI", "LDFI"])
def test_every_encoding_gives_the_same_road(tmp_path, encoding):
    road = roads.read(written(tmp_path / "a.crg", table(), encoding))
    assert road.length_m == pytest.approx(120, rel=1e-4) and not road.closed
    assert road.line[-1, :2] == pytest.approx((60 * np.sin(2), 60 * (1 - np.cos(2))), abs=0.4)
    assert road.line[:, 2].max() == pytest.approx(0.05 * 120 / (2 * np.pi), abs=0.03)
    here = road.line[100]
    left = here[:2] + 2 * np.array([-np.sin(road.heading[100]), np.cos(road.heading[100])])
    (middle, side), beside = road.height(np.array([here[:2], left]))
    assert middle == pytest.approx(here[2], abs=1e-3) and side - middle == pytest.approx(0.06, abs=2e-3)
    assert beside == pytest.approx((0, 2), abs=0.01)


def test_what_was_not_measured_is_as_high_as_its_neighbours(tmp_path):
    rows = table()
    rows[:, 3:] = 0.2
    rows[40:60, 4], rows[7] = np.nan, [*rows[7][:3], *[np.nan] * 5]
    for encoding in ("KRBI", "LRFI"):
        road = roads.read(written(tmp_path / "a.crg", rows, encoding))
        assert np.isfinite(road.heights).all() and np.ptp(road.heights[50] - 0.03 * road.sections_m) < 1e-6
    rows[:, 3:] = np.nan
    with pytest.raises(roads.RoadFileError, match="none of its heights"):
        roads.read(written(tmp_path / "a.crg", rows))
    rows = table()
    rows[30, 0] = np.nan
    with pytest.raises(roads.RoadFileError, match="has gaps"):
        roads.read(written(tmp_path / "a.crg", rows))


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"cut": 700}, "is cut off: 7012 of 7712 bytes"),
        ({"cut": 700, "encoding": "LRFI"}, "is cut off"),
        ({"encoding": "KHBI"}, "`#:KHBI`; KRBI, KDBI"),
        ({"length": 0.0}, "must lie beyond"),
        ({"length": 1e308, "head": "reference_line_increment = 1e-300\n"}, "are no road that is read"),
        ({"length": float("nan")}, "is not a finite number|must lie beyond"),
        ({"head": "reference_line_start_x = east\n"}, "reference_line_start_x is no number: 'east'"),
        ({"length": 50.0}, "line ends were converted"),
    ],
)
def test_what_is_broken_is_told(tmp_path, change, said):
    encoding = change.get("encoding", "KRBI")
    made = written(tmp_path / "a.crg", table(), encoding if encoding != "KHBI" else "KRBI", **{k: v for k, v in change.items() if k != "encoding"})  # fmt: skip
    made.write_bytes(made.read_bytes().replace(b"#:KRBI", f"#:{encoding}".encode()))
    with pytest.raises(roads.RoadFileError, match=said):
        read_crg(made)


def test_a_section_that_lies_nowhere_is_told(tmp_path):
    made = written(tmp_path / "a.crg", table())
    for place in (b"1..0e", b"9e999"):
        (tmp_path / "b.crg").write_bytes(made.read_bytes().replace(b"v = 1.000", b"v = " + place))
        with pytest.raises(roads.RoadFileError, match="does not say where it lies"):
            read_crg(tmp_path / "b.crg")


def test_no_tile_below_a_wide_road_is_left_out_and_a_coarse_one_is_refused(tmp_path):
    road = roads.read(written(tmp_path / "a.crg", table()))
    wide = replace(
        road, sections_m=np.linspace(-400.0, 400.0, len(road.sections_m)), heading=np.zeros_like(road.heading)
    )
    across = {y for _, y in tiles(wide)}
    assert len(across) == 1 + (max(across) - min(across)) / 50
    coarse = replace(road, line=road.line * 60)
    with pytest.raises(ValueError, match="survey it more closely"):
        tiles(coarse)


def test_what_is_no_road_file_is_told(tmp_path):
    (tmp_path / "a.crg").write_text("$CT\nhello\n")
    with pytest.raises(roads.RoadFileError, match="no OpenCRG file"):
        read_crg(tmp_path / "a.crg")
    with pytest.raises(roads.RoadFileError, match="cannot be read"):
        read_crg(tmp_path / "b.crg")
    with pytest.raises(roads.RoadFileError, match="beside the program"):
        roads.read("../b.crg")


def driven(road, seconds, friction=0.9, speed=8.0):
    spec = scene.new("road", time_step=0.002, floor=None)
    roads.add(spec, road, name="road", pos=(0, 0, LIFTED_M), surface=contacts.surface(friction=friction))
    course = vehicles.Course(road.lane(left_m=-1.0), closed=road.closed)
    car = vehicles.Car(tyre_friction=friction)
    start = course.line[8]
    way = course.line[9] - course.line[7]
    turn = float(np.degrees(np.arctan2(way[1], way[0])))
    vehicles.add(
        spec,
        car,
        name="car",
        pos=(*start, LIFTED_M + float(road.height(start[None])[0][0]) + 0.02),
        yaw_deg=turn,
        look=None,
    )
    motion.launch(spec, {"car": motion.Launch()})
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    driver = vehicles.Driver(car, course, top_m_s=speed)
    off, gap = [], []
    while data.time < seconds:
        vehicles.pedals(car, model, data, "car", **vars(driver.commands(data, "car")))
        mujoco.mj_step(model, data, nstep=10)
        off.append(abs(driver.off_m))
        hubs = np.array([data.body(f"car_{corner}_wheel").xpos for corner in car.corners])
        gap.append(hubs[:, 2] - car.wheel_radius_m - LIFTED_M - road.height(hubs[:, :2])[0])
    return spec, np.array(off), np.array(gap), data


def test_a_car_keeps_to_a_hilly_road_and_its_wheels_to_the_surface(tmp_path):
    road = roads.read(written(tmp_path / "a.crg", table()))
    assert len(tiles(road)) > 3
    spec, off, gap, data = driven(road, 11.0)
    assert off.max() < 0.6 and np.hypot(*data.qpos[:2]) > 60
    assert np.abs(gap[25:]).max() < 0.012  # over the borders of tiles, too
    assert portable.write(spec, tmp_path / "world.mjz")["rounded"] == {}


def test_tiles_share_their_borders(tmp_path):
    road = roads.read(written(tmp_path / "a.crg", table()))
    spec = scene.new("road", time_step=0.002, floor=None)
    roads.add(spec, road, name="road")
    model = spec.compile()
    heights = {}
    for g in range(model.ngeom):
        if model.geom_type[g] != mujoco.mjtGeom.mjGEOM_HFIELD:
            continue
        field = model.geom_dataid[g]
        grid = model.hfield_data[model.hfield_adr[field] :][: 101 * 101].reshape(101, 101)
        low = tuple(np.round(model.geom_pos[g][:2] - 25).astype(int))
        heights[low] = grid * model.hfield_size[field][2] + model.geom_pos[g][2]
    shared = [(a, b) for a in heights for b in heights if b == (a[0] + 50, a[1])]
    assert shared
    for a, b in shared:
        assert heights[a][:, -1] == pytest.approx(heights[b][:, 0], abs=1e-5)
