/* A plugin of the emulator that counts the instructions of a run: it prints "instructions N" at the end. Built as a shared object; make
 * emulate COUNT=1 uses it. The emulator exports this interface, but its package has no header: what is used is declared here. */
#include <stdint.h>
#include <stdio.h>
#include <stddef.h>

struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum { NO_REGISTERS = 0 };

void qemu_plugin_register_vcpu_tb_trans_cb(uint64_t id, void (*callback)(uint64_t id, struct qemu_plugin_tb *tb));
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *tb);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *tb, size_t idx);
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *insn, void (*callback)(unsigned core, void *user), int flags, void *user);
void qemu_plugin_register_atexit_cb(uint64_t id, void (*callback)(uint64_t id, void *user), void *user);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;
__attribute__((visibility("default"))) int qemu_plugin_install(uint64_t id, const void *info, int argc, char **argv);

static unsigned long long n_instructions;

static void on_instruction(unsigned core, void *user)
{
    (void)core, (void)user;
    n_instructions++;
}

static void on_translation(uint64_t id, struct qemu_plugin_tb *tb)
{
    (void)id;
    for (size_t i = 0; i < qemu_plugin_tb_n_insns(tb); i++)
        qemu_plugin_register_vcpu_insn_exec_cb(qemu_plugin_tb_get_insn(tb, i), on_instruction, NO_REGISTERS, NULL);
}

static void at_exit(uint64_t id, void *user)
{
    (void)id, (void)user;
    fprintf(stderr, "instructions %llu\n", n_instructions);
}

int qemu_plugin_install(uint64_t id, const void *info, int argc, char **argv)
{
    (void)info, (void)argc, (void)argv;
    qemu_plugin_register_vcpu_tb_trans_cb(id, on_translation);
    qemu_plugin_register_atexit_cb(id, at_exit, NULL);
    return 0;
}
