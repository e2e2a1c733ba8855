# Raspberry Pi Pico (RP2040): Cortex-M0+. Runs in rp2040js.
BOARD_CORE := Cortex-M0+
BOARD_RUNS := rp2040js
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m0plus -mthumb
BOARD_COMMON := cortex_m no_console
BOARD_PORT := armv6m
BOARD_EMULATOR :=
# Where flash begins, and what the chip is called
BOARD_UF2 := 0x10000000 0xE48BFF56
SCREEN_SIZE := 320x240
SCREEN_FORMAT := RGB565
SCREEN_SETTINGS := --set atlas_size=256
