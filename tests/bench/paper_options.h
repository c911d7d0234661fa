// The command line of bench_paper.
#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/solve_apart.h"

namespace bench {

struct Options {
  std::vector<std::string> scenes;
  Settings common;               // --set: of every solve
  std::vector<Settings> cases;   // --case: one solve of each scene each
  std::vector<Settings> rivals;  // --compare
  std::string reference_dir = ".";
  double reference_seconds = 0;
  bool reference_only = false;
  int64_t points = 10000, sides = 20000;
  uint64_t seed = 1;
  int64_t runs = 0;  // 0: 1, or 5 pairs
};

constexpr char kUsage[] =
    "Usage: bench_paper [OPTION]... SCENE...\n"
    "Solves scenes (built-in names or .obj paths) and prints cost and error.\n"
    "  --set NAME=VALUE[,...]     settings of every solve (threads is 1 unless set)\n"
    "  --case NAME=VALUE[,...]    one more solve of each scene, with these settings\n"
    "  --runs N                   solves of each case (default 1) or pairs (default 5); medians\n"
    "  --reference-dir DIR        where references are kept (default: the current directory)\n"
    "  --reference-seconds S      first improves each scene's reference by S s of user CPU\n"
    "  --reference-only           no solves after that\n"
    "  --points N                 random points for the error at points (default 10000)\n"
    "  --sides N                  patch sides for the error of means, all or N (default 20000)\n"
    "  --seed N                   of points and reference (default 1)\n"
    "  --compare SETTINGS SETTINGS  ratios of user CPU, solves interleaved\n";

inline Settings settings_in(const std::string& text) {
  Settings settings;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find(',', begin), text.size());
    const std::string one = text.substr(begin, end - begin);
    const size_t equals = one.find('=');
    if (equals == std::string::npos || equals == 0)
      throw std::invalid_argument("'" + one + "' is not NAME=VALUE");
    settings.emplace_back(one.substr(0, equals), one.substr(equals + 1));
    begin = end + 1;
  }
  return settings;
}

inline std::string text_of(const Settings& settings) {
  std::string text;
  for (const auto& [name, value] : settings) text += (text.empty() ? "" : ",") + name + "=" + value;
  return text.empty() ? "defaults" : text;
}

inline Settings joined(Settings first, const Settings& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

inline double number_in(const std::string& option, const std::string& text, double least) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (text.empty() || *end != '\0' || !(value >= least))
    throw std::invalid_argument(option + ": '" + text +
                                "' is not a number >= " + std::to_string(static_cast<long>(least)));
  return value;
}

inline Options options_in(const std::vector<std::string>& arguments) {
  Options o;
  size_t i = 0;
  const auto next = [&](const std::string& option) {
    if (i + 1 >= arguments.size()) throw std::invalid_argument(option + " needs a value");
    return arguments[++i];
  };
  for (; i < arguments.size(); ++i) {
    const std::string& a = arguments[i];
    const auto number = [&](double least) { return number_in(a, next(a), least); };
    if (a == "--set") {
      o.common = joined(o.common, settings_in(next(a)));
    } else if (a == "--case") {
      o.cases.push_back(settings_in(next(a)));
    } else if (a == "--compare") {
      o.rivals = {settings_in(next(a))};
      o.rivals.push_back(settings_in(next(a)));
    } else if (a == "--runs") {
      o.runs = static_cast<int64_t>(number(1));
    } else if (a == "--reference-dir") {
      o.reference_dir = next(a);
    } else if (a == "--reference-seconds") {
      o.reference_seconds = number(0);
    } else if (a == "--reference-only") {
      o.reference_only = true;
    } else if (a == "--points") {
      o.points = static_cast<int64_t>(number(1));
    } else if (a == "--sides") {
      o.sides = static_cast<int64_t>(number(1));
    } else if (a == "--seed") {
      o.seed = static_cast<uint64_t>(number(0));
    } else if (!a.empty() && a[0] == '-') {
      throw std::invalid_argument("unknown option " + a);
    } else {
      o.scenes.push_back(a);
    }
  }
  if (o.scenes.empty()) throw std::invalid_argument("no scene named");
  if (o.cases.empty()) o.cases.emplace_back();
  return o;
}

}  // namespace bench
