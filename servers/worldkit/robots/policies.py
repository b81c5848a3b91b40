"""A policy from an ONNX file: observations of many robots in, their actions out, in one call.

    WALK = policies.read("go1/walk.onnx", observation=48, action=12)  # beside the program
    actions = WALK(observations)  # (N, 48) to (N, 12)

It is run by onnxruntime on one thread, so that a repetition gives the same digits.
"""

import hashlib
import os
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import WorldkitError
from . import onnx_graph

if TYPE_CHECKING:
    import numpy as np

MOST_BYTES = 64 << 20
INSTALLING = 'pip install "worldwright[robots]"'


class PolicyError(WorldkitError):
    """A file that is no policy for this robot; `code` says why.

    `missing`, `too_large`, `other_file` (another SHA-256), `unreadable`, `custom_operator`,
    `external_weights` (in a file of their own), `wrong_shape`, `not_finite`, or `no_runtime`.
    """

    def __init__(self, code: str, cause: str, place: str, next_move: str) -> None:
        super().__init__(cause, place, next_move)
        self.code = code


@dataclass(frozen=True)
class Policy:
    """What `read` gives: called with observations (N, `observation`), it gives actions (N, `action`), float64."""

    name: str
    observation: int
    action: int
    sha256: str
    _session: Any = field(repr=False)

    def __call__(self, observations: "np.ndarray") -> "np.ndarray":
        """Actions of N robots by one call.

        Raises:
            PolicyError: the observations are of another shape, or what comes out is no number.
        """
        import numpy as np

        rows = np.asarray(observations, dtype=np.float32)
        if rows.ndim != 2 or rows.shape[1] != self.observation:
            raise PolicyError(
                "wrong_shape", f"it takes (N, {self.observation}), it is given {rows.shape}", self.name,
                "give one row for each robot, in the order of its layout",
            )  # fmt: skip
        entry = self._session.get_inputs()[0].name
        try:
            (actions,) = self._session.run(None, {entry: rows})[:1]
        except Exception as error:  # the runtime has no errors of its own that it promises
            raise _unreadable(self.name, error) from error
        if actions.shape != (len(rows), self.action) or not np.isfinite(actions).all():
            code = "not_finite" if actions.shape == (len(rows), self.action) else "wrong_shape"
            raise PolicyError(
                code, f"of {rows.shape} it makes {actions.shape}, finite: {bool(np.isfinite(actions).all())}", self.name,
                "look whether the robot has fallen or flown off, and whether the layout is the policy's own",
            )  # fmt: skip
        return actions.astype(float)


def read(file: str, *, observation: int, action: int, sha256: str = "") -> Policy:
    """A policy from a file beside the program.

    Args:
        file: relative to the program's folder.
        observation: numbers of one row that it is to take.
        action: numbers of one row that it is to give.
        sha256: of the file, where the plan says so.

    Raises:
        PolicyError: with the codes that it lists.
        ValueError: there is no such file beside the program.
    """
    from ..beside_program import found

    return opened(found(file, Path(file).stem), observation=observation, action=action, sha256=sha256)


def opened(path: Path, *, observation: int, action: int, sha256: str = "") -> Policy:
    """`read` for a file wherever it lies."""
    data = checked(path, sha256)
    os.environ["ORT_DISABLE_TELEMETRY"] = (
        "1"  # read as it is imported, else it writes a device's name down and sends reports
    )
    try:
        import onnxruntime
    except ImportError as error:
        raise PolicyError("no_runtime", "onnxruntime is not installed", path.name, INSTALLING) from error
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = 4  # what it would print is in the error that it raises
    try:
        session = onnxruntime.InferenceSession(onnx_graph.freed(data), options, providers=["CPUExecutionProvider"])
    except Exception as error:  # the runtime has no errors of its own that it promises
        raise _unreadable(path.name, error) from error
    entries, exits = session.get_inputs(), session.get_outputs()
    shapes = [list(one.shape[1:]) for one in (*entries, *exits)]
    if len(entries) != 1 or shapes[0] != [observation] or shapes[1] != [action] or entries[0].type != "tensor(float)":
        told = " and ".join(f"{one.name} {one.shape} {one.type}" for one in (*entries, *exits))
        raise PolicyError(
            "wrong_shape", f"it has {told}; wanted is one input of {observation} numbers (float) a row, and {action} out",
            path.name, "name the robot and the layout that it was trained for",
        )  # fmt: skip
    return Policy(path.name, observation, action, hashlib.sha256(data).hexdigest(), session)


def checked(path: Path, sha256: str = "") -> bytes:
    """The bytes of a file that may be a policy: of bounded size, the one that was named, whole in itself, with standard
    operators alone.

    Raises:
        PolicyError: it is not.
    """
    try:
        size = path.stat().st_size
        if size > MOST_BYTES:
            raise PolicyError(
                "too_large", f"it is larger than {MOST_BYTES >> 20} MB", path.name, "give a smaller policy"
            )
        data = path.read_bytes()
    except OSError as error:
        raise PolicyError("missing", f"it cannot be read ({error.strerror})", path.name, "put it there") from error
    found = hashlib.sha256(data).hexdigest()
    if sha256 and found != sha256.lower():
        raise PolicyError(
            "other_file", f"its SHA-256 is {found}, the plan says {sha256}", path.name, "put the named file there, or name this one"
        )  # fmt: skip
    try:
        used, elsewhere = onnx_graph.operators(data), onnx_graph.weighs_elsewhere(data)
    except ValueError as error:  # UnicodeDecodeError is one
        raise PolicyError(
            "unreadable", f"it is no whole ONNX file: {error}", path.name, "export it again, as ONNX with its weights inside"
        ) from error  # fmt: skip
    custom = sorted({f"{domain}.{name}" for domain, name in used if domain not in onnx_graph.KNOWN_DOMAINS})
    if custom:
        raise PolicyError(
            "custom_operator", f"it needs operators that only their maker has: {', '.join(custom[:5])}", path.name,
            "export it with standard operators (domain ai.onnx)",
        )  # fmt: skip
    if elsewhere:
        raise PolicyError(
            "external_weights", "its weights lie in a file of their own, which its hash does not cover", path.name,
            "export it again, as ONNX with its weights inside",
        )  # fmt: skip
    if not used:
        raise PolicyError("unreadable", "its graph is empty", path.name, "export it again")
    return data


def _unreadable(name: str, error: Exception) -> PolicyError:
    told = " ".join(str(error).split())[:300]
    return PolicyError(
        "unreadable", f"onnxruntime refuses it: {told}", name, "export it again, with its weights inside"
    )
