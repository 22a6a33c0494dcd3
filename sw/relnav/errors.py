# SPDX-License-Identifier: Apache-2.0
"""The errors a user meets: each prints as one line and makes the command line exit 2."""

from __future__ import annotations


def one_line(text: object) -> str:
    """text with every run of white space made one blank."""
    return " ".join(str(text).split())


class RelnavError(Exception):
    """Anything the user can put right."""

    def __init__(self, reason: object) -> None:
        super().__init__(one_line(reason))


class InputError(RelnavError, ValueError):
    """Input that no backend can take: names the file, the row and the reason."""


class IgnoredWarning(UserWarning):
    """A file has columns or arrays that nobody asks for: perhaps a name is misspelt."""


class BackendError(RelnavError):
    """A backend that cannot run: a tool or a part of the package is missing, or the simulation failed."""


class UpsetError(BackendError):
    """The core or the way to it was upset, by radiation say: what was read is not to be believed.

    CoreDriver.recover makes the core ready for the frame to be given again.
    """
