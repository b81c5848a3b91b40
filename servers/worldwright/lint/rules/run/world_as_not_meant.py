"""The compiled world cannot be what its numbers say.

What it does: looks at the compiled world of a plain program: a contact time constant of seconds, a margin equal to
its gap, deep overlaps at the first step, things that fall through a floor their masks let them pass, a keyframe that
nobody uses, noise of a sensor that nobody adds.

Why is this bad: a contact that does not push, a gap that stays open, a burst at the start.

Use instead: negative `solref` for (stiffness, damping); `gap` alone for detection; half sizes; masks that meet;
`mj_resetDataKeyframe`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR127"
SEVERITY = "warning"
HEAD = """\
import mujoco
def made(solref):
    return mujoco.MjModel.from_xml_string(f'<mujoco><worldbody><geom type="plane" size="5 5 .1" solref="{solref}" priority="1"/>'
        '<body pos="0 0 .1"><freejoint/><geom size=".1"/></body></worldbody></mujoco>')
"""
GOOD = (
    HEAD
    + """\
model = made('-4000 -60')
data = mujoco.MjData(model)
mujoco.mj_step(model, data, 300)
answer = data.qpos[2]
""",
    HEAD
    + """\
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><body><joint name="j"/><geom size=".1"/></body></worldbody>'
    '<sensor><jointpos joint="j" noise=".1"/></sensor></mujoco>')
data = mujoco.MjData(model)
mujoco.mj_step(model, data)
reading = float(data.sensordata[0]) + 2 * model.sensor_noise[0]
""",
)
BAD = (
    HEAD
    + """\
model = made('4000 60')
data = mujoco.MjData(model)
mujoco.mj_step(model, data, 300)
answer = data.qpos[2]
""",
    HEAD
    + """\
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><body><joint name="j"/><geom size=".1"/></body></worldbody>'
    '<sensor><jointpos joint="j" noise=".1"/></sensor></mujoco>')
data = mujoco.MjData(model)
mujoco.mj_step(model, data)
reading = float(data.sensordata[0])
""",
)
EVIDENCE = Measured("the ball sinks in", answer, 0.05, "m")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "solref_sign",
        "a positive solref is (time constant, damping ratio): {time:g} s is no contact",
        "for (stiffness, damping) write both negative",
    )
    yield from run.say(
        "margin_equals_gap",
        "margin equals gap: since 3.9 the contact pushes at the margin, {margin:g} m away",
        "use gap alone to detect without force",
    )
    yield from run.say(
        "overlap_at_start",
        "bodies start {share:.0%} of their half size deep in each other",
        "geom sizes are half sizes: check size and pos",
    )
    yield from run.say(
        "fell_through",
        "a body fell through the floor: contype and conaffinity of the two never meet",
        "give them a common bit: (a.contype & b.conaffinity) | (b.contype & a.conaffinity)",
    )
    yield from run.say(
        "keyframe_unused",
        "the model has a keyframe, and nothing ever starts from it",
        "use mj_resetDataKeyframe(model, data, model.key(name).id)",
    )
    yield from run.say(
        "noise_not_added",
        "the noise of a sensor is only told by the model: the engine adds none to sensordata",
        "add rng.normal(0, model.sensor_noise[sensor]) to the reading",
    )
