// Hashing of bytes and of keys: sample points, content and state hashes are made of these. Plain
// integer arithmetic, so that the bits are the same everywhere. Floor 1 (base).
#pragma once

#include <cstdint>
#include <cstring>

namespace hrad {

// The finaliser of splitmix64 (Steele, Lea, Flood, OOPSLA 2014): every input bit reaches every
// output bit.
inline uint64_t mix(uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}
inline uint64_t mix(uint64_t a, uint64_t b) { return mix(mix(a) ^ b); }
inline uint64_t mix(uint64_t a, uint64_t b, uint64_t c) { return mix(mix(a, b) ^ c); }

// The upper bits of a hash as a number in [0,1).
inline double unit_interval(uint64_t hash) {
  return static_cast<double>(hash >> 11) * (1.0 / 9007199254740992.0);
}

// Hash of a sequence of values, in order.
class Hasher {
 public:
  void add(uint64_t value) { state_ = mix(state_ ^ value) + 0x2545f4914f6cdd1du * ++count_; }
  void add(double value) {
    uint64_t bits;
    if (value == 0) value = 0;  // -0 and +0 are one value
    std::memcpy(&bits, &value, sizeof bits);
    add(bits);
  }
  void add(float value) { add(static_cast<double>(value)); }
  void add(const char* text) {
    for (; *text; ++text) add(static_cast<uint64_t>(static_cast<unsigned char>(*text)));
    add(uint64_t{0x100});
  }
  uint64_t value() const { return mix(state_, count_); }

 private:
  uint64_t state_ = 0x6a09e667f3bcc908u;
  uint64_t count_ = 0;
};

}  // namespace hrad
