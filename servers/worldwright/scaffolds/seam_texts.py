"""The texts of new entries of seams: complete by the protocol, with what is left to the author marked AUTHOR.

`{name}` is filled in. Until it is written, each fails the tests of its seam.
"""

RENDERER = '''"""AUTHOR: what draws, in one sentence, and what its pictures look like."""

from typing import TYPE_CHECKING

from . import Drawing, Quality

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..treatment import Treatment

# AUTHOR: the distributions whose versions decide its pictures.
PACKAGES = ("numpy",)


def take(model: "mujoco.MjModel", width: int, height: int) -> Drawing:
    """Take a model over; whatever it raises lets the plain renderer draw instead."""
    return Drawn(model, width, height)


class Drawn:
    """AUTHOR: the model on the side that draws. It draws nothing until it is written."""

    def __init__(self, model: "mujoco.MjModel", width: int, height: int) -> None:
        self._model, self._shape = model, (height, width)

    def image(self, data: "mujoco.MjData", camera: int, quality: Quality) -> "np.ndarray":
        """AUTHOR: the picture, uint8 (height, width, 3)."""
        import numpy as np

        return np.zeros((*self._shape, 3), np.uint8)

    def segmentation(self, data: "mujoco.MjData", camera: int) -> "np.ndarray":
        """AUTHOR: geom number of each pixel, or -1, int32 (height, width)."""
        import numpy as np

        return np.full(self._shape, -1, np.int32)

    def treat(self, treatment: "Treatment") -> bool:
        """AUTHOR: light, haze, focus and develop so from now on; False: it cannot, and draws as before."""
        return False

    def close(self) -> None:
        """AUTHOR: free what it holds."""
'''

SOLVER = '''"""AUTHOR: what it simulates beside the engine, in one sentence.

    F = AUTHOR: what it does to the bodies, in symbols

AUTHOR: what it leaves out. Source: AUTHOR: the law.
"""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from ..recording.columns import Column
from . import Case

if TYPE_CHECKING:
    import mujoco
    import numpy as np

CONSTANTS = {{"strength": ("N", "AUTHOR: what a plan's constant of this name means")}}
STRENGTH = Column("strength", (), "N", "AUTHOR: what is recorded of it")
# AUTHOR: a world whose outcome is known without this solver; this one fails until it is written.
CASES = (
    Case(
        '<mujoco><worldbody><body name="ball"><freejoint/><geom size="0.1"/></body></worldbody></mujoco>',
        bodies=("ball",),
        constants={{"strength": 1.0}},
        seconds=0.1,
        channel="strength",
        expected=1.0,
        tolerance=1e-6,
        because="AUTHOR: whose formula says so",
    ),
)


class Working:
    """AUTHOR: it at work on some bodies, with its own state."""

    def __init__(self, bodies: Sequence[int], constants: Mapping[str, float]) -> None:
        import numpy as np

        self._wrench = np.zeros((len(bodies), 6))
        self.channels = {{STRENGTH: np.zeros(())}}

    def look(self, data: "mujoco.MjData") -> "np.ndarray":
        """AUTHOR: bring the channels up to date, in place; the forces and torques on the bodies, (n, 6)."""
        return self._wrench

    def advance(self, step_s: float) -> None:
        """AUTHOR: bring its own state to the end of the step."""


def start(
    model: "mujoco.MjModel", data: "mujoco.MjData", bodies: Sequence[int], constants: Mapping[str, float]
) -> Working:
    """AUTHOR: set it up; refuse by a ProgramError what it cannot act on."""
    return Working(bodies, constants)


def show(model: "mujoco.MjModel", data: "mujoco.MjData", geom: int, channels: Mapping[str, Any]) -> None:
    """AUTHOR: pose the geom that shows it, in data.geom_xpos and data.geom_xmat; nothing where nothing is seen of it."""
'''

SOURCE = '''"""AUTHOR: whose assets these are, in one sentence, and what lies where below the catalog folder."""

from pathlib import Path

from ...data_folders import catalog_root
from ..entry import Asset
from ..reading import AssetError


def keys() -> tuple[str, ...]:
    """AUTHOR: every key that it delivers, sorted; cheap."""
    return ()


def find(key: str) -> Asset:
    """AUTHOR: one of its keys as an entry; an AssetError names file, key and remedy."""
    raise AssetError(f"{{catalog_root()}}: AUTHOR: {{key}} cannot be delivered yet")


def example(catalog: Path) -> str:
    """AUTHOR: lay out in an empty catalog what it needs for one asset. Its test fails until that is delivered."""
    return f"{{catalog.name}}-author"


def files(key: str) -> tuple[Path, ...]:
    """AUTHOR: every file that decides what the asset is, sorted."""
    return tuple(sorted(catalog_root().glob(f"{{key}}.*")))
'''

HARNESS = '''"""AUTHOR: the harness, in one sentence: how it starts agents, asks before a tool is used, and confines the shell.

AUTHOR: what it cannot keep from the runs and the suite, which the guard then must.
"""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..generated import GENERATED, instructions
from ..heard import Heard
from ..roles import Role
from ..tool_names import ToolNames

if TYPE_CHECKING:
    from ...doctor.diagnosis import Diagnosis

# AUTHOR: its command, its package on npm, and the version that was driven.
NAME, SHELL_SETS = "{name}", ()
PROGRAM, PACKAGE, TESTED = "{name}", "{name}", "0.0.0"
LINKS: tuple[str, ...] = ()
# AUTHOR: why its hooks need a person's word in a folder that it has never seen; empty where they do not.
TRUST = ""
# AUTHOR: whose tokens and money its events do not tell; empty where they tell of all.
UNCOUNTED = ""
# AUTHOR: whether its events tell US dollars, and whether what it took is known only when it has ended.
TELLS_MONEY, TELLS_AT_END = False, False
# AUTHOR: its names of tools in lower case; what stands nowhere is denied to every role.
TOOLS = ToolNames(
    writers=frozenset(),
    readers=frozenset(),
    shells=frozenset(),
    agents=(),
    harmless=frozenset(),
    confined_by_guard=True,
)


def files() -> dict[str, str]:
    """AUTHOR: its configuration: our servers, and the hook that asks the guard before every tool use."""
    return {{}}


def agent(role: Role) -> tuple[str, str]:
    """AUTHOR: the path and the text of one role's file, with its tools and no others."""
    return f".{name}/agents/{{role.agent}}.md", f"<!-- {{GENERATED}} -->\\n{{instructions(role)}}"


def diagnose(root: Path) -> Diagnosis | None:
    """AUTHOR: what the person must still do before it works in the project; None when it is not installed."""
    if shutil.which(PROGRAM) is None:
        return None
    from ...doctor.diagnosis import Diagnosis

    return Diagnosis(PROGRAM, False, "AUTHOR: is not looked at yet", "AUTHOR: what the person does", essential=False)


def unattended(files: dict[str, str], folder: Path) -> dict[str, str]:
    """AUTHOR: of its files those that are other where nobody is there to be asked."""
    return {{}}


def headless(prompt: str, model: str, folder: Path, most_usd: float | None) -> list[str]:
    """AUTHOR: the words that make a world of a prompt with nobody there, each event told as a line of JSON."""
    return ["run", "--json", f"/generate --auto {{prompt}}"]


def heard(event: dict[str, Any]) -> Heard:
    """AUTHOR: tokens, money and what was said, of one event."""
    return Heard()
'''

SEAM_TEXTS = {"renderer": RENDERER, "solver": SOLVER, "source": SOURCE, "harness": HARNESS}
