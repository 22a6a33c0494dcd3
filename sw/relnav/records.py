# SPDX-License-Identifier: Apache-2.0
"""Measurements from a CSV or .npz file, for any core, with errors that name the file and the row.

A row is counted from 1, without the header and blank lines; its line in the file (or its numpy index) is
given beside it. Rows with the same label in the column `frame` make one frame, wherever they stand; frames
come in the order in which their labels first appear.
"""

from __future__ import annotations

import csv
import io
import math
import warnings
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from .attitude import FloatArray
from .errors import IgnoredWarning, InputError, one_line

LABEL_LENGTH = 64
SHOWN = 5  # unknown names in a warning
WEIGHT, LABEL = "w", "frame"  # every layout may have these columns or arrays


@dataclass(frozen=True)
class Layout:
    """What a core's file holds.

    arrays:  name of an .npz array -> names of its columns in a CSV: three for (n, 3), one for (n,)
    noun:    what a row is, in the plural
    square:  name of an optional .npz array (n, n), or ""
    """

    arrays: dict[str, tuple[str, ...]]
    noun: str = "rows"
    square: str = ""

    @property
    def columns(self) -> tuple[str, ...]:
        """All columns a CSV must have."""
        return tuple(column for columns in self.arrays.values() for column in columns)

    @property
    def names(self) -> str:
        """The names of the arrays, for a message."""
        *some, last = self.arrays
        return f"{', '.join(some)} and {last}"


class Placed:
    """A frame that knows where its rows came from. rows: (n,) row in the file (1-based); lines: (n,) line."""

    name: str | int
    source: str
    rows: npt.NDArray[np.int64] | None
    lines: npt.NDArray[np.int64] | None

    def error(self, point: int, reason: str) -> InputError:
        """The error that names the file and the row of the given point (0-based)."""
        row = point + 1 if self.rows is None else int(self.rows[point])
        line = None if self.lines is None else int(self.lines[point])
        return InputError(f"{self.origin}: {_place(row, line)}: {reason}")

    @property
    def origin(self) -> str:
        """The file, or the frame where there is none."""
        return self.source or f"frame {self.name}"


@dataclass(frozen=True, eq=False)
class Records(Placed):
    """Rows of one frame: arrays as the layout names them, (n, 3) or (n,), all finite; w (n,) >= 0 or None."""

    layout: Layout
    name: str | int
    arrays: dict[str, FloatArray]
    w: FloatArray | None = None
    square: FloatArray | None = None
    source: str = ""
    rows: npt.NDArray[np.int64] | None = None
    lines: npt.NDArray[np.int64] | None = None

    @property
    def n(self) -> int:
        """Rows."""
        return len(next(iter(self.arrays.values())))


def read_records(path: str | Path, layout: Layout) -> list[Records]:
    """The frames of a CSV (with a header) or .npz, both with optional w, frame.

    Raises InputError, one line, for anything that is not such a file or holds a value that is not finite.
    """
    path = Path(path)
    source = one_line(path)
    try:
        data = path.read_bytes()
        if data[:2] == b"PK" or path.suffix.lower() == ".npz":
            return _read_npz(source, io.BytesIO(data), layout)
        return _read_csv(source, data, layout)
    except OSError as error:
        raise InputError(f"{source}: cannot be read: {error.strerror or error}") from None
    except MemoryError:
        raise InputError(f"{source}: too large for the memory there is") from None


def make_records(
    layout: Layout,
    arrays: Mapping[str, npt.ArrayLike],
    w: npt.ArrayLike | None = None,
    square: npt.ArrayLike | None = None,
    name: str | int = 0,
) -> Records:
    """Checked Records from arrays (n, 3) and (n,), w (n,), square (n, n). Raises InputError."""
    return _checked(layout, arrays, w, square, "", name)


def _checked(
    layout: Layout,
    arrays: Mapping[str, npt.ArrayLike],
    w: npt.ArrayLike | None,
    square: npt.ArrayLike | None,
    source: str,
    name: str | int = 0,
) -> Records:
    """Arrays of the right kind, shape and length, their values checked too. A file has at least one row."""
    prefix = f"{source}: " if source else ""
    checked = {
        key: _array(key, arrays[key], (None,) if len(columns) == 1 else (None, len(columns)), prefix)
        for key, columns in layout.arrays.items()
    }
    (first, values), *others = checked.items()
    n = len(values)
    for key, array in others:
        if len(array) != n:
            raise InputError(f"{prefix}{first} has {n} {layout.noun}, {key} has {len(array)}")
    if source and n == 0:
        raise InputError(f"{prefix}no {layout.noun}")
    weights = None if w is None else _array(WEIGHT, w, (n,), prefix)
    whole = None if square is None else _array(layout.square, square, (n, n), prefix)
    rows = np.arange(1, n + 1, dtype=np.int64)
    records = Records(layout, name, checked, weights, whole, source, rows)
    _check(records)
    return records


