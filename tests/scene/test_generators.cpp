// The built-in scenes: exact sizes, sound solids, light where it should be.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/error.h"
#include "scene/generate_polyhedron.h"
#include "scene/load.h"
#include "scene/mesh_checks.h"
#include "support/check.h"

using namespace hrad;
using namespace hrad_test;

namespace {

constexpr const char* names_in_order[] = {
    "building",       "building-x10", "building-x100",  "classroom",      "classroom-x10",
    "classroom-x100", "cornell",      "furnace",        "furnace-sphere", "furnace-boxes",
    "furnished-room", "box-in-box",   "parallel-plates"};

constexpr const char* small_scenes[] = {"building",       "classroom",     "cornell",
                                        "furnace",        "furnace-boxes", "furnace-sphere",
                                        "furnished-room", "box-in-box",    "parallel-plates"};

Scene make(const std::string& name, int bands = 3) {
  Scene scene;
  scene.bands = bands;
  make_builtin_scene(scene, name);
  return scene;
}

double area(const Scene& scene, int64_t patch) {
  return length(scene.triangle(patch).area_vector()) / 2;
}

bool emits(const Scene& scene, int64_t patch) { return scene.emission[patch * scene.bands] > 0; }

// The emitting patches, two to a lamp, all of them facing down.
int64_t count_lamps(const Scene& scene) {
  int64_t emitters = 0;
  for (int64_t patch = 0; patch < scene.patch_count(); ++patch) {
    if (!emits(scene, patch)) continue;
    CHECK_NEAR(normalized(scene.triangle(patch).area_vector()).z, -1, 1e-12);
    ++emitters;
  }
  CHECK_EQUAL(emitters % 2, 0);
  return emitters / 2;
}

void names() {
  int64_t index = 0;
  for (const char* name : names_in_order) CHECK(std::string(builtin_scene_name(index++)) == name);
  CHECK(builtin_scene_name(index) == nullptr);
  CHECK(builtin_scene_name(-1) == nullptr);
  Scene scene;
  CHECK_FAILS(make_builtin_scene(scene, "attic"), Status::argument, "parallel-plates");
  CHECK_EQUAL(scene.patch_count() + static_cast<int64_t>(scene.materials.size()), 0);
}

void sizes() {
  CHECK_EQUAL(make("building").patch_count(), 2880);
  CHECK_EQUAL(make("building-x10").patch_count(), 28800);
  CHECK_EQUAL(make("building-x100").patch_count(), 288000);
  CHECK_EQUAL(make("classroom").patch_count(), 9253);
  CHECK_EQUAL(make("classroom-x10").patch_count(), 92530);
  CHECK_EQUAL(make("classroom-x100").patch_count(), 925300);
  CHECK(make("furnished-room").patch_count() < 1000);
}

void lamps() {
  CHECK_EQUAL(count_lamps(make("building")), 20);
  CHECK_EQUAL(count_lamps(make("building-x10")), 200);
  CHECK_EQUAL(count_lamps(make("building-x100")), 2000);
  CHECK_EQUAL(count_lamps(make("classroom")), 12);
  CHECK_EQUAL(count_lamps(make("classroom-x10")), 105);
  CHECK_EQUAL(count_lamps(make("classroom-x100")), 1050);
  CHECK_EQUAL(count_lamps(make("furnished-room")), 1);
  CHECK_EQUAL(count_lamps(make("cornell")), 1);
}

void bands() {
  const Scene one = make("cornell", 1), three = make("cornell", 3), five = make("cornell", 5);
  for (int64_t patch = 0; patch < three.patch_count(); ++patch) {
    const double *rgb = &three.reflectance[patch * 3], *light = &three.emission[patch * 3];
    CHECK_NEAR(one.reflectance[patch], (rgb[0] + rgb[1] + rgb[2]) / 3, 1e-15);
    CHECK_NEAR(one.emission[patch], (light[0] + light[1] + light[2]) / 3, 1e-15);
    for (int band = 0; band < 5; ++band) {
      CHECK_EQUAL(five.reflectance[patch * 5 + band], rgb[band % 3]);
      CHECK_EQUAL(five.emission[patch * 5 + band], light[band % 3]);
    }
  }
}

void same_bytes_twice() {
  for (const char* name : names_in_order) {
    const Scene a = make(name), b = make(name);
    CHECK(a.corners == b.corners && a.material == b.material && a.flags == b.flags);
    CHECK(a.reflectance == b.reflectance && a.emission == b.emission && a.face == b.face);
    CHECK_EQUAL(a.vertices.size(), b.vertices.size());
    CHECK(std::memcmp(a.vertices.data(), b.vertices.data(), a.vertices.size() * sizeof(Vec3)) == 0);
  }
}

// Rooms are closed with fronts inward, everything else closed with fronts outward, but for the open
// pieces that a scene is meant to have.
void check_solids(const Scene& scene, int rooms, int open) {
  int found_rooms = 0, found_open = 0;
  Box inside;
  for (const Component& solid : components(scene)) {
    if (!solid.closed) {
      ++found_open;
    } else if (solid.volume < 0) {
      ++found_rooms;
      inside.grow(solid.box);
    } else {
      CHECK(solid.volume > 1e-9);
    }
  }
  CHECK_EQUAL(found_rooms, rooms);
  CHECK_EQUAL(found_open, open);
  if (rooms == 0) return;
  const Box all = scene.bounds();
  CHECK(length(all.low - inside.low) + length(all.high - inside.high) == 0);
}

void solids() {
  check_solids(make("building"), 1, 0);
  check_solids(make("building-x10"), 2, 0);
  check_solids(make("building-x100"), 5, 0);
  check_solids(make("classroom"), 1, 1);
  check_solids(make("classroom-x10"), 1, 10);
  check_solids(make("classroom-x100"), 1, 100);
  check_solids(make("cornell"), 0, 2);
  check_solids(make("furnace"), 1, 0);
  check_solids(make("furnace-sphere"), 1, 0);
  check_solids(make("furnace-boxes"), 1, 0);
  check_solids(make("furnished-room"), 1, 0);
  check_solids(make("box-in-box"), 1, 0);
  check_solids(make("parallel-plates"), 0, 2);
}

// The open pieces of the classrooms are two-sided pennants, of the Cornell box the walls and the
// light; nothing else is two-sided.
void two_sided() {
  for (const char* name : small_scenes) {
    const Scene scene = make(name);
    const bool classroom = std::string(name) == "classroom";
    for (const Component& solid : components(scene)) {
      const bool pennant = classroom && !solid.closed;
      if (pennant) CHECK_EQUAL(solid.patches.size(), size_t{1});
      for (const int64_t patch : solid.patches)
        CHECK_EQUAL(scene.has(patch, patch_two_sided), pennant);
    }
  }
}

void no_slivers() {
  for (const char* name : names_in_order) {
    const Scene scene = make(name);
    for (int64_t patch = 0; patch < scene.patch_count(); ++patch) {
      const Triangle t = scene.triangle(patch);
      const double longest = std::max({length(t.b - t.a), length(t.c - t.b), length(t.a - t.c)});
      CHECK(2 * area(scene, patch) / longest >= 0.005);  // half a notebook
    }
  }
}

// The checks below see what they look for.
void checks_see_faults() {
  Scene scene;
  const int32_t m = scene.add_material({});
  const BoxMaterials faces = all_faces(m);
  add_box(scene, {0, 0, 0}, {1000, 1000, 1000}, faces);
  add_box(scene, {200, 200, 500}, {600, 600, 1000}, faces);  // sunk in, tops flush
  add_box(scene, {200, 200, 800}, {600, 1600, 900}, faces);  // sticks out through a side
  add_box(scene, {1000, 0, 0}, {1500, 500, 500}, faces);     // touches a side
  double same = 0, opposite = 0;
  int pierced = 0;
  for_touching_pairs(scene, [&](int64_t i, int64_t j) {
    const Triangle s = scene.triangle(i), t = scene.triangle(j);
    bool same_facing = false;
    const double shared = shared_area(s, t, same_facing);
    // Boxes 1 and 2 share a part of their sides as well.
    if (i / 12 != 1 && j / 12 != 1) (same_facing ? same : opposite) += shared;
    if (i / 12 + j / 12 == 1) (same_facing ? same : opposite) += shared;
    pierced += i / 12 + j / 12 == 2 && i / 12 != j / 12 && (pierces(s, t) || pierces(t, s));
  });
  CHECK_NEAR(same, .16, 1e-12);
  CHECK_NEAR(opposite, .25, 1e-12);
  CHECK(pierced > 0);
  scene.corners.pop_back();
  for (const Component& solid : components(scene)) {
    CHECK_EQUAL(solid.closed, solid.patches.size() == 12);
    CHECK_EQUAL(solid.is_box(), solid.closed);
  }
}

// Touching is between opposite faces alone, and nothing passes through anything.
void no_overlaps() {
  for (const char* name : small_scenes) {
    const Scene scene = make(name);
    for_touching_pairs(scene, [&](int64_t i, int64_t j) {
      const Triangle s = scene.triangle(i), t = scene.triangle(j);
      bool same_facing = false;
      CHECK(shared_area(s, t, same_facing) < 1e-9 || !same_facing);
      CHECK(!pierces(s, t) && !pierces(t, s));
    });
    std::vector<Component> boxes;
    for (Component& solid : components(scene))
      if (solid.is_box()) boxes.push_back(std::move(solid));
    for (size_t i = 0; i < boxes.size(); ++i) {
      for (size_t j = i + 1; j < boxes.size(); ++j) {
        const Vec3 e =
            min(boxes[i].box.high, boxes[j].box.high) - max(boxes[i].box.low, boxes[j].box.low);
        CHECK(e.x < 1e-9 || e.y < 1e-9 || e.z < 1e-9);
      }
    }
  }
}

// Nothing floats but the lamps of the rooms where they hang.
void things_stand_on_things() {
  const std::pair<const char*, int> floating[] = {
      {"building", 20}, {"classroom", 1}, {"furnished-room", 1}, {"furnace-boxes", 0}};
  for (const auto& [name, wanted] : floating) {
    const Scene scene = make(name);
    const std::vector<Component> solids = components(scene);
    const std::vector<double> sealed = sealed_areas(scene, solids);
    CHECK_EQUAL(std::count_if(sealed.begin(), sealed.end(), [](double a) { return a < 1e-6; }),
                wanted);
  }
}

void furnace_boxes_seal_known_area() {
  const Scene scene = make("furnace-boxes");
  double both_sides = 0;
  for (const double a : sealed_areas(scene, components(scene))) both_sides += a;
  CHECK_NEAR(both_sides, 2 * (.8 * .7 + .6 * .7 + .6 * .6 + .4 * .4), 1e-12);
}

// Floods a horizontal slice of the building's air in cells of 10 cm, from the first lamp on;
// returns the number of lamps reached. Walls lie on cell sides, furniture is left out.
int64_t lamps_reached(const Scene& scene, const Component& shell, double eye) {
  constexpr double cell = 0.1;
  const auto index = [](double x) { return static_cast<int>(std::lround(x / cell)); };
  const int nx = index(shell.box.high.x), ny = index(shell.box.high.y);
  const double z = shell.box.low.z + eye;
  std::vector<uint8_t> wall_west(nx * ny), wall_south(nx * ny), wet(nx * ny);
  for (const int64_t patch : shell.patches) {
    const Triangle t = scene.triangle(patch);
    const Vec3 corner[3] = {t.a, t.b, t.c};
    std::vector<Vec3> cut;
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = corner[i], q = corner[(i + 1) % 3];
      if ((p.z < z) != (q.z < z)) cut.push_back(p + (q - p) * ((z - p.z) / (q.z - p.z)));
    }
    if (cut.size() != 2) continue;
    const Vec3 low = min(cut[0], cut[1]), high = max(cut[0], cut[1]);
    const bool along_y = high.x - low.x < 1e-9;
    // A cell's side is walled if its middle is.
    for (int y = index(low.y); along_y && index(low.x) < nx && y <= index(high.y) && y < ny; ++y)
      if ((y + .5) * cell > low.y && (y + .5) * cell < high.y) wall_west[y * nx + index(low.x)] = 1;
    for (int x = index(low.x); !along_y && index(low.y) < ny && x <= index(high.x) && x < nx; ++x)
      if ((x + .5) * cell > low.x && (x + .5) * cell < high.x)
        wall_south[index(low.y) * nx + x] = 1;
  }
  std::vector<int> lamp_cells, open;
  for (const Component& solid : components(scene)) {
    const Vec3 c = solid.box.center();
    const bool lamp = solid.is_box() && c.z > shell.box.low.z + 2.5 && c.z < shell.box.high.z;
    if (lamp)
      lamp_cells.push_back(static_cast<int>(c.y / cell) * nx + static_cast<int>(c.x / cell));
  }
  open.push_back(lamp_cells.at(0));
  wet[open[0]] = 1;
  const auto flow = [&](int to) {
    if (!wet[to]) open.push_back(to);
    wet[to] = 1;
  };
  while (!open.empty()) {
    const int at = open.back(), x = at % nx, y = at / nx;
    open.pop_back();
    if (x > 0 && !wall_west[at]) flow(at - 1);
    if (x + 1 < nx && !wall_west[at + 1]) flow(at + 1);
    if (y > 0 && !wall_south[at]) flow(at - nx);
    if (y + 1 < ny && !wall_south[at + nx]) flow(at + nx);
  }
  return std::count_if(lamp_cells.begin(), lamp_cells.end(), [&](int c) { return wet[c] != 0; });
}

