"""A film drawn roughly, to see it move at once: a quarter of its pixels, every second frame, or fewer where that takes too long.

It is drawn by the renderer and in the light of the film itself, so what it shows of place, shots and motion holds; nothing rests on it.
"""

import argparse
import math
import time
from typing import TYPE_CHECKING, Any

from worldkit.files import write_atomic

from .encode import Video
from .light_meter import reading
from .picture_grid import labelled, laid_out

if TYPE_CHECKING:
    import mujoco

    from ..given import Given
    from ..recording.stored import Recording
    from .described import Described

LEAST_STEP = 2
"""Of so many frames one is drawn."""
CELLS = 12
"""Pictures on the contact sheet, evenly through the film."""
MOVING, SHEET = "moving.mp4", "moving.jpg"


def draw(
    model: "mujoco.MjModel", recording: "Recording", film: "Described", given: "Given", options: argparse.Namespace
) -> dict[str, Any]:
    """Write `moving.mp4` and `moving.jpg` of a film into `options.out`, in about `options.within` seconds; returns what they show."""
    from .directed import Screening

    options.out.mkdir(parents=True, exist_ok=True)
    width, height = given.size
    size: tuple[int, int] = options.size or (max(16, width // 4 * 2), max(16, height // 4 * 2))
    with Screening(given.world, model, recording, film, size, given.fps) as screening:
        screening.alone = True
        screening.picture(0)  # the first one also sets the stage, which takes longer
        began = time.perf_counter()
        screening.picture(0)
        each = time.perf_counter() - began
        step = max(LEAST_STEP, math.ceil(film.frames * each / max(options.within, 1.0)))
        numbers = range(0, film.frames, step)
        shown = {numbers[round(part * (len(numbers) - 1) / (CELLS - 1))] for part in range(CELLS)}
        rows, cells, spent = [], [], 0.0
        with Video(options.out / MOVING, *size, max(1, round(given.fps / step))) as video:
            for number in numbers:
                dearer, began = screening.dearer(number, height), time.perf_counter()
                image = screening.picture(number)
                spent += (time.perf_counter() - began) * dearer
                video.add(image)
                if number in shown:
                    read = reading(screening.model, image, screening.layers(), given.movers)
                    at = {"film_s": number / given.fps, "recorded_s": float(film.arrays["time"][number])}
                    rows.append({**at, "shot": film.shot(number) + 1, "reading": read})
                    cells.append(labelled(image, f"shot {rows[-1]['shot']} {at['film_s']:.2f} s"))
        said = screening.frames.told()
    write_atomic(options.out / SHEET, laid_out(cells))
    return {
        "cameras": ["film"],
        "size": list(size),
        "renderer": said,
        "moments": rows,
        "frames": film.frames,
        "drawn": len(numbers),
        "step": step,
        "frame_s": round(spent / len(numbers) * (math.prod(given.size) / math.prod(size)) ** 0.5, 3),
        "film": film.told(given.fps),
    }
