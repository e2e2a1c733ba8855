# Black Pill (STM32F411CE): Cortex-M4. Built, not run: no emulator here has it.
BOARD_CORE := Cortex-M4
BOARD_RUNS := no
BOARD_CROSS := arm-none-eabi-
BOARD_CPU := -mcpu=cortex-m4 -mthumb -mfloat-abi=soft
BOARD_COMMON := cortex_m no_console stm32f4 stm32f4_spi
BOARD_PORT := armv7em armv7m
BOARD_EMULATOR :=
SCREEN_SIZE := 320x240
SCREEN_FORMAT := RGB565
SCREEN_SETTINGS := --set atlas_size=128
