// The contract of Comm over one process and over ranks that are threads.
#include <cstdlib>

#include "comm_contract.h"
#include "machine/comm_self.h"
#include "support/thread_ranks.h"

namespace {

template <void (*body)(hrad::Comm&)>
void alone() {
  hrad::CommSelf comm;
  body(comm);
}

// A check that fails on a rank ends the program with its message: the other ranks would wait.
template <void (*body)(hrad::Comm&)>
void over_threads() {
  for (int ranks = 1; ranks <= 5; ++ranks)
    hrad_test::on_ranks(ranks, [](hrad::Comm& comm) {
      try {
        body(comm);
      } catch (const std::exception& error) {
        std::fprintf(stderr, "rank %d of %d: %s\n", comm.rank(), comm.size(), error.what());
        std::abort();
      }
    });
}

}  // namespace

#define ALONE(body) HRAD_TEST(alone<body>)
#define OVER_THREADS(body) HRAD_TEST(over_threads<body>)

int main() {
  const CMUnitTest tests[] = {
      COMM_CONTRACT(ALONE),
      COMM_CONTRACT(OVER_THREADS),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
