# SPDX-License-Identifier: Apache-2.0
"""Bit-exact model of the solve engine (rtl/oltae/solve_engine.v): dot lanes, divider, microprogram."""

from __future__ import annotations

from dataclasses import dataclass, field

from relnav import words
from relnav.model import assembler as asm
from relnav.model import pose_program as pose
from relnav.model.assembler import LANES
from relnav.model.binary32 import to_binary32
from relnav.model.lane import ONE, ZERO, DotLane, LaneValue
from relnav.model.reciprocal import reciprocal
from relnav.model.rom import DRAIN_LATENCY, Program

EXPONENT_FLOOR = -(1 << (words.EXPO - 1))
MANT_POINT = words.MANT - 2  # ONE's exponent is -MANT_POINT


@dataclass
class Solver:
    """Register files, scale registers and outputs of the solve engine for one frame."""

    forbid_turns: bool = False
    reapply: bool = False
    registers: list[list[LaneValue]] = field(default_factory=lambda: [[ZERO] * 64 for _ in range(LANES)])
    lanes: list[DotLane] = field(default_factory=lambda: [DotLane(wide=lane == 0) for lane in range(LANES)])
    turn: int = 0
    moment_scale: int = EXPONENT_FLOOR
    cross_scale: int = EXPONENT_FLOOR
    quaternion_scale: int = EXPONENT_FLOOR
    centroid_scale: int = EXPONENT_FLOOR
    determinant: int = 0
    estimated: bool = True
    low_limbs: list[tuple[int, LaneValue]] = field(default_factory=list)
    outputs: dict[int, LaneValue] = field(default_factory=dict)
    fixed_outputs: dict[int, int] = field(default_factory=dict)
    saturated: bool = False

    def __post_init__(self) -> None:
        for bank in self.registers:
            bank[pose.ONE] = ONE

    def load(self, address: int, value: LaneValue) -> None:
        """A stream item arrives: broadcast to every lane's stream bank."""
        for bank in self.registers:
            bank[asm.STREAM + address] = value
        kind = address & 7
        if address == pose.ITEM_VARIANCE:
            self.estimated = value[0] == 0
        if address < 24 and value[0]:
            if kind == pose.KIND_T:
                self.moment_scale = max(self.moment_scale, value[1])
            if kind == pose.KIND_N:
                self.cross_scale = max(self.cross_scale, value[1])

    def reference(self, code: int, lane: int) -> int:
        """Reference exponent of a dot product, from the scales of the frame."""
        match code:
            case asm.REF_MOMENT:
                return self.moment_scale - MANT_POINT + 1
            case asm.REF_CROSS:
                return (self.moment_scale if lane else self.cross_scale) - MANT_POINT
            case asm.REF_QUATERNION:
                return 2 * self.quaternion_scale + 4  # |p|^2 / 2 may enter as a normalised value
            case asm.REF_UNIT:
                return -63
            case asm.REF_CENTROID:
                return self.centroid_scale - MANT_POINT + 4
            case asm.REF_ROTATED:
                return 2 * self.quaternion_scale + self.centroid_scale + 35
            case asm.REF_IMAGE:
                return self.moment_scale + self.quaternion_scale + 6
            case asm.REF_FORM:
                return self.moment_scale + 2 * self.quaternion_scale + 42
            case asm.REF_COFACTOR:
                return 2 * self.moment_scale + 8
            case asm.REF_NEWTON:
                return self.moment_scale - MANT_POINT + 5
            case asm.REF_FIXED:
                return -17 - words.LANE_DROP
        raise ValueError(f"no reference {code}")

    def execute(self, dot: asm.Dot) -> None:
        """One dot product in all lanes that anything is taken from."""
        operands = dot.operands[self.estimated, self.reapply]
        used = dot.used[self.turn]
        for number in used:
            lane, bank = self.lanes[number], self.registers[number]
            if dot.reference == asm.OWN:
                lane.run(bank, operands[number], None)
            elif dot.reference == asm.REF_PROBED:
                lane.run_probed(bank, operands[number])
            elif dot.kind == asm.FIXED:
                lane.run_fixed(bank, operands[number], self.reference(dot.reference, number))
            else:
                lane.run(bank, operands[number], self.reference(dot.reference, number))
        if dot.choose_turn:
            compared = [lane.narrow >> words.RANK_BITS for lane in self.lanes]
            best = max(range(LANES), key=lambda k: (compared[k], -k))
            self.turn = 0 if self.forbid_turns else best
            self.determinant = compared[self.turn]
        self.finish(dot, used)

    def finish(self, dot: asm.Dot, used: list[int]) -> None:
        """Write, track, divide, output."""
        if dot.kind == asm.FIXED:
            self.fixed_outputs[dot.output_index] = self.lanes[0].fixed()
            self.saturated = self.lanes[0].saturated
            return
        values = [ZERO] * LANES
        for number in used:
            lane = self.lanes[number]
            values[number] = lane.raw() if dot.kind == asm.RAW else lane.result(dot.half, dot.clamp)
        broadcast = values[self.turn if dot.source == asm.TURN else dot.source]
        suppressed = dot.only_turned and self.turn == 0
        dest = dot.dest | (8 if dot.turn_dest and self.turn == 0 else 0)
        if not suppressed:
            if dot.write == asm.PRIVATE:
                for number, bank in enumerate(self.registers):
                    bank[dest] = values[number]
            elif dot.write == asm.BROADCAST:
                for bank in self.registers:
                    bank[dest] = broadcast
            if dot.track == asm.TRACK_QUATERNION and dest & ~3 == pose.P and broadcast[0]:
                self.quaternion_scale = max(self.quaternion_scale, broadcast[1])
            if dot.track == asm.TRACK_AFRESH:
                self.quaternion_scale = broadcast[1] if broadcast[0] else EXPONENT_FLOOR
            if dot.track == asm.TRACK_CENTROID and broadcast[0]:
                self.centroid_scale = max(self.centroid_scale, broadcast[1])
        if dot.divide == asm.DIVIDE or (
            dot.divide in (asm.DIVIDE_UNTURNED, asm.DIVIDE_TURNED)
            and (dot.divide == asm.DIVIDE_TURNED) == (self.turn != 0)
        ):
            assert dot.divide_dest is not None
            for bank in self.registers:
                bank[dot.divide_dest] = reciprocal(broadcast)
        if dot.output == asm.SINGLE:
            self.outputs[dot.output_index] = values[0]
        elif dot.output != asm.NO_OUTPUT:
            stride = 3 if dot.output == asm.TRIPLE_COLUMN else 1
            for place in asm.OUTPUT_PLACES[dot.output]:
                self.outputs[dot.output_index + stride * place] = values[place + 1]

    def hold(self, address: int, value: LaneValue, low: bool = False) -> None:
        """An item for `run`: of the first drain, or a low limb of the second, in place of one not needed."""
        if low:
            self.low_limbs.append((address, value))
        else:
            self.load(address, value)

    def run(self, program: Program, *, whole: bool = True) -> None:
        """The program in issue order; the schedule proves that the pipelined engine does the same.

        The core drops a rank-deficient frame when the turn is chosen; ``whole`` is the engine alone.
        """
        step = range(program.call, program.call + len(program.newton) if self.reapply else program.call)
        pending = True
        for number, dot in enumerate(program.in_order(self.reapply)):
            if pending and number not in step and dot.cycle > program.redrain + DRAIN_LATENCY:
                pending = False
                for address, value in self.low_limbs:
                    for bank in self.registers:
                        bank[asm.STREAM + address] = value
            self.execute(dot)
            if dot.choose_turn and self.rank_deficient and not whole:
                return

    @property
    def rank_deficient(self) -> bool:
        """The chosen determinant is no more than rounding noise."""
        return self.determinant < 1

    @property
    def ill_conditioned(self) -> bool:
        """The chosen determinant keeps too few significant bits."""
        return not self.rank_deficient and self.determinant < 1 << (words.ILL_BITS - words.RANK_BITS)

    def words(self) -> dict[int, int]:
        """Result memory: index -> 32-bit word."""
        found = {index: to_binary32(value) for index, value in self.outputs.items()}
        found |= {index: value % (1 << 32) for index, value in self.fixed_outputs.items()}
        return found
