/* A plugin of the emulator: counts the instructions that firmware executes, by stage. A stage lasts from the first
 * instruction of its function to that of another stage's; what runs before the first is stage 0.
 *
 *   qemu-system-arm ... -plugin libstages.so,out=FILE,stage=ADDRESS,stage=ADDRESS...
 *
 * writes one line per stage to FILE: "stage NUMBER INSTRUCTIONS", in the order of the arguments, counted from 1.
 * Without out= it prints "instructions N", of the whole run: make emulate COUNT=1.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tcg_plugin.h"

enum { MAX_STAGES = 32 };

static uint64_t address[MAX_STAGES + 1], instructions[MAX_STAGES + 1];
static size_t n_stages, stage;
static char out_path[4096];

static void count(unsigned core, void *user)
{
    (void)core, (void)user;
    instructions[stage]++;
}

static void enter(unsigned core, void *user)
{
    stage = (size_t)((uint64_t *)user - address);
    count(core, NULL);
}

static void translated(qemu_plugin_id_t id, qemu_plugin_tb *block)
{
    (void)id;
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); i++) {
        qemu_plugin_insn *instruction = qemu_plugin_tb_get_insn(block, i);
        uint64_t *entry = NULL;
        for (size_t s = 1; s <= n_stages; s++)
            if (address[s] == qemu_plugin_insn_vaddr(instruction)) entry = &address[s];
        qemu_plugin_register_vcpu_insn_exec_cb(instruction, entry ? enter : count, QEMU_PLUGIN_CB_NO_REGS, entry);
    }
}

static void write_out(qemu_plugin_id_t id, void *user)
{
    (void)id, (void)user;
    uint64_t sum = 0;
    for (size_t s = 0; s <= n_stages; s++) sum += instructions[s];
    if (!*out_path) fprintf(stderr, "instructions %" PRIu64 "\n", sum);
    FILE *out = *out_path ? fopen(out_path, "w") : NULL;
    if (!out) return;
    for (size_t s = 0; s <= n_stages; s++) fprintf(out, "stage %zu %" PRIu64 "\n", s, instructions[s]);
    fclose(out);
}

/* The emulator looks these up by name. */
extern __attribute__((visibility("default"))) int qemu_plugin_version;
int qemu_plugin_version = 1;

__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info *info, int argc,
                                                               char **argv);

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info *info, int argc, char **argv)
{
    (void)info;
    for (int i = 0; i < argc; i++) {
        if (!strncmp(argv[i], "out=", 4)) snprintf(out_path, sizeof out_path, "%s", argv[i] + 4);
        else if (!strncmp(argv[i], "stage=", 6) && n_stages < MAX_STAGES)
            address[++n_stages] = strtoull(argv[i] + 6, NULL, 16) & ~(uint64_t)1;
        else {
            fprintf(stderr, "stages: unknown argument %s\n", argv[i]);
            return 1;
        }
    }
    qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
    qemu_plugin_register_atexit_cb(id, write_out, NULL);
    return 0;
}
