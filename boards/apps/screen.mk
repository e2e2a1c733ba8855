# For apps that show the sundial on a board's display. SCREEN_SIZE and SCREEN_FORMAT come from the board, or from the command line.
SCENE ?= host/scenes/sundial.gltf
SCENE_FLAGS ?= --size $(SCREEN_SIZE) $(SCREEN_SET)
APP_FLAGS := -DSCREEN_WIDTH=$(word 1,$(subst x, ,$(SCREEN_SIZE))) -DSCREEN_HEIGHT=$(word 2,$(subst x, ,$(SCREEN_SIZE))) \
  -DGN_FORMAT_SCREEN=GN_FORMAT_$(SCREEN_FORMAT)
