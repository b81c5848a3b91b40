"""A breeze moves what is drawn only, the same in both renderers; what is simulated stands where it was recorded."""

import numpy as np
import pytest

from small_worlds import ball, empty, floor, lay_film, record
from worldengine.film import described, dressed, motion_facts, swaying
from worldengine.film.described import FilmError
from worldengine.film.directed import Screening
from worldengine.film.renderers.traced.figures import found_again
from worldkit import portable
from worldkit.errors import ProgramError
from worldkit.filming import Film, Recorded, still, trees
from worldkit.filming import swaying_weights as weights

SIZE = (96, 54)
WIND = ["3.0", "0.0", "0.0"]


class Blown:
    """A ball at rest on a floor, and films of it."""

    def __init__(self, folder):
        self.folder = folder
        spec = empty()
        floor(spec)
        ball(spec, "ball", (-0.6, 0, 0.05))
        portable.write(spec, folder / "world.mjz")
        self.recording = record(spec, folder / "trajectory", 1000)
        self.recording.meta["movers"] = ["ball"]
        self.plain = portable.read(folder / "world.mjz")
        facts = {"fps": 24, "size": list(SIZE), "movers": ["ball"]}
        motion_facts.write(self.recording, folder / "motion.npz", facts, {"wind": WIND})
        with np.load(folder / "motion.npz") as arrays:
            self.seen = Recorded(dict(arrays))

    def film(self, tell, change=None):
        film = Film(self.seen)
        tell(film)
        film.shot(still((0, -3, 0.6), (0, 0, 0.5), lens_mm=35), until=0.9)
        lay_film(self.folder, film, change)
        return described.read(self.folder, self.recording)

    def pictures(self, tell, renderer, frames=(2, 16)):
        film = self.film(tell)
        with Screening(self.folder / "world.mjz", self.plain, self.recording, film, SIZE, 24, renderer) as screening:
            found = [
                screening.picture(frame, "video" if renderer == "preview" else 4).astype(float) for frame in frames
            ]
            assert screening.frames.renderer == renderer, screening.frames.reason
        return found


@pytest.fixture(scope="module")
def blown(tmp_path_factory):
    return Blown(tmp_path_factory.mktemp("blown"))


def flag(film):
    """A red sheet that hangs from its upper edge and is carried the further, the lower."""
    x, z = np.meshgrid(np.linspace(-0.2, 0.2, 9), np.linspace(0, 0.8, 17))
    points = np.stack([x, 0 * x, z + 0.1], -1).reshape(-1, 3)
    k = np.arange(x.size).reshape(x.shape)
    a, b, c, d = (part.ravel() for part in (k[:-1, :-1], k[:-1, 1:], k[1:, 1:], k[1:, :-1]))
    faces = np.vstack([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])
    faces = np.vstack([faces, faces[:, ::-1]])
    film.mesh("sheet", points, faces, look="#dd0000", sways=0.9 * (0.8 - (points[:, 2] - 0.1)))


def place(picture):
    """The column in which the red is, on the mean, in the lower half."""
    red = np.clip(picture[27:, :, 0] - picture[27:, :, 1] - 60, 0, None)
    red[:, :30] = 0  # the ball
    assert red.sum() > 500
    return float((red * np.arange(SIZE[0])).sum() / red.sum())


def windy(film):
    flag(film)
    film.breeze(8.0, towards_deg=0.0)


def pane(x0, x1, weight=0.8, look="#dd0000"):
    """Tells a film of a wide upright sheet before the ball, all of which is carried as far."""
    points = np.array([(x, -0.5, z) for x in (x0, x1) for z in (-0.7, 1.6)], float)
    faces = [(0, 1, 2), (1, 3, 2), (0, 2, 1), (1, 2, 3)]
    return lambda film: film.mesh("sheet", points, faces, look=look, sways=np.full(4, weight))


