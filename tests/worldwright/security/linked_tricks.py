"""Joints, ropes and motors: what holds gives way, and what pushes pushes harder."""

from .attack import Trick

JOINT, FRICTION, ROPE, MOTOR = (
    "spec.joint('stopped')",
    "spec.joint('stiff')",
    "spec.tendon('rope')",
    "spec.actuator('push')",
)
SOFT = "(.0001, .0001, .001, .5, 2)"
SLIDE = "target='rails', trntype=mujoco.mjtTrn.mjTRN_JOINT"
PULL = "a = spec.worldbody.add_site(name='far', pos=(3, 4, 1)); b = spec.body('cart').add_site(name='near'); t = spec.add_tendon(name={name!r}, stiffness=[{k}, 0, 0], springlength=[.1, .1]); t.wrap_site('far'); t.wrap_site('near')"
FAR = "{moves: {body: cart, min_m: 0.7}}"
"""Of the cart, which by its motor of 2 N comes 0.5 m far."""


def trick(
    name: str,
    does: str,
    body: str,
    expect: str,
    *build: str,
    family: str = "links",
    control: str = "",
    more: tuple[tuple[str, str], ...] = (),
) -> Trick:
    """A lie about one of the things of the workshop."""
    claims = f"- {{claim: The {body} moves as it should not., expect: [{expect}]}}"
    if body != "cart":
        claims += "\n- {claim: The cart moves., expect: [{moves: {body: cart, min_m: 0.4}}]}"
    plan = (
        ("# claims", claims),
        *((("motion_expectations: [cart]", f"motion_expectations: [cart, {body}]"),) if body != "cart" else ()),
        *more,
    )
    return Trick(name, family, does, world="workshop", plan=plan, build=build, control=control)


def falls(body: str, metres: float) -> str:
    return f"{{falls: {{body: {body}, min_m: {metres}}}}}"


