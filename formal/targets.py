# SPDX-License-Identifier: Apache-2.0
"""What is proved, and the faults that each proof must find.

A fault is an edit of the RTL as it stands (an edit that no longer fits is an error), the task that must fail
on it, and the assertion that must be among those that fail.
"""

from __future__ import annotations

from formal.runner import Broken, Group

SLAVE = "axi/axil_slave.v"
LOADER = "axi/frame_loader.v"
STATE = "axi/frame_state.v"
FILE = "axi/core_registers.v"
OLTAE = "axi/oltae_registers.v"
IVISNAV = "axi/ivisnav_registers.v"
VOTED = "trust/voted_register.v"
TWIN = "trust/twin_register.v"
DIGIT = "arith/srt_digit.v"
RECIPROCAL = "arith/reciprocal.v"
DIVIDE = "arith/float_divide.v"
STORE = "axi/result_store.v"
CELL = "gram/mac_cell.v"
RING = "gram/ring_store.v"
RESIDUE_MAC = "gram/residue_mac.v"
COEFFICIENTS = "gram/moment_coefficients.v"
ITEMS = "gram/item_residue.v"
BEATS = "gram/frame_residue.v"
RUN = "gram/sign_run.v"
NORMALISER = "gram/normaliser.v"
RECOMBINE = "gram/recombine.v"


def faults(task: str, file: str, *edits: tuple[str, str, str]) -> tuple[Broken, ...]:
    """Broken copies of one file for one task; an edit is (assertion that must fail, old text, new text)."""
    return tuple(Broken(task, file, old, new, label) for label, old, new in edits)


GO = "wire write_go = address_full && data_full && !s_axil_bvalid;"
IDLE_AGAIN = "assign s_axil_arready = running && !(issue || capture || s_axil_rvalid);"
ADDRESS_FREE = "assign s_axil_awready = running && !address_full;"
DATA_FREE = "assign s_axil_wready  = running && !data_full;"
MAJORITY = "assign q = (first & second) | (first & third) | (second & third);"

SLAVE_PROTOCOL = faults(
    "protocol_bmc",
    SLAVE,
    ("b_stays", "write_go || (s_axil_bvalid && !s_axil_bready)}", "write_go}"),
    ("b_needs_data", GO, "wire write_go = address_full && !s_axil_bvalid;"),
    ("b_needs_address", GO, "wire write_go = data_full && !s_axil_bvalid;"),
    ("write_once", GO, "wire write_go = address_full && data_full;"),
    ("b_comes", GO, "wire write_go = address_full && data_full && !s_axil_bvalid && s_axil_bready;"),
    (
        "b_not_early",
        "write_go || (s_axil_bvalid &&",
        "(address_full && (data_full || s_axil_wvalid)) || (s_axil_bvalid &&",
    ),
    ("one_address_waits", ADDRESS_FREE, ADDRESS_FREE.replace("address_full", "(address_full && data_full)")),
    ("one_data_waits", DATA_FREE, DATA_FREE.replace("data_full", "(address_full && data_full)")),
    ("awready_when_free", ADDRESS_FREE, ADDRESS_FREE.replace("address_full", "(address_full || data_full)")),
    ("wready_when_free", DATA_FREE, DATA_FREE.replace("!data_full", "!data_full && address_full")),
    ("b_error", "write_failed <= write_error || !write_fits;", "write_failed <= write_error;"),
    ("write_once", "= write_go && write_fits;", "= write_go;"),
    ("strobe_handed_on same_write_data", "write_strobe <= s_axil_wstrb;", "write_strobe <= 4'hF;"),
    ("write_handed_on", "if (s_axil_wready) begin", "if (s_axil_wvalid) begin"),
    (
        "parity_handed_on",
        "write_parity <= write_odd;",
        "write_parity <= {write_odd[3:2], write_odd[0], write_odd[1]};",
    ),
    ("no_false_alarm", "write_parity <= write_odd;", "write_parity <= {write_odd[3:1], write_odd[1]};"),
    (
        "b_reset same_write_state",
        ") write_register (\n      .clk(clk),\n      .rst(rst),",
        ") write_register (\n      .clk(clk),\n      .rst(1'b0),",
    ),
    ("r_stays same_read_state", "capture || (s_axil_rvalid && !s_axil_rready)}", "capture}"),
    ("r_stays", "if (capture) s_axil_rdata <= read_data;", "s_axil_rdata <= read_data;"),
    (
        "r_needs_request",
        "accept || (issue && read_wait)",
        "s_axil_arvalid || (issue && read_wait)",
    ),
    ("arready_when_free", IDLE_AGAIN, IDLE_AGAIN.replace("capture || ", "")),
    ("arready_comes", IDLE_AGAIN, IDLE_AGAIN.replace("issue ||", "issue || s_axil_arvalid ||")),
    (
        "r_answer same_read_failed",
        "if (go) read_failed <= read_error || !read_aligned;",
        "if (go) read_failed <= read_error;",
    ),
    ("r_comes", "capture || (s_axil_rvalid &&", "(capture && s_axil_rready) || (s_axil_rvalid &&"),
    ("read_once", "= issue && read_aligned;", "= issue;"),
    ("read_once", "accept || (issue && read_wait)", "accept"),
    (
        "read_handed_on same_read_address",
        "if (s_axil_arready) read_address",
        "if (s_axil_arvalid) read_address",
    ),
    (
        "r_reset",
        ") read_register (\n      .clk(clk),\n      .rst(rst),",
        ") read_register (\n      .clk(clk),\n      .rst(1'b0),",
    ),
)

