"""Files of each format become the same asset; what they look like comes along; what is told of them is measured."""

import json
import os
import struct
from pathlib import Path

import cv2
import numpy as np
import pytest
import trimesh

from worldkit.assets.reading import read_asset
from worldkit.errors import IntakeError
from worldkit.intake import confined_intake as process
from worldkit.intake import declared_sizes, drawn_pieces, shown_meshes, taken_in
from worldkit.intake.drawn_pieces import Drawn

OAK = {"name": "oak", "density": 690.0, "friction": 0.4, "restitution": 0.4, "source": "a table"}
ASKED = {
    "key": "crate", "category": "crate", "description": "a crate", "licence": "CC0-1.0", "creator": "somebody", "source": "a test",
    "material": OAK, "height": 0.3,
}  # fmt: skip


def crate() -> trimesh.Trimesh:
    """60 x 40 x 30, z up."""
    return trimesh.creation.box((60, 40, 30))


def y_up(mesh: trimesh.Trimesh) -> trimesh.Trimesh:
    """The same as glTF has it: y up, +z the front."""
    mesh.apply_transform([(0, 1, 0, 0), (0, 0, 1, 0), (1, 0, 0, 0), (0, 0, 0, 1)])
    return mesh


@pytest.mark.parametrize("suffix", [".glb", ".obj", ".stl", ".ply", ".off"])
def test_every_format_gives_the_same_crate(suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"crate{suffix}"
    (y_up(crate()) if suffix in (".glb", ".obj") else crate()).export(path)
    files, facts = taken_in.take_in(path, ASKED)
    assert facts["native_extents"] == pytest.approx([0.6, 0.4, 0.3], abs=1e-5)
    assert facts["solid_volume"] == pytest.approx(0.072) and facts["density"] == 690
    assert facts["inertia"]["per_kg"][:3] == pytest.approx(
        [(0.16 + 0.09) / 12, (0.36 + 0.09) / 12, (0.36 + 0.16) / 12], rel=1e-4
    )
    (piece,) = facts["collision"]
    assert piece["type"] == "box" and piece["extents"] == pytest.approx([0.6, 0.4, 0.3], abs=1e-5)
    taken_in.write(tmp_path / "crate", files, facts)
    asset = read_asset(tmp_path / "crate")
    assert asset.mass_at() == pytest.approx(690 * 0.072) and asset.creator == "somebody" and asset.friction == 0.4
    drawn = trimesh.load(tmp_path / "crate" / "look_00.obj", force="mesh")
    assert drawn.extents == pytest.approx([0.6, 0.4, 0.3], abs=1e-5) and drawn.volume == pytest.approx(0.072, rel=1e-4)


def test_a_picture_and_a_colour_come_along(tmp_path: Path) -> None:
    cv2.imwrite(str(tmp_path / "grain.png"), np.full((8, 4, 3), (10, 20, 200), np.uint8))
    (tmp_path / "a.mtl").write_text(
        "newmtl paint\nKd 0.1 0.5 0.9\nd 0.5\nNs 30\nnewmtl grain\nKd 1 1 1\nmap_Kd grain.png\n"
    )
    corners = [f"v {x} {y} {z}" for x in (0, 1) for y in (0, 1) for z in (0, 1)]
    faces = [(1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)]
    rows = ["mtllib a.mtl", *corners, "vt 0 0", "vt 1 1", "usemtl paint"]
    rows += ["f " + " ".join(f"{v}/1" for v in face) for face in faces[:3]] + ["usemtl grain"]
    rows += ["f " + " ".join(f"{v}/{1 + n % 2}" for n, v in enumerate(face)) for face in faces[3:]]
    (tmp_path / "a.obj").write_text("\n".join(rows) + "\n")
    files, facts = taken_in.take_in(tmp_path / "a.obj", ASKED)
    assert facts["measured"]["closed"], "a skin of two materials is closed"
    worn = {row["material"]: row["mesh"] for row in facts["visual"]}
    plain, grained = sorted(facts["materials"].items(), key=lambda row: "texture" in row[1])
    assert plain[1]["rgba"] == pytest.approx([0.1, 0.5, 0.9, 0.5], abs=0.01) and plain[1]["roughness"] == 0.5
    picture = cv2.imdecode(np.frombuffer(files[grained[1]["texture"]], np.uint8), cv2.IMREAD_COLOR)
    assert picture.shape == (8, 4, 3) and picture[0, 0].tolist() == [10, 20, 200]
    assert b"vt 1 1" in files[worn[grained[0]]]


def test_the_colour_of_a_gltf_is_of_light_and_ours_is_as_it_is_seen(tmp_path: Path) -> None:
    mesh = crate()
    colour = trimesh.visual.material.PBRMaterial(baseColorFactor=[55, 255, 0, 128])
    mesh.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), material=colour)
    mesh.export(tmp_path / "a.glb")
    (piece,), _ = drawn_pieces.read(tmp_path / "a.glb")
    assert piece.rgba == pytest.approx((0.5, 1.0, 0.0, 0.5), abs=0.01)


