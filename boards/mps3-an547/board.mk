# Arm MPS3 with the AN547 image: Cortex-M55 with Helium. Runs in QEMU.
BOARD_CORE := Cortex-M55
BOARD_RUNS := qemu
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m55 -mthumb -mfloat-abi=hard
BOARD_COMMON := cortex_m semihosting
BOARD_PORT := helium armv7m
BOARD_EMULATOR := qemu-system-arm -M mps3-an547
