# Gnomon as a module of MicroPython, for ports built by make: USER_C_MODULES=the folder above this one.
SRC_USERMOD_C += $(USERMOD_DIR)/modgnomon.c
SRC_USERMOD_LIB_C += $(USERMOD_DIR)/src/gnomon.c
CFLAGS_USERMOD += -I$(USERMOD_DIR)/src