def red_at_the_ball(screening, picture):
    """How much redder than green a picture is where the middle of the ball is."""
    data, camera = screening._replay.data, screening._camera
    seen = data.cam_xmat[camera].reshape(3, 3).T @ (data.body("ball").xipos - data.cam_xpos[camera])
    focal = SIZE[1] / 2 / np.tan(np.radians(screening.model.cam_fovy[camera]) / 2)
    column, row = (SIZE[0] / 2 - focal * seen[0] / seen[2], SIZE[1] / 2 + focal * seen[1] / seen[2])
    red, green, _ = picture[int(row), int(column)]
    return float(red - green)


@pytest.mark.gl
@pytest.mark.parametrize("renderer", ["preview", "traced"])
@pytest.mark.parametrize(("x0", "x1", "calm"), [(-0.65, -0.35, True), (-2.3, -0.6, False)], ids=["off", "over"])
def test_what_the_wind_carries_hides_a_thing_where_it_is_drawn(blown, x0, x1, calm, renderer):
    tell = pane(x0, x1)
    for wind, hides in ((None, calm), (40.0, not calm)):
        film = blown.film(lambda film, wind=wind: (tell(film), wind and film.breeze(wind, towards_deg=0.0)))
        with Screening(blown.folder / "world.mjz", blown.plain, blown.recording, film, SIZE, 24, renderer) as screening:
            for frame in (2, 9, 16):
                picture = screening.picture(frame, "video" if renderer == "preview" else 1).astype(float)
                assert screening.hidden() == ["ball behind sheet"] * hides, (wind, frame)
                assert (red_at_the_ball(screening, picture) > 60) is hides, (wind, frame)


def test_what_the_wind_carries_is_blurred_as_far_as_it_goes(blown):
    """With an open shutter, a gale takes more moments than a light air, and calm takes one."""
    taken = []
    for wind in (None, 1.0, 40.0):
        film = blown.film(
            lambda film, wind=wind: (flag(film), wind and film.breeze(wind, towards_deg=0.0), film.shutter(1.0))
        )
        with Screening(blown.folder / "world.mjz", blown.plain, blown.recording, film, (1280, 720), 24) as screening:
            taken.append([screening._moments("video", frame) for frame in (4, 10, 16)])
    assert taken[0] == [1, 1, 1] and max(taken[1]) < max(taken[2]) and max(taken[2]) == 8, taken


def test_a_foot_stands_and_the_wind_carries_in_proportion():
    weight, phase = np.array([0.0, 0.5]), np.zeros(2)
    points = np.array([(0, 0, 0), (1, 2, 3)], float)
    for t in np.linspace(0, 5, 40):
        moved = swaying.swayed(points, weight, phase, (8.0, 0.0, float(t)))
        assert not moved[0].any() and np.linalg.norm(moved[1]) < 1.2 * 0.5
        weak = swaying.swayed(points, weight, phase, (2.0, 0.0, float(t)))
        assert weak[1] == pytest.approx(moved[1] / 4)


@pytest.mark.gl
def test_the_preview_and_the_final_picture_agree_on_where_it_is(blown):
    calm = place(blown.pictures(flag, "preview", (2,))[0])
    mine = [place(picture) for picture in blown.pictures(windy, "preview")]
    theirs = [place(picture) for picture in blown.pictures(windy, "traced")]
    assert min(mine) > calm + 3, "it is carried along the wind"
    assert abs(mine[0] - mine[1]) > 0.3, "and not evenly"
    assert mine == pytest.approx(theirs, abs=1.0)


@pytest.mark.gl
def test_what_is_simulated_stands_still(blown):
    calm, windy_one = blown.pictures(flag, "preview", (2,))[0], blown.pictures(windy, "preview", (2,))[0]
    where = (slice(36, 50), slice(0, 30))  # the ball, far from the sheet
    assert np.abs(calm[where] - windy_one[where]).max() < 6


def test_a_blade_stands_with_its_foot_and_a_tree_with_its_trunk():
    film = Film(Recorded.rehearsal({"ball": np.zeros((5, 3))}, duration=1.0))
    film.grass(area=(-1, -1, 1, 1), height=0.2, count=50)
    told = film._things[-1].sways.reshape(-1, 5, 2)
    assert not told[:, :2, 0].any() and (told[:, 4, 0] > told[:, 2, 0]).all() and told[:, 4, 0].max() <= 0.2
    one = trees.tree("broadleaf", 8.0, 3)
    wood, leaves = weights.of_wood(one.wood, 8.0), weights.of_leaves(one.leaves, 8.0)
    assert wood[one.wood[:, 2] < 0.3, 0].max() < 0.002 and 0.1 < wood[:, 0].max() < 0.5
    assert np.ptp(leaves.reshape(-1, 4, 2), axis=1).max() < 1e-9, "a leaf is carried whole"


