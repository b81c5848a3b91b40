"""A film shows the recording: its bodies stand where they stood, and what it may not do it is refused."""

import math
import shutil
from argparse import Namespace
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import cv2
import mujoco
import numpy as np
import pytest

from filmed_balls import SIZE, Made
from small_worlds import empty, floor
from worldengine.film import behind_walls, chosen_frames, described, passes, streaks
from worldengine.film.described import FilmError
from worldengine.film.directed import Screening
from worldengine.film.dressed import DressedReplay, dress
from worldengine.film.lettering import letter, pace
from worldengine.film.treatment import Treatments
from worldkit import portable, sculpt, turning
from worldkit.filming import Surface, follow, planned, still, wide
from worldkit.filming.viewpoints import axes

CUBE = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
FACES = np.array([(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)])  # fmt: skip


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return Made(tmp_path_factory.mktemp("film"))


def two_shots(film):
    film.shot(wide(), until=0.2)
    film.shot(still((0, -2, 0.5), "first"), until=0.4)


@pytest.mark.gl
def test_the_film_is_drawn_before_the_plans_cameras_under_one_progress(made, tmp_path, monkeypatch):
    film = made.film(two_shots)
    told = tmp_path / "told"
    told.mkdir()
    for name in ("film.json", "film.npz"):
        shutil.copyfile(made.folder / name, told / name)
    seen = []

    class Progress:
        def __init__(self, out: Path, total: int, unit: str) -> None:
            self.out, self.unit = out, unit

        def __call__(self, done: int, total: int) -> None:
            seen.append((done, total, sorted(path.name for path in self.out.glob("*.mp4"))))

    monkeypatch.setattr("worldkit.reporting.Progress", Progress)
    given = SimpleNamespace(world=made.folder / "world.mjz", size=SIZE, fps=24, movers=("first", "second"))
    options = Namespace(film=told, out=tmp_path / "out", reuse=[], cameras=[])
    options.out.mkdir()
    summary = passes.film_first((made.plain, made.recording, [], options.out), film, given, options)
    assert summary["cameras"] == ["side"] and summary["drawn"] == film.frames + summary["frames"]
    assert set(summary["pictures"]) == {"film.mp4", "side.mp4"} and len(summary["film"]["shots"]) == 2
    done, totals, files = zip(*seen, strict=True)
    assert list(done) == sorted(done) and len(set(totals)) == 1 and done[-1] == totals[0]
    assert not any("side.mp4" in names for names in files[: film.frames]) and "film.mp4" in files[-1]


@pytest.mark.gl
def test_every_shot_is_seen_on_one_sheet_and_several_moments_in_one_call(made, tmp_path):
    film = made.film(two_shots)
    given = SimpleNamespace(world=made.folder / "world.mjz", size=SIZE, fps=24, movers=("first", "second"))
    options = Namespace(out=tmp_path, size=None, shots=True, at=[0.0], samples=None)
    told = chosen_frames.of_film(made.plain, made.recording, film, given, options)
    assert [(row["shot"], row["word"]) for row in told["moments"]] == [
        (shot, word) for shot in (1, 2) for word in ("first", "middle", "last")
    ]
    assert told["moments"][2]["film_s"] < told["moments"][3]["film_s"] and (tmp_path / "shots-1.jpg").is_file()
    assert told["moments"][0]["reading"]["subjects"]["first"] > 0
    chosen = chosen_frames.of_film(
        made.plain,
        made.recording,
        film,
        given,
        Namespace(out=tmp_path, size=None, shots=False, at=[0.3, 0.1], samples=None),
    )
    assert [row["film_s"] for row in chosen["moments"]] == pytest.approx([7 / 24, 2 / 24])
    assert {"frame.png", "frame-2.png"} <= {path.name for path in tmp_path.iterdir()}


def test_a_mover_that_the_key_light_does_not_reach_for_a_wall_is_told_with_the_way_that_is_free(made):
    def tell(film, wall=(0.5, 0.1, 4.0), pos=(0.0, -0.8, 2.0)):
        two_shots(film)
        film.light(azimuth_deg=-90, elevation_deg=20, strength=1.0)
        film.draw("fence", "box", wall, pos=pos)

    def told(film):
        model = dress(made.folder / "world.mjz", film)
        return behind_walls.told(model, made.recording, film, 24, ("first", "second"))

    said = told(made.film(tell))
    assert len(said) == 2 and said[0].startswith("shot 1: the key light (azimuth -90, elevation 20 degrees)")
    assert "'first', behind 'fence'" in said[0] and not any("'second'" in line for line in said)
    free = float(said[0].split("azimuth_deg=")[1].rstrip(")"))
    assert 10 <= abs(free + 90) <= 40

    def turned(film):
        tell(film)
        film.light(azimuth_deg=free)

    assert told(made.film(turned)) == []
    assert told(made.film(lambda film: tell(film, wall=(0.1, 0.1, 4.0)))) == []  # a post leaves some of it in the light


