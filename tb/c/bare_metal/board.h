/* SPDX-License-Identifier: Apache-2.0
 * What the bare-metal test has instead of a board: a page of addresses at which a mock of a core answers every load and store. */
#ifndef BOARD_H
#define BOARD_H

#include <stddef.h>
#include <stdint.h>

#define MOCK_BASE 0x43C00000u  /* where a Zynq's first AXI port usually is; loads and stores there fault and are emulated */
#define EMPTY_BASE 0x43D00000u /* nothing there: QEMU reads 0 */

/* startup.s */
void say(const char *text);
void finish(int failed);
void emulate(uint32_t registers[15], const uint32_t *instruction);
void on_interrupt(void);

/* board.c */
void board_start(void);
void board_interrupt(void); /* raises the processor's interrupt */
uint32_t board_take(void);  /* in the handler: which one */
void board_done(uint32_t interrupt);

/* mock.c */
typedef struct {
    uint32_t id;
    uint32_t version;
    uint32_t build;
    const uint64_t *beats;   /* of the one frame that it knows */
    size_t count;
    const uint32_t *head;    /* words at 0x060, as many as head_count */
    size_t head_count;
    const uint32_t *results; /* words at 0x100 */
    size_t result_count;
} mock_core;

void mock_start(const mock_core *core);
uint32_t mock_read(void *context, uint32_t offset);
void mock_write(void *context, uint32_t offset, uint32_t word);
void mock_stream(const uint64_t *beats, size_t count); /* what a DMA would do */
void mock_upset(void);
void mock_flag(uint32_t flag); /* raises it, and nothing else happens */

#endif
