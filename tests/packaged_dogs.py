"""A robot dog in a wheel of its own, and small ONNX files, for tests: what a user would have installed and been given."""

import re
import struct
from pathlib import Path

import pytest

from worldkit.robots import packaged
from worldkit.robots.gaits import GAITS

KEY = "go1"


def leg(name: str, x: float, y: float) -> str:
    """A hip, a thigh and a calf, each with its joint."""
    return f"""<body name="{name}_hip" pos="{x} {y} 0"><joint name="{name}_hip_joint" axis="1 0 0"/>
    <geom type="sphere" size="0.03" mass="0.7"/>
    <body name="{name}_thigh" pos="0 {y} 0"><joint name="{name}_thigh_joint" class="pitch"/>
      <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.015" mass="1"/>
      <body name="{name}_calf" pos="0 0 -0.2"><joint name="{name}_calf_joint" class="pitch" range="-2.8 -0.9"/>
        <geom type="mesh" mesh="shin" contype="0" conaffinity="0" mass="0"/>
        <geom name="{name}_foot" solimp="0.01 1 0.02" size="0.02" pos="0 0 -0.2" mass="0.2"/></body></body></body>"""


DOG = f"""<mujoco model="dog"><compiler angle="radian" meshdir="assets" autolimits="true"/>
  <default><default class="pitch"><joint axis="0 1 0"/></default></default>
  <asset><mesh name="shin" file="shin.obj"/></asset>
  <worldbody><body name="trunk" pos="0 0 0.4"><freejoint/><geom type="box" size="0.2 0.05 0.05" mass="5"/>
    <site name="imu" pos="0.1 0 0"/>
    {"".join(leg(name, x, y) for name, x, y in (("FR", 0.2, -0.1), ("FL", 0.2, 0.1), ("RR", -0.2, -0.1), ("RL", -0.2, 0.1)))}
  </body></worldbody>
  <actuator><motor joint="FR_hip_joint"/></actuator></mujoco>"""
BARE = re.sub(r'<asset>.*</asset>|<geom type="mesh".*?/>|<actuator>.*</actuator>', "", DOG)
"""Without its mesh and its motor."""
SHIN = "v 0 0 0\nv 0.01 0 0\nv 0 0.01 0\nv 0 0 -0.2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"


def install(folder: Path, monkeypatch: pytest.MonkeyPatch, key: str = KEY, model: str = DOG) -> packaged.Robot:
    """Lay a wheel with the dog where packages are looked for, or with another model; its key is that of a robot that is driven."""
    for name, text in (("dogs/dog.xml", model), ("dogs/assets/shin.obj", SHIN), ("dogs/LICENSE", "do as you like\n")):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    told = folder / "dogs_of_ours-2.0.dist-info/METADATA"
    told.parent.mkdir()
    told.write_text("Metadata-Version: 2.4\nName: dogs-of-ours\nVersion: 2.0\nLicense-Expression: MIT\n")
    monkeypatch.syspath_prepend(str(folder))
    robot = packaged.Robot(
        key, "dogs-of-ours", "dogs/dog.xml", "quadruped robot dog, of ours", "a breeder", "", (0.5, 0.4, 0.4)
    )
    monkeypatch.setitem(packaged.ROBOTS, key, robot)
    return robot


def policy(
    path: Path,
    inputs: int,
    outputs: int,
    operator: str = "MatMul",
    domain: str = "",
    value: float = 0.01,
    within: tuple[tuple[int, bytes], ...] = (),
) -> Path:
    """An ONNX file with one node: a row of `inputs` numbers times a matrix of `value`; `within` is of an attribute of the node."""
    weights = message((1, inputs), (1, outputs), (2, 1), (8, b"w"), (9, struct.pack("<f", value) * inputs * outputs))
    node = message((1, b"obs"), (1, b"w"), (2, b"act"), (4, operator.encode()), (7, domain.encode()))
    node += message((5, message(*within))) if within else b""
    graph = message(
        (1, node), (2, b"policy"), (5, weights), (11, _value(b"obs", inputs)), (12, _value(b"act", outputs))
    )  # fmt: skip
    opsets = [(8, message((1, name.encode()), (2, 17))) for name in dict.fromkeys(("", domain))]
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(message((1, 8), (7, graph), *opsets))
    return path


def walk(path: Path) -> Path:
    """A policy of the dog's shape."""
    return policy(path, GAITS[KEY].observation, len(GAITS[KEY].joints))


def _value(name: bytes, width: int) -> bytes:
    shape = message((1, message((1, 1))), (1, message((1, width))))
    return message((1, name), (2, message((1, message((1, 1), (2, shape))))))


def message(*fields: tuple[int, int | bytes]) -> bytes:
    """A message of Protocol Buffers: numbers and what has a length, each in its field."""
    out = b""
    for number, value in fields:
        if isinstance(value, int):
            out += _varint(number << 3) + _varint(value)
        else:
            out += _varint(number << 3 | 2) + _varint(len(value)) + value
    return out


def _varint(value: int) -> bytes:
    return bytes([value]) if value < 128 else bytes([value & 127 | 128]) + _varint(value >> 7)
