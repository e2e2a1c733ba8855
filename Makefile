# Gnomon. `make help` lists what there is.
#
# The library itself needs no build system: compile lib/*.c with -Ilib. This file builds the host tool and runs the tests.

CC ?= gcc
BUILD ?= build
OPT ?= -O2
# The library and the rest can differ: the oracles need not be slow where the library is tested without optimisation.
HOST_OPT ?= $(OPT)
# Of tests but for the oracles and the reference, whose own code hardly counts: a third of the time to compile.
TEST_OPT ?= $(if $(filter -O2,$(HOST_OPT)),-Og,$(HOST_OPT))
# Of what reads scenes: where little is optimised, files by the thousand and pictures are read soon.
SCENE_OPT ?= $(HOST_OPT)
SAN ?=
SIZE ?= 320x240
SCENES ?=
OWN_SCENES := $(foreach s,cube sundial avenue desk room fence mixed,host/scenes/$(s).gltf)

# The tests make an error of every warning (WERROR=-Werror); the compiler of a user may know new ones.
WERROR ?=
WARN := -Wall -Wextra -Wconversion -Wsign-conversion -Wdouble-promotion -Wshadow -Wundef $(WERROR)
# Room for any scene.
ROOM := -DGN_SEPARATE_FILES -DGN_PICTURES=15 -DGN_VALIDATION=2 -DGN_INCREMENTAL=3 -DGN_MANY_CASCADES=3 -DGN_MAX_WIDTH=2048 -DGN_MAX_HEIGHT=2048 -DGN_MAX_TRIANGLES=65534 \
  -DGN_MAX_TILE_REFS=1000000 -DGN_MAX_LIGHTS=64 -DGN_SURFACE_LIGHTS=64 -DGN_MAX_OBJECTS=65535 -DGN_MAX_SHADOW_TILES=16 \
  -DGN_MAX_OTHER_TILES=16
# The host build of the library: every knob at run time. The pixels are the target's, bit for bit. For the tests alone: CONSTANTS.
CONSTANTS ?=
HOST_KNOBS := $(ROOM) $(or $(CONSTANTS),-DGN_COUNTERS=1 -DGN_RUNTIME_KNOBS=1 -DGN_ATLAS_SIZE=1024 -DGN_OTHER_ATLAS_SIZE=1024)
LIB_CFLAGS := -std=c99 -pedantic $(OPT) -g $(WARN) $(SAN) -Ilib
HOST_CFLAGS := -std=c11 -D_POSIX_C_SOURCE=200809L $(HOST_OPT) -g $(WARN) $(SAN) -Ilib $(HOST_KNOBS) \
  -DSLOW_LIBRARY=$(if $(filter -O0,$(OPT)),1,0)

