# SPDX-License-Identifier: Apache-2.0
"""Reading files: what is taken, and that every refusal is one line naming the file and the row."""

from __future__ import annotations

import io
import warnings
from pathlib import Path

import numpy as np
import pytest
from relnav.errors import IgnoredWarning, InputError
from relnav.frames import make_frame, read_frames

HEADER = "ax,ay,az,bx,by,bz"
GOOD = f"{HEADER}\n1,2,3,4,5,6\n7,8,9,10,11,12\n0,1,0,1,0,1\n"


@pytest.fixture(autouse=True)
def no_warnings() -> object:
    """numpy's own remarks would be lines on stderr."""
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def csv(tmp_path: Path, text: str | bytes, name: str = "points.csv") -> Path:
    path = tmp_path / name
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    return path


def refusal(path: Path) -> str:
    with pytest.raises(InputError) as caught:
        read_frames(path)
    text = str(caught.value)
    assert "\n" not in text and text.startswith(f"{path}: ") and len(text) < 400
    return text.removeprefix(f"{path}: ")


def test_plain(tmp_path: Path) -> None:
    (frame,) = read_frames(csv(tmp_path, GOOD))
    assert frame.name == 0 and frame.w is None
    assert frame.a.tolist() == [[1, 2, 3], [7, 8, 9], [0, 1, 0]]
    assert frame.b.tolist() == [[4, 5, 6], [10, 11, 12], [1, 0, 1]]


@pytest.mark.parametrize(
    "text",
    [
        b"\xef\xbb\xbf" + GOOD.encode(),
        GOOD.replace("\n", "\r\n"),
        GOOD.replace("\n", "\r"),
        GOOD.replace("\n", "\n\n  \n\t\n"),
        "\n\n" + GOOD,
        GOOD.rstrip("\n"),
        GOOD.replace(",", " , "),
        GOOD.replace("10,", '"10",').replace("az", '"az"'),
        GOOD.replace("10", "1e1").replace("5", "+5.").replace("7", "0.7E+01"),
    ],
    ids=[
        "bom",
        "crlf",
        "cr",
        "blank lines",
        "blank first",
        "no last newline",
        "blanks",
        "quotes",
        "exponents",
    ],
)
def test_spellings(tmp_path: Path, text: str | bytes) -> None:
    (frame,) = read_frames(csv(tmp_path, text))
    (plain,) = read_frames(csv(tmp_path, GOOD, "plain.csv"))
    assert np.array_equal(frame.a, plain.a) and np.array_equal(frame.b, plain.b)


def test_columns_in_any_order_among_others(tmp_path: Path) -> None:
    text = "note,bz,by,bx,w,az,ay,ax,note,\nx,6,5,4,2,3,2,1,y,\n,12,11,10,0.5,9,8,7,,\n"
    with pytest.warns(IgnoredWarning, match=r"column 'note' ignored"):
        (frame,) = read_frames(csv(tmp_path, text))
    assert frame.a.tolist() == [[1, 2, 3], [7, 8, 9]] and frame.b.tolist() == [[4, 5, 6], [10, 11, 12]]
    assert frame.w is not None and frame.w.tolist() == [2.0, 0.5]


def test_frames_that_are_not_contiguous(tmp_path: Path) -> None:
    labels = [3, 1, 3, 2, 1, 3]
    text = f"frame,{HEADER}\n" + "".join(f"{label},{i},0,0,0,0,{i}\n" for i, label in enumerate(labels))
    frames = read_frames(csv(tmp_path, text))
    assert [frame.name for frame in frames] == [3, 1, 2]
    assert [frame.a[:, 0].tolist() for frame in frames] == [[0, 2, 5], [1, 4], [3]]
    assert str(frames[1].error(1, "x")).endswith("row 5 (line 6): x")


