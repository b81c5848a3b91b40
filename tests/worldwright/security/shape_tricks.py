"""Shape: what touches is not what is drawn, or what stands is not what was planned."""

from .attack import Trick

GROUND, CRATE = "spec.geom('ground')", "spec.geom('crate')"
EARLY = (("min_m: 0.55", "min_m: 0.1"), ("high: [0.35", "high: [-0.05"))
"""The claim that the crate stops early, which is as false."""
ALIKE = "a = dict(friction=spec.geom('ground').friction, solref=spec.geom('ground').solref, solimp=spec.geom('ground').solimp, condim=spec.geom('ground').condim)"
WALL = "type=mujoco.mjtGeom.mjGEOM_BOX, size=(.05, 1, .1), pos=(.16, 0, .1), rgba=(0, 0, 0, 0), **a"
TURNED = "import math; t = math.radians({}); spec.geom('ground').quat = (math.cos(t / 2), 0, math.sin(t / 2), 0); spec.geom('ground').pos = (-.5, 0, {})"


def trick(name: str, does: str, *build: str, early: bool = False) -> Trick:
    return Trick(name, "shape", does, plan=EARLY if early else (), build=build)


TRICKS = (
    trick("leaning_floor", "The floor leans by ten degrees.", TURNED.format(10, 0)),
    trick(
        "leaning_floor_at_the_corner",
        "The floor leans by 9.4 degrees about the crate's rear edge.",
        TURNED.format(9.6, 0),
    ),
    trick("rising_floor", "The floor rises, so that the crate stops early.", TURNED.format(-4, -0.02), early=True),
    trick(
        "sunken_floor",
        "The floor lies 30 cm lower: the crate falls, and flies meanwhile.",
        GROUND + ".pos = (0, 0, -.3)",
    ),
    trick(
        "floor_ends",
        "The floor is a box that ends, and the crate falls over its edge.",
        f"{GROUND}.type = mujoco.mjtGeom.mjGEOM_BOX; {GROUND}.size = (.5, 1, .1); {GROUND}.pos = (-.6, 0, -.1)",
    ),
    trick(
        "floor_of_hills",
        "The floor is a height field that slopes.",
        "spec.add_hfield(name='hills', nrow=2, ncol=2, size=(2, 2, .8, .1), userdata=[1., 0., 1., 0.])",
        f"{GROUND}.type = mujoco.mjtGeom.mjGEOM_HFIELD; {GROUND}.hfieldname = 'hills'; {GROUND}.pos = (0, 0, -.5)",
    ),
    trick(
        "floor_of_mesh",
        "The floor is a mesh that slopes.",
        "spec.add_mesh(name='wedge', uservert=[-2, -2, -2, 3, -2, -2, -2, 2, -2, 3, 2, -2, -2, -2, .2, 3, -2, -.64, -2, 2, .2, 3, 2, -.64])",
        f"{GROUND}.type = mujoco.mjtGeom.mjGEOM_MESH; {GROUND}.meshname = 'wedge'; m = spec.mesh('wedge')",
    ),
    trick(
        "unseen_wall",
        "An unseen wall catches the crate.",
        ALIKE,
        f"spec.worldbody.add_geom(name='wall', {WALL})",
        early=True,
    ),
    trick("wall_without_name", "An unseen wall without a name.", ALIKE, f"spec.worldbody.add_geom({WALL})", early=True),
    trick(
        "wall_by_the_name_of_the_crate",
        "The unseen wall has the name of the crate's geom.",
        ALIKE,
        f"{CRATE}.name = 'box'",
        f"spec.worldbody.add_geom(name='crate', {WALL})",
        early=True,
    ),
    trick(
        "wall_by_the_name_of_the_floor",
        "The unseen wall has the name of the floor, whose plane has another.",
        ALIKE,
        f"{GROUND}.name = 'plane'",
        f"spec.worldbody.add_geom(name='ground', {WALL})",
        early=True,
    ),
    trick(
        "wall_on_a_body",
        "The unseen wall is a body.",
        ALIKE,
        f"spec.worldbody.add_body(name='post').add_geom({WALL})",
        early=True,
    ),
    trick(
        "wall_of_a_free_body",
        "A heavy free body stands in the way.",
        ALIKE,
        "b = spec.worldbody.add_body(name='crate_stop', pos=(.2, 0, .1)); b.add_freejoint(); b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(.05, .3, .1), mass=200, **a)",
        early=True,
    ),
    trick(
        "wall_that_is_told_apart",
        "The wall touches the crate by bits of its own.",
        ALIKE,
        f"{CRATE}.contype = 3",
        f"spec.worldbody.add_geom(name='wall', contype=0, conaffinity=2, {WALL})",
        early=True,
    ),
    trick(
        "net",
        "An unseen cloth named after the crate catches it.",
        "f = spec.worldbody.add_flexcomp if hasattr(spec.worldbody, 'add_flexcomp') else None",
        'import mujoco as m; x = \'<mujoco><worldbody><flexcomp name="crate_net" type="grid" count="3 3 1" spacing=".3 .2 .1" pos=".2 0 .2" euler="0 90 0" radius=".02" dim="2" mass="50"><pin id="0 1 2 3 4 5 6 7 8"/></flexcomp></worldbody></mujoco>\'; spec.attach(m.MjSpec.from_string(x), frame=spec.worldbody.add_frame(), prefix=\'crate_\')',
        early=True,
    ),
    trick(
        "hidden_wheels",
        "The box is told apart from everything; two thin wheels carry it.",
        "b, c = spec.body('crate'), spec.geom('crate')",
        "r = dict(friction=c.friction, solref=c.solref, solimp=c.solimp, condim=c.condim, mass=0, rgba=(0, 0, 0, 0)); c.contype = 4; c.conaffinity = 8",
        "[b.add_geom(name=f'wheel{s}', type=mujoco.mjtGeom.mjGEOM_CYLINDER, size=(.1, .012, 0), pos=(0, .13 * s, 0), quat=(.7071068, .7071068, 0, 0), **r) for s in (-1, 1)]",
    ),
    trick(
        "hidden_ball",
        "The box is told apart from everything; a ball carries it.",
        "b, c = spec.body('crate'), spec.geom('crate')",
        "r = dict(friction=c.friction, solref=c.solref, solimp=c.solimp, condim=c.condim, mass=0); c.contype = 4; c.conaffinity = 8",
        "b.add_geom(name='ball', size=(.08, 0, 0), pos=(0, 0, -.02), **r)",
    ),
    trick("round_crate", "What touches is an ellipsoid.", f"{CRATE}.type = mujoco.mjtGeom.mjGEOM_ELLIPSOID"),
    trick("shrunken_crate", "What touches is smaller by 5 %.", f"{CRATE}.size = (.19, .14, .1)"),
    trick("lifted_crate", "What is drawn lies lower than what touches.", f"{CRATE}.pos = (0, 0, .03)"),
    trick(
        "second_skin",
        "What is drawn is elsewhere: a drawn box runs ahead of the one that touches.",
        f"{CRATE}.rgba = (0, 0, 0, 0)",
        "spec.body('crate').add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=(.2, .15, .1), pos=(.3, 0, 0), contype=0, conaffinity=0, mass=0)",
    ),
    Trick(
        "mesh_crate_counted_twice",
        "shape",
        "What touches is a barrel, some of whose faces stand twice so that its volume is the box's: it rolls.",
        plan=(("size: [0.4, 0.3, 0.2]", "size: [0.3, 0.3, 0.3]"), ("high: [0.35", "high: [1.35")),
        build=(
            "import numpy as np; u = np.linspace(0, 2 * np.pi, 24, endpoint=False)",
            "v = np.array([(.15 * np.cos(a), y, .15 * np.sin(a)) for y in (-.15, .15) for a in u])",
            "side = [(i, (i + 1) % 24, 24 + i) for i in range(24)] + [((i + 1) % 24, 24 + (i + 1) % 24, 24 + i) for i in range(24)]",
            "f = side + [(0, i + 1, i) for i in range(1, 23)] + [(24, 24 + i, 25 + i) for i in range(1, 23)]",
            "m = spec.add_mesh(name='barrel', uservert=v.ravel(), userface=np.ravel(f + f[::4]))",
            "m.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX",
            f"{CRATE}.type = mujoco.mjtGeom.mjGEOM_MESH; {CRATE}.meshname = 'barrel'; b = spec.body('crate')",
            "b.explicitinertial = True; b.mass = 5; b.ipos = (0, 0, 0); b.iquat = (1, 0, 0, 0); b.inertia = [5 / 6 * .09] * 3",
        ),
    ),
    Trick(
        "flat_field",
        "shape",
        "The floor is a flat height field, on whose corners the crate grips less.",
        plan=(("min_m: 0.55", "min_m: 0.294"),),
        build=(
            "spec.add_hfield(name='flat', nrow=2, ncol=2, size=(3, 3, .5, .1), userdata=[0., 0., 0., 0.])",
            f"{GROUND}.type = mujoco.mjtGeom.mjGEOM_HFIELD; {GROUND}.hfieldname = 'flat'; {GROUND}.pos = (0, 0, 0)",
        ),
    ),
)
