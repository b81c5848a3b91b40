"""Shapes beyond the primitives: cone, torus, rounded box, wedge, hill from a profile, lathe, and tube along a path.

    bodies.formed(spec, "bowl", form=forms.lathe(profile=((0, 0), (0.08, 0.01), (0.12, 0.07)), wall=0.006), pos=(0, 0, 0.5))

A `Form` is a closed mesh with convex pieces that collide: a ring keeps its hole, a bowl and a pipe their inside. Mass,
centre of mass and inertia are those of the solid that is drawn. Metres; the frame of a form is the centre of the box around
it, z up. No simulator is imported.
"""

from .bulk import Form, Rod
from .extruded import hill, rounded_box, wedge
from .revolved import cone, lathe, torus
from .swept import tube

__all__ = ["Form", "Rod", "cone", "hill", "lathe", "rounded_box", "torus", "tube", "wedge"]
