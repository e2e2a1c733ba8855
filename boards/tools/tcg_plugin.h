/* What boards/tools/stage_plugin.c uses of the emulator's plugin interface, version 1. Debian's packages have no header
 * for it. */
#ifndef GNOMON_BOARDS_TCG_PLUGIN_H
#define GNOMON_BOARDS_TCG_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

typedef uint64_t qemu_plugin_id_t;
typedef struct qemu_info qemu_info;
typedef struct qemu_plugin_tb qemu_plugin_tb;     /* a block of translated code */
typedef struct qemu_plugin_insn qemu_plugin_insn; /* an instruction of it */
enum { QEMU_PLUGIN_CB_NO_REGS = 0 };

typedef void (*tcg_translated_fn)(qemu_plugin_id_t id, qemu_plugin_tb *block);
typedef void (*tcg_executed_fn)(unsigned core, void *user);
typedef void (*tcg_exit_fn)(qemu_plugin_id_t id, void *user);

void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id, tcg_translated_fn fn);
void qemu_plugin_register_vcpu_insn_exec_cb(qemu_plugin_insn *instruction, tcg_executed_fn fn, int flags, void *user);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id, tcg_exit_fn fn, void *user);
size_t qemu_plugin_tb_n_insns(const qemu_plugin_tb *block);
qemu_plugin_insn *qemu_plugin_tb_get_insn(const qemu_plugin_tb *block, size_t i);
uint64_t qemu_plugin_insn_vaddr(const qemu_plugin_insn *instruction);

#endif
