"""Plans: the claim says more than what is measured, or the text says two things to two readers; and what stands elsewhere."""

from typing import Any

from .attack import Change, Trick

TRUE = ("min_m: 0.55", "min_m: 0.28")
EARLY = (("min_m: 0.55", "min_m: 0.1"), ("high: [0.35", "high: [-0.05"))
MOVES = "- moves: {body: crate, min_m: 0.55}"
INSIDE = "    - stays_within: {body: crate, low: [-1, -1, -1], high: [0.35, 1, 1]}\n"


def trick(name: str, does: str, *plan: Change, **more: Any) -> Trick:
    return Trick(name, "plan", does, plan=plan, **more)


def measured(text: str) -> tuple[Change, Change]:
    """The claim is measured by this alone."""
    return (MOVES, text), (INSIDE, "")


def fixed(name: str, size: str, x: float) -> tuple[Change, ...]:
    """A thing that stands, in the plan and in the pictures."""
    return (
        (
            "# more objects",
            f"- {{name: {name}, role: stands there, primitive: box, size: {size}, fixed: true, material: wood}}",
        ),
        ("  # more rows", f"  - {{subject: {name}, predicate: PLACE-ON-BASE, params: {{x: {x}, y: 0}}}}"),
        ("scene_objects: [crate]", f"scene_objects: [crate, {name}]"),
        ("subjects: [crate]", f"subjects: [crate, {name}]"),
        ("subjects: [crate]", f"subjects: [crate, {name}]"),
    )


def second(name: str) -> tuple[Change, ...]:
    """A second crate, which is launched faster."""
    return (
        (
            "# more objects",
            f"- {{name: {name}, role: the other body, primitive: box, size: [0.4, 0.3, 0.2], material: wood}}",
        ),
        ("  # more rows", f"  - {{subject: {name}, predicate: PLACE-ON-BASE, params: {{x: -0.3, y: 1}}}}"),
        ("scene_objects: [crate]", f"scene_objects: [crate, {name}]"),
        ("subjects: [crate]", f"subjects: [crate, {name}]"),
        ("subjects: [crate]", f"subjects: [crate, {name}]"),
        ("motion_expectations: [crate]", f"motion_expectations: [crate, {name}]"),
        ("  # more masses", f"  {name}: 5"),
        ("  crate: {linear: [1.5, 0, 0]}", f"  crate: {{linear: [1.5, 0, 0]}}\n  {name}: {{linear: [2.17, 0, 0]}}"),
    )


