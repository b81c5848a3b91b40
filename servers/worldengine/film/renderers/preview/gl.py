"""A thin layer over OpenGL: programs, textures, targets. Everything here needs a current context.

Not moderngl (5.13): it has neither `glClipControl` nor buffer textures, and does not find a current OSMesa context by itself.
"""

from __future__ import annotations

import ctypes
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import numpy as np
from OpenGL import GL

SHADERS = Path(__file__).parent / "shaders"
SCRATCH_UNIT = GL.GL_TEXTURE15
"""The unit on which textures are made, so that none in use is ever displaced."""
_common: dict[str, object] = {"HALF_DEPTH": 0, "COLOURED": 0}


def clip_control() -> Callable[[int, int], object] | None:
    """The driver's `glClipControl`, or None where it has none.

    PyOpenGL links extension functions by platform, and misses this one on OSMesa although Mesa has it there, too.
    """
    if GL.glClipControl:
        return GL.glClipControl
    from OpenGL import platform

    try:
        address = platform.PLATFORM.getExtensionProcedure(b"glClipControl")
    except AttributeError:
        return None
    return ctypes.CFUNCTYPE(None, ctypes.c_uint, ctypes.c_uint)(address) if address else None


def prepare_depth() -> bool:
    """Let depth run from 0 to 1 through the clip volume, as in our matrices; returns whether the driver can do it.

    Where it cannot, vertex shaders map our depth onto OpenGL's -1 to 1: the same depth reaches the buffer, with less
    precision far away (0.1 mm at 5 m).
    """
    control = clip_control()
    if control is not None:
        control(int(GL.GL_LOWER_LEFT), int(GL.GL_ZERO_TO_ONE))
    _common["HALF_DEPTH"] = int(control is None)
    return control is not None


@cache
def _text(name: str) -> str:
    return (SHADERS / name).read_text()


def source(name: str, defines: dict[str, object]) -> str:
    """A shader's text with its version line, its definitions (always `_common`), and the included files."""
    lines = []
    for line in _text(name).splitlines():
        lines.append(_text(line.split('"')[1]) if line.startswith("#include") else line)
    head = "".join(f"#define {key} {value}\n" for key, value in (_common | defines).items())
    return "#version 400 core\n" + head + "\n".join(lines) + "\n"


class Program:
    """A linked vertex and fragment shader with its uniforms by name.

    Raises RuntimeError with the driver's log when it does not compile.
    """

    def __init__(self, vertex: str, fragment: str, **defines: object):
        self.handle = GL.glCreateProgram()
        for kind, name in ((GL.GL_VERTEX_SHADER, vertex), (GL.GL_FRAGMENT_SHADER, fragment)):
            shader = GL.glCreateShader(kind)
            GL.glShaderSource(shader, source(name, defines))
            GL.glCompileShader(shader)
            if not GL.glGetShaderiv(shader, GL.GL_COMPILE_STATUS):
                raise RuntimeError(f"shader {name} does not compile: {GL.glGetShaderInfoLog(shader)!r}")
            GL.glAttachShader(self.handle, shader)
            GL.glDeleteShader(shader)
        GL.glLinkProgram(self.handle)
        if not GL.glGetProgramiv(self.handle, GL.GL_LINK_STATUS):
            raise RuntimeError(f"shaders {vertex} + {fragment} do not link: {GL.glGetProgramInfoLog(self.handle)!r}")
        self._places: dict[str, int] = {}

    def use(self) -> Program:
        """Make this the current program."""
        GL.glUseProgram(self.handle)
        return self

    def _place(self, name: str) -> int:
        if name not in self._places:
            self._places[name] = GL.glGetUniformLocation(self.handle, name)
        return self._places[name]

    def set(self, **values: object) -> Program:
        """Set uniforms: int, float, vectors (2..4,), matrices (4, 4) row-major, or arrays of vectors (n, 3) and (n, 4)."""
        for name, value in values.items():
            place = self._place(name)
            if place < 0:
                continue
            if isinstance(value, (bool, int, np.integer)):
                GL.glUniform1i(place, int(value))
            elif isinstance(value, (float, np.floating)):
                GL.glUniform1f(place, float(value))
            else:
                array = np.ascontiguousarray(value, dtype=np.float32)
                if array.shape == (4, 4):
                    GL.glUniformMatrix4fv(place, 1, GL.GL_TRUE, array)
                elif array.ndim == 2:
                    (GL.glUniform3fv if array.shape[1] == 3 else GL.glUniform4fv)(place, len(array), array)
                else:
                    {2: GL.glUniform2fv, 3: GL.glUniform3fv, 4: GL.glUniform4fv}[len(array)](place, 1, array)
        return self

    def texture(self, name: str, unit: int, handle: int, target: int = GL.GL_TEXTURE_2D) -> Program:
        """Bind a texture to a unit and a sampler to that unit."""
        GL.glActiveTexture(GL.GL_TEXTURE0 + unit)
        GL.glBindTexture(target, handle)
        GL.glUniform1i(self._place(name), unit)
        return self


