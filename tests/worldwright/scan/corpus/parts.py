"""MJCF text for the corpus: the few shapes and arenas its worlds are put together from."""

GROUND = '<geom name="ground" type="plane" size="0 0 1"/>'


def mjcf(body: str, *, option: str = "", more: str = "", ground: bool = True, default: str = "") -> str:
    """A whole model; `option` are attributes, `more` stands after the world body."""
    defaults = f"<default>{default}</default>" if default else ""
    return (
        f'<mujoco><option timestep="0.002" integrator="implicitfast" {option}/>{defaults}'
        f"<worldbody>{GROUND if ground else ''}{body}</worldbody>{more}</mujoco>"
    )


def ball(name: str = "ball", pos: str = "0 0 1", radius: float = 0.05, geom: str = "", mass: float = 0.5) -> str:
    """A loose sphere."""
    return (
        f'<body name="{name}" pos="{pos}"><freejoint/>'
        f'<geom name="{name}" type="sphere" size="{radius}" mass="{mass}" {geom}/></body>'
    )


def box(name: str = "box", pos: str = "0 0 0.1", half: str = "0.1 0.1 0.1", geom: str = "", mass: float = 1.0) -> str:
    """A loose box."""
    return (
        f'<body name="{name}" pos="{pos}"><freejoint/>'
        f'<geom name="{name}" type="box" size="{half}" mass="{mass}" {geom}/></body>'
    )


def pendulum(
    name: str = "bob", pivot: str = "0 0 2", length: float = 1.0, joint: str = "", at: str = "", geom: str = ""
) -> str:
    """A bob on a hinge about y; the body's origin is its pivot."""
    return (
        f'<body name="{name}" pos="{pivot}" {at}><joint name="{name}" type="hinge" axis="0 1 0" {joint}/>'
        f'<geom type="capsule" fromto="0 0 0 0 0 {-length + 0.06}" size="0.01" mass="0.02" contype="0" conaffinity="0"/>'
        f'<geom name="{name}" type="sphere" pos="0 0 {-length}" size="0.05" mass="1" {geom}/></body>'
    )


BOUNCY = 'solref="-40000 -8"'
"""Direct stiffness and damping: a light ball rebounds with about nine tenths of its speed."""
