APP_LIB := # it draws nothing
ifeq ($(BOARD_RUNS),host)
$(error APP=fault is for boards: the host has guards of its own)
endif
