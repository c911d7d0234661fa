// Writes a scene as OBJ and MTL, so that reading it gives the same triangles, windings,
// reflectance, emission and sides to the last bit; what the formats have no statement for stands in
// comments that the reader knows. Floor 3 (scene).
#include <algorithm>
#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/number_text.h"
#include "machine/file_self.h"
#include "scene/load.h"
#include "scene/obj_lexer.h"

namespace hrad {

namespace {

void append_numbers(std::string& line, std::initializer_list<double> values) {
  for (const double value : values) {
    line += ' ';
    append_number(line, value);
  }
}

std::string mark(const char* meaning) { return std::string(own_mark) + " " + meaning + "\n"; }

// A word for newmtl and usemtl: no blanks, nothing that begins a comment or joins lines.
std::string as_word(const std::string& name) {
  std::string word;
  for (char c : name) {
    const unsigned char byte = static_cast<unsigned char>(c);
    word += byte <= 0x20 || byte == 0x7f || c == '#' || c == '\\' ? '_' : c;
  }
  return word.empty() ? "material" : word;
}

// The materials of the file: those of the scene, and one for each pair of reflectance and emission
// that was set apart on a patch.
class MaterialTable {
 public:
  explicit MaterialTable(const Scene& scene) : scene_(scene) {
    for (const Material& m : scene.materials) add(m, m.name, m.reflectance, m.emission);
  }

  // The number of a patch's material in the file.
  size_t number_of(int64_t patch) {
    const int32_t number = scene_.material[patch];
    const Material& m = scene_.materials[number];
    const size_t bands = static_cast<size_t>(scene_.bands);
    const double* reflectance = &scene_.reflectance[patch * bands];
    const double* emission = &scene_.emission[patch * bands];
    if (std::equal(m.reflectance.begin(), m.reflectance.end(), reflectance) &&
        std::equal(m.emission.begin(), m.emission.end(), emission))
      return static_cast<size_t>(number);
    std::vector<double> values(reflectance, reflectance + bands);
    values.insert(values.end(), emission, emission + bands);
    const auto [found, added] = apart_.emplace(std::make_pair(number, std::move(values)), 0);
    if (added) {
      found->second = names_.size();
      add(m, m.name + "-apart", {reflectance, reflectance + bands}, {emission, emission + bands});
    }
    return found->second;
  }

  const std::string& name(size_t number) const { return names_[number]; }
  const std::string& mtl() const { return mtl_; }

 private:
  // like: whose sides it has.
  void add(const Material& like, const std::string& wanted, const std::vector<double>& reflectance,
           const std::vector<double>& emission) {
    const std::string word = as_word(wanted);
    std::string name = word;
    // Counted on per word, so that many of one name stay linear.
    while (!taken_.insert(name).second) name = word + "-" + std::to_string(++repeated_[word] + 1);
    names_.push_back(name);
    mtl_ += "\nnewmtl " + name + "\nKd";
    append_channels(reflectance);
    mtl_ += "\nKe";
    append_channels(emission);
    mtl_ += '\n';
    if (like.two_sided) mtl_ += mark("two-sided");
    if (like.blocker) mtl_ += mark("blocker");
  }

  // One band stands for red, green and blue.
  void append_channels(const std::vector<double>& values) {
    append_numbers(
        mtl_, {values[0], values[scene_.bands == 3 ? 1 : 0], values[scene_.bands == 3 ? 2 : 0]});
  }

  const Scene& scene_;
  std::map<std::pair<int32_t, std::vector<double>>, size_t> apart_;
  std::vector<std::string> names_;
  std::set<std::string> taken_;
  std::map<std::string, int64_t> repeated_;
  std::string mtl_;
};

// NAME.mtl for NAME.obj, beside it.
std::string mtl_path_of(const std::string& path) {
  const size_t slash = path.rfind('/');
  const size_t begin = slash == std::string::npos ? 0 : slash + 1;
  const size_t dot = path.rfind('.');
  const bool has_ending = dot != std::string::npos && dot > begin;
  std::string mtl_path = path.substr(0, has_ending ? dot : path.size()) + ".mtl";
  if (mtl_path == path)
    fail(Status::argument, "%s: the materials would take this name", path.c_str());
  return mtl_path;
}

// The name for the mtllib statement, which ends at a line's end or a comment.
std::string library_name(const std::string& mtl_path) {
  std::string name = mtl_path.substr(mtl_path.rfind('/') + 1);
  const bool readable = name.find_first_of("\n\r\t\v\f") == std::string::npos && name[0] != ' ' &&
                        name[0] != '#' && name.find(" #") == std::string::npos;
  if (!readable)
    fail(Status::file, "%s: an OBJ file can't refer to a file of this name", mtl_path.c_str());
  return name;
}

}  // namespace

void write_obj(const Scene& scene, const std::string& path) {
  if (scene.bands != 1 && scene.bands != 3)
    fail(Status::argument, "%s: an OBJ file takes 1 or 3 bands, not %d", path.c_str(), scene.bands);
  const std::string mtl_path = mtl_path_of(path);
  const std::string library = library_name(mtl_path);
  WholeFile obj(path), mtl(mtl_path);

  if (scene.z_up) obj.text(mark("z-up"));
  obj.text("mtllib " + library + "\n");
  std::string line;
  for (const Vec3& v : scene.vertices) {
    line = "v";
    append_numbers(line, {v.x, v.y, v.z});
    obj.text(line + "\n");
  }
  MaterialTable materials(scene);
  size_t current = 0;
  for (int64_t i = 0; i < scene.patch_count(); ++i) {
    const size_t number = materials.number_of(i);
    if (i == 0 || number != current) obj.text("usemtl " + materials.name(number) + "\n");
    current = number;
    line = "f";
    for (int32_t corner : scene.corners[i]) line += " " + std::to_string(int64_t{corner} + 1);
    obj.text(line + "\n");
  }

  mtl.text("# Kd: reflectance; Ke: radiant exitance, W/m2\n");
  mtl.text(materials.mtl());
  mtl.finish();
  obj.finish();
  // The materials first: what refers to them appears when they are there.
  mtl.commit();
  obj.commit();
}

}  // namespace hrad
