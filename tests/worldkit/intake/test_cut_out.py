"""A thing on a plain ground is cut out; a picture whose ground is not plain, or that shows nothing, is left as it is, and it is said."""

import json

import cv2
import numpy as np
import pytest

from worldkit.intake import cut_out


def drawn(
    ground: tuple[int, int, int], thing: tuple[int, int, int], noise: float = 2.0
) -> tuple[np.ndarray, np.ndarray]:
    """A mug with a handle whose hole shows the ground, (H, W, 3), and where it is."""
    where = np.zeros((240, 320), np.uint8)
    cv2.circle(where, (205, 120), 40, 1, -1)
    cv2.circle(where, (205, 120), 24, 0, -1)
    cv2.rectangle(where, (110, 60), (200, 190), 1, -1)
    picture = np.where(where[..., None] == 1, thing, ground) + np.random.default_rng(1).normal(0, noise, (240, 320, 3))
    return np.clip(cv2.GaussianBlur(picture, (3, 3), 0), 0, 255).astype(np.uint8), where


@pytest.mark.parametrize(
    ("ground", "thing"),
    [((250, 250, 250), (40, 60, 170)), ((20, 20, 20), (190, 200, 205)), ((90, 160, 70), (200, 120, 60))],
)
def test_a_thing_is_cut_from_a_plain_ground_with_the_hole_of_its_handle(ground, thing) -> None:
    picture, where = drawn(ground, thing)
    made, why = cut_out.cut(picture)
    assert "cut away" in why and (made[..., :3] == picture).all()
    found = made[..., 3] > 127
    assert (found & (where == 1)).sum() / (found | (where == 1)).sum() > 0.97 and made[120, 212, 3] == 0


def test_grey_deep_and_cut_pictures_are_understood() -> None:
    picture, where = drawn((250, 250, 250), (60, 60, 60))
    grey, _ = cut_out.cut(cv2.cvtColor(picture, cv2.COLOR_BGR2GRAY))
    deep, _ = cut_out.cut(picture.astype(np.uint16) * 257)
    assert grey.shape == (240, 320, 4) and ((deep[..., 3] > 127) != (where == 1)).mean() < 0.02
    assert cut_out.cut(deep) == (None, "it is cut out already")


@pytest.mark.parametrize(
    ("picture", "why"),
    [
        (np.random.default_rng(2).integers(0, 255, (120, 120, 3)).astype(np.uint8), "not plain"),
        (np.full((120, 120, 3), 200, np.uint8), "nothing stands out"),
        (np.full((8, 8, 3), 200, np.uint8), "too small"),
    ],
)
def test_what_cannot_be_cut_is_left_and_said(picture, why) -> None:
    made, told = cut_out.cut(picture)
    assert made is None and why in told


def test_a_photograph_is_cut_upright_as_its_camera_was_held(tmp_path) -> None:
    jpeg = cv2.imencode(".jpg", drawn((250, 250, 250), (40, 60, 170))[0])[1].tobytes()
    turned = b"Exif\0\0MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0\x06\0\0\0\0\0\0"  # orientation 6: a quarter turn
    (tmp_path / "picture").write_bytes(
        jpeg[:2] + b"\xff\xe1" + (len(turned) + 2).to_bytes(2, "big") + turned + jpeg[2:]
    )
    assert cut_out.main([str(tmp_path / "picture"), str(tmp_path)]) == 0
    assert cv2.imread(str(tmp_path / "cut.png"), cv2.IMREAD_UNCHANGED).shape == (320, 240, 4)


def test_the_process_says_what_it_could_not_decode(tmp_path) -> None:
    file = tmp_path / "picture"
    file.write_bytes(b"\x89PNG\r\n\x1a\n none")
    assert cut_out.main([str(file), str(tmp_path)]) == 1
    assert "decoded" in json.loads((tmp_path / "result.json").read_text())["why"]
    cv2.imwrite(str(tmp_path / "a.png"), drawn((250, 250, 250), (40, 60, 170))[0])
    assert cut_out.main([str(tmp_path / "a.png"), str(tmp_path)]) == 0
    assert cv2.imread(str(tmp_path / "cut.png"), cv2.IMREAD_UNCHANGED).shape == (240, 320, 4)
