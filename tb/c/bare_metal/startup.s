@ SPDX-License-Identifier: Apache-2.0
@ Cortex-A9 from reset to main: vectors, stacks, floating point. main runs in System mode with interrupts on; its value ends the program.
        .syntax unified
        .arm
        .fpu vfpv3-d16

        .section .vectors, "ax"
        .balign 32
vectors:
        ldr     pc, =start
        b       dead            @ undefined instruction
        b       dead            @ supervisor call
        b       dead            @ prefetch abort
        b       data_abort
        b       dead
        b       interrupt
        b       dead            @ fast interrupt
dead:
        mov     r0, #1
        b       finish

        .text
        .global start
start:
        ldr     r0, =vectors
        mcr     p15, 0, r0, c12, c0, 0          @ VBAR
        mrc     p15, 0, r0, c1, c0, 2           @ coprocessors 10 and 11
        orr     r0, r0, #0xF00000
        mcr     p15, 0, r0, c1, c0, 2
        isb
        mov     r0, #0x40000000
        vmsr    fpexc, r0
        cpsid   if, #0x12                       @ interrupt mode
        ldr     sp, =interrupt_stack
        cps     #0x17                           @ abort mode
        ldr     sp, =abort_stack
        cps     #0x1F                           @ System mode
        ldr     sp, =main_stack
        ldr     r0, =bss_begin
        ldr     r1, =bss_end
        mov     r2, #0
1:      cmp     r0, r1
        strlo   r2, [r0], #4
        blo     1b
        cpsie   i
        bl      main

@ ends QEMU; r0: 0 well, else not
        .global finish
finish:
        cmp     r0, #0
        ldr     r1, =0x20026                    @ the application's own end
        movne   r1, #0x20000
        mov     r0, #0x18                       @ semihosting's SYS_EXIT
        svc     #0x123456
        b       .

@ void say(const char *): semihosting's SYS_WRITE0
        .global say
say:
        mov     r1, r0
        mov     r0, #0x04
        svc     #0x123456
        bx      lr

@ What a compiler may call whatever the program does. Not in C: it would make a call of the loop.
        .global memcpy
memcpy: mov     r3, r0
1:      subs    r2, r2, #1
        bxlo    lr
        ldrb    r12, [r1], #1
        strb    r12, [r3], #1
        b       1b

        .global memset
memset: mov     r3, r0
1:      subs    r2, r2, #1
        bxlo    lr
        strb    r1, [r3], #1
        b       1b

@ A load or store that the mapping forbids: void emulate(uint32_t registers[15], const uint32_t *instruction), then the next instruction.
data_abort:
        sub     sp, sp, #64
        stmia   sp, {r0-r14}^                   @ those of System mode
        str     lr, [sp, #60]
        mov     r0, sp
        sub     r1, lr, #8
        vpush   {d0-d7}
        bl      emulate
        vpop    {d0-d7}
        ldr     lr, [sp, #60]
        ldmia   sp, {r0-r14}^
        add     sp, sp, #64
        subs    pc, lr, #4

@ void on_interrupt(void), in System mode
interrupt:
        sub     lr, lr, #4
        srsdb   sp!, #0x1F
        cps     #0x1F
        push    {r0-r3, r12, lr}
        vpush   {d0-d7}
        and     r1, sp, #4
        sub     sp, sp, r1
        push    {r1, r2}
        bl      on_interrupt
        pop     {r1, r2}
        add     sp, sp, r1
        vpop    {d0-d7}
        pop     {r0-r3, r12, lr}
        rfeia   sp!
