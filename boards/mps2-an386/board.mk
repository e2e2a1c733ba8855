# Arm MPS2 with the AN386 image: Cortex-M4 with an FPU that nothing here uses. Runs in QEMU.
BOARD_CORE := Cortex-M4
BOARD_RUNS := qemu
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
BOARD_COMMON := cortex_m vectors semihosting
BOARD_PORT := armv7em armv7m
BOARD_EMULATOR := qemu-system-arm -M mps2-an386
