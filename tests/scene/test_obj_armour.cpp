// OBJ files from anywhere: odd encodings, huge lines and lists, numbers that no double holds, and
// names that lead where a scene has no business. Each is read, repaired and said, or refused with
// its line.
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>

#include "scene_folder.h"

using hrad::Scene;
using hrad::Sides;
using hrad::Status;
using hrad_test::count_diagnostics;
using hrad_test::SceneFolder;
using std::to_string;

namespace {

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

void check_error(const SceneFolder& folder, const std::string& text, const std::string& message) {
  CHECK_FAILS(folder.load(text), Status::scene, message);
}

std::string utf16(const std::string& ascii, bool big_end, bool mark) {
  std::string result;
  const auto put = [&](char high, char low) {
    result += big_end ? high : low;
    result += big_end ? low : high;
  };
  if (mark) put('\xfe', '\xff');
  for (char c : ascii) put('\0', c);
  return result;
}

void other_encodings_are_named() {
  const SceneFolder folder;
  for (bool big_end : {false, true})
    for (bool mark : {false, true})
      check_error(folder, utf16(square + "f 1 2 3\n", big_end, mark),
                  "scene.obj:1: this is UTF-16");
  check_error(folder, std::string("v 0 0 0\nv 1 \0 0 0\n", 18), "scene.obj:2: a zero byte");
  check_error(folder, std::string("v 0 0 0\r\nv 1 0 0\rv 0 1 0\n#\0", 27), "scene.obj:4: a zero");
}

void vertical_tabs_and_form_feeds_are_blanks() {
  const SceneFolder folder;
  const Scene s = folder.load("v\v0 0\f0\nv 1 0 0\nv 0 1 0\n\v\n\fusemtl a\v\nf 1\v2 3\n");
  CHECK_EQUAL(s.patch_count(), int64_t{1});
  CHECK_EQUAL(count_diagnostics(s, "material 'a' is unknown"), 1);
}

void names_in_any_alphabet() {
  const SceneFolder folder;
  folder.put("\xe7\x81\xaf.mtl", "newmtl gr\xc3\xbcn\nKd .1\nnewmtl gr\xfcn\nKd .2\n");
  Scene s = folder.load("mtllib \xe7\x81\xaf.mtl\n" + square +
                        "usemtl gr\xc3\xbcn\nf 1 2 3\nusemtl gr\xfcn\nf 1 2 4\n");
  CHECK_EQUAL(s.reflectance[0], 0.1);
  CHECK_EQUAL(s.reflectance[3], 0.2);
  // In a message: no control characters, of neither set, and no half character at the cut.
  s = folder.load(square + "usemtl a\x1b[2Jb\xc2\x9b" + "2Jc\nf 1 2 3\n");
  CHECK_EQUAL(count_diagnostics(s, "'a?[2Jb?2Jc'"), 1);
  std::string longest = "a";
  while (longest.size() < 100) longest += "\xe7\x81\xaf";
  s = folder.load(square + "usemtl " + longest + "\nf 1 2 3\n");
  CHECK_EQUAL(count_diagnostics(s, "'" + longest.substr(0, 58) + "...'"), 1);
}

// The area and the number of triangles that one face of n corners is cut into.
void check_polygon(const std::string& vertices, int n, double area) {
  const SceneFolder folder;
  std::string face = "f";
  for (int i = 1; i <= n; ++i) face += " " + to_string(i);
  const Scene s = folder.load(vertices + face + "\n");
  CHECK_EQUAL(s.patch_count(), int64_t{n - 2});
  CHECK_EQUAL(count_diagnostics(s, "cross themselves"), 0);
  double sum = 0;
  for (int64_t i = 0; i < s.patch_count(); ++i) {
    const double z = s.triangle(i).area_vector().z;
    CHECK(z >= 0);
    sum += z / 2;
  }
  CHECK_NEAR(sum, area, 1e-9 * area);
}

// Ear clipping that looks at every other corner would take ten thousand million steps here.
void polygons_of_a_hundred_thousand_corners() {
  constexpr int n = 100000;
  std::string star, comb, spiral;
  double star_area = 0;
  const double step = 2 * std::acos(-1.0) / n;
  for (int i = 0; i < n; ++i) {
    const double r = i % 2 ? 1 : 0.5;
    star += hrad::format("v %.17g %.17g 0\n", r * std::cos(step * i), r * std::sin(step * i));
    star_area += 0.5 * 0.5 * 1 * std::sin(step);
  }
  check_polygon(star, n, star_area);
  // Two rows of teeth, one within the other.
  for (int i = 0; i < n / 2; ++i) comb += hrad::format("v %d %d 0\n", i, 100 * (i % 2));
  for (int i = n / 2 - 1; i >= 0; --i) comb += hrad::format("v %d %g 0\n", i, 100 * (i % 2) + 0.5);
  check_polygon(comb, n, 0.5 * (n / 2 - 1));
}

void lines_of_five_million_characters() {
  const SceneFolder folder;
  const auto many = [](const std::string& word) {
    std::string text;
    while (text.size() < 5000000) text += word;
    return text;
  };
  check_error(folder, "v " + many("0 ") + "\n", "scene.obj:1: a vertex has 3, 4 or 6 numbers, not");
  check_error(folder, square + "f 1 2 " + many("9"), "scene.obj:5: '9999");
  Scene s = folder.load(square + "usemtl " + many("x") + "\nf 1 2 3\n" + many("y") + "\n" + "g " +
                        many("a#") + "\n# " + many("b"));
  CHECK_EQUAL(s.patch_count(), int64_t{1});
  CHECK_EQUAL(count_diagnostics(s, "1 unknown statements"), 1);
  for (const std::string& text : s.diagnostics) CHECK(text.size() < 1000);
  s = folder.load("v 0." + many("0") + "1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  CHECK_EQUAL(s.vertices[0].x, 0.0);
  CHECK_EQUAL(count_diagnostics(s, "1 numbers are too small"), 1);
  s = folder.load(square + "f 1 \\\n" + many("\\\n") + " 2 3\n");
  CHECK_EQUAL(s.patch_count(), int64_t{1});
  // A name that no file can have, and a list of names that together are longer than any.
  s = folder.load("mtllib " + many("z") + "\nmtllib " + many("z.mtl ") + "\n" + square);
  CHECK_EQUAL(count_diagnostics(s, "scene.obj:2: no file"), 1);
  folder.put("last.mtl", "newmtl red\nKd .1\n");
  std::string list;
  for (int i = 0; i < 300; ++i) list += " part" + to_string(i) + ".mtl";
  s = folder.load("mtllib" + list + " last.mtl\n" + square + "usemtl red\nf 1 2 3\n");
  CHECK_EQUAL(s.reflectance[0], 0.1);
  CHECK_EQUAL(count_diagnostics(s, "no file"), 8);
  CHECK_EQUAL(count_diagnostics(s, "292 further files of materials are missing"), 1);
}

void a_hundred_thousand_materials() {
  const SceneFolder folder;
  constexpr int n = 100000;
  std::string text = "mtllib a.mtl\n" + square, materials;
  for (int i = 0; i < n; ++i) {
    text += "usemtl m" + to_string(i) + "\nf 1 2 3\n";
    if (i % 2 == 0) materials += "newmtl m" + to_string(i) + "\nKd ." + to_string(i % 10) + "\n";
  }
  folder.put("a.mtl", materials);
  const Scene s = folder.load(text);
  CHECK_EQUAL(s.materials.size(), size_t{n / 2 + 1});
  CHECK_EQUAL(s.reflectance[3 * 99998], 0.8);
  CHECK_EQUAL(s.reflectance[3 * 99999], 0.5);
  // A few by name, the others as one.
  CHECK_EQUAL(count_diagnostics(s, "is unknown"), 8);
  CHECK_EQUAL(count_diagnostics(s, "49992 further materials are unknown"), 1);
  CHECK_EQUAL(count_diagnostics(s, "their 49992 faces"), 1);
}

void mtllib_stays_in_the_folder_of_the_scene() {
  const SceneFolder folder;
  CHECK(mkdir(folder.file("scene").c_str(), 0700) == 0);
  CHECK(mkdir(folder.file("scene/below").c_str(), 0700) == 0);
  CHECK(mkdir(folder.file("scenery").c_str(), 0700) == 0);
  folder.put("outside.mtl", "newmtl a\nKd .1\n");
  folder.put("scenery/outside.mtl", "newmtl a\nKd .1\n");
  folder.put("scene/below/inside.mtl", "newmtl a\nKd .2\n");
  const auto link = [&](const char* to, const char* name) {
    CHECK(symlink(to, folder.file(name).c_str()) == 0);
  };
  link("../outside.mtl", "scene/out.mtl");
  link("../scenery/outside.mtl", "scene/out2.mtl");
  link("../scenery", "scene/out3");
  link("/dev/zero", "scene/zero.mtl");
  link("loop.mtl", "scene/loop.mtl");
  link("nowhere.mtl", "scene/dangling.mtl");
  link("below/inside.mtl", "scene/in.mtl");
  link("scene", "alias");
  const auto load = [&](const std::string& scene, const std::string& name) {
    Scene s;
    hrad::load_obj(
        s, folder.put(scene + "/a.obj", "mtllib " + name + "\n" + square + "usemtl a\nf 1 2 3\n"),
        Sides::front);
    return s;
  };
  for (const char* name : {"out.mtl", "out2.mtl", "out3/outside.mtl", "zero.mtl"})
    CHECK_FAILS(load("scene", name), Status::scene,
                "a.obj:1: mtllib '" + std::string(name) + "' is a link out of the folder");
  CHECK_FAILS(load("scene", "loop.mtl"), Status::scene, "a.obj:1: mtllib ");
  CHECK_EQUAL(count_diagnostics(load("scene", "dangling.mtl"), "no file"), 1);
  // Links within the folder, and a folder that is reached over a link, are as good as any.
  CHECK_EQUAL(load("scene", "in.mtl").reflectance[0], 0.2);
  CHECK_EQUAL(load("alias", "in.mtl").reflectance[0], 0.2);
  CHECK_EQUAL(load("scene/../scene", "below/inside.mtl").reflectance[0], 0.2);
}

void the_same_mtllib_again() {
  const SceneFolder folder;
  folder.put("a.mtl", "newmtl a\nKd .1\n");
  CHECK(symlink("a.mtl", folder.file("b.mtl").c_str()) == 0);
  const Scene s = folder.load("mtllib a.mtl\nmtllib a.mtl\nmtllib ./a.mtl b.mtl\n" + square);
  CHECK_EQUAL(s.materials.size(), size_t{1});
  CHECK_EQUAL(count_diagnostics(s, "3 mtllib that repeat an earlier one are ignored"), 1);
  CHECK_EQUAL(count_diagnostics(s, "scene.obj:2"), 1);
  CHECK_EQUAL(count_diagnostics(s, "repeated definitions"), 0);
}

void numbers_that_vanish() {
  const SceneFolder folder;
  const Scene s = folder.load(
      "v 1e-400 -1e-99999999999999999999 0.0001e-325\nv 1 4e-320 0\n"
      "v 0 1 1000000000e-350\nf 1 2 3\n");
  CHECK_EQUAL(s.vertices[0].x, 0.0);
  CHECK_EQUAL(s.vertices[0].y, 0.0);
  CHECK_EQUAL(s.vertices[0].z, 0.0);
  CHECK(s.vertices[1].y > 0);
  CHECK_EQUAL(count_diagnostics(s, "4 numbers are too small to be told from 0"), 1);
  CHECK_EQUAL(count_diagnostics(s, "scene.obj:1)"), 1);
}

void truncated_files() {
  const SceneFolder folder;
  const std::string whole = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  check_error(folder, "v 0 0 0\nv 1 0", "scene.obj:2: a vertex has 3, 4 or 6 numbers, not 2");
  check_error(folder, "v 0 0 0\nv 1 0 -", "scene.obj:2: '-' is not a number");
  check_error(folder, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2", "scene.obj:4: a face needs at least 3");
  check_error(folder, "v 0 0 0\nv 1 0 0\nf 1 2 3", "scene.obj:3: vertex index 3 is out of range");
  check_error(folder, whole + "f 1/", "scene.obj:5: a face needs");
  check_error(folder, whole + "f 1/ 2/ 3/", "scene.obj:5: '' is not a texture index");
  check_error(folder, whole + "mtllib", "scene.obj:5: mtllib without a name");
  CHECK_EQUAL(folder.load(whole + "usemtl").patch_count(), int64_t{1});
  CHECK_EQUAL(folder.load(whole + "\\").patch_count(), int64_t{1});
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(other_encodings_are_named),
      HRAD_TEST(vertical_tabs_and_form_feeds_are_blanks),
      HRAD_TEST(names_in_any_alphabet),
      HRAD_TEST(polygons_of_a_hundred_thousand_corners),
      HRAD_TEST(lines_of_five_million_characters),
      HRAD_TEST(a_hundred_thousand_materials),
      HRAD_TEST(mtllib_stays_in_the_folder_of_the_scene),
      HRAD_TEST(the_same_mtllib_again),
      HRAD_TEST(numbers_that_vanish),
      HRAD_TEST(truncated_files),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
