// Numbers as bytes of a file, the lowest byte first on every processor. Floor 1 (base).
#pragma once

#include <cstring>
#include <iterator>
#include <string>

namespace hrad {

template <class Number>
void put_little_endian(std::string& bytes, Number value) {
  char raw[sizeof value];
  std::memcpy(raw, &value, sizeof value);
#if defined(__BYTE_ORDER__) && __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__
  bytes.append(std::reverse_iterator<char*>(raw + sizeof raw), std::reverse_iterator<char*>(raw));
#else
  bytes.append(raw, sizeof raw);
#endif
}

}  // namespace hrad