def test_a_binary_stl_with_more_behind_its_triangles_is_read(tmp_path: Path) -> None:
    path = tmp_path / "a.stl"
    crate().export(path)
    path.write_bytes(path.read_bytes() + b"colour table\n")
    assert declared_sizes.check(path) == 12
    (piece,), _ = drawn_pieces.read(path)
    assert len(piece.faces) == 12


@pytest.mark.parametrize("end", ["\n", "\r\n"])
def test_an_obj_with_tabs_and_rows_that_go_on_is_read(tmp_path: Path, end: str) -> None:
    (tmp_path / "a.mtl").write_text("newmtl paint\nKd 1 0 0\n")
    rows = ["mtllib\ta.mtl", "v\t0 0\t0", "v 1 0 0", "v 0 1 \\", "0", "v 1\t1 1", "usemtl paint", "f 1 2\\", "4 3"]
    (tmp_path / "a.obj").write_bytes(end.join(rows).encode())
    assert declared_sizes.check(tmp_path / "a.obj") == 2
    (piece,), _ = drawn_pieces.read(tmp_path / "a.obj")
    assert len(piece.faces) == 2 and np.ptp(piece.vertices, axis=0).tolist() == [1, 1, 1]
    assert piece.rgba == pytest.approx((1, 0, 0, 1))


def test_a_row_without_an_end_is_counted_where_it_begins(tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_bytes(b"v 0 0 0\nv 1 0 0\nf 1 \\\n2 7 \\")
    with pytest.raises(IntakeError, match="corner 7 of 2") as told:
        declared_sizes.check(tmp_path / "a.obj")
    assert told.value.place == "a.obj:3"


def test_numbers_that_are_none_are_refused_with_their_place(tmp_path: Path) -> None:
    mesh = crate()
    points = np.array(mesh.vertices, np.float32)
    points[5] = np.nan
    head = f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\nproperty float z\n"
    head += f"element face {len(mesh.faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    body = points.tobytes() + b"".join(struct.pack("<B3i", 3, *face) for face in mesh.faces)
    (tmp_path / "a.ply").write_bytes(head.encode() + body)
    with pytest.raises(IntakeError, match="1 of 8 vertices are no numbers") as told:
        taken_in.take_in(tmp_path / "a.ply", ASKED)
    assert told.value.code == "not_finite" and told.value.place == "a.ply, piece 0, vertex 5"


def test_a_mass_that_no_substance_has_is_refused(tmp_path: Path) -> None:
    crate().export(tmp_path / "a.stl")
    with pytest.raises(IntakeError, match="no substance") as told:
        taken_in.take_in(tmp_path / "a.stl", {**ASKED, "mass": 5000})
    assert told.value.code == "implausible_mass"
    _, facts = taken_in.take_in(tmp_path / "a.stl", {**ASKED, "mass": 12})
    assert facts["mass"] == 12 and "density" not in facts


def test_many_triangles_are_drawn_as_few_with_their_picture_in_place(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(shown_meshes, "TRIANGLES", 500)
    n = 40
    x, y = (grid.ravel() for grid in np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n)))
    faces = [(k, k + 1, k + n + 1) for k in range(n * n - n) if (k + 1) % n] + [
        (k, k + n + 1, k + n) for k in range(n * n - n) if (k + 1) % n
    ]
    sheet = Drawn(
        np.column_stack([x, y, 0.1 * np.sin(9 * x)]),
        np.array(faces),
        np.column_stack([x, y]),
        np.zeros((2, 2, 3), np.uint8),
    )
    few = shown_meshes._fewer(sheet, len(faces))
    assert len(few.faces) <= 600 and few.uv is not None
    assert few.uv == pytest.approx(few.vertices[:, :2], abs=0.03), "the picture lies where it lay"


def test_a_hundred_pieces_become_as_many_as_are_handed_over(tmp_path: Path) -> None:
    from PIL import Image

    from worldwright.stage.confined import MOST_MATCHING

    def scene(looks: int, pictures: int) -> Path:
        made = trimesh.Scene()
        for number in range(100):
            box = trimesh.creation.box((1, 1, 1))
            if number < pictures:
                picture = Image.new("RGB", (2, 2), (number % looks, 40, 200))
                material = trimesh.visual.material.PBRMaterial(baseColorTexture=picture)
                box.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), material=material)
            else:
                colour = trimesh.visual.material.PBRMaterial(baseColorFactor=[number % looks, 200, 40, 255])
                box.visual = trimesh.visual.TextureVisuals(uv=np.zeros((8, 2)), material=colour)
            box.apply_translation((2 * number, 0, 0))
            made.add_geometry(box, node_name=f"n{number}", geom_name=f"g{number}")
        made.export(tmp_path / f"{looks}.glb")
        return tmp_path / f"{looks}.glb"

    pieces, said = drawn_pieces.read(scene(1, 90))
    assert len(pieces) == 2 and "one look" in " ".join(said), "equal pictures and equal colours are one"
    pieces, said = drawn_pieces.read(scene(100, 90))
    assert len(pieces) == drawn_pieces.MOST_PIECES < MOST_MATCHING and "nearest colour" in " ".join(said)
    assert sum(len(piece.faces) for piece in pieces) == 1200 and all(
        (piece.uv is None) == (piece.picture is None) for piece in pieces
    )