@pytest.mark.gl
def test_pictures_of_several_cameras_and_sizes_come_from_one_process_as_from_their_own(made, tmp_path):
    film = made.film(two_shots)
    given = SimpleNamespace(
        world=made.folder / "world.mjz",
        model=lambda: portable.read(made.folder / "world.mjz"),
        size=SIZE,
        fps=24,
        movers=("first", "second"),
    )
    asked = [((64, 36), 0.1, "side"), (SIZE, 0.3, "film"), ((32, 18), 0.0, "side"), ((64, 36), 0.4, "side")]
    seen = [("video", *one) for one in asked]
    told = chosen_frames.each(
        made.plain, made.recording, film, given, Namespace(out=tmp_path, seen=seen, within=math.inf)
    )
    assert told["drawn"] == [0, 3, 1, 2] and told["cameras"] == ["side", "film"]
    drawn = [cv2.imread(str(tmp_path / chosen_frames.picture_name(place))) for place in range(len(seen))]
    assert [picture.shape[1::-1] for picture in drawn] == [size for size, *_ in asked]
    assert np.abs(drawn[0].astype(int) - drawn[3]).max() > 40, "the balls fell on"

    alone = tmp_path / "alone"
    alone.mkdir()
    options = Namespace(out=alone, size=None, shots=False, at=[0.3], samples=None)
    chosen_frames.of_film(made.plain, made.recording, film, given, options)
    assert np.array_equal(cv2.imread(str(alone / "frame.png")), drawn[1])
    options = Namespace(out=alone, size=(64, 36), at=[0.4], samples=None, eye=None)
    chosen_frames.through_a_camera(made.plain, made.recording, "side", given, options)
    apart = np.abs(cv2.imread(str(alone / "frame.png")).astype(int) - drawn[3])
    assert apart.mean() < 0.5 < np.abs(drawn[0].astype(int) - drawn[3]).mean(), "the moment that was asked for"

    late = chosen_frames.each(made.plain, made.recording, None, given, Namespace(out=tmp_path, seen=seen, within=-1.0))
    assert late["drawn"] == [0], "the first is drawn however late it is"


def looking(film, until=0.4):
    film.shot(still((0.2, -2.5, 0.6), (0.2, 0, 0.4)), until=until)


def test_the_author_is_told_where_bodies_were_and_what_they_touched(made):
    assert made.seen.bodies == ("first", "second")
    assert made.seen.cameras == ("side",)
    assert made.seen.position("first", 0.0) == pytest.approx([0, 0, 0.6], abs=1e-6)
    assert made.seen.radius("first") == pytest.approx(0.1 * np.sqrt(3))
    touch = made.seen.touches("second", "world")[0]
    assert touch.time_s == pytest.approx(np.sqrt(2 * 0.3 / 9.81), abs=0.01)
    assert touch.force_n > 9.81
    assert made.seen.event() in {t.time_s for t in made.seen.touches()}


def test_bodies_stand_where_they_stood_whatever_is_drawn(made):
    def tell(film):
        looking(film)
        film.draw("hat", "cylinder", (0.2, 0.2, 0.1), pos=(0, 0, 0.15), to="first")
        film.draw("wall", "box", (2, 0.1, 1), pos=(0, 1, 0.5))
        film.particles("dust", lambda times: np.zeros((len(times), 5, 3)))
        film.grass(area=(-1, -1, 1, 1), count=50)

    film = made.film(tell)
    model = dress(made.folder / "world.mjz", film)
    replay = DressedReplay(model, made.plain, made.recording)
    for row in (0, 250, 500):
        data = replay.show(row)
        assert np.array_equal(data.xpos[1:], made.recording.pos[row])
    hat = data.geom_xpos[model.geom("drawn.hat").id]
    assert hat == pytest.approx(
        data.xpos[model.body("first").id] + data.xmat[model.body("first").id].reshape(3, 3) @ [0, 0, 0.15]
    )
    drawn = [g for g in range(model.ngeom) if model.geom(g).name.startswith("drawn.")]
    assert len(drawn) == 8
    assert not model.geom_contype[drawn].any()
    assert not model.geom_conaffinity[drawn].any()
    assert model.body_mass == pytest.approx(made.plain.body_mass)
    assert film.told(24)["drawn_only"] == [
        "hat (on first, 0.2 m, as large as second)",
        "wall",
        "grass",
        "dust (5 particles)",
    ]


def test_recorded_colours_reach_their_own_geom_wherever_additions_shifted_it(made):
    film = made.film(lambda f: (looking(f), f.draw("hat", "box", 0.1, to="first")))
    model = dress(made.folder / "world.mjz", film)
    assert model.geom("second").id != made.plain.geom("second").id
    replay = DressedReplay(model, made.plain, made.recording)
    for row, red in ((0, 0.0), (400, 0.4), (100, 0.1)):
        replay.show(row)
        assert model.geom_rgba[model.geom("second").id, 0] == pytest.approx(red, abs=0.005)
        assert model.geom_rgba[model.geom("drawn.hat").id, 0] == 0.5


