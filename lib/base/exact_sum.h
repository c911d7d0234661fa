// Sums of doubles that come out the same in any order: one integer as wide as all doubles, in parts
// that carry when the sum is asked for (Kulisch's accumulator). Floor 1 (base).
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace hrad {

// Not for more than 2^31 numbers.
class ExactSum {
 public:
  // 32 bits of the sum each, the last one with its sign, and how many numbers were not finite.
  // Those of two sums may be added up one by one, modulo 2^64.
  static constexpr size_t places = 67;
  using Digits = std::array<uint64_t, places + 1>;

  ExactSum() = default;
  explicit ExactSum(const Digits& digits) : not_finite_(digits[places]) {
    for (size_t k = 0; k < places; ++k) part_[k] = static_cast<int64_t>(digits[k]);
  }

  void add(double value) {
    uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    const uint64_t exponent = bits >> 52 & 0x7ff, fraction = bits & ((uint64_t{1} << 52) - 1);
    if (exponent == 0x7ff) {
      ++not_finite_;
      return;
    }
    // value = mantissa 2^(place - 1074)
    const uint64_t mantissa = exponent > 0 ? fraction | uint64_t{1} << 52 : fraction;
    const uint64_t place = exponent > 0 ? exponent - 1 : 0;
    const Wide wide = static_cast<Wide>(mantissa) << place % 32;
    part_[place / 32] += bits >> 63 ? -wide : wide;
  }
  void add(const ExactSum& other) {
    for (size_t k = 0; k < places; ++k) part_[k] += other.part_[k];
    not_finite_ += other.not_finite_;
  }
  // Nearly the nearest double; what is not finite makes the sum infinite.
  double value() const {
    if (not_finite_ > 0) return std::numeric_limits<double>::infinity();
    Digits digits = carried(1);
    const bool negative = static_cast<int64_t>(digits[places - 1]) < 0;
    if (negative) digits = carried(-1);
    double sum = 0;
    for (size_t k = places; k-- > 0;)
      sum += std::ldexp(static_cast<double>(digits[k]), static_cast<int>(32 * k) - 1074);
    return negative ? -sum : sum;
  }
  Digits digits() const { return carried(1); }

 private:
  __extension__ using Wide = __int128;

  // The sum times sign.
  Digits carried(int sign) const {
    Digits digits;
    Wide carry = 0;
    for (size_t k = 0; k < places; ++k) {
      carry += sign * part_[k];
      const bool last = k + 1 == places;
      digits[k] = static_cast<uint64_t>(last ? carry : carry & 0xffffffff);
      carry >>= 32;
    }
    digits[places] = not_finite_;
    return digits;
  }

  Wide part_[places] = {};
  uint64_t not_finite_ = 0;
};

}  // namespace hrad
