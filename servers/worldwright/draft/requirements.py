"""Collect what the parts of a draft need from their file, and what they leave to its author."""

from dataclasses import dataclass, field


@dataclass
class Needs:
    """The needs of a draft, collected while its parts are written."""

    modules: set[str] = field(default_factory=set)
    """Modules of worldkit that the program imports."""
    open_places: list[str] = field(default_factory=list)
    """Places that must be written by hand."""

    texts: dict[str, str | tuple[str, ...]] = field(default_factory=dict)
    """Constants that hold the text of a model, by name."""
    joint_kinds: dict[str, str] = field(default_factory=dict)
    """The kinds of the plan's joints, and of those inside its models, by name."""

    def use(self, *modules: str) -> None:
        """Import these modules of worldkit."""
        self.modules.update(modules)

    def leave(self, why: str, what: str) -> None:
        """Note a place for the author."""
        self.open_places.append(f"{why}: {what}")
