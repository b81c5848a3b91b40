"""A coding harness as the judge: one process in an empty folder, with a clean environment, and nothing of the project.

Of the environment it gets a path, a home (where its login is) and the variables of its own that are named; it has no session
to go on with. It is ended, with all that it started, when it says nothing for too long.
"""

import contextlib
import os
import shutil
import signal
import subprocess
import tempfile
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from .judges import Answer, JudgeError, Question

KEPT = ("PATH", "HOME", "LANG", "TERM", "TMPDIR", "SSL_CERT_FILE", "HTTP_PROXY", "HTTPS_PROXY", "NO_PROXY")
MOST_SAID = 8 << 20
LED_BY = (".git", "AGENTS.md", "CLAUDE.md")
"""Harnesses read a project's instructions from the folders above them: where such a thing lies, the judge would be told."""
ENDINGS = {"image/jpeg": "jpg", "image/png": "png"}


def run(
    question: Question,
    words: Callable[[list[Path]], Sequence[str]],
    read: Callable[[str], Answer],
    *,
    stdin: bytes = b"",
    keeps: Sequence[str] = (),
    files: Mapping[str, str] | None = None,
) -> Answer:
    """Start a harness once and read what it prints.

    Args:
        question: its `address` is the harness's program.
        words: its arguments, of the pictures as files in its folder.
        read: what it printed, as an answer; a `ValueError`, `KeyError` or `TypeError` of it is `garbage`.
        stdin: what it reads.
        keeps: further variables of the environment that it gets.
        files: texts that lie in its folder, by name.

    Raises:
        JudgeError: it is not there, its folder would lie in a project, it ends with another status than 0, says nothing for too
            long, or something else.
    """
    program = shutil.which(question.address)
    if program is None:
        raise JudgeError(
            "that harness is not here", code="not_here", place=question.address, next_move="install it and log in once"
        )
    kept = {name: os.environ[name] for name in (*KEPT, *keeps) if name in os.environ}
    with tempfile.TemporaryDirectory(prefix="judge-") as name:
        folder = Path(name).resolve()
        if led := next((at / one for at in folder.parents for one in LED_BY if (at / one).exists()), None):
            raise JudgeError(
                f"its folder would lie in a project, whose words it reads: {led}", code="refused", place=question.address,
                next_move="export TMPDIR=/tmp, or another folder outside of projects",
            )  # fmt: skip
        for title, text in (files or {}).items():
            (folder / title).write_text(text, encoding="utf-8")
        pictures = []
        for number, piece in enumerate(question.pieces, 1):
            pictures.append(folder / f"{number:02}.{ENDINGS.get(piece.media_type, 'bin')}")
            pictures[-1].write_bytes(piece.data)
        status, said, errors = _outcome([program, *words(pictures)], folder, kept, stdin, question)
    if status != 0:
        last = " ".join((errors or said).split())[-160:]
        raise JudgeError(
            f"it ended with status {status}: {last or 'it said nothing'}", code="failed", place=question.address,
            next_move="run it once by hand: it may have to be logged in, or not know the model",
        )  # fmt: skip
    try:
        return _typed(read(said))
    except (ValueError, KeyError, TypeError, IndexError, AttributeError, RecursionError) as cause:
        raise JudgeError(
            f"it printed no answer: {' '.join(said.split())[:80]!r}", code="garbage", place=question.address,
            next_move="see whether its version prints JSON as the tested one does",
        ) from cause  # fmt: skip


def _typed(answer: Answer) -> Answer:
    """An answer as it is; a `TypeError` where a harness prints other kinds of values than the tested one."""
    none = type(None)
    kinds: tuple[tuple[object, tuple[type, ...]], ...] = (
        (answer.text, (str,)),
        (answer.model, (str,)),
        (answer.cost_usd, (int, float, none)),
        (answer.tokens_in, (int, none)),
        (answer.tokens_out, (int, none)),
    )
    if any(isinstance(value, bool) or not isinstance(value, kind) for value, kind in kinds):
        raise TypeError("its answer's values are of other kinds")
    return answer


def _outcome(
    command: list[str], folder: Path, env: dict[str, str], stdin: bytes, question: Question
) -> tuple[int, str, str]:
    try:
        started = subprocess.Popen(
            command, cwd=folder, env=env, start_new_session=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        )  # fmt: skip
    except OSError as cause:
        raise JudgeError(
            f"it cannot be started: {cause.strerror}", code="not_here", place=question.address,
            next_move="name the harness's program: --address",
        ) from cause  # fmt: skip
    heard = [time.monotonic()]
    pieces: dict[str, list[bytes]] = {"stdout": [], "stderr": []}

    def listen(name: str) -> None:
        stream = getattr(started, name)
        while piece := stream.read1(1 << 16):
            heard[0] = time.monotonic()
            if sum(map(len, pieces[name])) < MOST_SAID:
                pieces[name].append(piece)

    def tell() -> None:
        with contextlib.suppress(OSError):
            started.stdin.write(stdin)  # type: ignore[union-attr]
            started.stdin.close()  # type: ignore[union-attr]

    threads = [threading.Thread(target=listen, args=(name,), daemon=True) for name in pieces]
    threads.append(threading.Thread(target=tell, daemon=True))
    try:
        for thread in threads:
            thread.start()
        while started.poll() is None:
            if time.monotonic() - heard[0] > question.silent_s:
                raise JudgeError(
                    f"it said nothing for {question.silent_s:g} s", code="timed_out", place=question.address,
                    next_move="ask again, or give it longer: --silent-s",
                )  # fmt: skip
            time.sleep(0.02)
        for thread in threads:
            thread.join(timeout=5)
    finally:
        with contextlib.suppress(ProcessLookupError, PermissionError):
            os.killpg(started.pid, signal.SIGKILL)
        started.wait()
    said, errors = (b"".join(pieces[name]).decode(errors="replace") for name in ("stdout", "stderr"))
    return started.returncode, said, errors
