// The solution as binary glTF 2.0 (Khronos, ISO/IEC 12113): one mesh whose vertices lie interleaved
// in one buffer view, its indices in another; a node turns the scene upright, brings it to metres
// and takes it to its place. Floor 8 (solver).
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/little_endian.h"
#include "base/number_text.h"
#include "base/version.h"
#include "machine/file_self.h"
#include "solver/display_color.h"
#include "solver/export.h"
#include "solver/leaf_mesh.h"
#include "solver/solver.h"

namespace hrad {
namespace {

constexpr uint32_t magic = 0x46546c67, json_chunk = 0x4e4f534a, binary_chunk = 0x004e4942;
constexpr int float_type = 5126, uint32_type = 5125;
constexpr int vertex_target = 34962, index_target = 34963;
constexpr uint64_t header_bytes = 12, chunk_head_bytes = 8;

// A scene that lies more than this many of its sizes from the origin is moved there, and moved back
// by its node: single precision would tear it.
constexpr double farthest = 64;

// ---- where the mesh stands

struct Placement {
  Vec3 origin;        // of the mesh's own coordinates, in the scene's
  double metres = 1;  // in the scene's unit of length
  bool z_up = false;  // glTF has y up

  std::array<float, 3> local(Vec3 p) const {
    const Vec3 q = p - origin;
    return {finite_float(q.x), finite_float(q.y), finite_float(q.z)};
  }
};

// The length of a unit that goes by one of its usual names; 1 for any other name.
double metres_of(const std::string& unit) {
  constexpr struct {
    double metres;
    const char* names[3];
  } units[] = {
      {0.001, {"mm", "millimetre", "millimeter"}}, {0.01, {"cm", "centimetre", "centimeter"}},
      {0.1, {"dm", "decimetre", "decimeter"}},     {1000, {"km", "kilometre", "kilometer"}},
      {0.0254, {"in", "inch", "inche"}},           {0.3048, {"ft", "foot", "feet"}}};
  const bool plural = unit.size() > 4 && unit.back() == 's';
  const std::string singular = unit.substr(0, unit.size() - (plural ? 1 : 0));
  for (const auto& u : units)
    for (const char* name : u.names)
      if (singular == name) return u.metres;
  return 1;
}

Placement placement_of(const Solver& solver) {
  Placement placement;
  placement.metres = metres_of(solver.params().unit);
  placement.z_up = solver.scene().z_up;
  Box box;
  for (int64_t i = 0; i < solver.leaf_count(); ++i) {
    const Triangle corners = solver.leaf(i).corners;
    for (const Vec3& corner : {corners.a, corners.b, corners.c}) box.grow(corner);
  }
  if (!box.empty() && length(box.center()) > farthest * length(box.extent()))
    placement.origin = box.center();
  return placement;
}

// ---- attributes

struct Attribute {
  std::string name;
  int components;
};

// In the order in which a vertex holds them: radiosity in groups of up to four bands.
std::vector<Attribute> attributes_of(int bands) {
  std::vector<Attribute> attributes = {{"POSITION", 3}, {"NORMAL", 3}, {"COLOR_0", 3}};
  if (bands <= 4) {
    attributes.push_back({"_RADIOSITY", bands});
    return attributes;
  }
  for (int group = 0; 4 * group < bands; ++group)
    attributes.push_back({"_RADIOSITY_" + std::to_string(group), std::min(4, bands - 4 * group)});
  return attributes;
}

void put_vertex(const MeshVertex& vertex, int bands, const Placement& placement,
                const DisplayColors& colors, std::string& bytes) {
  for (const float coordinate : placement.local(vertex.position))
    put_little_endian(bytes, coordinate);
  for (int axis = 0; axis < 3; ++axis) put_little_endian(bytes, finite_float(vertex.normal[axis]));
  for (const double value : colors.linear(vertex.radiosity.data()))
    put_little_endian(bytes, finite_float(value));
  for (int band = 0; band < bands; ++band)
    put_little_endian(bytes, finite_float(vertex.radiosity[band]));
}

struct Bounds {
  std::array<float, 3> low, high;
};

// Of the coordinates as the file holds them.
Bounds bounds_of(const LeafMesh& mesh, const Placement& placement) {
  constexpr float infinity = std::numeric_limits<float>::infinity();
  Bounds bounds{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (int64_t i = 0; i < mesh.vertex_count(); ++i) {
    const std::array<float, 3> p = placement.local(mesh.vertex(i).position);
    for (int axis = 0; axis < 3; ++axis) {
      bounds.low[axis] = std::min(bounds.low[axis], p[axis]);
      bounds.high[axis] = std::max(bounds.high[axis], p[axis]);
    }
  }
  return bounds;
}

// ---- the JSON part

template <class Values>
std::string array_text(const Values& values) {
  std::string text;
  for (const double value : values) {
    text += text.empty() ? '[' : ',';
    append_number(text, value);
  }
  return text + ']';
}

std::string node_text(const Placement& placement) {
  std::string text = "{\"name\":\"solution\",\"mesh\":0";
  const Vec3 o = placement.origin * placement.metres;
  if (o.x != 0 || o.y != 0 || o.z != 0) {
    const Vec3 t = placement.z_up ? Vec3{o.x, o.z, -o.y} : o;
    text += ",\"translation\":" + array_text(std::array<double, 3>{t.x, t.y, t.z});
  }
  if (placement.z_up) {
    // A quarter turn about x, as a quaternion: z becomes y.
    const double half = std::sqrt(0.5);
    text += ",\"rotation\":" + array_text(std::array<double, 4>{-half, 0, 0, half});
  }
  if (placement.metres != 1) {
    const double s = placement.metres;
    text += ",\"scale\":" + array_text(std::array<double, 3>{s, s, s});
  }
  return text + "}";
}

std::string accessor_text(int view, uint64_t offset, int type, uint64_t count, int components) {
  constexpr const char* types[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  return "{\"bufferView\":" + std::to_string(view) + ",\"byteOffset\":" + std::to_string(offset) +
         ",\"componentType\":" + std::to_string(type) + ",\"count\":" + std::to_string(count) +
         ",\"type\":\"" + types[components - 1] + '"';
}

struct Sizes {
  uint64_t vertices, triangles, stride;
  uint64_t vertex_bytes() const { return vertices * stride; }
  uint64_t index_bytes() const { return triangles * 3 * sizeof(uint32_t); }
};

std::string mesh_text(const std::vector<Attribute>& attributes, const Sizes& sizes,
                      const Bounds& bounds, double exposure) {
  std::string list, accessors;
  uint64_t offset = 0;
  for (size_t k = 0; k < attributes.size(); ++k) {
    const Attribute& a = attributes[k];
    list += (k ? ",\"" : "\"") + a.name + "\":" + std::to_string(k);
    accessors += accessor_text(0, offset, float_type, sizes.vertices, a.components);
    if (k == 0)
      accessors += ",\"min\":" + array_text(bounds.low) + ",\"max\":" + array_text(bounds.high);
    accessors += "},\n";
    offset += sizeof(float) * static_cast<uint64_t>(a.components);
  }
  accessors += accessor_text(1, 0, uint32_type, 3 * sizes.triangles, 1) + "}";

  const std::string bytes = std::to_string(sizes.vertex_bytes());
  return ",\n\"meshes\":[{\"name\":\"solution\",\"primitives\":[{\"attributes\":{" + list +
         "},\"indices\":" + std::to_string(attributes.size()) +
         ",\"material\":0,\"mode\":4}],\"extras\":{\"exposure\":" + number_text(exposure) +
         "}}],\n\"materials\":[{\"name\":\"radiosity\",\"pbrMetallicRoughness\":"
         "{\"baseColorFactor\":[1,1,1,1],\"metallicFactor\":0,\"roughnessFactor\":1},"
         "\"doubleSided\":false,\"extensions\":{\"KHR_materials_unlit\":{}}}],\n\"accessors\":[" +
         accessors + "],\n\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":" + bytes +
         ",\"byteStride\":" + std::to_string(sizes.stride) +
         ",\"target\":" + std::to_string(vertex_target) +
         "},\n{\"buffer\":0,\"byteOffset\":" + bytes +
         ",\"byteLength\":" + std::to_string(sizes.index_bytes()) +
         ",\"target\":" + std::to_string(index_target) + "}],\n\"buffers\":[{\"byteLength\":" +
         std::to_string(sizes.vertex_bytes() + sizes.index_bytes()) + "}]";
}

// Padded with blanks to whole words.
std::string json_text(const std::string& node, const std::string& mesh) {
  std::string json = "{\"asset\":{\"version\":\"2.0\",\"generator\":\"hrad ";
  json += version_text();
  json += "\"}";
  if (!mesh.empty()) json += ",\n\"extensionsUsed\":[\"KHR_materials_unlit\"]";
  json += ",\n\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\n\"nodes\":[" + node + "]" + mesh + "}\n";
  json.resize((json.size() + 3) / 4 * 4, ' ');
  return json;
}

void write_words(WholeFile& file, std::initializer_list<uint32_t> words) {
  std::string bytes;
  for (const uint32_t word : words) put_little_endian(bytes, word);
  file.text(bytes);
}

}  // namespace

uint32_t glb_length(const std::string& path, uint64_t json_bytes, uint64_t binary_bytes) {
  uint64_t length = header_bytes + chunk_head_bytes + json_bytes;
  if (binary_bytes) length += chunk_head_bytes + binary_bytes;
  if (length > std::numeric_limits<uint32_t>::max())
    fail(
        Status::unsupported,
        "%s: the solution takes %llu bytes and a .glb file holds less than 4 GiB: use .ply or .vtu",
        path.c_str(), static_cast<unsigned long long>(length));
  return static_cast<uint32_t>(length);
}

void export_glb(const Solver& solver, const std::string& path) {
  const LeafMesh mesh(solver, path);
  const DisplayColors colors(solver);
  const int bands = solver.scene().bands;
  const Placement placement = placement_of(solver);
  const std::vector<Attribute> attributes = attributes_of(bands);
  Sizes sizes{static_cast<uint64_t>(mesh.vertex_count()),
              static_cast<uint64_t>(mesh.triangle_count()), 0};
  for (const Attribute& a : attributes)
    sizes.stride += sizeof(float) * static_cast<uint64_t>(a.components);

  // A scene in which nothing exchanges light has no mesh: glTF knows no empty ones.
  const bool empty = sizes.triangles == 0;
  const std::string json =
      empty
          ? json_text("{\"name\":\"solution\"}", "")
          : json_text(node_text(placement),
                      mesh_text(attributes, sizes, bounds_of(mesh, placement), colors.exposure()));
  const uint64_t binary = sizes.vertex_bytes() + sizes.index_bytes();
  const uint32_t length = glb_length(path, json.size(), binary);

  WholeFile file(path);
  write_words(file, {magic, 2, length, static_cast<uint32_t>(json.size()), json_chunk});
  file.text(json);
  if (!empty) write_words(file, {static_cast<uint32_t>(binary), binary_chunk});
  std::string bytes;
  for (int64_t i = 0; i < mesh.vertex_count(); ++i) {
    bytes.clear();
    put_vertex(mesh.vertex(i), bands, placement, colors, bytes);
    file.text(bytes);
  }
  for (int64_t i = 0; i < mesh.triangle_count(); ++i)
    write_words(file, {mesh.triangle(i)[0], mesh.triangle(i)[1], mesh.triangle(i)[2]});
  file.commit();
}

}  // namespace hrad
