"""A film says in its picture's corner, its statement and its report what it shows otherwise than it was."""

from types import SimpleNamespace

import mujoco
import numpy as np
import pytest

from small_worlds import ball, empty, floor, lay_film, record
from worldengine.film import camera_roll, described, motion_facts, stand_ins, time_map, unseen
from worldengine.film.described import FilmError
from worldengine.film.dressed import dress
from worldengine.film.renderers.preview.things import Things
from worldengine.recording.seen import visible
from worldkit import portable
from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded, Surface, still

FPS = 24


class Made:
    """A ball that rolls for four seconds over a floor, recorded, and films of it."""

    MOVERS = ("ball",)

    def __init__(self, folder):
        self.folder = folder
        self.recording = record(self.world(), folder / "trajectory", 2000, before=self.push)
        self.recording.meta["movers"] = list(self.MOVERS)
        portable.write(self.world(), folder / "world.mjz")
        facts = {"fps": FPS, "size": [96, 54], "movers": list(self.MOVERS)}
        motion_facts.write(self.recording, folder / "motion.npz", facts)
        with np.load(folder / "motion.npz") as arrays:
            self.seen = Recorded(dict(arrays))

    def world(self):
        spec = empty(time_step=0.002)
        floor(spec)
        ball(spec, "ball", (0, 0, 0.1), rgba=(0.8, 0.1, 0.1, 1))
        return spec

    def push(self, model, data):
        data.qvel[0] = 0.2

    def film(self, tell, change=None):
        film = Film(self.seen)
        tell(film)
        if not film._shots:
            film.shot(SIDE, until=1.0)
        lay_film(self.folder, film, change)
        return described.read(self.folder, self.recording)

    def said(self, film, frame):
        return [time_map.words(film, frame, FPS), camera_roll.words(film, frame), stand_ins.words(film, frame)]


class Among(Made):
    """The same ball beside a large one, a point of mass without a shape, and two posts, one of which it rolls by."""

    MOVERS = ("ball", "large", "point")

    def world(self):
        spec = super().world()
        ball(spec, "large", (0, 2, 0.3), radius=0.3)
        heavy = {"mass": 0.1, "inertia": (1e-4, 1e-4, 1e-4), "ipos": (0, 0, 0), "explicitinertial": True}
        point = spec.worldbody.add_body(name="point", pos=(0, 4, 1), **heavy)
        point.add_freejoint()
        for name, y in (("post", 0.1), ("far post", -2)):
            post = spec.worldbody.add_body(name=name, pos=(0.4, y, 0))
            post.add_geom(size=(0.01, 0, 0), contype=0, conaffinity=0)
        return spec


class Long(Among):
    """The two balls beside a plank, 1.2 m long and 4 cm thick."""

    MOVERS = ("ball", "large", "plank")

    def world(self):
        spec = super().world()
        plank = spec.worldbody.add_body(name="plank", pos=(0, 6, 0.02))
        plank.add_freejoint()
        plank.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(0.6, 0.1, 0.02))
        return spec


SIDE = still((0.2, -2.5, 0.6), (0.2, 0, 0.1))


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    return Made(tmp_path_factory.mktemp("truths"))


def test_many_cuts_that_leap_ahead_are_fast_motion_and_say_so(made):
    def leaping(film):
        for number in range(12):
            film.shot(SIDE, start=number * 0.3, until=number * 0.3 + 2.4 / FPS)

    film = made.film(leaping)
    told = film.told(FPS)
    assert {shot["speed"] for shot in told["shots"]} == {1.0}
    assert told["shots"][1]["leap_s"] == pytest.approx(0.3 - 2 / FPS, abs=1e-3)
    assert all(row["pace"] > 2.5 for row in told["time_map"])
    assert made.said(film, 0)[0] == ""
    assert made.said(film, 2)[0] == "0.22 s later"
    assert "by cuts" in made.said(film, 20)[0] and made.said(film, 20)[0].startswith(("fast motion 3", "fast motion 4"))


def test_shots_that_follow_each_other_leap_over_nothing_whatever_their_speeds(made):
    def plain(film):
        film.shot(SIDE, until=0.7)
        film.shot(SIDE, until=1.2, speed=(1, 0.2))
        film.hold(SIDE, 0.5)
        film.shot(SIDE, until=3.0, speed=2.0)

    film = made.film(plain)
    told = film.told(FPS)
    assert not any("leap_s" in shot for shot in told["shots"])
    assert {made.said(film, frame)[0] for frame in range(film.frames)} == {""}
    assert sum(row["seconds"] for row in told["time_map"]) == pytest.approx(film.frames / FPS, abs=1e-3)


