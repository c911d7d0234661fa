/* Parameters through the C API: the whole table is walked, every row is set and read in its own
 * type and as text, and wrong names, types and values are refused with a message that helps. */
#include <float.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

#include "api.h"

static int64_t row_count(void) {
  hrad_param row = {.struct_size = sizeof row};
  int64_t rows = 0;
  while (hrad_describe_param(rows, &row) == HRAD_OK) ++rows;
  return rows;
}

static hrad_param describe(int64_t index) {
  hrad_param row = {.struct_size = sizeof row};
  assert_ok(hrad_describe_param(index, &row));
  return row;
}

static void every_row_is_described(void** state) {
  const int64_t rows = row_count();
  (void)state;
  assert_true(rows >= 18);
  for (int64_t i = 0; i < rows; ++i) {
    const hrad_param row = describe(i);
    assert_int_equal(row.struct_size, sizeof row);
    assert_true(row.name && *row.name);
    assert_true(row.type == HRAD_PARAM_INT || row.type == HRAD_PARAM_DOUBLE ||
                row.type == HRAD_PARAM_TEXT);
    assert_true(row.is_result == 0 || row.is_result == 1);
    assert_true(row.default_text && *row.default_text);
    assert_true(row.unit != NULL);
    assert_true(row.help && strlen(row.help) > 10);
    if (row.type == HRAD_PARAM_TEXT) {
      assert_true(row.minimum == 0 && row.maximum == 0);
    } else {
      assert_true(row.minimum < row.maximum);
      assert_null(row.choices);
    }
    for (int64_t j = 0; j < i; ++j) assert_string_not_equal(row.name, describe(j).name);
  }
}

static void table_ends(void** state) {
  hrad_param row = {.struct_size = sizeof row, .name = "untouched"};
  (void)state;
  assert_status(hrad_describe_param(-1, &row), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_describe_param(row_count(), &row), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_describe_param(INT64_MAX, &row), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_describe_param(INT64_MIN, &row), HRAD_ERROR_ARGUMENT);
  assert_string_equal(row.name, "untouched");
}

/* A program built against a header whose struct ended after `type` sees no write beyond. */
static void shorter_struct_is_respected(void** state) {
  hrad_param row;
  (void)state;
  memset(&row, 0x5a, sizeof row);
  row.struct_size = offsetof(hrad_param, is_result);
  assert_ok(hrad_describe_param(0, &row));
  assert_string_equal(row.name, "bands");
  assert_int_equal(row.type, HRAD_PARAM_INT);
  assert_int_equal(row.is_result, 0x5a5a5a5a);
  assert_int_equal(row.struct_size, offsetof(hrad_param, is_result));
}

static void longer_struct_is_accepted(void** state) {
  struct {
    hrad_param row;
    char later_fields[64];
  } newer;
  (void)state;
  memset(&newer, 0x5a, sizeof newer);
  newer.row.struct_size = sizeof newer;
  assert_ok(hrad_describe_param(0, &newer.row));
  assert_string_equal(newer.row.name, "bands");
  assert_int_equal(newer.row.struct_size, sizeof newer);
  for (size_t i = 0; i < sizeof newer.later_fields; ++i)
    assert_int_equal(newer.later_fields[i], 0x5a);
}

