/* SPDX-License-Identifier: Apache-2.0
 * The driver on a bare Cortex-A9: both cores as mocks, memory-mapped or, with RELNAV_CALLBACKS, behind functions. vectors.h is made
 * by test_bare_metal.py from the bit-exact models. */
#include "board.h"
#include "ivisnav.h"
#include "oltae.h"
#include "vectors.h"

enum { POLLS = 20, SPARE = 1 };

static int failed;
static volatile uint32_t events; /* of the interrupt handler */
static const relnav_core *interrupting;

static void say_number(unsigned number)
{
    char digits[12];
    char *at = digits + sizeof digits;

    *--at = '\0';
    do {
        *--at = (char)('0' + number % 10);
        number /= 10;
    } while (number > 0);
    say(at);
}

static void check(int good, unsigned line, const char *text)
{
    if (!good) {
        say("line ");
        say_number(line);
        say(": ");
        say(text);
        say("\n");
        failed = 1;
    }
}

#define CHECK(condition) check((condition), __LINE__, #condition)

void on_interrupt(void)
{
    uint32_t interrupt = board_take();

    events |= relnav_take_interrupt(interrupting);
    board_done(interrupt);
}

#ifdef RELNAV_CALLBACKS
static uint32_t read_nothing(void *context, uint32_t offset)
{
    (void)context;
    (void)offset;
    return 0;
}
#endif

static relnav_port port_at(uint32_t base)
{
    relnav_port made = relnav_at(base);

#ifdef RELNAV_CALLBACKS
    made.read = base == MOCK_BASE ? mock_read : read_nothing;
    made.write = mock_write;
#endif
    return made;
}

static int same(const void *left, const void *right, size_t bytes)
{
    const unsigned char *one = left;
    const unsigned char *other = right;
    size_t i;

    for (i = 0; i < bytes && one[i] == other[i]; i++) {
    }
    return i == bytes;
}

/* What both cores do alike, once the core is configured and its beats are known. */
static void check_shared(relnav_core *core, const uint64_t *beats, size_t count)
{
    uint32_t frac = core->frac;

    relnav_clear_flags(core, UINT32_MAX);
    CHECK(relnav_begin(core) == RELNAV_OK);
    CHECK(relnav_poll(core) == RELNAV_PENDING);
    CHECK(relnav_wait(core, POLLS) == RELNAV_TIMEOUT);

    /* by the interrupt */
    interrupting = core;
    (void)relnav_take_interrupt(core);
    relnav_enable_interrupts(core, RELNAV_DONE | RELNAV_ERROR);
    events = 0;
    mock_stream(beats, count);
    CHECK(events == RELNAV_DONE);
    CHECK(relnav_poll(core) == RELNAV_OK);
    CHECK(relnav_take_interrupt(core) == 0);
    relnav_acknowledge(core);
    CHECK(relnav_status(core) % 8 == OLTAE_STATE_IDLE);

    /* a frame that is too short; a core that noticed an upset and lost its configuration */
    events = 0;
    CHECK(relnav_begin(core) == RELNAV_OK);
    mock_stream(beats, count - 1);
    CHECK(events == RELNAV_ERROR);
    CHECK(relnav_wait(core, POLLS) == RELNAV_TOO_FEW);
    CHECK(relnav_frame_flags(core) == OLTAE_FLAGS_FEW_POINTS);
    CHECK(relnav_begin(core) == RELNAV_OK);
    CHECK(relnav_poll(core) == RELNAV_PENDING); /* the flag is of the frame before */
    relnav_enable_interrupts(core, 0);
    CHECK(relnav_begin(core) == RELNAV_OK);
    mock_upset();
    mock_write(NULL, offsetof(oltae_registers, FRAC), 0);
    CHECK(relnav_wait(core, POLLS) == RELNAV_UPSET);
    CHECK(relnav_begin(core) == RELNAV_UPSET);
    CHECK(relnav_recover(core) == RELNAV_OK);
    CHECK(mock_read(NULL, offsetof(oltae_registers, FRAC)) == frac);
    CHECK(relnav_flags(core) == 0 && relnav_take_interrupt(core) == 0);
    mock_upset(); /* between frames */
    CHECK(relnav_begin(core) == RELNAV_UPSET);
    CHECK(relnav_set(core, core->config, core->frac, core->variance, core->weight_scale) == RELNAV_OK);

    /* busy */
    CHECK(relnav_begin_push(core) == RELNAV_OK);
    relnav_push(core, beats[0], 0);
    CHECK(relnav_begin(core) == RELNAV_BUSY);
    mock_flag(OLTAE_FLAGS_TOO_LONG); /* the rest of the frame is still being swallowed */
    CHECK(relnav_poll(core) == RELNAV_PENDING);
    relnav_soft_reset(core);
    CHECK(relnav_begin_push(core) == RELNAV_OK);
    relnav_push(core, beats[0], 0);
    CHECK(relnav_recover(core) == RELNAV_OK);
    CHECK(relnav_begin(core) == RELNAV_OK);
}

