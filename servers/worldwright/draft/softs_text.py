"""Write the objects that are soft: one call of `worldkit.softs` for each."""

from ..model.plan.committed import SceneObject
from .python_text import Raw, call, comment, constant_name, exact
from .stances import Stances


def written(objects: Stances, row: SceneObject) -> str:
    """The text of a soft object."""
    assert row.soft is not None
    objects.needs.use("softs")
    numbers = {key: exact(value) if isinstance(value, float) else value for key, value in row.soft.numbers().items()}
    stiff = {"modulus_pa": Raw(constant_name(row.soft.modulus)), **numbers}
    made = " ".join(call(f"softs.{row.soft.kind.capitalize()}", indent=0, **stiff).split())
    keywords: dict = {"size": row.size, **objects.common(row.name, objects.scene[row.name])}
    if row.primitive != "box":
        keywords["shape"] = row.primitive
    if row.look:
        keywords["look"] = row.look
    if row.material:
        keywords["surface"] = Raw(constant_name(row.material))
    note = row.description or row.role
    lines = [comment(note)] if note else []
    return "\n".join(
        [*lines, call("softs.add", Raw("spec"), row.name, Raw(made.replace("( ", "(").replace(", )", ")")), **keywords)]
    )
