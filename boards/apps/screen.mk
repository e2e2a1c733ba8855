# For apps that show the sundial on a display. SCREEN_SIZE, SCREEN_FORMAT, SCREEN_ZOOM (16ths) and SCREEN_SETTINGS come from the board.
ifeq ($(SCREEN_SIZE),)
$(error $(BOARD) has no display (SCREEN_SIZE in board.mk))
endif
SCREEN_ZOOM ?= 16
SCENE ?= host/scenes/sundial.gltf
override SCENE_FLAGS := --size $(SCREEN_SIZE) $(SCREEN_SETTINGS) --simplify safe $(if $(TURN),--open) $(SCENE_FLAGS)
APP_FLAGS := -DSCREEN_WIDTH=$(word 1,$(subst x, ,$(SCREEN_SIZE))) -DSCREEN_HEIGHT=$(word 2,$(subst x, ,$(SCREEN_SIZE))) \
  -DGN_FORMAT_SCREEN=GN_FORMAT_$(SCREEN_FORMAT) -DSCREEN_ZOOM=$(SCREEN_ZOOM)

# Compiled once for all that show it alike: whether it fits a board, its linker says.
FW_SCENE_BOARD :=
screen_empty :=
screen_space := $(screen_empty) $(screen_empty)
FW_SCENE_DIR := $(BUILD)/firmware/scenes/$(basename $(notdir $(SCENE)))-$(subst =,-,$(subst $(screen_space),-,$(subst --,,$(strip $(SCENE_FLAGS)))))
