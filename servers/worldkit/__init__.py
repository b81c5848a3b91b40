"""The runtime that generated programs import.

A program builds an ``MjSpec`` with ``worldkit.scene``, ``materials``, ``contacts``, ``assets``, ``motion`` and
``cameras``, optionally controls it, and hands both to ``worldkit.program``, which owns the clock, the recording
and the passes. Nothing here imports ``worldwright``; nothing is imported before it is used.
"""

import os

if os.environ.get("WORLDKIT_LOCK"):
    from .lock import verify

    verify()
