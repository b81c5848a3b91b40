"""A sheet shows what a file sculpts from four sides, made and drawn in the sandbox; what goes wrong has its line."""

import cv2
import numpy as np
import pytest
from click.testing import CliRunner

from worldwright.cli import main
from worldwright.model.errors import JobError, NotFoundError
from worldwright.stage import tools as stage

FILE = """\
import numpy as np
from near import RED
from worldkit import scene, sculpt
from worldkit.sculpt import brushes

ball = sculpt.sphere(0.2)
peg = sculpt.cylinder(0.05, 0.2)


def paint(points, normals):
    return brushes.over(brushes.plain(points, RED), "#2040ff", points[:, 0] < 0)


def world():
    spec = scene.new("two", time_step=0.002)
    sculpt.add(spec, ball, name="ball", pos=(0, 0, 0.1), cells=24)
    sculpt.add(spec, peg, name="peg", pos=(0.4, 0, 0.1), cells=24)
    return spec


def typing_slip():
    return sculpt.sphere(-1.0)
"""


@pytest.fixture
def file(tmp_path):
    (tmp_path / "near.py").write_text('RED = "#ff2020"\n')
    (tmp_path / "things.py").write_text(FILE)
    return tmp_path / "things.py"


def test_it_is_seen_in_its_paint_from_front_and_back(file):
    told = stage.sheet(f"{file}:ball")
    assert told.data.extent_m == pytest.approx((0.2, 0.2, 0.2), abs=2e-3)
    (part,) = told.data.parts
    assert (part.hulls, part.bits) == (1, 1) and part.mass_kg == pytest.approx(4.19, abs=0.03)
    page = cv2.imdecode(np.frombuffer(told.pictures[0].data, np.uint8), cv2.IMREAD_COLOR).astype(int)
    height, width, _ = page.shape
    front, back = page[height // 4, width // 4], page[3 * height // 4, 3 * width // 4]
    assert front[2] > front[0] + 60 and back[0] > back[2] + 60


def test_a_whole_world_is_seen_too(file):
    told = stage.sheet(f"{file}:world")
    assert told.data.parts == () and told.data.extent_m[0] == pytest.approx(0.525, abs=0.01)


def test_what_goes_wrong_has_its_place(file):
    with pytest.raises(JobError, match="sizes must be positive") as refused:
        stage.sheet(f"{file}:typing_slip")
    assert refused.value.place == f"{file}:22"
    with pytest.raises(JobError, match="no 'hare' in it") as unknown:
        stage.sheet(f"{file}:hare")
    assert "ball, peg" in unknown.value.next_move
    with pytest.raises(NotFoundError):
        stage.sheet(str(file.with_name("gone.py")))


def test_it_may_not_read_what_is_not_beside_it(file, tmp_path_factory):
    secret = tmp_path_factory.mktemp("elsewhere") / "secret.txt"
    secret.write_text("x")
    file.write_text(f"from pathlib import Path\nPath({str(secret)!r}).read_text()\n")
    with pytest.raises(JobError):
        stage.sheet(str(file))


def test_the_command_takes_the_last_shape_and_writes_its_picture(file, tmp_path):
    done = CliRunner().invoke(main, ["sculpt", "sheet", str(file), "--save", str(tmp_path / "shown")])
    assert done.exit_code == 0 and "peg: 0.05 x 0.05 x 0.2 m" in done.output
    assert len(list((tmp_path / "shown").glob("*.jpg"))) == 1
