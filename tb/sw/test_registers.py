# SPDX-License-Identifier: Apache-2.0
"""The registers' one description and everything that is generated from it."""

from __future__ import annotations

import re
import shutil
import subprocess
from pathlib import Path

import pytest
from relnav import __version__, regtool
from relnav.registermap import Field, Register
from relnav.registers import Ivisnav, Oltae

OTHER = """
addrmap ivisnav #(longint unsigned VERSION_WORD = 0) {
    name = "iVisNav registers"; default regwidth = 32; default sw = r; default hw = w;
    reg { name = "Version"; field { hw = na; } VALUE[31:0] = VERSION_WORD; } VERSION @ 0x0;
    reg { name = "Rates"; field {} VALUE[31:0]; } RATE[6] @ 0x10;
};
"""


CORES = {"oltae": Oltae, "ivisnav": Ivisnav}
cores = pytest.mark.parametrize("core", CORES)


def registers(core: str = "oltae") -> dict[str, type[Register]]:
    found = {name: value for name, value in vars(CORES[core]).items() if isinstance(value, type)}
    return {name: value for name, value in found.items() if issubclass(value, Register)}


def test_generated_files_are_current() -> None:
    assert regtool.stale() == [], "run python -m relnav.regtool"


def test_a_change_is_noticed(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Every generated file, changed or gone, and every one of them after a change of the description."""
    shutil.copytree(regtool.ROOT / "registers", tmp_path / "registers")
    description = tmp_path / "registers" / "oltae.rdl"
    assert regtool.main(["--root", str(tmp_path)]) == 0
    made = list(regtool.outputs(tmp_path))
    assert len(made) == 8
    for name in made:
        assert (tmp_path / name).read_text() == (regtool.ROOT / name).read_text()
        good = (tmp_path / name).read_text()
        (tmp_path / name).write_text(good + "\n")
        assert regtool.stale(tmp_path) == [name]
        (tmp_path / name).unlink()
        assert regtool.stale(tmp_path) == [name]
        (tmp_path / name).write_text(good)
    description.write_text(description.read_text().replace("DATA_B @ 0x044", "DATA_B @ 0x04C"))
    other = {name for name in made if "ivisnav" in name.name}
    assert len(other) == 3 and set(regtool.stale(tmp_path)) == set(made) - other
    assert regtool.main(["--root", str(tmp_path), "--check"]) == 1
    assert "stale: rtl/include/oltae_registers.vh" in capsys.readouterr().err
    assert regtool.stale(regtool.ROOT, version="0.2.0") != [], "the version is part of the description"


def test_a_second_core_only_adds_its_file(tmp_path: Path) -> None:
    (tmp_path / "registers").mkdir()
    shutil.copy(regtool.ROOT / "registers" / "oltae.rdl", tmp_path / "registers")
    (tmp_path / "registers" / "ivisnav.rdl").write_text(OTHER)
    made = regtool.outputs(tmp_path)
    assert len(made) == 8
    assert (
        made[Path("rtl/include/oltae_registers.vh")]
        == (regtool.ROOT / "rtl/include/oltae_registers.vh").read_text()
    )
    assert "localparam [11:0] RATE_ADDRESS = 12'h010;" in made[Path("rtl/include/ivisnav_registers.vh")]
    space: dict[str, type] = {}
    exec(made[Path("sw/relnav/registers.py")], space)
    assert vars(space["Ivisnav"])["RATE"].element(5) == 0x24
    assert vars(space["Oltae"])["FLAGS"].ADDRESS == Oltae.FLAGS.ADDRESS


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (("@ 0x044", "@ 0x040"), "overlap"),
        (("RATE[6]", "RATE[6][2]"), "rows of adjacent words"),
        (("RATE[6] @ 0x10;", "RATE[6] @ 0x10 += 8;"), "rows of adjacent words"),
        (("RATE[6] @ 0x10", "RATE[6] @ 0x1000"), "12 address bits"),
        (("sw = r;", "sw = nonsense;"), "nonsense"),
    ],
)
def test_a_wrong_description_is_refused(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], change: tuple[str, str], complaint: str
) -> None:
    (tmp_path / "registers").mkdir()
    text = OTHER.replace(
        " @ 0x10;", " @ 0x10; reg { field {} V[31:0]; } A @ 0x040; reg { field {} V[31:0]; } B @ 0x044;"
    )
    if "RATE" in change[0]:
        text = OTHER
    assert change[0] in text
    (tmp_path / "registers" / "ivisnav.rdl").write_text(text.replace(*change))
    assert regtool.main(["--root", str(tmp_path)]) == 2
    error = capsys.readouterr().err
    assert error.startswith("regtool: ivisnav.rdl: ") and complaint in error and error.count("\n") == 1
    assert not (tmp_path / "sw").exists()


def test_version_word() -> None:
    major, minor, patch = (int(part) for part in __version__.split(".")[:3])
    assert Oltae.VERSION.RESET == major << 16 | minor << 8 | patch == regtool.version_word()
    with pytest.raises(regtool.DescriptionError, match=r"M\.m\.p"):
        regtool.version_word("next")


@cores
def test_verilog_and_python_agree(core: str) -> None:
    text = (regtool.ROOT / f"rtl/include/{core}_registers.vh").read_text()
    addresses = dict(re.findall(r"(\w+)_ADDRESS = 12'h([0-9A-F]{3});", text))
    assert {name: int(value, 16) for name, value in addresses.items()} == {
        n: r.ADDRESS for n, r in registers(core).items()
    }
    words = {int(word, 16) for word in re.findall(r"10'h([0-9A-F]{3})", text)}
    assert words == {r.element(i) // 4 for r in registers(core).values() for i in range(r.COUNT)}
    places = {name: int(low) for name, low in re.findall(r"(\w+)_LSB = (\d+);", text)}
    narrow = {(n, f): x for n, r in registers(core).items() for f, x in r.FIELDS.items() if x.width < 32}
    assert places == {f"{name}_{field}": place.low for (name, field), place in narrow.items()}


def test_common_registers_are_what_both_have() -> None:
    """Each line of the common header is in both; registers of one name are the same register."""
    folder = regtool.ROOT / "rtl/include"
    lines = {
        name: {line for line in (folder / f"{name}_registers.vh").read_text().splitlines() if " = " in line}
        for name in ("common", *CORES)
    }
    assert lines["common"] == {
        line for line in lines["oltae"] & lines["ivisnav"] if line.startswith("localparam")
    }
    for name in registers().keys() & registers("ivisnav").keys() - {"CONDITION", "RSS"}:
        ours, theirs = registers()[name], registers("ivisnav")[name]
        assert (ours.ADDRESS, ours.ACCESS) == (theirs.ADDRESS, theirs.ACCESS), name
        for field in ours.FIELDS.keys() & theirs.FIELDS.keys():
            assert ours.FIELDS[field] == theirs.FIELDS[field], (name, field)


RESULTS = {
    "oltae": ["Q", "Q_FIXED", "R", "T", "RSS", "CONDITION", "DETERMINANT", "SPARE", "Q_COV", "T_COV"],
    "ivisnav": ["V", "OMEGA", "RSS", "COV"],
}


@cores
def test_what_the_register_file_relies_on(core: str) -> None:
    """The RTL decodes 5 bits of word address below 0x80; from 0x100 on come the results in their order."""
    found, results = registers(core), RESULTS[core]
    place = 0x100
    for name in results:
        assert place == found[name].ADDRESS, name
        place += 4 * found[name].COUNT
    assert place == CORES[core].SIZE == 0x100 + 4 * {"oltae": 34, "ivisnav": 28}[core]
    assert all(r.ADDRESS < 0x80 and r.COUNT == 1 for n, r in found.items() if n not in results)
    flags = found["FLAGS"].FIELDS
    assert list(flags.items()) == list(found["FRAME_FLAGS"].FIELDS.items())
    assert [field.low for field in flags.values()] == [
        bit for bit in range(11) if core == "oltae" or bit not in (6, 9)
    ]
    assert [int(state) for state in CORES[core].State] == [0, 1, 2, 3, 4]


@cores
@pytest.mark.skipif(shutil.which("cc") is None, reason="no C compiler (cc)")
def test_c_header_compiles(core: str, tmp_path: Path) -> None:
    """C99 without a warning, the layout checked by the header, const where the hardware ignores writes."""
    header = regtool.ROOT / f"sw/c/{core}_registers.h"
    code = f'#include "{header}"\nvoid f({core}_registers *r) {{ r->%s = 1; }}\n'
    command = ["cc", "-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-fsyntax-only", "-x", "c", "-"]
    for name, register in registers(core).items():
        row = "[0]" if register.COUNT > 1 else ""
        done = subprocess.run(command, input=code % (name + row), text=True, capture_output=True, check=False)
        assert (done.returncode == 0) == (register.ACCESS != "ro"), name + done.stderr
    broken = tmp_path / "broken.h"
    broken.write_text(
        header.read_text().replace("    uint32_t FRAC; ", "    uint32_t FRAC; uint32_t EXTRA; ")
    )
    again = code.replace(str(header), str(broken)) % "FRAC"
    assert subprocess.run(command, input=again, text=True, capture_output=True, check=False).returncode != 0


def test_fields() -> None:
    assert Field(16, 16) == Oltae.STATUS.FRAME and Oltae.STATUS.FRAME.mask == 0xFFFF0000
    assert Oltae.STATUS.STATE.get(0xFFFFFFF2) == int(Oltae.State.COMPUTE)
    assert int(Oltae.State.COMPUTE) == 2
    assert (
        Oltae.FRAC.FRAC.put(-64) == 0xC0
        and Oltae.FRAC.FRAC.get(0xC0) == -64
        and Oltae.FRAC.FRAC.get(95) == 95
    )
    assert Oltae.STATUS.encode(STATE=3, FRAME=2) == 0x20003 and Oltae.STATUS.decode(0x20003)["FRAME"] == 2
    for field, value in (
        (Oltae.FRAC.FRAC, 128),
        (Oltae.FRAC.FRAC, -129),
        (Oltae.STATUS.STATE, 8),
        (Oltae.STATUS.STATE, -1),
    ):
        with pytest.raises(ValueError, match="does not fit"):
            field.put(value)
    assert [Oltae.R.element(i) for i in (0, 8)] == [0x118, 0x138]
    with pytest.raises(IndexError):
        Oltae.R.element(9)
