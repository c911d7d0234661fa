// Fuzz target: a sequence of calls of the C interface, drawn from the bytes with their arguments,
// good and bad, in any order, also with files. Every status must be one of the header's, every
// error have a message, and every number that comes out be one.
#include <hrad/hrad.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "fuzz/places.h"
#include "fuzz/target.h"

namespace {

class Bytes {
 public:
  Bytes(const uint8_t* data, size_t size) : data_(data), size_(size) {}
  bool empty() const { return at_ >= size_; }
  uint8_t byte() { return empty() ? 0 : data_[at_++]; }
  // Small numbers of either sign, now and then one of the largest.
  int64_t count() {
    const uint8_t b = byte();
    if (b == 255) return INT64_MAX;
    if (b == 254) return INT64_MIN;
    return static_cast<int8_t>(b);
  }
  double real() {
    static const double odd[] = {0,    -0.0, 1,     -1,       0.5,       1e-30, 1e30,
                                 1e31, 1e9,  1e-12, INFINITY, -INFINITY, NAN,   1e300};
    const uint8_t b = byte();
    return b < 240 ? (b - 100) / 40.0 : odd[b % (sizeof odd / sizeof odd[0])];
  }

 private:
  const uint8_t* data_;
  size_t size_, at_ = 0;
};

constexpr int64_t most_values = 4096;

void check(hrad_status status) {
  if (std::strcmp(hrad_status_name(status), "HRAD_UNKNOWN") == 0) std::abort();
  if (status < 0 && !*hrad_error_message()) std::abort();
  if (status == HRAD_ERROR_INTERNAL) std::abort();
}

int32_t stop_soon(const hrad_progress* progress, void* user) {
  if (!(progress->fraction >= 0 && progress->fraction <= 1)) std::abort();
  return --*static_cast<int*>(user) <= 0;
}

void hear(int32_t level, const char* message, void* user) {
  if (level < HRAD_LOG_ERROR || level > HRAD_LOG_DEBUG || !*message) std::abort();
  ++*static_cast<int64_t*>(user);
}

class Calls {
 public:
  explicit Calls(Bytes bytes) : bytes_(bytes), values_(most_values) {
    check(hrad_create(&solver_));
  }
  ~Calls() {
    hrad_destroy(&solver_);
    hrad_test::Places::get().tidy();
  }

  void run() {
    check(hrad_set_int(solver_, "threads", 1));
    // Quick solves: coarse, and no part smaller than this.
    check(hrad_set_double(solver_, "accuracy", 0.5));
    check(hrad_set_double(solver_, "min_area", 0.5));
    check(hrad_set_double(solver_, "tolerance", 1));
    int solves = 2;
    while (!bytes_.empty()) call(solves);
  }

 private:
  void call(int& solves) {
    const int32_t quantity = bytes_.byte() % 6 - 1, side = bytes_.byte() % 4 - 1;
    switch (bytes_.byte() % 22) {
      case 0:
        return add_material();
      case 1:
        return add_patches();
      case 2:
        return check(hrad_partition(solver_));
      case 3:
        if (solves-- > 0) check(hrad_solve(solver_));
        return;
      case 4:
        return query_patches(quantity, side);
      case 5:
        return query_point(quantity, side);
      case 6:
        return query_sensor();
      case 7:
        return query_leaves();
      case 8:
        return set_values();
      case 9:
        return set_parameter();
      case 10:
        return describe();
      case 11:
        return check(hrad_make_scene(solver_, bytes_.byte() % 2 ? "furnace" : "none"));
      case 12:
        stop_after_ = bytes_.byte() % 8;
        return check(
            hrad_set_progress(solver_, bytes_.byte() % 2 ? stop_soon : nullptr, &stop_after_));
      case 13:
        return hrad_request_stop(solver_);
      case 14:
        return balance();
      case 15:
        return check(hrad_write_checkpoint(solver_, to_write()));
      case 16:
        return check(hrad_load_scene(solver_, to_read()));
      case 17:
        return check(hrad_export(solver_, to_write()));
      case 18:
        return check(hrad_read_checkpoint(solver_, to_read()));
      case 19:
        return check(hrad_lock_checkpoint(solver_, to_write()));
      case 20:
        return set_log();
      default:
        return describe_checkpoint();
    }
  }

  const char* to_read() { return hrad_test::Places::get().to_read(bytes_.byte()); }
  const char* to_write() { return hrad_test::Places::get().to_write(bytes_.byte()); }

  void set_log() {
    const auto level = static_cast<int32_t>(bytes_.byte() % 6 - 1);
    check(hrad_set_log(solver_, bytes_.byte() % 4 ? hear : nullptr, &heard_, level));
  }

  void describe_checkpoint() {
    char text[64];
    int64_t needed = 0;
    const char* file = to_read();
    const int64_t size = bytes_.byte() % 66 - 1;
    check(hrad_describe_checkpoint(file, bytes_.byte() % 8 ? text : nullptr, size, &needed));
  }

  void add_material() {
    double reflectance[16], emission[16];
    for (double& r : reflectance) r = bytes_.real();
    for (double& e : emission) e = bytes_.real();
    hrad_material m{};
    m.struct_size = bytes_.byte() % 3 ? sizeof m : bytes_.byte();
    m.reflectance = bytes_.byte() % 4 ? reflectance : nullptr;
    m.emission = bytes_.byte() % 4 ? emission : nullptr;
    m.flags = bytes_.byte() % 5;
    // More than sizeof means a newer header, whose tail is not ours to read.
    check(hrad_add_material(solver_, &m, nullptr));
  }

