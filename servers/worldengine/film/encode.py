"""Write pictures to files: PNG stills, and H.264 videos encoded on a thread of their own while the next frame is drawn."""

import os
import queue
import threading
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING

from worldkit.files import write_atomic

if TYPE_CHECKING:
    import numpy as np

QUALITY = "19"
"""Constant rate factor, visually lossless at the sizes that we film."""
PRESET = "veryfast"

PNG_LEVEL = 5
"""How hard a still is packed, of 9."""


def write_png(path: Path, image: "np.ndarray") -> None:
    """Atomically write an RGB picture, uint8 (height, width, 3)."""
    import cv2  # a tenth of a second sooner there than what writes films

    good, coded = cv2.imencode(".png", image[:, :, ::-1], (cv2.IMWRITE_PNG_COMPRESSION, PNG_LEVEL))
    if not good:
        raise OSError(f"{path.name} cannot be written as PNG")
    write_atomic(path, coded.tobytes())


class Video:
    """An MP4 file (H.264, yuv420p, index in front) that appears when it is complete; a context manager.

    Args:
        path: the file.
        width, height: pixels, both even.
        fps: frames per second.
    """

    def __init__(self, path: Path, width: int, height: int, fps: int) -> None:
        import av

        self._path = Path(path)
        self._partial = self._path.with_name(f".{self._path.name}.part")
        self._container = av.open(str(self._partial), "w", format="mp4", options={"movflags": "+faststart"})
        stream = self._container.add_stream("libx264", rate=fps, options={"crf": QUALITY, "preset": PRESET})
        stream.width, stream.height, stream.pix_fmt = width, height, "yuv420p"
        codec = stream.codec_context
        # Players would guess the colour space, and guess by size. 1 is BT.709 in all three, and `color_range` 1 is the
        # studio
        # swing that the conversion below writes.
        codec.color_primaries = codec.color_trc = codec.colorspace = codec.color_range = 1
        codec.thread_count = min(2, os.cpu_count() or 1)  # the renderer needs the other cores more
        self._stream = stream
        self._frames: queue.Queue[np.ndarray | None] = queue.Queue(maxsize=4)
        self._failure: BaseException | None = None
        self._thread = threading.Thread(target=self._work, name="encoder", daemon=True)
        self._thread.start()

    def add(self, image: "np.ndarray") -> None:
        """Append a frame, uint8 (height, width, 3) RGB; the array must not be written to afterwards."""
        if self._failure is not None:
            raise self._failure
        self._frames.put(image)

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
        import av
        from av.video.reformatter import ColorRange, Colorspace

        try:
            while (image := self._frames.get()) is not None:
                frame = av.VideoFrame.from_ndarray(image, format="rgb24")
                frame = frame.reformat(
                    format="yuv420p",
                    src_colorspace=Colorspace.ITU709,
                    dst_colorspace=Colorspace.ITU709,
                    src_color_range=ColorRange.JPEG,
                    dst_color_range=ColorRange.MPEG,
                )
                for packet in self._stream.encode(frame):
                    self._container.mux(packet)
            for packet in self._stream.encode(None):
                self._container.mux(packet)
            self._container.close()
        except BaseException as failure:  # the drawing thread reports it
            self._failure = failure
            while self._frames.get() is not None:
                pass

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
