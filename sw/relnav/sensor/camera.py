# SPDX-License-Identifier: Apache-2.0
"""A pinhole camera and the look of the ground: Lambertian sun, fractal albedo."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from .mounting import Mounting
from .raycast import RayCaster
from .terrain import Terrain
from .trajectory import BodyPose

Array = NDArray[np.float64]
Image = NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class Pinhole:
    """A pixel grid behind a pinhole; pixel (0, 0) has its centre at u = v = 0. Square pixels.

    Args:
        width, height: pixels. fov_deg: horizontal field of view.
    """

    width: int = 480
    height: int = 360
    fov_deg: float = 50.0

    @property
    def focal(self) -> float:
        """Focal length, pixels."""
        return float(self.width / 2 / np.tan(np.deg2rad(self.fov_deg) / 2))

    def directions(self, uv: Array) -> Array:
        """Rays (..., 3) through pixel coordinates (..., 2), of unit depth (z = 1), sensor frame."""
        x = (uv[..., 0] - (self.width - 1) / 2) / self.focal
        y = (uv[..., 1] - (self.height - 1) / 2) / self.focal
        return np.stack([x, y, np.ones_like(x)], axis=-1)

    def project(self, points: Array) -> Array:
        """Pixel coordinates (..., 2) of points (..., 3) m in the sensor frame, z > 0."""
        centre = np.array([(self.width - 1) / 2, (self.height - 1) / 2])
        return np.asarray(points[..., :2] / points[..., 2:] * self.focal + centre)

    def grid(self) -> Array:
        """Rays (height, width, 3) of unit depth through every pixel's centre."""
        u, v = np.meshgrid(np.arange(self.width, dtype=float), np.arange(self.height, dtype=float))
        return self.directions(np.stack([u, v], axis=-1))