def texture(
    internal: int,
    width: int,
    height: int,
    *,
    linear: bool = True,
    repeat: bool = False,
    levels: int = 1,
) -> int:
    """Make an empty 2D texture with immutable storage, with at most `levels` levels, as many as its size allows."""
    levels = min(levels, max(width, height).bit_length())
    handle = GL.glGenTextures(1)
    GL.glActiveTexture(SCRATCH_UNIT)
    GL.glBindTexture(GL.GL_TEXTURE_2D, handle)
    GL.glTexStorage2D(GL.GL_TEXTURE_2D, levels, internal, width, height)
    magnify = GL.GL_LINEAR if linear else GL.GL_NEAREST
    minify = (GL.GL_LINEAR_MIPMAP_LINEAR if linear else GL.GL_NEAREST_MIPMAP_NEAREST) if levels > 1 else magnify
    wrap = GL.GL_REPEAT if repeat else GL.GL_CLAMP_TO_EDGE
    for name, value in (
        (GL.GL_TEXTURE_MIN_FILTER, minify),
        (GL.GL_TEXTURE_MAG_FILTER, magnify),
        (GL.GL_TEXTURE_WRAP_S, wrap),
        (GL.GL_TEXTURE_WRAP_T, wrap),
    ):
        GL.glTexParameteri(GL.GL_TEXTURE_2D, name, value)
    return handle


