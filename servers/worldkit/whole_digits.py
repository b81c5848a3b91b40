"""Restoring what the engine's XML writer rounds: a model written as text and read again is the same model, bit for bit.

The writer gives the poses of things after the compiler has moved them. A mesh is centred and turned to its principal axes
while it is compiled, and every geom that shows it moves the other way; written back, that motion is undone in floating
point, and a pose of (0, 0, 0) comes out as 1e-17. For a site it writes as many sizes as the shape needs, and the rest comes
back as the default. Here both are written as the spec, or the compiled model, holds them.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco


def whole_digits(text: str, spec: "mujoco.MjSpec", model: "mujoco.MjModel") -> str:
    """The XML with those numbers put back; unchanged where its elements cannot be told apart for sure.

    Args:
        text: as `spec.to_xml()` wrote it.
        spec: the world.
        model: compiled from the spec.
    """
    import mujoco

    shown = any(geom.meshname for geom in spec.geoms)
    if not (shown or spec.sites):
        return text
    from xml.dom import minidom  # keeps text sections as they are, which other parsers of the library do not

    document: Any = minidom.parseString(text)
    worlds = document.getElementsByTagName("worldbody")
    for element, geom in _paired(worlds, "geom", spec.geoms):
        plain = geom.alt.type == mujoco.mjtOrientation.mjORIENTATION_QUAT and geom.frame is None
        # A shape fitted to a mesh stands in the mesh's frame in the spec, in the body's in the text.
        if geom.meshname and plain and geom.type in (mujoco.mjtGeom.mjGEOM_MESH, mujoco.mjtGeom.mjGEOM_SDF):
            _set(element, "pos", geom.pos)
            _set(element, "quat", geom.quat)
    for element, site in _paired(worlds, "site", spec.sites):
        _set(element, "size", model.site_size[site.id])
    return str(document.documentElement.toxml())


def _paired(worlds: Any, tag: str, things: Any) -> list[tuple[Any, Any]]:
    """(element, thing of the spec) of one kind; nothing unless there are as many of both, in the same order by name.

    Bodies, and what they carry, are numbered in the order in which the XML lists them.
    """
    elements = [element for world in worlds for element in world.getElementsByTagName(tag)]
    ordered = sorted(things, key=lambda thing: thing.id)
    if [element.getAttribute("name") for element in elements] != [thing.name for thing in ordered]:
        return []
    return list(zip(elements, ordered, strict=True))


def _set(element: Any, attribute: str, numbers: Any) -> None:
    element.setAttribute(attribute, " ".join(repr(float(number)) for number in numbers))