static void every_row_is_set_and_read(void** state) {
  hrad_solver* solver = new_solver();
  const int64_t rows = row_count();
  (void)state;
  for (int64_t i = 0; i < rows; ++i) {
    const hrad_param row = describe(i);
    char text[256], again[256];
    int64_t needed = -1, whole = -1;
    double real = -1;
    assert_ok(hrad_get_text(solver, row.name, text, sizeof text, &needed));
    assert_string_equal(text, row.default_text);
    assert_int_equal(needed, strlen(text) + 1);
    assert_ok(hrad_set_text(solver, row.name, row.default_text));
    if (row.type == HRAD_PARAM_INT) {
      assert_ok(hrad_set_int(solver, row.name, (int64_t)row.maximum));
      assert_ok(hrad_get_int(solver, row.name, &whole));
      assert_true(whole == (int64_t)row.maximum);
      assert_fails(hrad_set_int(solver, row.name, (int64_t)row.maximum + 1), HRAD_ERROR_ARGUMENT,
                   row.name);
      assert_fails(hrad_set_int(solver, row.name, (int64_t)row.minimum - 1), HRAD_ERROR_ARGUMENT,
                   row.name);
      assert_ok(hrad_set_int(solver, row.name, (int64_t)row.minimum));
      assert_ok(hrad_get_int(solver, row.name, &whole));
      assert_true(whole == (int64_t)row.minimum);
      assert_fails(hrad_set_double(solver, row.name, row.minimum), HRAD_ERROR_ARGUMENT, row.name);
      assert_fails(hrad_get_double(solver, row.name, &real), HRAD_ERROR_ARGUMENT, row.name);
    } else if (row.type == HRAD_PARAM_DOUBLE) {
      assert_ok(hrad_set_double(solver, row.name, row.minimum));
      assert_ok(hrad_set_double(solver, row.name, row.maximum));
      assert_ok(hrad_get_double(solver, row.name, &real));
      assert_true(real == row.maximum);
      assert_fails(hrad_set_double(solver, row.name, row.maximum * 1.001), HRAD_ERROR_ARGUMENT,
                   row.name);
      assert_fails(hrad_set_double(solver, row.name, row.minimum - 1e-9), HRAD_ERROR_ARGUMENT,
                   row.name);
      assert_fails(hrad_set_double(solver, row.name, NAN), HRAD_ERROR_ARGUMENT, row.name);
      assert_fails(hrad_set_double(solver, row.name, INFINITY), HRAD_ERROR_ARGUMENT, row.name);
      assert_fails(hrad_set_int(solver, row.name, 1), HRAD_ERROR_ARGUMENT, row.name);
      assert_fails(hrad_get_int(solver, row.name, &whole), HRAD_ERROR_ARGUMENT, row.name);
      assert_ok(hrad_get_double(solver, row.name, &real));
      assert_true(real == row.maximum);
    } else {
      assert_fails(hrad_set_int(solver, row.name, 1), HRAD_ERROR_ARGUMENT, row.name);
      assert_fails(hrad_set_double(solver, row.name, 1), HRAD_ERROR_ARGUMENT, row.name);
      assert_fails(hrad_get_int(solver, row.name, &whole), HRAD_ERROR_ARGUMENT, row.name);
      assert_fails(hrad_get_double(solver, row.name, &real), HRAD_ERROR_ARGUMENT, row.name);
      if (row.choices)
        assert_fails(hrad_set_text(solver, row.name, "nonsense"), HRAD_ERROR_ARGUMENT, row.choices);
    }
    /* What is read as text can be set as text. */
    assert_ok(hrad_get_text(solver, row.name, text, sizeof text, NULL));
    assert_ok(hrad_set_text(solver, row.name, text));
    assert_ok(hrad_get_text(solver, row.name, again, sizeof again, NULL));
    assert_string_equal(text, again);
  }
  hrad_destroy(&solver);
}

static void promised_ranges(void** state) {
  hrad_solver* solver = new_solver();
  (void)state;
  assert_fails(hrad_set_double(solver, "accuracy", 0.51), HRAD_ERROR_ARGUMENT, "0.0005 to 0.5");
  assert_fails(hrad_set_double(solver, "accuracy", 0.0004), HRAD_ERROR_ARGUMENT, "0.0005 to 0.5");
  assert_ok(hrad_set_double(solver, "accuracy", 0.0005));
  assert_ok(hrad_set_double(solver, "accuracy", 0.5));
  assert_fails(hrad_set_int(solver, "bands", 17), HRAD_ERROR_ARGUMENT, "1 to 16");
  assert_fails(hrad_set_int(solver, "bands", 0), HRAD_ERROR_ARGUMENT, "1 to 16");
  hrad_destroy(&solver);
}

static void text_is_read_whole(void** state) {
  static const char* const wrong[] = {"",    " 0.1", "0.1 ", "0,1",   "0.1x", "+0.1",
                                      "nan", "inf",  "0x1",  "1e999", "rows"};
  hrad_solver* solver = new_solver();
  double accuracy = -1;
  int64_t threads = -1;
  (void)state;
  assert_ok(hrad_set_text(solver, "accuracy", "1e-1"));
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; ++i)
    assert_fails(hrad_set_text(solver, "accuracy", wrong[i]), HRAD_ERROR_ARGUMENT, "accuracy");
  assert_ok(hrad_get_double(solver, "accuracy", &accuracy));
  assert_true(accuracy == 0.1);
  assert_ok(hrad_set_text(solver, "threads", "3"));
  assert_fails(hrad_set_text(solver, "threads", "3.0"), HRAD_ERROR_ARGUMENT, "threads");
  assert_fails(hrad_set_text(solver, "threads", "-1"), HRAD_ERROR_ARGUMENT, "0 to 4096");
  assert_ok(hrad_get_int(solver, "threads", &threads));
  assert_true(threads == 3);
  hrad_destroy(&solver);
}

