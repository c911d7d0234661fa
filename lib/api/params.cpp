// hrad.h, section "parameters". Floor 9 (api).
#include "solver/params.h"

#include "api/arguments.h"
#include "api/guard.h"

namespace {

const hrad::ParamRow& row_of_type(const char* name, int32_t type) {
  hrad::api::require(name, "the parameter's name");
  const hrad::ParamRow& row = hrad::find_param(name);
  const char* const suffix[] = {"int", "double", "text"};
  if (row.type != type)
    hrad::fail(hrad::Status::argument, "parameter '%s' is not of type %s: read it with hrad_get_%s",
               name, suffix[type], suffix[row.type]);
  return row;
}

}  // namespace

hrad_status hrad_set_int(hrad_solver* solver, const char* name, int64_t value) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    hrad::api::require(name, "the parameter's name");
    inside.set_int(name, value);
  });
}

hrad_status hrad_set_double(hrad_solver* solver, const char* name, double value) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    hrad::api::require(name, "the parameter's name");
    inside.set_double(name, value);
  });
}

hrad_status hrad_set_text(hrad_solver* solver, const char* name, const char* value) {
  return hrad::api::collective(solver, [&](hrad::Solver& inside) {
    hrad::api::require(name, "the parameter's name");
    hrad::api::require(value, "the parameter's value");
    inside.set_text(name, value);
  });
}

hrad_status hrad_get_int(const hrad_solver* solver, const char* name, int64_t* value) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    const hrad::ParamRow& row = row_of_type(name, HRAD_PARAM_INT);
    hrad::api::require(value, "the place for the value");
    *value = inside.params().*row.as_int;
  });
}

hrad_status hrad_get_double(const hrad_solver* solver, const char* name, double* value) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    const hrad::ParamRow& row = row_of_type(name, HRAD_PARAM_DOUBLE);
    hrad::api::require(value, "the place for the value");
    *value = inside.params().*row.as_double;
  });
}

hrad_status hrad_get_text(const hrad_solver* solver, const char* name, char* text, int64_t size,
                          int64_t* needed) {
  return hrad::api::guarded(solver, [&](const hrad::Solver& inside) {
    hrad::api::require(name, "the parameter's name");
    const hrad::ParamRow& row = hrad::find_param(name);
    hrad::api::copy_text(hrad::param_text(inside.params(), row), text, size, needed);
  });
}

hrad_status hrad_describe_param(int64_t index, hrad_param* param) {
  return hrad::api::guarded([&] {
    hrad::api::require(param, "the place for the description");
    hrad::api::require_struct_size(param->struct_size, "hrad_param");
    const auto table = hrad::param_table();
    const auto rows = static_cast<int64_t>(table.size());
    if (index < 0 || index >= rows)
      hrad::fail(hrad::Status::argument, "there is no parameter %lld: there are %lld, from 0 on",
                 static_cast<long long>(index), static_cast<long long>(rows));
    const hrad::ParamRow& row = table[static_cast<size_t>(index)];
    hrad_param full = {};
    full.name = row.name;
    full.type = row.type;
    full.is_result = row.is_result ? 1 : 0;
    full.default_text = hrad::default_text(row);
    full.minimum = row.minimum;
    full.maximum = row.maximum;
    full.choices = row.choices;
    full.unit = row.unit;
    full.help = row.help;
    hrad::api::copy_struct_out(full, param);
  });
}
