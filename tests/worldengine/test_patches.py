"""Patches over a plate: where nothing differs they leave it as it is, and where they begin cannot be seen."""

import numpy as np

from worldengine.film.renderers.traced import patches, walked
from worldengine.film.renderers.traced.shutter import Shutter

HEIGHT, WIDTH = 360, 640


def differing(*places: tuple[int, int]) -> np.ndarray:
    """A mask a quarter as high and as wide as the picture, in which some places differ."""
    mask = np.zeros((HEIGHT // 4, WIDTH // 4), bool)
    for row, column in places:
        mask[row, column] = True
    return mask


def test_boxes_hold_what_differs_with_room_and_never_overlap():
    assert patches.boxes(differing(), HEIGHT, WIDTH) == []
    room = patches.AROUND_PX
    ((rows, columns),) = patches.boxes(differing((45, 80)), HEIGHT, WIDTH)
    assert (rows, columns) == (slice(180 - room, 184 + room), slice(320 - room, 324 + room))
    ((rows, columns),) = patches.boxes(differing((0, 0)), HEIGHT, WIDTH)
    assert (rows, columns) == (slice(0, 4 + room), slice(0, 4 + room)), "no further than the picture"
    assert len(patches.boxes(differing((45, 20), (45, 140)), HEIGHT, WIDTH)) == 2
    assert len(patches.boxes(differing((45, 20), (50, 40)), HEIGHT, WIDTH)) == 1, "what is near is done together"
    seen = np.zeros((HEIGHT, WIDTH), int)
    ring = [(row, column) for row in range(5, 85, 5) for column in (10, 60)] + [(5, column) for column in range(10, 60)]
    for box in patches.boxes(differing(*ring, (45, 35), (45, 150)), HEIGHT, WIDTH):
        seen[box] += 1
    assert seen.max() == 1


def test_a_patch_melts_into_the_plate_and_touches_nothing_else():
    clean = np.full((HEIGHT, WIDTH, 3), 0.5, np.float32)
    rays = walked.Rays(*[np.zeros((HEIGHT, WIDTH, 3), np.float32)] * 4, np.ones((HEIGHT, WIDTH), np.float32))
    asked = []

    def denoise(some, scale, fine):
        asked.append((some.light.shape, round(scale, 3), fine))
        return np.ones_like(some.light)

    found = patches.mended(clean, rays, differing((45, 80)), denoise)
    side = 4 + 2 * patches.AROUND_PX
    assert asked == [((side, side, 3), 0.36, True)], "a plate of 0.5 is darkened to 0.18"
    row = found[182, :, 0]
    assert (
        (row[320:324] == 1).all() and (row[300:312] < 1).all() and (row[: 320 - int(patches.NONE_PX) - 1] == 0.5).all()
    )
    assert np.abs(np.diff(row)).max() < 0.03, "no seam"
    assert (clean == 0.5).all(), "the plate stands for other pictures"
    asked.clear()
    assert patches.mended(clean, rays, np.ones((90, 160), bool), denoise).min() == 1
    assert asked[0][0] == clean.shape and not asked[0][2], "a whole picture is not worth the care"


def test_what_is_little_is_traced_with_more_samples_but_never_with_more_than_its_plate():
    whole = Shutter.of(6, 1)
    for share, samples in ((0.6, 6), (0.11, 6), (0.05, 12), (0.03, 18), (0.0, 18)):
        assert whole.finer(share, 18).samples == samples, share
    assert Shutter.of(54, 2).finer(0.01, 54) == Shutter.of(54, 2)
