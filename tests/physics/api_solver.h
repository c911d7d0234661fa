// The library as the physics tests hold it: hrad.h behind an owner that throws on errors. Nothing
// here knows how it solves.
#pragma once

#include <hrad/hrad.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "physics/surfaces.h"

namespace physics {

struct Balance {
  double emitted = 0, absorbed = 0, absorbed_back = 0, escaped = 0;  // all bands together
};

class ApiSolver {
 public:
  explicit ApiSolver(int bands = 3) : bands_(bands) {
    check(hrad_create(&solver_));
    set("bands", bands);
  }
  ~ApiSolver() { hrad_destroy(&solver_); }
  ApiSolver(const ApiSolver&) = delete;
  ApiSolver& operator=(const ApiSolver&) = delete;

  hrad_solver* get() const { return solver_; }
  int bands() const { return bands_; }

  static hrad_status check(hrad_status status) {
    if (status < 0)
      throw std::runtime_error(std::string(hrad_status_name(status)) + ": " + hrad_error_message());
    return status;
  }

  void set(const char* name, int value) { check(hrad_set_int(solver_, name, value)); }
  void set(const char* name, double value) { check(hrad_set_double(solver_, name, value)); }
  void set(const char* name, const char* value) { check(hrad_set_text(solver_, name, value)); }

  int32_t add_material(Spectrum reflectance, Spectrum emission, int32_t flags = 0) {
    hrad_material material{};
    material.struct_size = sizeof material;
    material.reflectance = reflectance.value.data();
    material.emission = emission.value.data();
    material.flags = flags;
    int32_t number = -1;
    check(hrad_add_material(solver_, &material, &number));
    return number;
  }

  // Adds a polygon as a fan of triangles; returns the number of the first.
  int64_t add(const Polygon& polygon, int32_t material) {
    const int64_t first = size();
    std::vector<double> xyz;
    std::vector<int64_t> corners;
    for (const Vector& p : polygon) xyz.insert(xyz.end(), {p.x, p.y, p.z});
    const int64_t count = static_cast<int64_t>(polygon.size());
    for (int64_t i = 2; i < count; ++i) corners.insert(corners.end(), {0, i - 1, i});
    const std::vector<int32_t> materials(static_cast<size_t>(count - 2), material);
    check(
        hrad_add_patches(solver_, count, xyz.data(), count - 2, corners.data(), materials.data()));
    return first;
  }
  int64_t add(const std::vector<Polygon>& polygons, int32_t material) {
    const int64_t first = size();
    for (const Polygon& p : polygons) add(p, material);
    return first;
  }

  void make(const char* name) { check(hrad_make_scene(solver_, name)); }

  int64_t size() const {
    int64_t patches = 0;
    check(hrad_scene_size(solver_, &patches, nullptr));
    return patches;
  }
  hrad_patch patch(int64_t number) const {
    hrad_patch p{};
    p.struct_size = sizeof p;
    check(hrad_get_patch(solver_, number, &p));
    return p;
  }

  // Every patch gets this emission (blockers stay dark) and reflectance.
  void set_everywhere(double emission, double reflectance) {
    const std::vector<double> e(bands_, emission), r(bands_, reflectance);
    for (int64_t i = 0; i < size(); ++i) {
      if ((patch(i).flags & HRAD_PATCH_BLOCKER) != 0) continue;
      check(hrad_set_emission(solver_, i, 1, e.data()));
      check(hrad_set_reflectance(solver_, i, 1, r.data()));
    }
  }

  hrad_status solve() { return check(hrad_solve(solver_)); }

  hrad_stats stats() const {
    hrad_stats s{};
    s.struct_size = sizeof s;
    check(hrad_get_stats(solver_, &s));
    return s;
  }

  std::vector<Spectrum> patches(int32_t quantity, int32_t side = HRAD_FRONT) const {
    std::vector<double> values(static_cast<size_t>(size() * bands_));
    check(hrad_query_patches(solver_, quantity, side, 0, size(), values.data()));
    return spectra(values);
  }

  std::vector<Spectrum> points(int32_t quantity, int32_t side, const std::vector<int64_t>& patch,
                               const std::vector<double>& uv) const {
    std::vector<double> values(patch.size() * static_cast<size_t>(bands_));
    check(hrad_query_points(solver_, quantity, side, static_cast<int64_t>(patch.size()),
                            patch.data(), uv.data(), values.data()));
    return spectra(values);
  }

  // The mean of a quantity over `count` patches, weighted by area.
  Spectrum mean(int32_t quantity, int64_t first, int64_t count, int32_t side = HRAD_FRONT) const {
    const std::vector<Spectrum> values = patches(quantity, side);
    Spectrum total;
    double area = 0;
    for (int64_t i = first; i < first + count; ++i) {
      const double a = patch(i).area;
      total = total + values[i] * a;
      area += a;
    }
    return total * (1 / area);
  }

  Balance balance() const {
    std::vector<double> e(bands_), a(bands_), b(bands_), s(bands_);
    check(hrad_power_balance(solver_, e.data(), a.data(), b.data(), s.data()));
    Balance total;
    for (int k = 0; k < bands_; ++k) {
      total.emitted += e[k];
      total.absorbed += a[k];
      total.absorbed_back += b[k];
      total.escaped += s[k];
    }
    return total;
  }

  // The scene for the reference: reflectance as loaded with the materials, emission as it is now.
  std::vector<Surface> surfaces() const {
    const std::vector<Spectrum> emission = patches(HRAD_EMISSION);
    std::vector<Surface> result;
    for (int64_t i = 0; i < size(); ++i) {
      const hrad_patch p = patch(i);
      const double* x = p.corners_xyz;
      std::vector<double> reflectance(bands_);
      check(hrad_get_material(solver_, p.material, nullptr, 0, nullptr, reflectance.data(), nullptr,
                              nullptr));
      Spectrum r;
      for (int k = 0; k < bands_; ++k) r[k] = reflectance[k];
      Surface s =
          triangle({x[0], x[1], x[2]}, {x[3], x[4], x[5]}, {x[6], x[7], x[8]}, r, emission[i]);
      if ((p.flags & HRAD_PATCH_DROPPED) != 0) s.area = 0;
      s.two_sided = (p.flags & HRAD_PATCH_TWO_SIDED) != 0;
      s.blocker = (p.flags & HRAD_PATCH_BLOCKER) != 0;
      result.push_back(s);
    }
    return result;
  }

 private:
  std::vector<Spectrum> spectra(const std::vector<double>& values) const {
    std::vector<Spectrum> result(values.size() / static_cast<size_t>(bands_));
    for (size_t i = 0; i < result.size(); ++i)
      for (int k = 0; k < bands_; ++k) result[i][k] = values[i * static_cast<size_t>(bands_) + k];
    return result;
  }

  hrad_solver* solver_ = nullptr;
  int bands_;
};

}  // namespace physics
