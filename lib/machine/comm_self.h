// One process alone. Floor 2 (machine).
#pragma once

#include <utility>

#include "machine/comm.h"

namespace hrad {

class CommSelf final : public Comm {
 public:
  int rank() const override { return 0; }
  int size() const override { return 1; }

 protected:
  std::vector<Word> do_tell(const Word& mine) override { return {mine}; }
  void do_broadcast(Bytes&, int) override {}
  std::vector<Bytes> do_gather_all(const Bytes& mine) override { return {mine}; }
  void do_start_exchange(std::vector<Bytes> to) override { on_the_way_ = std::move(to); }
  std::vector<Bytes> do_finish_exchange() override { return std::move(on_the_way_); }
  void do_add_up(Span<uint64_t>) override {}
  void do_raise() override {}
  bool do_raised() override { return false; }
  void do_settle(int) override {}

 private:
  std::vector<Bytes> on_the_way_;
};

}  // namespace hrad