SLAVE_PINS = faults(
    "dependence_bmc",
    SLAVE,
    (
        "ready_valid_registered",
        IDLE_AGAIN,
        IDLE_AGAIN.replace("s_axil_rvalid", "(s_axil_rvalid && !s_axil_rready)"),
    ),
) + (
    Broken(
        "dependence_bmc",
        SLAVE,
        "  wire issue, capture;\n",
        "  wire issue, capture, held;\n  assign capture = held && !s_axil_rready;\n",
        "same_state",
        (("  .q  ({issue, capture,", "  .q  ({issue, held,"),),
    ),
)

READY = "wire ready = (to_array && beat_ready) || (taken_here && !hold);"
VALID = "assign beat_valid = to_array && valid;"

STORE_FAULTS = faults(
    "middle_bmc",
    STORE,
    ("waits_for_writes", "assign read_wait = write_valid;", "assign read_wait = write_valid && read_valid;"),
    ("committed_read", "{write_bank == compare, write_index}", "{write_bank, write_index}"),
    ("difference_told", "{write_bank == compare, write_index}", "{!write_bank, write_index}"),
    ("difference_told", "memory[address] != write_data", "memory[address] < write_data"),
    ("no_difference", "differs <= compare && write_valid &&", "differs <= compare &&"),
    ("same_words", "if (write_valid && !compare)", "if (write_valid)"),
    ("committed_read", ": read_index < LAST_FIRST ?", ": read_index < LAST_FIRST - 1 ?"),
    ("committed_read", "write_index < LAST_FIRST ? bank[1]", "write_index < LAST_FIRST ? bank[0]"),
    ("silent", "read_valid && !write_valid ?", "!write_valid ?"),
    ("reset_bank same_bank", ".rst(rst),", ".rst(1'b0),"),
)

LOADER_FRONT = (
    *faults(
        "front_bmc",
        LOADER,
        ("no_beat_lost", READY, "wire ready = to_array || (taken_here && !hold);"),
        ("beats_add_up", READY, "wire ready = to_array || (taken_here && !hold);"),
        (
            "no_beat_twice",
            READY,
            "wire ready = (to_array && beat_ready && !last) || (taken_here && !hold);",
        ),
        ("no_beat_made", VALID, "assign beat_valid = to_array && (valid || push_valid);"),
        ("beat_stays", VALID, "assign beat_valid = to_array && valid && !weighted;"),
        ("beat_unchanged", "assign beat_data = from_push ?", "assign beat_data = push_valid ?"),
        ("beat_in_place", "(closing && !beat_weighted ?", "(closing ?"),
        ("weight_right same_weight", ".d(beat_data[15:0]),", ".d({1'b0, beat_data[14:0]}),"),
        ("mode_right", "assign beat_weighted = mode;", "assign beat_weighted = weighted;"),
        ("opens", "assign clear = !open && accept &&", "assign clear = !open &&"),
        ("clears", "assign frame_start = clear;", "assign frame_start = clear && !push_valid;"),
        ("closed_takes_none", "wire to_array = load &&", "wire to_array = !swallow &&"),
        ("reset_takes_none", "wire hold = soft_reset || (give_up && load);", "wire hold = give_up && load;"),
        ("abort_takes_none", "wire hold = soft_reset || (give_up && load);", "wire hold = soft_reset;"),
        ("takes", "wire hold = soft_reset || (give_up && load);", "wire hold = soft_reset || give_up;"),
        ("closed_by_reset", "if (soft_reset) next_state = IDLE;", ""),
        ("no_beat_made", "|| (give_up && load)) next_state = SWALLOW;", ") next_state = SWALLOW;"),
        ("open_right", "assign open = load || swallow;", "assign open = load;"),
        ("rows_right same_state", "count  <= count + 16'd1;", "count  <= count + {15'd0, !beat_last};"),
        ("upset_told", "upset <= (differ || give_up) && load", "upset <= (differ || give_up)"),
        ("one_source", "assign s_axis_tready = ready && !from_push;", "assign s_axis_tready = ready;"),
        (
            "push_told",
            "push_open = !open ? accept : from_push;",
            "push_open = !open || from_push;",
        ),
        ("drops_once", "assign frame_dropped = ends && !frame_end;", "assign frame_dropped = ends && !good;"),
        ("last_marked", "assign beat_last = last && closing && good;", "assign beat_last = last && closing;"),
        ("zero_right", "some <= !weighted;", "some <= 1'b0;"),
        (
            "drop_told",
            "assign bad_tlast = ends && load && !closing && !full;",
            "assign bad_tlast = 1'b0;",
        ),
        (
            "few_right",
            "assign few_rows = ends_row && !enough;",
            "assign few_rows = ends_row && !enough && some_weight;",
        ),
    ),
    *faults(
        "front_deep",
        LOADER,
        (
            "takes",
            "wire taken_here = swallow ||",
            "wire taken_here = (swallow && beat_ready) ||",
        ),
        ("long_right", "wire full = count == 16'hFFFF && first;", "wire full = count == 16'h7FFF && first;"),
        ("ends_once", "assign frame_end = ends_row && good;", "assign frame_end = ends_row && enough;"),
        ("tlast_right", "&& !closing && !full;", "&& !closing;"),
    ),
)

