// Reads MTL text. Floor 3 (scene).
#include "scene/mtl_reader.h"

#include <algorithm>

#include "scene/obj_lexer.h"

namespace hrad {

namespace {

// A surface that reflects everything has no equilibrium; this is the nearest the solver takes.
constexpr double largest_reflectance = 0.99;

// Radiosity is kept in single precision; the C interface refuses less.
constexpr double smallest_emission = 1e-30;

// Counts an event and keeps the place of the first one.
void note(int64_t& count, std::string& first, const ObjLexer& lexer) {
  if (count++ == 0) first = lexer.here();
}

void refuse_shining_blocker(const MtlMaterial& material, const ObjLexer& lexer) {
  for (const double value : material.emission)
    if (material.blocker && value > 0)
      lexer.fail_here("material " + quoted(material.name) + " is a blocker and can't emit");
}

void read_mark(MtlMaterial& material, const ObjLexer& lexer) {
  if (lexer.rest() == "two-sided")
    material.two_sided = true;
  else if (lexer.rest() == "blocker")
    material.blocker = true;
  else
    lexer.fail_here("the mark " + quoted(lexer.rest()) +
                    " is unknown: a material can be two-sided or blocker");
  refuse_shining_blocker(material, lexer);
}

// The one or three numbers of Kd or Ke.
std::array<double, 3> color(ObjLexer& lexer) {
  const std::string name(lexer.keyword());
  const auto& words = lexer.words();
  if (!words.empty() && (words[0] == "spectral" || words[0] == "xyz"))
    lexer.fail_here(name + " " + std::string(words[0]) +
                    " is not supported: give one or three numbers (red, green, blue)");
  if (words.size() != 1 && words.size() != 3)
    lexer.fail_here(name + " needs one or three numbers, not " + std::to_string(words.size()));
  std::array<double, 3> values;
  for (size_t i = 0; i < 3; ++i) {
    const size_t word = words.size() == 1 ? 0 : i;
    values[i] = lexer.number(word);
    if (values[i] < 0) lexer.fail_here(name + " " + quoted(words[word]) + " is negative");
    if (values[i] == 0) values[i] = 0;  // not -0
  }
  return values;
}

// Statements without a meaning for diffuse light.
constexpr std::string_view silent[] = {"Ka", "Ns", "Ni", "Tf", "illum", "sharpness", "Km",
                                       "Pr", "Pm", "Ps", "Pc", "Pcr",   "aniso",     "anisor"};

bool is_silent(std::string_view keyword) {
  return std::find(std::begin(silent), std::end(silent), keyword) != std::end(silent);
}

// Whether one of the words is a number on this side of a bound.
template <class Test>
bool any_number(ObjLexer& lexer, const Test& test) {
  for (std::string_view word : lexer.words()) {
    double value = 0;
    if (parse_number(word, value) == NumberForm::number && test(value)) return true;
  }
  return false;
}

bool is_texture(std::string_view keyword) {
  return keyword.substr(0, 4) == "map_" || keyword == "bump" || keyword == "disp" ||
         keyword == "decal" || keyword == "refl" || keyword == "norm";
}

}  // namespace

void read_mtl(const std::string& path, std::string_view text, MtlLibrary& library) {
  ObjLexer lexer(path, text);
  MtlMaterial ignored;  // takes what is said of a repeated name
  MtlMaterial* current = nullptr;
  bool transparent = false, specular = false;  // the current material is counted as such
  while (lexer.next()) {
    const std::string_view keyword = lexer.keyword();
    if (keyword == "newmtl") {
      if (lexer.rest().empty()) lexer.fail_here("newmtl without a name");
      const std::string name(lexer.rest());
      const int32_t number = static_cast<int32_t>(library.materials.size());
      transparent = specular = false;
      if (library.numbers.emplace(name, number).second) {
        library.materials.emplace_back();
        current = &library.materials.back();
        current->name = name;
      } else {
        note(library.repeated, library.first_repeated, lexer);
        current = &ignored;
      }
    } else if (keyword == own_mark) {
      if (!current) lexer.fail_here("a mark before the first newmtl");
      read_mark(*current, lexer);
    } else if (keyword == "Kd" || keyword == "Ke") {
      if (!current) lexer.fail_here(std::string(keyword) + " before the first newmtl");
      std::array<double, 3> values = color(lexer);
      if (keyword == "Ke") {
        for (double& value : values)
          if (value > 0 && value < smallest_emission) {
            value = 0;
            note(library.vanished, library.first_vanished, lexer);
          }
        current->emission = values;
        refuse_shining_blocker(*current, lexer);
        continue;
      }
      for (double& value : values)
        if (value >= 1) {
          value = largest_reflectance;
          if (current != &ignored) note(library.clamped, library.first_clamped, lexer);
        }
      current->reflectance = values;
      current->has_reflectance = true;
    } else if (is_texture(keyword)) {
      note(library.textures, library.first_texture, lexer);
    } else if (keyword == "d" || keyword == "Tr") {
      const bool opaque_is_one = keyword == "d";
      const auto transmits = [&](double v) { return opaque_is_one ? v < 1 : v > 0; };
      if (!transparent && any_number(lexer, transmits)) {
        note(library.transparent, library.first_transparent, lexer);
        transparent = true;
      }
    } else if (keyword == "Ks") {
      if (!specular && any_number(lexer, [](double v) { return v > 0; })) {
        note(library.specular, library.first_specular, lexer);
        specular = true;
      }
    } else if (!is_silent(keyword)) {
      note(library.unknown, library.first_unknown, lexer);
    }
  }
  if (lexer.vanished() > 0 && library.first_vanished.empty())
    library.first_vanished = lexer.first_vanished();
  library.vanished += lexer.vanished();
}

}  // namespace hrad
