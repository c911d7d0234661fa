// The meshes of .ply and .glb: vertices with the solver's own values, shared where leaves of a side
// meet, and the limits and places that a file knows.
#include <cstring>
#include <limits>
#include <set>
#include <tuple>

#include "base/error.h"
#include "export_room.h"
#include "solver/display_color.h"
#include "solver/export.h"
#include "solver/leaf_mesh.h"

namespace {

using namespace hrad;
using hrad_test::Folder;
using hrad_test::make_room;
using hrad_test::read_file;
using hrad_test::solved;
constexpr int bands = hrad_test::bands;

template <class Number>
Number number_at(const std::string& bytes, size_t at) {
  Number number;
  CHECK(at + sizeof number <= bytes.size());
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// ---- the mesh

void a_mesh_has_the_corners_of_the_leaves() {
  const LeafMesh mesh(solved(), "a.ply");
  CHECK_EQUAL(mesh.triangle_count(), solved().leaf_count());
  for (int64_t leaf = 0; leaf < solved().leaf_count(); ++leaf) {
    const LeafView view = solved().leaf(leaf);
    const Vec3 corners[] = {view.corners.a, view.corners.b, view.corners.c};
    const Vec3 normal = normalized(view.corners.area_vector());
    double radiosity[3 * bands];
    solved().leaf_corner_radiosity(leaf, radiosity);
    for (int c = 0; c < 3; ++c) {
      const MeshVertex vertex = mesh.vertex(mesh.triangle(leaf)[c]);
      CHECK_NEAR(length(vertex.position - corners[c]), 0, 1e-14);
      CHECK_NEAR(length(vertex.normal - normal), 0, 1e-12);
      for (int b = 0; b < bands; ++b) CHECK_EQUAL(vertex.radiosity[b], radiosity[c * bands + b]);
    }
  }
}

// Of one side of a patch no two vertices are the same, and all are used.
void vertices_are_shared() {
  const LeafMesh mesh(solved(), "a.ply");
  CHECK(mesh.vertex_count() < 2 * mesh.triangle_count());
  std::set<uint32_t> used;
  std::set<std::tuple<int64_t, int32_t, float, float, float>> places;
  for (int64_t leaf = 0; leaf < mesh.triangle_count(); ++leaf)
    for (const uint32_t number : mesh.triangle(leaf)) {
      if (!used.insert(number).second) continue;
      const Vec3 p = mesh.vertex(number).position;
      const LeafView view = solved().leaf(leaf);
      CHECK(places.emplace(view.patch, view.side, p.x, p.y, p.z).second);
    }
  CHECK_EQUAL(static_cast<int64_t>(used.size()), mesh.vertex_count());
}

// Between its vertices a triangle has the radiosity that queries of its points give. Not at the
// vertices themselves: there a point lies in the surface next to it and is sealed.
void triangles_have_the_values_of_point_queries() {
  const LeafMesh mesh(solved(), "a.ply");
  for (int64_t leaf = 0; leaf < mesh.triangle_count(); ++leaf) {
    const LeafView view = solved().leaf(leaf);
    const Triangle t = solved().scene().triangle(view.patch);
    const Vec3 n = t.area_vector();
    MeshVertex vertex[3];
    for (int c = 0; c < 3; ++c) vertex[c] = mesh.vertex(mesh.triangle(leaf)[c]);
    for (int c = 0; c < 3; ++c) {
      double weight[3] = {0.01, 0.01, 0.01};
      weight[c] = 0.98;
      Vec3 point = -t.a;
      for (int k = 0; k < 3; ++k) point = point + vertex[k].position * weight[k];
      const double uv[2] = {dot(cross(point, t.c - t.a), n) / dot(n, n),
                            dot(cross(t.b - t.a, point), n) / dot(n, n)};
      double queried[bands];
      solved().query_points(Quantity::radiosity, view.side, 1, &view.patch, uv, queried);
      for (int b = 0; b < bands; ++b) {
        double wanted = 0;
        for (int k = 0; k < 3; ++k) wanted += vertex[k].radiosity[b] * weight[k];
        CHECK_NEAR(queried[b], wanted, 1e-9 * (1 + wanted));
      }
    }
  }
}

// ---- .ply

void ply_holds_the_mesh() {
  Folder folder;
  export_solution(solved(), folder / "room.PLY");
  const std::string file = read_file(folder / "room.PLY");
  const LeafMesh mesh(solved(), "");
  const DisplayColors colors(solved());
  const std::string end = "end_header\n";
  const std::string header = file.substr(0, file.find(end));
  CHECK(header.rfind("ply\nformat binary_little_endian 1.0\n", 0) == 0);
  CHECK(contains(header, format("element vertex %d\n", static_cast<int>(mesh.vertex_count()))));
  CHECK(contains(header, "property float radiosity_1\nproperty uchar red\n"));
  CHECK(contains(header, format("element face %d\n", static_cast<int>(mesh.triangle_count()))));

  size_t at = header.size() + end.size();
  constexpr size_t vertex_bytes = 3 * 8 + bands * 4 + 3, face_bytes = 1 + 3 * 4 + 4 + 4 + 1;
  CHECK_EQUAL(file.size(),
              at + vertex_bytes * mesh.vertex_count() + face_bytes * mesh.triangle_count());
  for (int64_t i = 0; i < mesh.vertex_count(); ++i, at += vertex_bytes) {
    const MeshVertex vertex = mesh.vertex(i);
    for (int axis = 0; axis < 3; ++axis)
      CHECK_EQUAL(number_at<double>(file, at + 8 * axis), vertex.position[axis]);
    for (int b = 0; b < bands; ++b)
      CHECK_EQUAL(number_at<float>(file, at + 24 + 4 * b), static_cast<float>(vertex.radiosity[b]));
    for (int c = 0; c < 3; ++c)
      CHECK_EQUAL(int{number_at<uint8_t>(file, at + 24 + 4 * bands + c)},
                  int{srgb_byte(colors.linear(vertex.radiosity.data())[c])});
  }
  for (int64_t i = 0; i < mesh.triangle_count(); ++i, at += face_bytes) {
    const LeafView leaf = solved().leaf(i);
    CHECK_EQUAL(int{number_at<uint8_t>(file, at)}, 3);
    for (int c = 0; c < 3; ++c)
      CHECK_EQUAL(number_at<uint32_t>(file, at + 1 + 4 * c), mesh.triangle(i)[c]);
    CHECK_EQUAL(number_at<int32_t>(file, at + 13), leaf.patch);
    CHECK_EQUAL(number_at<int32_t>(file, at + 17), leaf.face);
    CHECK_EQUAL(int{number_at<uint8_t>(file, at + 21)}, leaf.side);
  }
}

// ---- .glb

struct Glb {
  std::string json, binary;
};

Glb read_glb(const std::string& path) {
  const std::string file = read_file(path);
  CHECK(file.rfind("glTF", 0) == 0);
  CHECK_EQUAL(number_at<uint32_t>(file, 8), file.size());
  const size_t json_bytes = number_at<uint32_t>(file, 12);
  const size_t binary = 20 + json_bytes;
  return {file.substr(20, json_bytes), binary < file.size() ? file.substr(binary + 8) : ""};
}

Glb exported_glb(const Solver& solver) {
  Folder folder;
  export_solution(solver, folder / "a.glb");
  return read_glb(folder / "a.glb");
}

void glb_holds_the_mesh() {
  const Glb glb = exported_glb(solved());
  const LeafMesh mesh(solved(), "");
  const DisplayColors colors(solved());
  constexpr size_t stride = 4 * (3 + 3 + 3 + bands);
  CHECK(contains(glb.json, "\"byteStride\":44"));
  CHECK(contains(glb.json, "\"_RADIOSITY\":3"));
  CHECK(!contains(glb.json, "rotation"));  // its parameter says that y is up
  const size_t indices = stride * mesh.vertex_count();
  CHECK_EQUAL(glb.binary.size(), indices + 12 * mesh.triangle_count());
  for (int64_t i = 0; i < mesh.vertex_count(); ++i) {
    const MeshVertex vertex = mesh.vertex(i);
    const auto value = [&](int k) { return number_at<float>(glb.binary, stride * i + 4 * k); };
    const auto color = colors.linear(vertex.radiosity.data());
    for (int axis = 0; axis < 3; ++axis) {
      CHECK_EQUAL(value(axis), static_cast<float>(vertex.position[axis]));
      CHECK_EQUAL(value(3 + axis), static_cast<float>(vertex.normal[axis]));
      CHECK_EQUAL(value(6 + axis), static_cast<float>(color[axis]));
    }
    for (int b = 0; b < bands; ++b)
      CHECK_EQUAL(value(9 + b), static_cast<float>(vertex.radiosity[b]));
  }
  for (int64_t i = 0; i < mesh.triangle_count(); ++i)
    for (int c = 0; c < 3; ++c)
      CHECK_EQUAL(number_at<uint32_t>(glb.binary, indices + 12 * i + 4 * c), mesh.triangle(i)[c]);
}

// One glowing triangle at a place, in a unit, of so many bands.
std::string json_of_triangle(Vec3 at, const char* unit, int n_bands) {
  Solver solver;
  solver.set_int("bands", n_bands);
  solver.set_text("unit", unit);
  solver.set_text("linking", "pairs");  // one leaf
  solver.set_text("up", "y");           // as glTF has it
  const std::vector<double> values(static_cast<size_t>(n_bands), 0.5);
  solver.add_material({"lamp", values, values, false, false});
  const double xyz[] = {at.x, at.y, at.z, at.x + 1, at.y, at.z, at.x, at.y + 1, at.z};
  const int64_t corners[] = {0, 1, 2};
  solver.add_patches(3, xyz, 1, corners, nullptr);
  CHECK(static_cast<int>(solver.solve()) >= 0);
  return exported_glb(solver).json;
}

void many_bands_take_several_attributes() {
  CHECK(contains(json_of_triangle({}, "m", 4), "\"_RADIOSITY\":3}"));
  const std::string five = json_of_triangle({}, "m", 5);
  CHECK(contains(five, "\"_RADIOSITY_0\":3,\"_RADIOSITY_1\":4}"));
  CHECK(contains(five, "\"byteOffset\":52,\"componentType\":5126,\"count\":3,\"type\":\"SCALAR\""));
  CHECK(contains(json_of_triangle({}, "m", 16), "\"_RADIOSITY_3\":6}"));
}

void units_are_brought_to_metres() {
  CHECK(!contains(json_of_triangle({}, "m", 1), "scale"));
  CHECK(!contains(json_of_triangle({}, "furlongs", 1), "scale"));
  CHECK(contains(json_of_triangle({}, "mm", 1), "\"scale\":[0.001,0.001,0.001]"));
  CHECK(contains(json_of_triangle({}, "kilometres", 1), "\"scale\":[1000,1000,1000]"));
  CHECK(contains(json_of_triangle({}, "inches", 1), "\"scale\":[0.0254,0.0254,0.0254]"));
  CHECK(contains(json_of_triangle({}, "foot", 1), "\"scale\":[0.3048,0.3048,0.3048]"));
}

// Single precision would round away the shape of what is far off.
void far_scenes_are_moved_to_the_origin() {
  const std::string json = json_of_triangle({4e8, 0, -8e8}, "cm", 1);
  CHECK(contains(json, "\"translation\":[4000000.005,0.005,-8e+06]"));
  CHECK(contains(json, "\"min\":[-0.5,-0.5,0],\"max\":[0.5,0.5,0]"));
  CHECK(!contains(json_of_triangle({20, 0, 0}, "m", 1), "translation"));
}

void built_in_scenes_stand_upright() {
  Solver solver;
  solver.make_scene("parallel-plates");
  solver.set_double("accuracy", 0.3);
  CHECK(static_cast<int>(solver.solve()) >= 0);
  CHECK(contains(exported_glb(solver).json, "\"rotation\":[-0.707"));
  solver.set_text("up", "y");
  CHECK(!contains(exported_glb(solver).json, "rotation"));
  // As arrays do of which nothing is said.
  Solver of_arrays;
  CHECK_EQUAL(of_arrays.stats().up_axis, 0);
  of_arrays.add_material({"lamp", {0.5, 0.5, 0.5}, {1, 1, 1}, false, false});
  const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int64_t corners[] = {0, 1, 2};
  of_arrays.add_patches(3, xyz, 1, corners, nullptr);
  CHECK_EQUAL(of_arrays.stats().up_axis, 2);
  CHECK(static_cast<int>(of_arrays.solve()) >= 0);
  CHECK(contains(exported_glb(of_arrays).json, "\"rotation\":[-0.707"));
}

void what_exchanges_nothing_has_no_mesh() {
  Solver solver;
  solver.add_material({"wall", {0.5, 0.5, 0.5}, {0, 0, 0}, false, true});
  const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const int64_t corners[] = {0, 1, 2};
  solver.add_patches(3, xyz, 1, corners, nullptr);
  CHECK(static_cast<int>(solver.solve()) >= 0);
  const Glb glb = exported_glb(solver);
  CHECK(!contains(glb.json, "mesh") && !contains(glb.json, "accessors"));
  CHECK(glb.binary.empty());
  Folder folder;
  export_solution(solver, folder / "a.ply");
  CHECK(contains(read_file(folder / "a.ply"), "element vertex 0\n"));
}

void a_glb_has_less_than_4_gib() {
  CHECK_EQUAL(glb_length("a.glb", 100, 0), 120u);
  CHECK_EQUAL(glb_length("a.glb", 100, 44), 172u);
  CHECK_EQUAL(glb_length("a.glb", 1000, 4294966000u), 4294967028u);
  CHECK_FAILS(glb_length("a.glb", 1000, 4294967000u), Status::unsupported, "a.glb");
  CHECK_FAILS(glb_length("a.glb", 1000, uint64_t{1} << 40), Status::unsupported, "4 GiB");
}

void floats_stay_finite() {
  CHECK_EQUAL(finite_float(0.1), 0.1f);
  CHECK_EQUAL(finite_float(1e300), std::numeric_limits<float>::max());
  CHECK_EQUAL(finite_float(-1e300), -std::numeric_limits<float>::max());
}

void threads_change_no_byte() {
  Folder folder;
  std::string files[2][2];
  for (int k = 0; k < 2; ++k) {
    Solver solver;
    make_room(solver);
    solver.set_int("threads", k == 0 ? 1 : 3);
    CHECK(static_cast<int>(solver.solve()) >= 0);
    for (int f = 0; f < 2; ++f) {
      const std::string path = folder / (f == 0 ? "a.ply" : "a.glb");
      export_solution(solver, path);
      files[k][f] = read_file(path);
    }
  }
  CHECK(files[0][0] == files[1][0]);
  CHECK(files[0][1] == files[1][1]);
}

}  // namespace

int main() {
  const struct CMUnitTest tests[] = {
      HRAD_TEST(a_mesh_has_the_corners_of_the_leaves),
      HRAD_TEST(vertices_are_shared),
      HRAD_TEST(triangles_have_the_values_of_point_queries),
      HRAD_TEST(ply_holds_the_mesh),
      HRAD_TEST(glb_holds_the_mesh),
      HRAD_TEST(many_bands_take_several_attributes),
      HRAD_TEST(units_are_brought_to_metres),
      HRAD_TEST(far_scenes_are_moved_to_the_origin),
      HRAD_TEST(built_in_scenes_stand_upright),
      HRAD_TEST(what_exchanges_nothing_has_no_mesh),
      HRAD_TEST(a_glb_has_less_than_4_gib),
      HRAD_TEST(floats_stay_finite),
      HRAD_TEST(threads_change_no_byte),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
