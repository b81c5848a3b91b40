"""The drawn world with its recorded motion as USD's own text, which needs no library to write."""

import re
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy as np

HEAD = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
    startTimeCode = 0
    endTimeCode = {end:.6g}
    timeCodesPerSecond = 1
)

def Xform "World"
{{
"""


def named(name: str, number: int) -> str:
    """A name that USD takes, none like another."""
    return f"_{number}_" + re.sub(r"\W", "_", name, flags=re.ASCII)


def _rows(values: "np.ndarray") -> str:
    return ", ".join("(" + ", ".join(f"{v:.6g}" for v in row) + ")" for row in values)


def written(
    names: "Sequence[str]", parts: "Sequence[Any]", times: "np.ndarray", places: "np.ndarray", turns: "np.ndarray"
) -> str:
    """The whole file: an `Xform` for each body with its poses at each time, s, and below it meshes with their materials.

    Args:
        names: of the bodies.
        parts: the shapes, as `carried_scene.Part`.
        times: (T,), s.
        places: (T, B, 3), m.
        turns: (T, B, 4), w first.
    """
    import numpy as np

    out = [HEAD.format(end=float(times[-1]))]
    bodies: dict[int, list[tuple[int, Any]]] = {}
    for number, part in enumerate(parts):
        bodies.setdefault(part.body, []).append((number, part))
        r, g, b, a = part.rgba
        out.append(
            f'    def Material "look{number}"\n    {{\n'
            f"        token outputs:surface.connect = </World/look{number}/surface.outputs:surface>\n"
            f'        def Shader "surface"\n        {{\n            uniform token info:id = "UsdPreviewSurface"\n'
            f"            color3f inputs:diffuseColor = ({r:.4g}, {g:.4g}, {b:.4g})\n"
            f"            float inputs:roughness = {part.roughness:.4g}\n"
            f"            float inputs:metallic = {part.metallic:.4g}\n            float inputs:opacity = {a:.4g}\n"
            f"            token outputs:surface\n        }}\n    }}\n"
        )
    for body, mine in sorted(bodies.items()):
        moves = np.ptp(places[:, body], axis=0).max() + np.ptp(turns[:, body], axis=0).max() > 1e-6
        rows = range(len(times)) if moves else range(1)
        out.append(f'    def Xform "{named(names[body], body)}"\n    {{\n')
        for what, kind, values in (("translate", "double3", places[:, body]), ("orient", "quatf", turns[:, body])):
            samples = "".join(f"            {times[k]:.6g}: {_rows(values[k : k + 1])},\n" for k in rows)
            out.append(f"        {kind} xformOp:{what}.timeSamples = {{\n{samples}        }}\n")
        out.append('        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:orient"]\n')
        for number, part in mine:
            out.append(
                f'        def Mesh "part{number}" (prepend apiSchemas = ["MaterialBindingAPI"])\n        {{\n'
                f"            rel material:binding = </World/look{number}>\n"
                f'            uniform token subdivisionScheme = "none"\n'
                f"            point3f[] points = [{_rows(part.points)}]\n"
                f'            normal3f[] normals = [{_rows(part.normals)}] (interpolation = "vertex")\n'
                f"            int[] faceVertexCounts = [{', '.join(['3'] * len(part.faces))}]\n"
                f"            int[] faceVertexIndices = [{', '.join(map(str, part.faces.ravel().tolist()))}]\n        }}\n"
            )
        out.append("    }\n")
    out.append("}\n")
    return "".join(out)