def test_only_a_film_with_a_breeze_tells_how_things_sway(blown):
    film = blown.film(flag)
    assert not film.things[0].get("sways") and film.breeze is None and "breeze" not in str(film.drawn_only())
    film = blown.film(lambda film: (flag(film), film.breeze()))
    assert film.things[0]["sways"] and film.breeze == (3.0, 0.0), "the plan's wind"
    assert "breeze (moves what is drawn only)" in film.drawn_only()
    model = dressed.dress(blown.folder / "world.mjz", film)
    assert swaying.geoms(model) == {model.geom("drawn.sheet").id}
    assert swaying.geoms(blown.plain) == set()


@pytest.mark.parametrize(
    "tell",
    [
        lambda film: film.breeze(0.0),
        lambda film: film.breeze(100.0),
        lambda film: film.mesh("m", np.eye(4)[:, :3], [(0, 1, 2), (0, 2, 3)], sways=np.zeros(3)),
        lambda film: film.mesh("m", np.eye(4)[:, :3], [(0, 1, 2), (0, 2, 3)], sways=np.full(4, 11.0)),
        lambda film: film.mesh("m", np.eye(4)[:, :3], [(0, 1, 2), (0, 2, 3)], sways=np.zeros(4), uv=np.zeros((4, 2))),
    ],
    ids=["no wind", "a storm", "too few", "too far", "with a picture"],
)
def test_what_no_breeze_does_is_refused(blown, tell):
    with pytest.raises(ProgramError):
        blown.film(tell)


def test_without_a_wind_of_the_plan_one_has_to_be_given():
    film = Film(Recorded.rehearsal({"ball": np.zeros((5, 3))}, duration=1.0))
    with pytest.raises(ProgramError, match="blows with more than 0"):
        film.breeze()
    assert "breeze" not in film.description()[0]


def test_a_hurricane_of_the_plan_is_drawn_as_the_strongest_breeze(blown):
    seen = Recorded.rehearsal({"ball": np.zeros((5, 3))}, duration=1.0)
    seen.wind = (0.0, -70.0, 0.0)
    film = Film(seen)
    film.breeze()
    assert film._breeze == pytest.approx((0.0, -40.0))
    assert blown.film(lambda film: film.breeze(40.0, towards_deg=30.0)).breeze
    with pytest.raises(ProgramError, match="at most 40"):
        film.breeze(70.0)


@pytest.mark.parametrize(
    "change",
    [
        lambda facts, arrays: facts.update(breeze=[1e9, 0]),
        lambda facts, arrays: facts.update(breeze=[float("nan"), 0]),
        lambda facts, arrays: arrays["uv0"].fill(1e6),
        lambda facts, arrays: arrays["uv0"].fill(0.9),
        lambda facts, arrays: arrays["uv0"].fill(-0.1),
        lambda facts, arrays: facts["things"][0].update(look="glass_clear"),
        lambda facts, arrays: arrays["uv0"].fill(np.nan),
    ],
    ids=["too strong", "no number", "too far", "further than it is large", "backwards", "see-through", "nowhere"],
)
def test_a_description_that_asks_for_more_is_refused(blown, change):
    with pytest.raises(FilmError, match=r"breeze|sways|number|not one uv"):
        blown.film(windy, change)


def test_corners_that_paint_has_split_sway_as_before():
    rows = np.zeros((3, 9), np.float32)
    rows[:, :3] = np.eye(3)
    rows[:, 7], rows[:, 8] = (0.1, 0.2, 0.3), (1, 0, -1)
    found = found_again(np.eye(3)[[2, 0, 0, 1]], rows)
    assert found == pytest.approx(np.array([(0.3, 2), (0.1, 0), (0.1, 0), (0.2, 1)]))
