/* SPDX-License-Identifier: Apache-2.0
 * In place of board.c and startup.s: the same test as an ordinary program, with RELNAV_CALLBACKS. */
#include <stdio.h>

#include "board.h"

void say(const char *text)
{
    (void)fputs(text, stdout);
}

void board_start(void)
{
}

void board_interrupt(void)
{
    on_interrupt();
}

uint32_t board_take(void)
{
    return 0;
}

void board_done(uint32_t interrupt)
{
    (void)interrupt;
}
