// Exports of a solved scene, read back: every number of .csv and .vtu is the solver's own, bit for
// bit, and a refused export leaves nothing behind.
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "export_room.h"
#include "solver/export.h"
#include "solver/solver.h"
#include "support/check.h"

namespace {

using namespace hrad;
using hrad_test::bands;
using hrad_test::Folder;
using hrad_test::make_room;
using hrad_test::read_file;
using hrad_test::solved;

// ---- .csv

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

void csv_holds_every_leaf_in_full_precision() {
  Folder folder;
  export_solution(solved(), folder / "room.csv");
  const std::vector<std::string> rows = split(read_file(folder / "room.csv"), '\n');
  CHECK(rows.at(0) == "patch,face,side,x0,y0,z0,x1,y1,z1,x2,y2,z2,area,b0,b1");
  CHECK_EQUAL(static_cast<int64_t>(rows.size()) - 1, solved().leaf_count());
  int64_t backs = 0;
  for (int64_t i = 0; i < solved().leaf_count(); ++i) {
    const LeafView leaf = solved().leaf(i);
    double values[bands];
    solved().leaf_values(i, Quantity::radiosity, values);
    const Vec3 a = leaf.corners.a, b = leaf.corners.b, c = leaf.corners.c;
    const double wanted[] = {double(leaf.patch),
                             double(leaf.face),
                             double(leaf.side),
                             a.x,
                             a.y,
                             a.z,
                             b.x,
                             b.y,
                             b.z,
                             c.x,
                             c.y,
                             c.z,
                             leaf.area,
                             values[0],
                             values[1]};
    const std::vector<std::string> fields = split(rows[i + 1], ',');
    CHECK_EQUAL(fields.size(), sizeof wanted / sizeof *wanted);
    for (size_t k = 0; k < fields.size(); ++k)
      CHECK_EQUAL(std::strtod(fields[k].c_str(), nullptr), wanted[k]);
    backs += leaf.side;
  }
  CHECK(backs > 0 && backs < solved().leaf_count());
}

// ---- .vtu

// The value of an attribute of the element that starts at `from`.
std::string attribute(const std::string& xml, size_t from, const std::string& name) {
  const size_t start = xml.find(" " + name + "=\"", from);
  CHECK(start != std::string::npos && start < xml.find('>', from));
  const size_t value = start + name.size() + 3;
  return xml.substr(value, xml.find('"', value) - value);
}

// The raw numbers of an array of a .vtu file.
template <class Number>
std::vector<Number> vtu_array(const std::string& file, const std::string& name,
                              const std::string& type, int components) {
  const size_t name_at = file.find(" Name=\"" + name + "\"");
  CHECK(name_at != std::string::npos);
  const size_t element = file.rfind('<', name_at);
  CHECK(attribute(file, element, "type") == type);
  CHECK_EQUAL(std::stoi(attribute(file, element, "NumberOfComponents")), components);
  CHECK(attribute(file, element, "format") == "appended");

  const std::string mark = "<AppendedData encoding=\"raw\">\n_";
  const size_t data = file.find(mark) + mark.size();
  const size_t at = data + std::stoull(attribute(file, element, "offset"));
  uint64_t size;
  CHECK(at + sizeof size <= file.size());
  std::memcpy(&size, file.data() + at, sizeof size);
  CHECK(at + sizeof size + size <= file.size());
  std::vector<Number> numbers(size / sizeof(Number));
  CHECK_EQUAL(numbers.size() * sizeof(Number), size);
  std::memcpy(numbers.data(), file.data() + at + sizeof size, size);
  return numbers;
}

void check_means(const std::string& file, const std::string& name, Quantity quantity) {
  const std::vector<double> means = vtu_array<double>(file, name, "Float64", bands);
  CHECK_EQUAL(static_cast<int64_t>(means.size()), solved().leaf_count() * bands);
  for (int64_t i = 0; i < solved().leaf_count(); ++i) {
    double wanted[bands];
    solved().leaf_values(i, quantity, wanted);
    for (int band = 0; band < bands; ++band) CHECK_EQUAL(means[i * bands + band], wanted[band]);
  }
}

std::string exported_vtu() {
  Folder folder;
  export_solution(solved(), folder / "room.VTU");
  return read_file(folder / "room.VTU");
}

void vtu_describes_its_arrays() {
  const std::string file = exported_vtu();
  CHECK(file.rfind("<?xml version=\"1.0\"?>", 0) == 0);
  const size_t head = file.find("<VTKFile");
  CHECK(attribute(file, head, "type") == "UnstructuredGrid");
  CHECK(attribute(file, head, "byte_order") == "LittleEndian");
  CHECK(attribute(file, head, "header_type") == "UInt64");
  const size_t piece = file.find("<Piece");
  CHECK_EQUAL(std::stoll(attribute(file, piece, "NumberOfCells")), solved().leaf_count());
  CHECK_EQUAL(std::stoll(attribute(file, piece, "NumberOfPoints")), 3 * solved().leaf_count());
  const std::string end = "\n</AppendedData>\n</VTKFile>\n";
  CHECK(file.compare(file.size() - end.size(), end.size(), end) == 0);
}

void vtu_holds_the_mesh() {
  const std::string file = exported_vtu();
  const std::vector<double> points = vtu_array<double>(file, "Points", "Float64", 3);
  const std::vector<int64_t> connectivity = vtu_array<int64_t>(file, "connectivity", "Int64", 1);
  const std::vector<int64_t> offsets = vtu_array<int64_t>(file, "offsets", "Int64", 1);
  const std::vector<uint8_t> types = vtu_array<uint8_t>(file, "types", "UInt8", 1);
  const std::vector<int64_t> patches = vtu_array<int64_t>(file, "patch", "Int64", 1);
  const std::vector<int64_t> faces = vtu_array<int64_t>(file, "face", "Int64", 1);
  const std::vector<int32_t> sides = vtu_array<int32_t>(file, "side", "Int32", 1);
  const auto leaves = static_cast<size_t>(solved().leaf_count());
  CHECK_EQUAL(points.size(), 9 * leaves);
  CHECK_EQUAL(connectivity.size(), 3 * leaves);
  CHECK_EQUAL(offsets.size(), leaves);
  CHECK_EQUAL(types.size(), leaves);
  CHECK_EQUAL(sides.size(), leaves);
  for (size_t i = 0; i < leaves; ++i) {
    const LeafView leaf = solved().leaf(static_cast<int64_t>(i));
    CHECK_EQUAL(patches[i], leaf.patch);
    CHECK_EQUAL(faces[i], leaf.face);
    CHECK_EQUAL(sides[i], leaf.side);
    CHECK_EQUAL(offsets[i], static_cast<int64_t>(3 * i + 3));
    CHECK_EQUAL(int{types[i]}, 5);
    const Vec3 corners[] = {leaf.corners.a, leaf.corners.b, leaf.corners.c};
    for (size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis)
        CHECK_EQUAL(points[3 * static_cast<size_t>(connectivity[3 * i + k]) + axis],
                    corners[k][axis]);
  }
}

void vtu_holds_means_and_corner_values() {
  const std::string file = exported_vtu();
  check_means(file, "radiosity", Quantity::radiosity);
  check_means(file, "irradiance", Quantity::irradiance);
  check_means(file, "emission", Quantity::emission);
  const std::vector<double> linear = vtu_array<double>(file, "radiosity_linear", "Float64", bands);
  CHECK_EQUAL(static_cast<int64_t>(linear.size()), solved().leaf_count() * 3 * bands);
  for (int64_t i = 0; i < solved().leaf_count(); ++i) {
    double wanted[3 * bands];
    solved().leaf_corner_radiosity(i, wanted);
    for (int k = 0; k < 3 * bands; ++k) CHECK_EQUAL(linear[i * 3 * bands + k], wanted[k]);
  }
}

// ---- the choice of a format, and failures

void obj_needs_no_solve() {
  Solver solver;
  solver.make_scene("cornell");
  Folder folder;
  solver.export_file(folder / "room.obj");
  Solver again;
  again.load_scene(folder / "room.obj");
  CHECK_EQUAL(again.scene().patch_count(), solver.scene().patch_count());
}

// A scene read back from its file is solved to the same bits: sheets, blockers and all.
void an_exported_scene_has_the_same_hash() {
  Folder folder;
  uint64_t hash[2];
  for (int k = 0; k < 2; ++k) {
    Solver solver;
    solver.set_double("accuracy", 0.3);
    if (k == 0) {
      solver.add_material({"lamp", {0.5, 0.5, 0.5}, {9, 5, 1}, false, false});
      solver.add_material({"sheet", {0.7, 0.4, 0.1}, {0, 0, 0}, true, false});
      solver.add_material({"blocker", {}, {}, false, true});
      const double xyz[] = {0, 0, 0, 1, 0, 0, 1, 1,   0, 0, 1, 0,
                            0, 0, 1, 0, 1, 1, 1, 0.1, 1, 1, 1, 0.3};
      const int64_t corners[] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 0, 6, 7};
      const int32_t materials[] = {0, 0, 1, 1, 2};
      solver.add_patches(8, xyz, 5, corners, materials);
      solver.export_file(folder / "room.obj");
    } else {
      solver.load_scene(folder / "room.obj");
    }
    CHECK(static_cast<int>(solver.solve()) >= 0);
    hash[k] = solver.state_hash();
  }
  CHECK_EQUAL(hash[0], hash[1]);
}

