// Scenes whose solution is known in closed form: furnaces, a box in a box, parallel plates.
// Floor 3 (scene).
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "scene/generate.h"
#include "scene/generate_materials.h"
#include "scene/generate_solids.h"

namespace hrad {
namespace {

int32_t add_furnace_material(Scene& scene) {
  return add_rgb_material(scene, "furnace", {.5, .5, .5}, {1, 1, 1});
}

int32_t add_black_emitter(Scene& scene) {
  return add_rgb_material(scene, "emitter", {0, 0, 0}, {1, 1, 1});
}

int32_t add_black_receiver(Scene& scene) { return add_rgb_material(scene, "receiver", {}); }

// A sphere of radius 1 from an icosahedron: each level cuts a triangle into four at the midpoints
// of its edges, pushed out onto the sphere. Corners anticlockwise seen from outside.
struct Icosphere {
  std::vector<Vec3> vertices;
  std::vector<std::array<int32_t, 3>> triangles;

  explicit Icosphere(int levels) {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    for (int axis = 0; axis < 3; ++axis) {
      for (const double one : {-1.0, 1.0}) {
        for (const double other : {-golden, golden}) {
          const std::array<double, 3> p{0, one, other};
          // A cyclic shift of the coordinates keeps the solid's handedness.
          vertices.push_back(normalized({p[(3 - axis) % 3], p[(4 - axis) % 3], p[(5 - axis) % 3]}));
        }
      }
    }
    add_icosahedron_faces();
    for (int level = 0; level < levels; ++level) refine();
  }

 private:
  // Its faces are the triples of corners at edge distance from each other.
  void add_icosahedron_faces() {
    const auto neighbours = [&](int32_t a, int32_t b) {
      return dot(vertices[a], vertices[b]) > 0.4;  // 0.447 along an edge, else -0.447 or -1
    };
    for (int32_t a = 0; a < 12; ++a) {
      for (int32_t b = a + 1; b < 12; ++b) {
        for (int32_t c = b + 1; c < 12; ++c) {
          if (!neighbours(a, b) || !neighbours(b, c) || !neighbours(a, c)) continue;
          const Triangle t{vertices[a], vertices[b], vertices[c]};
          if (dot(t.area_vector(), t.a) > 0)
            triangles.push_back({a, b, c});
          else
            triangles.push_back({a, c, b});
        }
      }
    }
  }

  void refine() {
    std::map<std::pair<int32_t, int32_t>, int32_t> middle_of;
    const auto middle = [&](int32_t a, int32_t b) {
      const auto [found, is_new] = middle_of.try_emplace(std::minmax(a, b), 0);
      if (is_new) {
        found->second = static_cast<int32_t>(vertices.size());
        vertices.push_back(normalized(vertices[a] + vertices[b]));
      }
      return found->second;
    };
    std::vector<std::array<int32_t, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.push_back({a, ab, ca});
      finer.push_back({b, bc, ab});
      finer.push_back({c, ca, bc});
      finer.push_back({ab, bc, ca});
    }
    triangles = std::move(finer);
  }
};

// A unit square at height z, its front up or down.
void add_unit_square(Scene& scene, double z, bool up, int32_t material) {
  const int32_t a = scene.add_vertex({0, 0, z}), b = scene.add_vertex({1, 0, z});
  const int32_t c = scene.add_vertex({1, 1, z}), d = scene.add_vertex({0, 1, z});
  if (up) {
    scene.add_patch(a, b, c, material);
    scene.add_patch(a, c, d, material);
  } else {
    scene.add_patch(a, c, b, material);
    scene.add_patch(a, d, c, material);
  }
}

}  // namespace

void generate_furnace(Scene& scene, int) {
  const int32_t material = add_furnace_material(scene);
  add_room(scene, {0, 0, 0}, {1000, 1000, 1000}, all_faces(material));
}

void generate_furnace_sphere(Scene& scene, int) {
  constexpr int levels = 3;  // 1,280 triangles
  const int32_t material = add_furnace_material(scene);
  const Icosphere sphere(levels);
  for (const Vec3& v : sphere.vertices) scene.add_vertex(v);
  for (const auto& [a, b, c] : sphere.triangles) scene.add_patch(a, c, b, material);
}

void generate_furnace_boxes(Scene& scene, int) {
  const int32_t material = add_furnace_material(scene);
  const BoxMaterials faces = all_faces(material);
  add_room(scene, {0, 0, 0}, {4000, 3000, 2500}, faces);
  add_box(scene, {500, 500, 0}, {1300, 1200, 900}, faces);
  add_box(scene, {2000, 1700, 0}, {2600, 2400, 1500}, faces);
  add_box(scene, {2900, 400, 0}, {3500, 1000, 400}, faces);
  // One that stands on another.
  add_box(scene, {600, 700, 900}, {1000, 1100, 1200}, faces);
}

void generate_box_in_box(Scene& scene, int) {
  const int32_t emitter = add_black_emitter(scene), receiver = add_black_receiver(scene);
  add_box(scene, {1000, 1000, 1000}, {2000, 2000, 2000}, all_faces(emitter));
  add_room(scene, {0, 0, 0}, {3000, 3000, 3000}, all_faces(receiver));
}

void generate_parallel_plates(Scene& scene, int) {
  const int32_t emitter = add_black_emitter(scene), receiver = add_black_receiver(scene);
  add_unit_square(scene, 0, true, emitter);
  add_unit_square(scene, 1, false, receiver);
}

}  // namespace hrad
