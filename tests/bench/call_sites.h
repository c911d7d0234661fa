// Names of the places in the library that a recording was made at. addr2line tells them from the
// symbols of this program; files and lines need a build with -g1.
#pragma once

#include <dlfcn.h>
#include <stdio.h>
#include <unistd.h>

#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "support/timeline.h"

namespace bench {

class CallSites {
 public:
  explicit CallSites(const std::vector<std::vector<void*>>& stacks) {
    std::string addresses;
    for (const auto& stack : stacks)
      for (void* address : stack) addresses += " " + offset_of(address);
    // All at once: an answer ends where the next address is repeated.
    std::vector<std::vector<Frame>> answers;
    for (size_t first = 0; first < addresses.size();) {
      constexpr size_t most = 60000;  // characters of a command line
      size_t end = addresses.size();
      if (end - first > most) end = addresses.rfind(' ', first + most);
      ask(addresses.substr(first, end - first), answers);
      first = end;
    }
    size_t next = 0;
    for (const auto& stack : stacks) {
      frames_.emplace_back();
      for (size_t k = 0; k < stack.size(); ++k, ++next)
        if (next < answers.size())
          for (const Frame& frame : answers[next])
            if (!is_plumbing(frame)) frames_.back().push_back(frame);
    }
  }

  // The innermost function and its callers, as far as they say something.
  std::string name(int32_t site) const {
    std::string text;
    const auto& frames = frames_[static_cast<size_t>(site)];
    for (size_t k = 0; k < frames.size() && k < 3; ++k)
      text += (k > 0 ? " < " : "") + frames[k].function + " " + frames[k].place;
    return text.empty() ? "?" : text;
  }

  // A stretch between two sites (-1: begin or end): the function that both lie in, and from where
  // to where in it.
  std::string between(int32_t from, int32_t to) const {
    if (from < 0) return "begin .. " + (to < 0 ? "end" : name(to));
    if (to < 0) return name(from) + " .. end";
    const auto &a = frames_[static_cast<size_t>(from)], &b = frames_[static_cast<size_t>(to)];
    size_t i = a.size(), j = b.size();
    while (i > 0 && j > 0 && a[i - 1] == b[j - 1]) --i, --j;
    // Here the two differ: in one function, or below the last common one.
    if (i > 0 && j > 0 && a[i - 1].function == b[j - 1].function)
      return a[i - 1].function + ": " + step(a, i - 1) + " .. " + step(b, j - 1);
    const std::string common = i < a.size() ? a[i].function : "?";
    return common + ": " + step(a, i) + " .. " + step(b, j);
  }

 private:
  struct Frame {
    std::string function, place;
    bool operator==(const Frame& o) const { return function == o.function && place == o.place; }
  };

  // A place and what it calls.
  static std::string step(const std::vector<Frame>& frames, size_t at) {
    std::string text = at < frames.size() ? frames[at].place : "";
    if (at > 0 && at <= frames.size()) text += " " + frames[at - 1].function;
    return text;
  }

  static std::string offset_of(void* address) {
    Dl_info info = {};
    char text[32];
    const char* base = nullptr;
    if (dladdr(address, &info) != 0) base = static_cast<const char*>(info.dli_fbase);
    // The call lies before the address that it returns to.
    snprintf(text, sizeof text, "%#lx",
             static_cast<unsigned long>(static_cast<const char*>(address) - base - 1));
    return text;
  }

  // Of each address the functions that are inlined there, innermost first.
  static void ask(const std::string& addresses, std::vector<std::vector<Frame>>& answers) {
    FILE* pipe = popen(("addr2line -a -f -C -i -e /proc/" + std::to_string(getpid()) + "/exe" +
                        addresses + " 2>/dev/null")
                           .c_str(),
                       "r");
    if (!pipe) return;
    std::vector<std::string> lines(1);
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
      if (c == '\n')
        lines.emplace_back();
      else
        lines.back() += static_cast<char>(c);
    }
    lines.pop_back();
    pclose(pipe);
    for (size_t k = 0; k < lines.size();) {
      if (lines[k].compare(0, 2, "0x") == 0) {
        answers.emplace_back();
        ++k;
      } else if (k + 1 < lines.size()) {
        answers.back().push_back({plain(lines[k]), base_name(lines[k + 1])});
        k += 2;
      } else {
        break;
      }
    }
  }

  // Without arguments and what is in <>.
  static std::string plain(const std::string& name) {
    std::string text;
    int depth = 0;
    const std::string anonymous = "(anonymous namespace)::", call = "operator()";
    for (size_t k = 0; k < name.size(); ++k) {
      if (name.compare(k, anonymous.size(), anonymous) == 0) {
        k += anonymous.size() - 1;
      } else if (name[k] == '<') {
        ++depth;
      } else if (name[k] == '>') {
        --depth;
      } else if (depth == 0) {
        if (name.compare(k, call.size(), call) == 0) {
          text += call;
          k += call.size() - 1;
        } else if (name[k] == '(') {
          break;
        } else {
          text += name[k];
        }
      }
    }
    const size_t space = text.rfind(' ');
    return space == std::string::npos ? text : text.substr(space + 1);
  }
  static std::string base_name(const std::string& place) {
    const size_t slash = place.rfind('/');
    std::string text = slash == std::string::npos ? place : place.substr(slash + 1);
    return text.substr(0, text.find(' '));
  }

  // What every recording goes through.
  static bool is_plumbing(const Frame& frame) {
    if (frame.place.compare(0, 2, "??") == 0 && frame.function == "??") return true;
    for (const char* start : {"hrad_test::", "bench::", "hrad::Comm::", "hrad::ThreadTeam::",
                              "hrad::api::", "std::", "__", "exchanging", "operator()", "clone"})
      if (frame.function.compare(0, std::strlen(start), start) == 0) return true;
    for (const char* name :
         {"hrad::share", "hrad::share_rows", "hrad::share_rows_of", "hrad::share_lists",
          "hrad::unite", "hrad::Exchange::share", "hrad::Exchange::share_lists",
          "hrad::Exchange::share_rows", "hrad::Exchange::share_turns", "hrad::Exchange::unite",
          "hrad::Exchange::all_go_on"})
      if (frame.function == name) return true;
    for (const char* place :
         {"recorder.h", "thread_team.cpp", "sharing.h", "comm.cpp", "exchange.h", "shared_rows.h",
          "std_function.h", "invoke.h", "recorded_solve.h", "bench_hybrid.cpp"})
      if (frame.place.compare(0, std::strlen(place), place) == 0) return true;
    return false;
  }

  std::vector<std::vector<Frame>> frames_;  // per site, innermost first
};

}  // namespace bench
