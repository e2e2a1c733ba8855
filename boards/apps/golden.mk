# Own scenes in one image, whole: what one preset does not need, another may. The last six have what people put into scenes.
GOLDEN_SCENES := sundial avenue desk room fence mixed isometric glow near cube snake glass
GOLDEN_FLAGS_glow := --set texture_format=grey4
GOLDEN_FLAGS_near := --set texture_levels=1 --set texture_format=rgb565
GOLDEN_FLAGS_cube := --set texture_size=20 --set texture_levels=1 --set texture_format=palette4
GOLDEN_DIR := $(BUILD)/firmware/scenes
APP_FLAGS := '-DGN_USER_CONFIG="golden_config.h"'
APP_OBJ := $(GOLDEN_SCENES:%=$(FW_OBJ_DIR)/golden_%.o)

$(APP_OBJ): $(FW_OBJ_DIR)/golden_%.o: boards/apps/golden_scene.c $(GOLDEN_DIR)/%/scene.c $(FW_OBJ_DIR)/compile.flags
	@mkdir -p $(@D)
	@echo '  CC $* ($(BOARD))'
	@$(FW_CC) $(FW_CFLAGS) -DGOLDEN_SCENE=$* -I$(GOLDEN_DIR)/$* -MMD -MP -c -o $@ $<

GOLDEN_DOCS := $(filter $(GOLDEN_SCENES),$(notdir $(basename $(wildcard docs/scenes/*.gltf))))
$(GOLDEN_DOCS:%=$(GOLDEN_DIR)/%/scene.c): $(GOLDEN_DIR)/%/scene.c: docs/scenes/%.gltf boards/apps/golden.mk $(BUILD)/gnomon
	@mkdir -p $(@D)
	@$(BUILD)/gnomon compile $< -o $(@D) --size 160x120 --simplify none $(GOLDEN_FLAGS_$*) >/dev/null

$(patsubst %,$(GOLDEN_DIR)/%/scene.c,$(filter-out $(GOLDEN_DOCS),$(GOLDEN_SCENES))): $(GOLDEN_DIR)/%/scene.c: host/scenes/%.gltf boards/apps/golden.mk $(BUILD)/gnomon
	@mkdir -p $(@D)
	@$(BUILD)/gnomon compile $< -o $(@D) --size 160x120 --simplify none $(GOLDEN_FLAGS_$*) >/dev/null
