// Ranks without MPI: threads of one process, each with a Comm of its own, so that tests of what
// ranks do together run anywhere and under any sanitizer.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "machine/comm.h"

namespace hrad_test {

// What the ranks share.
class Hub {
 public:
  explicit Hub(int size) : size(size), slots(size), raised(size, 0) {}

  // Until all are here.
  void meet() {
    std::unique_lock<std::mutex> lock(mutex);
    const int64_t turn = turns;
    if (++arrived == size) {
      arrived = 0;
      ++turns;
      all_here.notify_all();
    } else {
      all_here.wait(lock, [&] { return turns != turn; });
    }
  }

  const int size;
  std::vector<const void*> slots;  // what each rank shows the others between two meetings
  std::mutex mutex;
  std::vector<int> raised;  // for each rank, by others

 private:
  std::condition_variable all_here;
  int arrived = 0;
  int64_t turns = 0;
};

class CommThreads : public hrad::Comm {
 public:
  CommThreads(Hub& hub, int rank) : hub_(hub), rank_(rank) {}
  int rank() const override { return rank_; }
  int size() const override { return hub_.size; }

 protected:
  using Bytes = hrad::Bytes;

  // See what every rank shows.
  template <class T, class See>
  void show(const T& mine, See see) {
    hub_.slots[rank_] = &mine;
    hub_.meet();
    for (int k = 0; k < hub_.size; ++k) see(k, *static_cast<const T*>(hub_.slots[k]));
    hub_.meet();
  }

  std::vector<Word> do_tell(const Word& mine) override {
    std::vector<Word> words;
    show(mine, [&](int, const Word& word) { words.push_back(word); });
    return words;
  }
  void do_broadcast(Bytes& data, int root) override {
    Bytes result;
    show(data, [&](int k, const Bytes& bytes) {
      if (k == root) result = bytes;
    });
    data = std::move(result);
  }
  std::vector<Bytes> do_gather_all(const Bytes& mine) override {
    std::vector<Bytes> all;
    show(mine, [&](int, const Bytes& bytes) { all.push_back(bytes); });
    return all;
  }
  void do_start_exchange(std::vector<Bytes> to) override {
    on_the_way_.clear();
    show(to, [&](int, const std::vector<Bytes>& from) { on_the_way_.push_back(from[rank_]); });
  }
  std::vector<Bytes> do_finish_exchange() override { return std::move(on_the_way_); }
  void do_add_up(hrad::Span<uint64_t> values) override {
    const std::vector<uint64_t> mine(values.begin(), values.end());
    std::vector<uint64_t> sum(mine.size(), 0);
    show(mine, [&](int, const std::vector<uint64_t>& more) {
      for (size_t k = 0; k < sum.size(); ++k) sum[k] += more[k];
    });
    std::copy(sum.begin(), sum.end(), values.begin());
  }
  void do_raise() override {
    std::lock_guard<std::mutex> lock(hub_.mutex);
    for (int k = 0; k < hub_.size; ++k) hub_.raised[k] += k != rank_;
  }
  bool do_raised() override {
    std::lock_guard<std::mutex> lock(hub_.mutex);
    return hub_.raised[rank_] > 0;
  }
  void do_settle(int others_raised) override {
    std::lock_guard<std::mutex> lock(hub_.mutex);
    hub_.raised[rank_] -= others_raised;
  }

 private:
  Hub& hub_;
  const int rank_;
  std::vector<Bytes> on_the_way_;
};

// Runs body(hub, rank) on a thread for each of so many ranks; then throws what the lowest one
// threw, if any did. All must end: a rank that fails alone leaves the others waiting.
inline void on_threads(int ranks, const std::function<void(Hub&, int rank)>& body) {
  Hub hub(ranks);
  std::vector<std::thread> threads;
  std::vector<std::exception_ptr> thrown(static_cast<size_t>(ranks));
  for (int rank = 0; rank < ranks; ++rank)
    threads.emplace_back([&, rank] {
      try {
        body(hub, rank);
      } catch (...) {
        thrown[rank] = std::current_exception();
      }
    });
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& exception : thrown)
    if (exception) std::rethrow_exception(exception);
}

inline void on_ranks(int ranks, const std::function<void(hrad::Comm&)>& body) {
  on_threads(ranks, [&](Hub& hub, int rank) {
    CommThreads comm(hub, rank);
    body(comm);
  });
}

// As a solver takes it, which it must not outlive.
inline std::shared_ptr<hrad::Comm> not_owned(hrad::Comm& comm) {
  return {std::shared_ptr<hrad::Comm>(), &comm};
}

}  // namespace hrad_test
