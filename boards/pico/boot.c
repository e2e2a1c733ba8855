/* The second boot stage. The boot ROM copies the first 256 bytes of flash to RAM, checks the CRC in their last word,
 * and jumps to them. This one sets the flash interface to plain 24-bit reads, which every serial flash understands, and
 * starts the image. The CRC covers what stands before it: it changes with that, and the test of the boards says what it
 * must be. */
__asm__(".section .boot,\"ax\",%progbits\n"
        ".syntax unified\n"
        ".thumb\n"
        ".global pico_boot\n"
        "pico_boot:\n"
        "ldr r3, =0x18000000\n" /* SSI */
        "movs r0, #0\n"
        "str r0, [r3, #0x08]\n" /* SSIENR: off while it is set up */
        "movs r0, #4\n"
        "str r0, [r3, #0x14]\n" /* BAUDR: a quarter of the system clock */
        "ldr r0, =0x001f0300\n" /* CTRLR0: 32 bits per frame, read: send, then receive */
        "str r0, [r3, #0x00]\n"
        "ldr r0, =0x03000218\n" /* SPI_CTRLR0: command 03h, 8 bits, 24 bits of address */
        "ldr r1, =0x180000f4\n"
        "str r0, [r1]\n"
        "movs r0, #0\n"
        "str r0, [r3, #0x04]\n" /* CTRLR1: one frame at a time */
        "movs r0, #1\n"
        "str r0, [r3, #0x08]\n" /* SSIENR: on */
        "ldr r0, =0x10000100\n" /* the vector table */
        "ldr r1, =0xe000ed08\n" /* VTOR */
        "str r0, [r1]\n"
        "ldr r1, [r0]\n"
        "msr msp, r1\n"
        "ldr r1, [r0, #4]\n"
        "bx r1\n"
        ".ltorg\n"
        ".org 252\n"
        ".word 0xa0649345\n"
        ".previous");
