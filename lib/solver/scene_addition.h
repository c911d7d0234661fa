// What growing a scene needs, whichever way it grows. Floor 8 (solver).
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "base/memory_budget.h"
#include "scene/scene.h"

namespace hrad {

// Adds the time from its making to its end to a counter.
class Stopwatch {
 public:
  explicit Stopwatch(double* seconds) : seconds_(seconds) {}
  ~Stopwatch() {
    *seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double* seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Takes back what was added to a scene since it was made, unless it is told to keep it.
class SceneAddition {
 public:
  explicit SceneAddition(Scene& scene)
      : scene_(scene),
        vertices_(scene.vertices.size()),
        materials_(scene.materials.size()),
        patches_(scene.corners.size()),
        z_up_(scene.z_up),
        diagnostics_(scene.diagnostics) {}
  ~SceneAddition() {
    if (kept_) return;
    scene_.vertices.resize(vertices_);
    scene_.materials.resize(materials_);
    scene_.corners.resize(patches_);
    scene_.material.resize(patches_);
    scene_.face.resize(patches_);
    scene_.flags.resize(patches_);
    scene_.emission.resize(patches_ * static_cast<size_t>(scene_.bands));
    scene_.reflectance.resize(patches_ * static_cast<size_t>(scene_.bands));
    scene_.z_up = z_up_;
    scene_.diagnostics.swap(diagnostics_);
  }
  SceneAddition(const SceneAddition&) = delete;
  SceneAddition& operator=(const SceneAddition&) = delete;

  int64_t first_patch() const { return static_cast<int64_t>(patches_); }
  void keep() { kept_ = true; }

 private:
  Scene& scene_;
  const size_t vertices_, materials_, patches_;
  const bool z_up_;
  std::vector<std::string> diagnostics_;
  bool kept_ = false;
};

// MEMORY when a scene alone is over the limit.
inline void check_memory(const Scene& scene, int64_t limit) {
  MemoryBudget budget;
  budget.set_limit(limit);
  budget.take(scene.bytes(), "the patches of the scene");
}

}  // namespace hrad
