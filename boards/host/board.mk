# The machine that builds: the same apps as a program, which says what every board must print.
BOARD_CORE := host
BOARD_RUNS := host
BOARD_CC := $(CC)
BOARD_CPU :=
BOARD_COMMON :=
BOARD_EMULATOR :=
