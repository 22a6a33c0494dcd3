# SPDX-License-Identifier: Apache-2.0
"""Matched points from a CSV or .npz file, with errors that name the file and the row.

A row is counted from 1, without the header and blank lines; its line in the file (or its numpy index) is
given beside it. Rows with the same label in the column `frame` make one frame, wherever they stand; frames
come in the order in which their labels first appear.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from .attitude import FloatArray
from .errors import InputError, one_line

POINT_COLUMNS = ("ax", "ay", "az", "bx", "by", "bz")
LABEL_LENGTH = 64


@dataclass(frozen=True, eq=False)
class Frame:
    """Matched points of one frame, in any length unit.

    a, b:    (n, 3), finite
    w:       (n,) weights >= 0, finite, the inverse variances up to one factor; None for unweighted
    source:  the file; rows: (n,) each point's row there (1-based); lines: (n,) its line in a CSV
    """

    name: str | int
    a: FloatArray
    b: FloatArray
    w: FloatArray | None = None
    source: str = ""
    rows: npt.NDArray[np.int64] | None = None
    lines: npt.NDArray[np.int64] | None = None

    def error(self, point: int, reason: str) -> InputError:
        """The error that names the file and the row of the given point (0-based)."""
        row = point + 1 if self.rows is None else int(self.rows[point])
        line = None if self.lines is None else int(self.lines[point])
        return InputError(f"{self.source or f'frame {self.name}'}: {_place(row, line)}: {reason}")


def read_frames(path: str | Path) -> list[Frame]:
    """The frames of a CSV (header ax,ay,az,bx,by,bz) or .npz (a, b (n, 3)), both with optional w, frame.

    Raises InputError, one line, for anything that is not such a file or holds a value that is not finite.
    """
    path = Path(path)
    source = one_line(path)
    try:
        data = path.read_bytes()
    except OSError as error:
        raise InputError(f"{source}: cannot be read: {error.strerror or error}") from None
    if data[:2] == b"PK" or path.suffix.lower() == ".npz":
        return _read_npz(source, io.BytesIO(data))
    return _read_csv(source, data)


def make_frame(
    a: npt.ArrayLike, b: npt.ArrayLike, w: npt.ArrayLike | None = None, name: str | int = 0
) -> Frame:
    """A checked Frame from arrays (n, 3), (n, 3) and optional (n,)."""
    first, second = _points("a", a, ""), _points("b", b, "")
    if len(first) != len(second):
        raise InputError(f"a has {len(first)} points, b has {len(second)}")
    frame = Frame(name, first, second, None if w is None else _weights(w, len(first), ""))
    _check(frame)
    return frame


# ---- CSV


def _read_csv(source: str, data: bytes) -> list[Frame]:
    lines, numbers = _lines(source, data)
    if not lines:
        raise InputError(f"{source}: empty file; expected a header {','.join(POINT_COLUMNS)}")
    columns = _header(source, lines[0], numbers[0])
    if len(lines) == 1:
        raise InputError(f"{source}: no points after the header")
    table = _parse(source, lines[1:], numbers[1:], columns)
    rows = np.arange(1, len(lines), dtype=np.int64)
    a = np.stack([table[c] for c in ("ax", "ay", "az")], axis=1)
    b = np.stack([table[c] for c in ("bx", "by", "bz")], axis=1)
    whole = Frame(0, a, b, table.get("w"), source, rows, numbers[1:])
    _check(whole)
    return _split(whole, table.get("frame"))


def _lines(source: str, data: bytes) -> tuple[list[str], npt.NDArray[np.int64]]:
    """The lines that are not blank, and their numbers in the file (1-based)."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise InputError(f"{source}: line {line}: not UTF-8 text (byte {data[error.start]:#04x})") from None
    if "\r" in text:
        text = text.replace("\r\n", "\n").replace("\r", "\n")
    every = text.split("\n")
    kept = [i for i, line in enumerate(every) if line and not line.isspace()]
    lines = every if len(kept) == len(every) else [every[i] for i in kept]
    return lines, np.asarray(kept, dtype=np.int64) + 1


def _header(source: str, line: str, number: int) -> list[str]:
    """Column names; the points' must all be there, none of ours twice; columns of other names are ignored."""
    columns = [field.strip() for field in next(csv.reader([line]))]
    missing = [name for name in POINT_COLUMNS if name not in columns]
    if missing:
        raise InputError(f"{source}: header (line {number}): missing column {', '.join(missing)}")
    for name in (*POINT_COLUMNS, "w", "frame"):
        if columns.count(name) > 1:
            raise InputError(f"{source}: header (line {number}): column {name} stands there twice")
    return columns


def _parse(
    source: str, lines: list[str], numbers: npt.NDArray[np.int64], columns: list[str]
) -> dict[str, npt.NDArray[Any]]:
    """The known columns as arrays. numpy's parser is fast but loses the place: on its error, go by line."""
    for label in ("i8", f"U{LABEL_LENGTH}") if "frame" in columns else ("i8",):
        kinds = {"frame": label, "w": "f8"} | dict.fromkeys(POINT_COLUMNS, "f8")
        # The name is the column's number: an unknown column may have any name, or none.
        dtype = np.dtype([(str(i), kinds.get(name, "U1")) for i, name in enumerate(columns)])
        try:
            table = np.loadtxt(lines, dtype=dtype, delimiter=",", comments=None, quotechar='"', ndmin=1)
        except ValueError:
            continue
        if len(table) == len(lines):
            return {name: table[str(i)] for i, name in enumerate(columns) if name in kinds}
    return _parse_slowly(source, lines, numbers, columns)


def _parse_slowly(
    source: str, lines: list[str], numbers: npt.NDArray[np.int64], columns: list[str]
) -> dict[str, npt.NDArray[Any]]:
    """The same, one line at a time: names the first bad row, and takes what numpy is too strict for."""
    wanted = [(i, name) for i, name in enumerate(columns) if name in (*POINT_COLUMNS, "w", "frame")]
    table: dict[str, list[Any]] = {name: [] for _, name in wanted}
    for row, (line, number) in enumerate(zip(lines, numbers, strict=True), start=1):
        place = f"{source}: {_place(row, int(number))}"
        try:
            fields = next(csv.reader([line], strict=True))
        except csv.Error as error:
            raise InputError(f"{place}: {error}") from None
        if len(fields) != len(columns):
            raise InputError(f"{place}: {len(fields)} fields, the header has {len(columns)}")
        for i, name in wanted:
            field = fields[i].strip()
            if name == "frame":
                table[name].append(field)
                continue
            try:
                if "_" in field:  # float() takes 1_000; numpy and everyone else do not
                    raise ValueError
                table[name].append(float(field))
            except ValueError:
                raise InputError(f"{place}: {name} = {_shown(field)} is not a number") from None
    return {
        name: np.asarray(values, dtype=str if name == "frame" else float) for name, values in table.items()
    }


# ---- npz


def _read_npz(source: str, file: io.BytesIO) -> list[Frame]:
    try:
        archive = np.load(file, allow_pickle=False)
        if not isinstance(archive, np.lib.npyio.NpzFile):
            raise InputError(f"{source}: a single array; expected an .npz with arrays a and b")
        with archive:
            arrays = {
                name: _array(source, archive, name) for name in ("a", "b", "w", "frame") if name in archive
            }
    except InputError:
        raise
    except Exception as error:  # a damaged archive raises from zipfile, zlib, struct, ast and numpy alike
        raise InputError(f"{source}: not a readable .npz: {error}") from None
    for name in ("a", "b"):
        if name not in arrays:
            raise InputError(f"{source}: missing array {name}")
    a, b = (_points(name, arrays[name], f"{source}: ") for name in ("a", "b"))
    if len(a) != len(b):
        raise InputError(f"{source}: a has {len(a)} points, b has {len(b)}")
    if len(a) == 0:
        raise InputError(f"{source}: no points")
    w = _weights(arrays["w"], len(a), f"{source}: ") if "w" in arrays else None
    whole = Frame(0, a, b, w, source, np.arange(1, len(a) + 1, dtype=np.int64))
    _check(whole)
    labels = arrays.get("frame")
    if labels is not None and (labels.shape != (len(a),) or labels.dtype.kind not in "iufUS"):
        found = f"shape {labels.shape} of {labels.dtype}"
        raise InputError(f"{source}: array frame has {found}, expected ({len(a)},) of labels")
    return _split(whole, labels)


def _array(source: str, archive: Any, name: str) -> npt.NDArray[Any]:
    """One array of the archive; Python objects are never unpickled."""
    try:
        return np.asarray(archive[name])
    except ValueError as error:
        if "allow_pickle" in str(error):
            raise InputError(f"{source}: array {name} holds Python objects, which are never loaded") from None
        raise


def _points(name: str, values: npt.ArrayLike, prefix: str) -> FloatArray:
    array = _real(name, values, prefix)
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"{prefix}{name} has shape {array.shape}, expected (n, 3)")
    return array


def _weights(values: npt.ArrayLike, n: int, prefix: str) -> FloatArray:
    array = _real("w", values, prefix)
    if array.shape != (n,):
        raise InputError(f"{prefix}w has shape {array.shape}, expected ({n},)")
    return array


def _real(name: str, values: npt.ArrayLike, prefix: str) -> FloatArray:
    try:
        array = np.asarray(values)
    except ValueError:
        raise InputError(f"{prefix}{name} is ragged, expected an array") from None
    if array.dtype.kind not in "iuf":
        raise InputError(f"{prefix}{name} holds {array.dtype}, expected real numbers")
    return array.astype(np.float64)


# ---- both


def _check(frame: Frame) -> None:
    """Every value finite, every weight also not negative."""
    columns = [*zip(POINT_COLUMNS, (*frame.a.T, *frame.b.T), strict=True)]
    if frame.w is not None:
        columns.append(("w", frame.w))
    bad = [
        (int(np.argmin(good)), name, values)
        for name, values in columns
        if not (good := np.isfinite(values)).all()
    ]
    if bad:
        row, name, values = min(bad, key=lambda item: item[0])
        raise frame.error(row, f"{name} = {float(values[row])!r} is not finite")
    if frame.w is not None and (frame.w < 0).any():
        row = int(np.argmax(frame.w < 0))
        raise frame.error(row, f"w = {float(frame.w[row])!r} is negative")


def _split(whole: Frame, labels: npt.NDArray[Any] | None) -> list[Frame]:
    """One Frame a label, in the order of first appearance, the points in the file's order."""
    if labels is None:
        return [whole]
    if labels.dtype.kind == "S":
        labels = np.char.decode(labels, "utf-8", "replace")
    distinct, first, inverse = np.unique(labels, return_index=True, return_inverse=True)
    names = _names(whole, distinct, first)
    groups: dict[str | int, list[npt.NDArray[np.int64]]] = {}
    by_label = np.split(np.argsort(inverse, kind="stable"), np.cumsum(np.bincount(inverse))[:-1])
    for k in np.argsort(first):  # two spellings of one number (1 and 1.0) are one frame
        groups.setdefault(names[k], []).append(by_label[k])
    return [_take(whole, name, np.sort(np.concatenate(parts))) for name, parts in groups.items()]


def _names(whole: Frame, distinct: npt.NDArray[Any], first: npt.NDArray[np.int64]) -> list[str | int]:
    """Labels as int where all are whole numbers, else as text."""
    texts = [str(label).strip() for label in distinct.tolist()]
    for text, row in sorted(zip(texts, first.tolist(), strict=True), key=lambda pair: pair[1]):
        if not text:
            raise whole.error(row, "frame is empty")
        if text.lower().lstrip("+-") in ("nan", "inf", "infinity"):
            raise whole.error(row, f"frame = {text} is not a label")
        if len(text) >= LABEL_LENGTH and whole.lines is not None:
            raise whole.error(row, f"frame has a label of {LABEL_LENGTH} characters or more")
    numbers = list(_whole_numbers(texts))
    return numbers if len(numbers) == len(texts) else list(texts)


def _whole_numbers(texts: list[str]) -> Iterator[str | int]:
    for text in texts:
        try:
            yield int(text)
        except ValueError:
            try:
                value = float(text)
            except ValueError:
                return
            if not math.isfinite(value) or value != int(value):
                return
            yield int(value)


def _take(whole: Frame, name: str | int, index: npt.NDArray[np.int64]) -> Frame:
    assert whole.rows is not None
    return Frame(
        name,
        whole.a[index],
        whole.b[index],
        None if whole.w is None else whole.w[index],
        whole.source,
        whole.rows[index],
        None if whole.lines is None else whole.lines[index],
    )


def _place(row: int, line: int | None) -> str:
    return f"row {row} (index {row - 1})" if line is None else f"row {row} (line {line})"


def _shown(field: str) -> str:
    """A field as it may stand in a message."""
    return repr(field if len(field) <= 40 else field[:37] + "...")
