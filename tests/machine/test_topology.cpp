// What is counted of synthetic, recorded and restricted machines and of this one; the pool planned
// from it. The recorded topologies are hwloc XML in tests/machine/recorded.
#include <fcntl.h>
#include <sched.h>
#include <stdlib.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <fstream>
#include <thread>

#include "base/error.h"
#include "machine/thread_team.h"
#include "machine/topology.h"
#include "support/check.h"
#include "support/folder.h"

using hrad::PoolPlan;
using hrad::Status;
using hrad::Topology;
using hrad::TopologyKind;

namespace {

constexpr char kPaperNode[] = "pack:2 [numa] l3:1 core:4 pu:2";

Topology synthetic(const char* description) {
  return hrad::read_topology_from(TopologyKind::synthetic, description);
}

Topology recorded(const char* name) {
  return hrad::read_topology_from(TopologyKind::xml_file,
                                  std::string(HRAD_TEST_DATA "/machine/recorded/") + name);
}

std::vector<int> counts(const Topology& t) {
  return {t.packages, t.numa_nodes, t.cores, t.contexts, t.usable_cores, t.usable_contexts};
}

bool has_line(const std::string& text, const std::string& line) {
  return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

using Counts = std::vector<int>;
using Binding = std::vector<std::vector<int>>;

// The processors that this process may use, without hwloc.
std::vector<int> own_processors() {
  cpu_set_t set;
  CHECK_EQUAL(sched_getaffinity(0, sizeof set, &set), 0);
  std::vector<int> result;
  for (int i = 0; i < CPU_SETSIZE; ++i)
    if (CPU_ISSET(i, &set)) result.push_back(i);
  return result;
}

void confine(const std::vector<int>& processors) {
  cpu_set_t set;
  CPU_ZERO(&set);
  for (int processor : processors) CPU_SET(processor, &set);
  CHECK_EQUAL(sched_setaffinity(0, sizeof set, &set), 0);
}

std::vector<int> all_contexts(const Topology& topology) {
  std::vector<int> result;
  for (const std::vector<int>& core : topology.core_contexts)
    result.insert(result.end(), core.begin(), core.end());
  return result;
}

void paper_node() {
  const Topology t = synthetic(kPaperNode);
  CHECK(counts(t) == (Counts{2, 2, 8, 16, 8, 16}));
  CHECK(t.synthetic);
  CHECK(t.core_contexts ==
        (Binding{{0, 1}, {2, 3}, {4, 5}, {6, 7}, {8, 9}, {10, 11}, {12, 13}, {14, 15}}));
  CHECK_EQUAL(hrad::plan_pool(t, 0, false, false).threads, 8);
  CHECK_EQUAL(hrad::plan_pool(t, 0, true, false).threads, 16);
}

void machines_without_packages_or_cores() {
  CHECK(counts(synthetic("core:4 pu:1")) == (Counts{0, 1, 4, 4, 4, 4}));
  const Topology contexts_only = synthetic("pu:4");
  CHECK(counts(contexts_only) == (Counts{0, 1, 4, 4, 4, 4}));
  CHECK(contexts_only.core_contexts == (Binding{{0}, {1}, {2}, {3}}));
  CHECK_EQUAL(hrad::plan_pool(contexts_only, 0, false, false).threads, 4);
  CHECK_EQUAL(hrad::plan_pool(contexts_only, 0, true, false).threads, 4);
}

void desktop() {
  const Topology t = synthetic("pack:1 l3:1 core:8 pu:2");
  CHECK(counts(t) == (Counts{1, 1, 8, 16, 8, 16}));
  CHECK_EQUAL(hrad::plan_pool(t, 0, false, true).threads, 8);
  CHECK_EQUAL(hrad::plan_pool(t, 0, true, true).threads, 16);
}

// Cores of two kinds: two fast ones with two contexts, four slow ones with one.
void hybrid_machine() {
  const Topology t = recorded("hybrid-2-fast-4-slow-cores.xml");
  CHECK(counts(t) == (Counts{1, 1, 6, 8, 6, 8}));
  CHECK(t.core_contexts == (Binding{{0, 1}, {2, 3}, {4}, {6}, {8}, {10}}));
  CHECK_EQUAL(hrad::plan_pool(t, 0, false, false).threads, 6);
  CHECK_EQUAL(hrad::plan_pool(t, 0, true, false).threads, 8);
}

void recorded_virtual_machine() {
  const Topology t = recorded("virtual-2-cores.xml");
  CHECK(counts(t) == (Counts{1, 1, 2, 2, 2, 2}));
  CHECK(t.synthetic);
  CHECK(t.source == "recorded");
}

// Contexts that the administrator closed count for the machine, not for the pool.
void disallowed_contexts() {
  const Topology t = recorded("paper-node-half-allowed.xml");
  CHECK(counts(t) == (Counts{2, 2, 8, 16, 4, 8}));
  CHECK(t.core_contexts == (Binding{{0, 1}, {2, 3}, {8, 9}, {10, 11}}));
  const PoolPlan plan = hrad::plan_pool(t, 0, true, false);
  CHECK_EQUAL(plan.threads, 8);
  CHECK(plan.reason.find("8 of 16 contexts") != std::string::npos);
}

// A package that keeps only its memory has no core to offer.
void package_without_processors() {
  const Topology t = recorded("paper-node-one-package.xml");
  CHECK(counts(t) == (Counts{2, 2, 4, 8, 4, 8}));
}

void xml_text_is_read_like_a_file() {
  const std::string root =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!DOCTYPE topology SYSTEM \"hwloc2.dtd\">\n"
      "<topology version=\"2.0\">\n"
      "  <object type=\"Machine\" os_index=\"0\" cpuset=\"0x00000009\" "
      "complete_cpuset=\"0x00000009\""
      " allowed_cpuset=\"0x00000009\" nodeset=\"0x00000001\" complete_nodeset=\"0x00000001\""
      " allowed_nodeset=\"0x00000001\" gp_index=\"1\">\n"
      "    <object type=\"NUMANode\" os_index=\"0\" cpuset=\"0x00000009\""
      " complete_cpuset=\"0x00000009\" nodeset=\"0x00000001\" complete_nodeset=\"0x00000001\""
      " gp_index=\"4\"/>\n"
      "    <object type=\"PU\" os_index=\"0\" cpuset=\"0x00000001\" complete_cpuset=\"0x00000001\""
      " nodeset=\"0x00000001\" complete_nodeset=\"0x00000001\" gp_index=\"2\"/>\n"
      "    <object type=\"PU\" os_index=\"3\" cpuset=\"0x00000008\" complete_cpuset=\"0x00000008\""
      " nodeset=\"0x00000001\" complete_nodeset=\"0x00000001\" gp_index=\"3\"/>\n"
      "  </object>\n"
      "</topology>\n";
  const Topology t = hrad::read_topology_from(TopologyKind::xml, root);
  CHECK(counts(t) == (Counts{0, 1, 2, 2, 2, 2}));
  CHECK(t.core_contexts == (Binding{{0}, {3}}));  // the system's numbers, not hwloc's
}

void unreadable_topologies() {
  CHECK_FAILS(synthetic("no such machine"), Status::argument, "no such machine");
  CHECK_FAILS(synthetic(""), Status::argument, "topology");
  CHECK_FAILS(recorded("no-such-file.xml"), Status::argument, "topology");
  CHECK_FAILS(hrad::read_topology_from(TopologyKind::xml, "<topology"), Status::argument,
              "<topology");
}

void environment_is_honoured() {
  setenv("HWLOC_SYNTHETIC", kPaperNode, 1);
  const Topology t = hrad::read_topology();
  unsetenv("HWLOC_SYNTHETIC");
  CHECK(counts(t) == (Counts{2, 2, 8, 16, 8, 16}));
  CHECK(t.synthetic);
  CHECK(t.source == "synthetic");
  setenv("HWLOC_XMLFILE", HRAD_TEST_DATA "/machine/recorded/virtual-2-cores.xml", 1);
  const Topology x = hrad::read_topology();
  unsetenv("HWLOC_XMLFILE");
  CHECK(x.source == "recorded");
}

// This machine: what the scheduler allows this process, context by context.
void this_machine() {
  const Topology t = hrad::read_topology();
  CHECK(!t.synthetic);
  CHECK(t.source == "this machine");
  CHECK(!t.caller_confined);
  std::vector<int> contexts = all_contexts(t);
  std::sort(contexts.begin(), contexts.end());
  CHECK(contexts == own_processors());
  CHECK_EQUAL(t.usable_contexts, static_cast<int>(contexts.size()));
  CHECK(t.usable_cores >= 1);
  CHECK(t.usable_cores <= t.usable_contexts);
  CHECK(t.cores >= t.usable_cores);
  CHECK(t.contexts >= t.usable_contexts);
}

// Without /sys the processors are counted all the same, and nobody's output is written to. Skipped
// where this process may not hide it from itself.
void a_system_that_tells_nothing() {
  const hrad_test::Folder folder("topology");
  const std::string output = folder.file("output");
  const pid_t child = fork();
  if (child == 0) {
    constexpr int skipped = 2;
    if ((unshare(CLONE_NEWNS) != 0 && unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) ||
        mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
        mount("none", "/sys", "tmpfs", 0, nullptr) != 0)
      _exit(skipped);
    const int file = open(output.c_str(), O_CREAT | O_WRONLY, 0600);
    dup2(file, 1);
    dup2(file, 2);
    _exit(hrad::read_topology().usable_contexts == static_cast<int>(own_processors().size()) ? 0
                                                                                             : 1);
  }
  int status = 0;
  waitpid(child, &status, 0);
  CHECK(WIFEXITED(status));
  if (WEXITSTATUS(status) == 2) return;
  CHECK_EQUAL(WEXITSTATUS(status), 0);
  CHECK(hrad_test::bytes_of_file(output).empty());
}

// A launcher that binds the process to one processor gets a pool of one.
void restricted_process() {
  const std::vector<int> before = own_processors();
  confine({before.back()});
  const Topology t = hrad::read_topology();
  confine(before);
  CHECK(t.core_contexts == (Binding{{before.back()}}));
  CHECK_EQUAL(hrad::plan_pool(t, 0, true, true).threads, 1);
  CHECK(hrad::read_topology().core_contexts != t.core_contexts || before.size() == 1);
}

// A thread that is confined to less than its process (OMP_PROC_BIND does that) still gets the
// process's pool, and the workers don't inherit its confinement.
void confined_caller() {
  const std::vector<int> all = own_processors();
  Topology t;
  PoolPlan plan;
  std::vector<int> of_worker;
  std::thread([&] {
    cpu_set_t set;
    CPU_ZERO(&set);
    CPU_SET(all.front(), &set);
    sched_setaffinity(0, sizeof set, &set);
    t = hrad::read_topology();
    plan = hrad::plan_pool(t, 2, false, false);
    hrad::ThreadTeam team(2, plan.binding);
    // Both tasks wait for both workers, so that worker 1 has one.
    std::atomic<int> arrived{0};
    team.for_each(2, [&](int64_t, int worker) {
      for (++arrived; arrived < 2;) std::this_thread::sleep_for(std::chrono::milliseconds(1));
      if (worker == 1) of_worker = own_processors();
    });
  }).join();
  CHECK(t.caller_confined == (all.size() > 1));
  CHECK_EQUAL(t.usable_contexts, static_cast<int>(all.size()));
  CHECK(!plan.pinned);
  CHECK(of_worker == all);
}

// A machine of two packages of two cores of two contexts that may be pinned to.
Topology small_machine() {
  Topology t = synthetic("pack:2 core:2 pu:2");
  t.synthetic = false;
  return t;
}

void plan_by_number() {
  const Topology t = small_machine();
  for (int threads : {1, 3, 4, 8, 100}) {
    const PoolPlan plan = hrad::plan_pool(t, threads, false, false);
    CHECK_EQUAL(plan.threads, threads);
    CHECK(plan.binding.empty());
    CHECK(!plan.reason.empty());
  }
  CHECK(hrad::plan_pool(t, 9, false, false).reason.find("only 8") != std::string::npos);
  CHECK_EQUAL(hrad::plan_pool(Topology{}, 0, false, true).threads, 1);
}

// Fewer workers than cores are spread over the packages; more take the contexts in turns.
void plan_of_pinning() {
  const Topology t = small_machine();
  CHECK(hrad::plan_pool(t, 0, false, true).binding == (Binding{{0, 1}, {2, 3}, {4, 5}, {6, 7}}));
  CHECK(hrad::plan_pool(t, 2, false, true).binding == (Binding{{0, 1}, {4, 5}}));
  CHECK(hrad::plan_pool(t, 0, true, true).binding ==
        (Binding{{0}, {2}, {4}, {6}, {1}, {3}, {5}, {7}}));
  const Binding crowded = hrad::plan_pool(t, 10, false, true).binding;
  CHECK_EQUAL(crowded.size(), size_t{10});
  CHECK(crowded[8] == std::vector<int>{0});
}

// A machine that is not here is never pinned to.
void synthetic_is_not_pinned() {
  const PoolPlan plan = hrad::plan_pool(synthetic(kPaperNode), 0, true, true);
  CHECK(plan.binding.empty());
  CHECK(!plan.pinned);
  CHECK(plan.reason.find("not pinned") != std::string::npos);
}

void description() {
  Topology t = synthetic(kPaperNode);
  std::string text = hrad::describe(t, hrad::plan_pool(t, 0, false, false));
  for (const char* line : {"source: synthetic", "packages: 2", "numa_nodes: 2", "cores: 8",
                           "contexts: 16", "usable_cores: 8", "usable_contexts: 16", "threads: 8",
                           "binding: none", "reason: one thread for each of 8 usable cores"})
    CHECK(has_line(text, line));
  // Every line is `name: value`, and names have no blanks.
  size_t start = 0;
  for (size_t end; (end = text.find('\n', start)) != std::string::npos; start = end + 1) {
    const std::string line = text.substr(start, end - start);
    const size_t colon = line.find(": ");
    CHECK(colon != std::string::npos);
    CHECK(colon > 0);
    CHECK(line.size() > colon + 2);
    CHECK(line.substr(0, colon).find(' ') == std::string::npos);
  }
  CHECK_EQUAL(start, text.size());

  t = small_machine();
  CHECK(has_line(hrad::describe(t, hrad::plan_pool(t, 4, false, true)), "binding: a core each"));
  CHECK(has_line(hrad::describe(t, hrad::plan_pool(t, 0, true, true)), "binding: a context each"));
  t.caller_confined = true;
  CHECK(has_line(hrad::describe(t, hrad::plan_pool(t, 0, false, false)),
                 "binding: the process's processors"));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(paper_node),
      HRAD_TEST(machines_without_packages_or_cores),
      HRAD_TEST(desktop),
      HRAD_TEST(hybrid_machine),
      HRAD_TEST(recorded_virtual_machine),
      HRAD_TEST(disallowed_contexts),
      HRAD_TEST(package_without_processors),
      HRAD_TEST(xml_text_is_read_like_a_file),
      HRAD_TEST(unreadable_topologies),
      HRAD_TEST(environment_is_honoured),
      HRAD_TEST(this_machine),
      HRAD_TEST(a_system_that_tells_nothing),
      HRAD_TEST(restricted_process),
      HRAD_TEST(confined_caller),
      HRAD_TEST(plan_by_number),
      HRAD_TEST(plan_of_pinning),
      HRAD_TEST(synthetic_is_not_pinned),
      HRAD_TEST(description),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
