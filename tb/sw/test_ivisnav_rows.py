# SPDX-License-Identifier: Apache-2.0
"""iVisNav's readers: what is taken, and that every refusal is one line naming the file and the row."""

from __future__ import annotations

import warnings
from pathlib import Path

import numpy as np
import pytest
from relnav.errors import IgnoredWarning, InputError
from relnav.ivisnav.rows import make_rate_frame, read_rate_frames

HEADER = "rx,ry,rz,px,py,pz,dphi"
GOOD = f"{HEADER}\n1,2,3,4,5,6,0.25\n7,8,9,10,11,12,-3\n0,1,0,1,0,1,0\n"


@pytest.fixture(autouse=True)
def no_warnings() -> object:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        yield


def csv(tmp_path: Path, text: str) -> Path:
    path = tmp_path / "phases.csv"
    path.write_text(text)
    return path


def npz(tmp_path: Path, **arrays: object) -> Path:
    path = tmp_path / "phases.npz"
    np.savez(path, **arrays)  # type: ignore[arg-type]
    return path


def refusal(path: Path) -> str:
    with pytest.raises(InputError) as caught:
        read_rate_frames(path)
    text = str(caught.value)
    assert "\n" not in text and text.startswith(f"{path}: ") and len(text) < 400
    return text.removeprefix(f"{path}: ")


def test_csv(tmp_path: Path) -> None:
    (frame,) = read_rate_frames(csv(tmp_path, GOOD))
    assert (frame.name, frame.n, frame.w, frame.sigma) == (0, 3, None, None)
    assert frame.r.tolist() == [[1, 2, 3], [7, 8, 9], [0, 1, 0]]
    assert frame.p.tolist() == [[4, 5, 6], [10, 11, 12], [1, 0, 1]]
    assert frame.dphi.tolist() == [0.25, -3, 0]


def test_csv_with_everything(tmp_path: Path) -> None:
    text = "frame,w,dphi,note,rx,ry,rz,px,py,pz\n"
    text += "u,1,0.1,x,1,0,0,0,0,0\nv,2,0.2,,0,1,0,1,2,3\nu,3,0.3,,0,0,1,0,0,1\n"
    with pytest.warns(IgnoredWarning, match=r"column 'note' ignored"):
        first, second = read_rate_frames(csv(tmp_path, text))
    assert (first.name, second.name) == ("u", "v")
    assert first.dphi.tolist() == [0.1, 0.3] and second.p.tolist() == [[1, 2, 3]]
    assert first.w is not None and first.w.tolist() == [1, 3]
    assert str(first.error(1, "x")).endswith("row 3 (line 4): x")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", f"empty file; expected a header {HEADER}"),
        (HEADER, "no rows after the header"),
        ("rx,ry,rz,px,py,pz\n1,2,3,4,5,6\n", "header (line 1): missing column dphi"),
        (GOOD.replace("0.25", "nan"), "row 1 (line 2): dphi = nan is not finite"),
        (GOOD.replace("11", "1e999"), "row 2 (line 3): py = inf is not finite"),
        (GOOD.replace("0.25", "a"), "row 1 (line 2): dphi = 'a' is not a number"),
        (GOOD.replace("7,8,9", "0,-0,0e5"), "row 2 (line 3): the direction rx, ry, rz is zero"),
        (GOOD.replace("7,", ""), "row 2 (line 3): 6 fields, the header has 7"),
        (f"{HEADER},w\n1,2,3,4,5,6,7,-1\n", "row 1 (line 2): w = -1.0 is negative"),
    ],
)
def test_refused_csv(tmp_path: Path, text: str, message: str) -> None:
    assert refusal(csv(tmp_path, text)).startswith(message)


R, P, DPHI = np.eye(4)[:, :3] + 1.0, np.arange(12.0).reshape(4, 3), np.arange(4.0)
SIGMA = np.diag([1.0, 4.0, 9.0, 16.0]) + 0.5 * (np.eye(4, k=2) + np.eye(4, k=-2))


def changed(row: int, column: int, value: float) -> np.ndarray:
    sigma = SIGMA.copy()
    sigma[row, column] = value
    return sigma


