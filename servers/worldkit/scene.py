"""An empty world, ready for bodies: solver, ground, light and surroundings."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, Literal

from . import materials
from .settings import SETTINGS, Setting

if TYPE_CHECKING:
    from collections.abc import Mapping

    import mujoco

SettingName = Literal["studio", "room", "outdoor", "dark"]
GROUND = "ground"
INTEGRATORS = {
    "euler": "mjINT_EULER", "rk4": "mjINT_RK4", "implicit": "mjINT_IMPLICIT", "implicitfast": "mjINT_IMPLICITFAST",
    "discrete": "mjINT_DISCRETE",
}  # fmt: skip

# Skies of MuJoCo's own viewers: colour overhead and at the horizon.
_VIEWER_SKY = {
    "studio": ((0.52, 0.52, 0.53), (0.90, 0.87, 0.83)),
    "room": ((0.93, 0.92, 0.90), (0.84, 0.81, 0.76)),
    "outdoor": ((0.27, 0.50, 0.84), (0.85, 0.91, 0.96)),
    "dark": ((0.02, 0.03, 0.06), (0.10, 0.11, 0.15)),
}


def _pick(kind: str, name: str, known: Mapping[str, Any]) -> Any:
    if name not in known:
        raise ValueError(f"no {kind} is called {name!r}. Use one of: {', '.join(known)}.")
    return known[name]


def _lights(spec: mujoco.MjSpec, setting: Setting) -> None:
    """Lights for MuJoCo's own viewers; `worldengine.film.renderers` knows the setting's true ones."""
    import mujoco

    def add(name: str, light: Any, shadow: bool, gain: float) -> None:
        colour = [min(gain * c, 1.0) for c in light.colour]
        spec.worldbody.add_light(
            name=f"worldkit.{name}", type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
            pos=[6.0 * c for c in light.direction], dir=[-c for c in light.direction],
            diffuse=colour, specular=[0.4 * c for c in colour], ambient=(0, 0, 0), castshadow=shadow,
        )  # fmt: skip

    add("key", setting.key, True, 0.28)
    for number, fill in enumerate(setting.fills, 1):
        add(f"fill{number}", fill, False, 0.45)
    headlight = spec.visual.headlight
    headlight.ambient = (0.12, 0.12, 0.14) if setting.name == "dark" else (0.34, 0.34, 0.35)
    headlight.diffuse = (0.12, 0.12, 0.12)
    headlight.specular = (0.0, 0.0, 0.0)


def new(
    name: str,
    *,
    time_step: float,
    gravity: tuple[float, float, float] = (0.0, 0.0, -9.81),
    integrator: str = "implicitfast",
    setting: SettingName = "studio",
    floor: str | None = None,
    floor_surface: dict[str, Any] | None = None,
) -> mujoco.MjSpec:
    """A model with options, light and an endless level ground, the geom "ground" at z = 0, and nothing else.

    `time_step` in s, `gravity` in m/s^2. `setting` chooses light and surroundings: "studio" (a seamless backdrop under
    soft boxes), "room" (walls and a window), "outdoor" (sun, sky, hills) or "dark" (stars, cool key, warm rim).
    `floor` is a look for the ground instead of the setting's own; `floor_surface` its contact properties as
    `worldkit.contacts.surface` gives them. Contacts use elliptic friction cones; energy is computed.

    Raises ValueError for an unknown setting, integrator or look, and for a time step that is not positive.
    """
    import mujoco

    chosen: Setting = _pick("setting", setting, SETTINGS)
    method = _pick("integrator", integrator.lower(), INTEGRATORS)
    if not 0.0 < time_step < float("inf"):
        raise ValueError(f"the time step must be a positive number of seconds, got {time_step}")
    spec = mujoco.MjSpec()
    spec.modelname = name
    option = spec.option
    option.timestep = time_step
    option.gravity = gravity
    option.integrator = getattr(mujoco.mjtIntegrator, method)
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.solver = mujoco.mjtSolver.mjSOL_NEWTON
    option.iterations = 100
    option.ls_iterations = 50
    option.tolerance = 1e-10
    option.enableflags = int(option.enableflags) | int(mujoco.mjtEnableBit.mjENBL_ENERGY)

    view = spec.visual
    view.global_.offwidth, view.global_.offheight = 2560, 1440
    view.quality.shadowsize, view.quality.offsamples = 4096, 8
    view.map.znear, view.map.zfar = 0.005, 60.0
    overhead, horizon = _VIEWER_SKY[chosen.name]
    view.rgba.haze = (*horizon, 1.0)
    view.map.haze = 0.6
    spec.add_texture(
        name="worldkit.sky", type=mujoco.mjtTexture.mjTEXTURE_SKYBOX, builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=overhead, rgb2=horizon, width=128, height=768,
    )  # fmt: skip
    _lights(spec, chosen)
    surface = dict(floor_surface or {})
    surface.setdefault("material", materials.add(spec, floor or chosen.floor))
    spec.worldbody.add_geom(name=GROUND, type=mujoco.mjtGeom.mjGEOM_PLANE, size=(0, 0, 1), **surface)
    spec.add_text(name="worldkit.setting", data=json.dumps({"setting": chosen.name}))
    # Filled by cameras.aim: corners of the space that the subjects cross.
    spec.add_numeric(name="worldkit.space", size=6, data=[0.0] * 6)
    return spec
