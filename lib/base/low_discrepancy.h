// Points that fill the unit cube of four dimensions evenly however many of them are taken: Sobol's
// sequence, each key its own copy scrambled as Owen does, by hashing the bits in front of each
// (Owen, "Monte Carlo variance of scrambled net quadrature", 1997; Burley, "Practical hash-based
// Owen scrambling", JCGT 2020). Integer arithmetic, so that the bits are the same everywhere.
// Floor 1 (base).
#pragma once

#include <cstdint>

#include "base/hash.h"

namespace hrad {

constexpr uint32_t reversed_bits(uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0xff00ff00u) >> 8) | ((x & 0x00ff00ffu) << 8);
  x = ((x & 0xf0f0f0f0u) >> 4) | ((x & 0x0f0f0f0fu) << 4);
  x = ((x & 0xccccccccu) >> 2) | ((x & 0x33333333u) << 2);
  return ((x & 0xaaaaaaaau) >> 1) | ((x & 0x55555555u) << 1);
}

// A permutation of the numbers of 32 bits that keeps the tree of their upper bits: every bit is
// turned over or not as the bits above it and the seed say. It is handed the number in reversed
// bits, in which products with even factors carry only from higher places to lower ones.
inline uint32_t owen_scrambled(uint32_t x, uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return reversed_bits(x);
}

// Sobol's second to fourth dimension: for each byte of a point's number the bits it turns over, of
// reversed bits. The first dimension is the number itself.
struct SobolTables {
  uint32_t of[3][4][256];
  constexpr SobolTables() : of() {
    // Direction numbers of Joe and Kuo (2008), one per bit of the number.
    constexpr int degree[3] = {1, 2, 3};
    constexpr uint32_t inner[3] = {0, 1, 1};
    constexpr uint32_t first[3][3] = {{1, 0, 0}, {1, 3, 0}, {1, 3, 1}};
    for (int d = 0; d < 3; ++d) {
      uint32_t direction[32] = {};
      const int s = degree[d];
      for (int i = 0; i < 32; ++i) {
        direction[i] = i < s ? first[d][i] << (31 - i) : direction[i - s] ^ (direction[i - s] >> s);
        for (int j = 1; j < s && i >= s; ++j)
          if (inner[d] >> (s - 1 - j) & 1) direction[i] ^= direction[i - j];
      }
      for (int byte = 0; byte < 4; ++byte)
        for (uint32_t value = 1; value < 256; ++value) {
          int bit = 0;
          while (!(value >> bit & 1)) ++bit;
          of[d][byte][value] =
              of[d][byte][value & (value - 1)] ^ reversed_bits(direction[8 * byte + bit]);
        }
    }
  }
};
inline constexpr SobolTables sobol_tables;

// The sequence of a key, for who wants many of its points.
class LowDiscrepancy {
 public:
  explicit LowDiscrepancy(uint64_t key) : block_(static_cast<uint32_t>(mix(key, 4))) {
    for (int d = 0; d < 4; ++d)
      seed_[d] = static_cast<uint32_t>(mix(key, static_cast<uint64_t>(d)) >> 32);
  }

  void point(uint32_t k, double point[4]) const {
    // From a block of the sequence that the key picks, in an order of its own: parts of it are as
    // good as its beginning.
    const uint32_t index = owen_scrambled(reversed_bits(k), block_);
    uint32_t x[4] = {index, 0, 0, 0};
    for (int d = 0; d < 3; ++d)
      for (int byte = 0; byte < 4; ++byte)
        x[d + 1] ^= sobol_tables.of[d][byte][index >> (8 * byte) & 255];
    for (int d = 0; d < 4; ++d)
      point[d] = (owen_scrambled(x[d], seed_[d]) + 0.5) * (1.0 / 4294967296.0);
  }

 private:
  uint32_t block_, seed_[4];
};

// Point k of the sequence of this key.
inline void low_discrepancy_point(uint64_t key, uint32_t k, double point[4]) {
  LowDiscrepancy(key).point(k, point);
}

}  // namespace hrad