static void check_oltae(void)
{
    static const mock_core core = {OLTAE_ID_VALUE,      OLTAE_VERSION_VALUE,
                                   OLTAE_BUILD_WEIGHTED | OLTAE_BUILD_COVARIANCE,
                                   oltae_wanted,        OLTAE_BEATS,
                                   oltae_head,          sizeof oltae_head / sizeof(uint32_t),
                                   oltae_words,         sizeof oltae_words / sizeof(uint32_t)};
    static uint64_t buffer[OLTAE_BEATS + SPARE];
    static double other_a[3 * OLTAE_COUNT];
    oltae_frame frame = {OLTAE_COUNT, relnav_doubles(oltae_a), relnav_doubles(oltae_b), relnav_doubles(oltae_w)};
    oltae_scale scale;
    oltae_result result;
    oltae_raw raw;
    oltae device;
    ivisnav other;
    size_t row;

    mock_start(&core);
    CHECK(oltae_init(&device, relnav_at(0)) == RELNAV_NULL);
    CHECK(oltae_init(&device, relnav_at(MOCK_BASE + 2)) == RELNAV_MISALIGNED);
    CHECK(oltae_init(&device, port_at(EMPTY_BASE)) == RELNAV_NO_CORE);
    CHECK(ivisnav_init(&other, port_at(MOCK_BASE)) == RELNAV_NO_CORE);
    CHECK(oltae_init(&device, port_at(MOCK_BASE)) == RELNAV_OK);

    CHECK(oltae_solve(&device, &frame, OLTAE_CONFIG_COVARIANCE, OLTAE_VARIANCE, POLLS, &result) == RELNAV_OK);
    CHECK(result.flags == 0 && result.count == OLTAE_COUNT);
    CHECK(same(result.q, &oltae_words[0], sizeof result.q));
    CHECK(same(result.q_fixed, &oltae_words[3], sizeof result.q_fixed));
    CHECK(same(result.rotation, &oltae_words[6], sizeof result.rotation));
    CHECK(same(result.translation, &oltae_words[15], sizeof result.translation));
    CHECK(same(result.t_cov, &oltae_words[28], sizeof result.t_cov));
    CHECK(same(&result.rss, &oltae_rss, sizeof result.rss));
    CHECK(same(&result.determinant, &oltae_determinant, sizeof result.determinant));
    CHECK(mock_read(NULL, offsetof(oltae_registers, VARIANCE)) == OLTAE_VARIANCE_WORD);
    CHECK(mock_read(NULL, offsetof(oltae_registers, FRAC)) == (OLTAE_FRAC_WANTED & OLTAE_FRAC_FRAC));
    CHECK(oltae_solve(&device, &frame, 0, 0.0, 1, &result) == RELNAV_TIMEOUT && result.count == 0);
    CHECK(oltae_solve(&device, &frame, 0, 0.0, POLLS, &result) == RELNAV_OK);
    CHECK(oltae_solve(&device, &frame, OLTAE_CONFIG_REAPPLY, 0.0, POLLS, &result) == RELNAV_NOT_BUILT);

    frame.a = relnav_floats(oltae_a_float);
    frame.b = relnav_floats(oltae_b_float);
    frame.w = relnav_floats(oltae_w_float);
    CHECK(oltae_choose(&frame, RELNAV_FRAC_AUTO, &scale, &row) == RELNAV_OK);
    CHECK(oltae_fill(&frame, &scale, buffer, oltae_beats(&frame) - 1) == RELNAV_NO_SPACE);
    CHECK(oltae_beats(&frame) == OLTAE_BEATS && oltae_fill(&frame, &scale, buffer, OLTAE_BEATS) == RELNAV_OK);
    CHECK(same(buffer, oltae_wanted, sizeof oltae_wanted) && buffer[OLTAE_BEATS] == 0);
    CHECK(oltae_configure(&device, 0, 0.0, &scale) == RELNAV_OK);
    check_shared(&device.core, oltae_wanted, OLTAE_BEATS);
    CHECK(oltae_push_frame(&device, &frame, &scale) == RELNAV_OK);
    CHECK(oltae_configure(&device, 0, 0.0, &scale) == RELNAV_BUSY);
    CHECK(relnav_poll(&device.core) == RELNAV_PENDING);
    CHECK(relnav_status(&device.core) % 8 == OLTAE_STATE_VERIFY); /* the results stand, but are not verified */
    CHECK(oltae_read(&device, &result) == RELNAV_PENDING && result.count == 0);
    CHECK(relnav_wait(&device.core, POLLS) == RELNAV_OK);
    CHECK(oltae_read_raw(&device, &raw) == RELNAV_OK && same(raw.words, oltae_words, sizeof oltae_words));
    mock_flag(OLTAE_FLAGS_ILL_CONDITIONED); /* which leaves the result */
    CHECK(oltae_read(&device, &result) == RELNAV_OK && result.t_cov[0] <= 0.0F);
    mock_flag(OLTAE_FLAGS_WATCHDOG);
    CHECK(oltae_read(&device, &result) == RELNAV_WATCHDOG && result.count == 0);
    CHECK(relnav_recover(&device.core) == RELNAV_OK);

    for (row = 0; row < 3 * OLTAE_COUNT; row++) { /* its last value does not fit the scale */
        other_a[row] = row + 1 < 3 * OLTAE_COUNT ? oltae_a[row] : 1e3;
    }
    frame.a = relnav_doubles(other_a);
    CHECK(oltae_push_frame(&device, &frame, &scale) == RELNAV_TOO_LARGE);
    CHECK(relnav_begin(&device.core) == RELNAV_OK);

    frame.a = relnav_floats(oltae_a_float);
    frame.w = relnav_none(); /* other beats than the mock knows */
    CHECK(oltae_solve(&device, &frame, 0, 0.0, POLLS, &result) == RELNAV_TOO_FEW);
    CHECK(result.flags == OLTAE_FLAGS_FEW_POINTS);
}

