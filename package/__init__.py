# SPDX-License-Identifier: Apache-2.0
"""What other people's tools need to take the cores in: written from the sources by `python -m package`."""