def test_short_shots_that_each_begin_before_the_one_before_run_backwards_and_say_so(made):
    def back(film):
        for number in range(12):
            film.shot(SIDE, start=3.6 - number * 0.3, until=3.6 - number * 0.3 + 2.4 / FPS)

    film = made.film(back)
    told = film.told(FPS)
    assert {shot["speed"] for shot in told["shots"]} == {1.0}
    assert told["shots"][1]["leap_s"] == pytest.approx(-0.3 - 1 / FPS, abs=1e-3)
    assert all(row["pace"] < -2.5 and row["back_s"] > 2.5 for row in told["time_map"])
    assert [made.said(film, frame)[0] for frame in (0, 2)] == ["", "0.34 s earlier"]
    assert made.said(film, 20)[0].startswith("backwards, ") and made.said(film, 20)[0].endswith("by cuts")


def test_a_film_that_goes_back_and_comes_out_later_says_that_it_goes_back(made):
    def rocked(film):
        for start in (1.0, 0.9, 1.2, 1.1, 1.4, 1.3):
            film.shot(SIDE, start=start, until=start + 0.2)

    film = made.film(rocked)
    assert made.said(film, 20)[0] == "goes back by cuts"
    first = film.told(FPS)["time_map"][0]
    assert 0 < first["pace"] < 1 and first["back_s"] > 0.3


def test_a_moment_that_is_shown_again_is_told_for_a_second(made):
    film = made.film(lambda f: (f.shot(SIDE, until=3.0), f.shot(SIDE, start=1.0, until=2.5)))
    cut = film.shots[1]["first"]
    assert [made.said(film, frame)[0] for frame in (cut - 1, cut, cut + FPS + 1)] == ["", "2 s earlier", ""]
    assert film.told(FPS)["shots"][1]["leap_s"] == pytest.approx(-2.0, abs=0.05)


def test_one_cut_that_leaps_ahead_is_told_for_a_second(made):
    film = made.film(lambda f: (f.shot(SIDE, until=0.5), f.shot(SIDE, start=2.0, until=4.0)))
    cut = film.shots[1]["first"]
    assert [made.said(film, frame)[0] for frame in (cut - 1, cut, cut + FPS + 1)] == ["", "1.5 s later", ""]


def test_a_camera_that_is_rolled_over_is_told_and_one_that_is_canted_or_looks_down_is_not(made):
    def rolled(roll, eye=(0.2, -2.5, 0.6), change=None):
        return made.film(lambda f: f.shot(still(eye, (0.2, 0, 0.1), roll_deg=roll), until=0.3), change)

    for roll in (180.0, -180.0, 540.0):
        film = rolled(roll)
        assert abs(film.told(FPS)["shots"][0]["rolled_deg"]) == 180.0
        assert made.said(film, 3)[1] == "camera rolled 180°"
    for film in (rolled(20.0), rolled(360.0), rolled(90.0, (0.2, -0.01, 3.0))):
        assert "rolled_deg" not in film.told(FPS)["shots"][0] and made.said(film, 3)[1] == ""


def flying(diameter):
    return lambda f: f.particles(
        "dust", lambda t: np.stack([0.3 * t, 0 * t, 0.1 + t], axis=1)[:, None], diameter=diameter
    )


def test_particles_as_large_as_a_mover_are_told_by_size_and_count_and_in_the_corner(made):
    film = made.film(flying(0.2))
    assert film.drawn_only() == ["dust (1 particles of 0.2 m, as large as ball)"]
    assert made.said(film, 3)[2] == "drawn: dust"
    small = made.film(flying(0.02))
    assert small.drawn_only() == ["dust (1 particles)"] and made.said(small, 3)[2] == ""


def balled(radius, apart, names=("dust",), away=0.3):
    """Films of small particles, 4 cm wide, that make a ball together and fly beside; `names` share them."""
    grid = np.mgrid[-radius : radius + 1e-9 : apart, -radius : radius + 1e-9 : apart, -radius : radius + 1e-9 : apart]
    there = grid.reshape(3, -1).T
    there = there[np.linalg.norm(there, axis=1) <= radius]

    def tell(film):
        for n, name in enumerate(names):
            mine = there[n :: len(names)]
            film.particles(
                name,
                lambda t, mine=mine: mine + np.stack([away * t, 0 * t, 0.2 + t], axis=1)[:, None],
                diameter=0.04,
            )

    return tell


