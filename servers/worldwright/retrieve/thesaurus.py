"""What people say, in the manual's words: a symptom or an everyday word, and the terms its answer is written with.

Each row reads: when the question holds one of these (word stems; several words must all occur), look for those too.
"""

import re
from functools import cache

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
"""


@cache
def _rows() -> tuple[tuple[tuple[tuple[str, ...], ...], tuple[str, ...]], ...]:
    rows = []
    for line in _TABLE.strip().splitlines():
        said, meant = line.split(" : ")
        rows.append((tuple(tuple(phrase.split()) for phrase in said.split(",")), tuple(meant.split())))
    return tuple(rows)


def expand(question: str) -> list[str]:
    """The manual's words for what a question says, each once, none that the question has already.

    >>> expand("the ball bounces too little")
    ['restitution']
    """
    words = re.findall(r"[a-z_][a-z_\\-]*", question.lower())
    found: dict[str, None] = {}
    for phrases, meant in _rows():
        if any(all(any(word.startswith(part) for word in words) for part in phrase) for phrase in phrases):
            found.update(dict.fromkeys(term for term in meant if term.lower() not in words))
    return list(found)
