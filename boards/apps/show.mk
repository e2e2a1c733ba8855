include boards/apps/screen.mk
APP_SRC := $(wildcard boards/displays/*.c boards/$(BOARD)/screen/*.c)
BOARD_EMULATOR += $(SCREEN_DEVICE)
