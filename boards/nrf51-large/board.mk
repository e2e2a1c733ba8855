# The Cortex-M0 of the micro:bit with more memory than was ever made: for what 16 KB do not hold. Runs in QEMU.
BOARD_CORE := Cortex-M0
BOARD_RUNS := qemu
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m0 -mthumb
BOARD_COMMON := cortex_m vectors semihosting
BOARD_PORT := armv6m
BOARD_EMULATOR := qemu-system-arm -M microbit -global nrf51-soc.flash-size=4194304 -global nrf51-soc.sram-size=4194304
