# SPDX-License-Identifier: Apache-2.0
"""Simulated sensors and the image pipeline: terrain -> camera image and LiDAR scan -> matched 3-D points."""
