# BBC micro:bit (nRF51822): Cortex-M0, 16 KB of RAM. Runs in QEMU.
BOARD_CORE := Cortex-M0
BOARD_RUNS := qemu
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m0 -mthumb
BOARD_COMMON := cortex_m vectors semihosting
BOARD_PORT := armv6m
BOARD_EMULATOR := qemu-system-arm -M microbit
