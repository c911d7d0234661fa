// Files whose frame and checksums are right and one value of which can't be: each is refused, and
// the message names the section and the value.
#include <algorithm>
#include <limits>
#include <vector>

#include "solver/checkpoint_runs.h"
#include "solver/checkpoint_scene.h"
#include "solver/wrong_values.h"

using hrad::Link;
using hrad::NodeId;
using hrad::Scene;
using namespace hrad_test;

namespace {

Frame with_materials(const Good& good, const Scene& scene) {
  PackedBytes bytes;
  hrad::pack_materials(scene, bytes);
  return with(good, Section::materials, bytes);
}
Frame with_vertices(const Good& good, const Scene& scene) {
  PackedBytes bytes;
  hrad::pack_vertices(scene, 0, static_cast<int64_t>(scene.vertices.size()), bytes);
  return with(good, Section::vertices, bytes);
}
Frame with_patches(const Good& good, const Scene& scene) {
  PackedBytes bytes;
  hrad::pack_patches(scene, 0, scene.patch_count(), bytes);
  return with(good, Section::patches, bytes);
}

const Good& rows() {
  static const Good good({"cornell", "rows", "error", 0.3});
  return good;
}

const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const double infinite = std::numeric_limits<double>::infinity();

// Packed as they were, so that what is refused below is the value alone.
void the_file_is_made_again_the_same() {
  const Good& good = rows();
  const std::string file = file_of(good.frame);
  CHECK(file_of(with_materials(good, good.scene)) == file);
  CHECK(file_of(with_vertices(good, good.scene)) == file);
  CHECK(file_of(with_patches(good, good.scene)) == file);
}

void materials_that_give_back_all_are_refused() {
  for (double value : {1.0, 1.5, -0.25, infinite, not_a_number}) {
    Scene scene = rows().scene;
    scene.materials.back().reflectance[2] = value;
    refuses(with_materials(rows(), scene), Section::materials, "a reflectance is ");
  }
  for (double value : {-1.0, infinite, not_a_number}) {
    Scene scene = rows().scene;
    scene.materials.back().emission[0] = value;
    refuses(with_materials(rows(), scene), Section::materials, "an emission is ");
  }
}

void patches_that_give_back_all_are_refused() {
  for (double value : {1.0, 1.5, -0.25, infinite, not_a_number}) {
    Scene scene = rows().scene;
    scene.reflectance[4] = value;
    refuses(with_patches(rows(), scene), Section::patches, "a reflectance is ");
  }
  Scene scene = rows().scene;
  scene.emission[4] = -1;
  refuses(with_patches(rows(), scene), Section::patches, "an emission is ");
}

void vertices_that_are_nowhere_are_refused() {
  for (double value : {not_a_number, infinite, -infinite, 1e31}) {
    Scene scene = rows().scene;
    scene.vertices[1].y = value;
    refuses(with_vertices(rows(), scene), Section::vertices, "a vertex has the coordinate ");
  }
}

// One beyond the last one, and one before the first.
void patches_of_no_vertex_or_material_are_refused() {
  const auto vertices = static_cast<int32_t>(rows().scene.vertices.size());
  for (int32_t vertex : {vertices, -1}) {
    Scene scene = rows().scene;
    scene.corners[3][1] = vertex;
    refuses(with_patches(rows(), scene), Section::patches, "a patch's vertex");
  }
  // In the scene that is packed there is one more; not in the file.
  Scene scene = rows().scene;
  const auto materials = static_cast<int32_t>(scene.materials.size());
  scene.materials.push_back(scene.materials[static_cast<size_t>(scene.material[3])]);
  scene.material[3] = materials;
  refuses(with_patches(rows(), scene), Section::patches, "a patch's material");
}

// The last link of the first run of a section comes from the first node beyond those that it may.
Frame with_a_link_from(int64_t node, const Good& good, Section section, int64_t receivers) {
  Frame frame = good.frame;
  std::string& raw = section_of(frame, section)[0].raw;
  PackedReader bytes = reader_of(raw);
  const int64_t end = std::min(receivers, hrad::items_of_run(section));
  std::vector<std::vector<Link>> links;
  int64_t left = std::numeric_limits<int32_t>::max();
  hrad::unpack_runs(
      0, end, static_cast<NodeId>(good.nodes), left, bytes,
      [&](hrad::Span<const Link> run) { links.emplace_back(run.begin(), run.end()); });
  const auto repacked = [&] {
    PackedBytes packed;
    hrad::pack_runs(
        0, end,
        [&](int64_t k) -> hrad::Span<const Link> {
          const auto& run = links[static_cast<size_t>(k)];
          return {run.data(), run.size()};
        },
        packed);
    return packed.bytes();
  };
  CHECK(repacked() == raw);
  for (size_t k = links.size(); k-- > 0;)
    if (links[k].size() > 1) {
      links[k].back().source = static_cast<NodeId>(node);
      raw = repacked();
      return frame;
    }
  failed(__FILE__, __LINE__, "no run with two links");
}

// Of shares of rays and of other weights, which are packed in different ways.
void links_from_no_node_are_refused() {
  const Good pairs({"cornell", "pairs", "error", 0.5});
  for (const Good* good : {&rows(), &pairs})
    refuses(with_a_link_from(good->nodes, *good, Section::links, good->nodes), Section::links,
            "the source of a link is ");
  const Good& good = rows();
  refuses(with_a_link_from(good.emitters, good, Section::mean_light, good.nodes),
          Section::mean_light, "the source of a link is ");
  refuses(with_a_link_from(good.emitters, good, Section::point_links, good.points),
          Section::point_links, "the source of a link is ");
}

// The first leaf's first point is number 0, the second one so far away that its number overflows.
void points_of_no_number_are_refused() {
  PackedBytes bytes;
  bytes.byte(1);
  bytes.varint(0);
  bytes.varint(~uint64_t{0} - 1);
  refuses(with(rows(), Section::points, bytes), Section::points, "a point of leaf ");
}

// The last point of all can't be the first of three.
void own_points_of_no_leaf_are_refused() {
  PackedBytes bytes;
  bytes.signed_varint(rows().points - 1);
  for (int64_t k = 0; k < 9 * rows().points; ++k) bytes.byte(0);  // as long as it has to be
  refuses(with(rows(), Section::own_points, bytes), Section::own_points, "own point 0 is ");
}

// A stream shorter than a 64th of what it holds is followed by zeros, and by nothing else.
void a_run_is_filled_up_with_zeros_alone() {
  Scene scene = rows().scene;
  scene.diagnostics.push_back(std::string(size_t{1} << 17, ' '));
  Frame frame = with_materials(rows(), scene);
  Good::check_accepted(frame);
  FrameRun& run = section_of(frame, Section::materials)[0];
  const std::string stored = hrad::compressed(run.raw);
  CHECK(stored.size() == run.raw.size() / 64 + (run.raw.size() % 64 != 0));
  CHECK(stored.substr(stored.size() - 9) == std::string(9, '\0'));
  run.stated_raw = static_cast<uint32_t>(run.raw.size());
  run.stored = stored;
  Good::check_accepted(frame);
  for (size_t back : {1, 9}) {
    run.stored = stored;
    run.stored[stored.size() - back] = '\1';
    refuses(frame, Section::materials, "ends with what doesn't belong to it");
  }
  run.stored = stored + '\0';
  refuses(frame, Section::materials, "ends with what doesn't belong to it");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(the_file_is_made_again_the_same),
                              HRAD_TEST(materials_that_give_back_all_are_refused),
                              HRAD_TEST(patches_that_give_back_all_are_refused),
                              HRAD_TEST(vertices_that_are_nowhere_are_refused),
                              HRAD_TEST(patches_of_no_vertex_or_material_are_refused),
                              HRAD_TEST(links_from_no_node_are_refused),
                              HRAD_TEST(points_of_no_number_are_refused),
                              HRAD_TEST(own_points_of_no_leaf_are_refused),
                              HRAD_TEST(a_run_is_filled_up_with_zeros_alone)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