# The library, part by part: what changes is compiled again, and tests see its functions. Users compile lib/gnomon.c.
LIB_SRC := $(filter-out lib/compact/%, $(wildcard lib/*/*.c))
# main.c has no place beside a test's main(); generators, the report page and the playground are programs of their own.
HOST_SRC := $(filter-out host/tool/main.c host/generate/% host/report/% host/web/% host/record/recording.c, $(sort $(shell find host -name '*.c')))
SCENE_SRC := $(filter-out %/make_scenes.c, $(wildcard host/generate/scenes/*.c))
TEST_SRC := $(wildcard tests/*/test_*.c)
TESTS := $(basename $(notdir $(TEST_SRC)))
# Those of unit/ and property/ need no more than the library, but for five; test_golden_random is of GCC alone.
ALONE := $(patsubst tests/%.c,$(BUILD)/%,$(subst unit/,,$(subst property/,,$(wildcard tests/unit/test_*.c tests/property/test_*.c))))
ALONE := $(filter-out %/test_culling %/test_golden %/test_golden_random %/test_groups %/test_stages,$(ALONE))
# And those that are built with constants for knobs, too. The others choose their knobs: casters
# corner and radiance sweep what may be lost over all presets, arrival has the finest, cells, cones and fade all steps, refused what a knob
# refuses, runs and tiles have sizes of their own.
CONSTANT := $(filter-out %/test_arrival %/test_casters %/test_cells %/test_cones %/test_corner %/test_fade %/test_radiance %/test_refused %/test_runs %/test_tiles,$(ALONE))

# ONE_FILE=1: as users compile it, for builds that happen once.
ONE_FILE ?=
LIB_OBJ := $(patsubst %.c,$(BUILD)/obj/%.o,$(if $(ONE_FILE),lib/gnomon.c,$(LIB_SRC)))
HOST_OBJ := $(HOST_SRC:%.c=$(BUILD)/obj/%.o)
SCENE_OBJ := $(SCENE_SRC:%.c=$(BUILD)/obj/%.o)
PANEL_OBJ := $(patsubst %.c,$(BUILD)/obj/%.o, $(wildcard boards/displays/*.c) $(wildcard tests/firmware/panel_*.c))

all: $(BUILD)/gnomon ## build the host tool, build/gnomon (default)

help: ## list the targets
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/  make \1\t\2/p' Makefile | expand -t 18
	@echo
	@echo "  make run SCENES='a.obj b.glb' SIZE=480x320    renders these too, at this size"

run: $(BUILD)/gnomon ## render and compare the main scenes (and SCENES=...); pictures under build/run/
	@sh host/run.sh $(BUILD)/gnomon $(SIZE) $(BUILD)/run $(OWN_SCENES) $(SCENES)

deps: ## install what the tests need, as root or with sudo
	@sh tests/deps.sh

test: deps ## run every test
	@sh tests/run.sh

soak: ## the longer campaigns, minutes to hours: [SEED=n] [SCENES=n] [CAMPAIGNS="random census"]
	@sh tests/soak.sh

mutate: ## mutants of lib/ against the tests, a score and the survivors: [N=150] [SEED=n] [MINUTES=m] [FILES="lib/scene/gn_scene.c"]
	@SEED="$(SEED)" N="$(N)" MINUTES="$(MINUTES)" FILES="$(FILES)" sh tests/mutation/mutate.sh

prove: ## prove that primitives of lib/ can do nothing undefined, for all operands; needs Frama-C, which deps does not install
	@sh tests/prove/prove.sh

machines: ## the golden frames and the panel tests on big-endian hosts and as WebAssembly, where the compilers are installed
	@sh tests/firmware/machines.sh

coverage: ## print the lines and branches of lib/ that the C tests run, in some minutes
	@sh tests/coverage.sh

bench: $(BUILD)/gnomon ## count instructions on the host and on four target cores against the committed baselines; WRITE=1 renews them
	@sh tests/bench/bench.sh $(if $(WRITE),--write)
	@sh tests/bench/bench_target.sh $(if $(WRITE),--write)

firmware: $(if $(BOARD),,boards) ## build the image of a board: BOARD=mps2-an385 [APP=crc] [SCENE=FILE: APP=play] [PRESET=tiny]

emulate: $(if $(BOARD),,boards) ## build it, and run it in the emulator

screen: $(if $(BOARD),,boards) ## what a board's display shows: BOARD=lm3s6965evb ARGS="09:00 10:00" [APP=clock]

boards: ## list the boards
	@for file in boards/*/board.mk; do printf "  %-20s%s\n" "$$(basename $$(dirname $$file))" "$$(sed -n "1s/^# //p" $$file)"; done
	@$(if $(filter firmware emulate screen,$(MAKECMDGOALS)),echo "Which of them? BOARD=..." >&2; exit 1)

size: ## measure flash, RAM and worst-case stack on the targets; WRITE=1 renews baseline and documents
	@sh tests/firmware/size.sh $(if $(WRITE),--write)

dist: ## the packages that docs/FIRMWARE.md lists: build/dist/gnomon-VERSION.tar.gz
	@sh boards/packages/dist.sh $(BUILD)/dist

test-packages: ## of make test: what make dist packs, built with the tools of each ecosystem: CMake, Arduino
	@sh tests/tool/test_packages.sh

docs: $(BUILD)/gnomon $(addprefix $(BUILD)/test_,stages casters radiance punctual accuracy bias contact census rows seams crawl circle flicker kept culling lists changes extremes extremes_light extremes_many) ## regenerate the generated parts of docs/
	@sh docs/generate.sh $(BUILD)/gnomon

matrix: $(BUILD)/gnomon ## measure what each feature costs on two cores, in some minutes: docs/data/MATRIX.md
	@sh docs/matrix.sh $(BUILD)/gnomon

report: $(BUILD)/gnomon $(BUILD)/make_report ## one page of pictures, metrics and plots: build/report/index.html
	@sh host/report/report.sh $(BUILD)/gnomon $(SIZE) $(BUILD)/report $(patsubst %sundial.gltf,%sundial.gltf@48,$(OWN_SCENES)) $(SCENES)
	@echo $(BUILD)/report/index.html

playground: $(BUILD)/playground.html ## one page with the whole tool in it, for any browser: build/playground.html

test-playground: deps ## the playground in node and in a headless browser, in minutes; installs what it needs
	@sh tests/web/playground.sh

tables: $(BUILD)/gen_tables ## regenerate lib/base/gn_tables.c
	$(BUILD)/gen_tables > lib/base/gn_tables.c

prefix: ## regenerate lib/gn_prefix.h
	@mkdir -p $(BUILD)
	@sh host/generate/gen_prefix.sh >$(BUILD)/gn_prefix.h && mv $(BUILD)/gn_prefix.h lib/gn_prefix.h

scenes: $(BUILD)/make_scenes ## regenerate host/scenes/, docs/scenes/ and tests/bench/scenes/
	$(BUILD)/make_scenes host/scenes docs/scenes tests/bench/scenes

clean: ## remove the build folder
	rm -rf $(BUILD)

$(BUILD)/gnomon: $(BUILD)/obj/host/tool/main.o $(HOST_OBJ) $(LIB_OBJ)
	@echo '  LD $@'
	@$(CC) $(OPT) $(SAN) -o $@ $^ -lm

$(BUILD)/gen_tables: host/generate/gen_tables.c
	@mkdir -p $(@D)
	$(CC) $(HOST_CFLAGS) -o $@ $< -lm

$(BUILD)/make_report: $(patsubst %,$(BUILD)/obj/host/%.o, report/make_report report/embed base/json base/arena)
	@echo '  LD $@'
	@$(CC) $(OPT) $(SAN) -o $@ $^ -lm

# The tool for the page: the same sources as WebAssembly, but for the one that starts processes.
WASM_CC ?= clang --target=wasm32-wasi -isystem /usr/include/wasm32-wasi
WASM_OPT ?= -O2
WASM_CFLAGS := -std=c11 -D_POSIX_C_SOURCE=200809L $(WASM_OPT) $(WARN) -Ilib $(HOST_KNOBS) -DSLOW_LIBRARY=0 -Dmain=gnomon_main
WASM_SRC := $(filter-out %/sweep_target.c, $(HOST_SRC)) $(LIB_SRC) host/tool/main.c $(wildcard host/web/*.c)
WASM_OBJ := $(WASM_SRC:%.c=$(BUILD)/wasm/%.o)
WEB := $(wildcard host/web/*.js host/web/*.css host/web/*.html host/web/*.ino host/web/*.txt) host/web/page.sh

$(BUILD)/wasm/tools:
	@mkdir -p $(@D)
	@ls /usr/include/wasm32-wasi/stdio.h $(shell clang --target=wasm32-wasi -print-libgcc-file-name 2>/dev/null || echo /none) >/dev/null 2>&1 && command -v wasm-ld >/dev/null || \
	  { echo "The playground needs clang and lld for WebAssembly; in Debian: clang lld wasi-libc libclang-rt-dev-wasm32" >&2; exit 1; }
	@touch $@

$(BUILD)/wasm/%.o: %.c | $(BUILD)/wasm/tools
	@mkdir -p $(@D)
	@echo '  CC $< (WebAssembly)'
	@$(WASM_CC) $(WASM_CFLAGS) -MMD -MP -c -o $@ $<

$(BUILD)/gnomon.wasm: $(WASM_OBJ)
	@echo '  LD $@'
	@$(WASM_CC) $(WASM_OPT) -mexec-model=reactor -L/usr/lib/wasm32-wasi -Wl,-z,stack-size=8388608 -Wl,--stack-first -Wl,--strip-all \
	  -Wl,--wrap=picture_decode_rgba8 -o $@ $^ -lm

$(BUILD)/playground.html: $(BUILD)/gnomon.wasm $(WEB) $(wildcard host/scenes/*.gltf boards/*/link.ld) $(wildcard lib/*.h lib/*.c lib/*/*.h lib/*/*.c)
	@echo '  PAGE $@'
	@sh host/web/page.sh $@ $<

# Of the host's scene code the generator has the PNG writer alone.
SCENE_PNG := $(patsubst %,$(BUILD)/obj/host/scene/image/%.o, png_write deflate zlib_tables)
$(BUILD)/make_scenes: $(BUILD)/obj/host/generate/scenes/make_scenes.o $(SCENE_OBJ) $(SCENE_PNG)
	@echo '  LD $@'
	@$(CC) $(OPT) $(SAN) -o $@ $^ -lm

# Test programs of one variant: make test-programs BUILD=build/gcc-O0 CC=gcc OPT=-O0 SAN=-fsanitize=address,undefined
test-programs: $(TESTS:%=$(BUILD)/%) $(BUILD)/gnomon

# Of one configuration with constants: make constant-programs BUILD=build/tiny CONSTANTS=-DGN_PRESET=GN_PRESET_TINY
constant-programs: $(CONSTANT)

# Those that need no more than the library.
alone-programs: $(ALONE)

$(BUILD)/test_scenes: $(SCENE_OBJ)
$(BUILD)/test_panels $(BUILD)/test_panel_fuzz: $(PANEL_OBJ)

# What a board streamed, as a picture.
$(BUILD)/rgb565_png: $(BUILD)/obj/boards/tools/rgb565_png.o $(SCENE_PNG)
	@echo '  LD $@'
	@$(CC) $(OPT) $(SAN) -o $@ $^ -lm

$(BUILD)/ppm: $(BUILD)/obj/boards/tools/ppm.o $(SCENE_PNG)
	@echo '  LD $@'
	@$(CC) $(OPT) $(SAN) -o $@ $^ -lm

$(BUILD)/capture: $(BUILD)/obj/boards/tools/capture.o
	@echo '  LD $@'
	@$(CC) $(OPT) $(SAN) -o $@ $^

# A test program is found by its name, whatever folder of tests/ its source is in.
$(foreach source,$(TEST_SRC),$(eval $(BUILD)/$(basename $(notdir $(source))): $(source:%.c=$(BUILD)/obj/%.o)))
$(filter-out $(ALONE),$(TESTS:%=$(BUILD)/%)): $(HOST_OBJ)
$(ALONE): $(filter %/count.o,$(HOST_OBJ))
$(TESTS:%=$(BUILD)/%): $(LIB_OBJ)
	@echo '  LD $@'
	@$(CC) $(OPT) $(SAN) -o $@ $^ -lm

# OpenImageIO judges our PNG files: a C test over a small C++ shim.
$(BUILD)/test_oiio: $(BUILD)/obj/tests/tool/oiio/test_oiio.o $(BUILD)/obj/tests/tool/oiio/oiio_shim.o $(HOST_OBJ) $(LIB_OBJ)
	@echo '  LD $@'
	@$(CXX) -o $@ $^ $$(pkg-config --libs OpenImageIO) -lm

$(BUILD)/obj/tests/tool/oiio/oiio_shim.o: tests/tool/oiio/oiio_shim.cpp tests/tool/oiio/oiio_shim.h
	@mkdir -p $(@D)
	@echo '  CXX $<'
	@$(CXX) -std=c++17 -O1 -w $$(pkg-config --cflags OpenImageIO) -c -o $@ $<

$(BUILD)/obj/lib/%.o: lib/%.c
	@mkdir -p $(@D)
	@echo '  CC $<'
	@$(CC) $(LIB_CFLAGS) $(HOST_KNOBS) -MMD -MP -c -o $@ $<

$(BUILD)/obj/tests/%.o: HOST_CFLAGS += -Itests -Itests/support
$(foreach folder,unit property tool firmware,$(eval $(BUILD)/obj/tests/$(folder)/%.o: HOST_CFLAGS += $(TEST_OPT)))
$(BUILD)/obj/host/scene/%.o: HOST_CFLAGS += $(SCENE_OPT)

$(BUILD)/obj/%.o: %.c
	@mkdir -p $(@D)
	@echo '  CC $<'
	@$(CC) $(HOST_CFLAGS) -MMD -MP -c -o $@ $<

ifneq ($(BOARD),)
include boards/boards.mk
endif

-include $(shell find $(wildcard $(BUILD)/obj $(BUILD)/wasm) /dev/null -name "*.d")

.PHONY: all help run playground test-playground deps test dist test-packages soak mutate prove machines bench size matrix firmware emulate screen boards docs report prefix tables scenes coverage clean test-programs constant-programs alone-programs
.SECONDARY:
