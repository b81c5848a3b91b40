import os

os.environ.setdefault("MUJOCO_GL", "egl")  # before mujoco is imported by any test

import mujoco

config = mujoco.MjLogConfig.get()
config.logto_file = False  # else the engine's warnings end up in the working directory
config.set()