def test_small_particles_that_make_a_mover_together_are_told_and_such_that_fly_apart_are_not(made):
    for names in (("dust",), ("dust", "smoke")):
        film = made.film(balled(0.08, 0.04, names))
        assert all(said.endswith("particles of 0.2 m together, as large as ball)") for said in film.drawn_only())
        assert made.said(film, 3)[2] == f"drawn: {', '.join(names)}"
    for far in (balled(0.08, 0.06), balled(0.25, 0.04)):  # apart; a cloud that is far larger than the ball
        film = made.film(far)
        assert "as large" not in str(film.drawn_only()) and made.said(film, 3)[2] == ""


def test_particles_under_a_surface_are_told_by_what_it_is_called_however_large_it_is(made):
    for radius, size in ((0.08, "0.2"), (0.25, "0.48")):

        def covered(film, radius=radius):
            balled(radius, 0.04)(film)
            film.surface("honey", of="dust", look="honey")

        film = made.film(covered)
        assert film.drawn_only()[1] == f"honey (one surface in place of 1 shapes, {size} m together, as large as ball)"
        assert made.said(film, 3)[2] == "drawn: honey"


def test_a_thing_in_a_mover_s_place_is_told_and_scenery_is_not(made):
    def drawn(**where):
        film = made.film(lambda f: f.draw("other", "sphere", 0.21, **where))
        return film.drawn_only(), made.said(film, 3)[2]

    assert drawn(pos=(0.4, 0, 0.1)) == (["other (0.21 m, as large as ball, and in its place)"], "drawn: other")
    assert drawn(to="ball") == (["other (on ball, 0.21 m, as large as ball, and in its place)"], ""), "as a skin's"
    assert drawn(to="ball", pos=(0, 0, 0.08))[1] == "", "a hat"
    assert drawn(pos=(0.4, 1.0, 0.1)) == (["other"], "")
    assert drawn(to="ball", pos=(0, 0, 0.2)) == (["other (on ball)"], "")


@pytest.fixture(scope="module")
def among(tmp_path_factory):
    return Among(tmp_path_factory.mktemp("among"))


@pytest.mark.parametrize(
    ("size", "where", "said"),
    [
        (0.21, {"to": "large", "pos": (0, 0, 0.6)}, ["other (on large, 0.21 m, as large as ball)"]),
        (0.21, {"to": "large", "pos": (0, 0, 0.2)}, ["other (on large, 0.21 m, as large as ball)"]),
        (0.05, {"to": "large", "pos": (0, 0, 0.6)}, ["other (on large)"]),
        (0.5, {"to": "ball", "pos": (0, 0, 0.6)}, ["other (on ball, 0.5 m, as large as large)"]),
        (0.21, {"to": "ball", "pos": (0, 0, 0.2)}, ["other (on ball)"]),
        (0.21, {"to": "post", "pos": (0, -0.1, 0.1)}, ["other (on post, 0.21 m, as large as ball, and in its place)"]),
        (0.21, {"to": "far post", "pos": (0, -0.1, 0.1)}, ["other (on far post)"]),
    ],
)
def test_a_twin_that_rides_on_another_mover_is_told_and_one_on_what_stands_where_it_stands(among, size, where, said):
    film = among.film(lambda f: f.draw("other", "sphere", size, **where))
    assert film.drawn_only() == said
    assert among.said(film, 3)[2] == ("drawn: other" if "as large" in said[0] else "")


@pytest.fixture(scope="module")
def long(tmp_path_factory):
    return Long(tmp_path_factory.mktemp("long"))


@pytest.mark.parametrize(
    ("shape", "size", "pos", "shown"),
    [
        ("box", (1.25, 0.25, 0.06), (0, 0, 0.01), ""),  # a coat of paint
        ("box", (1.2, 0.3, 0.5), (0, 0, 0.22), ""),  # a body of sheet on its chassis
        ("box", (1.2, 0.2, 0.04), (0, 0, 0.2), "drawn: other"),  # one more plank that hovers over it
        ("sphere", 0.62, (0.0, 0, 0), "drawn: other"),  # the large ball's twin, stuck on the plank
        ("sphere", 0.62, (0.2, 0, 0.24), "drawn: other"),
    ],
)
def test_what_a_long_mover_wears_is_told_from_what_rides_on_it(long, shape, size, pos, shown):
    film = long.film(lambda f: f.draw("other", shape, size, to="plank", pos=pos))
    assert "as large as" in film.drawn_only()[0] and long.said(film, 3)[2] == shown


def test_what_moves_without_a_shape_of_its_own_has_no_size_to_be_as_large_as(among):
    assert "point" in stand_ins.movers(among.recording)
    film = among.film(flying(0.02))
    assert film.drawn_only() == ["dust (1 particles)"] and among.said(film, 3)[2] == ""