void doors_join_rooms() {
  const Scene small = make("building"), large = make("building-x10");
  for (const Component& solid : components(small)) {
    if (solid.volume > 0) continue;
    CHECK_EQUAL(lamps_reached(small, solid, 1.5), 20);
    CHECK_EQUAL(lamps_reached(small, solid, 2.5), 1);  // over the doors rooms are apart
  }
  for (const Component& solid : components(large))
    if (solid.volume < 0) CHECK_EQUAL(lamps_reached(large, solid, 1.5), 100);
}

// Emitted power over absorbing area: the irradiance if light were spread evenly.
void rooms_are_lit() {
  for (const char* name : {"building", "building-x10", "building-x100", "classroom",
                           "classroom-x10", "classroom-x100", "furnished-room"}) {
    const Scene scene = make(name);
    double power = 0, absorbing = 0;
    for (int64_t patch = 0; patch < scene.patch_count(); ++patch) {
      power += area(scene, patch) * scene.emission[patch * 3 + 1];
      absorbing += area(scene, patch) * (1 - scene.reflectance[patch * 3 + 1]);
    }
    CHECK(power / absorbing > 1 && power / absorbing < 10);
  }
}

void closed_forms() {
  for (const char* name : {"furnace", "furnace-sphere", "furnace-boxes"}) {
    const Scene scene = make(name);
    for (const double e : scene.emission) CHECK_EQUAL(e, 1.0);
    for (const double r : scene.reflectance) CHECK_EQUAL(r, 0.5);
  }
  const Scene sphere = make("furnace-sphere");
  CHECK_EQUAL(sphere.patch_count(), 1280);
  for (const Vec3 v : sphere.vertices) CHECK_NEAR(length(v), 1, 1e-15);
  CHECK_NEAR(components(sphere)[0].volume, -4.18879, 0.05);
  const Scene boxes = make("box-in-box");
  double inner = 0, outer = 0;
  for (int64_t patch = 0; patch < boxes.patch_count(); ++patch)
    (emits(boxes, patch) ? inner : outer) += area(boxes, patch);
  CHECK_NEAR(inner, 6, 1e-12);
  CHECK_NEAR(outer, 54, 1e-12);
  const Scene plates = make("parallel-plates");
  for (int64_t patch = 0; patch < plates.patch_count(); ++patch)
    CHECK_NEAR(plates.triangle(patch).area_vector().z, emits(plates, patch) ? 1 : -1, 1e-15);
}

