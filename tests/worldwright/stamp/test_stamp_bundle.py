"""What an accepted folder holds: a world that plain MuJoCo opens, its motion, an attestation, and who signed it."""

import base64
import json
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright import exported, kept_open
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.scan import tools as scan
from worldwright.stamp import bundle, signing
from worldwright.stamp import tools as stamp
from worldwright.stamp.statement import Statement
from worldwright.stamp.verification import static

Copy = Callable[[Path], Path]
EXAMPLES = Path(__file__).parents[3] / "examples"
PLAIN = """
import sys, mujoco, numpy as np
model = mujoco.MjSpec.from_file(sys.argv[1] + "/world.mjz").compile()
motion = np.load(sys.argv[1] + "/trajectory.npz", allow_pickle=False)
data = mujoco.MjData(model)
key = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, "start")
if key >= 0:
    mujoco.mj_resetDataKeyframe(model, data, key)
model.opt.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_AUTORESET)
while data.time < motion["t"][-1] - model.opt.timestep / 2:
    mujoco.mj_step(model, data)
print(float(np.abs(data.qpos - motion["qpos"][-1]).max()), [m for m in sys.modules if m.startswith("world")])
"""


def test_plain_mujoco_opens_the_world_and_it_moves_as_recorded(accepted: Path) -> None:
    folder = accepted / "accepted"
    call = [sys.executable, "-c", PLAIN, str(folder)]
    done = subprocess.run(call, capture_output=True, text=True, check=False, cwd="/")
    assert done.returncode == 0, done.stderr
    apart, ours = done.stdout.split(" ", 1)
    assert float(apart) < 1e-6
    assert ours.strip() == "[]"


def test_the_trajectory_in_the_bundle_can_be_scanned(accepted: Path) -> None:
    report = scan.scan(str(accepted / "accepted" / "trajectory.npz"))
    assert not [a for a in report.anomalies if a.severity == "blocking"]
    assert sum(c.status != "skipped" for c in report.checks) > 5


def test_the_attestation_names_every_material_and_product(accepted: Path) -> None:
    folder = accepted / "accepted"
    statement = Statement.model_validate_json((folder / "stamp.json").read_bytes())
    assert {"world.mjz", "trajectory.npz", "simulation.py", "plan.md"} <= {s.name for s in statement.subject}
    materials = statement.predicate.source.materials
    assert set(materials) == {
        "simulation.py", "plan.md", "prompt.md", "journal.jsonl", "simulator", "worldkit", "film",
    }  # fmt: skip
    assert materials["plan.md"].sha256 == sha256_file(accepted / "plan.md")
    proof = statement.predicate.proof
    assert proof.no_world == ""
    assert proof.sandbox in ("bubblewrap", "landlock", "rlimits")


