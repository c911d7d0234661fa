// hrad.h, section "query". All arguments are checked, those of all ranks, before the first output
// is written. Floor 9 (api).
#include <algorithm>
#include <cmath>

#include "api/arguments.h"
#include "api/guard.h"

namespace {

using hrad::Status;

// How far a point may lie outside its patch by rounding.
constexpr double kPointMargin = 1e-9;
constexpr int kMostBands = 16;

hrad::Quantity checked_quantity(int32_t quantity) {
  if (quantity < HRAD_RADIOSITY || quantity > HRAD_NET_FLUX)
    hrad::fail(Status::argument,
               "the quantity is %d: it must be HRAD_RADIOSITY, HRAD_IRRADIANCE, HRAD_EMISSION or "
               "HRAD_NET_FLUX",
               static_cast<int>(quantity));
  return static_cast<hrad::Quantity>(quantity);
}

void check_side(int32_t side) {
  if (side != HRAD_FRONT && side != HRAD_BACK)
    hrad::fail(Status::argument, "the side is %d: it must be HRAD_FRONT or HRAD_BACK",
               static_cast<int>(side));
}

void check_points(const hrad::Scene& scene, int64_t count, const int64_t* patch, const double* uv) {
  for (int64_t i = 0; i < count; ++i) {
    if (patch[i] < 0 || patch[i] >= scene.patch_count())
      hrad::fail(Status::argument, "point %lld is on patch %lld: there are %lld, from 0 on",
                 static_cast<long long>(i), static_cast<long long>(patch[i]),
                 static_cast<long long>(scene.patch_count()));
    const double u = uv[2 * i], v = uv[2 * i + 1];
    // Written so that a value that is not a number fails.
    if (!(u >= -kPointMargin && v >= -kPointMargin && u + v <= 1 + kPointMargin))
      hrad::fail(Status::argument,
                 "point %lld has u = %g, v = %g: they must be at least 0 and u + v at most 1",
                 static_cast<long long>(i), u, v);
  }
}

void check_sensors(int64_t count, const double* xyz, const double* normal) {
  for (int64_t i = 0; i < count; ++i) {
    const double* n = normal + 3 * i;
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(xyz[3 * i + axis]) || !std::isfinite(n[axis]))
        hrad::fail(Status::argument, "sensor %lld has a coordinate that is not finite",
                   static_cast<long long>(i));
    if (n[0] == 0 && n[1] == 0 && n[2] == 0)
      hrad::fail(Status::argument, "sensor %lld has the normal (0, 0, 0): it needs a direction",
                 static_cast<long long>(i));
  }
}

// Where the arrays of hrad_query_leaves go on for leaf `index`; NULL stays NULL.
template <class Value>
Value* at(Value* array, int64_t index, int values = 1) {
  return array ? array + index * values : nullptr;
}

void copy_leaf(const hrad::LeafView& leaf, int64_t* patch, int64_t* face, int32_t* side,
               double* corners_xyz, double* area) {
  if (patch) *patch = leaf.patch;
  if (face) *face = leaf.face;
  if (side) *side = leaf.side;
  if (area) *area = leaf.area;
  if (!corners_xyz) return;
  for (const hrad::Vec3& corner : {leaf.corners.a, leaf.corners.b, leaf.corners.c})
    for (int axis = 0; axis < 3; ++axis) *corners_xyz++ = corner[axis];
}

}  // namespace

hrad_status hrad_query_patches(const hrad_solver* solver, int32_t quantity, int32_t side,
                               int64_t first, int64_t count, double* out) {
  return hrad::api::collective(solver, [&](const hrad::Solver& inside) {
    const hrad::Quantity wanted = checked_quantity(quantity);
    check_side(side);
    hrad::api::require_array(out, count, "out");
    hrad::api::require_range(first, count, inside.scene().patch_count(), "patches");
    inside.query_patches(wanted, side, first, count, out);
  });
}

hrad_status hrad_query_points(const hrad_solver* solver, int32_t quantity, int32_t side,
                              int64_t count, const int64_t* patch, const double* uv, double* out) {
  return hrad::api::collective(solver, [&](const hrad::Solver& inside) {
    const hrad::Quantity wanted = checked_quantity(quantity);
    check_side(side);
    hrad::api::require_array(patch, count, "patch");
    hrad::api::require_array(uv, count, "uv");
    hrad::api::require_array(out, count, "out");
    check_points(inside.scene(), count, patch, uv);
    inside.query_points(wanted, side, count, patch, uv, out);
  });
}

hrad_status hrad_query_sensors(const hrad_solver* solver, int64_t count, const double* xyz,
                               const double* normal, double* irradiance, double* standard_error) {
  return hrad::api::collective(solver, [&](const hrad::Solver& inside) {
    hrad::api::require_array(xyz, count, "xyz");
    hrad::api::require_array(normal, count, "normal");
    hrad::api::require_array(irradiance, count, "irradiance");
    check_sensors(count, xyz, normal);
    inside.query_sensors(count, xyz, normal, irradiance, standard_error);
  });
}

hrad_status hrad_leaf_count(const hrad_solver* solver, int64_t* count) {
  return hrad::api::collective(solver, [&](const hrad::Solver& inside) {
    hrad::api::require(count, "the place for the count");
    const int64_t found = inside.leaf_count();
    inside.comm().all_go_on();
    *count = found;
  });
}

hrad_status hrad_query_leaves(const hrad_solver* solver, int64_t first, int64_t count,
                              int64_t* patch, int64_t* face, int32_t* side, double* corners_xyz,
                              double* area, double* radiosity) {
  return hrad::api::collective(solver, [&](const hrad::Solver& inside) {
    hrad::api::require_range(first, count, inside.leaf_count(), "leaves");
    inside.comm().all_go_on();
    inside.prepare_leaves();
    const int bands = inside.scene().bands;
    for (int64_t i = 0; i < count; ++i) {
      copy_leaf(inside.leaf(first + i), at(patch, i), at(face, i), at(side, i),
                at(corners_xyz, i, 9), at(area, i));
      if (radiosity)
        inside.leaf_values(first + i, hrad::Quantity::radiosity, at(radiosity, i, bands));
    }
  });
}

hrad_status hrad_power_balance(const hrad_solver* solver, double* emitted, double* absorbed,
                               double* absorbed_back, double* escaped) {
  return hrad::api::collective(solver, [&](const hrad::Solver& inside) {
    double terms[4][kMostBands] = {};
    inside.power_balance(terms[0], terms[1], terms[2], terms[3]);
    double* const outputs[4] = {emitted, absorbed, absorbed_back, escaped};
    for (int term = 0; term < 4; ++term)
      if (outputs[term]) std::copy_n(terms[term], inside.scene().bands, outputs[term]);
  });
}
