# SPDX-License-Identifier: Apache-2.0
"""The buses of hardware, on files and a stand-in of pynq: the same user code, the same numbers."""

from __future__ import annotations

import errno
import mmap
import os
import socket
import struct
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from relnav import driver as oltae
from relnav.buses import axi_dma, memory_map
from relnav.buses.axi_dma import AxiDma
from relnav.buses.memory_map import DevMemBus, MemoryMap, UioBus
from relnav.driver import CoreDriver, OltaeDriver
from relnav.errors import BackendError
from relnav.ivisnav import driver as ivisnav
from relnav.ivisnav.driver import IvisnavDriver
from relnav.ivisnav.quantise import QuantisedRows
from relnav.quantise import QuantisedFrame
from relnav.registers import Ivisnav, Oltae
from relnav.rtlsim import run_frames, run_rate_frames
from relnav.vlnv import vlnv

from tb.sw.fake_core import FakeCore
from tb.sw.model_core import MODELS, CoreDevice, DmaDevice, SolvingCore, WatchedMap, replay

RANDOM = np.random.default_rng(5)
A = RANDOM.integers(-(1 << 20), 1 << 20, (7, 3))
LINE = np.arange(5)[:, None] * np.array([[3, -4, 5]])
POINTS = [
    QuantisedFrame(A, A[:, [1, 0, 2]] * np.array([1, -1, 1]) + 77, None, 12),
    QuantisedFrame(A, A + np.array([5, -6, 7]), np.array([1, 2, 3, 0, 65535, 6, 7]), -3),
    QuantisedFrame(LINE, LINE, None, 0),  # has no pose
]
H = np.vstack((np.eye(6, dtype=np.int64), np.ones((2, 6), dtype=np.int64))) << 20
ROWS = [
    QuantisedRows(H, H @ np.array([1, -2, 3, -4, 5, -6]), np.ones(8, dtype=np.int64), 20, 20),
    QuantisedRows(H + RANDOM.integers(-99, 99, H.shape), H @ np.arange(4, 10), np.arange(8) + 1, 30, 10),
    QuantisedRows(H * 0 + 3, np.arange(8), np.arange(8), 0, 0),  # has no rates
]


@dataclass(frozen=True)
class Kind:
    driver: type[CoreDriver[Any]]
    frames: list[Any]
    beats: Callable[[Any], list[int]]
    simulate: Callable[[list[Any], str], list[Any]]
    ip: str


KINDS = {
    "oltae": Kind(OltaeDriver, POINTS, oltae.beats_of, run_frames, "OltaeIP"),
    "ivisnav": Kind(IvisnavDriver, ROWS, ivisnav.beats_of, run_rate_frames, "IvisnavIP"),
}


@pytest.fixture(params=KINDS)
def kind(request: pytest.FixtureRequest) -> Kind:
    return KINDS[str(request.param)]


@pytest.fixture
def watched(monkeypatch: pytest.MonkeyPatch) -> Iterator[type[WatchedMap]]:
    monkeypatch.setattr(memory_map, "MemoryMap", WatchedMap)
    yield WatchedMap
    WatchedMap.devices.clear()


def user_code(driver: Any, frames: list[Any]) -> list[Any]:
    """What every bus is asked to do."""
    driver.identify()
    return [driver.solve(frame) for frame in frames]


def empty(file: Path, size: int) -> Path:
    file.write_bytes(bytes(size))
    return file


def uio_device(folder: Path, name: str, size: int = 4096, index: int = 0, offset: int = 0) -> Path:
    """A file that stands for /dev/NAME, and its entries in a sysfs of our own."""
    entries = folder / "sys" / name / "maps" / f"map{index}"
    entries.mkdir(parents=True)
    (folder / "sys" / name / "name").write_text(f"{name}_core\n")
    for entry, value in (("size", size), ("offset", offset), ("addr", 0x43C00000)):
        (entries / entry).write_text(f"0x{value:x}\n")
    return empty(folder / name, size + offset + index * mmap.PAGESIZE)


