# CYCLES=1: also the core's cycles, for an owner's own board; a board that QEMU runs counts instructions.
CYCLES ?= $(if $(filter no rp2040js,$(BOARD_RUNS)),1)
ifneq ($(CYCLES),)
APP_SRC := boards/common/cycles.c
BENCH_CYCLES := -DBENCH_CYCLES=1
endif
APP_FLAGS := $(BENCH_CYCLES)
# Without a scene: the workload, from the program that makes it on this machine.
ifeq ($(SCENE),)
APP_FLAGS += -I$(BUILD)/firmware/bench -DGN_MAX_TRIANGLES=1000 -DGN_MAX_TILE_REFS=8000
$(FW_OBJ_DIR)/boards/apps/bench.o: $(BUILD)/firmware/bench/bench_meshes.h
$(BUILD)/firmware/bench/bench_meshes.h: tests/bench/bench_workload.c tests/bench/bench_gen.c boards/apps/bench_scene.h
	@mkdir -p $(@D)
	@gcc -std=c11 -D_POSIX_C_SOURCE=200809L -O1 -Ilib -Itests -DGN_MAX_TRIANGLES=1000 -DGN_MAX_TILE_REFS=8000 -o $(@D)/workload \
	  tests/bench/bench_workload.c tests/bench/bench_gen.c host/scene/image/zlib_tables.c lib/*.c -lm
	@$(@D)/workload meshes >$@
endif
