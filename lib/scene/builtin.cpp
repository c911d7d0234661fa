// The table of built-in scenes. Floor 3 (scene).
#include <cstdint>
#include <string>

#include "base/error.h"
#include "scene/generate.h"
#include "scene/load.h"

namespace hrad {
namespace {

struct BuiltinScene {
  const char* name;
  void (*generate)(Scene& scene, int size);
  int size;
};

constexpr BuiltinScene builtin_scenes[] = {
    {"building", generate_building, 1},
    {"building-x10", generate_building, 10},
    {"building-x100", generate_building, 100},
    {"classroom", generate_classroom, 1},
    {"classroom-x10", generate_classroom, 10},
    {"classroom-x100", generate_classroom, 100},
    {"cornell", generate_cornell, 1},
    {"furnace", generate_furnace, 1},
    {"furnace-sphere", generate_furnace_sphere, 1},
    {"furnace-boxes", generate_furnace_boxes, 1},
    {"furnished-room", generate_furnished_room, 1},
    {"box-in-box", generate_box_in_box, 1},
    {"parallel-plates", generate_parallel_plates, 1},
};

}  // namespace

void make_builtin_scene(Scene& scene, const std::string& name) {
  std::string names;
  for (const BuiltinScene& builtin : builtin_scenes) {
    if (name == builtin.name) {
      builtin.generate(scene, builtin.size);
      scene.z_up = true;
      return;
    }
    names += names.empty() ? "" : ", ";
    names += builtin.name;
  }
  fail(Status::argument, "there is no built-in scene '%s'; choose one of: %s", name.c_str(),
       names.c_str());
}

const char* builtin_scene_name(int64_t index) {
  constexpr int64_t count = sizeof builtin_scenes / sizeof builtin_scenes[0];
  return index >= 0 && index < count ? builtin_scenes[index].name : nullptr;
}

}  // namespace hrad