# ---- CSV


def _read_csv(source: str, data: bytes, layout: Layout) -> list[Records]:
    lines, numbers = _lines(source, data)
    if not lines:
        raise InputError(f"{source}: empty file; expected a header {','.join(layout.columns)}")
    columns = _header(source, lines[0], numbers[0], layout)
    if len(lines) == 1:
        raise InputError(f"{source}: no {layout.noun} after the header")
    table = _parse(source, lines[1:], numbers[1:], columns, layout)
    rows = np.arange(1, len(lines), dtype=np.int64)
    arrays = {
        name: table[names[0]] if len(names) == 1 else np.stack([table[c] for c in names], axis=1)
        for name, names in layout.arrays.items()
    }
    whole = Records(layout, 0, arrays, table.get(WEIGHT), None, source, rows, numbers[1:])
    _check(whole)
    return _split(whole, table.get(LABEL))


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


def _header(source: str, line: str, number: int, layout: Layout) -> list[str]:
    """Column names; the layout's must all be there, none of ours twice. Others: a warning."""
    try:
        columns = [field.strip() for field in next(csv.reader([line]))]
    except csv.Error as error:
        raise InputError(f"{source}: header (line {number}): {error}") from None
    missing = [name for name in layout.columns if name not in columns]
    if missing:
        raise InputError(f"{source}: header (line {number}): missing column {', '.join(missing)}")
    for name in (*layout.columns, WEIGHT, LABEL):
        if columns.count(name) > 1:
            raise InputError(f"{source}: header (line {number}): column {name} stands there twice")
    _ignored(source, "column", columns, (*layout.columns, WEIGHT, LABEL))
    return columns


def _parse(
    source: str, lines: list[str], numbers: npt.NDArray[np.int64], columns: list[str], layout: Layout
) -> dict[str, npt.NDArray[Any]]:
    """The known columns as arrays. numpy's parser is fast but loses the place: on its error, go by line."""
    for label in ("i8", f"U{LABEL_LENGTH}") if LABEL in columns else ("i8",):
        kinds = {LABEL: label, WEIGHT: "f8"} | dict.fromkeys(layout.columns, "f8")
        # The name is the column's number: an unknown column may have any name, or none.
        dtype = np.dtype([(str(i), kinds.get(name, "U1")) for i, name in enumerate(columns)])
        try:
            table = np.loadtxt(lines, dtype=dtype, delimiter=",", comments=None, quotechar='"', ndmin=1)
        except ValueError:
            continue
        if len(table) == len(lines):
            return {name: table[str(i)] for i, name in enumerate(columns) if name in kinds}
    return _parse_slowly(source, lines, numbers, columns, layout)


def _parse_slowly(
    source: str, lines: list[str], numbers: npt.NDArray[np.int64], columns: list[str], layout: Layout
) -> dict[str, npt.NDArray[Any]]:
    """The same, one line at a time: names the first bad row, and takes what numpy is too strict for."""
    wanted = [(i, name) for i, name in enumerate(columns) if name in (*layout.columns, WEIGHT, LABEL)]
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
            if name == LABEL:
                table[name].append(field)
                continue
            try:
                if "_" in field:  # float() takes 1_000; numpy and everyone else do not
                    raise ValueError
                table[name].append(float(field))
            except ValueError:
                raise InputError(f"{place}: {name} = {_shown(field)} is not a number") from None
    return {name: np.asarray(values, dtype=str if name == LABEL else float) for name, values in table.items()}


# ---- npz


def _read_npz(source: str, file: io.BytesIO, layout: Layout) -> list[Records]:
    known = (*layout.arrays, WEIGHT, LABEL, *([layout.square] if layout.square else ()))
    try:
        archive = np.load(file, allow_pickle=False)
        if not isinstance(archive, np.lib.npyio.NpzFile):
            raise InputError(f"{source}: a single array; expected an .npz with arrays {layout.names}")
        with archive:
            arrays = {name: _load(source, archive, name) for name in known if name in archive}
            others = archive.files
    except InputError:
        raise
    except Exception as error:  # a damaged archive raises from zipfile, zlib, struct, ast and numpy alike
        # numpy's advice for what is no archive at all is to unpickle it
        reason = "it is no zip archive" if "pickle" in str(error) else error
        raise InputError(f"{source}: not a readable .npz: {reason}") from None
    for name in layout.arrays:
        if name not in arrays:
            raise InputError(f"{source}: missing array {name}")
    _ignored(source, "array", others, known)
    labels = arrays.pop(LABEL, None)
    whole = _checked(
        layout,
        {name: arrays[name] for name in layout.arrays},
        arrays.get(WEIGHT),
        arrays.get(layout.square),
        source,
    )
    if labels is not None and (labels.shape != (whole.n,) or labels.dtype.kind not in "iufUS"):
        found = f"shape {labels.shape} of {labels.dtype}"
        raise InputError(f"{source}: array frame has {found}, expected ({whole.n},) of labels")
    return _split(whole, labels)