def test_a_look_is_given_to_a_body_and_told(made):
    film = made.film(lambda f: (looking(f), f.look("first", "gold"), f.look("ground", Surface(colour="#224488"))))
    model = dress(made.folder / "world.mjz", film)
    assert model.mat(model.geom("first").matid[0]).name == "gold"
    assert film.told(24)["looks"] == {"first": "gold", "ground": "a surface of its own"}


def test_the_words_of_a_plate_are_a_flat_sheet_that_goes_with_its_body(made):
    film = made.film(lambda f: (looking(f), f.label("KINETIC", (0, -0.1, 0), height=0.1, facing_deg=-90.0, to="first")))
    model = dress(made.folder / "world.mjz", film)
    sheet, plate = (model.geom(f"drawn.{name}") for name in ("KINETIC", "KINETIC plate"))
    mesh = int(sheet.dataid[0])
    assert (model.mesh_vertnum[mesh], model.mesh_facenum[mesh]) == (4, 2) and model.mesh_texcoordnum[mesh] == 4
    assert sheet.bodyid[0] == plate.bodyid[0] == model.body("first").id
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    first = model.mesh_vertadr[mesh]
    corners = model.mesh_vert[first : first + 4] @ data.geom(sheet.id).xmat.reshape(3, 3).T + data.geom(sheet.id).xpos
    own = corners - data.body("first").xpos - (0, -0.1, 0)
    assert np.ptp(own[:, 1]) < 1e-6 and own[0, 1] < -plate.size[1], "before its plate"
    assert np.ptp(own[:, 0]) == pytest.approx(2 * plate.size[0]) and np.ptp(own[:, 2]) == pytest.approx(0.1)
    assert (model.mat(sheet.matid[0]).texid >= 0).any()


def test_the_words_of_a_plate_are_told_as_captions_are_whatever_it_is_called(made):
    film = made.film(
        lambda f: (
            looking(f),
            f.label("SLID 0.60 M", (0, 0, 0.5), name="post"),
            f.caption("a fall", seconds=0.1, place="top"),
        )
    )
    assert film.told(24)["captions"] == ["a fall", "SLID 0.60 M"]
    with pytest.raises(FilmError, match="no list of words"):
        made.film(looking, lambda facts, arrays: facts.update(labels=[3]))


def test_a_lamp_with_the_name_of_a_drawn_thing_is_told(made):
    def tell(film):
        looking(film)
        film.draw("cup", "sphere", 0.05, pos=(1, 0, 0))
        film.lamp("glow", (1, 0, 1), radius=0.02)
        film.lamp("wide", (1, 0, 2))

    assert made.film(tell).drawn_only() == ["cup", "glow", "wide (a lamp)"]
    other = made.film(tell, lambda facts, arrays: facts["lamps"][1].update(name="cup"))
    assert other.drawn_only() == ["cup", "glow", "cup (a lamp)"]


def test_a_skin_takes_the_place_of_its_body_if_it_has_its_size(made):
    film = made.film(lambda f: (looking(f), f.mesh("ox", 0.1 * CUBE, FACES, to="first", instead=True)))
    model = dress(made.folder / "world.mjz", film)
    assert model.geom_group[model.geom("first").id] > 2
    assert model.geom_group[model.geom("second").id] <= 2
    assert film.drawn_only() == ["ox (skin over first)"]
    longer = made.film(
        lambda f: (looking(f), f.mesh("ox", (0.24, 0.1, 0.1) * CUBE + (0.08, 0, 0), FACES, to="first", instead=True))
    )
    assert longer.drawn_only() == ["ox (skin over first, 2.4 times as long, up to 0.22 m off its sides)"]
    ahead = made.film(lambda f: (looking(f), f.mesh("ox", 0.1 * CUBE + (0.05, 0, 0), FACES, to="first", instead=True)))
    assert ahead.drawn_only() == ["ox (skin over first, up to 0.05 m off its sides)"]
    for size, pos in ((0.01, (0, 0, 0)), (1.0, (0, 0, 0)), (0.1, (0.3, 0, 0))):
        wrong = made.film(
            lambda f, size=size, pos=pos: (
                looking(f),
                f.mesh("ox", size * CUBE, FACES, pos=pos, to="first", instead=True),
            )
        )
        with pytest.raises(FilmError, match="times the size"):
            dress(made.folder / "world.mjz", wrong)