TRICKS = (
    trick(
        "stop_of_rubber",
        "The stop of the hinge has a solref of no stiffness.",
        "arm",
        falls("arm", 0.2),
        f"{JOINT}.solref_limit = (-1, -1)",
    ),
    trick(
        "stop_of_syrup",
        "The stop of the hinge yields slowly.",
        "arm",
        falls("arm", 0.2),
        f"{JOINT}.solref_limit = (.5, 1)",
    ),
    trick("stop_moved", "The stop of the hinge lies lower.", "arm", falls("arm", 0.2), f"{JOINT}.range = (-90, 46)"),
    trick(
        "stop_with_margin",
        "The stop works before or after its place.",
        "arm",
        falls("arm", 0.2),
        f"{JOINT}.margin = -.5",
    ),
    trick("stop_off", "There is no stop.", "arm", falls("arm", 0.25), f"{JOINT}.limited = False"),
    trick(
        "stop_that_throws",
        "The stop throws the arm back: its solref has no damping.",
        "arm",
        "{rises: {body: arm, min_m: 0.06}}",
        f"{JOINT}.solref_limit = (-40000, 0)",
    ),
    trick(
        "grip_of_syrup",
        "Dry friction yields by a solref of its own.",
        "gate",
        falls("gate", 0.2),
        f"{FRICTION}.solref_friction = (10, 1)",
    ),
    trick(
        "grip_of_rubber",
        "Dry friction in the direct format, of no damping.",
        "gate",
        falls("gate", 0.2),
        f"{FRICTION}.solref_friction = (-1, -1)",
    ),
    trick(
        "grip_without_impedance",
        "Dry friction of no impedance.",
        "gate",
        falls("gate", 0.06),
        f"{FRICTION}.solimp_friction = {SOFT}",
    ),
    trick("grip_smaller", "Less dry friction.", "gate", falls("gate", 0.2), f"{FRICTION}.frictionloss = 1"),
    trick(
        "grip_off",
        "Dry friction is switched off for the whole world.",
        "gate",
        falls("gate", 0.2),
        "setattr(spec.option, 'disableflags', 4)",
    ),
    trick(
        "rope_of_rubber",
        "The rope's limit has a solref of no stiffness.",
        "bob",
        falls("bob", 0.15),
        f"{ROPE}.solref_limit = (-1, -1)",
    ),
    trick(
        "rope_of_syrup",
        "The rope yields slowly.",
        "bob",
        falls("bob", 0.02),
        f"{ROPE}.solref_limit = (.0299, 1)",
        f"{ROPE}.solimp_limit = (.01, .01, .001, .5, 2)",
    ),
    trick(
        "rope_without_impedance",
        "The rope's limit has no impedance.",
        "bob",
        falls("bob", 0.002),
        f"{ROPE}.solimp_limit = {SOFT}",
    ),
    trick("rope_longer", "The rope is longer.", "bob", falls("bob", 0.15), f"{ROPE}.range = (0, .7)"),
    trick(
        "rope_longer_within_tolerance",
        "The rope is longer by what counts as equal.",
        "bob",
        falls("bob", 0.0004),
        f"{ROPE}.range = (0, .50049)",
    ),
    trick(
        "rope_fastened_elsewhere",
        "The rope is fastened 4.9 mm lower.",
        "bob",
        falls("bob", 0.004),
        "spec.site('rope_0').pos = (0, 3, 1.4951)",
    ),
    trick(
        "rope_with_margin",
        "The rope holds before it is taut, or after.",
        "bob",
        falls("bob", 0.15),
        f"{ROPE}.margin = -.3",
    ),
    trick("rope_off", "The rope has no limit.", "bob", falls("bob", 0.3), f"{ROPE}.limited = False"),
    trick(
        "rope_over_a_hook",
        "The rope runs over a point that the plan does not have.",
        "bob",
        "{rises: {body: bob, min_m: 0.1}}",
        f"{ROPE}.range = (0, .4)",
    ),
    trick("strong_gear", "The motor has a gear of two.", "cart", FAR, f"{MOTOR}.gear[0] = 2"),
    trick(
        "motor_with_bias",
        "The motor pushes by a bias of its own.",
        "cart",
        FAR,
        f"{MOTOR}.biastype = mujoco.mjtBias.mjBIAS_AFFINE; {MOTOR}.biasprm[0] = 2",
    ),
    trick("motor_with_gain", "The motor has a gain of two.", "cart", FAR, f"{MOTOR}.gainprm[0] = 2"),
    trick(
        "motor_with_negative_damping",
        "The motor takes negative damping to its joint.",
        "cart",
        FAR,
        f"{MOTOR}.damping[0] = -2",
    ),
    trick(
        "motor_with_dynamics",
        "The motor integrates what it is told.",
        "cart",
        FAR,
        f"{MOTOR}.dyntype = mujoco.mjtDyn.mjDYN_INTEGRATOR; {MOTOR}.gainprm[0] = 20",
    ),
    trick("motor_with_armature", "The motor has a negative armature.", "cart", FAR, f"{MOTOR}.armature = -.9"),
    trick(
        "second_motor",
        "A second motor with a bias pushes too.",
        "cart",
        FAR,
        f"m = spec.add_actuator(name='help', {SLIDE}); m.biastype = mujoco.mjtBias.mjBIAS_AFFINE; m.biasprm[0] = 2",
    ),
    trick("hidden_spring", "A spring pulls the cart.", "cart", FAR, PULL.format(name="spring", k=1)),
    trick(
        "spring_by_the_name_of_the_motor",
        "The spring that pulls the cart has the name of the motor, which the plan declares.",
        "cart",
        FAR,
        PULL.format(name="push", k=1),
    ),
    trick(
        "tie_by_the_name_of_the_motor",
        "A soft tie that pulls the cart has the name of the motor.",
        "cart",
        FAR,
        "e = spec.add_equality(name='push', type=mujoco.mjtEq.mjEQ_JOINT, objtype=mujoco.mjtObj.mjOBJ_JOINT, name1='rails'); e.data[0] = 1.; e.solref = (1., 1.)",
    ),
    trick(
        "body_by_the_name_of_the_motor",
        "A heavy unseen body that falls onto a ramp has the name of the motor.",
        "cart",
        FAR,
        "g = spec.geom('ground'); a = dict(friction=g.friction, solref=g.solref, solimp=g.solimp, condim=g.condim); b = spec.worldbody.add_body(name='push', pos=(-.25, 4, 1), gravcomp=1); b.add_joint(name='push', type=mujoco.mjtJoint.mjJNT_SLIDE, axis=(1, 0, 0)); b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(.1, .1, .05), mass=20, rgba=(0, 0, 0, 0), **a)",
    ),
    trick(
        "mocap_by_the_name_of_the_motor",
        "A mocap body in the cart's way has the name of the motor.",
        "cart",
        "{stays_within: {body: cart, high: [0.3, 9, 9]}}",
        "g = spec.geom('ground'); a = dict(friction=g.friction, solref=g.solref, solimp=g.solimp, condim=g.condim); b = spec.worldbody.add_body(name='push', pos=(.45, 4, 1), mocap=True); b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(.1, .1, .05), rgba=(0, 0, 0, 0), **a)",
        more=(("expect: [{stays_within", "expect: [{moves: {body: cart, min_m: 0.1}}, {stays_within"),),
    ),
    trick(
        "wall_by_the_name_of_the_motor",
        "A fixed unseen body in the cart's way has the name of the motor.",
        "cart",
        "{stays_within: {body: cart, high: [0.3, 9, 9]}}",
        "g = spec.geom('ground'); a = dict(friction=g.friction, solref=g.solref, solimp=g.solimp, condim=g.condim); b = spec.worldbody.add_body(name='push', pos=(.45, 4, 1)); b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(.1, .1, .05), rgba=(0, 0, 0, 0), **a)",
        more=(("expect: [{stays_within", "expect: [{moves: {body: cart, min_m: 0.1}}, {stays_within"),),
    ),
    trick(
        "slide_with_negative_friction",
        "The slide has negative damping.",
        "cart",
        FAR,
        "spec.joint('rails').damping[0] = -2",
    ),
    trick(
        "leaning_slide",
        "The slide leans by nine tenths of a degree.",
        "cart",
        FAR,
        "import math; spec.joint('rails').axis = (math.cos(math.radians(.9)), 0, -math.sin(math.radians(.9)))",
    ),
    trick("light_cart", "The cart weighs half.", "cart", FAR, "spec.geom('cart').mass = 1"),
    trick(
        "light_cart_within_tolerance",
        "The cart weighs 2 % less.",
        "cart",
        "{moves: {body: cart, min_m: 0.505}}",
        "spec.geom('cart').mass = 1.962",
    ),
    trick(
        "sensor_with_delay",
        "Sensors with delays, which change nothing.",
        "cart",
        FAR,
        "spec.add_sensor(name='late', type=mujoco.mjtSensor.mjSENS_JOINTPOS, objtype=mujoco.mjtObj.mjOBJ_JOINT, objname='rails', delay=.1, nsample=60)",
    ),
)
