"""Place cameras by their templates, once every body has its pose."""

from ..model.plan.layout import PlacedCamera
from .anchors import Box, CannotResolveError
from .resolution import Resolution, Shot, rounded
from .statements import Problems
from .vocabulary import CAMERA_FAMILY, ask


def shots(resolution: Resolution, problems: Problems) -> dict[str, Shot]:
    """Every camera that a relation template places, by name; a camera without a place is a finding."""
    found: dict[str, Shot] = {}
    for row in resolution.statements:
        if row.entry.FAMILY != CAMERA_FAMILY:
            continue
        frames = resolution.reference(row)
        if frames is None:  # its subject is not placed, and a finding says why
            continue
        if row.subject in found:
            problems.add(
                "WP206",
                "over_determined",
                f"two relations place the camera `{row.subject}`: {found[row.subject].placed.template} and {row.code}",
                "keep one of them, or add another camera",
                row.path,
            )
            continue
        camera = Box(row.subject, (0.0, 0.0, 0.0), round=True)
        formulas = []
        try:
            for dof in row.pins:
                derivation = ask(row.entry, "resolve", dof, camera, frames, row.params)
                setattr(camera, dof, derivation.value)
                formulas.append(derivation.formula)
            target = ask(row.entry, "target", frames, row.params)
        except CannotResolveError as error:
            problems.add("WP208", "no_solution", f"{row}: {error}", error.fix, row.path)
            continue
        found[row.subject] = Shot(
            camera,
            frames,
            PlacedCamera(
                name=row.subject,
                template=row.code,
                position=(rounded(camera.get("x")), rounded(camera.get("y")), rounded(camera.get("z"))),
                target=(rounded(target[0]), rounded(target[1]), rounded(target[2])),
                fovy_deg=row.params["fovy_deg"],
                provenance=tuple(formulas),
            ),
        )
    return found
