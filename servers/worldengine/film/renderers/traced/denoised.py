"""Take the noise out of a traced picture with Open Image Denoise, on the graphics card where the paths were traced there."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

THREADS = min(os.cpu_count() or 1, 8)
IMAGES = ("color", "albedo", "normal", "output")


class Denoiser:
    """Denoises pictures of one size; the same input always gives the same output.

    Args:
        width, height: pixels.
        card: whether to use NVIDIA's card; where that cannot be opened, the processor does the same.
        fine: whether to take two to three times as long, and lose less.
        scale: by how much light is brightened meanwhile; with 0 as much as each picture needs.
    """

    def __init__(self, width: int, height: int, card: bool = False, fine: bool = False, scale: float = 0.0) -> None:
        import numpy as np

        self._filter: Any = None
        try:
            import pyoidn
        except (ImportError, OSError):
            return  # without the library a picture stays as noisy as it is
        self._images = {name: np.zeros((height, width, 3), np.float32) for name in IMAGES}
        self._buffers: dict[str, Any] = {}
        self._fine, self._scale = fine, scale
        self.card = card and bool(pyoidn.Device.is_cuda_available())
        """Whether the card does the work."""
        try:
            self._open()
        except RuntimeError:
            if not self.card:
                raise
            self.card = False
            self._open()

    def _open(self) -> None:
        """Open the device and its filter; raises RuntimeError where it refuses."""
        import pyoidn

        height, width, _ = self._images["color"].shape
        self._device = pyoidn.Device(pyoidn.OIDN_DEVICE_TYPE_CUDA if self.card else pyoidn.OIDN_DEVICE_TYPE_CPU)
        if not self.card:
            self._device.set_int("numThreads", THREADS)
            self._device.set_bool("setAffinity", False)
        self._device.commit()
        self._filter = pyoidn.Filter(self._device)
        # A card has a memory of its own, so pictures are written into it and read out of it.
        self._buffers = (
            {n: pyoidn.Buffer(self._device, image.nbytes) for n, image in self._images.items()} if self.card else {}
        )
        for name, image in self._images.items():
            place = self._buffers.get(name, image)
            self._filter.set_image(name, place, pyoidn.OIDN_FORMAT_FLOAT3, width, height)
        self._filter.set_bool("hdr", True)
        if self._scale > 0:
            self._filter.set_float("inputScale", self._scale)
        self._filter.set_quality(pyoidn.OIDN_QUALITY_HIGH if self._fine else pyoidn.OIDN_QUALITY_FAST)
        self._filter.commit()
        self._refused()

    @property
    def there(self) -> bool:
        """Whether the library is there, and open."""
        return self._filter is not None

    def clean(self, light: np.ndarray, albedo: np.ndarray, normal: np.ndarray) -> np.ndarray:
        """The picture (H, W, 3) of scene light without noise, guided by surface colour and normals.

        Raises:
            RuntimeError: the library refuses.
        """
        if self._filter is None:
            return light
        for name, image in (("color", light), ("albedo", albedo), ("normal", normal)):
            self._images[name][...] = image
            if self._buffers:
                self._buffers[name].write(0, image.size * 4, self._images[name])
        self._filter.execute()
        self._refused()
        output = self._images["output"].copy()
        if self._buffers:
            self._buffers["output"].read(0, output.nbytes, output)
        return output

    def _refused(self) -> None:
        if said := self._device.get_error():
            raise RuntimeError(f"Open Image Denoise: {said}")

    def close(self) -> None:
        """Free the library's memory."""
        if self._filter is not None:
            self._filter.release()
            for buffer in self._buffers.values():
                buffer.release()
            self._device.release()
            self._filter = None
