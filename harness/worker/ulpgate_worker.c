/* A process that calls foreign functions on behalf of the harness: what it crashes, hangs or sets is its own.
 *
 *   ulpgate-worker LIBRARY SYMBOL SIGNATURE     with the channel of worker_channel.h as descriptor 3
 *
 * LIBRARY "-" is the worker itself: of a static one, which has no loader, the functions of its table (below).
 * Plain C without dependencies but the C library, so that it can be built against another one:
 *   musl-gcc -O2 -static -DULPGATE_WORKER_TABLE='"table.h"' ulpgate_worker.c -o ulpgate-worker-musl -lm
 * where each line of table.h is ULPGATE_FUNCTION(sin).
 */
#define _GNU_SOURCE
#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
#ifdef ULPGATE_WORKER_TABLE
#include <math.h>
#else
#include <dlfcn.h>
#include <elf.h>
#include <link.h>
#endif

#include "worker_channel.h"
#include "worker_signature.h"

typedef void (*function_t)(void);
static struct ulpgate_channel* channel;

#include "worker_thunks.h"

static struct ulpgate_environment standard;

/* Of the kernel's interface; its headers are not every C library's. */
enum { FUTEX_WAIT = 0, FUTEX_WAKE = 1 };

static long futex(uint32_t* word, int operation, uint32_t value) {
  return syscall(SYS_futex, word, operation, value, NULL, NULL, 0);
}

static void answer(uint32_t request) {
  __atomic_store_n(&channel->reply, request, __ATOMIC_RELEASE);
  futex(&channel->reply, FUTEX_WAKE, INT_MAX);
}

static void set_state(enum ulpgate_worker_state state) {
  __atomic_store_n(&channel->state, state, __ATOMIC_RELEASE);
  futex(&channel->state, FUTEX_WAKE, INT_MAX);
}

static void end_with(enum ulpgate_worker_state state, const char* what, const char* why) {
  snprintf(channel->message, sizeof channel->message, "%s: %s", what, why);
  set_state(state);
  _exit(1);
}
static void refuse(const char* what, const char* why) {
  end_with(ulpgate_worker_refused, what, why);
}

/* ---- the floating-point environment: control bits, exception flags left out ---- */

#if defined(__x86_64__)
enum { mxcsr_controls = 0xffc0, mxcsr_flags = 0x3f };
static struct ulpgate_environment environment(void) {
  struct ulpgate_environment e;
  uint16_t x87;
  __asm__ volatile("fnstcw %0" : "=m"(x87));
  e.sse = __builtin_ia32_stmxcsr() & mxcsr_controls;
  e.x87 = x87;
  return e;
}
static void restore(void) {
  const struct ulpgate_environment now = environment();
  if (now.sse != standard.sse)
    __builtin_ia32_ldmxcsr(standard.sse | (__builtin_ia32_stmxcsr() & mxcsr_flags));
  if (now.x87 != standard.x87) {
    const uint16_t x87 = (uint16_t)standard.x87;
    __asm__ volatile("fldcw %0" : : "m"(x87));
  }
}
#elif defined(__aarch64__)
static struct ulpgate_environment environment(void) {
  uint64_t fpcr;
  __asm__ volatile("mrs %0, fpcr" : "=r"(fpcr));
  struct ulpgate_environment e = {(uint32_t)fpcr, 0};
  return e;
}
static void restore(void) {
  const uint64_t fpcr = standard.sse;
  __asm__ volatile("msr fpcr, %0" : : "r"(fpcr));
}
#else
#include <fenv.h>
static struct ulpgate_environment environment(void) {
  struct ulpgate_environment e = {(uint32_t)fegetround(), 0};
  return e;
}
static void restore(void) {
  fesetround((int)standard.sse);
}
#endif

static int same(struct ulpgate_environment a, struct ulpgate_environment b) {
  return a.sse == b.sse && a.x87 == b.x87;
}

/* Whether it is another; it is as it was before afterwards. */
static unsigned char environment_changed(void) {
  const struct ulpgate_environment now = environment();
  if (same(now, standard)) return 0;
  if (channel->changed == 0) channel->after = now;
  channel->changed = 1;
  restore();
  return 1;
}

/* ---- signals ---- */

static const int watched[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGTRAP, SIGSYS};
enum { watched_count = sizeof watched / sizeof watched[0] };

/* The state of the process may be broken: what is known is written down, and it ends. */
static void on_signal(int number) {
  channel->signal = number;
  __atomic_store_n(&channel->state, ulpgate_worker_signalled, __ATOMIC_RELEASE);
  futex(&channel->state, FUTEX_WAKE, INT_MAX);
  futex(&channel->reply, FUTEX_WAKE, INT_MAX);
  _exit(2);
}

