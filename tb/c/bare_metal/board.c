/* SPDX-License-Identifier: Apache-2.0 */
#include "board.h"

#define DISTRIBUTOR 0xF8F01000u
#define INTERFACE 0xF8F00100u
#define MEGABYTE_BITS 20
#define RAM_END 0x08000000u

static uint32_t sections[4096] __attribute__((aligned(16384)));

static volatile uint32_t *word_at(uint32_t address)
{
    return (volatile uint32_t *)(uintptr_t)address;
}

void board_start(void)
{
    uint32_t i;

    for (i = 0; i < 4096; i++) { /* flat: memory, or strongly ordered; the mock's section is left out */
        uint32_t address = i << MEGABYTE_BITS;

        sections[i] = address == MOCK_BASE ? 0 : address | (address < RAM_END ? 0x1C0E : 0xC02);
    }
    __asm__ volatile("mcr p15, 0, %0, c2, c0, 0\n" /* TTBR0 */
                     "mcr p15, 0, %1, c3, c0, 0\n" /* domain 0: client */
                     "mcr p15, 0, %2, c8, c7, 0\n" /* TLB */
                     "dsb\n"
                     "mrc p15, 0, r1, c1, c0, 0\n"
                     "orr r1, r1, #1\n"
                     "mcr p15, 0, r1, c1, c0, 0\n"
                     "isb\n"
                     :
                     : "r"(sections), "r"(1), "r"(0)
                     : "r1", "memory");
    *word_at(INTERFACE + 4) = 0xFF; /* every priority */
    *word_at(INTERFACE) = 1;
    *word_at(DISTRIBUTOR) = 1;
}

void board_interrupt(void)
{
    *word_at(DISTRIBUTOR + 0xF00) = 0x02000000; /* software interrupt 0, to this processor */
}

uint32_t board_take(void)
{
    return *word_at(INTERFACE + 0xC);
}

void board_done(uint32_t interrupt)
{
    *word_at(INTERFACE + 0x10) = interrupt;
}

/* LDR and STR of a word in A32, with their write-back where the offset is immediate: what a compiler makes of a volatile access. */
/* cppcheck-suppress unusedFunction ; startup.s calls it */
void emulate(uint32_t registers[15], const uint32_t *instruction)
{
    uint32_t code = *instruction;
    uint32_t address;
    uint32_t target = code >> 12 & 15;
    int post_indexed = (code >> 24 & 1) == 0;

    __asm__ volatile("mrc p15, 0, %0, c6, c0, 0" : "=r"(address)); /* the address that faulted */
    if ((code >> 26 & 3) != 1 || (code >> 22 & 1) != 0 || target == 15 ||
        address >> MEGABYTE_BITS != MOCK_BASE >> MEGABYTE_BITS) {
        say("an access that a register does not have, or a stray one\n");
        finish(1);
    }
    if (post_indexed || (code >> 21 & 1) != 0) {
        if ((code >> 25 & 1) != 0) {
            say("a write-back by a register, which is not emulated\n");
            finish(1);
        }
        registers[code >> 16 & 15] += (code >> 23 & 1) != 0 ? code & 0xFFF : -(code & 0xFFF);
    }
    if ((code >> 20 & 1) != 0) {
        registers[target] = mock_read(NULL, address - MOCK_BASE);
    } else {
        mock_write(NULL, address - MOCK_BASE, registers[target]);
    }
}