def test_a_thin_body_may_have_a_skin_that_curls_but_no_thick_or_high_one_and_never_a_line(tmp_path):
    def skin(points, faces=FACES, body=(0.04, 0.022, 0.0005)):
        spec = empty()
        floor(spec)
        plate = spec.worldbody.add_body(name="leaf", pos=(0, 0, 0.2))
        plate.add_freejoint()
        plate.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=body, mass=0.001)
        portable.write(spec, tmp_path / "world.mjz")
        name = {
            "name": "skin",
            "shape": "mesh",
            "size": (1, 1, 1),
            "pos": (0, 0, 0),
            "quat": (1, 0, 0, 0),
            "to": "leaf",
        }
        thing = {**name, "instead": True, "vertices": "v", "faces": "f", "look": "leaf_green"}
        arrays = {"v": points, "f": faces, "eye": np.zeros((1, 3))}
        film = described.Described((), (), Treatments([]), (thing,), (), (), (), {}, 0.0, 1, arrays)
        return dress(tmp_path / "world.mjz", film)

    leaf = sculpt.leaf(0.08, 0.045, curl_deg=70)
    assert 0.006 < np.ptp(leaf.vertices[:, 2]) < 0.015
    assert skin(leaf.vertices, leaf.faces).geom("drawn.skin").id >= 0
    for half, middle in (((0.04, 0.022, 0.009), 0.0), ((0.04, 0.022, 0.002), 0.004), ((0.12, 0.022, 0.002), 0.0)):
        with pytest.raises(FilmError, match="15 mm thick"):
            skin(CUBE * half + (0, 0, middle))
    wire = (0.04, 0.0005, 0.0005)
    assert skin(CUBE * (0.04, 0.001, 0.0001), body=wire).geom("drawn.skin").id >= 0, "a ribbon"
    with pytest.raises(FilmError, match="times the size"):
        skin(CUBE * (0.04, 0.0001, 0.0001), body=wire)


def test_leaves_are_drawn_where_and_as_they_are_told(made):
    def tell(film):
        looking(film)
        path = np.array([[0.0, 0, 1], [0.3, 0.2, 0.8]])
        film.particles(
            "leaves", lambda t: path + t[:, None, None] * [0, 0, -0.5], shape="leaf", diameter=0.06, look="leaf_autumn"
        )

    screening = made.screening(tell)
    film, model, frame = screening.film, screening.model, 5
    assert "leaves (2 particles)" in film.drawn_only()
    data = screening._moment(frame)
    one = model.geom("drawn.leaves/0").id
    mesh = int(model.geom_dataid[one])
    start, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    for number in range(2):
        points = (
            data.geom_xpos[one + number]
            + model.mesh_vert[start : start + count] @ data.geom_xmat[one + number].reshape(3, 3).T
        )
        turn = turning.matrices(film.arrays["turns0"][frame, number])
        assert abs(turn[2, 2]) < 0.99  # it rocks
        own = (points - film.arrays["ways0"][frame, number]) @ turn
        assert np.ptp(own[:, 0]) == pytest.approx(0.06, rel=0.05)
        assert np.allclose(own.min(axis=0), -own.max(axis=0), atol=1e-5)


@pytest.mark.parametrize(
    "wrong", [lambda a: a.update(turns0=2 * a["turns0"]), lambda a: a.update(turns0=a["turns0"][1:])]
)
def test_leaves_that_are_turned_by_no_quaternion_are_refused(made, wrong):
    def tell(film):
        looking(film)
        film.particles("leaves", lambda t: np.zeros((len(t), 2, 3)), shape="leaf")

    with pytest.raises(FilmError, match="quaternion"):
        made.film(tell, lambda facts, arrays: wrong(arrays))


def setting(name, value):
    return lambda facts, arrays: facts.update({name: value})


REFUSED = {
    "nothing of the light": lambda f, a: f["air"].append({"at_s": 0.0, "body_rgb": [1, 0, 0]}),
    "light elevation_deg must lie": lambda f, a: f["air"].append({"at_s": 0.0, "light_elevation_deg": -5}),
    "told for nan s": lambda f, a: f["air"].append({"at_s": "nan", "light_elevation_deg": 5}),
    "told for -1.0 s": lambda f, a: f["air"].append({"at_s": -1.0, "light_elevation_deg": 5}),
    "stands from": lambda f, a: f["captions"].append({"text": "a", "place": "top", "start_s": -1.0, "end_s": 1.0}),
    "to inf s": lambda f, a: f["captions"].append({"text": "a", "place": "top", "start_s": 0.0, "end_s": "inf"}),
    "no body": lambda f, a: f["things"][0].update(to="third"),
    "neither|is no body and no geom": setting("looks", {"third": "gold"}),
    "no look is called": setting("looks", {"first": "gould"}),
    "moments outside": lambda f, a: a.update(time=a["time"] + 9.0),
    "finite numbers": lambda f, a: a.update(eye=a["eye"] * np.nan),
    "does not follow": lambda f, a: f["shots"][0].update(first=3),
    "names no camera": lambda f, a: f["shots"][0].update(planned="top"),
    "is damaged": setting("things", 7),
    "is damaged: OverflowError": setting("samples", float("inf")),
    "no size": lambda f, a: f["things"][0].update(size=[0, 1, 1]),
    "no shape": lambda f, a: f["things"][0].update(shape="plane"),
    "a shutter": setting("samples", 1000),
    "a lens sees": lambda f, a: a.update(fovy_deg=a["fovy_deg"] * 0 + 170.0),
}


@pytest.mark.parametrize("words", REFUSED)
def test_a_description_that_says_what_it_may_not_is_refused(made, words):
    with pytest.raises(FilmError, match=words):
        made.film(lambda f: (looking(f), f.draw("box", "box", 0.1, to="first")), REFUSED[words])


