"""Write pictures to files: PNG stills, and H.264 videos encoded on a thread of their own while the next frame is drawn."""

import os
import queue
import threading
from fractions import Fraction
from functools import cache
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

from worldkit.files import write_atomic

if TYPE_CHECKING:
    import numpy as np

QUALITY = "19"
"""Constant rate factor, visually lossless at the sizes that we film."""
PRESET = "veryfast"

STEADY = {"x264-params": "asm=AVX2"}
"""x264's routines for AVX-512 give other bits now and then for the same pictures, in one film of three where memory is not fresh."""
CUT = "cut"
Packet = tuple[int, bool, bytes]
"""In the order of decoding: the frame of its part at which it is shown, whether it begins anew, and what it holds."""
DELAY = 2
"""So many frames before its place a packet is decoded. The encoder needs no more for frames that look both ways, but fewer in a
part of one or two, and times of decoding may not run back from part to part."""

PNG_LEVEL, PASSING = 5, 1
"""How hard a still is packed, of 9, and one that is read once and thrown away."""


@cache
def options() -> dict[str, str]:
    """The encoder's, by which the same pictures have the same bits on this machine."""
    from worldkit.lock import cpu_features

    return {"crf": QUALITY, "preset": PRESET} | (STEADY if "avx512f" in cpu_features().split() else {})


def write_png(path: Path, image: "np.ndarray", level: int = PNG_LEVEL) -> None:
    """Atomically write an RGB picture, uint8 (height, width, 3)."""
    import cv2  # a tenth of a second sooner there than what writes films

    good, coded = cv2.imencode(".png", image[:, :, ::-1], (cv2.IMWRITE_PNG_COMPRESSION, level))
    if not good:
        raise OSError(f"{path.name} cannot be written as PNG")
    write_atomic(path, coded.tobytes())