void refused_exports_leave_nothing() {
  Folder folder;
  Solver solver;
  make_room(solver);
  CHECK_FAILS(export_solution(solver, folder / "a.csv"), Status::state, "solve");
  CHECK_FAILS(export_solution(solver, folder / "a.vtu"), Status::state, "solve");
  CHECK_FAILS(export_solution(solver, folder / "a.ply"), Status::state, "solve");
  CHECK_FAILS(export_solution(solver, folder / "a.GLB"), Status::state, "solve");
  CHECK_FAILS(export_solution(solved(), folder / "a.png"), Status::argument,
              ".csv, .vtu, .ply, .glb, .obj");
  CHECK_FAILS(export_solution(solved(), folder / "a"), Status::argument,
              ".csv, .vtu, .ply, .glb, .obj");
  CHECK_FAILS(export_solution(solved(), folder / "csv"), Status::argument,
              ".csv, .vtu, .ply, .glb, .obj");
  CHECK_FAILS(export_solution(solved(), ""), Status::argument, ".csv, .vtu, .ply, .glb, .obj");
  CHECK(folder.empty());
  CHECK_FAILS(export_solution(solved(), folder / "none/a.csv"), Status::file, "none/a.csv");
  CHECK_FAILS(export_solution(solved(), folder / "none.csv/a"), Status::argument, ".csv, .vtu");
  CHECK(folder.empty());
}

void an_export_replaces_the_old_file() {
  Folder folder;
  std::ofstream(folder / "a.csv") << "old";
  export_solution(solved(), folder / "a.csv");
  export_solution(solved(), folder / "b.csv");
  CHECK(read_file(folder / "a.csv") == read_file(folder / "b.csv"));
  CHECK(read_file(folder / "a.csv") != "old");
}

}  // namespace

int main() {
  const struct CMUnitTest tests[] = {
      HRAD_TEST(csv_holds_every_leaf_in_full_precision),
      HRAD_TEST(vtu_describes_its_arrays),
      HRAD_TEST(vtu_holds_the_mesh),
      HRAD_TEST(vtu_holds_means_and_corner_values),
      HRAD_TEST(obj_needs_no_solve),
      HRAD_TEST(an_exported_scene_has_the_same_hash),
      HRAD_TEST(refused_exports_leave_nothing),
      HRAD_TEST(an_export_replaces_the_old_file),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