def coarser(pixels: np.ndarray) -> Iterator[np.ndarray]:
    """A picture and its halves down to one pixel, averaged as light; itself alone where its sides are no powers of two.

    Args:
        pixels: uint8 (H, W, 4), sRGB and a linear fourth channel.

    A driver for the processor compiles a shader in each process before it halves its first texture, for as long as a small still
    takes to draw.
    """
    yield pixels
    if not _halves(*pixels.shape[:2]):
        return
    light, coded = _light()
    sums = np.concatenate([light[pixels[..., :3]], pixels[..., 3:] * np.uint32(257)], axis=2)
    while max(sums.shape[:2]) > 1:
        many = 1
        if sums.shape[0] > 1:
            sums, many = sums[0::2] + sums[1::2], 2 * many
        if sums.shape[1] > 1:
            sums, many = sums[:, 0::2] + sums[:, 1::2], 2 * many
        sums = (sums + np.uint32(many // 2)) // np.uint32(many)
        yield np.concatenate([coded[sums[..., :3]], ((sums[..., 3:] + 128) // 257).astype(np.uint8)], axis=2)


def _halves(*sides: int) -> bool:
    """Whether all sides can be halved down to one pixel."""
    return all(side & (side - 1) == 0 for side in sides)


@cache
def _light() -> tuple[np.ndarray, np.ndarray]:
    """The light, in 65535ths, of each of 256 sRGB values, and the nearest value of each light. Source: IEC 61966-2-1."""
    value = np.arange(256) / 255.0
    light = np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)
    share = np.arange(65536) / 65535.0
    coded = np.where(share <= 0.0031308, 12.92 * share, 1.055 * share ** (1 / 2.4) - 0.055)
    return np.rint(65535 * light).astype(np.uint32), np.rint(255 * coded).astype(np.uint8)


def picture(pixels: np.ndarray) -> int:
    """Make a repeating, mipmapped texture from uint8 (H, W, 4): sRGB and a linear fourth channel; row 0 is the top."""
    height, width = pixels.shape[:2]
    levels = int(np.log2(max(width, height))) + 1
    handle = texture(GL.GL_SRGB8_ALPHA8, width, height, repeat=True, levels=levels)
    GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
    for level, data in enumerate(coarser(np.ascontiguousarray(pixels[::-1]))):
        side = data.shape[1], data.shape[0]
        GL.glTexSubImage2D(GL.GL_TEXTURE_2D, level, 0, 0, *side, GL.GL_RGBA, GL.GL_UNSIGNED_BYTE, data)
    if not _halves(height, width):
        GL.glGenerateMipmap(GL.GL_TEXTURE_2D)
    return handle


def cube_picture(faces: np.ndarray) -> int:
    """Make a mipmapped cube map from uint8 (6, N, N, 4)."""
    size = faces.shape[1]
    handle = GL.glGenTextures(1)
    GL.glActiveTexture(SCRATCH_UNIT)
    GL.glBindTexture(GL.GL_TEXTURE_CUBE_MAP, handle)
    GL.glTexStorage2D(GL.GL_TEXTURE_CUBE_MAP, int(np.log2(size)) + 1, GL.GL_SRGB8_ALPHA8, size, size)
    GL.glPixelStorei(GL.GL_UNPACK_ALIGNMENT, 1)
    for i in range(6):
        face = GL.GL_TEXTURE_CUBE_MAP_POSITIVE_X + i
        for level, data in enumerate(coarser(np.ascontiguousarray(faces[i]))):
            GL.glTexSubImage2D(face, level, 0, 0, len(data), len(data), GL.GL_RGBA, GL.GL_UNSIGNED_BYTE, data)
    if not _halves(size, size):
        GL.glGenerateMipmap(GL.GL_TEXTURE_CUBE_MAP)
    for name, value in (
        (GL.GL_TEXTURE_MIN_FILTER, GL.GL_LINEAR_MIPMAP_LINEAR),
        (GL.GL_TEXTURE_MAG_FILTER, GL.GL_LINEAR),
        (GL.GL_TEXTURE_WRAP_S, GL.GL_CLAMP_TO_EDGE),
        (GL.GL_TEXTURE_WRAP_T, GL.GL_CLAMP_TO_EDGE),
        (GL.GL_TEXTURE_WRAP_R, GL.GL_CLAMP_TO_EDGE),
    ):
        GL.glTexParameteri(GL.GL_TEXTURE_CUBE_MAP, name, value)
    GL.glEnable(GL.GL_TEXTURE_CUBE_MAP_SEAMLESS)
    return handle


class Target:
    """A framebuffer of `width` x `height` with one colour texture, if any, and maybe a depth texture.

    One with `samples` in each pixel has a depth of its own, and its colour has them all.
    """

    def __init__(
        self,
        width: int,
        height: int,
        colour: int | None,
        *,
        depth: bool = False,
        linear: bool = True,
        levels: int = 1,
        samples: int = 0,
    ):
        self.width, self.height = width, height
        self.handle = GL.glGenFramebuffers(1)
        self.colour = self.depth = 0
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self.handle)
        if samples:
            both = ((GL.GL_COLOR_ATTACHMENT0, colour), (GL.GL_DEPTH_ATTACHMENT, GL.GL_DEPTH_COMPONENT32F))
            for place, kind in both:
                made = GL.glGenTextures(1)
                GL.glActiveTexture(SCRATCH_UNIT)
                GL.glBindTexture(GL.GL_TEXTURE_2D_MULTISAMPLE, made)
                GL.glTexImage2DMultisample(GL.GL_TEXTURE_2D_MULTISAMPLE, samples, kind, width, height, True)
                GL.glFramebufferTexture2D(GL.GL_FRAMEBUFFER, place, GL.GL_TEXTURE_2D_MULTISAMPLE, made, 0)
                self.colour = self.colour or made
            depth = False
        elif colour is not None:
            self.colour = texture(colour, width, height, linear=linear, levels=levels)
            GL.glFramebufferTexture2D(GL.GL_FRAMEBUFFER, GL.GL_COLOR_ATTACHMENT0, GL.GL_TEXTURE_2D, self.colour, 0)
        else:
            GL.glDrawBuffer(GL.GL_NONE)
        if depth:
            self.depth = texture(GL.GL_DEPTH_COMPONENT32F, width, height, linear=False)
            GL.glFramebufferTexture2D(GL.GL_FRAMEBUFFER, GL.GL_DEPTH_ATTACHMENT, GL.GL_TEXTURE_2D, self.depth, 0)
        status = GL.glCheckFramebufferStatus(GL.GL_FRAMEBUFFER)
        if status != GL.GL_FRAMEBUFFER_COMPLETE:
            raise RuntimeError(f"the graphics driver refuses a {width}x{height} render target (status {status:#x})")

    def bind(self) -> None:
        """Draw into this target from now on."""
        GL.glBindFramebuffer(GL.GL_FRAMEBUFFER, self.handle)
        GL.glViewport(0, 0, self.width, self.height)

    def blit_to(self, other: Target, depth: bool = False) -> None:
        """Copy the colour, and the depth if asked, to `other` of the same size; of several samples in a pixel the mean."""
        GL.glBindFramebuffer(GL.GL_READ_FRAMEBUFFER, self.handle)
        GL.glBindFramebuffer(GL.GL_DRAW_FRAMEBUFFER, other.handle)
        what = GL.GL_COLOR_BUFFER_BIT | (GL.GL_DEPTH_BUFFER_BIT if depth else 0)
        GL.glBlitFramebuffer(0, 0, self.width, self.height, 0, 0, other.width, other.height, what, GL.GL_NEAREST)


class Shape:
    """Vertices (n, 9: corner xyz and cap side, normal xyz, texture uv; or n, 12: colour rgb, too) and triangles (m, 3) on the
    graphics side."""

    def __init__(self, vertices: np.ndarray, triangles: np.ndarray, dynamic: bool = False):
        self.count = triangles.size
        self._usage = GL.GL_STREAM_DRAW if dynamic else GL.GL_STATIC_DRAW
        self._array = GL.glGenVertexArrays(1)
        GL.glBindVertexArray(self._array)
        self._vertices, elements = GL.glGenBuffers(2)
        GL.glBindBuffer(GL.GL_ELEMENT_ARRAY_BUFFER, elements)
        indices = np.ascontiguousarray(triangles, dtype=np.uint32)
        GL.glBufferData(GL.GL_ELEMENT_ARRAY_BUFFER, indices.nbytes, indices, GL.GL_STATIC_DRAW)
        self.fill(vertices)
        self.coloured = vertices.shape[1] > 9
        for place, (count, offset) in enumerate(((4, 0), (3, 16), (2, 28), (3, 36))[: 3 + self.coloured]):
            GL.glEnableVertexAttribArray(place)
            stride = 4 * vertices.shape[1]
            GL.glVertexAttribPointer(place, count, GL.GL_FLOAT, GL.GL_FALSE, stride, ctypes.c_void_p(offset))

    def fill(self, vertices: np.ndarray) -> None:
        """Replace the vertices (n, 9 or 12)."""
        data = np.ascontiguousarray(vertices, dtype=np.float32)
        GL.glBindBuffer(GL.GL_ARRAY_BUFFER, self._vertices)
        GL.glBufferData(GL.GL_ARRAY_BUFFER, data.nbytes, data, self._usage)

    def draw(self, instances: int) -> None:
        """Draw `instances` copies."""
        GL.glBindVertexArray(self._array)
        GL.glDrawElementsInstanced(GL.GL_TRIANGLES, self.count, GL.GL_UNSIGNED_INT, None, instances)


class FarSides:
    """Leaves out the far sides of closed shapes or draws them; a context manager that restores everything.

    `flipped` is for pictures that show the world mirrored, or from behind.
    """

    def __init__(self, flipped: bool):
        self._flipped, self._hidden = flipped, False

    def hide(self, hidden: bool) -> None:
        """Leave far sides out from now on, or draw them."""
        if hidden != self._hidden:
            (GL.glEnable if hidden else GL.glDisable)(GL.GL_CULL_FACE)
            self._hidden = hidden

    def __enter__(self) -> FarSides:
        GL.glCullFace(GL.GL_BACK)
        GL.glFrontFace(GL.GL_CW if self._flipped else GL.GL_CCW)
        return self

    def __exit__(self, *_: object) -> None:
        self.hide(False)
        GL.glFrontFace(GL.GL_CCW)