LOADER_INSIDE = (
    *faults(
        "inside_bmc",
        LOADER,
        ("few_right", "count[2:0] == ALMOST", "count[1:0] == ALMOST[1:0]"),
        ("weight_right", "assign beat_weight = beat_data[47:32];", "assign beat_weight = beat_data[15:0];"),
    ),
    *faults(
        "inside_deep",
        LOADER,
        ("zero_right", "some <= some || here;", "some <= here;"),
        ("beat_in_place", "localparam LAST = BEATS - 1,", "localparam LAST = BEATS - 2,"),
    ),
)

LOADER_PLAIN = faults(
    "plain_deep",
    LOADER,
    ("long_right", "assign too_long = fire && load && full;", "assign too_long = fire && full;"),
    ("no_beat_lost", "(fire && load && full) ||", "(fire && load && count[15]) ||"),
)

STATE_FAULTS = (
    *faults(
        "short_bmc",
        STATE,
        ("reset_to_idle", "soft_reset | watchdog | upset;", "soft_reset | upset;"),
        ("reset_to_idle", "soft_reset | watchdog | upset;", "soft_reset | watchdog;"),
        (
            "compute_bounded",
            "(computing | verifying) & cycles[WATCHDOG_BITS];",
            "(computing | verifying) & cycles[15];",
        ),
        (
            "watchdog_right",
            "assign watchdog = (computing | verifying) & cycles",
            "assign watchdog = computing & cycles",
        ),
        ("commit_in_compute", "assign commit = done & {3{computing}};", "assign commit = done;"),
        ("done_held", "else if (acknowledge) state_next = IDLE;", "else state_next = IDLE;"),
        ("accept_when_idle", "(state_next == IDLE || state_next == DONE)", "(state_next == IDLE)"),
        (
            "begins_accepted",
            "(state_next == IDLE || state_next == DONE)",
            "(state_next == IDLE || state_next == DONE || done[0])",
        ),
        ("state_told", "assign loading = state == LOADING;", "assign loading = state[0];"),
        (
            "idle_left",
            "IDLE: if (frame_start) state_next",
            "IDLE: if (frame_start & ~acknowledge) state_next",
        ),
        (
            "loading_left",
            "if (frame_end) state_next = COMPUTE;",
            "if (frame_end | frame_dropped) state_next = COMPUTE;",
        ),
        ("compute_left", "if (refused) state_next = IDLE;", "if (refused) state_next = DONE;"),
        (
            "busy_told",
            "assign busy = loading | computing | verifying;",
            "assign busy = computing | verifying;",
        ),
        ("results_told", "frame_start | (busy & (upset | watchdog)) ? 3'd0 :", "frame_start ? 3'd0 :"),
        ("results_told", "cycles    <= frame_end ? 16'd1 :", "cycles    <= frame_end ? 16'd0 :"),
        ("named_state", "VERIFY != 0 ? VERIFYING : DONE;", "3'd7;"),
        ("completes_verified", "verifying & repeated & ~given_up : solved;", "solved : solved;"),
        ("verify_left", "else if (repeated) state_next = DONE;", "else if (done[2]) state_next = DONE;"),
        ("forgets", "again_1   <= solved;", "again_1   <= computing & done[2];"),
    ),
    *faults(
        "short_bmc",
        LOADER,
        ("loads_only", "if (soft_reset) next_state = IDLE;", ""),
        ("ends_loaded", "if (soft_reset) next_state = IDLE;", ""),
        (
            "never_lost same_state",
            "assign frame_dropped = ends && !frame_end;",
            "assign frame_dropped = ends && !frame_end && !bad_tlast;",
        ),
    ),
)

READ_BITS = "if (!(read_low && (at_flags || at_frame_flags || at_frac))) bits"
FLAGS_NEXT = "(flags & ~(ones & {FLAGS{to_flags}})) | raised"
IRQ_NEXT = "(irq_status & ~(write_data[1:0] & {2{to_irq_status}})) | {|raised, frame_complete}"