def test_npz(tmp_path: Path) -> None:
    (frame,) = read_rate_frames(npz(tmp_path, r=R, p=P, dphi=DPHI.astype(np.int8), sigma=SIGMA))
    assert frame.sigma is not None and frame.sigma.tolist() == SIGMA.tolist()
    first, second = read_rate_frames(npz(tmp_path, r=R, p=P, dphi=DPHI, sigma=SIGMA, frame=[1, 0, 1, 0]))
    assert first.sigma is not None and first.sigma.tolist() == [[1, 0.5], [0.5, 9]]
    assert second.sigma is not None and second.sigma.tolist() == [[4, 0.5], [0.5, 16]]


@pytest.mark.parametrize(
    ("arrays", "message"),
    [
        ({"dphi": None}, "missing array dphi"),
        ({"dphi": DPHI[:3]}, "r has 4 rows, dphi has 3"),
        ({"dphi": DPHI[:, None]}, "dphi has shape (4, 1), expected (n,)"),
        ({"r": R[:, :2]}, "r has shape (4, 2), expected (n, 3)"),
        ({"p": P * 1j}, "p holds complex128, expected real numbers"),
        ({"r": R * [[0], [1], [1], [1]]}, "row 1 (index 0): the direction rx, ry, rz is zero"),
        ({"sigma": SIGMA[:3]}, "sigma has shape (3, 4), expected (4, 4)"),
        ({"sigma": np.diag(SIGMA)}, "sigma has shape (4,), expected (4, 4)"),
        ({"sigma": SIGMA.astype(object)}, "array sigma holds Python objects"),
        ({"sigma": changed(1, 2, np.nan)}, "row 2 (index 1): sigma[1, 2] = nan is not finite"),
        ({"sigma": changed(0, 1, 0.1)}, "frame 0: sigma is not symmetric: [0, 1] = 0.1, [1, 0] = 0.0"),
        ({"sigma": changed(2, 2, 0.0)}, "frame 0: sigma is not positive definite: its variance 2 is 0.0"),
        ({"sigma": changed(2, 2, 0.2)}, "frame 0: sigma is not positive definite"),
        ({"sigma": changed(2, 2, 0.25)}, "frame 0: sigma is not positive definite"),
        ({"sigma": SIGMA, "w": np.ones(4)}, "w and sigma exclude each other"),
        (
            {"sigma": SIGMA, "frame": [1, 1, 2, 2]},
            "row 1 (index 0): sigma[0, 2] is not 0: sigma joins two frames",
        ),
    ],
)
def test_refused_npz(tmp_path: Path, arrays: dict[str, object], message: str) -> None:
    every = {"r": R, "p": P, "dphi": DPHI} | arrays
    path = npz(tmp_path, **{name: array for name, array in every.items() if array is not None})
    assert refusal(path).startswith(message)


def test_arrays() -> None:
    frame = make_rate_frame([[1, 2, 2]], [[4, 5, 6]], [2], [3], name="x")
    assert (frame.name, frame.n) == ("x", 1) and frame.w is not None
    np.testing.assert_allclose(frame.directions(), [[1 / 3, 2 / 3, 2 / 3]])
    huge = make_rate_frame([[1e308, 1e308, 0], [0, 0, 5e-324]], np.zeros((2, 3)), [0, 0])
    np.testing.assert_allclose(huge.directions(), [[2**-0.5, 2**-0.5, 0], [0, 0, 1]])
    for sigma in (None, np.zeros((0, 0))):
        assert make_rate_frame(np.zeros((0, 3)), np.zeros((0, 3)), [], sigma=sigma).n == 0
    with pytest.raises(InputError, match=r"^frame 7: row 1 \(index 0\): the direction"):
        make_rate_frame([[0, 0, 0]], [[4, 5, 6]], [2], name=7)
    with pytest.raises(InputError, match="dphi is ragged"):
        make_rate_frame([[0, 0, 1]], [[4, 5, 6]], [[2], [1, 2]])  # type: ignore[list-item]