static void handle_signals(void) {
  static unsigned char stack[64 * 1024];
  stack_t own;
  memset(&own, 0, sizeof own);
  own.ss_sp = stack;
  own.ss_size = sizeof stack;
  sigaltstack(&own, NULL);
  struct sigaction action;
  memset(&action, 0, sizeof action);
  action.sa_handler = on_signal;
  action.sa_flags = SA_ONSTACK;
  for (int i = 0; i < watched_count; ++i) sigaction(watched[i], &action, NULL);
}

static void note_replaced_handlers(void) {
  for (int i = 0; i < watched_count; ++i) {
    struct sigaction now;
    if (sigaction(watched[i], NULL, &now) == 0 && now.sa_handler != on_signal)
      channel->handlers |= UINT64_C(1) << (watched[i] - 1);
  }
  if (channel->handlers != 0) handle_signals();
}

/* ---- what is called ---- */

#ifdef ULPGATE_WORKER_TABLE
struct named {
  const char* name;
  function_t call;
};
static const struct named table[] = {
#define ULPGATE_FUNCTION(f) {#f, (function_t)(f)},
#include ULPGATE_WORKER_TABLE
#undef ULPGATE_FUNCTION
    {NULL, NULL}};

static function_t find(const char* library, const char* symbol) {
  if (strcmp(library, "-") != 0) refuse("a static worker loads no library", library);
  ssize_t n = readlink("/proc/self/exe", channel->path, sizeof channel->path - 1);
  if (n > 0) channel->path[n] = '\0';
  for (const struct named* f = table; f->name != NULL; ++f)
    if (strcmp(f->name, symbol) == 0) return f->call;
  refuse("not in the table of this worker", symbol);
  return NULL;
}
#else
struct sought {
  uintptr_t address;
};

static void read_note(const char* at, const char* end) {
  while (at + sizeof(ElfW(Nhdr)) <= end) {
    const ElfW(Nhdr)* note = (const ElfW(Nhdr)*)at;
    const char* name = at + sizeof *note;
    const unsigned char* body = (const unsigned char*)name + ((note->n_namesz + 3) & ~3U);
    const char* next = (const char*)body + ((note->n_descsz + 3) & ~3U);
    if (note->n_type == NT_GNU_BUILD_ID && note->n_namesz == 4 && memcmp(name, "GNU", 4) == 0 &&
        next <= end) {
      for (unsigned i = 0; i < note->n_descsz && 2 * i + 2 < sizeof channel->build_id; ++i)
        snprintf(channel->build_id + 2 * i, 3, "%02x", body[i]);
      return;
    }
    at = next;
  }
}

/* Fills in the build-id and the SONAME of the object that holds the symbol. */
static int describe(struct dl_phdr_info* info, size_t size, void* data) {
  (void)size;
  const uintptr_t address = ((const struct sought*)data)->address;
  int holds = 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)* p = &info->dlpi_phdr[i];
    if (p->p_type == PT_LOAD && address - info->dlpi_addr - p->p_vaddr < p->p_memsz) holds = 1;
  }
  if (!holds) return 0;
  for (int i = 0; i < info->dlpi_phnum; ++i) {
    const ElfW(Phdr)* p = &info->dlpi_phdr[i];
    const char* start = (const char*)info->dlpi_addr + p->p_vaddr;
    if (p->p_type == PT_NOTE) read_note(start, start + p->p_memsz);
    if (p->p_type != PT_DYNAMIC) continue;
    const char* strings = NULL;
    size_t soname = 0;
    for (const ElfW(Dyn)* d = (const ElfW(Dyn)*)start; d->d_tag != DT_NULL; ++d) {
      /* glibc relocates this entry in place, musl does not. */
      if (d->d_tag == DT_STRTAB)
        strings =
            (const char*)(d->d_un.d_ptr < info->dlpi_addr ? info->dlpi_addr + d->d_un.d_ptr : d->d_un.d_ptr);
      if (d->d_tag == DT_SONAME) soname = d->d_un.d_val;
    }
    if (strings != NULL && soname != 0)
      snprintf(channel->soname, sizeof channel->soname, "%s", strings + soname);
  }
  return 1;
}

