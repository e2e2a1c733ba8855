# QEMU's virt machine: RV32IMAC. Runs in QEMU.
BOARD_CORE := RV32IMAC
BOARD_RUNS := qemu
BOARD_CROSS := riscv64-unknown-elf-
BOARD_CPU := -march=rv32imac -mabi=ilp32
BOARD_COMMON := rv32 semihosting
BOARD_PORT := portable
BOARD_EMULATOR := qemu-system-riscv32 -M virt -bios none
SCREEN_SIZE := 320x240
SCREEN_FORMAT := RGB565
SCREEN_DEVICE := -nic none -device VGA,romfile=
SCREEN_SETTINGS := --set atlas_size=256
