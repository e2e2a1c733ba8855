# Arm MPS2 with the AN505 image: Cortex-M33, secure state. Runs in QEMU.
BOARD_CORE := Cortex-M33
BOARD_RUNS := qemu
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m33 -mthumb -mfloat-abi=soft
BOARD_COMMON := cortex_m vectors semihosting
BOARD_PORT := armv7em armv7m
BOARD_EMULATOR := qemu-system-arm -M mps2-an505
