// The smallest C++ program that uses the library.
#include <hrad/hrad.h>

#include <cstdio>
#include <memory>

struct Destroy {
  void operator()(hrad_solver* solver) const { hrad_destroy(&solver); }
};

int main() {
  hrad_solver* made = nullptr;
  if (hrad_create(&made) != HRAD_OK) return 1;
  const std::unique_ptr<hrad_solver, Destroy> solver(made);
  double power[3];
  if (hrad_make_scene(made, "furnace") < 0 || hrad_set_double(made, "accuracy", 0.1) < 0 ||
      hrad_solve(made) < 0 || hrad_power_balance(made, power, nullptr, nullptr, nullptr) < 0) {
    std::fprintf(stderr, "%s\n", hrad_error_message());
    return 1;
  }
  std::printf("hrad %s: the furnace emits %g W\n", hrad_version_text(), power[0]);
  return hrad_version() > 0 && power[0] > 0 ? 0 : 2;
}
