# The kernels of the board's port, and the oracle.
APP_LIB :=
APP_SRC := port/portable/gn_port_oracle.c
APP_FLAGS := -Iport/portable
