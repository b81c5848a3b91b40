"""What our house around Mitsuba costs: a frame of the final film against a bare loop with the same scene, samples and denoiser.

Run ``python tests/bench/final_render.py``; goals (1280x720, 3 samples a pixel, a moving ball): at most 1.15 times the bare
loop, and less than 6 GB of memory. The bare loop renders, renders its guides, denoises, and does nothing else with the picture.
"""

import os
import resource
import sys
import time

from figures import Figure, report

os.environ.setdefault("MUJOCO_GL", "egl")

import mujoco
import numpy as np

from worldengine.film import renderers
from worldengine.film.renderers.preview.eye import of_camera
from worldkit import bodies, cameras, scene

WIDTH, HEIGHT, SAMPLES, FRAMES = 1280, 720, 3, 6


def world(setting):
    spec = scene.new(setting, time_step=0.002, setting=setting)
    for number in range(20):
        place = (0.35 * (number % 5) - 0.7, 0.35 * (number // 5) - 0.5, 0.1)
        if number % 2:
            bodies.box(spec, f"thing{number}", size=(0.18, 0.14, 0.2), pos=place, look="wood_oak")
        else:
            bodies.sphere(spec, f"thing{number}", diameter=0.2, pos=place, look="phenolic_red")
    cameras.add(spec, "eye", subjects=("thing0", "thing19"))
    model = spec.compile()
    cameras.aim(model)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def bare(drawing, model, data):
    """A frame by Mitsuba and OIDN alone, of the scene that the renderer has built."""
    import mitsuba as mi
    import pyoidn

    view = of_camera(model, data, 0, WIDTH, HEIGHT)
    (built,) = drawing._scenes.values()
    sensors = [drawing._sensor(view, channels) for channels in ("rgb", "rgba")]
    path = mi.load_dict({"type": "path", "max_depth": 4, "rr_depth": 16})
    guide = mi.load_dict({"type": "aov", "aovs": "a:albedo,n:sh_normal,p:position", "any": {"type": "depth"}})

    def frame():
        drawing.figures.place(data)  # whoever animates has to move what moves
        light = np.array(mi.render(built, sensor=sensors[0], integrator=path, spp=SAMPLES, seed=0))
        said = np.array(mi.render(built, sensor=sensors[1], integrator=guide, spp=4, seed=0))
        albedo, normal = np.ascontiguousarray(said[..., 4:7]), np.ascontiguousarray(said[..., 7:10])
        pyoidn.denoise(light, albedo, normal, hdr=True, quality="fast")

    return frame


def main() -> int:
    figures = []
    for setting in ("room", "outdoor"):
        model, data = world(setting)
        drawing = renderers.SEAM.find(renderers.FINAL).take(model, WIDTH, HEIGHT)
        drawing.image(data, 0, SAMPLES)
        loops = {"ours": lambda: drawing.image(data, 0, SAMPLES), "bare": bare(drawing, model, data)}  # noqa: B023
        times = {name: [] for name in loops}
        for number in range(FRAMES + 1):  # the first one warms up; taking turns spreads what else the machine does
            data.qpos[0] += 0.01
            mujoco.mj_forward(model, data)
            for name, loop in loops.items():
                start = time.perf_counter()
                loop()
                if number:
                    times[name].append(time.perf_counter() - start)
        ours, plain = min(times["ours"]), min(times["bare"])
        print(f"{setting}: {ours:.2f} s a frame, bare {plain:.2f} s")
        figures.append(Figure(f"final frame over a bare loop, {setting}", ours / plain, 1.15))
        drawing.close()
    figures.append(
        Figure("memory of the final renderer", resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 2**20, 6, "GB")
    )
    return report(*figures)


if __name__ == "__main__":
    sys.exit(main())
