# QEMU's Xtensa simulator with the core of the ESP8266: LX106. Runs in QEMU.
BOARD_CORE := Xtensa LX106
BOARD_RUNS := qemu
BOARD_CROSS := xtensa-lx106-elf-
BOARD_CPU := -mlongcalls -mtext-section-literals
BOARD_COMMON := xtensa xtensa_arithmetic simcall
BOARD_PORT := portable
BOARD_EMULATOR := qemu-system-xtensa -M sim -cpu lx106
