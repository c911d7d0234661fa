// A file that ranks write together: whole under its name or not at all, whatever fails on one.
#include <functional>

#include "api/guard.h"
#include "machine/comm_self.h"
#include "machine/shared_file.h"
#include "machine/shared_file_contract.h"
#include "solver/checkpoint_files.h"
#include "support/failing_ranks.h"

namespace {

using namespace hrad_test;
using namespace shared_file_contract;

using Body = void (*)(Comm&, const std::string&);

template <Body body>
void by_one() {
  const Folder folder("shared");
  hrad::CommSelf comm;
  body(comm, folder.file(""));
}

template <Body body>
void by_threads() {
  for (int ranks : {2, 3, 5}) {
    const Folder folder("shared");
    on_ranks(ranks,
             [&](Comm& comm) { hrad::api::agreed(comm, [&] { body(comm, folder.file("")); }); });
  }
}

// The message that all ranks have, of a call that one of them lets fail; "": none failed.
std::string message_of(Comm& comm, const std::function<void()>& body) {
  std::string message;
  try {
    try {
      body();
      comm.all_go_on();
    } catch (const hrad::AgreedError&) {
      throw;
    } catch (const hrad::Error& error) {
      comm.fail_all(error.status(), error.what());
    }
  } catch (const hrad::AgreedError& error) {
    message = error.status() == hrad::Status::file ? error.what() : "another status";
  }
  return message;
}

// Every step that a rank takes fails once.
void every_step_on_every_rank() {
  const Folder folder("shared");
  const std::string path = folder.file("a");
  int failures = 0;
  for (int failing_rank : {0, 1, 2}) {
    for (int step = 0;; ++step) {
      write_bytes(path, "old");
      std::vector<std::string> messages(3);
      std::vector<int64_t> left(3);
      on_failing_ranks(3, [&](FailingComm& comm) {
        const auto rank = static_cast<size_t>(comm.rank());
        if (comm.rank() == failing_rank) comm.failing_step = step;
        messages[rank] = message_of(comm, [&] { write_new(comm, path); });
        comm.all_go_on();
        left[rank] = entries(folder.file(""));
      });
      CHECK(messages[1] == messages[0] && messages[2] == messages[0]);
      CHECK(left[0] == 1 && left[1] == 1 && left[2] == 1);
      if (messages[0].empty()) break;
      CHECK(messages[0].find(path + ": rank " + std::to_string(failing_rank)) == 0);
      CHECK(content(path) == "old");
      ++failures;
    }
    CHECK(content(path) == wanted_content());
  }
  CHECK(failures > 30);
}

// Ranks whose folder is another one under the same name.
class CommElsewhere : public CommThreads {
 public:
  CommElsewhere(Hub& hub, int rank, std::string elsewhere)
      : CommThreads(hub, rank), elsewhere_(std::move(elsewhere)) {}
  std::unique_ptr<hrad::FilePart> open_part(const std::string& name,
                                            const std::string& path) override {
    if (rank() == 0) return nullptr;
    return std::make_unique<hrad::FilePartSelf>(elsewhere_.empty() ? name + "x" : elsewhere_, path);
  }

 private:
  const std::string elsewhere_;
};

void a_folder_that_is_not_shared() {
  const Folder folder("shared");
  const std::string path = folder.file("a"), other = folder.file("other");
  for (const std::string& elsewhere : {std::string(), other}) {
    for (const char* text : {"", "some bytes that another writer has left behind"}) {
      write_bytes(other, text);
      write_bytes(path, "old");
      std::vector<std::string> messages(2);
      on_threads(2, [&](Hub& hub, int rank) {
        CommElsewhere comm(hub, rank, elsewhere);
        messages[static_cast<size_t>(rank)] = message_of(comm, [&] { write_new(comm, path); });
      });
      CHECK(messages[0] == messages[1]);
      CHECK(messages[0].find(path + ": cannot open") == 0);
      CHECK(messages[0].find("rank 1: all ranks write this file") != std::string::npos);
      CHECK(content(path) == "old" && content(other) == text);
      CHECK_EQUAL(folder.count(), 2);
    }
  }
}

// At the beginning of this process's memory nothing can be read.
void a_part_that_can_not_be_read() {
  hrad::FilePartSelf part("/proc/self/mem", "path");
  char some[4];
  CHECK_FAILS(part.read_start(some, sizeof some), hrad::Status::file, "path: cannot read: ");
}

// What rank 0 alone does: making the file and giving it its name.
void what_rank_0_can_not_do() {
  const Folder folder("shared");
  std::filesystem::create_directories(folder.file("a.prev/is a folder"));
  write_bytes(folder.file("a"), "old");
  for (const auto& [path, text] :
       {std::pair<std::string, std::string>(folder.file("none/a"), "cannot create"),
        {folder.file("a.prev"), "cannot create"},
        {folder.file("a"), "cannot keep the old file"}}) {
    std::vector<std::string> messages(3);
    on_ranks(3, [&, path = path](Comm& comm) {
      messages[static_cast<size_t>(comm.rank())] =
          message_of(comm, [&] { write_new(comm, path, 1); });
    });
    CHECK(messages[1] == messages[0] && messages[2] == messages[0]);
    CHECK(messages[0].find(path + ": " + text) == 0);
    CHECK_EQUAL(folder.count(), 2);
  }
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(by_one<all_write_their_pieces>), HRAD_TEST(by_threads<all_write_their_pieces>),
      HRAD_TEST(by_one<modes_and_names>),        HRAD_TEST(by_threads<modes_and_names>),
      HRAD_TEST(by_one<abandoned_by_all>),       HRAD_TEST(by_threads<abandoned_by_all>),
      HRAD_TEST(every_step_on_every_rank),       HRAD_TEST(a_folder_that_is_not_shared),
      HRAD_TEST(a_part_that_can_not_be_read),
      HRAD_TEST(what_rank_0_can_not_do),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