FILE_FAULTS = (
    *faults(
        "full_bmc",
        FILE,
        ("write_answer", ".write_error(!write_mapped)", ".write_error(1'b0)"),
        ("read_error", ".read_error(!read_mapped)", ".read_error(1'b0)"),
        ("read_returns", "word_pick[0] ? weight : data_b", "word_pick[0] ? data_b : weight"),
        ("read_returns", READ_BITS, READ_BITS.replace("read_low && ", "")),
        ("read_returns same_fetched", "constants <= VERSION_RESET;", "constants <= ID;"),
        (
            "results_asked",
            "assign result_valid = read_valid && read_mapped &&",
            "assign result_valid = read_valid &&",
        ),
        (
            "result_place",
            "assign result_index = read_word[7:2];",
            "assign result_index = {1'b0, read_word[6:2]};",
        ),
        ("frac_written", "write_data[8*i+6] && write_data[8*i+5]", "write_data[8*i+6]"),
        (
            "locked_while_busy",
            "if (to_variance && write_strobe[b] && !busy)",
            "if (to_variance && write_strobe[b])",
        ),
        ("variance_written", "if (to_variance && write_strobe[b] && !busy)", "if (to_variance && !busy)"),
        ("control_pulses", "to == CONTROL_ADDRESS[6:2] && write_strobe[0];", "to == CONTROL_ADDRESS[6:2];"),
        ("push_written", "wire push_taken = to_push && !push_locked;", "wire push_taken = to_push;"),
        (
            "push_stays same_words",
            "if (to_data_b && write_strobe[b] && !push_waits)",
            "if (to_data_b && write_strobe[b])",
        ),
        ("push_last_written", "write_data[PUSH_LAST_LSB] && write_strobe[0]", "write_data[PUSH_LAST_LSB]"),
        ("flags_right", FLAGS_NEXT, "(flags | raised) & ~(ones & {FLAGS{to_flags}})"),
        ("flags_right", FLAGS_NEXT, "(to_flags ? {FLAGS{1'b0}} : flags) | raised"),
        ("flags_right", "{{FLAGS - 8{write_strobe[1]}}, {8{write_strobe[0]}}}", "{FLAGS{write_strobe[0]}}"),
        ("frame_flags_right", "~{FLAGS{frame_start}}) | raised,", "~{FLAGS{frame_start}}) | flag_set,"),
        (
            "irq_right",
            IRQ_NEXT,
            "(irq_status | {|raised, frame_complete}) & ~(write_data[1:0] & {2{to_irq_status}})",
        ),
        ("irq_right", "to_irq_enable ? write_data", "to_irq_enable && !busy ? write_data"),
        ("irq_level", "<= |(irq_enable & irq_status);", "<= |irq_status;"),
        (
            "frame_counted",
            "frame + {15'd0, frame_complete}",
            "write_low && to == STATUS_ADDRESS[6:2] ? write_data[31:16] : frame + {15'd0, frame_complete}",
        ),
        (
            "no_false_alarm",
            "variance_parity[b] <= write_parity[b];",
            "variance_parity[b] <= write_parity[0];",
        ),
        ("no_false_alarm same_parity", "variance_parity[b] <= ~^", "variance_parity[b] <= ^"),
    ),
    *faults(
        "full_bmc",
        SLAVE,
        ("b_stays", "write_go || (s_axil_bvalid && !s_axil_bready)}", "write_go}"),
        ("r_stays", "capture || (s_axil_rvalid && !s_axil_rready)}", "capture}"),
        ("read_answer_due same_bus", "accept || (issue && read_wait)", "accept"),
        ("one_stage", IDLE_AGAIN, IDLE_AGAIN.replace("capture || ", "")),
        ("same_failed", "read_failed <= read_error || !read_aligned;", "read_failed <= read_error;"),
        ("same_read", "if (s_axil_arready) read_address", "if (s_axil_arvalid) read_address"),
        ("same_address", "write_address_parity <= write_address_odd;", "write_address_parity <= 1'b0;"),
        ("same_data", "write_parity <= write_odd;", "write_parity <= {write_odd[3:1], write_odd[1]};"),
    ),
    *faults(
        "full_bmc",
        OLTAE,
        ("config_locked", "to_config && write_strobe[0] && !busy;", "to_config && write_strobe[0];"),
        ("config_written", "to_config && write_strobe[0] && !busy;", "to_config && !busy;"),
        ("flags_right", ".own_locked(busy && to_config)", ".own_locked(1'b0)"),
        ("read_returns", "if (!(read_valid && (at_config || at_turn))) own <= 4'd0;", ""),
    ),
)

BARE_FAULTS = faults(
    "bare_bmc",
    OLTAE,
    ("config_built", "wire [3:0] given = write_data[3:0] & BUILT;", "wire [3:0] given = write_data[3:0];"),
    ("no_false_alarm", "parity <= ^{given, asks};", "parity <= ^given;"),
    ("flags_right", "(set_config && asks) || (frame_start && asked);", "(set_config && asks);"),
)

IVISNAV_FAULTS = (
    *faults(
        "bmc",
        IVISNAV,
        ("read_returns", "read_valid && read_word == CONDITION_ADDRESS[11:2] ?", "read_valid ?"),
        ("read_error", ".read_mapped(is_mapped(read_word))", ".read_mapped(1'b1)"),
        ("flags_right", ".flag_set(flag_set & ~GAPS)", ".flag_set(flag_set)"),
    ),
    *faults(
        "bmc",
        FILE,
        ("frac_written", "for (i = 0; i < FRACS; i = i + 1)", "for (i = 0; i < 1; i = i + 1)"),
        ("locked_while_busy", "write_strobe[b] && !busy && frac_fits)", "write_strobe[b] && frac_fits)"),
    ),
)

