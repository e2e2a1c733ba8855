# Six own scenes in one image, whole: what one preset does not need, another may.
GOLDEN_SCENES := sundial avenue desk room fence mixed
GOLDEN_DIR := $(BUILD)/firmware/scenes
APP_FLAGS := '-DGN_USER_CONFIG="golden_config.h"'
APP_OBJ := $(GOLDEN_SCENES:%=$(FW_OBJ_DIR)/golden_%.o)

$(APP_OBJ): $(FW_OBJ_DIR)/golden_%.o: boards/apps/golden_scene.c $(GOLDEN_DIR)/%/scene.c $(FW_OBJ_DIR)/compile.flags
	@mkdir -p $(@D)
	@echo '  CC $* ($(BOARD))'
	@$(FW_CC) $(FW_CFLAGS) -DGOLDEN_SCENE=$* -I$(GOLDEN_DIR)/$* -MMD -MP -c -o $@ $<

$(GOLDEN_SCENES:%=$(GOLDEN_DIR)/%/scene.c): $(GOLDEN_DIR)/%/scene.c: host/scenes/%.gltf boards/apps/golden.mk $(BUILD)/gnomon
	@mkdir -p $(@D)
	@$(BUILD)/gnomon compile $< -o $(@D) --size 160x120 --simplify none >/dev/null
