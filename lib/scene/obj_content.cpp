// Parses OBJ text. Floor 3 (scene).
#include "scene/obj_content.h"

#include <algorithm>
#include <limits>

#include "scene/obj_lexer.h"

namespace hrad {

namespace {

// Statements without a meaning for light: names, groups, texture coordinates and normals (only
// their number counts), display attributes.
constexpr std::string_view silent[] = {"g",      "o",          "s",        "vp",       "lod",
                                       "mg",     "bevel",      "c_interp", "d_interp", "usemap",
                                       "maplib", "shadow_obj", "trace_obj"};
// Geometry that this reader does not take.
constexpr std::string_view unread[] = {
    "p",    "l",  "curv", "curv2", "surf",  "cstype", "deg", "bmat", "step", "parm", "trim", "hole",
    "scrv", "sp", "end",  "con",   "ctech", "stech",  "bsp", "bzp",  "cdc",  "cdp",  "res"};

template <size_t n>
bool contains(const std::string_view (&list)[n], std::string_view word) {
  return std::find(std::begin(list), std::end(list), word) != std::end(list);
}

// One of the three lists that a face refers to.
struct Reference {
  const char* name;
  int64_t count = 0;              // defined so far
  int64_t largest = 0, line = 0;  // the largest index used, and where

  // Index from 0 of a reference as written. A positive one may name what is defined further down;
  // check() is the judge of that.
  int64_t resolve(const ObjLexer& lexer, std::string_view word) {
    int64_t index;
    if (!parse_integer(word, index)) lexer.fail_here(quoted(word) + " is not a " + name + " index");
    if (index == 0)
      lexer.fail_here(std::string(name) + " index 0: indices begin with 1 (or -1, the last one)");
    if (index < -count)
      lexer.fail_here(std::string(name) + " index " + std::to_string(index) +
                      (count ? " is out of range -" + std::to_string(count) + " to -1"
                             : " refers to nothing: there is none before this line"));
    if (index < 0) return count + index;
    if (index > largest) {
      largest = index;
      line = lexer.line();
    }
    return index - 1;
  }

  void check(const ObjLexer& lexer) const {
    if (largest > count)
      lexer.fail_at(line, std::string(name) + " index " + std::to_string(largest) +
                              (count ? " is out of range 1 to " + std::to_string(count)
                                     : " refers to nothing: the file has none"));
  }
};

class Parser {
 public:
  Parser(const std::string& path, std::string_view text) : lexer_(path, text) {}

  ObjContent parse() {
    while (lexer_.next()) statement();
    content_.vanished = lexer_.vanished();
    content_.first_vanished = lexer_.first_vanished();
    for (const Reference* reference : {&vertex_, &texture_, &normal_}) reference->check(lexer_);
    return std::move(content_);
  }

 private:
  void statement() {
    const std::string_view keyword = lexer_.keyword();
    if (keyword == "v") {
      vertex();
    } else if (keyword == "f" || keyword == "fo") {
      face();
    } else if (keyword == "vt") {
      ++texture_.count;
    } else if (keyword == "vn") {
      ++normal_.count;
    } else if (keyword == "usemtl") {
      use_material();
    } else if (keyword == own_mark) {
      if (lexer_.rest() != "z-up")
        lexer_.fail_here("the mark " + quoted(lexer_.rest()) + " is unknown: here it can be z-up");
      content_.z_up = true;
    } else if (keyword == "mtllib") {
      if (lexer_.rest().empty()) lexer_.fail_here("mtllib without a name");
      content_.libraries.push_back({lexer_.line(), std::string(lexer_.rest())});
    } else if (keyword == "call" || keyword == "csh") {
      lexer_.fail_here(std::string(keyword) + " is refused: it would run other files or commands");
    } else if (contains(unread, keyword)) {
      count(content_.ignored[std::string(keyword)]);
    } else if (!contains(silent, keyword)) {
      if (count(content_.unknown)) content_.first_unknown = quoted(keyword);
    }
  }

  // True the first time.
  bool count(ObjContent::Count& c) {
    if (c.count == 0) c.first_line = lexer_.line();
    return c.count++ == 0;
  }

  // x y z, then nothing, a weight, or a colour.
  void vertex() {
    const size_t n = lexer_.words().size();
    if (n != 3 && n != 4 && n != 6)
      lexer_.fail_here("a vertex has 3, 4 or 6 numbers, not " + std::to_string(n));
    if (vertex_.count == std::numeric_limits<int32_t>::max())
      lexer_.fail_here("more than 2^31-1 vertices");
    for (size_t i = 3; i < n; ++i) lexer_.number(i);
    content_.vertices.push_back({lexer_.number(0), lexer_.number(1), lexer_.number(2)});
    ++vertex_.count;
  }

  // v, v/t, v//n or v/t/n. The vertex's index from 0.
  int32_t corner(std::string_view word) {
    const size_t first = word.find('/');
    if (first != std::string_view::npos) {
      const std::string_view after = word.substr(first + 1);
      const size_t second = after.find('/');
      const std::string_view texture = after.substr(0, second);
      if (second == std::string_view::npos) {
        texture_.resolve(lexer_, texture);
      } else {
        if (!texture.empty()) texture_.resolve(lexer_, texture);
        normal_.resolve(lexer_, after.substr(second + 1));
      }
    }
    const int64_t index = vertex_.resolve(lexer_, word.substr(0, first));
    // One that doesn't fit can't be in the file either, and check() says so.
    return static_cast<int32_t>(std::min(index, int64_t{std::numeric_limits<int32_t>::max()}));
  }

  void face() {
    const auto& words = lexer_.words();
    if (words.size() < 3)
      lexer_.fail_here("a face needs at least 3 corners, not " + std::to_string(words.size()));
    std::vector<int32_t>& corners = content_.corners;
    const size_t begin = corners.size();
    for (std::string_view word : words) corners.push_back(corner(word));
    remove_repetitions(begin);
    content_.first_corner.push_back(static_cast<int64_t>(corners.size()));
    content_.line.push_back(lexer_.line());
    content_.material.push_back(material_);
  }

  // A corner that is also the one before it adds nothing to a polygon. Three are left in any case:
  // a triangle without area keeps its number.
  void remove_repetitions(size_t begin) {
    std::vector<int32_t>& corners = content_.corners;
    size_t end = begin + 1, left = corners.size() - begin;
    const auto remove = [&] {
      if (content_.repeated_corners++ == 0) content_.first_repeated_corner = lexer_.line();
      --left;
    };
    for (size_t i = begin + 1; i < corners.size(); ++i) {
      if (corners[i] == corners[end - 1] && left > 3)
        remove();
      else
        corners[end++] = corners[i];
    }
    while (left > 3 && corners[end - 1] == corners[begin]) {
      remove();
      --end;
    }
    corners.resize(end);
  }

  void use_material() {
    const std::string name(lexer_.rest());
    const int32_t next = static_cast<int32_t>(content_.material_names.size());
    const auto [found, added] = materials_.emplace(name, next);
    if (added) {
      content_.material_names.push_back(name);
      content_.material_line.push_back(lexer_.line());
    }
    material_ = found->second;
  }

  ObjLexer lexer_;
  ObjContent content_;
  Reference vertex_{"vertex"}, texture_{"texture"}, normal_{"normal"};
  std::map<std::string, int32_t> materials_;
  int32_t material_ = -1;
};

}  // namespace

ObjContent parse_obj(const std::string& path, std::string_view text) {
  return Parser(path, text).parse();
}

}  // namespace hrad