TRIPLE_TOP = "{{2{triple[WIDTH+1]}}, triple[WIDTH+1-:7]}"

DIGIT_FAULTS = faults(
    "reciprocal_bmc",
    DIGIT,
    (
        "next_bounded",
        "wire [8:0] t_3 = {five[13], five[13:6]};",
        "wire [8:0] t_3 = {seven[13], seven[13:6]};",
    ),
    ("next_exact", ".in_2(triple[WIDTH-1:0])", ".in_2({divisor[WIDTH-2:0], 1'b0})"),
    ("subtract_right", "assign subtract = positive & reached[1];", "assign subtract = positive;"),
    ("sign_right", "assign positive = ~(below_zero ^ divisor[WIDTH-1]);", "assign positive = ~below_zero;"),
)

DIVIDE_FAULTS = (
    *faults(
        "divide_bmc", DIGIT, ("next_bounded", TRIPLE_TOP, "{{2{triple[WIDTH+1]}}, triple[WIDTH+1-:5], 2'b00}")
    ),
    *faults("divide_all", DIGIT, ("thermometer", TRIPLE_TOP, "{triple[WIDTH+1], triple[WIDTH+1-:8]}")),
)

RECIPROCAL_FAULTS = faults(
    "anywhere",
    RECIPROCAL,
    ("quotient_right", "divisor[34] ? 5'sd1 : -5'sd1", "-5'sd1"),
    ("digits_right", "positive ? size - 3'd1 : ~size;", "positive ? size - 3'd1 : -size;"),
    ("digit_legal", "positive ? size - 3'd1 : ~size;", "size - 3'd1;"),
    ("done_on_time", "assign done = step == LAST[3:0];", "assign done = step == DIGITS[3:0];"),
    ("same_step", "(step == 4'd0 || step == LAST[3:0])", "step == LAST[3:0]"),
    ("same_divisor", "divisor  <= value[34:0];", "divisor  <= {value[34:1], 1'b0};"),
    ("remainder_exact", "remainder <= 35'h080000000;", "remainder <= 35'h080000001;"),
    ("exact", "else remainder <= next;", "else remainder <= next + {34'd0, step == DIGITS[3:0]};"),
    ("exponent_right", "result = {1'b0, exponent,", "result = {1'b0, exponent + 12'd1,"),
    ("operands_fit", "seven    <= {leading, 3'd0} -", "seven    <= {leading, 3'd0} +"),
    ("same_exponent", "exponent <= -12'd65 + ~value[46:35];", "exponent <= -12'd64 + ~value[46:35];"),
)

FLUSH_FAULTS = faults(
    "flush_anywhere",
    DIVIDE,
    ("same_step", "step == LAST[3:0]) ? 4'd0", "step == 4'd15) ? 4'd0"),
    ("done_on_time", "done <= finish & ~rst;", "done <= finish;"),
    ("same_kinds", "zero     <= x_zero | y_ones;", "zero     <= x_zero;"),
    ("normalised", "if (start) held <=", "if (start & ~y[0]) held <="),
    ("same_range", "above_128  <= difference > 128;", "above_128  <= difference >= 128;"),
    (
        "operands_fit",
        "five      <= {1'b0, leading, 2'd0} + {3'd0, leading};",
        "five      <= {1'b0, leading, 2'd0};",
    ),
    ("same_divisor", "divisor   <= y_f;", "divisor   <= x_f;"),
    ("remainder_exact", "remainder <= {3'd0, x_f};", "remainder <= {3'd0, x_f[23:1], 1'b0};"),
    ("same_digits", "whole <= {opposite ?", "whole <= {positive ?"),
    ("exact", "else remainder <= next;", "else remainder <= next ^ {26'd0, step == 4'd9};"),
    (
        "quotient_in_range floor_in_range",
        "else remainder <= next;",
        "else remainder <= next ^ {27{step == 4'd9}};",
    ),
    ("stays", "if (finish) begin", "if (finish | done) begin"),
    ("rounded_once", "wire sticky = |remainder |", "wire sticky = |remainder[26:1] |"),
    ("rounded_once", "wire up = (guard & (lost | fraction[0])) | edge_case;", "wire up = guard | edge_case;"),
    ("rounded_once", "(is_m127 & high) |", "(is_m127 & high & lost) |"),
    ("rounded_once", "assign over = above_128 | (is_128 & high);", "assign over = above_128;"),
    ("rounded_once", "if (nan) quotient[22] <= 1'b1;", "if (nan & ~zero) quotient[22] <= 1'b1;"),
)