@pytest.mark.parametrize(
    ("labels", "names"),
    [
        (["b", "a", "b"], ["b", "a"]),
        (["2", "x", "2"], ["2", "x"]),
        (["1", "1.0", " 1 "], [1]),
        (["-1", "0", "007"], [-1, 0, 7]),
        (["1758000000123456789", "1758000000123456790", "99999999999999999999"], None),
        (["0.5", "1.5", "0.5"], ["0.5", "1.5"]),
    ],
)
def test_labels(tmp_path: Path, labels: list[str], names: list[str | int] | None) -> None:
    text = f"{HEADER},frame\n" + "".join(f"1,2,3,4,5,6,{label}\n" for label in labels)
    expected = [int(label) for label in labels] if names is None else names
    assert [frame.name for frame in read_frames(csv(tmp_path, text))] == expected


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "empty file"),
        ("\n \n", "empty file"),
        (HEADER, "no points after the header"),
        (HEADER + "\n\n", "no points after the header"),
        ("ax,ay,az,bx,by\n1,2,3,4,5\n", "header (line 1): missing column bz"),
        ("\n1,2,3,4,5,6\n", "header (line 2): missing column ax, ay, az, bx, by, bz"),
        ("ax;ay;az;bx;by;bz\n", "header (line 1): missing column"),
        (GOOD.replace("ay", "ax"), "header (line 1): missing column ay"),
        (f"{HEADER},ax\n", "header (line 1): column ax stands there twice"),
        (f"{HEADER},w,w\n", "header (line 1): column w stands there twice"),
        (GOOD.replace("8", "nan"), "row 2 (line 3): ay = nan is not finite"),
        (GOOD.replace("8", "-inf"), "row 2 (line 3): ay = -inf is not finite"),
        (GOOD.replace("8", "1e400"), "row 2 (line 3): ay = inf is not finite"),
        (GOOD.replace("8", ""), "row 2 (line 3): ay = '' is not a number"),
        (GOOD.replace("8", "eight"), "row 2 (line 3): ay = 'eight' is not a number"),
        (GOOD.replace("8", "1_0"), "row 2 (line 3): ay = '1_0' is not a number"),
        (GOOD.replace("8", "0x10"), "row 2 (line 3): ay = '0x10' is not a number"),
        (GOOD.replace("8", "8\x00"), "row 2 (line 3): ay = '8\\x00' is not a number"),
        (GOOD.replace("8", "8" * 50 + "x"), "row 2 (line 3): ay = '" + "8" * 37 + "...' is not a number"),
        (GOOD.replace("8,", ""), "row 2 (line 3): 5 fields, the header has 6"),
        (GOOD.replace("8", "8,5"), "row 2 (line 3): 7 fields, the header has 6"),
        (GOOD.replace("10", '"10'), "row 2 (line 3): "),
        (GOOD.replace("7,8", "\n\n7,x"), "row 2 (line 5): ay = 'x' is not a number"),
        (f"{HEADER},w\n1,2,3,4,5,6,1\n1,2,3,4,5,6,-1\n", "row 2 (line 3): w = -1.0 is negative"),
        (f"{HEADER},w\n1,2,3,4,5,6,nan\n1,2,3,4,5,nan,-1\n", "row 1 (line 2): w = nan is not finite"),
        (f"{HEADER},frame\n1,2,3,4,5,6,1\n1,2,3,4,5,6, \n", "row 2 (line 3): frame is empty"),
        (f"{HEADER},frame\n1,2,3,4,5,6,1\n1,2,3,4,5,6,nan\n", "row 2 (line 3): frame = nan is not a label"),
        (f"{HEADER},frame\n1,2,3,4,5,6,{'x' * 64}\n", "row 1 (line 2): frame has a label of 64"),
        (GOOD.encode().replace(b"8", b"\xff"), "line 3: not UTF-8 text (byte 0xff)"),
        (GOOD.encode("utf-16"), "line 1: not UTF-8 text"),
    ],
)
def test_refused_csv(tmp_path: Path, text: str | bytes, message: str) -> None:
    assert refusal(csv(tmp_path, text)).startswith(message)


def test_huge_integers_are_numbers(tmp_path: Path) -> None:
    (frame,) = read_frames(csv(tmp_path, GOOD.replace("8", "123456789012345678901234567890")))
    assert frame.a[1, 1] == 123456789012345678901234567890.0


def test_unreadable(tmp_path: Path) -> None:
    assert "cannot be read: No such file" in refusal(tmp_path / "none.csv")
    assert "cannot be read" in refusal(tmp_path)


def npz(tmp_path: Path, **arrays: object) -> Path:
    path = tmp_path / "points.npz"
    np.savez(path, **arrays)  # type: ignore[arg-type]
    return path


POINTS = np.arange(12.0).reshape(4, 3)


def test_npz(tmp_path: Path) -> None:
    path = npz(
        tmp_path, a=POINTS.astype(np.int16), b=POINTS.astype(">f4"), w=np.arange(4), frame=[1, 0, 1, 1]
    )
    first, second = read_frames(path)
    assert (first.name, second.name) == (1, 0) and first.a.dtype == first.b.dtype == np.float64
    assert (
        first.a.tolist() == POINTS[[0, 2, 3]].tolist()
        and first.w is not None
        and first.w.tolist() == [0, 2, 3]
    )
    assert str(first.error(1, "x")) == f"{path}: row 3 (index 2): x"


