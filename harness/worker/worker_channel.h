/* What the harness and a worker process share: a page of words, the arguments and the results.  C and C++. */
#ifndef ULPGATE_WORKER_CHANNEL_H
#define ULPGATE_WORKER_CHANNEL_H

#include <stddef.h>
#include <stdint.h>

/* NOLINTBEGIN(readability-identifier-naming): C */

/* Raise it when anything below changes: a worker of another build is refused rather than misread. */
enum { ulpgate_channel_version = 3, ulpgate_channel_magic = 0x55504757 };
/* The descriptor under which a worker finds the channel. */
enum { ulpgate_channel_fd = 3 };
/* The most points of a request, and values of the widest type that its arguments and its results may take. */
enum { ulpgate_channel_points = 32768, ulpgate_channel_values = 3 * ulpgate_channel_points };

enum ulpgate_worker_state {
  ulpgate_worker_starting = 0, /* nothing of the library has run */
  ulpgate_worker_loading,      /* its constructors run */
  ulpgate_worker_ready,
  ulpgate_worker_refused,     /* `message` says why */
  ulpgate_worker_unsupported, /* likewise: not on this processor, or not with this compiler */
  ulpgate_worker_signalled,   /* `signal` ended it */
};

enum ulpgate_worker_mode {
  ulpgate_worker_whole = 0, /* the environment is looked at behind the batch */
  ulpgate_worker_singly,    /* it is restored before and looked at behind every point */
};

/* Control bits of the processor's floating-point units: rounding, precision, flushing, traps. */
struct ulpgate_environment {
  uint32_t sse; /* MXCSR without its flags; FPCR on AArch64 */
  uint32_t x87; /* the control word */
};

struct ulpgate_channel {
  uint32_t magic;
  uint32_t version;
  /* The harness writes `request` and wakes it; the worker answers with the same number in `reply`, and wakes
   * that. */
  uint32_t request;
  uint32_t reply;
  uint64_t progress; /* the point that is being evaluated, of vectors the first of its lanes */
  uint32_t count;    /* points of this request */
  uint32_t mode;
  uint32_t state;
  int32_t signal;
  uint64_t elapsed_ns; /* that a whole batch took, all rounds */
  uint32_t rounds;     /* how often, where the batch is whole */
  uint32_t changed;    /* 1 where a point or the batch left another environment behind: the first such one is
                          `after` */
  struct ulpgate_environment after;
  /* That of a process before and behind the library's constructors. */
  struct ulpgate_environment at_start;
  struct ulpgate_environment loaded;
  /* Signals whose handlers the library replaced, a bit for each: 1 << (signal - 1). */
  uint64_t handlers;
  /* Of mode singly: 1 for each point that left another environment, and for the others of its vector. */
  unsigned char changed_points[ulpgate_channel_points];
  char message[512];
  char path[1024]; /* of the library, as the loader resolved it */
  char soname[256];
  char build_id[80]; /* hexadecimal; empty where there is none */
  unsigned char arguments[16 * ulpgate_channel_values] __attribute__((aligned(64)));
  unsigned char results[16 * ulpgate_channel_values] __attribute__((aligned(64)));
};

/* NOLINTEND(readability-identifier-naming) */

#endif
