"""A vehicle is placed on its wheels, and a road is its surface: what lies in a slope is found, what stands on it is not."""

import numpy as np
import pytest

from worldkit.vehicles import Car
from worldwright.model.plan.committed import AssetRow, Plan
from worldwright.model.plan.imported import road_box
from worldwright.place.asking import simulate
from worldwright.place.checks import check
from worldwright.place.engine import resolve

SLOPE = 0.06
CAR = Car()


def climbing(folder):
    """A straight road of 80 m along x that climbs by 6 %, its file beside the plan, and the box around it."""
    if not (folder / "roads").exists():
        (folder / "roads").mkdir()
        grid = np.zeros((161, 4))
        grid[:, 0] = SLOPE
        head = "$ROAD_CRG\nreference_line_end_u = 80\nreference_line_increment = 0.5\n$KD_DEFINITION\n#:KRBI\nU:u,m,0,0.5\n"
        head += "D:reference line slope,m/m\n" + "".join(f"D:long section at v = {v},m\n" for v in (-3, 0, 3))
        (folder / "roads" / "hill.crg").write_bytes((head + "$" * 80 + "\n").encode() + grid.astype(">f4").tobytes())
    row = {"name": "road", "type": "road", "filename": "roads/hill.crg"}
    return row, road_box(AssetRow.model_validate(row), folder)


def parked(folder, above, yaw=0.0):
    """What is found of a car 40 m up the road, so far above the height at which its upper wheels touch; and its contacts."""
    row, (low, high) = climbing(folder)
    half = [(b - a) / 2 for a, b in zip(low, high, strict=True)]
    wheels = (
        SLOPE * (40 + CAR.wheelbase_m / 2) - low[2] + SLOPE**2 * CAR.wheel_radius_m / 2
    )  # a wheel touches behind its hub
    places = {
        "car": {"x": 40.0, "y": 0.0, "z": wheels + CAR.height_m / 2 + above},
        "road": {"x": low[0] + half[0], "y": low[1] + half[1], "z": half[2]},
    }
    plan = Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 1.0},
            "objectives": [{"claim": "It stands."}],
            "assets": [{"name": "car", "type": "vehicle", "vehicle": {"kind": "car"}}, row],
            "topology": {"body_positions": places},
        }
    ).read_from(folder)
    resolution = resolve(plan)
    assert resolution.scene.ok, resolution.scene.findings
    found = check(plan, resolution, locate=lambda *path: None)
    return [one.message for one in found.findings if one.code == "WP302"], plan, resolution.scene


@pytest.mark.parametrize(("above", "deep"), [(0.0, False), (0.3, False), (-0.1, True), (-1.0, True)])
def test_a_car_in_a_sloping_road_is_found_and_one_on_it_is_not(tmp_path, above, deep):
    found, _, _ = parked(tmp_path, above)
    assert len(found) == deep
    if deep:
        assert "`car` and `road` penetrate" in found[0]


def test_a_car_that_is_let_go_on_a_road_stays_on_it(tmp_path):
    _, plan, scene = parked(tmp_path, 0.0)
    told = simulate(plan, scene, duration_s=0.5, falling=["car"])
    (_, way, below), car = told["drops"][0], told["objects"]["car"]
    assert below == "road" and way < 0.01
    assert abs(car["end"][2] - car["start"][2]) < 0.15 and abs(car["end"][0] - car["start"][0]) < 0.3


def test_another_surface_is_another_question(tmp_path):
    assert parked(tmp_path, 0.3)[0] == []
    path = tmp_path / "roads" / "hill.crg"
    head, body = path.read_bytes().split(b"$" * 80 + b"\n")
    grid = np.frombuffer(body, ">f4").reshape(161, 4).copy()
    grid[70:90, 1:] += 0.5  # the box around it stays the same
    path.write_bytes(head + b"$" * 80 + b"\n" + grid.astype(">f4").tobytes())
    assert len(parked(tmp_path, 0.3)[0]) == 1
