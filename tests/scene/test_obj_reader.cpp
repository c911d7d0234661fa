// OBJ files: what is read, what is repaired and said, what is refused and where.
#include <sys/stat.h>
#include <unistd.h>

#include <clocale>

#include "scene_folder.h"

using hrad::Scene;
using hrad::Sides;
using hrad::Status;
using hrad_test::count_diagnostics;
using hrad_test::SceneFolder;

namespace {

using Corners = std::array<int32_t, 3>;

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

void check_error(const std::string& text, const std::string& message) {
  const SceneFolder folder;
  CHECK_FAILS(folder.load(text), Status::scene, message);
}

void check_error_in(const SceneFolder& folder, const std::string& text,
                    const std::string& message) {
  CHECK_FAILS(folder.load(text), Status::scene, message);
}

void faces_and_their_numbers() {
  SceneFolder folder;
  const Scene s = folder.load(square + "f 1 2 3\nf 1 2 3 4\nf 2 3 4\n");
  CHECK_EQUAL(s.patch_count(), int64_t{4});
  CHECK((s.corners[0] == Corners{0, 1, 2}));
  CHECK((s.corners[1] == Corners{0, 1, 2}));
  CHECK((s.corners[2] == Corners{0, 2, 3}));
  CHECK((s.corners[3] == Corners{1, 2, 3}));
  CHECK((s.face == std::vector<int64_t>{0, 1, 1, 2}));
  CHECK_EQUAL(s.vertices.size(), size_t{4});
  CHECK_EQUAL(s.vertices[2].y, 1.0);
}

void concave_faces_keep_their_shape() {
  SceneFolder folder;
  const Scene s =
      folder.load("v 0 0 0\nv 2 -1 0\nv .5 0 0\nv 2 1 0\nf 1 2 3 4\nf 4 3 2 1\nf 2 3 4 1\n");
  CHECK_EQUAL(s.patch_count(), int64_t{6});
  double area = 0;
  for (int64_t i = 0; i < 6; ++i) {
    const double z = s.triangle(i).area_vector().z;
    CHECK(s.face[i] == 1 ? z < 0 : z > 0);
    area += std::fabs(z) / 2;
  }
  CHECK_NEAR(area, 1.5, 1e-12);
  CHECK_EQUAL(count_diagnostics(s, "cross themselves"), 0);
}

void forms_of_corners() {
  SceneFolder folder;
  const std::string lists = square + "vt 0 0\nvt 1 0\nvn 0 0 1\n";
  for (const char* face :
       {"f 1 2 3", "f 1/1 2/2 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/2/1 3/2/1", "f -4 -3 -2",
        "f -4/-2 -3/-1 -2/-1", "f -4//-1 2//1 -2//-1", "f -4/1/-1 2/-1/1 -2/1/1", "fo 1 2 3"}) {
    const Scene s = folder.load(lists + face);
    CHECK_EQUAL(s.patch_count(), int64_t{1});
    CHECK((s.corners[0] == Corners{0, 1, 2}));
  }
  // Relative to the vertices before the face, absolute among all of the file.
  const Scene s = folder.load("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -1 -2 -3\nf 4 5 6\n" + square);
  CHECK((s.corners[0] == Corners{2, 1, 0}));
  CHECK((s.corners[1] == Corners{3, 4, 5}));
}

void wrong_corners() {
  check_error(square + "f 1 2 0\n", "scene.obj:5: vertex index 0: indices begin with 1");
  check_error(square + "f 1 2 5\n", "scene.obj:5: vertex index 5 is out of range 1 to 4");
  check_error(square + "\nf 1 2 3\nf 1 2 9\nf 1 2 5", ":7: vertex index 9 is out of range 1 to 4");
  check_error(square + "f 1 2 -5\n", ":5: vertex index -5 is out of range -4 to -1");
  check_error("f 1 2 -1\n" + square, ":1: vertex index -1 refers to nothing");
  check_error("f 1 2 3\n", ":1: vertex index 3 refers to nothing");
  check_error(square + "f 1 2 99999999999\n", "index 99999999999 is out of range 1 to 4");
  check_error(square + "f 1 2 99999999999999999999\n", "is not a vertex index");
  check_error(square + "f 1 2 4294967297\n", "index 4294967297 is out of range 1 to 4");
  for (const char* word : {"3.0", "3a", "x", "0x3", "+3", "3,", "1e0", "-", "/1", "3_"})
    check_error(square + "vt 0 0\nf 1 2 " + word + "\n", "is not a vertex index");
  for (const char* word : {"3/", "3//", "3/1/", "3/1/1/1", "3/1//1", "3///1", "3/a", "3//1x"})
    check_error(square + "vt 0 0\nvn 0 0 1\nf 1 2 " + word + "\n", "scene.obj:7: '");
  check_error(square + "vt 0 0\nf 1/1 2/2 3/1\n", "texture index 2 is out of range 1 to 1");
  check_error(square + "f 1//1 2//1 3//1\n", "normal index 1 refers to nothing");
  check_error(square + "vt 0 0\nf 1/0 2/1 3/1\n", "texture index 0");
  check_error(square + "vt 0 0\nf 1/-2 2/1 3/1\n", "texture index -2 is out of range -1 to -1");
  check_error(square + "f 1 2\n", ":5: a face needs at least 3 corners, not 2");
  check_error(square + "f\n", ":5: a face needs at least 3 corners, not 0");
}

void repeated_corners() {
  SceneFolder folder;
  Scene s = folder.load(square + "f 1 1 2 3 3 3 4 1\n");
  CHECK_EQUAL(s.patch_count(), int64_t{2});
  CHECK((s.corners[0] == Corners{0, 1, 2}));
  CHECK((s.corners[1] == Corners{0, 2, 3}));
  CHECK_EQUAL(count_diagnostics(s, "4 repeated corners"), 1);
  // A triangle keeps its number, whatever its area.
  s = folder.load(square + "f 1 1 2\nf 2 2 2 2\nf 1 2 3\n");
  CHECK_EQUAL(s.patch_count(), int64_t{3});
  CHECK((s.corners[2] == Corners{0, 1, 2}));
  CHECK_EQUAL(s.face[2], int64_t{2});
}

void faces_that_cross_themselves() {
  SceneFolder folder;
  const Scene s = folder.load("v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 3 4\n");
  CHECK_EQUAL(s.patch_count(), int64_t{3});
  CHECK_EQUAL(count_diagnostics(s, "1 faces cross themselves"), 1);
  CHECK_EQUAL(count_diagnostics(s, "scene.obj:6"), 1);
}

void numbers_of_vertices() {
  SceneFolder folder;
  const std::string rest = "v 1 0 0\nv 0 1 0\nf 1 2 3\n";
  CHECK_EQUAL(folder.load("v 1 2 3\n" + rest).vertices[0].z, 3.0);
  CHECK_EQUAL(folder.load("v 1 2 3 1.0\n" + rest).vertices[0].z, 3.0);
  CHECK_EQUAL(folder.load("v 1 2 3 .1 .2 .3\n" + rest).vertices[0].z, 3.0);
  CHECK_EQUAL(folder.load("v +1.5 -.5 1e-3\n" + rest).vertices[0].x, 1.5);
  CHECK_EQUAL(folder.load("v 1.E2 5. 1e+2\n" + rest).vertices[0].z, 100.0);
  CHECK_EQUAL(folder.load("v 0.1 0 1e30\n" + rest).vertices[0].x, 0.1);
  for (const char* n : {"2", "1 2", "1 2 3 4 5", "1 2 3 4 5 6 7", ""})
    check_error(std::string("v ") + n + "\n" + rest, ":1: a vertex has 3, 4 or 6 numbers");
  for (const char* word : {"nan", "inf", "-inf", "infinity", "0x10", "1,5", "10abc",
                           "1.5.2", "--1", "+-1", "1e", "e5", "+", "1d3", "1_0", "\xd9\xa1"})
    check_error("v 0 " + std::string(word) + " 0\n" + rest,
                ":1: '" + std::string(word) + "' is not");
  check_error("v 0 0 0 nan\n" + rest, ":1: 'nan' is not a number");
  for (const char* word : {"1.1e30", "-1e31", "1e999", "-1e99999999999999999999", "1000e9999"})
    check_error("v 0 " + std::string(word) + " 0\n" + rest,
                ":1: '" + std::string(word) + "' is beyond 1e30");
}

void the_locale_means_nothing() {
  // Set only where such a locale is installed; the reader must not care either way.
  for (const char* name : {"de_DE.UTF-8", "fr_FR.UTF-8", "C.UTF-8"}) std::setlocale(LC_ALL, name);
  SceneFolder folder;
  const Scene s = folder.load("v 1.5 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::setlocale(LC_ALL, "C");
  CHECK_EQUAL(s.vertices[0].x, 1.5);
}

void lines_and_blanks() {
  SceneFolder folder;
  const char* texts[] = {
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3",
      "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n",
      "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r",
      "\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
      "\n\n  v\t0  0 0 \t\n\tv 1 0 0   \nv 0 1 0\n   \nf\t1 2\t3  \n\n",
      "# a scene\nv 0 0 0 # origin\nv 1 0 0 #\nv 0 1 0\n#f 9 9 9\nf 1 2 3 # f",
      "v 0 \\\n0 0\nv 1 0 0\nv 0 1 0\nf 1 \\\n 2\\\n3\n",
      "v 0 \\\r\n0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\\",
      "# not joined \\\nv 0 0 0\nv 1 0 0\nv 0 1 \\\n 0 # not joined \\\nf 1 2 3\n",
  };
  for (const char* text : texts) {
    const Scene s = folder.load(text);
    CHECK_EQUAL(s.patch_count(), int64_t{1});
    CHECK((s.corners[0] == Corners{0, 1, 2}));
    CHECK_EQUAL(s.vertices[1].x, 1.0);
  }
  // Errors name the line as an editor counts it.
  check_error("v 0 0 \\\n 0\r\nv 1 0 0\rv x 0 0\n", "scene.obj:4: 'x' is not a number");
  check_error("v 0 0 \\\n x\n", "scene.obj:1: 'x' is not a number");
}

void other_statements() {
  SceneFolder folder;
  const Scene s = folder.load("o room\ng a b\ns off\nvt nan\nvp 1\n" + square +
                              "l 1 2\nl 2 3\np 1\ncurv 0 1 1 2\nf 1 2 3\nfoo 1\nbar\n");
  CHECK_EQUAL(s.patch_count(), int64_t{1});
  CHECK_EQUAL(count_diagnostics(s, "2 statements 'l' are ignored"), 1);
  CHECK_EQUAL(count_diagnostics(s, "scene.obj:10"), 1);
  CHECK_EQUAL(count_diagnostics(s, "1 statements 'p'"), 1);
  CHECK_EQUAL(count_diagnostics(s, "1 statements 'curv'"), 1);
  CHECK_EQUAL(count_diagnostics(s, "2 unknown statements"), 1);
  CHECK_EQUAL(count_diagnostics(s, "'foo'"), 1);
  check_error("call /etc/passwd\n", "scene.obj:1: call is refused");
  check_error("\ncsh rm -rf x\n", "scene.obj:2: csh is refused");
}

void materials_by_name() {
  SceneFolder folder;
  folder.put("a.mtl", "newmtl red\nKd .5 .1 .1\nnewmtl dark blue\nKd 0 0 .2\nKe 1 2 3\n");
  const Scene s = folder.load("mtllib a.mtl\n" + square +
                              "f 1 2 3\nusemtl red\nf 1 2 3\nusemtl  dark blue # x\nf 1 2 3\n"
                              "usemtl nothing\nf 1 2 3 4\nusemtl red\nf 1 2 3\n");
  CHECK_EQUAL(s.materials.size(), size_t{3});
  CHECK((s.material == std::vector<int32_t>{2, 0, 1, 2, 2, 0}));
  CHECK((s.materials[0].reflectance == std::vector<double>{.5, .1, .1}));
  CHECK((s.materials[1].emission == std::vector<double>{1, 2, 3}));
  CHECK(s.materials[2].name == "default");
  CHECK((s.materials[2].reflectance == std::vector<double>{.5, .5, .5}));
  CHECK((s.materials[2].emission == std::vector<double>{0, 0, 0}));
  CHECK_EQUAL(s.emission[2 * 3 + 1], 2.0);
  CHECK_EQUAL(s.reflectance[5 * 3], 0.5);
  CHECK_EQUAL(count_diagnostics(s, "scene.obj:11: material 'nothing' is unknown"), 1);
  CHECK_EQUAL(count_diagnostics(s, "1 faces without a material"), 1);
}

void material_files() {
  SceneFolder folder;
  folder.put("a.mtl", "newmtl a\nKd .1\n");
  folder.put("b.mtl", "newmtl b\nKd .2\nnewmtl a\nKd .9\nKe 5\n");
  folder.put("my own.mtl", "newmtl c\nKd .3\n");
  folder.put("plain", "newmtl d\nKd .4\n");
  CHECK(mkdir(folder.file("sub").c_str(), 0700) == 0);
  folder.put("sub/e.mtl", "newmtl e\nKd .5\n");
  const auto names = [&](const std::string& libraries) {
    std::string result;
    for (const hrad::Material& m : folder.load(libraries + square + "f 1 2 3\n").materials)
      if (m.name != "default") result += m.name;
    return result;
  };
  CHECK(names("mtllib a.mtl\n") == "a");
  CHECK(names("mtllib a.mtl b.mtl\n") == "ab");
  CHECK(names("mtllib a.mtl\nmtllib b.mtl\nmtllib a.mtl\n") == "ab");
  CHECK(names("mtllib my own.mtl\n") == "c");
  CHECK(names("mtllib a.mtl   my own.mtl\tplain\n") == "acd");
  CHECK(names("mtllib ./sub/e.mtl\n") == "e");
  // Also behind the faces.
  CHECK_EQUAL(folder.load(square + "usemtl a\nf 1 2 3\nmtllib a.mtl\n").reflectance[0], 0.1);
  const Scene s = folder.load("mtllib a.mtl b.mtl\n" + square + "usemtl a\nf 1 2 3\n");
  CHECK_EQUAL(s.reflectance[0], 0.1);
  CHECK_EQUAL(s.emission[0], 0.0);
  CHECK_EQUAL(count_diagnostics(s, "1 repeated definitions of a material"), 1);
  CHECK_EQUAL(count_diagnostics(s, "b.mtl:3"), 1);
}

void missing_and_forbidden_material_files() {
  SceneFolder folder;
  const Scene s = folder.load("mtllib no.mtl\n" + square + "usemtl red\nf 1 2 3\n");
  CHECK_EQUAL(s.reflectance[0], 0.5);
  CHECK_EQUAL(count_diagnostics(s, "scene.obj:1: no file '" + folder.file("no.mtl")), 1);
  CHECK_EQUAL(count_diagnostics(s, "material 'red' is unknown"), 1);
  check_error("mtllib\n", ":1: mtllib without a name");
  for (const char* name : {"/etc/passwd", "../a.mtl", "sub/../../a.mtl", "a.mtl ../b.mtl", "..",
                           "a.mtl /b.mtl", "sub/.."})
    check_error(std::string("\nmtllib ") + name + "\n", "scene.obj:2: mtllib '");
  CHECK(mkfifo(folder.file("fifo.mtl").c_str(), 0600) == 0);
  check_error_in(folder, "\nmtllib fifo.mtl\n", "scene.obj:2: mtllib ");
  check_error_in(folder, "mtllib fifo.mtl\n", "mtllib 'fifo.mtl': not a regular file");
  CHECK(mkdir(folder.file("dir.mtl").c_str(), 0700) == 0);
  check_error_in(folder, "mtllib dir.mtl\n", "mtllib 'dir.mtl': cannot read: Is a directory");
  folder.put("bad.mtl", "newmtl a\n\nKd x\n");
  CHECK_FAILS(folder.load("mtllib bad.mtl\n"), Status::scene, "bad.mtl:3: 'x' is not a number");
}

void files_that_cannot_be_read() {
  SceneFolder folder;
  Scene s;
  const std::string missing = folder.file("missing.obj");
  CHECK_FAILS(hrad::load_obj(s, missing, Sides::front), Status::file,
              missing + ": cannot open: No such file");
  CHECK_FAILS(hrad::load_obj(s, folder.path, Sides::front), Status::file, "Is a directory");
  CHECK_FAILS(hrad::load_obj(s, "/dev/null", Sides::front), Status::file, "not a regular file");
  CHECK(mkfifo(folder.file("fifo.obj").c_str(), 0600) == 0);
  CHECK_FAILS(hrad::load_obj(s, folder.file("fifo.obj"), Sides::front), Status::file, "regular");
}

void sides() {
  SceneFolder folder;
  folder.put("a.mtl", "newmtl a\nKd .1\n");
  const std::string text = "mtllib a.mtl\n" + square + "f 1 2 3\nusemtl a\nf 1 2 3 4\n";
  Scene s = folder.load(text, Sides::two_sided);
  CHECK(s.materials[0].two_sided && s.materials[1].two_sided);
  for (int64_t i = 0; i < 3; ++i) CHECK(s.has(i, hrad::patch_two_sided));
  s = folder.load(text, Sides::flip);
  CHECK((s.corners[0] == Corners{0, 2, 1}));
  CHECK((s.corners[2] == Corners{0, 3, 2}));
  CHECK(!s.has(0, hrad::patch_two_sided));
}

void bands() {
  SceneFolder folder;
  folder.put("a.mtl", "newmtl a\nKd .1 .2 .6\nKe 1 2 6\nnewmtl b\nKd 0.7 0.7 0.7\n");
  const std::string text = "mtllib a.mtl\n" + square + "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 3\n";
  const Scene s = folder.load(text, Sides::front, 1);
  CHECK_EQUAL(s.reflectance.size(), size_t{2});
  CHECK_NEAR(s.reflectance[0], 0.3, 1e-15);
  CHECK_EQUAL(s.emission[0], 3.0);
  CHECK_EQUAL(s.reflectance[1], 0.7);
  CHECK_FAILS(folder.load(text, Sides::front, 2), Status::argument, "bands = 3, or bands = 1");
}

void adds_to_a_scene_or_changes_nothing() {
  SceneFolder folder;
  folder.put("a.mtl", "newmtl a\nKd .1\nKe 1\n");
  Scene s = folder.load("mtllib a.mtl\n" + square + "usemtl a\nf 1 2 3\n");
  hrad::load_obj(s, folder.put("second.obj", square + "f 1 2 3 4\n"), Sides::front);
  CHECK_EQUAL(s.patch_count(), int64_t{3});
  CHECK((s.corners[1] == Corners{4, 5, 6}));
  CHECK((s.material == std::vector<int32_t>{0, 1, 1}));
  CHECK((s.face == std::vector<int64_t>{0, 0, 0}));
  CHECK_EQUAL(s.vertices.size(), size_t{8});
  const size_t diagnostics = s.diagnostics.size();
  const std::string bad = folder.put("bad.obj", "mtllib a.mtl\n" + square + "f 1 2 3\nf 1 2 7\n");
  CHECK_FAILS(hrad::load_obj(s, bad, Sides::front), Status::scene, "bad.obj:7");
  CHECK_EQUAL(s.patch_count(), int64_t{3});
  CHECK_EQUAL(s.vertices.size(), size_t{8});
  CHECK_EQUAL(s.materials.size(), size_t{2});
  CHECK_EQUAL(s.diagnostics.size(), diagnostics);
}

void marks() {
  SceneFolder folder;
  folder.put("a.mtl",
             "newmtl a\n# hrad: two-sided\nnewmtl b\n# hrad: blocker \nnewmtl c\nKe 1\n"
             "# hrad two-sided\n#hrad: blocker\n # hrad: blocker\n");
  const std::string text =
      square + "mtllib a.mtl\nusemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\nusemtl c\nf 1 3 4\n";
  Scene s = folder.load(text);
  CHECK((s.flags == std::vector<uint8_t>{hrad::patch_two_sided, hrad::patch_blocker, 0}));
  CHECK(!s.z_up);
  s = folder.load("# hrad: z-up\n" + text, Sides::two_sided);
  CHECK((s.flags ==
         std::vector<uint8_t>{hrad::patch_two_sided, hrad::patch_blocker, hrad::patch_two_sided}));
  CHECK(s.z_up);
  CHECK_FAILS(folder.load("\n# hrad: two-sided\n" + text), Status::scene,
              "scene.obj:2: the mark 'two-sided' is unknown");
}

void dark_and_empty_scenes() {
  SceneFolder folder;
  const Scene dark = folder.load(square + "f 1 2 3\n");  // said by the solver, as of any scene
  CHECK_EQUAL(count_diagnostics(dark, "emit"), 0);
  const Scene s = folder.load("");
  CHECK_EQUAL(s.patch_count(), int64_t{0});
  CHECK_EQUAL(count_diagnostics(s, "there are no faces"), 1);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(faces_and_their_numbers),
      HRAD_TEST(concave_faces_keep_their_shape),
      HRAD_TEST(forms_of_corners),
      HRAD_TEST(wrong_corners),
      HRAD_TEST(repeated_corners),
      HRAD_TEST(faces_that_cross_themselves),
      HRAD_TEST(numbers_of_vertices),
      HRAD_TEST(the_locale_means_nothing),
      HRAD_TEST(lines_and_blanks),
      HRAD_TEST(other_statements),
      HRAD_TEST(materials_by_name),
      HRAD_TEST(material_files),
      HRAD_TEST(missing_and_forbidden_material_files),
      HRAD_TEST(files_that_cannot_be_read),
      HRAD_TEST(sides),
      HRAD_TEST(bands),
      HRAD_TEST(adds_to_a_scene_or_changes_nothing),
      HRAD_TEST(marks),
      HRAD_TEST(dark_and_empty_scenes),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
