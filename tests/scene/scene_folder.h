// A folder for the files of one test, gone at its end.
#pragma once

#include <stdlib.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.h"
#include "scene/load.h"
#include "support/check.h"

namespace hrad_test {

struct SceneFolder {
  std::string path;

  SceneFolder() {
    char name[] = "/tmp/hrad_test_scene_XXXXXX";
    CHECK(mkdtemp(name) != nullptr);
    path = name;
  }
  ~SceneFolder() {
    if (std::system(("rm -rf '" + path + "'").c_str()) != 0) std::perror("rm");
  }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  std::string file(const std::string& name) const { return path + "/" + name; }

  std::string put(const std::string& name, const std::string& text) const {
    std::ofstream out(file(name), std::ios::binary);
    out << text;
    out.close();
    CHECK(out.good());
    return file(name);
  }

  std::string content(const std::string& name) const {
    std::ifstream in(file(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  // Loads `text` as scene.obj.
  hrad::Scene load(const std::string& text, hrad::Sides sides = hrad::Sides::front,
                   int bands = 3) const {
    hrad::Scene scene;
    scene.bands = bands;
    hrad::load_obj(scene, put("scene.obj", text), sides);
    return scene;
  }
};

// How many diagnostics contain the text.
inline int count_diagnostics(const hrad::Scene& scene, const std::string& text) {
  int count = 0;
  for (const std::string& d : scene.diagnostics) count += d.find(text) != std::string::npos;
  return count;
}

}  // namespace hrad_test
