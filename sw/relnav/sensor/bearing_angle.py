# SPDX-License-Identifier: Apache-2.0
"""Bearing-angle images: a picture made of the point cloud alone, no camera needed.

Source: OLTAE paper, "Software simulation pipeline"; C.-C. Lin et al., EURASIP J. Adv. Signal Process. 2017:1.
"""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from .lidar import Lidar

Array = NDArray[np.float64]
Image = NDArray[np.uint8]

SMOOTHING = 1.6  # pixels; range noise over one pixel's baseline would drown the relief


def bearing_angles(lidar: Lidar, ranges: Array) -> Array:
    """The angle (height, width), rad, at each point between a beam and the line to its diagonal neighbour.

    angle = acos((r - r' cos d) / sqrt(r^2 + r'^2 - 2 r r' cos d)), d the angle between the two beams.
    The beams taken are the diagonal neighbours on either side, so that the angle belongs to the pixel
    between them (one-sided, every feature would sit a pixel off). NaN where a return is missing.
    """
    smooth = _smoothed(ranges)
    rays = lidar.pinhole.grid()
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    before, after = (slice(None, -2), slice(None, -2)), (slice(2, None), slice(2, None))
    near, far = smooth[after], smooth[before]
    cosine = np.einsum("ijk,ijk->ij", rays[after], rays[before])
    third_side = np.sqrt(np.maximum(near**2 + far**2 - 2.0 * near * far * cosine, 0.0))
    with np.errstate(invalid="ignore", divide="ignore"):
        angle = np.arccos(np.clip((near - far * cosine) / third_side, -1.0, 1.0))
    return np.pad(angle, 1, mode="edge")


def bearing_angle_image(lidar: Lidar, ranges: Array) -> Image:
    """Bearing angles stretched to 8 bit, local contrast evened out; (height, width), 0 where no return."""
    angle = bearing_angles(lidar, ranges)
    known = np.isfinite(angle)
    if not known.any():
        return np.zeros(angle.shape, dtype=np.uint8)
    low, high = np.percentile(angle[known], [0.5, 99.5])
    grey = np.clip((angle - low) / max(high - low, 1e-12), 0.0, 1.0)
    image = np.where(known, np.rint(255.0 * np.nan_to_num(grey)), 0).astype(np.uint8)
    return np.asarray(cv2.createCLAHE(clipLimit=3.0, tileGridSize=(6, 6)).apply(image), dtype=np.uint8)


def _smoothed(ranges: Array) -> Array:
    """Gaussian smoothing that ignores missing returns and leaves them missing."""
    known = np.isfinite(ranges)
    total = cv2.GaussianBlur(np.where(known, ranges, 0.0), (0, 0), SMOOTHING)
    weight = cv2.GaussianBlur(known.astype(np.float64), (0, 0), SMOOTHING)
    return np.where(known, total / np.maximum(weight, 1e-9), np.nan)
