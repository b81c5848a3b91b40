"""Assets against their goals: ten thousand of them searched, warm; a mesh of 50,000 faces taken in, beside CoACD alone on it.

Processor time, so that other work on the machine counts for neither side.
"""

import os
import sys
import tempfile
from collections.abc import Callable
from functools import partial
from pathlib import Path

from figures import Figure, report

COUNT, FACES = 10_000, 50_000
SEARCH_S, TIMES_COACD = 0.050, 1.3
THINGS = [
    "chair",
    "table",
    "lamp",
    "shelf",
    "bowl",
    "mug",
    "crate",
    "barrel",
    "basket",
    "sofa",
    "bench",
    "stool",
    "vase",
    "clock",
    "mirror",
    "rug",
    "door",
    "kettle",
    "pan",
    "spoon",
]
LIKE = [
    "oak",
    "garden",
    "kitchen",
    "old",
    "small",
    "round",
    "folding",
    "painted",
    "iron",
    "glass",
    "woven",
    "blue",
    "travel",
    "office",
    "school",
]
QUESTIONS = (
    "a garden chair",
    "something to sit on",
    "round iron table",
    "old clocks",
    "tall vase of glass",
    "kitchne shelf",
)


def spent(action: Callable[[], object]) -> float:
    """Processor seconds of an action, with those of the processes that it starts and waits for."""
    began = sum(os.times()[:4])
    action()
    return sum(os.times()[:4]) - began


def searching(folder: Path) -> Figure:
    """The median question, once the assets are read and embedded."""
    from worldkit.assets.sources import recipes
    from worldwright.retrieve.assets import find

    for number in range(COUNT):
        own = folder / f"{LIKE[number % 15]}_{THINGS[number // 15 % 20]}_{number}"
        own.mkdir(parents=True)
        (own / "cube.obj").write_text(recipes.CUBE, encoding="utf-8")
        (own / "asset.yaml").write_text(recipes.SAID, encoding="utf-8")
    find("anything", 5)
    taken = sorted(spent(partial(find, question, 5)) for question in QUESTIONS for _ in range(5))
    return Figure(f"{COUNT:,} assets searched, warm", taken[len(taken) // 2], SEARCH_S, "s")


def taking_in(folder: Path) -> Figure:
    """A wavy bowl taken in whole, relative to CoACD on its faces."""
    import coacd
    import numpy as np
    import trimesh

    from worldkit.intake import taken_in
    from worldkit.intake.cutting import CLOSED, CONCAVITY, CORNERS, MOST_HULLS, SEED

    along = np.linspace(0, 1, FACES // 1000)
    outer = np.column_stack([0.05 + 0.03 * along + 0.001 * np.sin(40 * along), 0.06 * along])
    inner = np.column_stack([0.042 + 0.03 * along[::-1], 0.01 + 0.05 * along[::-1]])
    mesh = trimesh.creation.revolve(np.concatenate([[(0, 0)], outer, inner, [(0, 0.01)]]), sections=250)
    mesh.export(folder / "wavy.ply")
    material = {"name": "ceramic", "density": 2400.0, "friction": 0.4, "restitution": 0.3, "source": "a bench"}
    asked = dict.fromkeys(("key", "category", "description", "licence", "creator", "source"), "x")
    whole = spent(lambda: taken_in.take_in(folder / "wavy.ply", {**asked, "material": material, "units": "m"}))
    coacd.set_log_level("error")
    alone = spent(
        lambda: coacd.run_coacd(
            coacd.Mesh(mesh.vertices, mesh.faces), threshold=CONCAVITY, max_convex_hull=MOST_HULLS, max_ch_vertex=CORNERS,
            seed=SEED, **CLOSED,
        )
    )  # fmt: skip
    print(f"{len(mesh.faces):,} faces: taken in in {whole:.2f} s, CoACD alone {alone:.2f} s")
    return Figure("a 50,000-face mesh taken in, to CoACD alone", whole / alone, TIMES_COACD)


def main() -> int:
    """Measure, print ratios, and fail when a goal is missed."""
    with tempfile.TemporaryDirectory() as scratch:
        os.environ["WORLDWRIGHT_ASSETS"] = str(Path(scratch) / "own")
        os.environ["WORLDWRIGHT_CACHE"] = str(Path(scratch) / "cache")
        return report(taking_in(Path(scratch)), searching(Path(scratch) / "own"))


if __name__ == "__main__":
    sys.exit(main())