@pytest.mark.parametrize("size", [np.nan, np.inf, -1.0, 1e9])
def test_particles_have_sizes_that_can_be_drawn(made, size):
    def grown(film):
        looking(film)
        film.particles("sparks", lambda t: np.zeros((len(t), 2, 3)))

    made.film(grown)
    with pytest.raises(FilmError, match="'sparks' has not a size"):
        made.film(grown, lambda f, a: a["sizes0"].__setitem__((3, 1), size))


def test_a_pickle_is_no_description(made):
    made.film(looking)
    np.savez(made.folder / "film.npz", time=np.array([{}], dtype=object), allow_pickle=True)
    with pytest.raises(FilmError, match="damaged"):
        described.read(made.folder, made.recording)


def test_pictures_show_the_film(made):
    def tell(film):
        looking(film)
        film.hold(follow("first"), 0.2)

    with made.screening(tell) as screening:
        first, again, held = screening.picture(0), screening.picture(0), screening.picture(10)
        assert first.shape == (54, 96, 3)
        assert np.array_equal(first, again)
        seen = screening.segmentation()
    assert np.abs(first.astype(int) - held).mean() > 3
    middle = seen[27 - 3 : 27 + 3, 48 - 3 : 48 + 3]
    assert (middle == made.plain.geom("first").id).mean() > 0.5


def test_what_a_drawn_thing_hides_is_told(made):
    made.recording.meta["movers"] = ["first", "second"]

    def behind(y):
        def tell(film):
            looking(film)
            film.draw("fence", "box", (0.3, 0.05, 2.0), pos=(0.0, y, 0.5))

        with made.screening(tell) as screening:
            screening.picture(0)
            return screening.hidden()

    assert behind(-0.5) == ["first behind fence"]
    assert behind(0.5) == []


def test_what_is_looked_at_through_a_hole_is_hidden_and_what_stands_behind_a_pole_is_told_too(made):
    made.recording.meta["movers"] = ["first"]

    with made.screening(looking) as screening:
        screening.picture(0)
        place, eye = (
            screening._replay.data.body("first").xpos.copy(),
            screening._replay.data.cam_xpos[screening._camera].copy(),
        )
    x, y, z = eye + (place - eye) * (-0.5 - eye[1]) / (place[1] - eye[1])

    def behind(*boards):
        def tell(film):
            looking(film)
            for number, (dx, dz, side, high) in enumerate(boards):
                film.draw(f"trim {number}", "box", (side, 0.002, high), pos=(x + dx, y, z + dz))

        with made.screening(tell) as screening:
            screening.picture(0)
            return screening.hidden()

    left, right, above, below = (
        (-0.105, 0, 0.2, 0.4),
        (0.105, 0, 0.2, 0.4),
        (0, 0.105, 0.02, 0.2),
        (0, -0.105, 0.02, 0.2),
    )
    (told,) = behind(left, right, above, below)
    assert told.startswith("first behind trim")
    assert behind((0, 0, 0.01, 0.4)) == ["first behind trim 0"]
    assert behind(left) == []


def test_what_a_panel_of_light_hides_is_told_unless_it_is_not_there_to_be_seen(made):
    made.recording.meta["movers"] = ["first", "second"]
    for seen in (True, False):

        def tell(film, seen=seen):
            looking(film)
            film.panel("softbox", (0.0, -1.0, 0.5), (0.4, 2.0), towards=(0, 0, 0.5), seen=seen)

        with made.screening(tell) as screening:
            screening.picture(0)
            assert ("first behind softbox" in screening.hidden()) is seen


def test_what_a_mover_carries_before_itself_hides_it_too_but_neither_it_nor_its_skin_does(made):
    made.recording.meta["movers"] = ["first"]

    def told(tell):
        def all_of_it(film):
            looking(film)
            tell(film)

        with made.screening(all_of_it) as screening:
            screening._moment(0)
            return screening.hidden()

    def screen(y):
        return lambda film: film.panel("screen", (0, y, 0), (0.5, 0.5), towards=(0, -9, 0), to="first")

    assert told(screen(-0.3)) == ["first behind screen"]
    assert told(screen(0.3)) == []
    assert told(lambda film: film.draw("lid", "box", (0.4, 0.02, 0.4), pos=(0, -0.2, 0), to="first")) == [
        "first behind lid"
    ]
    assert told(lambda film: film.mesh("coat", 0.1 * CUBE, FACES, to="first", instead=True)) == []


def test_a_plan_s_camera_sees_what_it_sees_without_a_film(made):
    from worldengine.film.drawn_frames import Frames
    from worldengine.recording.replay import Replay

    with made.screening(lambda f: f.shot(planned("side"), until=0.2)) as screening:
        filmed = screening.picture(2)
    data = Replay(made.plain, made.recording).show(int(np.abs(made.recording.time - 2 / 24).argmin()))
    with Frames(made.plain, *SIZE) as frames:
        drawn = frames.image(data, "side")
    assert np.abs(filmed.astype(int) - drawn).mean() < 1.0


def brightness(picture):
    return float(picture.mean())


