// When a parameter of a solver may change: result parameters decide the bits, so that they hold
// from the first solve on, but for those that go on refining. No rank takes a value unless all of
// them accept theirs. Floor 8 (solver).
#include <utility>

#include "base/error.h"
#include "solver/solution.h"

namespace hrad {
namespace {

// Whether a result parameter may still change from one value to another when a solve has begun.
bool may_go_on(const ParamRow& row, const Params& now, const Params& next) {
  if (row.as_double == &Params::accuracy) return next.accuracy <= now.accuracy;
  if (row.as_int == &Params::max_iterations) return next.max_iterations >= now.max_iterations;
  return row.as_int == &Params::refine || same_value(now, next, row);
}

// The parameters with one of them changed, after the checks that need no solver.
template <class Value>
Params changed(const Params& now, const ParamRow& row, const Value& value) {
  Params next = now;
  set_param(next, row, value);
  return next;
}

// Throws when the state of the solver forbids the change of this parameter.
void check_change(const ParamRow& row, const Params& now, const Params& next, const Scene& scene,
                  bool partitioned, bool begun) {
  if (!row.is_result || same_value(now, next, row)) return;
  const std::string from = param_text(now, row), to = param_text(next, row);
  if (begun && !may_go_on(row, now, next))
    fail(Status::state,
         "parameter '%s' is %s since the solve began and can't become %s: make a new solver",
         row.name, from.c_str(), to.c_str());
  if (partitioned && row.as_text == &Params::visibility)
    fail(Status::state,
         "parameter 'visibility' is %s since the partition and can't become %s: set it before",
         from.c_str(), to.c_str());
  if (row.as_int == &Params::bands && (!scene.materials.empty() || scene.patch_count() > 0))
    fail(Status::state,
         "parameter 'bands' is %s since the first material and can't become %s: set it before",
         from.c_str(), to.c_str());
}

}  // namespace

void Solver::set_int(const std::string& name, int64_t value) {
  const ParamRow& row = find_param(name);
  Params next = changed(params_, row, value);
  check_change(row, params_, next, scene_, solution_ != nullptr, begun_);
  comm_->all_go_on();
  params_ = std::move(next);
  scene_.bands = static_cast<int>(params_.bands);
  if (solution_) solution_->state.memory.set_limit(params_.max_memory);
}

void Solver::set_double(const std::string& name, double value) {
  const ParamRow& row = find_param(name);
  Params next = changed(params_, row, value);
  check_change(row, params_, next, scene_, solution_ != nullptr, begun_);
  comm_->all_go_on();
  params_ = std::move(next);
}

void Solver::set_text(const std::string& name, const std::string& value) {
  const ParamRow& row = find_param(name);
  Params next = changed(params_, row, value);
  check_change(row, params_, next, scene_, solution_ != nullptr, begun_);
  comm_->all_go_on();
  params_ = std::move(next);
  scene_.bands = static_cast<int>(params_.bands);
  if (solution_) solution_->state.memory.set_limit(params_.max_memory);
  set_up_axis();
}

void Solver::set_up_axis() {
  if (params_.up != "auto") scene_.z_up = params_.up == "z";
}

}  // namespace hrad