/* What a checkpoint has room for. */
static void texts_have_a_longest(void** state) {
  hrad_solver* solver = new_solver();
  static char text[4098];
  (void)state;
  memset(text, 'm', 4096);
  assert_ok(hrad_set_text(solver, "unit", text));
  text[4096] = 'm';
  assert_fails(hrad_set_text(solver, "unit", text), HRAD_ERROR_ARGUMENT, "4096");
  hrad_destroy(&solver);
}

static void unknown_names_get_a_hint(void** state) {
  hrad_solver* solver = new_solver();
  char text[8] = "keep";
  (void)state;
  assert_fails(hrad_set_int(solver, "thread", 1), HRAD_ERROR_ARGUMENT, "'threads'");
  assert_fails(hrad_set_double(solver, "acuracy", 0.1), HRAD_ERROR_ARGUMENT, "'accuracy'");
  assert_fails(hrad_set_text(solver, "linkin", "rows"), HRAD_ERROR_ARGUMENT, "'linking'");
  assert_fails(hrad_get_text(solver, "max-memory", text, sizeof text, NULL), HRAD_ERROR_ARGUMENT,
               "'max_memory'");
  assert_fails(hrad_set_int(solver, "nothing_like_it", 1), HRAD_ERROR_ARGUMENT, "accuracy");
  assert_string_equal(text, "keep");
  hrad_destroy(&solver);
}

static void text_buffers_are_cut(void** state) {
  hrad_solver* solver = new_solver();
  char text[16];
  int64_t needed = -1;
  (void)state;
  assert_ok(hrad_set_text(solver, "unit", "kilometre"));
  memset(text, 'x', sizeof text);
  assert_ok(hrad_get_text(solver, "unit", text, 5, &needed));
  assert_string_equal(text, "kilo");
  assert_int_equal(text[5], 'x');
  assert_int_equal(needed, 10);
  assert_ok(hrad_get_text(solver, "unit", text, 1, NULL));
  assert_string_equal(text, "");
  needed = -1;
  assert_ok(hrad_get_text(solver, "unit", NULL, 0, &needed));
  assert_int_equal(needed, 10);
  assert_ok(hrad_get_text(solver, "unit", text, 10, &needed));
  assert_string_equal(text, "kilometre");
  needed = -1;
  assert_status(hrad_get_text(solver, "unit", text, -1, &needed), HRAD_ERROR_ARGUMENT);
  assert_status(hrad_get_text(solver, "unit", NULL, 4, &needed), HRAD_ERROR_ARGUMENT);
  assert_int_equal(needed, -1);
  hrad_destroy(&solver);
}

static void bands_are_fixed_by_the_first_material(void** state) {
  hrad_solver* solver = new_solver();
  int64_t bands = -1;
  (void)state;
  assert_ok(hrad_set_int(solver, "bands", 5));
  assert_ok(hrad_set_int(solver, "bands", 2));
  add_gray(solver, 0.5, 0, 0);
  assert_fails(hrad_set_int(solver, "bands", 3), HRAD_ERROR_STATE, "2");
  assert_fails(hrad_set_text(solver, "bands", "3"), HRAD_ERROR_STATE, "3");
  assert_ok(hrad_set_int(solver, "bands", 2));
  assert_ok(hrad_get_int(solver, "bands", &bands));
  assert_true(bands == 2);
  hrad_destroy(&solver);
}

static void solvers_do_not_share_parameters(void** state) {
  hrad_solver *a = new_solver(), *b = new_solver();
  int64_t seed = -1;
  (void)state;
  assert_ok(hrad_set_int(a, "seed", 77));
  assert_ok(hrad_get_int(b, "seed", &seed));
  assert_true(seed == 1);
  hrad_destroy(&a);
  hrad_destroy(&b);
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(every_row_is_described),
      cmocka_unit_test(table_ends),
      cmocka_unit_test(shorter_struct_is_respected),
      cmocka_unit_test(longer_struct_is_accepted),
      cmocka_unit_test(every_row_is_set_and_read),
      cmocka_unit_test(promised_ranges),
      cmocka_unit_test(text_is_read_whole),
      cmocka_unit_test(texts_have_a_longest),
      cmocka_unit_test(unknown_names_get_a_hint),
      cmocka_unit_test(text_buffers_are_cut),
      cmocka_unit_test(bands_are_fixed_by_the_first_material),
      cmocka_unit_test(solvers_do_not_share_parameters),
  };
  return cmocka_run_group_tests(tests, NULL, NULL);
}
