"""The root of every data class: immutable, and closed (an unknown key is an error that lists the known ones)."""

from pydantic import BaseModel, ConfigDict


class Frozen(BaseModel):
    """Immutable data whose unknown keys are refused."""

    model_config = ConfigDict(frozen=True, extra="forbid", populate_by_name=True)
