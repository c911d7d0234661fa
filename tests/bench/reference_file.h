// The cache of references: one binary file per scene content, number of points and seed. A file
// holds this machine's own structures; one that doesn't fit exactly is not used.
#pragma once

#include <cstdio>
#include <stdexcept>
#include <string>

#include "bench/reference.h"

namespace bench {

struct Reference {
  TargetSet sides, points;
  bool usable() const { return sides.passes > 0 && points.passes > 0; }
};

// Where a scene's reference lies and what it depends on besides the scene.
struct ReferencePlace {
  std::string folder, scene;
  int64_t points = 0, sides = 0;
  uint64_t seed = 0;

  uint64_t key(const std::vector<Surface>& surfaces) const {
    uint64_t key = Random::mixed(seed + 5);
    const auto add = [&](double value) {
      uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      key = Random::mixed(key ^ bits) + 1;
    };
    int64_t dark_sides = 0;
    for (const Surface& s : surfaces) {
      dark_sides += s.emits() ? 0 : s.sides();
      for (const Vector& p : {s.a, s.b, s.c}) add(p.x), add(p.y), add(p.z);
      for (double v : s.reflectance.value) add(v);
      for (double v : s.emission.value) add(v);
      add(s.area), add(s.two_sided), add(s.blocker);
    }
    add(static_cast<double>(points));
    add(static_cast<double>(sides < dark_sides ? sides : 0));  // 0: all
    return key;
  }
  std::string path(uint64_t key) const {
    const size_t slash = scene.find_last_of('/');
    char ending[64];
    std::snprintf(ending, sizeof ending, "-%lld-%016llx.ref", static_cast<long long>(points),
                  static_cast<unsigned long long>(key));
    return folder + "/" + scene.substr(slash == std::string::npos ? 0 : slash + 1) + ending;
  }
};

struct ReferenceHeader {
  char magic[8] = {'h', 'r', 'a', 'd', 'r', 'e', 'f', '1'};
  uint64_t key = 0, target_size = sizeof(Target), paths = kPathsPerReplicate;
  uint64_t counts[2] = {}, passes[2] = {}, is_sample[2] = {};
  double seconds[2] = {};
};

// False when there is no file, or one for something else.
inline bool read_reference(const std::string& path, uint64_t key, Reference& reference) {
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return false;
  const ReferenceHeader expected;
  ReferenceHeader h;
  Reference found;
  bool good = std::fread(&h, sizeof h, 1, file) == 1 &&
              std::memcmp(h.magic, expected.magic, sizeof h.magic) == 0 && h.key == key &&
              h.target_size == expected.target_size && h.paths == expected.paths;
  TargetSet* sets[2] = {&found.sides, &found.points};
  for (int i = 0; i < 2 && good; ++i) {
    good = h.counts[i] < (1u << 28);
    if (!good) break;
    sets[i]->targets.resize(h.counts[i]);
    sets[i]->passes = static_cast<int64_t>(h.passes[i]);
    sets[i]->is_sample = static_cast<int64_t>(h.is_sample[i]);
    sets[i]->seconds = h.seconds[i];
    good = std::fread(sets[i]->targets.data(), sizeof(Target), h.counts[i], file) == h.counts[i];
  }
  good = good && std::fgetc(file) == EOF;
  std::fclose(file);
  if (good) reference = std::move(found);
  return good;
}

inline void write_reference(const std::string& path, uint64_t key, const Reference& reference) {
  ReferenceHeader h;
  h.key = key;
  const TargetSet* sets[2] = {&reference.sides, &reference.points};
  for (int i = 0; i < 2; ++i) {
    h.counts[i] = sets[i]->targets.size();
    h.passes[i] = static_cast<uint64_t>(sets[i]->passes);
    h.is_sample[i] = static_cast<uint64_t>(sets[i]->is_sample);
    h.seconds[i] = sets[i]->seconds;
  }
  const std::string part = path + ".part";
  std::FILE* file = std::fopen(part.c_str(), "wb");
  bool good = file != nullptr && std::fwrite(&h, sizeof h, 1, file) == 1;
  for (int i = 0; i < 2 && good; ++i)
    good = std::fwrite(sets[i]->targets.data(), sizeof(Target), h.counts[i], file) == h.counts[i];
  if (file != nullptr) good = std::fclose(file) == 0 && good;
  if (!good || std::rename(part.c_str(), path.c_str()) != 0)
    throw std::runtime_error(path + ": can't be written");
}

}  // namespace bench
