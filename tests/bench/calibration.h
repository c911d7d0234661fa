// A yardstick for times: a loop whose work never changes, half arithmetic, half waiting for memory,
// run beside what is measured. Times as multiples of it compare between machines and between hours
// of a machine that does other work.
#pragma once

#include <sys/mman.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>

#include "bench/user_time.h"

namespace bench {

// Eight independent chains of multiplications, additions, divisions and square roots.
inline double calibration_arithmetic() {
  constexpr int rounds = 3000000, chains = 8;
  double x[chains], sum = 0;
  for (int k = 0; k < chains; ++k) x[k] = 0.1 + 0.1 * k;
  for (int round = 0; round < rounds; ++round)
    for (double& value : x) value = 2 * value / (1 + value * value) + 0.25 * std::sqrt(value);
  for (double value : x) sum += value;
  return sum;
}

// Loads that wait for one another, all over the table.
inline uint32_t calibration_loads(uint32_t* table, uint32_t size) {
  constexpr int steps = 1000000;
  // Successors by a full-period generator modulo a power of two, with bits mixed on both ends of
  // the step: one cycle through the whole table without an order that could be foreseen.
  const auto mixed = [size](uint32_t k) {
    k ^= k >> 11;
    k = (k * 0x9e3779b1u) & (size - 1);
    return k ^ (k >> 11);
  };
  for (uint32_t k = 0; k < size; ++k)
    table[mixed(k)] = mixed((k * 0x2c9277b5u + 0x3619636bu) & (size - 1));
  uint32_t at = 0;
  for (int step = 0; step < steps; ++step) at = table[at];
  return at;
}

// User CPU of one run. The table is mapped and unmapped, so that it leaves no trace in the memory
// of what is measured afterwards.
inline double calibration_seconds() {
  constexpr uint32_t size = 1u << 22;
  constexpr size_t bytes = size * sizeof(uint32_t);
  void* table = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (table == MAP_FAILED) throw std::runtime_error("no memory for the calibration loop");
  const double start = user_seconds();
  // Written where the compiler must believe that somebody reads it.
  volatile double result = calibration_arithmetic();
  result = result + calibration_loads(static_cast<uint32_t*>(table), size);
  const double seconds = user_seconds() - start;
  munmap(table, bytes);
  return seconds;
}

}  // namespace bench