static void check_ivisnav(void)
{
    static const mock_core core = {IVISNAV_ID_VALUE, IVISNAV_VERSION_VALUE,
                                   0,
                                   ivisnav_wanted,   IVISNAV_BEATS,
                                   ivisnav_head,     sizeof ivisnav_head / sizeof(uint32_t),
                                   ivisnav_words,    sizeof ivisnav_words / sizeof(uint32_t)};
    static mock_core wrong;
    static double h[6 * IVISNAV_COUNT];
    static double y[IVISNAV_COUNT];
    static uint64_t buffer[IVISNAV_BEATS + SPARE];
    ivisnav_frame frame = {IVISNAV_COUNT, relnav_doubles(h), relnav_doubles(y), relnav_doubles(ivisnav_w)};
    ivisnav_scale scale;
    ivisnav_result result;
    ivisnav_raw raw;
    ivisnav device;
    oltae other;
    size_t row;

    wrong = core;
    wrong.version += UINT32_C(1) << IVISNAV_VERSION_MINOR_SHIFT;
    mock_start(&wrong);
    CHECK(ivisnav_init(&device, port_at(MOCK_BASE)) == RELNAV_WRONG_VERSION);
    mock_start(&core);
    CHECK(ivisnav_init(&device, port_at(EMPTY_BASE)) == RELNAV_NO_CORE);
    CHECK(oltae_init(&other, port_at(MOCK_BASE)) == RELNAV_NO_CORE);
    CHECK(ivisnav_init(&device, port_at(MOCK_BASE)) == RELNAV_OK);

    for (row = 0; row < IVISNAV_COUNT; row++) {
        CHECK(ivisnav_row(&ivisnav_r[3 * row], &ivisnav_p[3 * row], &h[6 * row]) == RELNAV_OK);
        y[row] = ivisnav_metres_per_second(IVISNAV_F0, IVISNAV_DT) * ivisnav_dphi[row];
    }
    CHECK(ivisnav_solve(&device, &frame, IVISNAV_VARIANCE, POLLS, &result) == RELNAV_OK);
    CHECK(result.flags == 0 && result.count == IVISNAV_COUNT);
    CHECK(same(result.v, &ivisnav_words[0], sizeof result.v));
    CHECK(same(result.omega, &ivisnav_words[3], sizeof result.omega));
    CHECK(same(result.covariance, &ivisnav_words[7], sizeof result.covariance));
    CHECK(same(&result.rss, &ivisnav_rss, sizeof result.rss));
    CHECK(same(&result.condition, &ivisnav_condition, sizeof result.condition));
    CHECK(mock_read(NULL, offsetof(ivisnav_registers, VARIANCE)) == IVISNAV_VARIANCE_WORD);

    CHECK(ivisnav_solve(&device, &frame, 0.0, 1, &result) == RELNAV_TIMEOUT && result.count == 0);
    CHECK(ivisnav_solve(&device, &frame, 0.0, POLLS, &result) == RELNAV_OK);
    CHECK(ivisnav_choose(&frame, RELNAV_FRAC_AUTO, RELNAV_FRAC_AUTO, &scale, &row) == RELNAV_OK);
    CHECK(ivisnav_beats(&frame) == IVISNAV_BEATS && ivisnav_fill(&frame, &scale, buffer, IVISNAV_BEATS) == RELNAV_OK);
    CHECK(same(buffer, ivisnav_wanted, sizeof ivisnav_wanted) && buffer[IVISNAV_BEATS] == 0);
    CHECK(ivisnav_configure(&device, 0.0, &scale) == RELNAV_OK);
    check_shared(&device.core, ivisnav_wanted, IVISNAV_BEATS);
    CHECK(ivisnav_push_frame(&device, &frame, &scale) == RELNAV_OK);
    CHECK(relnav_wait(&device.core, POLLS) == RELNAV_OK);
    CHECK(ivisnav_read_raw(&device, &raw) == RELNAV_OK && same(raw.words, ivisnav_words, sizeof ivisnav_words));
    mock_flag(IVISNAV_FLAGS_ILL_CONDITIONED); /* which leaves none */
    CHECK(ivisnav_read(&device, &result) == RELNAV_ILL_CONDITIONED && result.count == 0);
    y[IVISNAV_COUNT - 1] = 1e6;
    CHECK(ivisnav_push_frame(&device, &frame, &scale) == RELNAV_TOO_LARGE);
    CHECK(relnav_begin(&device.core) == RELNAV_OK);
}

int main(void)
{
    board_start();
    check_oltae();
    check_ivisnav();
    say(failed ? relnav_error_text(RELNAV_WRONG_FRAME) : "all well");
    say("\n");
    return failed;
}
