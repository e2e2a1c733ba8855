# Arm MPS2 with the AN500 image: Cortex-M7 without its caches and FPU in use. Runs in QEMU.
BOARD_CORE := Cortex-M7
BOARD_RUNS := qemu
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m7 -mthumb -mfloat-abi=soft
BOARD_COMMON := cortex_m vectors semihosting
BOARD_PORT := armv7em armv7m
BOARD_EMULATOR := qemu-system-arm -M mps2-an500
