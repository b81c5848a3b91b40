"""Stone, concrete, sand, ice: isotropic mineral surfaces."""

import numpy as np

from . import Painted
from .noise import cells, mix, ramp, smooth, spectral, unit

Rgb = tuple[float, float, float]


def marble(size: int, name: str, ground: Rgb, cloud: Rgb, vein: Rgb) -> Painted:
    """Polished marble: soft clouds, and veins where warped noise crosses zero."""
    soft = unit(spectral(size, 1.9, name + "soft"))
    rgb = mix(ground, cloud, 0.75 * soft)
    for octave, (slope, width, strength) in enumerate(((1.75, 0.07, 0.75), (1.6, 0.045, 0.5), (1.4, 0.03, 0.25))):
        crossing = np.abs(spectral(size, slope, f"{name}vein{octave}", low=1.0 + octave))
        presence = smooth(-0.2, 1.4, spectral(size, 2.0, f"{name}where{octave}"))
        line = np.exp(-((crossing / width) ** 2)) + 0.35 * np.exp(-((crossing / (5.0 * width)) ** 2))
        rgb = mix(rgb, vein, np.clip(strength * presence * line, 0.0, 1.0))
    return Painted(rgb, np.full((size, size), 0.9))


def concrete(size: int, name: str, tone: Rgb, contrast: float = 1.0) -> Painted:
    """Trowelled concrete: clouds, fine grit, a few pin holes."""
    broad = spectral(size, 1.7, name + "broad")
    fine = spectral(size, 0.45, name + "fine", low=20.0)
    holes = smooth(3.0, 3.9, spectral(size, 0.9, name + "holes", low=30.0))
    value = 1.0 + contrast * (0.055 * broad + 0.035 * fine) - 0.3 * holes
    rgb = np.asarray(tone) * value[..., None]
    return Painted(rgb, np.clip(0.75 + 0.05 * fine + 0.03 * broad - 0.6 * holes, 0.0, 1.0))


def asphalt(size: int, name: str, tone: Rgb) -> Painted:
    """Chippings in bitumen."""
    near, far, number = cells(size, 56, name)
    edge = smooth(0.02, 0.3, far - near)
    stone = 0.55 + 0.9 * number**3
    rgb = np.asarray(tone) * (0.45 + 0.55 * edge * stone)[..., None]
    rgb = rgb * (1.0 + 0.08 * spectral(size, 1.8, name + "broad"))[..., None]
    return Painted(rgb, np.clip(edge * (0.5 + 0.5 * number), 0.0, 1.0))


def sand(size: int, name: str, light: Rgb, dark: Rgb) -> Painted:
    """Fine grains and soft wind ripples."""
    grain = spectral(size, 0.15, name + "grain", low=30.0)
    dunes = spectral(size, 1.8, name + "dunes", stretch=(1.0, 1.0))
    v = np.arange(size)[:, None] / size
    ripple = np.sin(2.0 * np.pi * (6.0 * v + 0.35 * spectral(size, 2.3, name + "bend")))
    tone = np.clip(0.45 + 0.10 * grain + 0.10 * dunes + 0.06 * ripple, 0.0, 1.0)
    rgb = ramp([(0.0, dark), (1.0, light)], tone)
    return Painted(rgb, np.clip(0.5 + 0.22 * ripple + 0.06 * grain + 0.08 * dunes, 0.0, 1.0))


def slabs(size: int, name: str, light: Rgb, dark: Rgb, joint: Rgb, count: int = 5) -> Painted:
    """Irregular paving stones with mortar joints."""
    near, far, number = cells(size, count, name)
    rough = spectral(size, 1.2, name + "rough", low=3.0)
    inside = smooth(0.03, 0.09, far - near + 0.006 * rough)
    tone = np.clip(0.25 + 0.5 * number + 0.10 * rough, 0.0, 1.0)
    rgb = mix(joint, ramp([(0.0, dark), (1.0, light)], tone), inside)
    return Painted(rgb, np.clip(inside * (0.75 + 0.06 * rough), 0.0, 1.0))


def granite(size: int, name: str, base: Rgb, fleck: Rgb, speck: Rgb) -> Painted:
    """Mineral flecks of three tones."""
    _, _, first = cells(size, 64, name)
    _, _, second = cells(size, 84, name + "b")
    rgb = mix(base, fleck, smooth(0.55, 0.75, first))
    rgb = mix(rgb, speck, smooth(0.82, 0.9, second))
    rgb = rgb * (1.0 + 0.06 * spectral(size, 1.6, name + "broad"))[..., None]
    return Painted(rgb, np.full((size, size), 0.9))


def ice(size: int, name: str) -> Painted:
    """Frozen water: pale, with hairline cracks and trapped clouds."""
    soft = unit(spectral(size, 1.9, name + "soft"))
    rgb = mix((0.70, 0.83, 0.90), (0.90, 0.96, 0.985), soft)
    near, far, _ = cells(size, 4, name)
    crack = 1.0 - smooth(0.004, 0.022, far - near + 0.03 * np.abs(spectral(size, 1.5, name + "bend")))
    rgb = mix(rgb, (0.97, 0.99, 1.0), 0.8 * crack)
    scratch = smooth(1.8, 3.0, spectral(size, 0.9, name + "scratch", stretch=(1.0, 7.0), low=8.0))
    rgb = mix(rgb, (0.95, 0.98, 1.0), 0.25 * scratch)
    return Painted(rgb, np.clip(0.9 - 0.3 * crack - 0.15 * scratch, 0.0, 1.0))


def grass(size: int, name: str, light: Rgb, middle: Rgb, dark: Rgb) -> Painted:
    """Mown lawn seen from above: short blades in all directions over dark ground."""
    blades = np.maximum(
        np.maximum(
            spectral(size, 0.25, name + "a", stretch=(1.0, 4.5), low=14.0),
            spectral(size, 0.25, name + "b", stretch=(4.5, 1.0), low=14.0),
        ),
        np.maximum(
            spectral(size, 0.35, name + "c", low=18.0), spectral(size, 0.3, name + "d", stretch=(1.0, 2.5), low=10.0)
        ),
    )
    blades = (blades - 1.0) / 0.75
    patch = spectral(size, 1.7, name + "patch")
    tone = np.clip(0.45 + 0.22 * blades + 0.07 * patch, 0.0, 1.0)
    rgb = ramp([(0.0, dark), (0.5, middle), (1.0, light)], tone)
    dry = smooth(0.9, 2.4, spectral(size, 1.2, name + "dry", low=3.0))
    rgb = mix(rgb, (0.50, 0.46, 0.27), 0.45 * dry)
    # Thatch of dead blades, and bare soil where nothing grew.
    thatch = smooth(0.3, 1.7, spectral(size, 0.9, name + "thatch", low=5.0))
    rgb = mix(rgb, (0.47, 0.41, 0.26), 0.5 * thatch)
    bare = smooth(1.0, 1.9, spectral(size, 1.3, name + "bare", low=4.0) - 0.25 * blades)
    return Painted(mix(rgb, (0.27, 0.21, 0.14), 0.7 * bare), np.clip(0.45 + 0.2 * blades - 0.3 * bare, 0.0, 1.0))