class Ground:
    """What the terrain looks like: brightness at any place, band-limited to the pixel's footprint.

    Elevation data is far coarser than a pixel, so octaves of noise fixed to the ground are added: to the
    albedo, and, below four posts of the grid, to the slopes that the sun lights (for the eye alone: the
    LiDAR meets the mesh as it is). Octaves below 3 pixels fade out, which keeps the image free of aliasing
    and the features repeatable.
    """

    TILE = 512
    TEXELS_PER_WAVE = 8.0
    OCTAVES = 11
    ALBEDO_CONTRAST = 0.09  # of ln(albedo), an octave
    SLOPE_CONTRAST = 0.07  # rise over run, an octave

    def __init__(self, terrain: Terrain, seed: int, sun_azimuth_deg: float = 130.0, sun_up_deg: float = 34.0):
        self._terrain = terrain
        azimuth, up = np.deg2rad(sun_azimuth_deg), np.deg2rad(sun_up_deg)
        self._sun = np.array([np.cos(azimuth) * np.cos(up), np.sin(azimuth) * np.cos(up), np.sin(up)])
        rng = np.random.default_rng([seed, 1])
        self._tile = _band_noise(rng, self.TILE, self.TEXELS_PER_WAVE)
        self._shift = rng.uniform(0.0, self.TILE, (self.OCTAVES, 2))
        self._turn = rng.uniform(0.0, 2 * np.pi, self.OCTAVES)
        self._slopes = [slope.astype(np.float32) for slope in terrain.slope]

    def brightness(self, xy: Array, footprint: Array) -> Array:
        """Radiance (h, w), about 0 to 1, at world places (h, w, 2) m seen by pixels (h, w) m wide."""
        albedo, tilt = self._texture(xy, footprint)
        light = self._sunlight(xy, tilt)
        radiance: Array = 0.46 * np.exp(albedo) * (0.10 + 0.90 * light)
        return radiance

    def _sunlight(self, xy: Array, tilt: Array) -> Array:
        """Cosine of the sun's incidence, 1 on level ground; tilt: extra slope (h, w) towards the sun."""
        column, row = (axis.astype(np.float32) for axis in self._terrain.index_of(xy))
        dz_dx, dz_dy = (
            cv2.remap(slope, column, row, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
            for slope in self._slopes
        )
        level = float(np.hypot(self._sun[0], self._sun[1]))
        facing = self._sun[2] - self._sun[0] * dz_dx - self._sun[1] * dz_dy + level * tilt
        light: Array = np.maximum(facing, 0.0) / np.sqrt(1.0 + dz_dx**2 + dz_dy**2 + tilt**2) / self._sun[2]
        return light

    def _texture(self, xy: Array, footprint: Array) -> tuple[Array, Array]:
        """ln(albedo) and slope towards the sun, (h, w) each, of the octaves that the pixels resolve."""
        albedo, tilt = np.zeros(xy.shape[:-1]), np.zeros(xy.shape[:-1])
        wave = self._terrain.span / 8.0
        for shift, turn in zip(self._shift, self._turn, strict=True):
            fade = np.clip(np.log2(wave / (3.0 * footprint)), 0.0, 1.0)
            if np.any(fade > 0):
                albedo += self.ALBEDO_CONTRAST * fade * self._octave(xy, wave, shift, turn)
                if wave < 4.0 * self._terrain.spacing:
                    # height h = noise * SLOPE_CONTRAST * wave / 2 pi; its slope by a difference of wave / 8
                    step = wave / 8.0 * self._sun[:2] / np.hypot(self._sun[0], self._sun[1])
                    ahead, behind = (self._octave(xy + way * step, wave, shift, turn) for way in (1, -1))
                    rise = ahead - behind
                    tilt -= self.SLOPE_CONTRAST * fade * rise * (4.0 / (2.0 * np.pi))
            wave /= 2.0
        return albedo, tilt

    def _octave(self, xy: Array, wave: float, shift: Array, turn: float) -> NDArray[np.float32]:
        """Unit-variance noise (h, w) of one wavelength, m, at world places (h, w, 2)."""
        c, s = np.cos(turn), np.sin(turn)
        texel = self.TEXELS_PER_WAVE / wave
        u = np.mod((c * xy[..., 0] - s * xy[..., 1]) * texel + shift[0], self.TILE)
        v = np.mod((s * xy[..., 0] + c * xy[..., 1]) * texel + shift[1], self.TILE)
        u32, v32 = u.astype(np.float32), v.astype(np.float32)
        noise = cv2.remap(self._tile, u32, v32, cv2.INTER_LINEAR, borderMode=cv2.BORDER_WRAP)
        return np.asarray(noise, dtype=np.float32)


def _band_noise(rng: np.random.Generator, size: int, texels_per_wave: float) -> NDArray[np.float32]:
    """Periodic noise (size, size), unit variance, of about an octave around one wavelength."""
    frequency = np.hypot(np.fft.fftfreq(size)[:, None], np.fft.fftfreq(size)[None, :]) * texels_per_wave
    with np.errstate(divide="ignore"):
        band = np.exp(-0.5 * (np.log2(frequency) / 0.5) ** 2)
    noise = np.fft.ifft2(np.fft.fft2(rng.standard_normal((size, size))) * band).real
    return np.asarray(noise / noise.std(), dtype=np.float32)


@dataclass(frozen=True, eq=False)
class Camera:
    """A monochrome 8-bit camera.

    Args:
        pixel_noise: standard deviation, grey levels.
    """

    pinhole: Pinhole
    mounting: Mounting
    pixel_noise: float = 2.0

    def image(self, caster: RayCaster, ground: Ground, body: BodyPose, rng: np.random.Generator) -> Image:
        """What the camera sees: (height, width) grey levels, sky black."""
        rays = self.mounting.directions_to_body(self.pinhole.grid()) @ body.rotation.T
        eye = body.to_world(self.mounting.position)
        depth = caster.cast(eye, rays)
        seen = np.isfinite(depth)
        depth = np.where(seen, depth, np.nanmedian(depth) if seen.any() else 1.0)
        places = eye + depth[..., None] * rays
        radiance = np.where(seen, ground.brightness(places[..., :2], depth / self.pinhole.focal), 0.0)
        levels = 255.0 * radiance + self.pixel_noise * rng.standard_normal(radiance.shape)
        image: Image = np.clip(np.rint(levels), 0, 255).astype(np.uint8)
        return image
