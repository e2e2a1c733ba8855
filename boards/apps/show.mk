include boards/apps/screen.mk
APP_SRC := $(wildcard boards/displays/*.c boards/$(BOARD)/screen/*.c)
BOARD_EMULATOR += $(SCREEN_DEVICE)
# TURN=N: N pictures for one turn of the model about the file's vertical axis
APP_FLAGS += $(if $(TURN),-DSHOW_TURN=$(TURN))