class Video:
    """An MP4 file (H.264, yuv420p, index in front) that appears when it is complete; a context manager.

    Its parts, which `cut` divides, are encoded each by itself: a part has the same bits whatever stands before it, and another
    film can `take` it as it is, drawn and encoded no second time.

    Args:
        path: the file.
        width, height: pixels, both even.
        fps: frames per second.
    """

    def __init__(self, path: Path, width: int, height: int, fps: int) -> None:
        import av

        self._path, self._size, self._fps = Path(path), (width, height), fps
        self._partial = self._path.with_name(f".{self._path.name}.part")
        self._container = av.open(str(self._partial), "w", format="mp4", options={"movflags": "+faststart"})
        self._stream = self._container.add_stream("libx264", rate=fps, options=dict(options()))
        self._described(self._stream.codec_context)
        self._frames: queue.Queue[np.ndarray | list[Packet] | str | None] = queue.Queue(maxsize=4)
        self._failure: BaseException | None = None
        self._thread = threading.Thread(target=self._work, name="encoder", daemon=True)
        self._thread.start()

    def _described(self, codec: Any) -> None:
        codec.width, codec.height, codec.pix_fmt = *self._size, "yuv420p"
        # Players would guess the colour space, and guess by size. 1 is BT.709 in all three, and `color_range` 1 is the
        # studio
        # swing that the conversion below writes.
        codec.color_primaries = codec.color_trc = codec.colorspace = codec.color_range = 1
        codec.thread_count = min(2, os.cpu_count() or 1)  # the renderer needs the other cores more

    def add(self, image: "np.ndarray") -> None:
        """Append a frame, uint8 (height, width, 3) RGB; the array must not be written to afterwards."""
        self._put(image)

    def cut(self) -> None:
        """Let the next frame begin a part."""
        self._put(CUT)

    def take(self, packets: "list[Packet]") -> None:
        """Append a part of another film, by `part`, as it is."""
        self._put(CUT)
        self._put(packets)

    def _put(self, what: "np.ndarray | list[Packet] | str") -> None:
        if self._failure is not None:
            raise self._failure
        self._frames.put(what)

    def close(self) -> None:
        """Finish the file and let it appear."""
        self._stop()
        if self._failure is not None:
            self._partial.unlink(missing_ok=True)
            raise self._failure
        self._partial.replace(self._path)

    def _stop(self) -> None:
        if self._thread.is_alive():
            self._frames.put(None)
            self._thread.join()

    def _work(self) -> None:
        begun, done, decoded = 0, 0, 0

        def mux(packets: list[Packet]) -> None:
            nonlocal decoded
            for shown, key, data in packets:
                self._mux(begun + shown, decoded - DELAY, key, data)
                decoded += 1

        codec: Any = None
        try:
            while (told := self._frames.get()) is not None:
                if isinstance(told, str):
                    mux(self._encoded(codec, None))
                    codec, begun = None, done
                elif isinstance(told, list):
                    mux(told)
                    done += len(told)
                    begun = done
                else:
                    codec = codec or self._encoder()
                    mux(self._encoded(codec, told, done - begun))
                    done += 1
            mux(self._encoded(codec, None))
            self._container.close()
        except BaseException as failure:  # the drawing thread reports it
            self._failure = failure
            while self._frames.get() is not None:
                pass

    def _encoder(self) -> Any:
        import av
        from av.codec.context import Flags

        codec = av.CodecContext.create("libx264", "w")
        codec.options = dict(options())
        codec.framerate, codec.time_base = Fraction(self._fps), Fraction(1, self._fps)
        codec.flags |= Flags.global_header
        self._described(codec)
        return codec

    def _encoded(self, codec: Any, image: "np.ndarray | None", number: int = 0) -> "list[Packet]":
        """What the encoder gives out when it is given a frame, or at the end of its part."""
        import av
        from av.video.reformatter import ColorRange, Colorspace

        if codec is None:
            return []
        frame = None
        if image is not None:
            frame = av.VideoFrame.from_ndarray(image, format="rgb24").reformat(
                format="yuv420p",
                src_colorspace=Colorspace.ITU709,
                dst_colorspace=Colorspace.ITU709,
                src_color_range=ColorRange.JPEG,
                dst_color_range=ColorRange.MPEG,
            )
            frame.pts, frame.time_base = number, codec.time_base
        return [(packet.pts, packet.is_keyframe, bytes(packet)) for packet in codec.encode(frame)]

    def _mux(self, shown: int, decoded: int, key: bool, data: bytes) -> None:
        """Write a packet, by the frames of the film at which it is shown and decoded."""
        import av

        packet = av.Packet(data)
        packet.stream, packet.time_base = self._stream, Fraction(1, self._fps)
        packet.pts, packet.dts, packet.is_keyframe, packet.duration = shown, decoded, key, 1
        self._container.mux(packet)

    def __enter__(self) -> "Video":
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is None:
            self.close()
        else:
            self._stop()
            self._partial.unlink(missing_ok=True)


def packets(path: Path, size: tuple[int, int], fps: int) -> "list[Packet]":
    """The frames of a film that `Video` wrote, as they are encoded; none where it is of another size or frame rate.

    Raises:
        OSError: it cannot be read.
    """
    import av

    try:
        with av.open(str(path)) as film:
            stream = film.streams.video[0]
            each, told = 1 / (Fraction(stream.time_base or 0) * fps), stream.codec_context
            if each.denominator != 1 or (told.width, told.height) != size or stream.average_rate != fps:
                return []
            return [
                (packet.pts // int(each), packet.is_keyframe, bytes(packet))
                for packet in film.demux(stream)
                if packet.pts is not None and packet.size
            ]
    except (av.FFmpegError, IndexError, ZeroDivisionError) as cause:
        raise OSError(f"{path.name} is no film: {cause}") from cause


def part(film: "list[Packet]", first: int, count: int) -> "list[Packet] | None":
    """So many frames of a film's `packets`, from a cut to a cut; None where there is no such part."""
    found = [(shown - first, key, data) for shown, key, data in film if first <= shown < first + count]
    if sorted(shown for shown, *_ in found) != list(range(count)) or found[0][0] != 0 or not found[0][1]:
        return None
    return [(shown, key, _as_encoded(data)) for shown, key, data in found]


def _as_encoded(data: bytes) -> bytes:
    """A packet of a file with the start codes that an encoder writes (Annex B), in place of lengths."""
    at, units = 0, []
    while at + 4 <= len(data):
        end = at + 4 + int.from_bytes(data[at : at + 4], "big")
        units.append(data[at + 4 : end])
        at = end
    return b"".join(b"\0\0\0\1" + unit for unit in units)
