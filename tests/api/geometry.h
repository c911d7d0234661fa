// Small scenes of triangles for the tests of odd geometry, and solving them with a look at every
// number that the library gives out.
#pragma once

#include <hrad/hrad.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/check.h"

namespace hrad_test {

constexpr double reflectance = 0.5;

struct Place {
  double x, y, z;
};

enum MaterialNumber : int32_t { dark = 0, lamp = 1, two_sided = 2 };

class Scene {
 public:
  void triangle(Place a, Place b, Place c, int32_t material) {
    for (Place p : {a, b, c}) {
      vertex_.push_back(static_cast<int64_t>(vertex_.size()));
      xyz_.insert(xyz_.end(), {p.x, p.y, p.z});
    }
    material_.push_back(material);
  }

  // A parallelogram; seen anticlockwise from where edge1 x edge2 points.
  void quad(Place at, Place edge1, Place edge2, int32_t material) {
    const auto sum = [](Place a, Place b) { return Place{a.x + b.x, a.y + b.y, a.z + b.z}; };
    const Place b = sum(at, edge1), d = sum(at, edge2), c = sum(b, edge2);
    triangle(at, b, c, material);
    triangle(at, c, d, material);
  }

  // Fronts outward.
  void box(Place low, Place high, int32_t material) {
    const double x = high.x - low.x, y = high.y - low.y, z = high.z - low.z;
    quad(low, {0, y, 0}, {x, 0, 0}, material);
    quad(low, {x, 0, 0}, {0, 0, z}, material);
    quad(low, {0, 0, z}, {0, y, 0}, material);
    quad(high, {-x, 0, 0}, {0, -y, 0}, material);
    quad(high, {0, 0, -z}, {-x, 0, 0}, material);
    quad(high, {0, -y, 0}, {0, 0, -z}, material);
  }

  // Turns the last `count` patches round.
  void flip_last(size_t count) {
    for (size_t i = material_.size() - count; i < material_.size(); ++i)
      std::swap(vertex_[3 * i + 1], vertex_[3 * i + 2]);
  }

  void scale_and_move(double factor, Place by) {
    for (size_t i = 0; i < xyz_.size(); i += 3) {
      xyz_[i] = xyz_[i] * factor + by.x;
      xyz_[i + 1] = xyz_[i + 1] * factor + by.y;
      xyz_[i + 2] = xyz_[i + 2] * factor + by.z;
    }
  }

  int64_t size() const { return static_cast<int64_t>(material_.size()); }

  void add_to(hrad_solver* solver, double emission = 1) const {
    const double none = 0;
    CHECK_EQUAL(hrad_set_int(solver, "bands", 1), HRAD_OK);
    for (int32_t number : {dark, lamp, two_sided}) {
      hrad_material m{};
      m.struct_size = sizeof m;
      m.reflectance = &reflectance;
      m.emission = number == lamp ? &emission : &none;
      m.flags = number == two_sided ? HRAD_TWO_SIDED : 0;
      CHECK_EQUAL(hrad_add_material(solver, &m, nullptr), HRAD_OK);
    }
    CHECK_EQUAL(hrad_add_patches(solver, static_cast<int64_t>(xyz_.size() / 3), xyz_.data(), size(),
                                 vertex_.data(), material_.data()),
                HRAD_OK);
  }

 private:
  std::vector<double> xyz_;
  std::vector<int64_t> vertex_;
  std::vector<int32_t> material_;
};

// The unit cube seen from within (patches 0 to 11) with a lamp under its ceiling (12 and 13).
inline Scene room() {
  Scene scene;
  scene.box({0, 0, 0}, {1, 1, 1}, dark);
  scene.flip_last(12);
  scene.quad({.3, .3, .9}, {0, .4, 0}, {.4, 0, 0}, lamp);
  return scene;
}

struct Solution {
  hrad_solver* solver = nullptr;
  std::vector<double> radiosity;                        // of the patches' fronts
  double absorbed = 0, absorbed_back = 0, escaped = 0;  // as shares of what is emitted
  double sealed = 0;                                    // share of all area

  Solution() { CHECK_EQUAL(hrad_create(&solver), HRAD_OK); }
  ~Solution() { hrad_destroy(&solver); }
  Solution(const Solution&) = delete;
  Solution& operator=(const Solution&) = delete;

  double balance() const { return absorbed + absorbed_back + escaped; }

  int count_diagnostics(const std::string& text) const {
    int count = 0;
    char found[512];
    for (int64_t i = 0; hrad_get_diagnostic(solver, i, found, sizeof found, nullptr) == HRAD_OK;
         ++i)
      count += std::string(found).find(text) != std::string::npos;
    return count;
  }

  // Solves and looks at every number that the library gives out.
  void solve(const Scene& scene, double emission = 1) {
    scene.add_to(solver, emission);
    CHECK_EQUAL(hrad_set_double(solver, "accuracy", 0.1), HRAD_OK);
    const hrad_status status = hrad_solve(solver);
    if (status < 0) throw Failure(hrad_error_message());
    const int64_t patches = scene.size();
    radiosity.resize(static_cast<size_t>(patches));
    for (int32_t side : {HRAD_FRONT, HRAD_BACK})
      for (int32_t quantity : {HRAD_IRRADIANCE, HRAD_EMISSION, HRAD_NET_FLUX, HRAD_RADIOSITY}) {
        CHECK_EQUAL(hrad_query_patches(solver, quantity, side, 0, patches, radiosity.data()),
                    HRAD_OK);
        for (double value : radiosity)
          CHECK(std::isfinite(value) && (value >= 0 || quantity == HRAD_NET_FLUX));
      }
    CHECK_EQUAL(
        hrad_query_patches(solver, HRAD_RADIOSITY, HRAD_FRONT, 0, patches, radiosity.data()),
        HRAD_OK);
    int64_t leaves = 0;
    CHECK_EQUAL(hrad_leaf_count(solver, &leaves), HRAD_OK);
    std::vector<double> area(leaves), values(leaves), corners(9 * leaves);
    CHECK_EQUAL(hrad_query_leaves(solver, 0, leaves, nullptr, nullptr, nullptr, corners.data(),
                                  area.data(), values.data()),
                HRAD_OK);
    for (int64_t i = 0; i < leaves; ++i)
      CHECK(std::isfinite(values[i]) && values[i] >= 0 && area[i] > 0);
    for (double x : corners) CHECK(std::isfinite(x));
    double emitted = 0;
    CHECK_EQUAL(hrad_power_balance(solver, &emitted, &absorbed, &absorbed_back, &escaped), HRAD_OK);
    if (emitted > 0) {
      absorbed /= emitted;
      absorbed_back /= emitted;
      escaped /= emitted;
    }
    hrad_stats stats{};
    stats.struct_size = sizeof stats;
    CHECK_EQUAL(hrad_get_stats(solver, &stats), HRAD_OK);
    sealed = stats.area > 0 ? stats.sealed_area / stats.area : 0;
    CHECK(std::isfinite(stats.error_estimate) && std::isfinite(sealed));
    CHECK_EQUAL(count_diagnostics("are sealed"), sealed > 0 ? 1 : 0);
  }
};

}  // namespace hrad_test
