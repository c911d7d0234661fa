// The entry of a fuzz target, as libFuzzer calls it; replay.cpp calls it without libFuzzer.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
