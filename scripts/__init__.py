# SPDX-License-Identifier: Apache-2.0
"""Scripts that are not part of the package: set-up, lint, and what fills the documents' tables."""
