/* Signatures of foreign functions as words, read by the harness and by its workers alike.  C and C++.
 *
 *   d(d)  d(d,d)  d(d,d,d)      one value; f, d, l, q: float, double, long double, binary128
 *   d(i,d)  d(d,i)              one argument is an int
 *   d(d,i*)                     the sign of a result in an int, as of lgamma_r: not looked at
 *   v4d(v4d)  v4d(v4d,v4d)      vectors of 128, 256 or 512 bits by value: v2d v4d v8d v4f v8f v16f
 *   void(n,d*,d*)  void(n,d*,d*,d*)   arrays of any length, arguments first
 *   void(d,d*,d*)  void(v4d,d*,d*)    sincos: two results
 *   void(v4d,v4d*,v4d*)         sincos of the vector ABI's "vvv": vectors of pointers, one for each lane
 */
#ifndef ULPGATE_WORKER_SIGNATURE_H
#define ULPGATE_WORKER_SIGNATURE_H

#include <string.h>

/* NOLINTBEGIN(readability-identifier-naming): C */

enum ulpgate_shape {
  ulpgate_shape_value,     /* results are returned */
  ulpgate_shape_sign,      /* returned, with a pointer to an int behind the arguments */
  ulpgate_shape_arrays,    /* a length, arrays of arguments, one of results */
  ulpgate_shape_pair,      /* one argument, two pointers to results */
  ulpgate_shape_lane_pair, /* likewise, two vectors of pointers */
};

struct ulpgate_signature {
  char element; /* f d l q */
  int lanes;    /* 1: no vector */
  enum ulpgate_shape shape;
  int arguments;
  int integer; /* which argument is an int, counted from 1; 0: none */
};

/* Reads "d" or "v4d" at *text; 0 where there is neither. */
static inline int ulpgate_read_operand(const char** text, char* element, int* lanes) {
  const char* at = *text;
  int n = 1;
  if (*at == 'v') {
    n = 0;
    for (++at; *at >= '0' && *at <= '9' && n < 100; ++at) n = 10 * n + (*at - '0');
    if (n != 2 && n != 4 && n != 8 && n != 16) return 0;
  }
  if (*at == '\0' || strchr("fdlq", *at) == NULL) return 0;
  *element = *at;
  *lanes = n;
  *text = at + 1;
  return 1;
}

/* Of the results that a call writes. */
static inline int ulpgate_results_of(const struct ulpgate_signature* s) {
  return s->shape == ulpgate_shape_pair || s->shape == ulpgate_shape_lane_pair ? 2 : 1;
}

/* Returns 1, or 0 for anything that is no signature. */
static inline int ulpgate_parse_signature(const char* text, struct ulpgate_signature* out) {
  struct ulpgate_signature s = {'d', 1, ulpgate_shape_value, 0, 0};
  char element = 'd';
  int lanes = 1;
  int pointers = 0;
  const int is_void = strncmp(text, "void(", 5) == 0;
  if (is_void) {
    text += 5;
    if (strncmp(text, "n,", 2) == 0) {
      text += 2;
      s.shape = ulpgate_shape_arrays;
    } else {
      if (!ulpgate_read_operand(&text, &s.element, &s.lanes) || *text++ != ',') return 0;
      s.shape = ulpgate_shape_pair;
      s.arguments = 1;
    }
    do {
      if (!ulpgate_read_operand(&text, &element, &lanes) || *text++ != '*') return 0;
      if (lanes != 1 && (s.shape == ulpgate_shape_arrays || lanes != s.lanes)) return 0;
      if (pointers > 0 && (lanes != 1) != (s.shape == ulpgate_shape_lane_pair)) return 0;
      if (lanes != 1) s.shape = ulpgate_shape_lane_pair;
      if (pointers == 0 && s.shape == ulpgate_shape_arrays) s.element = element;
      if (element != s.element) return 0;
      ++pointers;
    } while (*text == ',' && *++text != '\0');
    if (s.shape != ulpgate_shape_arrays && pointers != 2) return 0;
    if (s.shape == ulpgate_shape_arrays) s.arguments = pointers - 1;
  } else {
    if (!ulpgate_read_operand(&text, &s.element, &s.lanes) || *text++ != '(') return 0;
    do {
      if (strncmp(text, "i*", 2) == 0) {
        if (s.shape == ulpgate_shape_sign) return 0;
        s.shape = ulpgate_shape_sign;
        text += 2;
        continue;
      }
      if (s.shape == ulpgate_shape_sign) return 0;
      ++s.arguments;
      if (*text == 'i') {
        if (s.integer != 0) return 0;
        s.integer = s.arguments;
        ++text;
      } else if (!ulpgate_read_operand(&text, &element, &lanes) || element != s.element || lanes != s.lanes) {
        return 0;
      }
    } while (*text == ',' && *++text != '\0');
  }
  if (text[0] != ')' || text[1] != '\0') return 0;
  if (s.arguments < 1 || s.arguments > 3) return 0;
  if (s.shape == ulpgate_shape_sign && (s.arguments != 1 || s.integer != 0 || s.lanes != 1)) return 0;
  if (s.shape == ulpgate_shape_arrays && s.arguments > 2) return 0;
  if (s.integer != 0 && (s.arguments != 2 || s.lanes != 1)) return 0;
  if (s.lanes != 1) {
    const int bits = s.lanes * (s.element == 'f' ? 32 : 64);
    if (s.element != 'f' && s.element != 'd') return 0;
    if (bits != 128 && bits != 256 && bits != 512) return 0;
  }
  *out = s;
  return 1;
}

/* NOLINTEND(readability-identifier-naming) */

#endif
