# SPDX-License-Identifier: Apache-2.0
"""Short programs on top of relnav, each with a picture as its result: README.md."""