GRADUAL_FAULTS = faults(
    "gradual_anywhere",
    DIVIDE,
    ("same_operands", "x_zeros    <= x_count;", "x_zeros    <= {x_count[4:1], 1'b0};"),
    ("normalised", "y_left <= y_raw << y_zeros;", "y_left <= y_raw << y_zeros[3:0];"),
    ("same_kept", "kept_sticky <= sticky;", "kept_sticky <= |remainder;"),
    ("rounded_once", "|short[9:5] ? 5'd31 :", "|short[9:6] ? 5'd31 :"),
    ("rounded_once", "wire tiny = short > 0;", "wire tiny = short > 1;"),
    ("rounded_once", "assign lost = kept_sticky |", "assign lost = 1'b0 |"),
    ("rounded_once", "assign over = exponent > 254;", "assign over = exponent > 255;"),
)

RUN_FAULTS = faults(
    "bmc",
    RUN,
    ("any_right", "assign any = |some;", "assign any = |some[3:1];"),
    ("count_right", "(x[4:3] == 2'b00 && (x[2] || !x[1]))", "(x[4:3] == 2'b00 && x[2])"),
)

NORMALISER_FAULTS = faults(
    "upper_98_bmc",
    NORMALISER,
    ("mant_right", "({35{fine[1:0] == 2'd1}} & by_4[36:2])", "({35{fine[1:0] == 2'd1}} & by_4[37:3])"),
    ("zero_right", "wire is_zero = !(top_bit || |by_1[33:0]);", "wire is_zero = !(|by_1[33:0]);"),
    ("exp_right", "exp_2 - {8'd0, fine};", "exp_2 - {9'd0, fine[2:0]};"),
    ("normalised", "(quad[1] || !quad[2]);", "quad[1];"),
    ("valid_right", "out_tag <= tag_2;", "out_tag <= tag_1;"),
)

CELL_FAULTS = faults(
    "bmc",
    CELL,
    (
        "product_bounded",
        "else product <= x_factor * y_factor;",
        "else product <= (x_factor * y_factor) <<< 1;",
    ),
    (
        "sum_exact",
        "{{SUM_BITS - X_BITS - Y_BITS{product[X_BITS+Y_BITS-1]}}, product}",
        "{{SUM_BITS - X_BITS - Y_BITS{1'b0}}, product}",
    ),
    ("sum_exact", "sum <= extended + addend;", "sum <= (extended + addend) <<< 15 >>> 15;"),
    (
        "same_addend addend_bounded",
        "if (addend_clear) addend <= 0;\n    else if (addend_load)",
        "if (addend_load)",
    ),
    ("sum_bounded", "if (clear) sum <= 0;\n    else if (accumulate)", "if (accumulate)"),
)

RING_FAULTS = (
    *faults(
        "three_bmc",
        RING,
        ("then_comes", "else if (advance) ring <= from_sum;", "else ring <= from_sum;"),
        (
            "then_comes all_cleared",
            "if (clear) ring <= 0;\n        else if (advance) ring <= from_sum;",
            "if (advance) ring <= from_sum;",
        ),
    ),
    *faults(
        "three_bmc",
        CELL,
        ("next_comes", "else if (addend_load) addend", "else if (addend_load && !skip) addend"),
        ("last_is_sum", "else if (accumulate) sum <= extended + addend;", "else sum <= extended + addend;"),
    ),
)

FOUR_FAULTS = faults(
    "four_bmc",
    RING,
    (
        "newest_waits",
        "{ring[(DEPTH-1)*BITS-1:0], from_sum}",
        "{from_sum, ring[(DEPTH-1)*BITS-1:0]}",
    ),
    ("then_comes", "ring[DEPTH*BITS-1-:BITS];", "ring[BITS-1:0];"),
)

RECOMBINE_FAULTS = faults(
    "weighted_bmc",
    RECOMBINE,
    ("moment_exact", "$signed({{32{middle[47]}}, middle[47:16]});", "$signed({32'd0, middle[47:16]});"),
    ("moment_exact", "upper  <= top_1 + (high_1 >>> 16);", "upper  <= top_1 + (high_1 >> 16);"),
    ("moment_exact", "if (!with_top) top_1 <= 0;\n        else top_1 <= top;", "top_1 <= top;"),
    (
        "moment_exact",
        "reg signed [47:0] difference, fraction, middle;",
        "reg signed [45:0] difference, fraction, middle;",
    ),
)

COEFFICIENT_FAULTS = faults(
    "array_bmc",
    COEFFICIENTS,
    ("bit_seen", "RING == 0 && k < 28 && k != 24;", "RING == 0 && k < 27 && k != 24;"),
    ("sums_differ", "LANE == 1 || LANE == 4 || LANE == 5 ? 1 : 0;", "LANE == 1 || LANE == 4 ? 1 : 0;"),
    ("taken_once", "k == 56 || k == 57 ? 1 : 0;", "k == 56 || k == 57 ? 3 : 0;"),
)

JUDGE_FAULTS = faults(
    "judge_bmc",
    ITEMS,
    ("on_time", "checked  <= ends[6] && rounds[1] &&", "checked  <= ends[6] && rounds[0] &&"),
    ("no_false_alarm", "&& sum[17:0] != 18'd0;", ";"),
    ("none_missed", "sum[17:0] != 18'd0;", "sum[17:1] != 17'd0;"),
)

