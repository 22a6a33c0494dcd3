// SPDX-License-Identifier: Apache-2.0
// Verilator's counting of toggles, replaced in a build with coverage (sim/runner.py: --compiler-include).
//
// * Verilator 5.48 counts a change of bit i of a signal of more than 64 bits for the bits i + 32, i + 64 .. as well.
// * It compares the first values with random ones (--x-initial unique): nothing counts before time has passed.
// * Its loops look at every bit of a signal that changed; these at the bits that changed.
#ifndef RELNAV_TOGGLE_H
#define RELNAV_TOGGLE_H

#include "verilated.h"
#include "verilated_cov.h"

static inline void relnav_toggles(uint32_t* counters, uint64_t now, uint64_t before) {
    for (uint64_t changed = now ^ before; changed; changed &= changed - 1) {
        const int bit = __builtin_ctzll(changed);
        ++counters[2 * bit + (now >> bit & 1)];
    }
}

static inline void relnav_toggle(int, uint32_t* counters, uint64_t now, uint64_t before) {
    if (Verilated::threadContextp()->time()) relnav_toggles(counters, now, before);
}

static inline void relnav_toggle_wide(int width, uint32_t* counters, WDataInP now, WDataInP before) {
    if (!Verilated::threadContextp()->time()) return;
    for (int word = 0; word < VL_WORDS_I(width); ++word) {
        relnav_toggles(counters + 2 * VL_EDATASIZE * word, now[word], before[word]);
    }
}

#define VL_COV_TOGGLE_CHG_ST_I relnav_toggle
#define VL_COV_TOGGLE_CHG_ST_Q relnav_toggle
#define VL_COV_TOGGLE_CHG_ST_W relnav_toggle_wide

#endif