@pytest.mark.parametrize(
    ("plain", "triangles", "left", "why"),
    [(1, 1, 13, "nearest colour"), (1, 3, 15, "nearest colour"), (0, 1, 12, "left out"), (0, 2, 14, "in one colour")],
)
def test_a_single_triangle_is_no_mesh_of_its_own(plain: int, triangles: int, left: int, why: str) -> None:
    box = trimesh.creation.box((1, 1, 1))
    picture = None if plain else np.zeros((2, 2, 3), np.uint8)
    whole = Drawn(np.array(box.vertices), np.array(box.faces), None if plain else np.zeros((8, 2)), picture)
    one = np.eye(3), np.array([[0, 1, 2]])
    single = [Drawn(*one, rgba=(n / 4, 0.0, 0.0, 1.0)) for n in range(triangles)]
    pieces, (said,) = drawn_pieces._corners([whole, *single])
    assert all(len(piece.vertices) >= 4 for piece in pieces) and sum(len(piece.faces) for piece in pieces) == left
    assert why in said
    assert drawn_pieces._corners([whole]) == ([whole], [])


@pytest.mark.parametrize("triangles", [1, 2])
@pytest.mark.parametrize("other", [(), ("red",)])
def test_a_single_triangle_joins_the_larger_piece_of_its_own_look(other: tuple, triangles: int) -> None:
    box, picture = trimesh.creation.box((1, 1, 1)), np.full((2, 2, 3), 200, np.uint8)
    look = {"picture": picture, "rgba": (1.0, 1.0, 1.0, 1.0)}
    whole = Drawn(np.array(box.vertices), np.array(box.faces), np.zeros((8, 2)), **look)
    one = Drawn(np.eye(3), np.array([[0, 1, 2]]), np.zeros((3, 2)), **look)
    red = [Drawn(np.array(box.vertices), np.array(box.faces), rgba=(1.0, 0.0, 0.0, 1.0)) for _ in other]
    pieces, (said,) = drawn_pieces._corners([whole, *red, *[one] * triangles])
    assert [(len(piece.faces), piece.picture is None) for piece in pieces] == [
        (12 + triangles, False),
        *[(12, True)] * len(red),
    ]
    assert len(pieces[0].uv) == len(pieces[0].vertices) and said.endswith("joined those of their look")


@pytest.fixture
def intake(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """The confined process, here in this one."""
    for name in ("WORLDWRIGHT_CATALOG", "WORLDWRIGHT_ASSETS"):
        monkeypatch.setenv(name, os.environ.get(name, ""))

    def run(mesh: trimesh.Trimesh, **more) -> dict:
        mesh.export(tmp_path / "a.stl")
        (tmp_path / "request.json").write_text(json.dumps({**ASKED, **more, "file": "a.stl"}))
        out = tmp_path / "out"
        out.mkdir(exist_ok=True)
        status = process.main([str(tmp_path / "request.json"), str(out)])
        told = "asset.yaml" if status == 0 else "error.json"
        import yaml

        return yaml.safe_load((out / told).read_text())

    return run


def test_what_stands_and_what_falls_is_measured(intake) -> None:
    facts = intake(crate())
    assert facts["measured"]["stands"] and facts["measured"]["tilt_deg"] < 0.1 and "cavity" not in facts["measured"]
    pencil = trimesh.creation.cone(radius=1, height=20, sections=16)
    pencil.apply_transform(np.diag([1, 1, -1, 1]))
    pencil.invert()
    facts = intake(pencil, key="cone")
    assert not facts["measured"]["stands"] and facts["measured"]["tilt_deg"] > 45
    assert any("does not stand still" in line for line in facts["mended"])


def test_a_refusal_is_left_as_an_error_with_cause_place_and_next_move(intake) -> None:
    told = intake(crate(), height=None, units=None)
    assert told["code"] == "unknown_size" and told["cause"] and "--height" in told["next"]


def test_what_diverges_does_not_stand(intake, monkeypatch: pytest.MonkeyPatch) -> None:
    import mujoco

    real, steps = mujoco.mj_step, iter(range(10**9))

    def step(model, data) -> None:
        if next(steps) == 100:
            data.qvel[:] = 1e12
        real(model, data)

    monkeypatch.setattr(mujoco, "mj_step", step)
    facts = intake(crate(), key="wild")
    assert facts["measured"]["stands"] is False and facts["measured"]["why"] == "its motion diverged"


@pytest.mark.parametrize("holds", [True, False])
def test_only_a_cavity_that_holds_is_what_things_are_put_into(
    intake, monkeypatch: pytest.MonkeyPatch, holds: bool
) -> None:
    found = {"z": 0.1, "width": 0.2, "holds": holds}
    monkeypatch.setattr(process.stillness, "stood", lambda key: {"stands": True})
    monkeypatch.setattr(process.stillness, "cavity", lambda key: found)
    facts = intake(crate(), key="tray")
    assert [row["name"] for row in facts.get("supports", [])] == ["inside"] * holds
    assert facts["measured"]["cavity"] == found
