// The convergence check (paper, Section 2): the total radiosity transported, compared between two
// iterations. Floor 7 (stages).
#pragma once

#include <utility>
#include <vector>

namespace hrad {

// Follows one series of sweeps.
class Convergence {
 public:
  // tolerance: the share of the total that may still be missing.
  explicit Convergence(double tolerance) : tolerance_(tolerance) {}

  // Takes the totals (per band) of an iteration; true when what is missing is below the tolerance
  // in every band. The change falls by a ratio q from sweep to sweep, so after a change d there is
  // d q/(1-q) to come: a small change alone proves nothing where reflectances are high.
  bool reached(const std::vector<double>& total);

  // Of the sweeps that it takes, the share that has been done, if the light goes on as it did.
  double share_of_way() const { return sweeps_ > 0 ? sweeps_ / (sweeps_ + to_come_) : 0; }

  // What it knows so far, to be kept in a file: the totals of the last iteration and by how much
  // they had changed; empty before the first and the second one.
  double tolerance() const { return tolerance_; }
  const std::vector<double>& last() const { return last_; }
  const std::vector<double>& change() const { return change_; }
  Convergence(double tolerance, std::vector<double> last, std::vector<double> change)
      : tolerance_(tolerance), last_(std::move(last)), change_(std::move(change)) {}

 private:
  double tolerance_;
  std::vector<double> last_, change_;
  double sweeps_ = 0, to_come_ = 1;  // since this began, and as many as may follow
};

}  // namespace hrad
