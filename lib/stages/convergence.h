// The convergence check (paper, Section 2): the total radiosity transported, compared between two
// iterations. Floor 7 (stages).
#pragma once

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

 private:
  double tolerance_;
  std::vector<double> last_, change_;
};

}  // namespace hrad
