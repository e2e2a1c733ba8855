include boards/apps/screen.mk
APP_SRC := boards/apps/day.c $(wildcard boards/displays/*.c boards/$(BOARD)/screen/*.c)
BOARD_EMULATOR += $(SCREEN_DEVICE)
ifeq ($(BOARD),pico) # all of its RAM is taken; gn_render and the flush need 1.5 KB
APP_LINK := -Wl,--defsym=STACK=3K
endif
