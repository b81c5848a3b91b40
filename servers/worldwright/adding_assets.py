"""`worldwright asset add FILE`, `asset keep RUN NAME` and their tools: a mesh of the user's, or what a run of theirs sculpted, becomes
an asset that plans can name.

They are tools of `retrieve`, which finds assets, and stand here, since taking one in needs the sandbox, which is `stage`'s.
"""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import Field

from .expose import Positional
from .model.picture import Illustrated
from .model.progress import Progress, silent


def add_asset(
    file: Annotated[
        Path,
        Field(
            description="GLB, glTF, OBJ, STL, PLY, OFF, DAE, 3MF, USD; a folder or .zip with one; or the key of a library's offer."
        ),
    ],
    key: Annotated[
        str | None, Field(description="What plans call it, e.g. garden_chair; without it the file's name.")
    ] = None,
    height: Annotated[float | None, Field(description="How high it stands in the real world, m.", gt=0)] = None,
    units: Annotated[Literal["m", "cm", "mm", "in", "ft"] | None, Field(description="The file's unit.")] = None,
    category: Annotated[
        str | None, Field(description="What it is (chair, bowl, car …): gives the height where nothing else does.")
    ] = None,
    description: Annotated[str | None, Field(description="One sentence by which it is found.")] = None,
    material: Annotated[
        str | None, Field(description="What it is of (wood, ceramic, steel …): density, friction, restitution.")
    ] = None,
    mass: Annotated[
        float | None, Field(description="kg, where it is known; else the material's density decides.", gt=0)
    ] = None,
    up: Annotated[
        str | None, Field(description="The file's axis that is up, e.g. +z; without it that of its format.")
    ] = None,
    front: Annotated[str | None, Field(description="The file's axis that is the front, e.g. -y.")] = None,
    licence: Annotated[str | None, Field(description="Its licence, e.g. CC-BY-4.0.")] = None,
    creator: Annotated[str | None, Field(description="Who made it, as the licence wants it named.")] = None,
    source: Annotated[str | None, Field(description="Where it is from.")] = None,
    to: Annotated[
        Literal["own", "catalog"], Field(description="Your own folder, seen from every project, or this catalog.")
    ] = "own",
    replace: Annotated[bool, Field(description="Take the place of an asset of the same key there.")] = False,
    progress: Progress = silent,
) -> Illustrated:
    """Make an asset of a mesh file: mended, scaled, with hulls that keep cavities, mass and friction, stood on a floor.

    The file is read confined and bounded; what was mended and assumed is told. What cannot be taken in is not registered; what
    does not stand still is, and it is said. Afterwards `find_asset` finds it, and a plan names its key.
    """
    from .intake.taking_in import add

    asked = {
        "key": key, "height": height, "units": units, "category": category, "description": description, "material": material,
        "mass": mass, "up": up, "front": front, "licence": licence, "creator": creator, "source": source,
    }  # fmt: skip
    return add(
        file,
        {name: value for name, value in asked.items() if value is not None},
        to,
        replace=replace,
        progress=progress,
    )


def keep_sculpt(
    run: Annotated[str, Field(description="The run, by name or folder."), Positional()],
    name: Annotated[str, Field(description="Its row of `assets` of type sculpt."), Positional()],
    key: Annotated[str | None, Field(description="What plans call it; without it the row's name.")] = None,
    category: Annotated[str | None, Field(description="What it is, e.g. science, furniture.")] = None,
    description: Annotated[str | None, Field(description="One sentence by which it is found.")] = None,
    licence: Annotated[str | None, Field(description="Its licence, e.g. CC-BY-4.0.")] = None,
    creator: Annotated[str | None, Field(description="Who made it, as the licence wants it named.")] = None,
    to: Annotated[
        Literal["own", "catalog"], Field(description="Your own folder, seen from every project, or this catalog.")
    ] = "own",
    replace: Annotated[bool, Field(description="Take the place of an asset of the same key there.")] = False,
    progress: Progress = silent,
) -> Illustrated:
    """Keep what a run sculpted as an asset: source, meshes, hulls, mass, materials, the joints between its parts.

    Afterwards `find_asset` finds it, and another plan names its key; with its parts moving, `KEY/moving.xml` as a row of type mjcf.
    """
    from .intake.keeping import keep

    asked = {"key": key, "category": category, "description": description, "licence": licence, "creator": creator}
    told = {word: value for word, value in asked.items() if value is not None}
    return keep(run, name, told, to, replace=replace, progress=progress)


TOOLS = (add_asset, keep_sculpt)
