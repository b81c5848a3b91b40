"""How far a flex gives under contact is reckoned as deep as the engine lets things sink."""

import re

import mujoco
import pytest

from worldwright.lint.compiled import measure
from worldwright.lint.compiled.fetch import Outcome
from worldwright.lint.compiled.view import ModelView
from worldwright.lint.rules.model import flex_too_soft_to_touch as rule

TRAMPOLINE = """<mujoco><option integrator="discrete" timestep="0.002"/><worldbody>
  <flexcomp name="cloth" type="grid" dim="2" count="{n} {n} 1" spacing="{d} {d} 1" pos="0 0 1" mass=".2" radius=".004">
    <contact solref="{ref} 1" selfcollide="none"/>
    <elasticity young="2e5" poisson=".3" thickness="4e-4" damping=".1" elastic2d="both"/>
    <pin id="{pins}"/></flexcomp>
  <body name="ball" pos="0 0 1.104"><freejoint/><geom size=".1" mass="{mass}" solref="{ref} 1"/></body>
</worldbody></mujoco>"""


@pytest.mark.parametrize(
    ("points", "ref", "mass", "told"), [(13, 0.02, 0.5, True), (13, 0.004, 0.5, False), (13, 0.004, 6.0, True)]
)
def test_a_ball_sinks_into_a_cloth_as_far_as_is_said(points, ref, mass, told):
    last = points - 1
    pins = " ".join(str(i) for i in (*range(points), *range(points * last, points**2)))
    text = TRAMPOLINE.format(n=points, d=1 / last, ref=ref, mass=mass, pins=pins)
    model = mujoco.MjSpec.from_string(text).compile()
    arrays, texts = measure.facts(model)
    found = [p.message for p in rule.check(ModelView(Outcome("compiled", arrays=arrays, texts=texts)))]
    data = mujoco.MjData(model)
    for _ in range(1200):
        mujoco.mj_step(model, data)
    deepest = -float(data.contact.dist.min())
    assert bool(found) is told is (deepest > 0.004)
    if told:
        said = float(re.search(r"give by ([0-9.]+) mm", found[0])[1]) * 1e-3
        assert deepest / 1.6 < said < 1.6 * deepest
