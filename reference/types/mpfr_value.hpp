// Owners of MPFR, MPC and GMP numbers, and the wide exponent range that references are computed in.
#pragma once

#include <gmp.h>
#include <mpc.h>
#include <mpfr.h>

namespace ulpgate {

// Owns one mpfr_t.  Not copyable: copies between precisions round, so they are written out where they happen.
class MpfrValue {
 public:
  explicit MpfrValue(mpfr_prec_t bits = 64) { mpfr_init2(value_, bits); }
  MpfrValue(MpfrValue&& other) noexcept {
    mpfr_init2(value_, MPFR_PREC_MIN);
    mpfr_swap(value_, other.value_);
  }
  MpfrValue& operator=(MpfrValue&& other) noexcept {
    mpfr_swap(value_, other.value_);
    return *this;
  }
  MpfrValue(const MpfrValue&) = delete;
  MpfrValue& operator=(const MpfrValue&) = delete;
  ~MpfrValue() { mpfr_clear(value_); }

  [[nodiscard]] mpfr_ptr get() { return value_; }
  [[nodiscard]] mpfr_srcptr get() const { return value_; }
  // NOLINTNEXTLINE(google-explicit-constructor): stands wherever the C library wants its pointer
  operator mpfr_ptr() { return value_; }
  // NOLINTNEXTLINE(google-explicit-constructor)
  operator mpfr_srcptr() const { return value_; }

 private:
  mpfr_t value_;
};

// Owns one mpz_t.
class MpzValue {
 public:
  MpzValue() { mpz_init(value_); }
  MpzValue(const MpzValue&) = delete;
  MpzValue& operator=(const MpzValue&) = delete;
  ~MpzValue() { mpz_clear(value_); }
  // NOLINTNEXTLINE(google-explicit-constructor)
  operator mpz_ptr() { return value_; }

 private:
  mpz_t value_;
};

// Owns one mpc_t with equal precisions of both parts.
class MpcValue {
 public:
  explicit MpcValue(mpfr_prec_t bits = 64) { mpc_init2(value_, bits); }
  MpcValue(const MpcValue&) = delete;
  MpcValue& operator=(const MpcValue&) = delete;
  ~MpcValue() { mpc_clear(value_); }
  // NOLINTNEXTLINE(google-explicit-constructor)
  operator mpc_ptr() { return value_; }

 private:
  mpc_t value_;
};

// While alive, MPFR on this thread uses its widest exponent range: a reference must not over- or underflow
// where the type under test does.  The types under test themselves run in MPFR's default range.
class WideExponentRange {
 public:
  WideExponentRange() : emin_(mpfr_get_emin()), emax_(mpfr_get_emax()) {
    mpfr_set_emin(mpfr_get_emin_min());
    mpfr_set_emax(mpfr_get_emax_max());
  }
  WideExponentRange(const WideExponentRange&) = delete;
  WideExponentRange& operator=(const WideExponentRange&) = delete;
  ~WideExponentRange() {
    mpfr_set_emin(emin_);
    mpfr_set_emax(emax_);
  }

 private:
  mpfr_exp_t emin_;
  mpfr_exp_t emax_;
};

// Frees MPFR's caches of this thread when it goes out of scope; one stands at the top of every thread.
struct MpfrThread {
  MpfrThread() = default;
  MpfrThread(const MpfrThread&) = delete;
  MpfrThread& operator=(const MpfrThread&) = delete;
  ~MpfrThread() { mpfr_free_cache(); }
};

}  // namespace ulpgate