static function_t find(const char* library, const char* symbol) {
  int flags = RTLD_NOW | RTLD_LOCAL;
#ifdef RTLD_DEEPBIND
  /* A library that calls its own exp means its own exp, not the one that this process has already. */
  flags |= RTLD_DEEPBIND;
#endif
  void* handle = dlopen(strcmp(library, "-") == 0 ? NULL : library, flags);
  if (handle == NULL) {
    const char* why = dlerror();
    refuse("cannot be loaded", why != NULL ? why : library);
  }
  void* found = dlsym(handle, symbol);
  if (found == NULL) refuse("there is no symbol", symbol);
  Dl_info where;
  if (dladdr(found, &where) != 0 && where.dli_fname != NULL &&
      realpath(where.dli_fname, channel->path) == NULL)
    snprintf(channel->path, sizeof channel->path, "%s", where.dli_fname);
  struct sought sought = {(uintptr_t)found};
  dl_iterate_phdr(describe, &sought);
  function_t call;
  memcpy(&call, &found, sizeof call);
  return call;
}
#endif

typedef void (*thunk_t)(function_t, const struct ulpgate_signature*, uint32_t, uint32_t);

/* Null where this processor or compiler has no such type. */
static thunk_t thunk_of(const struct ulpgate_signature* s) {
  if (s->lanes == 1) {
    if (s->element == 'f') return scalar_f;
    if (s->element == 'd') return scalar_d;
    if (s->element == 'l') return scalar_l;
#if defined(__SIZEOF_FLOAT128__)
    if (s->element == 'q') return scalar_q;
#endif
    return NULL;
  }
  const int bits = s->lanes * (s->element == 'f' ? 32 : 64);
  if (bits == 128) return s->element == 'f' ? vector_f4 : vector_d2;
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (bits == 256 && __builtin_cpu_supports("avx2")) return s->element == 'f' ? vector_f8 : vector_d4;
  if (bits == 512 && __builtin_cpu_supports("avx512f")) return s->element == 'f' ? vector_f16 : vector_d8;
#endif
  return NULL;
}

static uint64_t now_ns(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (uint64_t)t.tv_sec * 1000000000U + (uint64_t)t.tv_nsec;
}

static void serve(function_t f, const struct ulpgate_signature* s, thunk_t thunk) {
  uint32_t done = __atomic_load_n(&channel->reply, __ATOMIC_ACQUIRE);
  for (;;) {
    uint32_t request = __atomic_load_n(&channel->request, __ATOMIC_ACQUIRE);
    if (request == done) {
      futex(&channel->request, FUTEX_WAIT, done);
      continue;
    }
    const uint32_t count = channel->count;
    channel->changed = 0;
    restore();
    if (channel->mode == ulpgate_worker_singly) {
      for (uint32_t i = 0; i < count; i += (uint32_t)s->lanes) {
        const uint32_t last = count - i < (uint32_t)s->lanes ? count : i + (uint32_t)s->lanes;
        thunk(f, s, i, last);
        memset(channel->changed_points + i, environment_changed(), last - i);
      }
    } else {
      const uint64_t start = now_ns();
      for (uint32_t round = 0; round < channel->rounds; ++round) thunk(f, s, 0, count);
      channel->elapsed_ns = now_ns() - start;
      environment_changed();
    }
    note_replaced_handlers();
    done = request;
    answer(request);
  }
}

int main(int argc, char** argv) {
  channel = mmap(NULL, sizeof *channel, PROT_READ | PROT_WRITE, MAP_SHARED, ulpgate_channel_fd, 0);
  if (argc != 4 || channel == MAP_FAILED) {
    fprintf(stderr,
            "ulpgate-worker: started by ulpgate alone, with LIBRARY SYMBOL SIGNATURE and its channel\n");
    return 2;
  }
  close(ulpgate_channel_fd);
  if (channel->magic != ulpgate_channel_magic || channel->version != ulpgate_channel_version)
    refuse("the worker is of another version of ulpgate", argv[0]);
  /* It dies with the thread that started it, leaves no core, and takes no machine down with it. */
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const struct rlimit no_core = {0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  const struct rlimit memory = {UINT64_C(8) << 30, UINT64_C(8) << 30};
  setrlimit(RLIMIT_AS, &memory);
  handle_signals();
  struct ulpgate_signature signature;
  if (!ulpgate_parse_signature(argv[3], &signature)) refuse("no signature", argv[3]);
  const thunk_t thunk = thunk_of(&signature);
  if (thunk == NULL)
    end_with(ulpgate_worker_unsupported, "this processor has no such vectors, or the worker no such type",
             argv[3]);
  standard = environment();
  channel->at_start = standard;
  set_state(ulpgate_worker_loading);
  const function_t f = find(argv[1], argv[2]);
  channel->loaded = environment();
  restore();
  note_replaced_handlers();
  set_state(ulpgate_worker_ready);
  serve(f, &signature, thunk);
}
