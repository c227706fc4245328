/* Calls of every signature: NAME(f, signature, first, last) evaluates these points of `channel`.  Included by
 * ulpgate_worker.c alone. */
/* A store costs nothing measurable and names the argument of a crash. */
static inline void progress(uint32_t i) {
  __atomic_store_n(&channel->progress, i, __ATOMIC_RELAXED);
}

#define SCALAR_THUNK(NAME, T)                                                                        \
  static void NAME(function_t f, const struct ulpgate_signature* s, uint32_t first, uint32_t last) { \
    const T* a = (const T*)channel->arguments;                                                       \
    T* r = (T*)channel->results;                                                                     \
    int sign;                                                                                        \
    if (s->shape == ulpgate_shape_arrays) {                                                          \
      progress(first);                                                                               \
      /* The arguments of a point stand side by side; here one array follows the other. */           \
      static T x[2][ulpgate_channel_values];                                                         \
      const long n = (long)(last - first);                                                           \
      for (uint32_t i = first; i < last; ++i)                                                        \
        for (int j = 0; j < s->arguments; ++j)                                                       \
          x[j][i - first] = a[(uint32_t)s->arguments * i + (uint32_t)j];                             \
      if (s->arguments == 1) ((void (*)(long, const T*, T*))f)(n, x[0], r + first);                  \
      if (s->arguments == 2) ((void (*)(long, const T*, const T*, T*))f)(n, x[0], x[1], r + first);  \
      return;                                                                                        \
    }                                                                                                \
    for (uint32_t i = first; i < last; ++i) {                                                        \
      progress(i);                                                                                   \
      if (s->shape == ulpgate_shape_pair) {                                                          \
        ((void (*)(T, T*, T*))f)(a[i], r + 2 * i, r + 2 * i + 1);                                    \
      } else if (s->shape == ulpgate_shape_sign) {                                                   \
        r[i] = ((T(*)(T, int*))f)(a[i], &sign);                                                      \
      } else if (s->integer == 1) {                                                                  \
        r[i] = ((T(*)(int, T))f)((int)a[2 * i], a[2 * i + 1]);                                       \
      } else if (s->integer == 2) {                                                                  \
        r[i] = ((T(*)(T, int))f)(a[2 * i], (int)a[2 * i + 1]);                                       \
      } else if (s->arguments == 1) {                                                                \
        r[i] = ((T(*)(T))f)(a[i]);                                                                   \
      } else if (s->arguments == 2) {                                                                \
        r[i] = ((T(*)(T, T))f)(a[2 * i], a[2 * i + 1]);                                              \
      } else {                                                                                       \
        r[i] = ((T(*)(T, T, T))f)(a[3 * i], a[3 * i + 1], a[3 * i + 2]);                             \
      }                                                                                              \
    }                                                                                                \
  }

SCALAR_THUNK(scalar_f, float)
SCALAR_THUNK(scalar_d, double)
SCALAR_THUNK(scalar_l, long double)
#if defined(__SIZEOF_FLOAT128__)
SCALAR_THUNK(scalar_q, __float128)
#endif

/* The last vector of a range is filled up with its last point. */
#define VECTOR_THUNK(NAME, T, LANES, TARGET)                                                                \
  typedef T NAME##_vector __attribute__((vector_size(LANES * sizeof(T))));                                  \
  typedef uint64_t NAME##_addresses __attribute__((vector_size(LANES * sizeof(T))));                        \
  TARGET static void NAME(function_t f, const struct ulpgate_signature* s, uint32_t first, uint32_t last) { \
    typedef NAME##_vector V;                                                                                \
    const T* a = (const T*)channel->arguments;                                                              \
    T* r = (T*)channel->results;                                                                            \
    const uint32_t arity = (uint32_t)s->arguments;                                                          \
    uint32_t i = first;                                                                                     \
    if (arity == 1 && s->shape != ulpgate_shape_pair && s->shape != ulpgate_shape_lane_pair) {              \
      /* Without a call but that of f, which may take no longer. */                                         \
      for (; last - i >= LANES; i += LANES) {                                                               \
        V one;                                                                                              \
        progress(i);                                                                                        \
        memcpy(&one, a + i, sizeof(V));                                                                     \
        one = ((V(*)(V))f)(one);                                                                            \
        memcpy(r + i, &one, sizeof(V));                                                                     \
      }                                                                                                     \
    }                                                                                                       \
    for (; i < last; i += LANES) {                                                                          \
      progress(i);                                                                                          \
      V x[3] = {{0}};                                                                                       \
      V y;                                                                                                  \
      const uint32_t n = last - i < LANES ? last - i : LANES;                                               \
      for (uint32_t j = 0; j < arity; ++j)                                                                  \
        for (uint32_t k = 0; k < LANES; ++k) x[j][k] = a[arity * (i + (k < n ? k : n - 1)) + j];            \
      if (s->shape == ulpgate_shape_pair) {                                                                 \
        T sine[LANES];                                                                                      \
        T cosine[LANES];                                                                                    \
        ((void (*)(V, T*, T*))f)(x[0], sine, cosine);                                                       \
        for (uint32_t k = 0; k < n; ++k) {                                                                  \
          r[2 * (i + k)] = sine[k];                                                                         \
          r[2 * (i + k) + 1] = cosine[k];                                                                   \
        }                                                                                                   \
        continue;                                                                                           \
      }                                                                                                     \
      if (s->shape == ulpgate_shape_lane_pair) {                                                            \
        /* As many vectors of addresses as their width wants: one of doubles, two of floats. */             \
        NAME##_addresses p[4];                                                                              \
        enum { per = sizeof(V) / sizeof(uint64_t), vectors = LANES / per };                                 \
        T unused;                                                                                           \
        for (uint32_t k = 0; k < LANES; ++k) {                                                              \
          p[k / per][k % per] = (uint64_t)(uintptr_t)(k < n ? r + 2 * (i + k) : &unused);                   \
          p[vectors + k / per][k % per] = (uint64_t)(uintptr_t)(k < n ? r + 2 * (i + k) + 1 : &unused);     \
        }                                                                                                   \
        typedef NAME##_addresses A;                                                                         \
        if (vectors == 1) {                                                                                 \
          ((void (*)(V, A, A))f)(x[0], p[0], p[1]);                                                         \
        } else {                                                                                            \
          ((void (*)(V, A, A, A, A))f)(x[0], p[0], p[1], p[2], p[3]);                                       \
        }                                                                                                   \
        continue;                                                                                           \
      }                                                                                                     \
      if (arity == 1) {                                                                                     \
        y = ((V(*)(V))f)(x[0]);                                                                             \
      } else if (arity == 2) {                                                                              \
        y = ((V(*)(V, V))f)(x[0], x[1]);                                                                    \
      } else {                                                                                              \
        y = ((V(*)(V, V, V))f)(x[0], x[1], x[2]);                                                           \
      }                                                                                                     \
      memcpy(r + i, &y, n * sizeof(T));                                                                     \
    }                                                                                                       \
  }

VECTOR_THUNK(vector_d2, double, 2, )
VECTOR_THUNK(vector_f4, float, 4, )
#if defined(__x86_64__)
VECTOR_THUNK(vector_d4, double, 4, __attribute__((target("avx2"))))
VECTOR_THUNK(vector_f8, float, 8, __attribute__((target("avx2"))))
VECTOR_THUNK(vector_d8, double, 8, __attribute__((target("avx512f"))))
VECTOR_THUNK(vector_f16, float, 16, __attribute__((target("avx512f"))))
#endif
