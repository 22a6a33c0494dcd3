/* SPDX-License-Identifier: Apache-2.0
 * A core that knows one frame: it compares the beats, takes some looks at STATUS to "compute", and shows the results given, for the
 * last of these looks provisionally. Anything else is TOO_FEW. It serves both cores, whose control registers are the same. */
#include "board.h"
#include "oltae_registers.h"

enum { REGISTERS = sizeof(oltae_registers) / sizeof(uint32_t), LOOKS = 5, VERIFYING = 3 };

#define AT(name) (offsetof(oltae_registers, name) / sizeof(uint32_t))

static const mock_core *mock;
static uint32_t words[REGISTERS];
static size_t taken;  /* beats of the open frame */
static int wrong;     /* one of them differed */
static unsigned looks; /* left until DONE */

static void set_state(uint32_t state, int busy)
{
    words[AT(STATUS)] &= OLTAE_STATUS_FRAME;
    words[AT(STATUS)] |= state | (busy ? OLTAE_STATUS_BUSY : 0) | (state <= OLTAE_STATE_LOAD ? OLTAE_STATUS_PUSH_READY : 0);
    if (state == OLTAE_STATE_DONE) {
        words[AT(STATUS)] |= OLTAE_STATUS_PUSH_READY;
    }
    if (state == OLTAE_STATE_DONE || state == OLTAE_STATE_VERIFY) {
        words[AT(STATUS)] |= OLTAE_STATUS_ALL_READY;
    }
}

static void raise(uint32_t event)
{
    words[AT(IRQ_STATUS)] |= event;
    if ((words[AT(IRQ_ENABLE)] & event) != 0) {
        board_interrupt();
    }
}

static void fail(uint32_t flag)
{
    words[AT(FLAGS)] |= flag;
    words[AT(FRAME_FLAGS)] = flag;
    set_state(OLTAE_STATE_IDLE, 0);
    taken = 0;
    raise(OLTAE_IRQ_STATUS_ERROR);
}

static void take(uint64_t beat, int last)
{
    if (taken == 0) {
        wrong = 0;
        words[AT(FRAME_FLAGS)] = 0;
        set_state(OLTAE_STATE_LOAD, 1);
    }
    wrong |= taken >= mock->count || beat != mock->beats[taken];
    taken++;
    if (last && (wrong || taken != mock->count)) {
        fail(OLTAE_FLAGS_FEW_POINTS);
    } else if (last) {
        set_state(OLTAE_STATE_COMPUTE, 1);
        looks = LOOKS;
    }
}

static void show(void)
{
    size_t i;

    for (i = 0; i < mock->head_count; i++) {
        words[AT(POINTS) + i] = mock->head[i];
    }
    for (i = 0; i < mock->result_count; i++) {
        words[AT(Q) + i] = mock->results[i];
    }
    set_state(OLTAE_STATE_VERIFY, 1);
}

static void finish_frame(void)
{
    words[AT(STATUS)] += UINT32_C(1) << OLTAE_STATUS_FRAME_SHIFT;
    set_state(OLTAE_STATE_DONE, 0);
    taken = 0;
    raise(OLTAE_IRQ_STATUS_DONE);
}

void mock_start(const mock_core *core)
{
    size_t i;

    for (i = 0; i < REGISTERS; i++) {
        words[i] = 0;
    }
    mock = core;
    taken = 0;
    looks = 0;
    words[AT(ID)] = core->id;
    words[AT(VERSION)] = core->version;
    words[AT(BUILD)] = core->build;
    words[AT(STATUS)] = OLTAE_STATUS_FRAME; /* the next completed frame wraps */
    set_state(OLTAE_STATE_IDLE, 0);
}

uint32_t mock_read(void *context, uint32_t offset)
{
    (void)context;
    if (offset == offsetof(oltae_registers, STATUS) && looks > 0) {
        looks--;
        if (looks == VERIFYING) {
            show();
        } else if (looks == 0) {
            finish_frame();
        }
    }
    return offset / sizeof(uint32_t) < REGISTERS ? words[offset / sizeof(uint32_t)] : 0xDEADBEEF;
}

void mock_write(void *context, uint32_t offset, uint32_t word)
{
    (void)context;
    switch (offset) {
    case offsetof(oltae_registers, FLAGS):
    case offsetof(oltae_registers, IRQ_STATUS):
        words[offset / sizeof(uint32_t)] &= ~word;
        break;
    case offsetof(oltae_registers, CONTROL):
        if ((word & OLTAE_CONTROL_SOFT_RESET) != 0 || words[AT(STATUS)] % 8 == OLTAE_STATE_DONE) {
            set_state(OLTAE_STATE_IDLE, 0);
            taken = 0;
            looks = 0;
        }
        break;
    case offsetof(oltae_registers, PUSH):
        take((uint64_t)words[AT(DATA_B)] << 32 | words[AT(DATA_A)], (word & OLTAE_PUSH_LAST) != 0);
        break;
    default:
        words[offset / sizeof(uint32_t)] = word;
        break;
    }
}

void mock_stream(const uint64_t *beats, size_t count)
{
    size_t i;

    for (i = 0; i < count; i++) {
        take(beats[i], i + 1 == count);
    }
    while (looks > 0) { /* a DMA's user may sleep until the interrupt */
        (void)mock_read(NULL, offsetof(oltae_registers, STATUS));
    }
}

void mock_flag(uint32_t flag)
{
    words[AT(FLAGS)] |= flag;
}

void mock_upset(void)
{
    fail(OLTAE_FLAGS_UPSET);
}
