"""The forms that the roles are shown are those that the tools take."""

import re

import pytest

from worldwright.contract import roles
from worldwright.model.evidence.reports import VisualDescription
from worldwright.model.evidence.verdict import RepairTarget, Verdict


@pytest.mark.parametrize(("role", "model"), [(roles.VISUAL, VisualDescription), (roles.REVIEW, Verdict)])
def test_a_form_in_a_role_is_taken(role, model):
    (form,) = re.findall(r"`(\{.*?\})`", role.instructions, re.DOTALL)
    made = model.model_validate_json(form.replace(", …]", "]"))
    assert made.model_fields_set >= {"summary"} or made.objectives


def test_the_review_role_knows_every_target():
    for target in RepairTarget.__args__:
        assert target in roles.REVIEW.instructions