GROUPS = (
    Group("axil_slave", "protocol_prove", "AXI4-Lite: answers, stability, SLVERR, accesses", SLAVE_PROTOCOL),
    Group("axil_slave", "dependence_prove", "no ready or valid depends on an input of its clock", SLAVE_PINS),
    *(
        Group(
            "axil_slave",
            f"{copy}_prove",
            f"AXI4-Lite as above while the {copy} copy of every voted bit is anything in every clock",
            faults(f"{copy}_bmc", VOTED, (label, MAJORITY, f"assign q = {fault};")),
        )
        for copy, label, fault in (
            ("first", "b_stays same_write_address", "first"),
            ("second", "r_stays", "second & (first | third)"),
            ("third", "awready_when_free", "third | (first & second)"),
        )
    ),
    Group(
        "oltae_registers", "full_prove", "register map: write, read, W1C, locks, push, interrupt", FILE_FAULTS
    ),
    Group("oltae_registers", "bare_prove", "the same without weights, covariance, reapply", BARE_FAULTS),
    Group(
        "ivisnav_registers", "prove", "register map: write, read, W1C, locks, push, interrupt", IVISNAV_FAULTS
    ),
    Group(
        "frame_loader", "plain_prove", "AXI4-Stream sink, no weights: beats, verdicts, flags", LOADER_PLAIN
    ),
    Group("frame_loader", "front_prove", "AXI4-Stream sink, weights in front", LOADER_FRONT),
    Group("frame_loader", "inside_prove", "AXI4-Stream sink of ivisnav", LOADER_INSIDE),
    Group(
        "frame_loader",
        "front_pins_prove",
        "no valid depends on a ready, no ready on a valid (weights in front)",
        faults(
            "front_pins_bmc",
            LOADER,
            ("valid_needs_no_ready", VALID, "assign beat_valid = to_array && valid && beat_ready;"),
            (
                "ready_needs_no_valid",
                "s_axis_tready = ready && !from_push;",
                "s_axis_tready = fire && !from_push;",
            ),
        ),
    ),
    Group("frame_loader", "plain_pins_prove", "the same, no weights"),
    Group("frame_loader", "inside_pins_prove", "the same, ivisnav"),
    Group(
        "frame_state",
        "oltae_prove",
        "states, watchdog, commits, times; behind the loader of oltae",
        STATE_FAULTS,
    ),
    Group("frame_state", "ivisnav_prove", "the same behind the loader of ivisnav"),
    Group(
        "frame_state",
        "upset_prove",
        "a state without a name is left at once",
        faults("upset_bmc", STATE, ("upset_left", "default: state_next = IDLE;", "default: ;")),
    ),
    Group(
        "result_store",
        "middle_prove",
        "only committed words are read, 0 without a read; group pose",
        STORE_FAULTS,
    ),
    Group("result_store", "first_prove", "the same, group q"),
    Group("result_store", "last_prove", "the same, group all"),
    Group("result_store", "ivisnav_prove", "the same, ivisnav"),
    Group(
        "srt_digit",
        "reciprocal_bmc",
        "digit, next remainder and its bound, all 35-bit operands",
        DIGIT_FAULTS,
    ),
    Group("srt_digit", "divide_bmc", "the same, all 27-bit operands", DIVIDE_FAULTS),
    Group(
        "reciprocal",
        "prove",
        "2^61 / m towards zero for every 35-bit m, with srt_digit by its contract",
        RECIPROCAL_FAULTS,
    ),
    *(
        Group(
            "float_divide",
            f"{kind}_{part}",
            f"{about}, {operands}",
            faulty if part == "rounding" else (),
        )
        for kind, operands, faulty in (
            ("flush", "denormals as 0", FLUSH_FAULTS),
            ("gradual", "gradual underflow", GRADUAL_FAULTS),
        )
        for part, about in (
            ("remainder", "x / y of every pair: 8^k x_f = q y_f + r, with srt_digit by its contract"),
            ("digits", "the registers are that quotient"),
            ("exact", "rounded down it is x_f / y_f 2^25"),
            ("rounding", "it is rounded once, to nearest even, in time"),
            ("reset", "what these presume holds after a reset"),
        )
    ),
    Group("sign_run", "bmc", "exact for all inputs", RUN_FAULTS),
    Group(
        "normaliser",
        "upper_98_bmc",
        "mantissa, exponent, zero, tag of every 98-bit integer",
        NORMALISER_FAULTS,
    ),
    Group("normaliser", "upper_130_bmc", "the same, 130 bits"),
    Group(
        "normaliser",
        "upper_144_bmc",
        "the same, 144 bits",
        faults(
            "upper_144_bmc",
            NORMALISER,
            ("exp_right", "- {4'd0, group, 4'd0};", "- {5'd0, group[2:0], 4'd0};"),
        ),
    ),
    Group(
        "normaliser",
        "lower_98_bmc",
        "the 34 bits below, 98 bits",
        faults("lower_98_bmc", NORMALISER, ("mant_right", "(value_1 << 98)", "(value_1 << 96)")),
    ),
    Group("normaliser", "lower_130_bmc", "the same, 130 bits"),
    Group(
        "mac_cell", "prove", "48 bits never overflow in a frame of 65535 rows; the sum is exact", CELL_FAULTS
    ),
    Group(
        "ring_store",
        "three_prove",
        "three accumulators that go round with mac_cell: each gets its own products, none another's",
        RING_FAULTS,
    ),
    Group("ring_store", "four_prove", "the same, four accumulators", FOUR_FAULTS),
    Group(
        "residue_mac",
        "plus_bmc",
        "sum of (x + y) factor, of reduced width",
        faults(
            "plus_bmc",
            RESIDUE_MAC,
            ("sum_right", "sum <= extended + base;", "sum <= extended + sum;"),
            ("sum_right", "product <= term * held;", "product <= term * factor;"),
        ),
    ),
    Group(
        "residue_mac",
        "minus_bmc",
        "the same with x - y",
        faults("minus_bmc", RESIDUE_MAC, ("sum_right", "wide_x - wide_y;", "wide_y - wide_x;")),
    ),
    Group(
        "moment_coefficients",
        "array_bmc",
        "a wrong bit of a sum changes it modulo 2^16 + 1; no two sums weigh alike; gram_array",
        COEFFICIENT_FAULTS,
    ),
    Group(
        "moment_coefficients",
        "ring_bmc",
        "the same, gram_ring",
        faults(
            "ring_bmc", COEFFICIENTS, ("bit_seen", "WEIGHT = RING != 0 ? 2 :", "WEIGHT = RING != 0 ? 0 :")
        ),
    ),
    Group(
        "frame_residue",
        "array_bmc",
        "what a beat adds, folding, term: congruent modulo 2^16 + 1; gram_array",
        faults(
            "array_bmc",
            BEATS,
            (
                "row_right",
                "{2'd0, beat_data[15:0]} - {{2{beat_data[31]}}",
                "{2'd0, beat_data[15:0]} - {{2{1'b0}}",
            ),
            ("row_right", "index[0] ? high <<< 3 :", "index[0] ? high <<< 2 :"),
            ("folded_right", "{2'd0, s[15:0]} - {{6{s[27]}}", "{2'd0, s[15:0]} + {{6{s[27]}}"),
            ("term_right", ".x({3'b010, square[15:0]}),", ".x({3'b001, square[15:0]}),"),
        ),
    ),
    Group(
        "frame_residue",
        "ring_bmc",
        "the same, gram_ring",
        faults("ring_bmc", BEATS, ("row_right", "if (BEATS == 4 && beat_index == 2'd3) f_b <= 18'd0;", "")),
    ),
    Group(
        "frame_residue",
        "total_prove",
        "the sum of a frame of 65535 rows is exact though its lower part wraps",
        faults(
            "total_bmc",
            BEATS,
            ("total_right", "if (low_top && !low[47]) high_count", "if (low_top) high_count"),
        ),
    ),
    Group(
        "item_residue",
        "item_bmc",
        "an item is congruent to the term made of it, modulo 2^16 + 1",
        faults(
            "item_bmc",
            ITEMS,
            ("folded_right", "folded <= first - second;", "folded <= first + second;"),
            (
                "term_right",
                "folded[15:0]} - {2'd0, folded[31:16]};",
                "folded[15:0]} + {2'd0, folded[31:16]};",
            ),
        ),
    ),
    Group(
        "item_residue",
        "value_bmc",
        "the same of a value",
        faults(
            "value_bmc",
            ITEMS,
            ("folded_right", "{{66 - VALUE_BITS{v[VALUE_BITS-1]}}, v[", "{{66 - VALUE_BITS{1'b0}}, v["),
        ),
    ),
    Group(
        "item_residue",
        "narrow_bmc",
        "the same of gram_ring's value",
        faults(
            "narrow_bmc",
            ITEMS,
            ("folded_right", "{{50 - VALUE_BITS{v[VALUE_BITS-1]}}, v}", "{{50 - VALUE_BITS{1'b0}}, v}"),
        ),
    ),
    Group(
        "item_residue",
        "beats_bmc",
        "the same of the residue of the beats",
        faults("beats_bmc", ITEMS, ("folded_right", "{48'd0, residue[49:48] &", "{48'd0, residue[48:47] &")),
    ),
    Group(
        "item_residue",
        "back_bmc",
        "the same of the sum fed back",
        faults("back_bmc", ITEMS, ("folded_right", "{{10{back[39]}}, back}", "{10'd0, back}")),
    ),
    Group(
        "item_residue",
        "judge_bmc",
        "mismatch for every sum that is no multiple of 2^16 + 1, never for one that is, in time",
        JUDGE_FAULTS,
    ),
    Group(
        "recombine",
        "weighted_bmc",
        "exact for all limb sums of 65535 points, `both` wrapping",
        RECOMBINE_FAULTS,
    ),
    Group(
        "recombine",
        "lean_bmc",
        "the same without weights",
        faults(
            "lean_bmc",
            RECOMBINE,
            ("moment_exact", "high_2 + (middle >>> 16);", "high_2 + (middle >> 16);"),
        ),
    ),
)
