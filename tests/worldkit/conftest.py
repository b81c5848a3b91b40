import os
import sys
from pathlib import Path

os.environ.setdefault("MUJOCO_GL", "egl")  # before mujoco is imported by any test
sys.path.insert(0, str(Path(__file__).parents[1]))  # for `small_worlds`

import mujoco

config = mujoco.MjLogConfig.get()
config.logto_file = False  # else the engine's warnings end up in the working directory
config.set()
