"""Looks: what surfaces are made of, to the eye. `add(spec, "wood_oak")` gives the name of a material to use on a geom.

Looks never change the physics; friction, restitution and density live in `worldkit.contacts`.
"""

from __future__ import annotations

import difflib
import re
from functools import cache
from typing import TYPE_CHECKING

from . import clear_liquids
from .catalogue import LIBRARY
from .look import Look

if TYPE_CHECKING:
    import mujoco

__all__ = ["LOOKS", "Look", "add", "look"]

LOOKS: dict[str, str] = {name: entry.description for name, entry in LIBRARY.items()}
"""Every look by name, with a short description. Any ``#rrggbb`` is a look too (satin plastic of that colour), and any
``clear #rrggbb 10mm`` (`clear_liquids`)."""

TILE_PIXELS = 256
"""Size of the flat textures stored in the model for MuJoCo's own viewers; `worldengine.film.renderers` paints finer ones."""
CUBE_PIXELS = 96


@cache
def look(name: str) -> Look:
    """The look called `name`.

    Raises ValueError, naming the nearest looks and all the others, when there is none.
    """
    if name in LIBRARY:
        return LIBRARY[name]
    if re.fullmatch(r"#[0-9a-fA-F]{6}", name):
        red, green, blue = (int(name[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
        return Look(f"Satin plastic, {name}", rgba=(red, green, blue, 1.0), roughness=0.36, coat=0.08, mark=True)
    if (clear := clear_liquids.of(name)) is not None:
        return clear
    words = [
        known for known in LIBRARY if any(word in known for word in re.split(r"[_\W]+", name.lower()) if len(word) > 2)
    ]
    near = list(dict.fromkeys(difflib.get_close_matches(name, LIBRARY, n=4, cutoff=0.55) + words))[:6]
    hint = f"Nearest: {', '.join(near)}. " if near else ""
    raise ValueError(
        f"no look is called {name!r}. {hint}Use one of: {', '.join(sorted(LIBRARY))}; or a colour such as '#3a7bd5', "
        "or something clear that has a colour at a depth, such as 'clear #b5651d 10mm'."
    )


def add(spec: mujoco.MjSpec, look_name: str) -> str:
    """Add the texture and material of a look to `spec`, once, and return the material's name (the look's own name).

    Raises ValueError when the look is unknown.
    """
    entry = look(look_name)
    if any(material.name == look_name for material in spec.materials):
        return look_name
    import mujoco

    metal = 1.0 if entry.metallic > 0.5 else 0.0
    material = spec.add_material(
        name=look_name,
        rgba=entry.rgba,
        metallic=entry.metallic,
        roughness=entry.roughness,
        emission=min(entry.emission, 1.0),
        specular=min(1.0, 0.25 + 0.6 * metal + 0.4 * entry.coat),
        shininess=(1.0 - entry.roughness) ** 2,
        reflectance=0.0,
    )
    if entry.paint is not None:
        from . import paint

        if entry.around:
            faces = paint.cube(entry, CUBE_PIXELS)[..., :3]
            texture = spec.add_texture(
                name=look_name,
                type=mujoco.mjtTexture.mjTEXTURE_CUBE,
                width=CUBE_PIXELS,
                height=6 * CUBE_PIXELS,
                nchannel=3,
            )
            texture.data = faces.tobytes()
        else:
            pixels = paint.tile(entry, TILE_PIXELS)[..., :3]
            texture = spec.add_texture(
                name=look_name, type=mujoco.mjtTexture.mjTEXTURE_2D, width=TILE_PIXELS, height=TILE_PIXELS, nchannel=3
            )
            texture.data = pixels.tobytes()
            material.texuniform = True
            material.texrepeat = (1.0 / entry.tile_m, 1.0 / entry.tile_m)
        roles = [""] * int(mujoco.mjtTextureRole.mjNTEXROLE)
        roles[int(mujoco.mjtTextureRole.mjTEXROLE_RGB)] = look_name
        material.textures = roles
    return look_name