def test_light_fog_and_grading_change_the_picture_as_they_say(made):
    def treated(tell):
        with made.screening(lambda f: (looking(f), tell(f))) as screening:
            return screening.picture(1).astype(float)

    plain = treated(lambda f: None)
    assert brightness(treated(lambda f: f.grade(exposure_stops=1))) > brightness(plain) + 15
    assert brightness(treated(lambda f: f.grade(fade=1))) < 2
    grey = treated(lambda f: f.grade(saturation=0))
    assert np.ptp(grey, axis=2).mean() < 2.5
    warm = treated(lambda f: f.grade(temperature=0.8))
    assert (warm[..., 0] - warm[..., 2]).mean() > (plain[..., 0] - plain[..., 2]).mean() + 15
    foggy = treated(lambda f: f.fog(colour="#ff0000", visibility_m=1.0))
    assert foggy[..., 0].mean() > 2 * foggy[..., 2].mean()
    sky = treated(lambda f: f.sky(zenith="#0000ff", horizon="#0000ff", ground="#0000ff"))
    assert sky[2, :, 2].mean() > sky[2, :, 0].mean() + 60


def test_light_that_moves_moves_its_shadows(made):
    def tell(film):
        looking(film)
        film.light(azimuth_deg=-160, elevation_deg=30, at=0.0)
        film.light(azimuth_deg=-20, elevation_deg=30, at=0.3)

    with made.screening(tell) as screening:
        early, late = screening.picture(0).astype(int), screening.picture(7).astype(int)
    assert np.abs(early - late).max() > 40


def test_what_is_out_of_focus_is_blurred(made):
    def sharp(aperture):
        camera = still((0.0, -1.0, 0.6), (0, 0, 0.5), lens_mm=50, focus=0.25, aperture=aperture)
        with made.screening(lambda f: f.shot(camera, until=0.1)) as screening:
            picture = screening.picture(0).astype(float).mean(axis=2)
        return np.abs(np.diff(picture, axis=1)).max()

    assert sharp(1.4) < 0.6 * sharp(None)


def test_an_open_shutter_smears_what_moves(made):
    def edge(*shutter):
        def tell(film):
            film.shot(still((0.0, -1.2, 0.3), (0, 0, 0.3)), until=0.4)
            if shutter:
                film.shutter(shutter[0], samples=8)

        with made.screening(tell) as screening:
            picture = screening.picture(6).astype(float)
        column = (picture[..., 0] - picture[..., 2])[:, 44:52].mean(axis=1)
        return np.abs(np.diff(column[:40])).max()

    assert edge(1.0) < 0.7 * edge()


def test_an_open_shutter_takes_one_picture_where_nothing_moves_and_more_where_much_does(made, monkeypatch):
    drawn = []

    def tell(film):
        film.hold(still((0.0, -1.2, 0.3), (0, 0, 0.3)), 0.5, at=0.1)
        film.shot(still((0.0, -1.2, 0.3), (0, 0, 0.3)), until=0.4)
        film.shutter(1.0, samples=6)

    with made.screening(tell) as screening:
        whole = screening.frames.blurred
        monkeypatch.setattr(screening.frames, "blurred", lambda m, *more: drawn.append(len(m)) or whole(m, *more))
        pictures = [screening.picture(number) for number in (3, 15, 18)]
        assert len(drawn) == 2 and all(1 < n <= 6 for n in drawn), "one that is held is one picture"
        assert np.array_equal(pictures[1], screening.picture(15)), "the same frame, the same moments"


def test_a_larger_picture_takes_more_moments_which_its_forecast_knows(made):
    def tell(film):
        film.hold(still((0.0, -1.2, 0.3), (0, 0, 0.3)), 0.5, at=0.1)
        film.shot(still((0.0, -1.2, 0.3), (0, 0, 0.3)), until=0.4)
        film.shutter(0.3, samples=16)

    with made.screening(tell) as screening:
        tall = screening.frames.height
        assert screening.dearer(15, tall) == 1.0 < screening.dearer(15, 8 * tall) <= 8.0
        assert screening.dearer(3, 8 * tall) == 1.0, "what is held stays one picture"


def test_a_film_that_says_nothing_of_its_shutter_draws_each_frame_once_and_smears_what_moves(made, monkeypatch):
    calls = []
    camera = still((0.0, -1.2, 0.3), (0, 0, 0.3))

    def tell(film):
        film.hold(camera, 0.5, at=0.1)
        film.shot(camera, until=0.4)

    with made.screening(tell) as screening:
        counted(monkeypatch, streaks, "streaked", calls)
        monkeypatch.setattr(screening.frames, "blurred", lambda *_: pytest.fail("drawn more than once"))
        held, moving = screening.picture(3), screening.picture(15)
        assert len(calls) == 1, "what is held is sharp"
        assert np.array_equal(moving, screening.picture(15)) and np.array_equal(held, screening.picture(3))
        assert screening._replay.data.time == pytest.approx(screening.film.arrays["time"][3], abs=0.01)
        screening.film = replace(screening.film, shutter=0.0)
        sharp = screening.picture(15)
        assert np.array_equal(held, screening.picture(3))
    assert np.abs(moving.astype(int) - sharp).max() > 20


