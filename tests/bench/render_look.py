"""What the good look costs: frames of our renderer against MuJoCo's own on the same scenes, in one run.

Run ``python tests/bench/render_look.py``; goals (1280x720, two threads): a video frame within about 130 ms, a still in
two seconds. Prints milliseconds of this machine and, what carries over to others, the ratios.
"""

import os
import statistics
import sys
import time

from figures import Figure, report

os.environ.setdefault("MUJOCO_GL", "egl")

import mujoco
import numpy as np

from worldengine.film.drawn_frames import Frames
from worldkit import cameras, materials, scene

G = mujoco.mjtGeom
WIDTH, HEIGHT, FRAMES = 1280, 720, 5


def balls(count):
    spec = scene.new(f"{count} balls", time_step=0.002, floor="wood_planks")
    looks = ["phenolic_red", "phenolic_blue", "phenolic_white", "rubber_orange", "chrome", "plastic_green"]
    generator = np.random.default_rng(1)
    for number in range(count):
        body = spec.worldbody.add_body(name=f"ball{number}", pos=(*generator.uniform(-1, 1, 2), 0.1))
        body.add_freejoint()
        body.add_geom(type=G.mjGEOM_SPHERE, size=(0.1, 0, 0), material=materials.add(spec, looks[number % len(looks)]))
    return spec


def boxes(count, setting):
    spec = scene.new(f"{count} boxes, {setting}", time_step=0.002, setting=setting)
    looks = ["wood_oak", "cardboard", "plastic_blue", "brick", "marble_white", "steel_brushed"]
    generator = np.random.default_rng(2)
    for number in range(count):
        half = generator.uniform(0.05, 0.15, 3)
        body = spec.worldbody.add_body(name=f"box{number}", pos=(*generator.uniform(-1, 1, 2), half[2]))
        body.add_freejoint()
        body.add_geom(type=G.mjGEOM_BOX, size=half, material=materials.add(spec, looks[number % len(looks)]))
    return spec


def best(draw):
    """Milliseconds of the quickest of several frames, after one to warm up."""
    draw()
    times = []
    for _ in range(FRAMES):
        start = time.perf_counter()
        draw()
        times.append(1e3 * (time.perf_counter() - start))
    return min(times)


def main() -> int:
    """Draw each scene and print what it costs."""
    videos, stills = [], []
    print(f"{'scene':<24}{'plain ms':>10}{'video ms':>10}{'ratio':>8}{'still ms':>10}{'first s':>9}")
    scenes = [balls(6), balls(40), boxes(20, "room"), boxes(20, "outdoor"), boxes(200, "studio"), boxes(20, "dark")]
    for spec in scenes:
        cameras.add(spec, "eye")
        model = spec.compile()
        cameras.aim(model)
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        with mujoco.Renderer(model, HEIGHT, WIDTH) as renderer:

            def plain(renderer=renderer, data=data):
                renderer.update_scene(data, "eye")
                return renderer.render()

            ordinary = best(plain)
        start = time.perf_counter()
        with Frames(model, WIDTH, HEIGHT) as frames:
            frames.image(data, "eye")
            first = time.perf_counter() - start
            if frames.renderer != "preview":
                sys.exit(f"our renderer does not run here: {frames.reason}")
            video = best(lambda f=frames, d=data: f.image(d, "eye"))
            still = best(lambda f=frames, d=data: f.image(d, "eye", quality="still"))
        print(f"{spec.modelname:<24}{ordinary:10.0f}{video:10.0f}{video / ordinary:8.2f}{still:10.0f}{first:9.1f}")
        videos.append(video)
        stills.append(still)
    return report(
        Figure("a frame of a film, 1280x720, median scene", statistics.median(videos), 130, "ms"),
        Figure("a still, 1280x720, median scene", statistics.median(stills), 2000, "ms"),
    )


if __name__ == "__main__":
    sys.exit(main())
