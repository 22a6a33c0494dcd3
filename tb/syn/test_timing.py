# SPDX-License-Identifier: Apache-2.0
"""The longest-path search, on an SDF small enough to do by hand."""

from pathlib import Path

from syn.timing import longest_paths, read_sdf, register_name

SDF = """(DELAYFILE
  (CELL
    (CELLTYPE "top")
    (INSTANCE )
    (DELAY
      (ABSOLUTE
        (INTERCONNECT a_TRELLIS_FF_Q/Q add_CCU2C\\$CCU2_COMB0/A (0:0:100) (0:0:100))
        (INTERCONNECT add_CCU2C\\$CCU2_COMB0/FCO add_CCU2C\\$CCU2_COMB1/FCI (0:0:0) (0:0:0))
        (INTERCONNECT add_CCU2C\\$CCU2_COMB1/F b_TRELLIS_FF_Q/DI (0:0:200) (0:0:200))
        (INTERCONNECT a_TRELLIS_FF_Q/Q b_TRELLIS_FF_Q_1/DI (0:0:50) (0:0:50))
        (INTERCONNECT pin\\$tr_io/O c_TRELLIS_FF_Q/DI (0:0:9000) (0:0:9000))
        (INTERCONNECT b_TRELLIS_FF_Q/Q c_TRELLIS_FF_Q/CE (0:0:10) (0:0:10))
      )
    )
  )
"""


def flip_flop(name: str, port: str) -> str:
    return f"""  (CELL
    (CELLTYPE "TRELLIS_FF")
    (INSTANCE {name})
    (DELAY
      (ABSOLUTE
        (IOPATH CLK Q (300:350:400) (300:350:400))
      )
    )
    (TIMINGCHECK
      (SETUPHOLD (posedge {port}) (posedge CLK) (0:0:30) (213:222:232))
    )
    )
"""


def carry(name: str, source: str, sink: str, delay: int) -> str:
    return f"""  (CELL
    (CELLTYPE "TRELLIS_COMB")
    (INSTANCE {name})
    (DELAY
      (ABSOLUTE
        (IOPATH {source} {sink} (0:0:{delay}) (0:0:{delay}))
      )
    )
    )
"""


def test_worst_path_first_one_for_each_pair_of_registers(tmp_path: Path) -> None:
    file = tmp_path / "a.sdf"
    cells = [flip_flop("a_TRELLIS_FF_Q", "DI"), flip_flop("b_TRELLIS_FF_Q", "DI")]
    cells += [flip_flop("b_TRELLIS_FF_Q_1", "DI"), flip_flop("c_TRELLIS_FF_Q", "CE")]
    cells += [
        carry("add_CCU2C\\$CCU2_COMB0", "A", "FCO", 350),
        carry("add_CCU2C\\$CCU2_COMB1", "FCI", "F", 300),
    ]
    file.write_text(SDF + "".join(cells) + ")\n")
    paths = longest_paths(read_sdf(file))
    # 400 clock-to-out + 100 + 350 + 0 + 300 + 200 + 30 set-up; the second bit of b and the pin don't count
    assert [(p.start, p.end, p.delay_ns, p.through) for p in paths] == [
        ("a", "b", 1.38, ("carry x2",)),
        ("b", "c", 0.44, ()),
    ]


def test_names_go_back_to_the_source() -> None:
    assert register_name("u_a1.u_high.product_TRELLIS_FF_Q_26") == "u_a1.u_high.product"
    assert register_name("u_g01.product_TRELLIS_FF_Q_28_DI_MULT18X18D_P17") == "u_g01.product"