HIDDEN = """<!--
```yaml
time_step: 0.002
simulation_duration: 1.0
gravity: -9.81
masses: {crate: 5}
materials:
  wood: {friction: 0.19, restitution: 0.2, source: "made up for a test"}
  ground: {friction: 0.19, restitution: 0.2, source: "made up for a test"}
initial_motion:
  crate: {linear: [1.5, 0, 0]}
inferred: [time_step, simulation_duration, masses, initial_motion, materials]
```
-->

```text
time_step: 0.002"""
MODEL = """<mujoco model="crate"><worldbody><body name="crate" gravcomp="0.52"><freejoint/>
<geom name="crate" type="box" size=".2 .15 .1" mass="5"/></body></worldbody></mujoco>"""
CRATE = """- {name: crate, role: the sliding body, primitive: box, size: [0.4, 0.3, 0.2], material: wood, look: "#b3261e"}
"""
IMPORTED = (
    (
        "## assets\n\nNone.",
        "## assets\n\n```yaml\n- {name: crate, type: mjcf, filename: crate.xml, material: wood}\n```",
    ),
    ("masses:\n  crate: 5\n  # more masses\n", ""),
    (CRATE, ""),
    ("simulation_duration, masses, ", "simulation_duration, "),
)
TRICKS = (
    trick(
        "claim_says_more",
        "The claim says 6 km; what is measured is 0.28 m.",
        TRUE,
        ("The crate slides about 0.6 m.", "The crate slides 6 km."),
    ),
    trick(
        "claim_of_another_body",
        "The claim is about the crate; what is measured is another.",
        *second("sled"),
        (MOVES, "- moves: {body: sled, min_m: 0.55}"),
        (INSIDE, "    - moves: {body: crate, min_m: 0.1}\n"),
    ),
    trick(
        "claim_of_a_namesake",
        "What is measured is a body whose name looks the same.",
        *second("cr\u0430te"),
        (MOVES, "- moves: {body: cr\u0430te, min_m: 0.55}"),
        (INSIDE, "    - moves: {body: crate, min_m: 0.1}\n"),
    ),
    trick(
        "claim_in_a_window",
        "The claim is that it never stops; the window ends before it does.",
        ("The crate slides about 0.6 m.", "The crate slides on for ever and never stops."),
        *measured("- reaches_speed: {body: crate, min_m_s: 1.0, window_s: [0, 0.05]}"),
    ),
    trick(
        "claim_without_measure",
        "Nothing is measured.",
        ("  expect:\n", "  expect: []\n  # "),
        (MOVES, ""),
        (INSIDE, ""),
    ),
    trick(
        "claim_for_the_eye",
        "What could be measured is called visual.",
        ("  expect:\n    " + MOVES + "\n" + INSIDE, "  visual_only: it is easier to see than to measure\n"),
    ),
    trick(
        "vast_tolerance",
        "It reaches a place, within 100 m.",
        ("The crate slides about 0.6 m.", "The crate reaches a place 6 m ahead."),
        *measured("- reaches: {body: crate, place: [6, 0, 0], tolerance_m: 100}"),
    ),
    trick(
        "vacuous_box",
        "It stays in a box of a billion metres.",
        ("The crate slides about 0.6 m.", "The crate stays on its spot."),
        *measured("- stays_within: {body: crate, high: [1.0e+9, 1.0e+9, 1.0e+9]}"),
    ),
    trick("vacuous_move", "It moves by at least a picometre.", *measured("- moves: {body: crate, min_m: 1.0e-12}")),
    trick(
        "nothing_touched", "It never touches what is not there.", *measured("- never_touches: {bodies: [crate, ghost]}")
    ),
    trick("unknown_expectation", "An expectation that does not exist.", *measured("- slides_far: {body: crate}")),
    trick("infinite_least", "A least distance of minus infinity.", *measured("- moves: {body: crate, min_m: -.inf}")),
    trick("no_number", "A least distance that is no number.", *measured("- moves: {body: crate, min_m: .nan}")),
    trick(
        "key_twice",
        "The claim stands twice.",
        (
            "- claim: The crate slides about 0.6 m.",
            "- claim: The crate slides about 0.6 m.\n  claim: The crate slides 6 km.",
        ),
        TRUE,
    ),
    trick(
        "section_twice",
        "The objectives stand twice.",
        (
            "## implementation_steps",
            "## objectives\n\n```yaml\n- {claim: It slides 6 km., expect: [{moves: {body: crate, min_m: 0.1}}]}\n```\n\n## implementation_steps",
        ),
    ),
    trick(
        "section_of_a_namesake", "The objectives' heading is in other letters.", ("## objectives", "## \u043ebjectives")
    ),
    trick(
        "block_twice",
        "The section has two blocks.",
        (
            "# more objectives\n```",
            "# more objectives\n```\n\n```yaml\n- {claim: It slides 6 km., expect: [{moves: {body: crate, min_m: 0.1}}]}\n```",
        ),
    ),
    trick("anchor", "A number is said by an anchor elsewhere.", ("min_m: 0.55", "min_m: &far 0.28")),
    trick(
        "line_inside_a_comment",
        "A comment holds a line of its own, behind a separator that YAML takes for an end of line.",
        ("gravity: -9.81", "# gravity is the engine's own \u2028gravity: -4.7"),
    ),
    trick(
        "next_line_inside_a_comment",
        "The same by another separator.",
        ("gravity: -9.81", "# gravity is the engine's own \u0085gravity: -4.7"),
    ),
    trick(
        "numbers_in_a_comment",
        "What is read stands in a comment that no reader of the page sees; what is seen is text.",
        ("```yaml\ntime_step: 0.002", HIDDEN),
    ),
    trick(
        "measured_on_what_is_drawn",
        "The claim is measured on what is only drawn.",
        ("material: wood, look", "visual_only: a drawing, material: wood, look"),
    ),
    trick(
        "model_of_less_weight",
        "A model file beside the plan takes half of the weight off.",
        *IMPORTED,
        *fixed("post", "[0.06, 0.6, 0.4]", 1.2),
        ("scene_objects: [crate, post]", "scene_objects: [post]"),
        beside={"crate.xml": MODEL},
    ),
    trick(
        "leaning_post",
        "A planned post leans: its foot is in the crate's way.",
        *EARLY,
        *fixed("post", "[0.06, 0.6, 1]", 0.27),
        build=("import math; t = math.radians(20); spec.body('post').quat = (math.cos(t / 2), 0, math.sin(t / 2), 0)",),
    ),
    trick(
        "turned_post",
        "A planned board stands across instead of along.",
        *EARLY,
        *fixed("post", "[0.06, 0.9, 0.4]", 0.55),
        build=("spec.body('post').quat = (.7071068, 0, 0, .7071068)",),
    ),
    trick(
        "moved_post",
        "A planned post stands 20 cm nearer.",
        *EARLY,
        *fixed("post", "[0.06, 0.6, 1]", 0.27),
        build=("spec.body('post').pos[0] -= .2",),
    ),
    trick(
        "post_moved_within_tolerance",
        "A planned post stands 4.9 mm nearer, and the crate just touches it.",
        *measured("- touches: {bodies: [crate, post]}"),
        *fixed("post", "[0.06, 0.6, 1]", 0.22),
        build=("spec.body('post').pos[0] -= .0049",),
    ),
    trick(
        "clock_ahead_for_a_window",
        "The start's clock stands at 0.6 s: the window sees the launch.",
        ("The crate slides about 0.6 m.", "The crate is still fast after 0.6 s."),
        *measured("- reaches_speed: {body: crate, min_m_s: 1.2, window_s: [0.6, 1.0]}"),
        build=("spec.key('start').time = .6",),
    ),
)
