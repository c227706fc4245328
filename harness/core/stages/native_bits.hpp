// Bits of native IEEE numbers: exponent, leading fraction and parity, without a call to the C library.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <limits>

#include "reference/multi_word/double_double.hpp"
#include "reference/native/native_functions.hpp"

namespace ulpgate {

// The binary formats that a native stage reads; long double where it is x87's, with its explicit leading bit.
template <class T>
concept NativeBits = std::same_as<T, float> || std::same_as<T, double> ||
                     (std::same_as<T, long double>&& std::numeric_limits<long double>::digits == 64)
#ifdef ULPGATE_HAVE_FLOAT128
                     || std::same_as<T, Binary128>
#endif
                     || std::same_as<T, DoubleDouble>;

struct NumberBits {
  int exponent;            // of the binade, where the number is normal
  bool normal;             // neither zero nor subnormal, infinite or NaN
  bool odd;                // last bit of the significand
  std::uint32_t fraction;  // first 32 bits after the leading one, zeros behind a shorter significand
};

template <NativeBits T>
[[nodiscard]] inline NumberBits bits_of(T x) {
  if constexpr (std::same_as<T, float>) {
    const auto u = std::bit_cast<std::uint32_t>(x);
    const int e = static_cast<int>((u >> 23U) & 0xffU);
    return {e - 127, e != 0 && e != 0xff, (u & 1U) != 0, u << 9U};
  } else if constexpr (std::same_as<T, double>) {
    const auto u = std::bit_cast<std::uint64_t>(x);
    const int e = static_cast<int>((u >> 52U) & 0x7ffU);
    return {e - 1023, e != 0 && e != 0x7ff, (u & 1U) != 0, static_cast<std::uint32_t>(u >> 20U)};
  } else if constexpr (std::same_as<T, long double>) {
    std::uint64_t significand = 0;
    std::uint16_t head = 0;
    std::memcpy(&significand, &x, sizeof significand);
    std::memcpy(&head, reinterpret_cast<const char*>(&x) + sizeof significand, sizeof head);
    const int e = head & 0x7fff;
    return {e - 16383, e != 0 && e != 0x7fff, (significand & 1U) != 0,
            static_cast<std::uint32_t>(significand >> 31U)};
  } else if constexpr (std::same_as<T, DoubleDouble>) {
    // Below hi, where lo is of the other sign, lies the number before it: of a power of two that of another
    // binade.
    const bool below = x.lo != 0 && (x.lo < 0) != (x.hi < 0);
    const auto u = std::bit_cast<std::uint64_t>(x.hi) - (below ? 1U : 0U);
    const int e = static_cast<int>((u >> 52U) & 0x7ffU);
    return {e - 1023, e != 0 && e != 0x7ff, false, static_cast<std::uint32_t>(u >> 20U)};
  } else {
    const auto u = std::bit_cast<unsigned __int128>(x);
    const auto high = static_cast<std::uint64_t>(u >> 64U);
    const int e = static_cast<int>((high >> 48U) & 0x7fffU);
    return {e - 16383, e != 0 && e != 0x7fff, (u & 1U) != 0, static_cast<std::uint32_t>(high >> 16U)};
  }
}

template <NativeBits T>
inline constexpr int significand_bits = std::numeric_limits<T>::digits;
#ifdef ULPGATE_HAVE_FLOAT128
template <>
inline constexpr int significand_bits<Binary128> = 113;
#endif
template <>
inline constexpr int significand_bits<DoubleDouble> = double_double_bits;

// 2^e for exponents of normal doubles.
[[nodiscard]] constexpr double power_of_two(int e) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52U);
}

}  // namespace ulpgate
