// Speed of the ray engines: CPU time of one thread for packets of one link, for unrelated packets
// and for single rays, every engine in turn, several times; medians and their ratio to Embree's.
// Embree is told that packets are coherent, as those of links are and as the seam promises: that is
// its best for links, but for unrelated packets it would be three times faster told otherwise.
// Scenes are built in; OBJ files may be named as arguments.
#include <time.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>

#include "base/error.h"
#include "scene/load.h"
#include "visibility/brute_force.h"

using namespace hrad;
using namespace hrad_test;

namespace {

double cpu_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Workload {
  const char* name;
  std::vector<SegmentPacket> packets;
  bool single = false;  // nearest hits of the segments' rays instead
};

// Pairs of triangles that see each other's fronts, all equally probable.
Workload links(const Scene& scene, const VisibilityEngine& engine, int64_t count) {
  Workload work{"packets of a link", {}};
  Random random(1);
  while (static_cast<int64_t>(work.packets.size()) < count) {
    const int64_t p = random.below(scene.patch_count()), q = random.below(scene.patch_count());
    const Triangle a = scene.triangle(p), b = scene.triangle(q);
    const Vec3 d = b.centroid() - a.centroid();
    if (dot(a.area_vector(), d) <= 0 || dot(b.area_vector(), d) >= 0) continue;
    work.packets.push_back(packet_between(a, b, engine.offset(), engine.center(), random));
  }
  return work;
}

Workload loose(const Scene& scene, const VisibilityEngine& engine, int64_t count, bool single) {
  Workload work{single ? "single nearest rays" : "unrelated packets", {}, single};
  Random random(2);
  const Box box = scene.bounds();
  for (int64_t i = 0; i < count; ++i) {
    SegmentPacket packet;
    for (int k = 0; k < 16; ++k) {
      const Triangle a = scene.triangle(random.below(scene.patch_count()));
      const Vec3 from = point_on(a, random);
      const Vec3 up = normalized(a.area_vector());
      Vec3 to{random.between(box.low.x, box.high.x), random.between(box.low.y, box.high.y),
              random.between(box.low.z, box.high.z)};
      if (dot(up, to - from) < 0) to = from + from - to;
      set_segment(packet, k, from + up * engine.offset(), to, engine.center());
    }
    work.packets.push_back(packet);
  }
  return work;
}

struct Result {
  double seconds = 0;
  int64_t rays = 0, hits = 0;
};

Result run(const VisibilityEngine& engine, const Workload& work) {
  Result result;
  const double start = cpu_seconds();
  for (const SegmentPacket& packet : work.packets) {
    // A solver has just made its packet: it lies in the cache.
    for (size_t i = 0; i < sizeof packet; i += 64)
      __builtin_prefetch(reinterpret_cast<const char*>(&packet + 1) + i);
    result.rays += 16;
    if (!work.single) {
      result.hits += __builtin_popcount(engine.blocked(packet));
      continue;
    }
    for (int i = 0; i < 16; ++i) {
      const Vec3 origin = packet_origin(packet, i, engine.center());
      result.hits += engine.nearest(origin, packet_direction(packet, i), 0).patch >= 0;
    }
  }
  result.seconds = cpu_seconds() - start;
  return result;
}

void compare(const std::string& name, const Scene& scene, double effort) {
  ThreadTeam team(1);
  std::vector<std::string> names;
  std::vector<std::unique_ptr<VisibilityEngine>> engines;
  for (const char* set : {"sse2", "avx2", "avx512", "embree"}) {
    const bool embree = std::strcmp(set, "embree") == 0;
    try {
      const double start = cpu_seconds();
      engines.push_back(
          make_visibility_engine(scene, embree ? set : "builtin", embree ? "auto" : set, team));
      names.push_back(embree ? "embree " + engines.back()->version()
                             : std::string("builtin ") + set);
      std::printf(
          "%s: %s built in %.3f s, %.1f bytes a triangle\n", name.c_str(), names.back().c_str(),
          cpu_seconds() - start,
          static_cast<double>(engines.back()->bytes()) / static_cast<double>(scene.patch_count()));
    } catch (const Error& e) {
      std::printf("%s: %s\n", name.c_str(), e.what());
    }
  }
  const int64_t count = static_cast<int64_t>(effort * 20000);
  const Workload works[] = {links(scene, *engines[0], count),
                            loose(scene, *engines[0], count / 4, false),
                            loose(scene, *engines[0], count / 8, true)};
  for (const Workload& work : works) {
    const int rounds = 7;
    std::vector<std::vector<double>> seconds(engines.size());
    std::vector<Result> last(engines.size());
    for (int round = 0; round < rounds; ++round) {
      for (size_t e = 0; e < engines.size(); ++e) {
        last[e] = run(*engines[e], work);
        seconds[e].push_back(last[e].seconds);
      }
    }
    std::printf("%s, %lld patches, %s\n", name.c_str(), static_cast<long long>(scene.patch_count()),
                work.name);
    for (auto& s : seconds) std::sort(s.begin(), s.end());
    const double reference = seconds.back()[rounds / 2];
    for (size_t e = 0; e < engines.size(); ++e) {
      const double median = seconds[e][rounds / 2];
      std::printf("  %-16s %7.2f Mrays/s   time %5.2f of %s's   %.4f hit\n", names[e].c_str(),
                  1e-6 * static_cast<double>(last[e].rays) / median, median / reference,
                  names.back().c_str(),
                  static_cast<double>(last[e].hits) / static_cast<double>(last[e].rays));
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    double effort = 1;
    std::vector<std::string> scenes;
    for (int i = 1; i < argc; ++i) {
      if (std::strcmp(argv[i], "--effort") == 0 && i + 1 < argc)
        effort = std::atof(argv[++i]);
      else
        scenes.push_back(argv[i]);
    }
    if (scenes.empty()) scenes = {"classroom", "building"};
    for (const std::string& name : scenes) {
      Scene scene;
      if (name == "boxes")
        scene = room_with_boxes(800, 1);
      else if (name == "soup")
        scene = random_soup(1000000, 0.01, 1);
      else if (name.find('.') != std::string::npos)
        load_obj(scene, name, Sides::front);
      else
        make_builtin_scene(scene, name);
      compare(name, scene, effort);
    }
  } catch (const Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
