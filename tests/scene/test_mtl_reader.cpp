// MTL texts: Kd and Ke, line ends and encodings, what is clamped, ignored and refused.
#include "base/error.h"
#include "scene/mtl_reader.h"
#include "support/check.h"

using hrad::MtlLibrary;
using hrad::Status;

namespace {

using Color = std::array<double, 3>;

MtlLibrary read(const std::string& text) {
  MtlLibrary library;
  hrad::read_mtl("a.mtl", text, library);
  return library;
}

void check_error(const std::string& text, const std::string& message) {
  CHECK_FAILS(read(text), Status::scene, message);
}

void reflectance_and_emission() {
  const MtlLibrary l = read(
      "# file\n\nnewmtl one\n  Ka 1 1 1\n\tKd 0.1 .2 3e-1\n  Ke 1 20 300\n  illum 2\r\n"
      "newmtl  second one \nKd 0.4\nKe 7\nnewmtl last");
  CHECK_EQUAL(l.materials.size(), size_t{3});
  CHECK(l.materials[0].name == "one");
  CHECK((l.materials[0].reflectance == Color{.1, .2, .3}));
  CHECK((l.materials[0].emission == Color{1, 20, 300}));
  CHECK(l.materials[1].name == "second one");
  CHECK((l.materials[1].reflectance == Color{.4, .4, .4}));
  CHECK((l.materials[1].emission == Color{7, 7, 7}));
  CHECK(l.materials[1].has_reflectance && !l.materials[2].has_reflectance);
  CHECK((l.materials[2].reflectance == Color{.5, .5, .5}));
  CHECK((l.materials[2].emission == Color{0, 0, 0}));
  CHECK_EQUAL(l.numbers.at("second one"), 1);
  CHECK_EQUAL(l.clamped + l.textures + l.repeated, int64_t{0});
}

void too_bright_reflectance_is_clamped() {
  const MtlLibrary l = read("newmtl a\nKd 1 0.999 5\nnewmtl b\nKd 1\n");
  CHECK((l.materials[0].reflectance == Color{.99, .999, .99}));
  CHECK((l.materials[1].reflectance == Color{.99, .99, .99}));
  CHECK_EQUAL(l.clamped, int64_t{5});
  CHECK(l.first_clamped == "a.mtl:2");
}

void textures_are_counted() {
  const MtlLibrary l =
      read("newmtl a\nmap_Kd wall paper.png\nKd .5\nbump b.png\nmap_Ke -mm 0 1 e.png\n#map_d x\n");
  CHECK_EQUAL(l.textures, int64_t{3});
  CHECK(l.first_texture == "a.mtl:2");
}

void marks_are_read() {
  const MtlLibrary l = read(
      "newmtl a\nKd .5\n# hrad: two-sided\n# hrad:  blocker\nnewmtl b\nKe 2\n# hrad:two-sided\n"
      "newmtl a\n# hrad: two-sided\nnewmtl c\n## hrad: blocker\n");
  CHECK(l.materials[0].two_sided && l.materials[0].blocker);
  CHECK(l.materials[1].two_sided && !l.materials[1].blocker);
  CHECK(!l.materials[2].two_sided && !l.materials[2].blocker);
}

void the_first_definition_counts() {
  MtlLibrary l = read("newmtl a\nKd .1\nnewmtl a\nKd .2\nKe 3\nnewmtl b\nKd .3\n");
  CHECK_EQUAL(l.materials.size(), size_t{2});
  CHECK((l.materials[0].reflectance == Color{.1, .1, .1}));
  CHECK((l.materials[0].emission == Color{0, 0, 0}));
  CHECK_EQUAL(l.repeated, int64_t{1});
  CHECK(l.first_repeated == "a.mtl:3");
  hrad::read_mtl("b.mtl", "newmtl b\nKd .9\nnewmtl c\nKd .4\n", l);
  CHECK_EQUAL(l.materials.size(), size_t{3});
  CHECK((l.materials[1].reflectance == Color{.3, .3, .3}));
  CHECK_EQUAL(l.repeated, int64_t{2});
}

void refused() {
  check_error("# hrad: two-sided\nnewmtl a\n", "a.mtl:1: a mark before the first newmtl");
  check_error("newmtl a\n# hrad: twosided\n", "a.mtl:2: the mark 'twosided' is unknown");
  check_error("newmtl a\n# hrad:\n", "a.mtl:2: the mark '' is unknown");
  check_error("newmtl a\n# hrad: blocker\nKe 0 1 0\n", "a.mtl:3: material 'a' is a blocker");
  check_error("newmtl a\nKe 1\n# hrad: blocker\n", "a.mtl:3: material 'a' is a blocker");
  check_error("newmtl a\nKd spectral wall.rfl 1\n", "a.mtl:2: Kd spectral is not supported");
  check_error("newmtl a\nKe xyz 1 1 1\n", "a.mtl:2: Ke xyz is not supported");
  check_error("newmtl a\nKd .1 .2\n", "a.mtl:2: Kd needs one or three numbers, not 2");
  check_error("newmtl a\nKd\n", "a.mtl:2: Kd needs one or three numbers, not 0");
  check_error("newmtl a\nKd .1 .1 .1 .1\n", "not 4");
  check_error("newmtl a\nKd .1 -.1 .1\n", "a.mtl:2: Kd '-.1' is negative");
  check_error("newmtl a\nKe -1 0 0\n", "a.mtl:2: Ke '-1' is negative");
  check_error("newmtl a\nKe 1e31\n", "a.mtl:2: '1e31' is beyond 1e30");
  check_error("newmtl a\nKd 1e999\n", "a.mtl:2: '1e999' is beyond 1e30");
  for (const char* word : {"nan", "inf", "0,5", "0x1", "1f", "red"})
    check_error(std::string("newmtl a\nKd .1 .1 ") + word + "\n",
                "a.mtl:2: '" + std::string(word) + "' is not a number");
  check_error("Kd .5\nnewmtl a\n", "a.mtl:1: Kd before the first newmtl");
  check_error("newmtl\nKd .5\n", "a.mtl:1: newmtl without a name");
  check_error(std::string("newmtl a\n\0", 10), "a.mtl:2: a zero byte");
}

// Of ASCII.
std::string utf16(const std::string& ascii, bool big_end, bool mark) {
  std::string result;
  if (mark) result += big_end ? "\xfe\xff" : "\xff\xfe";
  for (char c : ascii) {
    if (big_end) result += '\0';
    result += c;
    if (!big_end) result += '\0';
  }
  return result;
}

void lines_end_in_any_way() {
  for (const char* text :
       {"newmtl a\nKd .1\nnewmtl b\nKe 2", "newmtl a\r\nKd .1\r\nnewmtl b\r\nKe 2\r\n",
        "newmtl a\rKd .1\rnewmtl b\rKe 2\r", "\xef\xbb\xbfnewmtl a\nKd .1\nnewmtl b\nKe 2\n",
        "\xef\xbb\xbfnewmtl a\rKd .1\r\n\nnewmtl b\rKe \\\r\n2\r"}) {
    const MtlLibrary l = read(text);
    CHECK_EQUAL(l.materials.size(), size_t{2});
    CHECK(l.materials[0].name == "a" && l.materials[1].name == "b");
    CHECK((l.materials[0].reflectance == Color{.1, .1, .1}));
    CHECK((l.materials[1].emission == Color{2, 2, 2}));
    CHECK_EQUAL(l.unknown, int64_t{0});
  }
  // Counted as an editor does.
  check_error("newmtl a\rKd .1\r\nKe x\n", "a.mtl:3: 'x' is not a number");
}

void other_encodings_are_named() {
  for (bool big_end : {false, true})
    for (bool mark : {false, true})
      check_error(utf16("newmtl a\nKd .1\n", big_end, mark), "a.mtl:1: this is UTF-16");
}

void what_this_reader_has_no_use_for_is_counted() {
  const MtlLibrary l = read(
      "newmtl a\nKd .1\nNi 1\nillum 2\nd 1\nTr 0\nKs 0 0 0\nTf 1 1 1\nkd 1\n"
      "newmtl b\nKd .1\nKs 0 .5 0\nKs 1 1 1\nd -halo 0.5\nTr 0.5\nnewmtl c\nTr 1\nfoo\n");
  CHECK_EQUAL(l.unknown, int64_t{2});
  CHECK(l.first_unknown == "a.mtl:9");
  CHECK_EQUAL(l.specular, int64_t{1});
  CHECK(l.first_specular == "a.mtl:12");
  CHECK_EQUAL(l.transparent, int64_t{2});
  CHECK(l.first_transparent == "a.mtl:14");
}

void too_small_numbers_are_zero() {
  const MtlLibrary l = read("newmtl a\nKd .5 1e-999 .5\nKe 1e-320 1 1e-30\n");
  CHECK((l.materials[0].reflectance == Color{.5, 0, .5}));
  CHECK((l.materials[0].emission == Color{0, 1, 1e-30}));
  CHECK_EQUAL(l.vanished, int64_t{2});
  CHECK(l.first_vanished == "a.mtl:3");
}

void minus_zero_is_zero() {
  const MtlLibrary l = read("newmtl a\nKd -0 0 0\nKe -0.0\n");
  CHECK(!std::signbit(l.materials[0].reflectance[0]) && !std::signbit(l.materials[0].emission[0]));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {
      HRAD_TEST(reflectance_and_emission),
      HRAD_TEST(too_bright_reflectance_is_clamped),
      HRAD_TEST(textures_are_counted),
      HRAD_TEST(marks_are_read),
      HRAD_TEST(the_first_definition_counts),
      HRAD_TEST(refused),
      HRAD_TEST(lines_end_in_any_way),
      HRAD_TEST(other_encodings_are_named),
      HRAD_TEST(what_this_reader_has_no_use_for_is_counted),
      HRAD_TEST(too_small_numbers_are_zero),
      HRAD_TEST(minus_zero_is_zero),
  };
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
