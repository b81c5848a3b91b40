"""What pushes or pulls, named in one of three ways: a tendon, a constraint, or two bodies in contact."""

import numpy as np
from pydantic import Field, model_validator

from ...model.recording.trajectory import Trajectory
from .channels import Channel, constraint_load, tension
from .measured import Arguments, Name, UnknowableError, contacts_of, one_of


class Load(Arguments):
    """One force over time."""

    tendon: Name | None = Field(None, description="the tension of a tendon; or")
    constraint: Name | None = Field(None, description="the force that a constraint carries; or")
    bodies: tuple[Name, Name] | None = Field(None, description="two bodies that push on each other")

    @model_validator(mode="after")
    def _one(self) -> "Load":
        one_of(self, "tendon", "constraint", "bodies")
        return self

    def channel(self, trajectory: Trajectory) -> Channel:
        """Its size over time, N; of a contact the sum of the normal forces."""
        if self.tendon:
            return tension(trajectory, self.tendon)
        if self.constraint:
            return constraint_load(trajectory, self.constraint)
        bodies = self.bodies or ("", "")
        contacts = trajectory.contacts
        if contacts is None:
            raise UnknowableError("no contact forces were recorded")
        force = np.zeros(len(trajectory.t))
        mine = contacts_of(trajectory, *bodies)
        np.add.at(force, contacts.row[mine], contacts.normal_force[mine])
        return Channel(force, "N", " on ".join(bodies))
