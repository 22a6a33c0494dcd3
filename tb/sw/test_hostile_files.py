# SPDX-License-Identifier: Apache-2.0
"""Files made to hurt, for `relnav pose` and `relnav rates`: one line that names the cause, exit code 2.

In a process of its own, with limits on time and memory, as a user would meet them. What one frame's values or
arrays may be is in test_frames, test_ivisnav_rows and the tests of both commands.
"""

from __future__ import annotations

import io
import os
import pickle
import resource
import subprocess
import sys
import threading
import zipfile
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
HEADERS = {"pose": "ax,ay,az,bx,by,bz", "rates": "rx,ry,rz,px,py,pz,dphi"}
OPTIONS = {"pose": [], "rates": ["--f0", "20e6", "--dt", "0.01"]}
ARRAYS = {"pose": ("a", "b"), "rates": ("r", "p", "dphi")}
MEMORY = 4 << 30
SECONDS = 60


def run(
    command: str, path: Path, *options: str, memory: int = MEMORY, seconds: float = SECONDS
) -> subprocess.CompletedProcess[str]:
    """`relnav COMMAND PATH`; ends after `seconds`, cannot have more than `memory` bytes."""
    return subprocess.run(
        [sys.executable, "-m", "relnav.cli", command, str(path), *OPTIONS[command], *options],
        cwd=ROOT / "sw",
        env=os.environ | {"OPENBLAS_NUM_THREADS": "1"},  # whose threads each reserve memory
        capture_output=True,
        text=True,
        timeout=seconds,
        check=False,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (memory, memory)),
    )


def refused(command: str, path: Path, *options: str, memory: int = MEMORY) -> str:
    """The one line, without the file's name."""
    done = run(command, path, *options, memory=memory)
    assert done.returncode == 2 and done.stdout == "", done.stderr
    assert done.stderr.count("\n") == 1 and "Traceback" not in done.stderr, done.stderr
    assert done.stderr.startswith(f"relnav: {path}: "), done.stderr
    return done.stderr.removeprefix(f"relnav: {path}: ").strip()


def row(command: str, value: str) -> str:
    """Three good rows and one with the value in its third column."""
    width = HEADERS[command].count(",") + 1
    good = [",".join(str((3 * i + 5 * k * k) % 7 + 1) for k in range(width)) for i in range(3)]
    fields = ["1"] * width
    fields[2] = value
    return "\n".join((HEADERS[command], *good, ",".join(fields), ""))


def archive(path: Path, **entries: bytes) -> Path:
    """An .npz of any bytes."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for name, data in entries.items():
            file.writestr(f"{name}.npy", data)
    return path


def array(values: object) -> bytes:
    """A .npy."""
    out = io.BytesIO()
    np.save(out, np.asarray(values), allow_pickle=True)
    return out.getvalue()


def arrays(command: str) -> dict[str, np.ndarray]:
    """Eight rows."""
    rng = np.random.default_rng(1)
    return {name: rng.normal(size=(8, 3) if name != "dphi" else 8) for name in ARRAYS[command]}


COMMANDS = pytest.mark.parametrize("command", ["pose", "rates"])


@COMMANDS
@pytest.mark.parametrize(
    ("value", "word"),
    [("nan", "nan"), ("-inf", "-inf"), ("1e999", "inf"), ("1e308", "1e+308"), ("-1.7e308", "too large")],
)
def test_values(tmp_path: Path, command: str, value: str, word: str) -> None:
    path = tmp_path / "values.csv"
    path.write_text(row(command, value))
    done = run(command, path, "--json")
    if command == "rates" and "308" in value:  # a direction has any length: it is made unit
        assert done.returncode in (0, 3) and done.stderr == ""
        return
    reason = refused(command, path)
    assert reason.startswith("row 4 (line 5): ") and word in reason


@COMMANDS
@pytest.mark.parametrize("value", ["1e308", "-1e308"])
def test_huge_everywhere(tmp_path: Path, command: str, value: str) -> None:
    """No sum or product on the way overflows into a traceback or a warning."""
    path = tmp_path / "huge.csv"
    width = HEADERS[command].count(",") + 1
    path.write_text("\n".join((HEADERS[command], *[",".join([value] * width)] * 8, "")))
    for backend in ("double", "fixed"):
        done = run(command, path, "--backend", backend)
        assert done.returncode == 2 and done.stderr.count("\n") == 1, done.stderr


def nothing(folder: Path, command: str) -> Path:
    (folder / "empty.csv").touch()
    return folder / "empty.csv"


def header_only(folder: Path, command: str) -> Path:
    (folder / "header.csv").write_text(HEADERS[command] + "\n")
    return folder / "header.csv"


def directory(folder: Path, command: str) -> Path:
    (folder / "folder.csv").mkdir()
    return folder / "folder.csv"


def garbage(folder: Path, command: str) -> Path:
    (folder / "garbage.csv").write_bytes(np.random.default_rng(2).bytes(1 << 16))
    return folder / "garbage.csv"


def zeros(folder: Path, command: str) -> Path:
    (folder / "zeros.csv").write_bytes(bytes(1 << 20))
    return folder / "zeros.csv"


def one_line(folder: Path, command: str) -> Path:
    (folder / "line.csv").write_text(HEADERS[command] + "\n" + "1," * (1 << 20))
    return folder / "line.csv"


def quote(folder: Path, command: str) -> Path:
    (folder / "quote.csv").write_text(HEADERS[command] + '\n"' + "1,2,3\n" * (1 << 16))
    return folder / "quote.csv"


def empty_npz(folder: Path, command: str) -> Path:
    np.savez(folder / "empty.npz")
    return folder / "empty.npz"


def truncated(folder: Path, command: str) -> Path:
    np.savez(folder / "whole.npz", **arrays(command))  # type: ignore[arg-type]
    whole = (folder / "whole.npz").read_bytes()
    (folder / "cut.npz").write_bytes(whole[: 2 * len(whole) // 3])
    return folder / "cut.npz"


def objects(folder: Path, command: str) -> Path:
    given: dict[str, object] = dict(arrays(command))
    given[ARRAYS[command][1]] = np.array([{"x": 1}] * 8, dtype=object)
    np.savez(folder / "objects.npz", **given)  # type: ignore[arg-type]
    return folder / "objects.npz"


class Bomb:
    """Writes a file when it is unpickled."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def __reduce__(self) -> tuple[object, ...]:
        return Path.touch, (self.path,)