def uio_bus(folder: Path, core: FakeCore, watched: type[WatchedMap], dma: bool) -> UioBus:
    """UIO; with a DMA whose registers and buffer are files too."""
    device = uio_device(folder, "uio3")
    watched.devices[device] = CoreDevice(core)
    if not dma:
        return UioBus(device, sysfs=folder / "sys")
    registers, memory = empty(folder / "dma", 65536), empty(folder / "memory", 4096)
    watched.devices[registers] = DmaDevice(core, memory, 0x1_2000_0000)
    sender = AxiDma(watched(registers, 0, 65536), MemoryMap(memory, 0, 4096), 0x1_2000_0000)
    return UioBus(device, sender, sysfs=folder / "sys")


def mem_bus(folder: Path, core: FakeCore, watched: type[WatchedMap]) -> DevMemBus:
    file = empty(folder / "mem", 0x6000)
    watched.devices[file] = CoreDevice(core)
    return DevMemBus(0x5000, file=file)


def answers(kind: Kind, source: str) -> list[Any]:
    if source == "model":
        core = SolvingCore(kind.driver, MODELS[kind.driver])
        return user_code(kind.driver(core), kind.frames)  # no bus between
    return kind.simulate(kind.frames, source)


@pytest.fixture(params=["model", "icarus", "verilator"])
def source(request: pytest.FixtureRequest) -> str:
    """Where the numbers come from: the bit-exact model, or the driver on a simulator's bus."""
    from sim.runner import missing

    name = str(request.param)
    if name != "model" and (reason := missing(name)):
        pytest.skip(reason)
    return name


