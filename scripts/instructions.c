// QEMU plugin that counts the instructions an emulated program executes, thread by thread. Debian ships
// QEMU's plugins' interface without its header; these declarations are those of API version 1.
#include <inttypes.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
enum { kNoRegisters = 0 };
extern size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb* block);
extern void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t id,
                                                  void (*call)(qemu_plugin_id_t, struct qemu_plugin_tb*));
extern void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb* block, void (*call)(unsigned, void*),
                                                 int registers, void* data);
extern void qemu_plugin_register_atexit_cb(qemu_plugin_id_t id, void (*call)(qemu_plugin_id_t, void*),
                                           void* data);

__attribute__((visibility("default"))) int qemu_plugin_version = 1;

enum { kThreads = 64 };
static uint64_t executed[kThreads];  // the last also counts for all after it

static void run(unsigned thread, void* instructions) {
  executed[thread < kThreads ? thread : kThreads - 1] += (uintptr_t)instructions;
}

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb* block) {
  (void)id;
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the number itself is what travels
  qemu_plugin_register_vcpu_tb_exec_cb(block, run, kNoRegisters,
                                       (void*)(uintptr_t)qemu_plugin_tb_n_insns(block));
}

static void at_exit(qemu_plugin_id_t id, void* data) {
  (void)id;
  (void)data;
  for (int thread = 0; thread < kThreads; ++thread)
    if (executed[thread] != 0) fprintf(stderr, "instructions %d %" PRIu64 "\n", thread, executed[thread]);
}

__attribute__((visibility("default"))) int qemu_plugin_install(qemu_plugin_id_t id, const void* info,
                                                               int argc, char** argv) {
  (void)info;
  (void)argc;
  (void)argv;
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_atexit_cb(id, at_exit, NULL);
  return 0;
}
