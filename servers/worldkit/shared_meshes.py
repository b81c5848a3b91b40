"""Meshes of models that are brought in several times, kept once: twenty-four robots of one file are as heavy to compile as one.

What a later model brings and an earlier one has brought already, from the same file, as large, turned and hulled alike, is let go,
and its geoms show the earlier one. Nothing of the physics is changed by it: a mesh belongs to no body.
"""

import hashlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco

NUMBERS = (
    "scale", "refpos", "refquat", "uservert", "userface", "usernormal", "usertexcoord", "userfacenormal",
    "userfacetexcoord",
)  # fmt: skip
WORDS = ("file", "content_type", "inertia", "smoothnormal", "needsdf", "maxhullvert", "octree_maxdepth")


def share(spec: "mujoco.MjSpec", prefix: str) -> None:
    """Have the geoms of what is called `prefix` and more show meshes that the world had before, where it has the same."""
    own = [mesh for mesh in spec.meshes if mesh.name.startswith(prefix)]
    known = {told(mesh): mesh.name for mesh in spec.meshes if not mesh.name.startswith(prefix)} if own else {}
    instead = {mesh.name: known[made] for mesh in own if (made := told(mesh)) in known}
    for geom in spec.geoms if instead else ():
        geom.meshname = instead.get(geom.meshname, geom.meshname)
    for mesh in own:
        if mesh.name in instead:
            spec.delete(mesh)


def told(mesh: "mujoco.MjsMesh") -> tuple[Any, ...]:
    """All that a mesh is made of, but its name and what it looks like."""
    import numpy as np

    arrays = b"/".join(np.ascontiguousarray(getattr(mesh, name), dtype=float).tobytes() for name in NUMBERS)
    return (
        *(str(getattr(mesh, name)) for name in WORDS),
        mesh.plugin.active,
        mesh.material,
        hashlib.sha256(arrays).digest(),
    )
