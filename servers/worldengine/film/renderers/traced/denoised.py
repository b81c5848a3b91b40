"""Take the noise out of a traced picture with Open Image Denoise."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

THREADS = min(os.cpu_count() or 1, 8)


class Denoiser:
    """Denoises pictures of one size; the same input always gives the same output."""

    def __init__(self, width: int, height: int) -> None:
        import numpy as np

        self._filter: Any = None
        try:
            import pyoidn
        except (ImportError, OSError):
            return  # without the library a picture stays as noisy as it is
        self._images = {
            name: np.zeros((height, width, 3), np.float32) for name in ("color", "albedo", "normal", "output")
        }
        self._device = pyoidn.Device()
        self._device.set_int("numThreads", THREADS)
        self._device.set_bool("setAffinity", False)
        self._device.commit()
        self._filter = pyoidn.Filter(self._device)
        for name, image in self._images.items():
            self._filter.set_image(name, image, pyoidn.OIDN_FORMAT_FLOAT3)
        self._filter.set_bool("hdr", True)
        self._filter.set_quality(pyoidn.OIDN_QUALITY_FAST)
        self._filter.commit()

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
        self._filter.execute()
        if said := self._device.get_error():
            raise RuntimeError(f"Open Image Denoise: {said}")
        return self._images["output"].copy()

    def close(self) -> None:
        """Free the library's memory."""
        if self._filter is not None:
            self._filter.release()
            self._device.release()
            self._filter = None
