// The parameter table: every row is sound, values are read strictly, names are hinted at.
#include <clocale>
#include <cstring>
#include <limits>
#include <set>
#include <string>

#include "base/error.h"
#include "solver/params.h"
#include "support/check.h"

using namespace hrad;

namespace {

const double kNan = std::numeric_limits<double>::quiet_NaN();
const double kInfinity = std::numeric_limits<double>::infinity();

void set(Params& params, const char* name, const char* value) {
  set_param(params, find_param(name), std::string(value));
}

void rows_are_sound() {
  std::set<std::string> names;
  for (const ParamRow& row : param_table()) {
    CHECK(names.insert(row.name).second);
    CHECK(row.type >= 0 && row.type <= 2);
    CHECK_EQUAL(row.as_int != nullptr, row.type == 0);
    CHECK_EQUAL(row.as_double != nullptr, row.type == 1);
    CHECK_EQUAL(row.as_text != nullptr, row.type == 2);
    CHECK(row.unit != nullptr);
    const size_t length = std::strlen(row.help);
    CHECK(length > 10 && row.help[length - 1] == '.');
    CHECK(std::strstr(row.help, ". ") == nullptr);  // one sentence
    if (row.type == 2)
      CHECK(row.minimum == 0 && row.maximum == 0);
    else
      CHECK(row.minimum < row.maximum && row.choices == nullptr);
  }
  for (const char* name : {"bands", "accuracy", "linking", "oracle", "bf_epsilon", "min_area",
                           "tolerance", "max_iterations", "refine", "seed", "unit", "visibility",
                           "threads", "smt", "bind", "partition", "max_memory", "sides"})
    CHECK(names.count(name) == 1);
}

// The default text, set as text, gives the default value and the same text again.
void defaults_go_round() {
  for (const ParamRow& row : param_table()) {
    Params params;
    set_param(params, row, std::string(default_text(row)));
    CHECK(same_value(params, Params(), row));
    CHECK(param_text(params, row) == default_text(row));
    CHECK(default_text(row) == default_text(row));  // the same pointer for ever
  }
}

void bounds_are_included() {
  for (const ParamRow& row : param_table()) {
    Params params;
    if (row.type == 0) {
      const auto low = static_cast<int64_t>(row.minimum), high = static_cast<int64_t>(row.maximum);
      set_param(params, row, low);
      CHECK_EQUAL(params.*row.as_int, low);
      set_param(params, row, high);
      CHECK_EQUAL(params.*row.as_int, high);
      CHECK_FAILS(set_param(params, row, low - 1), Status::argument, row.name);
      CHECK_FAILS(set_param(params, row, high + 1), Status::argument, row.name);
      CHECK_FAILS(set_param(params, row, std::numeric_limits<int64_t>::min()), Status::argument,
                  "");
      CHECK_FAILS(set_param(params, row, std::numeric_limits<int64_t>::max()), Status::argument,
                  "");
      CHECK_FAILS(set_param(params, row, 1.0), Status::argument, "an integer");
      CHECK_EQUAL(params.*row.as_int, high);
    } else if (row.type == 1) {
      set_param(params, row, row.minimum);
      CHECK(params.*row.as_double == row.minimum);
      set_param(params, row, row.maximum);
      CHECK(params.*row.as_double == row.maximum);
      CHECK_FAILS(set_param(params, row, std::nextafter(row.minimum, -kInfinity)), Status::argument,
                  row.name);
      CHECK_FAILS(set_param(params, row, std::nextafter(row.maximum, kInfinity)), Status::argument,
                  row.name);
      CHECK_FAILS(set_param(params, row, kNan), Status::argument, row.name);
      CHECK_FAILS(set_param(params, row, kInfinity), Status::argument, row.name);
      CHECK_FAILS(set_param(params, row, int64_t{1}), Status::argument, "a real number");
      CHECK(params.*row.as_double == row.maximum);
    } else {
      CHECK_FAILS(set_param(params, row, int64_t{1}), Status::argument, row.name);
      CHECK_FAILS(set_param(params, row, 1.0), Status::argument, row.name);
    }
  }
}

void choices_are_closed() {
  for (const ParamRow& row : param_table()) {
    if (!row.choices) continue;
    Params params;
    std::string rest = row.choices;
    for (size_t end = 0; end != std::string::npos;) {
      end = rest.find('|');
      const std::string word = rest.substr(0, end);
      set_param(params, row, word);
      CHECK(params.*row.as_text == word);
      rest = end == std::string::npos ? "" : rest.substr(end + 1);
    }
    for (const char* wrong : {"", "|", "nonsense", row.choices})
      CHECK_FAILS(set_param(params, row, std::string(wrong)), Status::argument, row.choices);
  }
}

void numbers_are_read_whole() {
  Params params;
  set(params, "accuracy", "5e-2");
  CHECK(params.accuracy == 0.05);
  set(params, "threads", "12");
  CHECK_EQUAL(params.threads, 12);
  for (const char* wrong : {"", " ", "0.05 ", " 0.05", "0,05", "0.05x", "+0.05", "nan", "inf",
                            "0x1p-4", "1e999", "--1", "1e-400"})
    CHECK_FAILS(set(params, "accuracy", wrong), Status::argument, "0.0005 to 0.5");
  for (const char* wrong :
       {"", " 1", "1 ", "1.0", "1e2", "0x10", "+1", "-1", "4097", "99999999999999999999"})
    CHECK_FAILS(set(params, "threads", wrong), Status::argument, "0 to 4096 threads");
  CHECK_FAILS(set_param(params, find_param("threads"), std::string("1\0002", 3)), Status::argument,
              "threads");
  CHECK(params.accuracy == 0.05);
  CHECK_EQUAL(params.threads, 12);
}

void zero_has_no_sign() {
  Params params;
  set(params, "tolerance", "-0");
  CHECK(!std::signbit(params.tolerance));
  CHECK(param_text(params, find_param("tolerance")) == "0");
}

// A decimal comma in the process's locale changes neither reading nor writing.
void locale_does_not_matter() {
  const std::string before = std::setlocale(LC_NUMERIC, nullptr);
  for (const char* locale : {"de_DE.UTF-8", "fr_FR.UTF-8", "C"}) {
    if (!std::setlocale(LC_NUMERIC, locale)) continue;
    Params params;
    set(params, "accuracy", "0.125");
    CHECK(params.accuracy == 0.125);
    CHECK(param_text(params, find_param("accuracy")) == "0.125");
    CHECK_FAILS(set(params, "accuracy", "0,125"), Status::argument, "0.0005 to 0.5");
  }
  std::setlocale(LC_NUMERIC, before.c_str());
}

// Reals are written so that reading them gives the same bits.
void text_keeps_every_bit() {
  const ParamRow& row = find_param("accuracy");
  for (double value : {0.1, 1.0 / 3, 0.0005, std::nextafter(0.02, 1.0)}) {
    Params params, again;
    set_param(params, row, value);
    set_param(again, row, param_text(params, row));
    CHECK(again.accuracy == value);
    CHECK(param_text(again, row).find('e') == std::string::npos);  // as people write them
  }
}

void names_are_hinted_at() {
  CHECK_FAILS(find_param("acuracy"), Status::argument, "did you mean 'accuracy'");
  CHECK_FAILS(find_param("max-memory"), Status::argument, "did you mean 'max_memory'");
  CHECK_FAILS(find_param("thread"), Status::argument, "did you mean 'threads'");
  CHECK_FAILS(find_param("Seed"), Status::argument, "did you mean 'seed'");
  for (const char* far : {"", "x", "colour_temperature"})
    CHECK_FAILS(find_param(far), Status::argument, "the parameters are bands, accuracy");
  CHECK_FAILS(find_param(std::string(1000000, 'a')), Status::argument, "...");
  CHECK_FAILS(find_param(std::string("seed\0x", 6)), Status::argument, "seed?");
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {HRAD_TEST(rows_are_sound),         HRAD_TEST(defaults_go_round),
                              HRAD_TEST(bounds_are_included),    HRAD_TEST(choices_are_closed),
                              HRAD_TEST(numbers_are_read_whole), HRAD_TEST(zero_has_no_sign),
                              HRAD_TEST(locale_does_not_matter), HRAD_TEST(text_keeps_every_bit),
                              HRAD_TEST(names_are_hinted_at)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