def test_where_the_driver_cannot_tell_what_a_picture_shows_it_stays_sharp(made, monkeypatch):
    def refuse(*_):
        raise RuntimeError("no such format")

    with made.screening(lambda film: film.shot(still((0.0, -1.2, 0.3), (0, 0, 0.3)), until=0.4)) as screening:
        monkeypatch.setattr(screening, "surfaces", refuse)
        first = screening.picture(5)
        assert np.array_equal(first, screening.picture(5)) and "no such format" in screening._sharp


def counted(monkeypatch, place, name, calls):
    there = getattr(place, name)

    def call(*given, **named):
        calls.append((name, given, named))
        return there(*given, **named)

    monkeypatch.setattr(place, name, call)


@pytest.mark.gl
def test_light_of_an_open_shutter_is_added_up_and_developed_once(made, monkeypatch):
    pytest.importorskip("mitsuba")
    from worldengine.film.renderers.traced import tracing

    calls = []
    for place, name in ((tracing.Tracing, "trace"), (tracing.Tracing, "_cleaned"), (tracing, "develop")):
        counted(monkeypatch, place, name, calls)

    def edge(quality, shutter):
        def tell(film):
            film.shot(still((0.0, -1.2, 0.3), (0, 0, 0.3), shake=1e-3), until=0.4)  # of a still one, less is traced
            film.shutter(shutter, samples=4)

        calls.clear()
        film = made.film(tell)
        with Screening(made.folder / "world.mjz", made.plain, made.recording, film, SIZE, 24, "traced") as screening:
            picture = screening.picture(6, quality).astype(float)
            assert screening.frames.renderer == "traced", screening.frames.reason
        column = (picture[..., 0] - picture[..., 2])[:, 44:52].mean(axis=1)
        return np.abs(np.diff(column[:40])).max()

    assert edge(8, 1.0) < 0.7 * edge(8, 0.0)
    for quality, moments, each in ((8, 4, 2), (2, 2, 1), (0.5, 1, 2)):
        edge(quality, 1.0)
        assert [name for name, _, _ in calls] == ["trace"] * moments + ["_cleaned", "develop"]
        assert {given[4] for _, given, _ in calls[:moments]} == {each}, "the samples are shared out"
        assert len({given[5] for _, given, _ in calls[:moments]}) == moments, "each moment has chances of its own"


def test_how_fast_it_runs_stands_in_the_corner(made):
    def tell(film):
        looking(film, 0.2)
        film.shot(still((0.2, -2.5, 0.6), (0.2, 0, 0.4)), until=0.4, speed=0.25)
        film.shot(still((0.2, -2.5, 0.6), (0.2, 0, 0.4)), start=0.0, until=0.2)

    film = made.film(tell)
    assert [pace(film.speed(frame, 24)) for frame in (2, 8, 26)] == ["", "slow motion 1/4", ""]
    with made.screening(tell) as screening:
        corners = [screening.picture(frame)[:8, -40:].astype(int) for frame in (2, 8, film.frames - 1)]
    assert np.abs(corners[0] - corners[1]).mean() > 3
    assert np.abs(corners[0] - corners[2]).mean() > 3  # shown again


@pytest.mark.parametrize(
    ("speed", "words"),
    [
        (1.0, ""),
        (0.5, "slow motion 1/2"),
        (0.2, "slow motion 1/5"),
        (0.0, "held"),
        (2.0, "fast motion 2 ×"),
        (0.62, "slow motion 0.6 ×"),
        (0.97, "slow motion 0.97 ×"),
        (0.01, "slow motion 1/100"),
        (-1.0, "backwards"),
    ],
)
def test_speeds_have_names(speed, words):
    assert pace(speed) == words


def test_a_caption_of_a_third_of_a_second_is_read_for_half_of_it():
    black = np.zeros((180, 320, 3), np.uint8)
    captions = [{"text": "7 J", "place": "bottom", "start_s": 0.0, "end_s": 0.3}]
    seen = [int(letter(black, k / 24, captions, 1.0, False).max()) for k in range(7)]
    assert max(seen) > 240 and sum(light > 240 for light in seen) >= 3


def test_spaces_and_line_ends_of_a_caption_stay():
    black = np.zeros((180, 640, 3), np.uint8)

    def columns(text):
        captions = [{"text": text, "place": "bottom", "start_s": 0.0, "end_s": 4.0}]
        shown = letter(black, 2.0, captions, 1.0, False).max(axis=2) > 128
        return np.ptp(np.flatnonzero(shown.any(axis=0))), np.ptp(np.flatnonzero(shown.any(axis=1)))

    together, apart, below = columns("12 J 9 J"), columns("12 J      9 J"), columns("12 J\n9 J")
    assert apart[0] > together[0] + 10 and apart[1] == together[1]
    assert below[0] < together[0] and below[1] > 1.8 * together[1]


