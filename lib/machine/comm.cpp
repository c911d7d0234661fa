// Agreement before every exchange. Floor 2 (machine).
#include "machine/comm.h"

#include <cstring>
#include <utility>

namespace hrad {

// Throws when any process has failed.
bool Comm::agree(Word mine, const char* message) {
  mine.raised = has_raised_ ? 1 : 0;
  has_raised_ = false;
  if (alone()) {
    if (mine.status < 0) throw AgreedError(static_cast<Status>(mine.status), message);
    return mine.goes_on != 0;
  }
  const std::vector<Word> words = do_tell(mine);
  int others_raised = 0, failed = -1;
  bool all = true;
  for (int k = 0; k < static_cast<int>(words.size()); ++k) {
    if (k != rank()) others_raised += words[k].raised;
    if (failed < 0 && words[k].status < 0) failed = k;
    all = all && words[k].goes_on;
  }
  do_settle(others_raised);
  if (failed < 0) return all;
  // Messages under way must not stay so.
  if (std::exchange(exchanging_, false)) do_finish_exchange();
  Bytes text;
  if (failed == rank()) text.assign(message, message + std::strlen(message));
  do_broadcast(text, failed);
  throw AgreedError(static_cast<Status>(words[failed].status),
                    std::string(text.begin(), text.end()));
}

bool Comm::all_go_on(bool mine) {
  Word word;
  word.goes_on = mine ? 1 : 0;
  return agree(word, "");
}

void Comm::fail_all(Status status, const char* message) {
  this->raise();
  Word word;
  word.status = static_cast<int32_t>(status);
  agree(word, message);
  throw AgreedError(status, message);
}

void Comm::raise() {
  if (has_raised_) return;
  has_raised_ = true;
  do_raise();
}

bool Comm::raised() { return do_raised(); }

void Comm::broadcast(Bytes& data) {
  agree({}, "");
  do_broadcast(data, 0);
}

std::vector<Bytes> Comm::gather_all(const Bytes& mine) {
  agree({}, "");
  return do_gather_all(mine);
}

void Comm::start_exchange(std::vector<Bytes> to) {
  agree({}, "");
  do_start_exchange(std::move(to));
  exchanging_ = true;
}

std::vector<Bytes> Comm::finish_exchange() {
  agree({}, "");
  exchanging_ = false;
  return do_finish_exchange();
}

void Comm::add_up(Span<uint64_t> values) {
  agree({}, "");
  do_add_up(values);
}

}  // namespace hrad