  void add_patches() {
    const int vertices = bytes_.byte() % 9, triangles = bytes_.byte() % 9;
    std::vector<double> xyz(3 * vertices);
    std::vector<int64_t> vertex(3 * triangles);
    std::vector<int32_t> material(triangles);
    for (double& x : xyz) x = bytes_.real();
    for (int64_t& v : vertex) v = bytes_.byte() % (vertices + 1);
    for (int32_t& m : material) m = bytes_.byte() % 4 - 1;
    check(hrad_add_patches(solver_, vertices, xyz.data(), triangles, vertex.data(),
                           bytes_.byte() % 2 ? material.data() : nullptr));
  }

  // All values of an array of `count` items, as far as they are asked for.
  void look(hrad_status status, int64_t values) {
    check(status);
    for (int64_t i = 0; status >= 0 && i < values; ++i)
      if (!std::isfinite(values_[i])) std::abort();
  }

  int64_t bands() {
    int64_t bands = 0;
    check(hrad_get_int(solver_, "bands", &bands));
    return bands;
  }

  // A count that the buffer can hold, or one that must be refused.
  int64_t fitting_count() {
    const int64_t count = bytes_.count();
    return count > 100 && count != INT64_MAX ? 100 : count;
  }

  void query_patches(int32_t quantity, int32_t side) {
    const int64_t first = bytes_.count(), count = fitting_count();
    look(hrad_query_patches(solver_, quantity, side, first, count, values_.data()),
         count * (count > 0 && count <= 100 ? bands() : 0));
  }

  void query_point(int32_t quantity, int32_t side) {
    const int64_t patch = bytes_.count();
    const double uv[2] = {bytes_.real(), bytes_.real()};
    look(hrad_query_points(solver_, quantity, side, 1, &patch, uv, values_.data()), bands());
  }

  void query_sensor() {
    double at[3], normal[3];
    for (double& x : at) x = bytes_.real();
    for (double& x : normal) x = bytes_.real();
    look(hrad_query_sensors(solver_, 1, at, normal, values_.data(), nullptr), bands());
  }

  void query_leaves() {
    const int64_t first = bytes_.count(), count = fitting_count();
    look(hrad_query_leaves(solver_, first, count, nullptr, nullptr, nullptr, nullptr, nullptr,
                           values_.data()),
         count * (count > 0 && count <= 100 ? bands() : 0));
  }

  void set_values() {
    const int64_t first = bytes_.count(), count = fitting_count();
    for (int i = 0; i < 16; ++i) values_[i] = bytes_.real();
    check(bytes_.byte() % 2 ? hrad_set_emission(solver_, first, count, values_.data())
                            : hrad_set_reflectance(solver_, first, count, values_.data()));
  }

  void set_parameter() {
    static const char* const names[] = {"bands", "accuracy", "linking",        "oracle",
                                        "seed",  "unit",     "max_iterations", "visibility",
                                        "sides", "nothing"};
    static const char* const texts[] = {"1",      "3", "16", "0.5", "pairs",
                                        "energy", "m", "-1", "x",   ""};
    const char* name = names[bytes_.byte() % 10];
    const char* text = texts[bytes_.byte() % 10];
    // Finer than 0.3 a solve takes long.
    if (std::strcmp(name, "accuracy") == 0 && std::atof(text) < 0.3) return;
    check(hrad_set_text(solver_, name, text));
  }

  void describe() {
    char text[64];
    int64_t needed = 0;
    check(hrad_get_diagnostic(solver_, bytes_.count(), text, bytes_.byte() % 65, &needed));
    check(hrad_describe_machine(solver_, text, bytes_.byte() % 65, &needed));
    hrad_patch patch{};
    patch.struct_size = bytes_.byte() % 2 ? sizeof patch : bytes_.byte() % sizeof patch;
    check(hrad_get_patch(solver_, bytes_.count(), &patch));
    hrad_stats stats{};
    stats.struct_size = bytes_.byte() % 2 ? sizeof stats : bytes_.byte();
    check(hrad_get_stats(solver_, &stats));
    if (bytes_.byte() % 4) return;  // it closes the scene
    hrad_rank_load loads[4] = {};
    loads[0].struct_size = bytes_.byte() % 2 ? sizeof *loads : bytes_.byte() % sizeof *loads;
    check(hrad_plan_partition(solver_, bytes_.byte() % 2 ? "cost" : "grid",
                              static_cast<int32_t>(bytes_.byte() % 5), nullptr, loads));
  }

  void balance() {
    const int64_t n = bands();
    look(hrad_power_balance(solver_, &values_[0], &values_[n], &values_[2 * n], &values_[3 * n]),
         4 * n);
  }

  Bytes bytes_;
  hrad_solver* solver_ = nullptr;
  std::vector<double> values_;
  int stop_after_ = 0;
  int64_t heard_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  // A machine that is quickly looked at.
  setenv("HWLOC_SYNTHETIC", "pack:1 core:1 pu:1", 1);
  Calls calls(Bytes(data, size < 2000 ? size : 2000));
  calls.run();
  return 0;
}
