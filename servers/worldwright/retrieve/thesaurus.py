"""Everyday words for what the manual calls otherwise: a symptom or a common word, and the terms of its answer.

Each row reads: when the question contains one of these (word stems; several words must all occur), look for those too.
"""

import re
from functools import cache

SHARED = 2.0
"""Weight that the words of a row share, each at most as much as a word of the question: a long row says each less surely."""
_TABLE = """
    bounc, rebound                        : restitution
    blow up, blows up, explod, diverg, unstable, nan, instabil : divergence unstable NaN warning bad
    sink into, penetrat, too soft, overlap : penetration soft solimp solref impedance
    tunnel, fall through, falls through, pass through, passes through, passing through, go through : tunneling speculative margin
    through itself, self collision, self-collision, collide with itself : selfcollide
    slip, slid, creep, drift, drops       : slippage noslip impratio
    jagged, aliasing, pixelated, staircase : antialiasing multisampling offsamples
    blocky shadow, shadow resolution, blurry shadow : shadowsize
    screen, display, server, no monitor, headless : headless EGL OSMesa MUJOCO_GL
    cut off, framebuffer, frame buffer, image size, resolution : offwidth offheight offscreen
    buoyan, float in, floats, water, archimedes : fluid density medium gravcomp
    drag, air resistance, feather, parachute : fluid viscosity density drag
    curve in flight, curves in flight, curveball, spin in the air : Magnus lift fluid
    wind, blow                            : wind
    repeat, many copies, array of, copies of : replicate
    hinge spring, spring and, spring damper, spring and damper : stiffness damping springref
    initial velocity, initial speed, start velocity, launch : keyframe qvel
    initial state, initial pose, starting pose : keyframe qpos
    move together, coupled, gears, gear ratio, mimic : equality joint polycoef
    break, snap, fracture, detach          : active eq_active equality weld
    glue, rigidly, fixed together          : weld equality
    rope, cable, cord, string, chain       : tendon flexcomp cable rod
    cloth, fabric, soft body, jelly, rubber, deformable : flex flexcomp elasticity
    stiff, floppy                          : young stiffness thickness
    dent, plastic, permanent, stays bent, yield : yield plastic springyield
    magnet, suction, sticky, stick to      : adhesion
    conveyor, treadmill, moving surface    : surfacevel
    gpu, cuda, jax                         : MJX Warp
    parallel, threads, batch, many simulations : rollout batch multithreading
    one file, single file, package, bundle, archive : MJZ archive zip
    save, export, write the xml            : mj_saveXML to_xml
    copy the state, restore, checkpoint, reset : mj_getState mj_setState state
    friction combined, combine, mixed, two geoms : solmix priority maximum
    rolling, spinning friction             : condim torsional rolling
    invisible, not drawn, hidden           : group visibility geomgroup
    visual only, only visual, without colliding, no collision, ignore collision : contype conaffinity exclude
    holes, concave, hollow mesh            : convex hull decomposition
    depth image, segmentation, mask        : depth segmentation renderer
    fov, field of view, zoom               : fovy
    follow, track                          : tracking trackcom targetbody
    sky, background                        : skybox
    metal, shiny, glossy, pbr              : metallic roughness reflectance
    terrain, landscape                     : hfield
    pid, servo                             : kp kv dampratio pid
    oscillat, overshoot, vibrat            : dampratio damping kv
    motor, voltage, back emf               : dcmotor
    pneumatic, hydraulic                   : cylinder
    measure force, contact force, force on : touch contact sensor mj_contactForce
    beyond limit, beyond its limit, exceeds, overshoots its limit : limit margin solreflimit
    asleep, at rest, resting               : sleep
    slow, speed up, faster                 : performance sleep
    deterministic, reproduc, differ between, another machine : reproducibility
    name clash, repeated name, duplicate name : prefix unique name
    ignored, lost, dropped after           : merged attach conflict
    memory, arena, overflow, too many contacts : arena memory nconmax njmax
    heavy, mass is, weigh                  : density mass inertiafromgeom
    play, slack, loose                     : backlash
    delay, latency, lag                    : delay interval
    energy                                 : potential kinetic energy
    composite                              : composite flexcomp
    mujoco-py, mujoco_py, dm_control       : migration
    units, kilogram, metre, meters         : units
    moon, zero gravity, weightless         : gravity
    pulley                                 : pulley divisor
    crank, slider                          : cranklength slidersite
    viewer, interactive window             : viewer passive
    closed loop, loop closure, closed chain, linkage, bar mechanism, parallel robot : equality connect loop
    identical, grid of, row of, duplicate, many of : replicate
    without repeating, same attribute, same color, inherit, shared setting : default class childclass
    delete, remove a, removing       : delete
    tube, bowl, cup, ring, cavity, solid inside : convex hull decomposition
    stl, obj file, millimet, inch, too big, too small : mesh scale
    hang, nailed, fixed corner, hold corner : pin
    suction, vacuum, activate, deactivat, switch on, turn on, at runtime : active eq_active
    cancel contact, cancel collision, disable collision, disable contact, avoid collision, ignore contact, no contact between : exclude contype conaffinity
    terrain, height of the ground, altitude, lidar, proximity, distance to : mj_ray rangefinder
    gravity compensation, hold position, keep still, static torque, static : gravcomp qfrc_bias inverse
    copy limit, same limit, joint limit, ctrl limit : inheritrange ctrlrange
    combine, merge, several file, separate xml, base model, assemble : attach attachment include
    core, cores, cpu : thread multithreading
    supported, not implemented, unsupported : feature parity supported
    vertex count, vertices : maxhullvert
    always zero, always 0, stale, not updated, old value, outdated : mj_forward mj_rnePostConstraint
    soft contact, cushion, foam, soft object, hard contact : solref solimp impedance
    imu                              : accelerometer gyro
    orientation, euler, rotation matrix : quaternion
    end effector, inverse kinematic, ik : mj_jac jacobian
    lineariz, mpc, ilqr, lqr         : mjd_transitionFD derivatives
    record video, video, mp4         : renderer
    key press, keyboard              : key_callback
    push, apply a force, external force, cartesian force : xfrc_applied qfrc_applied mj_applyFT
    dry friction, stiction, joint friction : frictionloss
    gearbox, rotor, reflected        : armature gear
    watertight, volume is too small, thin sheet : shell inertia volume
    urdf                             : urdf compiler
    transparen, see through          : rgba alpha
    docker, colab, cluster, remote   : MUJOCO_GL EGL OSMesa
    profil, which part, bottleneck   : timer profiler
    step per second, steps per second, fps, throughput : performance batch
    constant speed, keep speed       : velocity
    trigger, event, region, enters   : contact sensor distance
    vectoriz, parallel env, environments : batch worlds
    exception, try except, crash, abort : error
    penetration depth, resting depth : solref solimp penetration
    mirror, reflect, reflection            : reflectance
    fog, haze, mist                        : fog haze
    sun, lamp, too dark, too bright        : light headlight ambient
    show contact, draw contact, visualize contact, arrows : contactpoint contactforce visualization
    show name, label, caption              : label overlay
    not converge, iterations, convergence  : iterations tolerance solver
    degree, radian                         : angle compiler
    mass matrix, inertia matrix            : mj_fullM qM
    coriolis, centrifugal                  : qfrc_bias
    randomiz, randomis, change mass, change friction, modify model : mjModel runtime mj_setConst
    teleport, move object, drag object     : mocap qpos
    saturat, clip sensor                   : cutoff
    torque sensor, measure torque, joint torque, motor torque : jointactuatorfrc actuatorfrc qfrc_actuator
    touching, foot contact, hits the, touches : contact sensor touch
    drone, quadrotor, propeller, thrust, rocket : site gear refsite
    intrinsic, focal, calibrat             : focal principal sensorsize
    fisheye, orthographic, perspective     : orthographic projection
    pickle, multiprocess, serializ         : pickling serialization
    cmake, from source, build mujoco, compile mujoco : building source CMake
    browser, javascript, web               : WASM
    usd, blender, omniverse                : USD
    fixed base, floating base, fixed to world, fixed to the world : freejoint static world
    no gravity, ignore gravity, hover, turn off gravity : gravcomp disableflags
    center of mass, centre of mass, com    : subtree_com inertial ipos
    line of sight, visible from, occlu     : mj_ray rangefinder
    frame skip, frameskip, control frequency, control rate : timestep mj_step control
    name to id, id from name, look up, index of : mj_name2id named access
    lock joint, lock a joint, freeze, disable actuator, turn off motor : equality joint actuatorgroupdisable
    rest length, rest position, natural length : springlength springref
    user data, extra data, own data, metadata : custom user numeric userdata
    wheel, car, vehicle, rover             : rolling condim friction
    ctrl ignored, no effect, does nothing, not moving : gear ctrllimited ctrlrange
    flicker, z-fighting, z fighting        : znear zfar
    swim, fish, boat, underwater, ship     : fluid fluidshape density viscosity
    wings, airplane, glider, kite          : lift drag fluidshape ellipsoid
    inertia tensor, moment of inertia      : fullinertia diaginertia inertial
    principal ax                           : inertial iquat balanceinertia
    subtract, difference between orientations, quaternion error : mju_subQuat mj_differentiatePos
"""


@cache
def _rows() -> tuple[tuple[tuple[tuple[str, ...], ...], tuple[str, ...]], ...]:
    rows = []
    for line in _TABLE.strip().splitlines():
        said, meant = line.split(" : ")
        rows.append((tuple(tuple(phrase.split()) for phrase in said.split(",")), tuple(meant.split())))
    return tuple(rows)


def expand(question: str) -> dict[str, float]:
    """The manual's words for what a question says, none that the question has already, with their weights.

    >>> expand("the ball bounces too little")
    {'restitution': 1.0}
    """
    words = re.findall(r"[a-z_][a-z_\\-]*", question.lower())
    found: dict[str, float] = {}
    for phrases, meant in _rows():
        if any(all(any(word.startswith(part) for word in words) for part in phrase) for phrase in phrases):
            weight = min(1.0, SHARED / len(meant))
            found.update({term: max(weight, found.get(term, 0.0)) for term in meant if term.lower() not in words})
    return found