def _load(source: str, archive: Any, name: str) -> npt.NDArray[Any]:
    """One array of the archive; Python objects are never unpickled."""
    try:
        return np.asarray(archive[name])
    except ValueError as error:
        if "allow_pickle" in str(error):
            raise InputError(f"{source}: array {name} holds Python objects, which are never loaded") from None
        raise


def _array(name: str, values: npt.ArrayLike, shape: tuple[int | None, ...], prefix: str) -> FloatArray:
    """values as doubles, of the given shape (None: any length)."""
    try:
        array = np.asarray(values)
    except ValueError:
        raise InputError(f"{prefix}{name} is ragged, expected an array") from None
    if array.dtype.kind not in "iuf":
        raise InputError(f"{prefix}{name} holds {array.dtype}, expected real numbers")
    fits = array.ndim == len(shape) and all(
        expected in (None, found) for expected, found in zip(shape, array.shape, strict=True)
    )
    if not fits:
        text = ", ".join("n" if length is None else str(length) for length in shape)
        raise InputError(
            f"{prefix}{name} has shape {array.shape}, expected ({text}{',' if len(shape) == 1 else ''})"
        )
    with np.errstate(over="ignore"):  # beyond double's range: refused as infinite
        return array.astype(np.float64)


# ---- both


def _ignored(source: str, kind: str, names: Iterable[str], known: Iterable[str]) -> None:
    """Warn of what stands in the file and is not used."""
    known = list(known)
    others = [name for name in dict.fromkeys(names) if name and name not in known]
    if others:
        more = f" and {len(others) - SHOWN} more" if len(others) > SHOWN else ""
        what = f"{kind}{'s' if len(others) > 1 else ''} {', '.join(map(_shown, others[:SHOWN]))}{more}"
        warnings.warn(f"{source}: {what} ignored; known are {', '.join(known)}", IgnoredWarning, stacklevel=2)


def _check(records: Records) -> None:
    """Every value finite, every weight also not negative."""
    columns = []
    for name, names in records.layout.arrays.items():
        array = records.arrays[name]
        columns += [*zip(names, array.T if array.ndim == 2 else (array,), strict=True)]
    if records.w is not None:
        columns.append((WEIGHT, records.w))
    bad = [
        (int(np.argmin(good)), name, values)
        for name, values in columns
        if not (good := np.isfinite(values)).all()
    ]
    if bad:
        row, name, values = min(bad, key=lambda item: item[0])
        raise records.error(row, f"{name} = {float(values[row])!r} is not finite")
    if records.w is not None and (records.w < 0).any():
        row = int(np.argmax(records.w < 0))
        raise records.error(row, f"w = {float(records.w[row])!r} is negative")
    if records.square is not None and not np.isfinite(records.square).all():
        row, column = divmod(int(np.argmin(np.isfinite(records.square))), records.n)
        value = float(records.square[row, column])
        raise records.error(row, f"{records.layout.square}[{row}, {column}] = {value!r} is not finite")


def _split(whole: Records, labels: npt.NDArray[Any] | None) -> list[Records]:
    """One Records a label, in the order of first appearance, the rows in the file's order."""
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


def _names(whole: Records, distinct: npt.NDArray[Any], first: npt.NDArray[np.int64]) -> list[str | int]:
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


def _take(whole: Records, name: str | int, index: npt.NDArray[np.int64]) -> Records:
    assert whole.rows is not None
    if whole.square is not None:
        _check_block(whole, index)
    return replace(
        whole,
        name=name,
        arrays={key: array[index] for key, array in whole.arrays.items()},
        w=None if whole.w is None else whole.w[index],
        square=None if whole.square is None else whole.square[np.ix_(index, index)],
        rows=whole.rows[index],
        lines=None if whole.lines is None else whole.lines[index],
    )


def _check_block(whole: Records, index: npt.NDArray[np.int64]) -> None:
    """A frame's rows of the square array must be zero in the columns of other frames."""
    assert whole.square is not None
    rest = whole.square[index].copy()
    rest[:, index] = 0.0
    if rest.any():
        row, column = (int(k) for k in np.argwhere(rest)[0])
        name = whole.layout.square
        reason = f"{name}[{index[row]}, {column}] is not 0: {name} joins two frames"
        raise whole.error(int(index[row]), reason)


def _place(row: int, line: int | None) -> str:
    return f"row {row} (index {row - 1})" if line is None else f"row {row} (line {line})"


def _shown(field: str) -> str:
    """A field as it may stand in a message."""
    return repr(field if len(field) <= 40 else field[:37] + "...")
