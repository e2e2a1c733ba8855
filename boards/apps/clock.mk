include boards/apps/screen.mk
APP_SRC := boards/apps/day.c $(wildcard boards/displays/*.c boards/$(BOARD)/screen/*.c)
BOARD_EMULATOR += $(SCREEN_DEVICE)
