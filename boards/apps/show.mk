# Any scene: settings that leave room for it, and a word before the linker's on whether it fits. A texture of 256 texels has about one for
# each pixel of such displays; one of 1024 takes 4 MB.
SCREEN_SETTINGS := --set incremental=2 $(or $(SHOW_SETTINGS),$(SCREEN_SETTINGS) --set texture_size=256)
include boards/apps/screen.mk
undefine FW_SCENE_BOARD
undefine FW_SCENE_DIR
APP_SRC := $(wildcard boards/displays/*.c boards/$(BOARD)/screen/*.c)
BOARD_EMULATOR += $(SCREEN_DEVICE)
# TURN=N: N pictures for one turn of the model about its vertical axis
ifneq ($(TURN),)
ifneq ($(shell echo '$(TURN)' | grep -c -x '[1-9][0-9]*'),1)
$(error TURN='$(TURN)' is no number of pictures)
endif
endif
APP_FLAGS += $(if $(TURN),-DSHOW_TURN=$(TURN))
