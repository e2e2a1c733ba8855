/* A plugin of the emulator that counts the instructions of a run: it prints "instructions N" at the end. make emulate COUNT=1 uses it. */
#include <stdio.h>

#include "tcg_plugin.h"

__attribute__((visibility("default"))) int qemu_plugin_version = 1;
__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info *info, int argc, char **argv);

static unsigned long long n_instructions;

static void on_instruction(unsigned core, void *user)
{
    (void)core, (void)user;
    n_instructions++;
}

static void on_translation(qemu_plugin_id_t id, qemu_plugin_tb *block)
{
    (void)id;
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(block); i++)
        qemu_plugin_register_vcpu_insn_exec_cb(qemu_plugin_tb_get_insn(block, i), on_instruction, QEMU_PLUGIN_CB_NO_REGS, NULL);
}

static void at_exit(qemu_plugin_id_t id, void *user)
{
    (void)id, (void)user;
    fprintf(stderr, "instructions %llu\n", n_instructions);
}

int qemu_plugin_install(qemu_plugin_id_t id, const qemu_info *info, int argc, char **argv)
{
    (void)info, (void)argc, (void)argv;
    qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
    qemu_plugin_register_atexit_cb(id, at_exit, NULL);
    return 0;
}
