// How long a solve goes on, guessed from the pace of its present stage and from what is known of
// the later ones. It reads no clock: seconds since the solve began are told. Floor 8 (solver).
#pragma once

#include <functional>
#include <vector>

namespace hrad {

class TimeLeft {
 public:
  // expected: seconds that the stage may take, negative where nobody knows. later: of all that
  // follows it, for what its own length is guessed to be.
  void begin_stage(double now, double expected, std::function<double(double)> later);
  // The share of the stage that is done; it never falls.
  void report(double now, double share);
  // Negative while unknown.
  double left(double now) const;

 private:
  struct Mark {
    double elapsed, share;
  };
  double pace_since(double from, double elapsed) const;
  double left_of_stage(double elapsed) const;

  double begin_ = 0, expected_ = -1, share_ = 0;
  std::function<double(double)> later_ = [](double) { return 0.0; };
  std::vector<Mark> marks_{{0, 0}};  // of the stage, each later by a tenth than the one before
};

}  // namespace hrad
