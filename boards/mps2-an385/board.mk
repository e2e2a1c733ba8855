# Arm MPS2 with the AN385 image: Cortex-M3. Runs in QEMU.
BOARD_CORE := Cortex-M3
BOARD_RUNS := qemu
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m3 -mthumb
BOARD_COMMON := cortex_m vectors semihosting
BOARD_PORT := armv7m
BOARD_EMULATOR := qemu-system-arm -M mps2-an385