@pytest.mark.parametrize("frames", [1, 2, 24, 25, 26, 47, 48, 49])
def test_the_time_map_is_as_long_as_the_film(frames):
    times = 0.002 * np.arange(frames) ** 2.0  # each second of film is faster than the one before
    rows = time_map.paces(SimpleNamespace(frames=frames, shots=(), arrays={"time": times}), FPS)
    assert sum(row["seconds"] for row in rows) == pytest.approx(frames / FPS, abs=1e-3)
    assert all(row["pace"] > 0 for row in rows) or frames == 1
    assert [row["film_s"] for row in rows] == [float(second) for second in range(max(frames - 2, 0) // FPS + 1)]


def test_a_speck_on_a_clear_mover_does_not_show_it(made):
    clear = {"rgb": [1, 1, 1], "roughness": 0.5, "metallic": 0, "glow": 0, "opacity": 0.05, "tile_m": 1}

    def specked(facts, _, **more):
        facts["looks"].update(ball=clear)
        facts["things"][0] |= more

    for name, more in (("speck", {}), ("speck", {"instead": True}), ("a/speck", {})):
        film = made.film(
            lambda f, name=name: f.draw(name, "sphere", 0.002, to="ball"),
            lambda *told, more=more: specked(*told, **more),
        )
        with pytest.raises(FilmError, match="makes 'ball', which can move, nearly clear"):
            dress(made.folder / "world.mjz", film)


@pytest.mark.parametrize(
    ("pane", "own", "shown"), [(0.0, 1.0, True), (1.0, 0.0, False), (0.0, None, False), (1.0, None, True)]
)
def test_a_colour_of_its_own_wins_over_a_material_s_whoever_asks(pane, own, shown):
    spec = empty()
    spec.add_material(name="pane", rgba=(1, 1, 1, pane))
    ball(spec, "ball", (0, 0, 1), material="pane", **({} if own is None else {"rgba": (1, 0, 0, own)}))
    model = spec.compile()
    drawn = mujoco.MjvScene(model, 10)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    catch = int(mujoco.mjtCatBit.mjCAT_ALL)
    mujoco.mjv_updateScene(model, data, mujoco.MjvOption(), None, mujoco.MjvCamera(), catch, drawn)
    assert [geom.rgba[3] > 0.02 for geom in drawn.geoms[: drawn.ngeom]].count(True) == shown  # as the engine draws it
    assert bool(visible(model)[0]) == (len(Things(model).geoms) == 1) == ("ball" in unseen.seen(spec)) == shown


def test_no_look_makes_a_mover_unseen(made):
    with pytest.raises(ProgramError, match="'ball' moves, and an opacity of 0 makes it unseen"):
        made.film(lambda f: f.look("ball", Surface(opacity=0.0)))
    clear = {"rgb": [1, 1, 1], "roughness": 0.5, "metallic": 0, "glow": 0, "opacity": 0.05, "tile_m": 1}

    def refused(film):
        with pytest.raises(FilmError, match="makes 'ball', which can move, nearly clear"):
            dress(made.folder / "world.mjz", film)

    refused(made.film(lambda f: None, lambda facts, _: facts["looks"].update(ball=clear)))
    refused(made.film(lambda f: f.surface("honey", of="ball", look=Surface(opacity=0.1))))
    whole = made.film(lambda f: (f.surface("honey", of="ball", look="honey"), f.look("ground", Surface(opacity=0.1))))
    assert dress(made.folder / "world.mjz", whole).nskin == 1
    assert whole.told(FPS)["looks"] == {"ground": "a surface of its own, nearly clear"}
    assert dress(made.folder / "world.mjz", made.film(lambda f: f.look("ball", "glass_clear"))).ngeom


def test_a_clear_skin_hides_no_mover(made):
    cube = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], float)
    faces = [(0, 2, 1), (1, 2, 3), (4, 5, 6), (5, 7, 6), (0, 1, 4), (1, 5, 4), (2, 6, 3), (3, 6, 7), (0, 4, 2), (2, 4, 6), (1, 3, 5), (3, 7, 5)]  # fmt: skip

    def skin(look):
        return made.film(lambda f: f.mesh("coat", 0.1 * cube, np.array(faces), to="ball", instead=True, look=look))

    with pytest.raises(FilmError, match="nearly clear"):
        dress(made.folder / "world.mjz", skin(Surface(opacity=0.05)))
    assert skin("gold").told(FPS)["drawn_only"] == ["coat (skin over ball)"]


def test_captions_are_told_word_for_word(made):
    film = made.film(lambda f: f.caption("The ball leaps by itself"))
    assert film.told(FPS)["captions"] == ["The ball leaps by itself"]
