// Gives the files of a folder to a fuzz target, one after the other, each also cut short and with
// one byte changed: the corpus as an ordinary test, with any compiler.
//   replay FOLDER
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/target.h"

namespace {

void run(const std::string& bytes) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: %s FOLDER\n", argv[0]);
    return 2;
  }
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(argv[1])) files.push_back(entry);
  std::sort(files.begin(), files.end());
  for (const auto& path : files) {
    std::ifstream in(path, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    std::printf("%s: %zu bytes\n", path.filename().c_str(), bytes.size());
    std::fflush(stdout);  // the one that fails is the last one named
    run(bytes);
    constexpr size_t variations = 16;
    for (size_t i = 0; i < variations; ++i) {
      const size_t at = bytes.size() * i / variations;
      run(bytes.substr(0, at));
      std::string changed = bytes;
      if (at < changed.size()) changed[at] = static_cast<char>(changed[at] ^ (1 << i % 8));
      run(changed);
    }
  }
  if (files.empty()) std::fprintf(stderr, "%s: no files\n", argv[1]);
  return files.empty() ? 1 : 0;
}