def test_however_much_a_corner_has_to_say_the_speed_stands_in_it():
    black = np.zeros((270, 480, 3), np.uint8)
    names = "drawn: " + ", ".join(["a cloud of dust that is as large as the ball that flies through it"] * 3)
    usual, slow, again, alone = (
        letter(black, 1.0, [], *said)
        for said in ((1.0, False, names), (0.2, False, names), (0.2, True, names), (0.2, False))
    )
    assert (usual != slow).any() and (slow != again).any()
    for picture in (usual, slow, again):
        assert picture[:, :9].max() == 0  # nothing runs over the edge
    wide = [np.flatnonzero((picture.max(axis=2) > 128).any(axis=0)) for picture in (slow, alone)]
    first = [columns[0] for columns in wide]
    span = int(np.ptp(wide[1])) - 1
    assert np.allclose(slow[:, first[0] : first[0] + span], alone[:, first[1] : first[1] + span], atol=60)


def test_the_corner_says_it_without_a_dark_ground_and_small():
    grey = np.full((720, 1280, 3), 200, np.uint8)
    shown = letter(grey, 1.0, [], 0.5, False).astype(int)[..., 0]
    rows, columns = np.nonzero(np.abs(shown - 200) > 8)
    words = shown[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1]
    assert np.ptp(rows) < 0.05 * 720 and np.median(words) > 170
    assert words.max() - words.min() > 70, "and it can be read on a bright picture"


def test_captions_come_and_go():
    black = np.zeros((270, 480, 3), np.uint8)
    captions = [{"text": "A ball falls", "place": "bottom", "start_s": 1.0, "end_s": 3.0}]
    assert letter(black, 0.5, captions, 1.0, False) is black
    shown = letter(black, 2.0, captions, 1.0, False)
    assert shown[220:].max() > 200
    assert shown[:200].max() == 0
    assert letter(black, 3.0, captions, 1.0, False).max() == 0
    assert black.max() == 0


def test_between_two_moments_light_changes_evenly():
    held = Treatments(
        [{"at_s": 0.0, "grade_contrast": 1.0}, {"at_s": 2.0, "grade_contrast": 2.0, "fog_rgb": (1, 1, 1)}]
    )
    assert [held.at(t).grade_contrast for t in (-1, 0, 1, 2, 9)] == [1, 1, 1.5, 2, 2]
    assert held.at(0.0).fog_rgb == (1.0, 1.0, 1.0)


def test_a_camera_stands_upright_and_rolls():
    upright = axes([0, -1, 0], [0, 0, 0], 0.0)
    assert upright == pytest.approx(np.array([[1, 0, 0], [0, 0, -1], [0, 1, 0]]))
    rolled = axes([0, -1, 0], [0, 0, 0], 90.0)
    assert rolled[:, 0] == pytest.approx([0, 0, 1])
    straight = axes([0, 0, 5], [0, 0, 0], 0.0)
    assert straight.T @ straight == pytest.approx(np.eye(3))


def test_a_renderer_that_cannot_light_says_so(made, monkeypatch):
    monkeypatch.setenv("WORLDKIT_RENDERER", "classic")
    with made.screening(lambda f: (looking(f), f.mood("noon"))) as screening:
        screening.picture(0)
        assert "fog" in screening.frames.told()["without"]


def test_nothing_here_steps_the_physics(made, monkeypatch):
    monkeypatch.setattr(mujoco, "mj_step", lambda *_: pytest.fail("a film stepped"))
    with made.screening(lambda f: f.shot(wide(), until=0.1)) as screening:
        screening.picture(0)


@pytest.mark.gl
def test_the_frames_of_a_still_shot_stand_in_for_what_does_not_change(made):
    def tell(film):
        looking(film, until=0.2)
        film.shot(follow("first"), until=0.3)
        film.light(azimuth_deg=10, at=0.3)
        film.shot(still((0.2, -2.5, 0.6), (0.2, 0, 0.4)), until=0.4)
        film.light(azimuth_deg=60, at=0.4)

    with made.screening(tell) as screening:
        shots = screening.film.shots
        first, last = shots[0]["first"], shots[0]["first"] + shots[0]["frames"] - 1
        assert screening.standing(first, 2) == screening.standing(last, 2) == (last, first)
        assert screening.standing(first, "video") == screening.standing(first, 0.5) == ()
        assert screening.standing(shots[1]["first"], 2) == (), "the camera goes along"
        assert screening.standing(shots[2]["first"], 2) == (), "the light wanders"
        assert screening.stills(first, 2) == 0, "this renderer draws none of them beside"
        screening.frames._drawing.beside = lambda moments, quality: {1: (2, 3.0), 4: (1, 1.0)}[moments]
        assert [screening.stills(frame, 2) for frame in (first, first + 1, last, shots[1]["first"])] == [5, 6, 5, 0]
        screening.film = replace(screening.film, shutter=0.5, samples=4)
        assert [screening.stills(frame, 5) for frame in (first, last)] == [1, 0], "there is room for one"
        screening.film = replace(screening.film, shutter=0.0)
        assert np.array_equal(screening.picture(first, 2), screening.picture(first))
