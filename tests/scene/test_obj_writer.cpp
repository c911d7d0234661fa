// Written scenes read back the same, to the last bit.
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

#include "base/hash.h"
#include "scene_folder.h"

using hrad::Scene;
using hrad::Sides;
using hrad::Status;
using hrad_test::SceneFolder;

namespace {

double random_number(uint64_t i) { return hrad::unit_interval(hrad::mix(5, i)); }

// Triangles of random corners and materials, and some set apart; sheets and blockers.
Scene random_scene(int bands) {
  Scene s;
  s.bands = bands;
  uint64_t n = 0;
  const char* names[] = {"red", "red", "dark blue", "", "a#b", "red-1", "back\\slash", "grün"};
  for (const char* name : names) {
    hrad::Material m;
    m.name = name;
    for (int b = 0; b < bands; ++b) {
      m.reflectance.push_back(random_number(++n) * 0.9999);
      m.emission.push_back(n % 3 ? 0 : random_number(n) * 1e5);
    }
    m.two_sided = s.materials.size() % 3 == 1;
    s.add_material(m);
  }
  hrad::Material blocker;
  blocker.name = "blocker";
  blocker.reflectance.assign(bands, 0.25);
  blocker.blocker = true;
  s.add_material(blocker);
  s.z_up = true;
  s.materials[1].reflectance[0] = 0.9999999999999999;
  for (int i = 0; i < 60; ++i)
    s.add_vertex({random_number(++n) * 1e-7, random_number(++n) - 0.5, random_number(++n) * 1e9});
  for (int i = 0; i < 300; ++i)
    s.add_patch(hrad::mix(1, i) % 60, hrad::mix(2, i) % 60, hrad::mix(3, i) % 60,
                hrad::mix(4, i) % 8);
  for (int i = 0; i < 4; ++i) s.add_patch(i, i + 1, i + 2, 8);
  for (int i = 10; i < 40; ++i) {
    s.emission[i * bands] = i < 20 ? 5 : random_number(++n);
    s.reflectance[(i + 10) * bands] = 0.123456789012345678;
  }
  return s;
}

void check_same(const Scene& s, const Scene& t) {
  CHECK_EQUAL(s.patch_count(), t.patch_count());
  for (int64_t i = 0; i < s.patch_count(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const hrad::Vec3 p = s.vertices[s.corners[i][k]], q = t.vertices[t.corners[i][k]];
      CHECK(p.x == q.x && p.y == q.y && p.z == q.z);
    }
    CHECK_EQUAL(t.face[i], i);
  }
  CHECK(s.flags == t.flags);
  CHECK_EQUAL(s.z_up, t.z_up);
  CHECK(s.emission == t.emission);
  CHECK(s.reflectance == t.reflectance);
}

void the_same_bits(int bands) {
  SceneFolder folder;
  const Scene s = random_scene(bands);
  const std::string path = folder.file("my scene.v2.obj");
  hrad::write_obj(s, path);
  Scene t;
  t.bands = bands;
  hrad::load_obj(t, path, Sides::front);
  for (const std::string& d : t.diagnostics) hrad_test::failed(__FILE__, __LINE__, d);
  check_same(s, t);
  CHECK(access(folder.file("my scene.v2.mtl").c_str(), F_OK) == 0);
  // Once more: now nothing is set apart.
  hrad::write_obj(t, folder.file("again"));
  Scene u;
  u.bands = bands;
  hrad::load_obj(u, folder.file("again"), Sides::front);
  CHECK_EQUAL(u.materials.size(), t.materials.size());
  check_same(s, u);
}
void three_bands() { the_same_bits(3); }
void one_band() { the_same_bits(1); }

void names_are_words_and_unlike() {
  SceneFolder folder;
  hrad::write_obj(random_scene(3), folder.file("a.obj"));
  Scene t;
  hrad::load_obj(t, folder.file("a.obj"), Sides::front);
  const char* wanted[] = {"red", "red-2", "dark_blue",  "material",
                          "a_b", "red-1", "back_slash", "grün"};
  for (int i = 0; i < 8; ++i) {
    if (t.materials[i].name != wanted[i])
      hrad_test::failed(__FILE__, __LINE__, t.materials[i].name + ", not " + wanted[i]);
  }
}

// What the formats can't say stands in comments, which other programs skip.
void marks_are_comments() {
  SceneFolder folder;
  Scene s = random_scene(3);
  hrad::write_obj(s, folder.file("a.obj"));
  CHECK(folder.content("a.obj").rfind("# hrad: z-up\n", 0) == 0);
  const std::string mtl = folder.content("a.mtl");
  CHECK(mtl.find("\n# hrad: two-sided\n") != std::string::npos);
  CHECK(mtl.find("\n# hrad: blocker\n") != std::string::npos);
  s.z_up = false;
  hrad::write_obj(s, folder.file("a.obj"));
  CHECK(folder.content("a.obj").find('#') == std::string::npos);
}

void what_cannot_be_written() {
  SceneFolder folder;
  Scene s = random_scene(3);
  CHECK_FAILS(hrad::write_obj(s, folder.file("no/a.obj")), Status::file, "No such file");
  CHECK_FAILS(hrad::write_obj(s, folder.file("a.mtl")), Status::argument, "a.mtl");
  CHECK_FAILS(hrad::write_obj(s, folder.file("a #b.obj")), Status::file, "can't refer to");
  CHECK(access(folder.file("a #b.obj").c_str(), F_OK) != 0);
  CHECK(mkdir(folder.file("b.mtl").c_str(), 0700) == 0);
  CHECK_FAILS(hrad::write_obj(s, folder.file("b.obj")), Status::file, "b.mtl: cannot create");
  CHECK(access(folder.file("b.obj").c_str(), F_OK) != 0);
  s.bands = 2;
  CHECK_FAILS(hrad::write_obj(s, folder.file("a.obj")), Status::argument, "1 or 3 bands");
}

void a_failed_write_leaves_the_old_files() {
  SceneFolder folder;
  folder.put("a.obj", "old obj");
  folder.put("a.mtl", "old mtl");
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before;
  CHECK(getrlimit(RLIMIT_FSIZE, &before) == 0);
  rlimit small = before;
  small.rlim_cur = 6000;  // enough for the materials alone
  CHECK(setrlimit(RLIMIT_FSIZE, &small) == 0);
  CHECK_FAILS(hrad::write_obj(random_scene(3), folder.file("a.obj")), Status::file, "too large");
  CHECK(setrlimit(RLIMIT_FSIZE, &before) == 0);
  CHECK(folder.content("a.obj") == "old obj");
  CHECK(folder.content("a.mtl") == "old mtl");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(three_bands),
      HRAD_TEST(one_band),
      HRAD_TEST(names_are_words_and_unlike),
      HRAD_TEST(marks_are_comments),
      HRAD_TEST(what_cannot_be_written),
      HRAD_TEST(a_failed_write_leaves_the_old_files),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
