// Solvers of the C API on ranks that are threads of this process, and what every call answered on
// each of them: ranks that don't agree fail the test. Nothing is checked while they are at work,
// since a rank that leaves alone would keep the others waiting.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "api/create_over.h"
#include "hrad/hrad.h"
#include "support/check.h"
#include "support/thread_ranks.h"

namespace hrad_test {

// Of one call: its status, and its message or what it found out.
struct Answer {
  hrad_status status = HRAD_OK;
  std::string text;
  bool operator==(const Answer& other) const {
    return status == other.status && text == other.text;
  }
};

// One rank with its solver.
class SolverRank {
 public:
  SolverRank(Hub& hub, int rank) : rank(rank) {
    struct Place {
      Hub& hub;
      int rank;
    } const place{hub, rank};
    const auto make = [](const void* host) -> hrad::Comm* {
      const auto* place = static_cast<const Place*>(host);
      return new CommThreads(place->hub, place->rank);
    };
    note(hrad_create_over(make, &place, &solver));
  }
  ~SolverRank() { hrad_destroy(&solver); }
  SolverRank(const SolverRank&) = delete;
  SolverRank& operator=(const SolverRank&) = delete;

  // Every call goes through one of these.
  hrad_status note(hrad_status status) {
    answers.push_back({status, status < 0 ? hrad_error_message() : ""});
    return status;
  }
  void note_number(uint64_t number) { answers.push_back({HRAD_OK, std::to_string(number)}); }

  void note_hash() {
    uint64_t hash = 0;
    if (note(hrad_state_hash(solver, &hash)) == HRAD_OK) note_number(hash);
  }
  void note_patches() {
    int64_t patches = -1;
    hrad_scene_size(solver, &patches, nullptr);
    note_number(static_cast<uint64_t>(patches));
  }
  hrad_stats stats() {
    hrad_stats stats{};
    stats.struct_size = sizeof stats;
    note(hrad_get_stats(solver, &stats));
    return stats;
  }
  // One thread, so that there are no more of them than ranks.
  void prepare(const char* scene, const char* linking, double accuracy) {
    note(hrad_set_int(solver, "threads", 1));
    note(hrad_set_text(solver, "linking", linking));
    note(hrad_set_double(solver, "accuracy", accuracy));
    note(hrad_make_scene(solver, scene));
  }

  const int rank;
  hrad_solver* solver = nullptr;
  std::vector<Answer> answers;
};

// What all ranks have answered, call by call.
inline std::vector<Answer> solve_together(int ranks, const std::function<void(SolverRank&)>& body) {
  Hub hub(ranks);
  std::vector<std::vector<Answer>> of_rank(static_cast<size_t>(ranks));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < ranks; ++rank)
    threads.emplace_back([&, rank] {
      SolverRank one(hub, rank);
      body(one);
      of_rank[static_cast<size_t>(rank)] = one.answers;
    });
  for (std::thread& thread : threads) thread.join();
  for (size_t rank = 1; rank < of_rank.size(); ++rank) {
    if (of_rank[rank].size() != of_rank[0].size())
      failed(__FILE__, __LINE__, "rank " + std::to_string(rank) + " made other calls");
    for (size_t k = 0; k < of_rank[0].size(); ++k)
      if (!(of_rank[rank][k] == of_rank[0][k]))
        failed(__FILE__, __LINE__,
               "call " + std::to_string(k) + ": rank " + std::to_string(rank) + " answers " +
                   std::to_string(of_rank[rank][k].status) + " '" + of_rank[rank][k].text +
                   "', rank 0 " + std::to_string(of_rank[0][k].status) + " '" + of_rank[0][k].text +
                   "'");
  }
  return of_rank[0];
}

// The errors among them, in order.
inline std::vector<Answer> errors_of(const std::vector<Answer>& answers) {
  std::vector<Answer> errors;
  for (const Answer& answer : answers)
    if (answer.status < 0) errors.push_back(answer);
  return errors;
}

// The only error among them has this status, and its message has the text.
inline void check_one_error(const std::vector<Answer>& answers, hrad_status status,
                            const std::string& text) {
  const std::vector<Answer> errors = errors_of(answers);
  if (errors.size() == 1 && errors[0].status == status &&
      errors[0].text.find(text) != std::string::npos)
    return;
  std::string all;
  for (const Answer& error : errors) all += std::to_string(error.status) + " '" + error.text + "' ";
  failed(__FILE__, __LINE__, "wanted one error with '" + text + "', met: " + all);
}

// The last answer: what a test compares.
inline std::string last_of(const std::vector<Answer>& answers) {
  CHECK(!answers.empty() && answers.back().status == HRAD_OK);
  return answers.back().text;
}

// What one rank finds.
inline std::string hash_of_one(const char* scene, const char* linking, double accuracy) {
  return last_of(solve_together(1, [&](SolverRank& one) {
    one.prepare(scene, linking, accuracy);
    one.note(hrad_solve(one.solver));
    one.note_hash();
  }));
}

}  // namespace hrad_test
