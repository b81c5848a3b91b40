"""Which spec a compiled model came from, so that a program may return either.

What is simulated is compiled from a file (`portable`), and a compiled model cannot be written as one. While `build()` runs,
the ways to compile a model are watched, so that a model it returns can be traced to its spec. What it edited in the compiled
arrays afterwards is found when the file is compared with the model.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco


@contextmanager
def watched() -> "Iterator[list[tuple[mujoco.MjModel, mujoco.MjSpec]]]":
    """List, within the block, every model that is compiled, with its spec as it was then."""
    import mujoco

    found: list[tuple[mujoco.MjModel, mujoco.MjSpec]] = []
    compiles = mujoco.MjSpec.compile
    read = {name: getattr(mujoco.MjModel, name) for name in ("from_xml_string", "from_xml_path")}

    def compiled(spec: "mujoco.MjSpec") -> "mujoco.MjModel":
        model = compiles(spec)
        found.append((model, spec))
        return model

    def reader(make: Any) -> Any:
        def from_xml(source: str, assets: dict[str, bytes] | None = None) -> "mujoco.MjModel":
            return compiled(make(source, assets=assets) if assets else make(source))

        return staticmethod(from_xml)

    mujoco.MjSpec.compile = compiled
    mujoco.MjModel.from_xml_string = reader(mujoco.MjSpec.from_string)
    mujoco.MjModel.from_xml_path = reader(mujoco.MjSpec.from_file)
    try:
        yield found
    finally:
        mujoco.MjSpec.compile = compiles
        for name, original in read.items():
            setattr(mujoco.MjModel, name, original)
