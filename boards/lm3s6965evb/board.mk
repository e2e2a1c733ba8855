# Luminary LM3S6965 evaluation board: Cortex-M3, 64 KB RAM, grey OLED 128x64. Runs in QEMU.
BOARD_CORE := Cortex-M3
BOARD_RUNS := qemu
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m3 -mthumb
BOARD_COMMON := cortex_m vectors semihosting
BOARD_PORT := armv7m
BOARD_EMULATOR := qemu-system-arm -M lm3s6965evb
SCREEN_SIZE := 128x64
SCREEN_FORMAT := GREY4
SCREEN_ZOOM := 26
SCREEN_SETTINGS := --set tile_height=8 --set max_tile_refs=1000
SHOW_SETTINGS := --set preset=tiny --set tile_height=8