def bomb(folder: Path, command: str) -> Path:
    """An object array whose pickle acts."""
    data = array(np.array([Bomb(folder / "exploded")], dtype=object))
    return archive(folder / "bomb.npz", **dict.fromkeys(ARRAYS[command], data))


def bare_pickle(folder: Path, command: str) -> Path:
    """A pickle by another name; numpy would load it, were it allowed to."""
    (folder / "pickle.npz").write_bytes(pickle.dumps(Bomb(folder / "exploded")))
    return folder / "pickle.npz"


def zip_bomb(folder: Path, command: str) -> Path:
    """A megabyte on disk that says it holds eight gigabytes."""
    header = array(np.zeros((1, 3)))[:128].replace(b"(1, 3)", b"(%d, 3)" % (1 << 28))
    header = header[:8] + len(header[10:]).to_bytes(2, "little") + header[10:]
    return archive(folder / "bomb.npz", **dict.fromkeys(ARRAYS[command], header + bytes(64 << 20)))


def no_arrays(folder: Path, command: str) -> Path:
    return archive(folder / "text.npz", **dict.fromkeys(ARRAYS[command], b"not an array"))


@COMMANDS
@pytest.mark.parametrize(
    ("make", "words"),
    [
        (nothing, "empty file"),
        (header_only, "after the header"),
        (directory, "cannot be read: Is a directory"),
        (garbage, "not UTF-8 text"),
        (zeros, "header (line 1): field larger than"),
        (one_line, "row 1 (line 2)"),
        (quote, "row 1 (line 2)"),
        (empty_npz, "missing array"),
        (truncated, "not a readable .npz"),
        (objects, "holds Python objects, which are never loaded"),
        (bomb, "holds Python objects, which are never loaded"),
        (bare_pickle, "not a readable .npz"),
        (zip_bomb, ""),
        (no_arrays, ""),
    ],
)
def test_files(tmp_path: Path, command: str, make: Callable[[Path, str], Path], words: str) -> None:
    assert words in refused(command, make(tmp_path, command))
    assert not (tmp_path / "exploded").exists()


@COMMANDS
def test_fifo(tmp_path: Path, command: str) -> None:
    """A pipe is read to its end, like a file."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    writer = threading.Thread(target=pipe.write_text, args=(row(command, "nan"),), daemon=True)
    writer.start()
    assert refused(command, pipe).startswith("row 4 (line 5): ")
    writer.join(5)


@COMMANDS
def test_endless(command: str) -> None:
    """A file without an end meets the limit of the process."""
    assert refused(command, Path("/dev/zero"), memory=3 << 29) == "too large for the memory there is"


@COMMANDS
@pytest.mark.parametrize("end", ["", "nan"])
def test_long_csv(tmp_path: Path, command: str, end: str) -> None:
    """More rows than a core takes, in a second or two and a few hundred megabytes.

    Ten megabytes here, for the regression's sake; RELNAV_HUGE=10 makes it a hundred.
    """
    path = tmp_path / "long.csv"
    body = row(command, "5").partition("\n")[2]
    times = 160_000 * int(os.environ.get("RELNAV_HUGE", "1"))
    with path.open("w") as file:
        file.write(HEADERS[command] + "\n")
        for _ in range(times // 10_000):
            file.write(body * 10_000)
        file.write(row(command, end).partition("\n")[2] if end else "")
    if end:
        assert refused(command, path).startswith(f"row {4 * times + 4} (line {4 * times + 5}): ")
        return
    done = run(command, path, memory=8 << 30, seconds=300)
    assert done.returncode == 3 and "TOO_LONG" in done.stdout and done.stderr == "", done.stderr