@pytest.fixture(scope="module")
def keys(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    """Two people's keys, in the two formats that people have."""
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey
    from cryptography.hazmat.primitives.serialization import (
        BestAvailableEncryption,
        Encoding,
        NoEncryption,
        PrivateFormat,
        PublicFormat,
    )

    folder = tmp_path_factory.mktemp("keys")
    found = {}
    pem = (Encoding.PEM, PrivateFormat.PKCS8, Encoding.PEM, PublicFormat.SubjectPublicKeyInfo)
    ssh = (Encoding.PEM, PrivateFormat.OpenSSH, Encoding.OpenSSH, PublicFormat.OpenSSH)
    for name, (e1, f1, e2, f2), lock in (
        ("pem", pem, NoEncryption()),
        ("ssh", ssh, NoEncryption()),
        ("locked", pem, BestAvailableEncryption(b"open sesame")),
    ):
        key = Ed25519PrivateKey.generate()
        for suffix, content in (("", key.private_bytes(e1, f1, lock)), (".pub", key.public_key().public_bytes(e2, f2))):
            found[name + suffix] = folder / (name + suffix)
            found[name + suffix].write_bytes(content)
    return found


@pytest.mark.parametrize("kind", ["pem", "ssh"])
def test_a_signed_stamp_says_by_whom(accepted: Path, copy: Copy, keys: dict[str, Path], kind: str) -> None:
    folder = copy(accepted)
    before = sha256_file(folder / "accepted" / "stamp.json")
    assert stamp.accept(str(folder), signing_key=keys[kind]).ok
    assert sha256_file(folder / "accepted" / "stamp.json") == before
    assert stamp.status(str(folder)).state == "accepted"
    inner, run = folder / "accepted", Run(folder)

    def said(signer: str | None) -> tuple[bool, str]:
        return next(
            (c.ok, c.detail) for c in static(run, inner, keys[signer] if signer else None) if c.name == "signature"
        )

    assert said(f"{kind}.pub")[0]
    assert "UNKNOWN" in said(None)[1]
    other = "ssh" if kind == "pem" else "pem"
    assert said(f"{other}.pub") == (False, "the signature is not that key's")
    envelope = json.loads((inner / signing.ENVELOPE).read_text())
    assert envelope["payloadType"] == "application/vnd.in-toto+json"
    assert base64.b64decode(envelope["payload"]) == (inner / "stamp.json").read_bytes()


def test_an_edited_byte_of_the_signature_or_the_stamp_is_noticed(
    accepted: Path, copy: Copy, keys: dict[str, Path]
) -> None:
    folder = copy(accepted)
    stamp.accept(str(folder), signing_key=keys["pem"])
    inner = folder / "accepted"
    for name in (signing.ENVELOPE, signing.PUBLIC, "stamp.json"):
        path = inner / name
        whole = path.read_bytes()
        for at in (len(whole) // 3, len(whole) // 2, len(whole) - 40):
            path.write_bytes(whole[:at] + bytes([whole[at] ^ 1]) + whole[at + 1 :])
            assert not all(c.ok for c in static(Run(folder), inner, keys["pem.pub"])) or name == signing.PUBLIC
            assert not all(c.ok for c in static(Run(folder), inner))
        path.write_bytes(whole)
    assert all(c.ok for c in static(Run(folder), inner, keys["pem.pub"]))


def test_an_unsigned_stamp_does_not_satisfy_who_asks_for_a_signer(
    accepted: Path, copy: Copy, keys: dict[str, Path]
) -> None:
    folder = copy(accepted)
    for name in (signing.ENVELOPE, signing.PUBLIC):
        (folder / "accepted" / name).unlink()
    result = stamp.verify(str(folder), signer=keys["pem.pub"])
    assert not result.ok
    assert "FAIL signature: the stamp is not signed" in result.text()


def test_a_locked_key_needs_its_password(
    accepted: Path, copy: Copy, keys: dict[str, Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = copy(accepted)
    with pytest.raises(signing.SigningError, match="password") as caught:
        stamp.accept(str(folder), signing_key=keys["locked"])
    assert signing.PASSWORD in caught.value.next_move
    monkeypatch.setenv(signing.PASSWORD, "open sesame")
    assert stamp.accept(str(folder), signing_key=keys["locked"]).ok
    with pytest.raises(signing.SigningError, match="cannot be read"):
        stamp.accept(str(folder), signing_key=folder / "nothing")
    with pytest.raises(signing.SigningError):
        stamp.accept(str(folder), signing_key=folder / "plan.md")


def test_what_report_export_and_watch_leave_beside_a_small_form_does_not_break_it(tmp_path: Path) -> None:
    folder = tmp_path / "kept"
    shutil.copytree(
        EXAMPLES / "bouncing-basketball", folder, ignore=shutil.ignore_patterns("accepted", "evidence", "jobs")
    )
    (folder / "out").mkdir()
    for name in (*exported.FORMATS.values(), f"out/{kept_open.PICTURE}", "report.html"):
        (folder / name).write_bytes(b"made again")
    statement = Statement.model_validate_json((folder / bundle.STAMP).read_bytes())
    assert bundle.damage(folder, statement) == []
    (folder / "out.txt").write_bytes(b"left by somebody")
    assert bundle.damage(folder, statement) == ["out.txt is not in the stamp"]


@pytest.fixture
def small(tmp_path: Path) -> tuple[Path, Statement]:
    """The small form of an accepted world, and its stamp."""
    folder = tmp_path / "kept"
    shutil.copytree(
        EXAMPLES / "bouncing-basketball", folder, ignore=shutil.ignore_patterns("accepted", "evidence", "jobs")
    )
    return folder, Statement.model_validate_json((folder / bundle.STAMP).read_bytes())


@pytest.mark.parametrize("name", ["video", "stills", "jobs", "evidence", "evidence/0123"])
def test_a_link_in_a_stamped_folder_is_refused_wherever_it_leads(
    small: tuple[Path, Statement], tmp_path: Path, name: str
) -> None:
    folder, statement = small
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "another.mp4").write_bytes(b"another film")
    (folder / name).parent.mkdir(exist_ok=True)
    (folder / name).symlink_to(tmp_path / "elsewhere")
    assert bundle.damage(folder, statement) == [f"{name} is a link, and not in the stamp"]


def test_what_a_stamp_does_not_list_is_refused_in_its_folders_and_named_beside_them(
    small: tuple[Path, Statement],
) -> None:
    folder, statement = small
    for name in (
        "evidence/robust.json",
        "stills/another.png",
        "video/another.mp4",
        "report.html",
        "evidence/0123/key.json",
    ):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(b"{}")
    refused = ["evidence/robust.json", "stills/another.png", "video/another.mp4"]
    assert bundle.damage(folder, statement) == [f"{name} is not in the stamp" for name in refused]
    for name in refused:
        (folder / name).unlink()
    checks = static(Run(folder), folder)
    assert all(check.ok for check in checks)
    (told,) = [check.detail for check in checks if check.note]
    assert told.startswith("evidence/, report.html, ") and "stills/, video/: in no list" in told, told


def test_a_film_that_no_stamp_lists_and_an_empty_folder_are_named(small: tuple[Path, Statement]) -> None:
    folder, statement = small
    (folder / "handed_in.mp4").write_bytes(b"of another world")
    (folder / "secret" / "room").mkdir(parents=True)
    checks = static(Run(folder), folder)
    assert all(check.ok for check in checks) and bundle.damage(folder, statement) == []
    (told,) = [check.detail for check in checks if check.note]
    assert told.startswith("handed_in.mp4, secret/room/: in no list")
    (folder / "handed_in.mp4").unlink()
    (folder / "handed_in.mp4").symlink_to("/dev/null")
    assert bundle.damage(folder, statement) == ["handed_in.mp4 is a link, and not in the stamp"]
