# SPDX-License-Identifier: Apache-2.0
"""The C driver's sources: no warning, no complaint of cppcheck, examples that compile, no libc, sizes."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from scripts import c_size
from scripts.c_build import (
    ARM,
    CALLBACKS,
    CORTEX_A9,
    DRIVER,
    HOST,
    SOURCES,
    STRICT_FLAGS,
    CompileError,
    check,
    missing,
    run,
)
from scripts.marked import fill
from tb.c.test_bare_metal import HERE, vectors

COMPILERS = {"host": [HOST], "cortex-a9": [ARM, *CORTEX_A9]}
HEADERS = sorted(DRIVER.glob("*.h"))
ALLOWED = {"stdint.h", "stddef.h", "string.h"}


@pytest.fixture(params=COMPILERS)
def compiler(request: pytest.FixtureRequest) -> list[str]:
    """Each compiler with the options of its machine."""
    command = COMPILERS[str(request.param)]
    if reason := missing(command[0]):
        pytest.skip(reason)
    return command


@pytest.mark.parametrize("option", ["-O0", "-O2", "-Os", CALLBACKS])
def test_no_warning(option: str, compiler: list[str], tmp_path: Path) -> None:
    for source in SOURCES:
        run([*compiler, *STRICT_FLAGS, option, "-I", DRIVER, "-c", "-o", tmp_path / "out.o", source])


def test_headers_stand_alone_and_serve_cpp(compiler: list[str], tmp_path: Path) -> None:
    for header in HEADERS:
        for language, standard in (("c", "-std=c99"), ("c++", "-std=c++17")):
            source = tmp_path / "one"
            source.write_text(f'#include "{header.name}"\n#include "{header.name}"\n')
            flags = [standard, "-Wall", "-Werror", "-fsyntax-only", "-I", DRIVER]
            run([*compiler, *flags, "-x", language, source])


def test_examples_compile(compiler: list[str], tmp_path: Path) -> None:
    blocks = re.findall(r"^```c\n(.*?)^```", (DRIVER / "README.md").read_text(), re.MULTILINE | re.DOTALL)
    assert len(blocks) == 4
    for block in blocks:
        source = tmp_path / "example.c"
        source.write_text(block)
        run([*compiler, *STRICT_FLAGS, "-O2", "-I", DRIVER, "-c", "-o", tmp_path / "out.o", source])


def test_build_commands_of_the_readme(compiler: list[str], tmp_path: Path) -> None:
    text = (DRIVER / "README.md").read_text().replace("sw/c", str(DRIVER))
    (command,) = re.findall(rf"^    ({re.escape(compiler[0])} .*)$", text, re.MULTILINE)
    run(["sh", "-c", f"cd {tmp_path} && {command}"])
    assert {file.stem for file in tmp_path.glob("*.o")} == {source.stem for source in SOURCES}


def test_a_read_only_register_cannot_be_written(compiler: list[str], tmp_path: Path) -> None:
    source = tmp_path / "write.c"
    for name, compiles in (("FRAC", True), ("STATUS", False)):
        source.write_text(
            '#include "oltae.h"\nvoid f(const relnav_port *p);\n'
            f"void f(const relnav_port *p) {{ RELNAV_WRITE(p, oltae_registers, {name}, 0u); }}\n"
        )
        command = [*compiler, *STRICT_FLAGS, "-fsyntax-only", "-I", DRIVER, source]
        if compiles:
            run(command)
        else:
            with pytest.raises(CompileError, match="read-only"):
                run(command)


def test_no_libc_but_memory(compiler: list[str], tmp_path: Path) -> None:
    for source in [*SOURCES, *HEADERS]:
        assert set(re.findall(r"#include <([^>]+)>", source.read_text())) <= ALLOWED, source.name
    made = tmp_path / "all.o"
    run([*compiler, "-std=c99", "-Os", "-r", "-nostdlib", "-I", DRIVER, "-o", made, *SOURCES])
    tool = "nm" if compiler[0] == HOST else ARM.replace("gcc", "nm")
    undefined = set(run([tool, "-u", made]).split()) - {"U"}
    compilers = ("__aeabi_", "_GLOBAL_OFFSET_TABLE_", "__stack_chk")
    own = {name for name in undefined if not name.startswith(compilers)}
    assert own <= {"memcpy", "memset"}


def test_cppcheck(tmp_path: Path) -> None:
    if reason := missing("cppcheck"):
        pytest.skip(reason)
    (tmp_path / "vectors.h").write_text(vectors())
    check([tmp_path], HERE)


def test_cppcheck_would_complain(tmp_path: Path) -> None:
    if reason := missing("cppcheck"):
        pytest.skip(reason)
    (tmp_path / "vectors.h").write_text(vectors())
    (tmp_path / "bad.c").write_text("int f(void);\nint f(void)\n{\n    int a[2];\n    return a[2];\n}\n")
    with pytest.raises(CompileError, match="arrayIndexOutOfBounds"):
        check([tmp_path], HERE, tmp_path)


# ----------------------------------------------------------------------------------------------------- size

GRAPH = """graph: { title: "x.c"
node: { title: "top" label: "top\\nx.c:1:1\\n16 bytes (static)" }
edge: { sourcename: "top" targetname: "x.c:low" label: "x.c:2:2" }
edge: { sourcename: "top" targetname: "memcpy" }
node: { title: "x.c:low" label: "low\\nx.c:3:1\\n40 bytes (static)" }
node: { title: "side" label: "side\\nx.c:9:1\\n48 bytes (static)" }
}
"""


def test_stack_is_the_deepest_path() -> None:
    assert c_size.stacks([GRAPH]) == {"top": 56, "side": 48}
    for target, text in (("top", "itself"), ("__indirect_call", "pointer")):
        loop = GRAPH + f'edge: {{ sourcename: "x.c:low" targetname: "{target}" }}\n'
        with pytest.raises(SystemExit, match=text):
            c_size.stacks([loop])


def test_the_committed_sizes_are_in_the_readme(tmp_path: Path) -> None:
    found = json.loads(c_size.SIZES.read_text())
    copy = tmp_path / "README.md"
    copy.write_text((DRIVER / "README.md").read_text())
    assert not fill(copy, "size", c_size.text(found))


def test_the_committed_sizes_are_measured() -> None:
    if reason := missing(ARM):
        pytest.skip(reason)
    found, stored = c_size.measure(), json.loads(c_size.SIZES.read_text())
    if found["compiler"] != stored["compiler"]:
        pytest.skip(f"sizes are of {stored['compiler']}, here is {found['compiler']}")
    assert found == stored, "run make c"