def test_npz_labels(tmp_path: Path) -> None:
    for labels, names in (
        (np.array(["u", "v", "u", "u"]), ["u", "v"]),
        (np.array([b"u", b"v", b"u", b"u"]), ["u", "v"]),
        (np.array([2.0, 1.0, 2.0, 2.0]), [2, 1]),
        (np.array([2**63, 1, 2, 2], dtype=np.uint64), [2**63, 1, 2]),
    ):
        assert [frame.name for frame in read_frames(npz(tmp_path, a=POINTS, b=POINTS, frame=labels))] == names


def test_npz_by_content(tmp_path: Path) -> None:
    path = npz(tmp_path, a=POINTS, b=POINTS).rename(tmp_path / "points.dat")
    assert len(read_frames(path)) == 1


BAD = POINTS.copy()
BAD[2, 1] = np.nan


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"a": POINTS}, "missing array b"),
        ({"a": POINTS, "b": POINTS[:3]}, "a has 4 points, b has 3"),
        ({"a": POINTS.T, "b": POINTS}, "a has shape (3, 4), expected (n, 3)"),
        ({"a": POINTS, "b": POINTS[None]}, "b has shape (1, 4, 3), expected (n, 3)"),
        ({"a": POINTS, "b": POINTS, "w": np.ones((4, 1))}, "w has shape (4, 1), expected (4,)"),
        ({"a": POINTS, "b": POINTS, "frame": np.zeros(3)}, "array frame has shape (3,)"),
        ({"a": POINTS, "b": POINTS, "frame": np.array([0, 1, np.nan, 0])}, "row 3 (index 2): frame = nan"),
        ({"a": POINTS, "b": BAD}, "row 3 (index 2): by = nan is not finite"),
        ({"a": POINTS * 1j, "b": POINTS}, "a holds complex128, expected real numbers"),
        ({"a": POINTS > 1, "b": POINTS}, "a holds bool, expected real numbers"),
        ({"a": POINTS.astype(str), "b": POINTS}, "a holds <U"),
        ({"a": POINTS[:0], "b": POINTS[:0]}, "no points"),
        ({"a": POINTS, "b": POINTS, "w": -np.ones(4)}, "row 1 (index 0): w = -1.0 is negative"),
    ],
)
def test_refused_npz(tmp_path: Path, arrays: dict[str, object], message: str) -> None:
    assert refusal(npz(tmp_path, **arrays)).startswith(message)


class Trap:
    """Tells on the reader that unpickles it."""

    def __reduce__(self) -> tuple[object, ...]:
        return pytest.fail, ("unpickled",)


@pytest.mark.parametrize("name", ["a", "w", "frame"])
def test_objects_are_never_unpickled(tmp_path: Path, name: str) -> None:
    arrays = {"a": POINTS, "b": POINTS, "w": np.ones(4), "frame": np.zeros(4)}
    arrays[name] = np.array([Trap()] * 4, dtype=object)
    assert refusal(npz(tmp_path, **arrays)).startswith(f"array {name} holds Python objects")


def test_damaged_npz(tmp_path: Path) -> None:
    whole = npz(tmp_path, a=POINTS, b=POINTS).read_bytes()
    for size in (0, 1, 30, 100, len(whole) // 2, len(whole) - 1):
        assert refusal(csv(tmp_path, whole[:size], "cut.npz")).startswith("not a readable .npz")
    spoiled = bytearray(whole)
    spoiled[150] ^= 0xFF
    assert refusal(csv(tmp_path, bytes(spoiled), "spoiled.npz")).startswith("not a readable .npz")
    single = io.BytesIO()
    np.save(single, POINTS)
    assert refusal(csv(tmp_path, single.getvalue(), "single.npz")).startswith("a single array")
    assert refusal(csv(tmp_path, GOOD, "text.npz")).startswith("not a readable .npz")


def test_arrays() -> None:
    frame = make_frame([[1, 2, 3]], [[4, 5, 6]], [2])
    assert frame.a.dtype == np.float64 and frame.w is not None and frame.w.tolist() == [2.0]
    for bad in (
        ([[1, 2]], [[1, 2]]),
        ([[1, 2, 3]], [[1, 2, 3], [4]]),
        ("x", "y"),
        ([[1, 2, np.inf]], [[1, 2, 3]]),
    ):
        with pytest.raises(InputError):
            make_frame(*bad)