def test_same_code_same_numbers(
    kind: Kind, source: str, watched: type[WatchedMap], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """UIO by registers and by DMA, /dev/mem and PYNQ give what the simulator's bus gives, cycles included."""
    expected = answers(kind, source)
    assert [raw.failed for raw in expected] == [False, False, True]
    answer = MODELS[kind.driver]
    if source != "model":
        answer = replay([(kind.beats(f), raw) for f, raw in zip(kind.frames, expected, strict=True)])
        again = user_code(kind.driver(SolvingCore(kind.driver, MODELS[kind.driver])), kind.frames)
        for raw, model in zip(expected, again, strict=True):  # and the model's numbers are the RTL's
            clock = {n: getattr(raw, n) for n in vars(raw) if n.startswith("cycles")}
            assert replace(model, **clock) == raw
    for name in ("registers", "dma", "mem", "pynq", "pynq dma"):
        folder = tmp_path / name
        folder.mkdir()
        core = SolvingCore(kind.driver, answer)
        if name.startswith("pynq"):
            ip = fake_pynq(monkeypatch, kind.ip, core)
            driver = ip.driver(FakeDma(core)) if "dma" in name else ip.driver()
        else:
            bus: Any = (
                mem_bus(folder, core, watched)
                if name == "mem"
                else uio_bus(folder, core, watched, name == "dma")
            )
            driver = kind.driver(bus)
        assert user_code(driver, kind.frames) == expected, name
        assert core.frames == [kind.beats(frame) for frame in kind.frames], name
        pushed = sum(address == kind.driver.MAP.PUSH.ADDRESS for address, _ in core.written)
        assert pushed == (0 if "dma" in name else sum(len(kind.beats(f)) for f in kind.frames)), name


# ------------------------------------------------------------------------------------------------- memory


def test_words_of_a_file(tmp_path: Path) -> None:
    """At an offset that is no whole page; only the word written changes, in the machine's byte order."""
    file = empty(tmp_path / "file", 3 * mmap.PAGESIZE)
    with MemoryMap(file, mmap.PAGESIZE + 0x40, 0x20) as memory:
        memory.write(0x1C, 0x89ABCDEF)
        assert memory.read(0x1C) == 0x89ABCDEF and memory.read(0x18) == 0
        place = mmap.PAGESIZE + 0x40 + 0x1C
        content = file.read_bytes()
        assert content[place : place + 4] == struct.pack("=I", 0x89ABCDEF) and sum(content) == sum(
            content[place : place + 4]
        )
        for address in (-4, 2, 0x20):
            with pytest.raises(BackendError, match="no word at byte address"):
                memory.read(address)
            with pytest.raises(BackendError, match="no word at byte address"):
                memory.write(address, 0)
        for value in (1 << 33, 1 << 32, -1):
            with pytest.raises(BackendError, match=f"^{value} at byte address 0x1c is no word of 32 bits$"):
                memory.write(0x1C, value)
        assert memory.read(0x1C) == 0x89ABCDEF
    assert len(memory.words) == 0


@pytest.mark.parametrize(
    ("offset", "size", "reason"),
    [
        (2, 4, "no whole words"),
        (0, 6, "no whole words"),
        (0, 0, "no whole words"),
        (0, 1 << 20, "cannot map"),
    ],
)
def test_what_cannot_be_mapped(tmp_path: Path, offset: int, size: int, reason: str) -> None:
    file = empty(tmp_path / "file", 4096)
    with pytest.raises(BackendError, match=reason):
        MemoryMap(file, offset, size)


def test_devices_that_are_not_there(tmp_path: Path) -> None:
    with pytest.raises(BackendError, match="cannot map 4096 bytes at 0x43c00000: No such file"):
        DevMemBus(0x43C0_0000, file=tmp_path / "mem")
    with pytest.raises(BackendError, match="maps/map0/size: No such file or directory: no such UIO device"):
        UioBus("/dev/uio0", sysfs=tmp_path)
    device = uio_device(tmp_path, "uio0", size=0x100)
    with pytest.raises(BackendError, match="uio0: map 0 has 256 bytes, a core needs 4096"):
        UioBus(device, sysfs=tmp_path / "sys")
    (tmp_path / "sys/uio0/maps/map0/size").write_text("many\n")
    with pytest.raises(BackendError, match="size: invalid literal"):
        UioBus(device, sysfs=tmp_path / "sys")
    with pytest.raises(BackendError, match=r"no UIO device is called 'oltae' \(1 in "):
        UioBus.named("oltae", sysfs=tmp_path / "sys")
    with pytest.raises(BackendError, match=r"map0/size: invalid"):
        UioBus.named("uio0_core", sysfs=tmp_path / "sys")  # found by its name


def test_devices_that_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """No right to it, a device that opens once only, one without an interrupt, an entry that vanished."""
    device = uio_device(tmp_path, "uio0")
    real, opened = os.open, []

    def refuse(after: int, number: int) -> Callable[..., int]:
        def opens(file: str | Path, flags: int) -> int:
            opened.append(file)
            if len(opened) > after:
                raise OSError(number, os.strerror(number))
            return real(file, flags)

        return opens

    for after, number, message in (
        (0, errno.EACCES, "uio0: cannot map 4096 bytes at 0x0: Permission denied"),
        (1, errno.EBUSY, "uio0: cannot open it for its interrupts: Device or resource busy"),
    ):
        opened.clear()
        monkeypatch.setattr(os, "open", refuse(after, number))
        with pytest.raises(BackendError, match=message):
            UioBus(device, sysfs=tmp_path / "sys")
    opened.clear()
    monkeypatch.setattr(os, "open", refuse(0, errno.EPERM))
    with pytest.raises(
        BackendError, match="mem: cannot map 4096 bytes at 0x43c00000: Operation not permitted"
    ):
        DevMemBus(0x43C0_0000, file=tmp_path / "mem")
    monkeypatch.setattr(os, "open", real)
    bus = UioBus(device, sysfs=tmp_path / "sys")

    def no_interrupt(*_: object) -> int:
        raise OSError(errno.EIO, "Input/output error")

    monkeypatch.setattr(os, "write", no_interrupt)
    with pytest.raises(BackendError, match="uio0: cannot wait for its interrupt: Input/output error"):
        bus.idle()
    bus.close()
    (tmp_path / "sys/uio0/name").unlink()
    with pytest.raises(BackendError, match="name: No such file or directory: no such UIO device or map"):
        UioBus.named("oltae", sysfs=tmp_path / "sys")
    short = uio_device(tmp_path, "uio4")
    short.write_bytes(bytes(100))
    with pytest.raises(BackendError, match="uio4: cannot map 4096 bytes at 0x0: mmap length is greater than"):
        UioBus(short, sysfs=tmp_path / "sys")


def test_a_map_of_its_own(tmp_path: Path) -> None:
    """Map 2 lies at page 2 of the device, its registers where `offset` says."""
    device = uio_device(tmp_path, "uio1", size=0x800, index=2, offset=0x80)
    bus = UioBus(device, index=2, sysfs=tmp_path / "sys")
    bus.write(0x10, 77)
    assert bus.read(0x10) == 77
    place = 2 * mmap.PAGESIZE + 0x80 + 0x10
    assert device.read_bytes()[place] == 77
    bus.close()


def test_interrupts(tmp_path: Path) -> None:
    """Unmasked by a word of 1, then a word read: the kernel's count."""
    device = uio_device(tmp_path, "uio0")
    bus = UioBus(device, sysfs=tmp_path / "sys", patience=0.0)
    ours, kernels = socket.socketpair()
    bus._events = ours.fileno()
    assert not bus.wait_interrupt(0.0)
    assert kernels.recv(4) == struct.pack("=I", 1)
    kernels.send(struct.pack("=I", 12))
    assert bus.wait_interrupt(60.0)
    bus.idle()  # none is pending: it returns all the same
    assert kernels.recv(8) == struct.pack("=II", 1, 1)
    kernels.close()
    ours.detach()
    bus.close()


def test_pushes_wait_for_the_core(monkeypatch: pytest.MonkeyPatch) -> None:
    core = FakeCore(Oltae)
    core.push_ready = False
    monkeypatch.setattr(memory_map, "PUSH_LOOKS", 9)
    with pytest.raises(BackendError, match="takes no push: it is busy"):
        memory_map.push_beats(core, [1, 2, 3])
    assert not core.written
    for name in ("STATUS", "DATA_A", "DATA_B", "PUSH"):  # which the buses take for the same in every core
        assert getattr(Oltae, name).ADDRESS == getattr(Ivisnav, name).ADDRESS
    assert Oltae.STATUS.PUSH_READY == Ivisnav.STATUS.PUSH_READY and Oltae.PUSH.LAST == Ivisnav.PUSH.LAST


# ------------------------------------------------------------------------------------------------- AXI DMA


def dma_of(
    folder: Path, core: FakeCore, watched: type[WatchedMap], **options: int
) -> tuple[AxiDma, DmaDevice]:
    registers, memory = empty(folder / "dma", 4096), empty(folder / "memory", 4096)
    device = DmaDevice(core, memory, 0x2000_0000)
    watched.devices[registers] = device
    return AxiDma(watched(registers, 0, 4096), MemoryMap(memory, 0, 4096), 0x2000_0000, **options), device


def test_dma_transfers(tmp_path: Path, watched: type[WatchedMap]) -> None:
    core = FakeCore(Oltae)
    dma, device = dma_of(tmp_path, core, watched)
    frames = [[1 << 63 | 5, 6, 7], [8]]
    for frame in frames:
        dma.send(frame)
    dma.wait()
    assert core.frames == frames and device.sent == [24, 8]
    with pytest.raises(BackendError, match="can send 4096 bytes at a time, a frame has 4104"):
        dma.send([0] * 513)
    with pytest.raises(BackendError, match="buffer at 0x20000004 does not begin with a whole beat"):
        AxiDma(dma.registers, dma.buffer, 0x2000_0004)
    short, _ = dma_of(tmp_path, core, watched, length_bits=8)
    with pytest.raises(BackendError, match="can send 255 bytes"):
        short.send([0] * 32)


def test_dma_that_fails(tmp_path: Path, watched: type[WatchedMap], monkeypatch: pytest.MonkeyPatch) -> None:
    """A decode error resets it; a core that takes no beats is reported; afterwards it works again."""
    core = FakeCore(Oltae)
    dma, device = dma_of(tmp_path, core, watched)
    monkeypatch.setattr(axi_dma, "LOOKS", 5)
    device.error = 1 << 6
    dma.send([1])
    with pytest.raises(BackendError, match="the DMA failed, DMASR = 0x00000040"):
        dma.send([2])
    device.error, device.stuck = 0, True
    dma.send([3])
    with pytest.raises(BackendError, match="transfer does not end: the core takes no beats"):
        dma.wait()
    dma.reset()
    device.stuck = False
    dma.send([4])
    dma.wait()
    assert core.frames == [[1], [3], [4]]


# ------------------------------------------------------------------------------------------------- PYNQ


class FakeChannel:
    """pynq's send channel: what is given is sent when it is looked at."""

    def __init__(self, core: FakeCore) -> None:
        self.core, self.waiting, self.stuck = core, [], False  # type: ignore[var-annotated]

    @property
    def idle(self) -> bool:
        if not self.stuck:
            self.waiting.clear()
        return not self.waiting

    def transfer(self, array: Any, start: int = 0, nbytes: int = 0) -> None:
        assert self.idle and array.shape[0] * 8 >= nbytes and array.dtype == np.uint64
        self.waiting.append(nbytes)
        self.core.stream(array[: nbytes // 8].tolist())

    def stop(self) -> None:
        self.waiting.clear()

    def start(self) -> None:
        self.stuck = False


class FakeDma:
    def __init__(self, core: FakeCore) -> None:
        self.sendchannel = FakeChannel(core)


class Buffer(np.ndarray[Any, Any]):
    freed = 0

    def freebuffer(self) -> None:
        type(self).freed += 1


def fake_pynq(monkeypatch: pytest.MonkeyPatch, name: str, core: FakeCore) -> Any:
    """An object of the driver class `name`, as an overlay with this core would make it."""

    class DefaultIP:
        def __init__(self, description: dict[str, Any]) -> None:
            self.description = description

        def read(self, offset: int = 0) -> int:
            return core.read(offset)

        def write(self, offset: int, value: int) -> None:
            core.write(offset, value)

    package = ModuleType("pynq")
    vars(package).update(
        DefaultIP=DefaultIP, allocate=lambda shape, dtype: np.zeros(shape, dtype).view(Buffer)
    )
    monkeypatch.setitem(sys.modules, "pynq", package)
    monkeypatch.delitem(sys.modules, "relnav.buses.pynq", raising=False)
    import relnav.buses.pynq as module

    monkeypatch.delitem(sys.modules, "relnav.buses.pynq")
    return getattr(module, name)({"fullpath": "core_0"})


def test_pynq_is_bound_by_the_catalogue_name(monkeypatch: pytest.MonkeyPatch) -> None:
    for name, top in (("OltaeIP", "oltae_top"), ("IvisnavIP", "ivisnav_top")):
        assert fake_pynq(monkeypatch, name, FakeCore(Oltae)).bindto == [vlnv(top)]
    assert vlnv("oltae_top", "1.2.3") == "relnav:cores:oltae_top:1.2"


def test_pynq_is_only_needed_there() -> None:
    """Nothing else of the package asks for pynq."""
    folder = Path(memory_map.__file__).parent.parent
    users = [file.name for file in folder.rglob("*.py") if "import pynq" in file.read_text()]
    users += [file.name for file in folder.rglob("*.py") if "from pynq" in file.read_text()]
    assert set(users) == {"pynq.py"}


def test_pynq_dma(monkeypatch: pytest.MonkeyPatch) -> None:
    """The buffer grows and is given back; a core that takes no beats is reported."""
    core = FakeCore(Oltae)
    driver = fake_pynq(monkeypatch, "OltaeIP", core).driver(FakeDma(core))
    dma, Buffer.freed = driver.bus.dma, 0
    for frame in ([1, 2], [3], [4, 5, 1 << 63]):
        dma.send(frame)
    assert core.frames == [[1, 2], [3], [4, 5, 1 << 63]] and Buffer.freed == 1
    monkeypatch.setitem(dma.send.__globals__, "LOOKS", 3)
    dma.wait()
    dma.channel.stuck = True
    dma.send([6])
    with pytest.raises(BackendError, match="does not end: the core takes no beats"):
        dma.send([7])
    dma.reset()
    dma.send([8])
    assert core.frames[-1] == [8]