// Corners on straight lines (neighbours' corners) become triangles with area.
void triangulation() {
  const Outline outline = {{0, 0, 5},   {10, 0, 5},  {20, 0, 5},  {30, 0, 5},
                           {30, 10, 5}, {20, 10, 5}, {20, 20, 5}, {30, 20, 5},
                           {30, 30, 5}, {0, 30, 5},  {0, 20, 5},  {0, 10, 5}};
  for (const bool up : {true, false}) {
    const Outline turned = facing(outline, 2, up);
    const auto triangles = triangulate_outline(turned);
    CHECK_EQUAL(triangles.size(), outline.size() - 2);
    double sum = 0;
    for (const auto& [a, b, c] : triangles) {
      const double z =
          Triangle{metres(turned[a]), metres(turned[b]), metres(turned[c])}.area_vector().z;
      CHECK((z > 0) == up && std::fabs(z) > 1e-9);
      sum += std::fabs(z) / 2;
    }
    CHECK_NEAR(sum, 800e-6, 1e-12);
  }
  CHECK_FAILS(triangulate_outline({{0, 0, 0}, {10, 0, 0}, {20, 0, 0}}), Status::internal,
              "polygon");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(names),
      HRAD_TEST(sizes),
      HRAD_TEST(lamps),
      HRAD_TEST(bands),
      HRAD_TEST(same_bytes_twice),
      HRAD_TEST(solids),
      HRAD_TEST(two_sided),
      HRAD_TEST(no_slivers),
      HRAD_TEST(checks_see_faults),
      HRAD_TEST(no_overlaps),
      HRAD_TEST(things_stand_on_things),
      HRAD_TEST(furnace_boxes_seal_known_area),
      HRAD_TEST(doors_join_rooms),
      HRAD_TEST(rooms_are_lit),
      HRAD_TEST(closed_forms),
      HRAD_TEST(triangulation),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
