include boards/apps/screen.mk
APP_SRC := boards/apps/day.c $(wildcard boards/displays/*.c boards/$(BOARD)/screen/*.c)
BOARD_EMULATOR += $(SCREEN_DEVICE)
ifeq ($(BOARD),pico) # all of its RAM is taken; of its stack three frames use 1512 bytes
APP_LINK := -Wl,--defsym=STACK=3K
endif
