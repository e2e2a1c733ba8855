# Firmware of one board: make firmware BOARD=mps2-an385 APP=crc. Included when BOARD is set.
#
# BOARD       a folder of boards/ with board.mk, link.ld and, where common/vectors.c does not do, startup.c
# APP         boards/apps/APP.c; APP.mk beside it may set APP_SRC, APP_FLAGS, APP_LINK, APP_OBJ, APP_LIB, and have rules
# SCENE       a scene file that the app renders, compiled to C arrays by build/gnomon
# PRESET      tiny, fast, balanced, accurate
# BOARD_PORT  folders of port/, the first with the header, in place of those that the board names
# SCENE_FLAGS more options of gnomon compile, such as --size 128x64
# FW_OPT      the optimisation, else the board's
# FW_FLAGS    more flags, such as -DGN_TILE_HEIGHT=4
# LINK_FLAGS  more flags of the linker, such as -Wl,--defsym=RAM_BYTES=32K,--defsym=STACK=1K
# IMAGE       the name of the image, else made of APP, SCENE, PRESET and SCREEN_OF
# ARGS        what the app reads with board_args
# COUNT       1: the emulator counts the instructions of the run

APP ?= $(if $(filter screen,$(MAKECMDGOALS)),clock,$(if $(SCENE),play,crc))
ifeq ($(wildcard boards/$(BOARD)/board.mk),)
$(error There is no board '$(BOARD)': make boards lists those that there are)
endif
ifeq ($(wildcard boards/apps/$(APP).c),)
$(error There is no app '$(APP)': boards/apps has $(basename $(notdir $(shell grep -l '^int app_main' boards/apps/*.c))))
endif
ifneq ($(PRESET),)
ifeq ($(filter tiny fast balanced accurate,$(PRESET)),)
$(error PRESET='$(PRESET)' is none of tiny, fast, balanced, accurate)
endif
endif
ifneq ($(SCENE),)
ifneq ($(words $(SCENE)),1)
$(error SCENE='$(SCENE)': make knows no file names with blanks in them)
endif
ifeq ($(wildcard $(SCENE)),)
$(error SCENE=$(SCENE): there is no such file)
endif
endif
include boards/$(BOARD)/board.mk
ifneq ($(BOARD_RUNS),host)
$(foreach setting,BOARD_RUNS BOARD_CROSS BOARD_CPU BOARD_COMMON,$(if $(strip $($(setting))),,$(error boards/$(BOARD)/board.mk sets no $(setting))))
ifeq ($(filter qemu rp2040js no,$(BOARD_RUNS)),)
$(error boards/$(BOARD)/board.mk: BOARD_RUNS is '$(BOARD_RUNS)', none of qemu, rp2040js, no)
endif
ifeq ($(BOARD_RUNS)$(strip $(BOARD_EMULATOR)),qemu)
$(error boards/$(BOARD)/board.mk: BOARD_RUNS is qemu, but it sets no BOARD_EMULATOR)
endif
endif

BOARD_OPT ?= -O2
FW_OPT ?= $(BOARD_OPT)
FW_DEBUG ?= -g
IMAGE ?= $(APP)$(if $(SCENE),-$(basename $(notdir $(SCENE))))$(if $(PRESET),-$(PRESET))$(if $(SCREEN_OF),-$(SCREEN_OF))
FW := $(BUILD)/firmware/$(BOARD)
FIRMWARE := $(FW)/$(IMAGE).elf
FW_OBJ_DIR := $(FW)/$(IMAGE).obj

APP_LIB := lib/gnomon.c
-include boards/apps/$(APP).mk
ifeq ($(SCENE),) # an app that does without asks for BOARD_SCENE first
ifneq ($(shell awk '/BOARD_SCENE/ { exit } /^.include "scene.h"/ { print; exit }' boards/apps/$(APP).c),)
$(error APP=$(APP) needs SCENE=FILE)
endif
endif

# The host links a program; boards link without a C library.
FW_HOSTED := $(filter host,$(BOARD_RUNS))
FW_CC := $(if $(BOARD_CC),$(BOARD_CC),$(BOARD_CROSS)gcc)
FW_SRC := $(APP_LIB) boards/apps/$(APP).c $(APP_SRC) $(wildcard boards/$(BOARD)/*.c) boards/common/print.c $(BOARD_COMMON:%=boards/common/%.c)
ifeq ($(FW_HOSTED),)
FW_SRC += boards/common/start.c boards/common/memory.c
FW_FREE := -ffreestanding -isystem boards/common/include
FW_LINK := -nostdlib -nostartfiles -Wl,--gc-sections,--fatal-warnings,-Map=$(FIRMWARE:.elf=.map) -Wl,--no-warn-rwx-segments -Lboards/common -T boards/$(BOARD)/link.ld
FW_LIBS := -lgcc
FW_HOT := '-DGN_PORT_HOT_SECTION=".gn_hot"' # common/sections.ld places it
endif
ifneq ($(PRESET),)
FW_PRESET := -DGN_PRESET=GN_PRESET_$(shell echo $(PRESET) | tr a-z A-Z)
endif
ifneq ($(SCENE),)
FW_SCENE_DIR ?= $(FW_OBJ_DIR)/scene
FW_SCENE_BOARD ?= $(if $(wildcard boards/$(BOARD)/link.ld),--board $(BOARD) $(addprefix --optimise ,$(lastword $(filter -O%,$(FW_OPT) $(FW_FLAGS))))) # whether it fits
FW_SCENE := -I$(FW_SCENE_DIR) '-DGN_USER_CONFIG="gn_scene_config.h"' -DBOARD_SCENE=1
FW_SCENE_OBJ := $(FW_OBJ_DIR)/scene.o
endif
ifneq ($(BOARD_PORT),)
FW_PORT := -Iport/$(firstword $(BOARD_PORT)) '-DGN_PORT="gn_port_$(notdir $(firstword $(BOARD_PORT))).h"'
FW_SRC += $(filter-out port/portable/gn_port_oracle.c,$(foreach port,$(BOARD_PORT),$(wildcard port/$(port)/*.c)))
endif
FW_CFLAGS := $(BOARD_CPU) -std=c99 $(FW_OPT) $(FW_DEBUG) $(WARN) $(FW_FREE) -ffunction-sections -fdata-sections -Ilib -Iport -Iboards/common -Iboards/apps \
  $(FW_SCENE) $(FW_PRESET) $(FW_PORT) $(FW_HOT) $(BOARD_FLAGS) $(APP_FLAGS) $(FW_FLAGS)
FW_OBJ := $(FW_SRC:%.c=$(FW_OBJ_DIR)/%.o) $(FW_SCENE_OBJ) $(APP_OBJ)

$(FIRMWARE): $(FW_OBJ) $(wildcard boards/$(BOARD)/*.ld boards/common/*.ld) $(FW_OBJ_DIR)/link.flags
	@echo '  LD $@'
	@$(FW_CC) $(BOARD_CPU) $(FW_OPT) $(FW_LINK) $(APP_LINK) $(LINK_FLAGS) -o $@ $(FW_OBJ) $(FW_LIBS)

$(FW_OBJ_DIR)/%.o: %.c $(FW_OBJ_DIR)/compile.flags
	@mkdir -p $(@D)
	@echo '  CC $< ($(BOARD))'
	@$(FW_CC) $(FW_CFLAGS) -MMD -MP -c -o $@ $<

# The compiler would turn the loops of memset and memcpy into calls of themselves.
$(FW_OBJ_DIR)/boards/common/memory.o $(FW_OBJ_DIR)/boards/common/start.o: FW_CFLAGS += -fno-tree-loop-distribute-patterns -fno-builtin

ifneq ($(SCENE),)
# scene.d, which is written beside it, names what else the scene was read from.
$(FW_OBJ): $(FW_SCENE_DIR)/scene.c
# Whether it fits is asked of the board's linker script and board.mk.
$(FW_SCENE_DIR)/scene.c: $(SCENE) $(BUILD)/gnomon $(FW_SCENE_DIR)/scene.flags $(if $(strip $(FW_SCENE_BOARD)),$(wildcard boards/$(BOARD)/link.ld boards/$(BOARD)/board.mk))
	@mkdir -p $(@D)
	@$(BUILD)/gnomon compile $(SCENE) -o $(@D) $(FW_SCENE_BOARD) $(if $(PRESET),--set preset=$(PRESET)) $(SCENE_FLAGS) || \
	  { echo 'options for gnomon compile: make ... SCENE_FLAGS="--set KEY=VALUE"' >&2; exit 1; }
$(FW_SCENE_OBJ): $(FW_SCENE_DIR)/scene.c $(FW_OBJ_DIR)/compile.flags
	@$(FW_CC) $(FW_CFLAGS) -MMD -MP -c -o $@ $<
endif

# Rebuilds what other flags made.
$(FW_OBJ_DIR)/compile.flags: FW_NOW = $(FW_CC) $(FW_CFLAGS)
$(FW_OBJ_DIR)/link.flags: FW_NOW = $(APP_LINK) $(LINK_FLAGS)
$(FW_SCENE_DIR)/scene.flags: FW_NOW = $(SCENE) $(PRESET) $(SCENE_FLAGS) $(FW_SCENE_BOARD)
%.flags: always
	@mkdir -p $(@D)
	@echo '$(subst ','"'"',$(FW_NOW))' | cmp -s - $@ || echo '$(subst ','"'"',$(FW_NOW))' >$@
always:

-include $(shell test -d $(FW_OBJ_DIR) && find $(FW_OBJ_DIR) -name '*.d')

# What a programmer writes to flash, of boards that QEMU does not run; UF2 where the board takes it by copying.
FW_FLAT := $(if $(filter no rp2040js,$(BOARD_RUNS)),$(FIRMWARE:.elf=.bin) $(if $(BOARD_UF2),$(FIRMWARE:.elf=.uf2)))
$(FIRMWARE:.elf=.bin): $(FIRMWARE)
	@$(BOARD_CROSS)objcopy -O binary $< $@
$(FIRMWARE:.elf=.uf2): $(FIRMWARE:.elf=.bin) $(BUILD)/uf2
	@$(BUILD)/uf2 $(BOARD_UF2) <$< >$@
$(BUILD)/uf2: boards/tools/uf2.c
	@mkdir -p $(@D)
	@$(CC) -std=c11 -O2 $(WARN) -o $@ $<

firmware: $(FIRMWARE) $(FW_FLAT)
emulate: run-firmware
screen: run-screen

comma := ,
empty :=
FW_ARGS = $(APP)$(subst $(empty) $(comma)arg=,$(comma)arg=,$(patsubst %,$(comma)arg=%,$(subst $(comma),$(comma)$(comma),$(ARGS))))
EMULATE = $(BOARD_EMULATOR) -semihosting-config enable=on,target=native,arg=$(FW_ARGS) -kernel $(FIRMWARE)
EMULATOR_FLAGS := -display none -monitor none -serial none $(if $(COUNT),-plugin $(abspath $(BUILD)/libstages.so))
# rp2040js is a package of node: it boots the UF2 of a Pico, and ends after ARGS frames. Tested with this version.
RP2040JS := $(BUILD)/node_modules/rp2040js
RP2040JS_VERSION := 1.4.1
RUN_PICO = NODE_PATH=$(BUILD)/node_modules timeout $(or $(TIMEOUT),300) \
  node boards/tools/pico.js $(FIRMWARE:.elf=.uf2) $(FIRMWARE:.elf=.symbols) $(or $(ARGS),2)
PICO_NEEDS := $(if $(filter rp2040js,$(BOARD_RUNS)),$(FIRMWARE:.elf=.uf2) $(FIRMWARE:.elf=.symbols) $(RP2040JS)/package.json)
$(FIRMWARE:.elf=.symbols): $(FIRMWARE)
	@$(BOARD_CROSS)nm $< >$@
$(RP2040JS)/package.json:
	@command -v node >/dev/null && command -v npm >/dev/null || \
	  { echo "rp2040js, which runs the $(BOARD), needs node and npm (in Debian: nodejs npm)" >&2; exit 1; }
	@npm install --silent --no-save --no-audit --no-fund --prefix $(BUILD) rp2040js@$(RP2040JS_VERSION) >/dev/null || \
	  { echo "npm could not install rp2040js $(RP2040JS_VERSION) in $(BUILD)/node_modules" >&2; exit 1; }

run-firmware: $(FIRMWARE) $(PICO_NEEDS) $(if $(COUNT),$(BUILD)/libstages.so)
ifneq ($(FW_HOSTED),)
	@$(BOARD_EMULATOR) $(FIRMWARE) $(ARGS)
else ifeq ($(BOARD_RUNS),rp2040js)
	@$(RUN_PICO)
else ifeq ($(BOARD_RUNS),qemu)
	@timeout $(or $(TIMEOUT),120) $(EMULATE) $(EMULATOR_FLAGS)
else
	@echo "$(BOARD) is built, not run: its board.mk has BOARD_RUNS := $(BOARD_RUNS)" >&2; exit 1
endif

# The display, when the clock has come to the last time of ARGS; that of show, and the Pico's, after ARGS frames.
SCREEN_OUT ?= $(FIRMWARE:.elf=.ppm)
ifneq ($(BOARD_RUNS),rp2040js)
run-screen: ARGS ?= $(if $(filter clock,$(APP)),09:40 10:00,2)
endif
run-screen: $(FIRMWARE) $(PICO_NEEDS) $(BUILD)/capture $(BUILD)/ppm
ifeq ($(BOARD_RUNS),rp2040js)
	@$(RUN_PICO) $(SCREEN_OUT)
	@$(BUILD)/ppm png $(SCREEN_OUT) $(SCREEN_OUT:.ppm=.png) && echo $(SCREEN_OUT:.ppm=.png)
else ifeq ($(BOARD_RUNS),qemu)
	@$(BUILD)/capture $(or $(TIMEOUT),60) 'READY $(lastword $(ARGS))' $(SCREEN_OUT) $(EMULATE)
	@$(BUILD)/ppm png $(SCREEN_OUT) $(SCREEN_OUT:.ppm=.png) && echo $(SCREEN_OUT:.ppm=.png)
else
	@echo "$(BOARD) is built, not run: its board.mk has BOARD_RUNS := $(BOARD_RUNS)" >&2; exit 1
endif

$(BUILD)/libstages.so: boards/tools/stage_plugin.c boards/tools/tcg_plugin.h
	@mkdir -p $(@D)
	@$(CC) -std=c11 -O2 $(WARN) -shared -fPIC -o $@ $<

.PHONY: always run-firmware run-screen
