"""stage: run it. Physics, stills, video.

Each pass is a job: a detached supervisor runs the program in the strongest sandbox the machine offers, enforces the
limits, and on success moves the pass's files into the run's evidence in one step. A failed pass leaves earlier
evidence untouched. To ask again for what has already succeeded costs nothing.

Jobs outlive their server, and a kill at any moment loses at most the running pass. Besides worlds with a plan, any MJCF
file can be recorded (`bare_models`), and the physics pass can be repeated with a difference for an audit (`variants`).
"""
