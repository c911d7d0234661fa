// What benches share that measure one thing scene by scene: the command line, the calibration loop
// beside each measurement, messages and exit codes.
#pragma once

#include <algorithm>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/calibration.h"
#include "bench/paper_options.h"
#include "bench/solve_apart.h"

namespace bench {

struct SceneOptions {
  std::vector<std::string> scenes;
  Settings settings;  // --set
};

// take(name, value): an option of the bench's own; false: it has none of this name.
template <class Take>
SceneOptions scene_options(const std::vector<std::string>& arguments, const Take& take) {
  SceneOptions o;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& a = arguments[i];
    const bool has_value = i + 1 < arguments.size();
    if (a == "--set" && has_value)
      o.settings = settings_in(arguments[++i]);
    else if (has_value && take(a, arguments[i + 1]))
      ++i;
    else if (a[0] == '-')
      throw std::invalid_argument("unknown option or no value: " + a);
    else
      o.scenes.push_back(a);
  }
  if (o.scenes.empty()) throw std::invalid_argument("no scene named");
  return o;
}

// Of each scene measure(scene, result), in a process of its own, and print(scene, result, seconds
// of the calibration loop).
template <class Result, class Measure, class Print>
void for_each_scene(const std::vector<std::string>& scenes, const Measure& measure,
                    const Print& print) {
  for (const std::string& scene : scenes) {
    double calibration = calibration_seconds();
    const Result measured = in_child<Result>([&](Result& result) { measure(scene, result); });
    calibration = (calibration + calibration_seconds()) / 2;
    print(scene, measured, calibration);
  }
}

// The exit code of a bench that does this.
template <class Body>
int exit_code_of(const char* name, const char* usage, const Body& body) {
  try {
    body();
  } catch (const std::invalid_argument& error) {
    std::fprintf(stderr, "%s: %s\n%s", name, error.what(), usage);
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", name, error.what());
    return 1;
  }
  return 0;
}

inline double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

inline double per(double value, double by) { return by > 0 ? value / by : 0; }

}  // namespace bench
