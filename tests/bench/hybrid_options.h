// The command line of bench_hybrid.
#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/recorded_solve.h"

namespace bench {

struct HybridOptions {
  std::vector<std::string> scenes, linkings;
  std::vector<int> nodes{1, 2, 4, 8}, threads{1, 2, 4, 8, 16};
  Settings common;
  std::string accuracy = "0.05", partition = "cost";
  int repeat = 1, top = 12;
  double wake = 0;  // seconds
  bool other_partition = true, measure = false;
};

constexpr char kHybridUsage[] =
    "Usage: bench_hybrid [OPTION]...\n"
    "Projects the time of a solve on so many nodes and threads from the recorded costs of its\n"
    "tasks and messages.\n"
    "  --scene NAME         built-in scene, again for more (default: building and classroom)\n"
    "  --linking HOW        paper (pairs with the paper's oracle), pairs, auto or another method,\n"
    "                       again for more (default: paper, pairs and auto)\n"
    "  --accuracy X         of all but paper (default 0.05)\n"
    "  --nodes N,...        (default 1,2,4,8; 1 is always among them)\n"
    "  --threads N,...      (default 1,2,4,8,16)\n"
    "  --partition METHOD   cost or grid (default cost)\n"
    "  --no-other           doesn't solve with the other partition for its balance\n"
    "  --repeat N           solves of each kind; the least of every cost counts (default 1)\n"
    "  --wake MICROSECONDS  until sleeping threads have entered a loop (default 0)\n"
    "  --top N              parts of the critical path to print (default 12)\n"
    "  --measure            also wall times where nodes times threads fit this machine\n"
    "  --set NAME=VALUE     one more setting of every solve\n";

inline std::vector<int> numbers_in(const std::string& option, const std::string& text) {
  std::vector<int> numbers;
  const char* at = text.c_str();
  for (;;) {
    char* end = nullptr;
    const long number = std::strtol(at, &end, 10);
    if (end == at || number < 1 || number > 1024 || (*end != '\0' && *end != ','))
      throw std::invalid_argument(option + ": '" + text + "' is not a list of numbers from 1 on");
    numbers.push_back(static_cast<int>(number));
    if (*end == '\0') return numbers;
    at = end + 1;
  }
}

inline HybridOptions hybrid_options_in(const std::vector<std::string>& arguments) {
  HybridOptions o;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string& a = arguments[i];
    const auto next = [&] {
      if (i + 1 >= arguments.size()) throw std::invalid_argument(a + " needs a value");
      return arguments[++i];
    };
    if (a == "--scene") {
      o.scenes.push_back(next());
    } else if (a == "--linking") {
      o.linkings.push_back(next());
    } else if (a == "--accuracy") {
      o.accuracy = next();
    } else if (a == "--nodes") {
      o.nodes = numbers_in(a, next());
    } else if (a == "--threads") {
      o.threads = numbers_in(a, next());
    } else if (a == "--partition") {
      o.partition = next();
    } else if (a == "--no-other") {
      o.other_partition = false;
    } else if (a == "--repeat") {
      o.repeat = numbers_in(a, next())[0];
    } else if (a == "--wake") {
      o.wake = 1e-6 * std::strtod(next().c_str(), nullptr);
    } else if (a == "--top") {
      o.top = numbers_in(a, next())[0];
    } else if (a == "--measure") {
      o.measure = true;
    } else if (a == "--set") {
      const std::string text = next();
      const size_t equals = text.find('=');
      if (equals == std::string::npos)
        throw std::invalid_argument("'" + text + "' is not NAME=VALUE");
      o.common.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    } else {
      throw std::invalid_argument("unknown option " + a);
    }
  }
  if (o.scenes.empty()) o.scenes = {"building", "classroom"};
  if (o.linkings.empty()) o.linkings = {"paper", "pairs", "auto"};
  if (o.nodes[0] != 1) o.nodes.insert(o.nodes.begin(), 1);
  return o;
}

// The paper's oracle with thresholds that give about as many leaves as its table's meshes have.
inline Settings settings_of(const std::string& scene, const std::string& linking,
                            const HybridOptions& o) {
  Settings settings{{"partition", o.partition}};
  if (linking == "paper") {
    settings.insert(settings.end(), {{"linking", "pairs"}, {"oracle", "energy"}});
    if (scene == "classroom")
      settings.insert(settings.end(), {{"bf_epsilon", "0.00017"}, {"min_area", "1e-5"}});
    else
      settings.insert(settings.end(), {{"bf_epsilon", "0.0145"}});
  } else {
    settings.insert(settings.end(), {{"linking", linking}, {"accuracy", o.accuracy}});
  }
  settings.insert(settings.end(), o.common.begin(), o.common.end());
  return settings;
}

}  // namespace bench
