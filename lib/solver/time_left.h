// How long a solve goes on, guessed from the pace of its present stage and from what is known of
// the later ones. It reads no clock: seconds since the solve began are told. Floor 8 (solver).
#pragma once

#include <functional>
#include <vector>

namespace hrad {

class TimeLeft {
 public:
  // What is guessed before a stage begins: the seconds it may take, negative where nobody knows,
  // and from which share on its pace alone tells more.
  struct Expected {
    double seconds, until = 0.2;
  };

  // later: seconds of all that follows the stage, for what its own length is guessed to be.
  void begin_stage(double now, Expected expected, std::function<double(double)> later);
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

  double begin_ = 0, share_ = 0;
  Expected expected_{-1};
  std::function<double(double)> later_ = [](double) { return 0.0; };
  std::vector<Mark> marks_{{0, 0}};  // of the stage, each later by a tenth than the one before
};

}  // namespace hrad
