// Embree 3 or 4 behind the seam: the cross-check of the builtin engine and the measure of its
// speed. Its scenes are robust: without that, hits differ between instruction sets. Floor 4
// (visibility).
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#if HRAD_WITH_EMBREE >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "base/error.h"
#include "visibility/engines.h"
#include "visibility/exact_hit.h"

namespace hrad {

namespace {

class EmbreeEngine final : public VisibilityEngine {
 public:
  explicit EmbreeEngine(const Scene& scene);
  ~EmbreeEngine() override { release(); }
  EmbreeEngine(const EmbreeEngine&) = delete;
  EmbreeEngine& operator=(const EmbreeEngine&) = delete;

  uint32_t blocked(const SegmentPacket& packet) const override;
  Hit nearest(Vec3 origin, Vec3 direction, double t_min) const override;

  const char* name() const override { return "embree"; }
  std::string version() const override {
    const auto get = [&](RTCDeviceProperty property) {
      return static_cast<int>(rtcGetDeviceProperty(device_, property));
    };
    return format("%d.%d.%d", get(RTC_DEVICE_PROPERTY_VERSION_MAJOR),
                  get(RTC_DEVICE_PROPERTY_VERSION_MINOR), get(RTC_DEVICE_PROPERTY_VERSION_PATCH));
  }
  int64_t bytes() const override { return bytes_; }

 private:
  static bool count_memory(void* engine, ssize_t bytes, bool) {
    static_cast<EmbreeEngine*>(engine)->bytes_ += bytes;
    return true;
  }
  void build();
  void find_sheets();
  void check(const char* step) const {
    const RTCError error = rtcGetDeviceError(device_);
    if (error == RTC_ERROR_NONE) return;
    fail(error == RTC_ERROR_OUT_OF_MEMORY ? Status::memory : Status::internal,
         "Embree failed to %s (error %d)", step, static_cast<int>(error));
  }
  void release() {
    if (geometry_scene_) rtcReleaseScene(geometry_scene_);
    if (device_) rtcReleaseDevice(device_);
  }

  const Scene& scene_;
  RTCDevice device_ = nullptr;
  RTCScene geometry_scene_ = nullptr;
  std::vector<int32_t> patches_;  // of each of Embree's primitives
  // Per patch the one with the same corners that faces the other way, -1: none. Embree may report
  // either side of such a sheet.
  std::vector<int32_t> other_side_;
  int64_t bytes_ = 0;  // changed while building alone, by one thread
};

EmbreeEngine::EmbreeEngine(const Scene& scene) : scene_(scene) {
  measure_scene(scene, center_, radius_);
  try {
    build();
  } catch (...) {
    release();
    throw;
  }
}

void EmbreeEngine::find_sheets() {
  using Place = std::array<double, 9>;
  std::vector<std::pair<Place, int32_t>> places;
  for (int32_t patch : patches_) {
    std::array<std::array<double, 3>, 3> corners;
    for (int c = 0; c < 3; ++c) {
      const Vec3& v = scene_.vertices[scene_.corners[patch][c]];
      corners[c] = {v.x, v.y, v.z};
    }
    std::sort(corners.begin(), corners.end());
    Place place;
    for (int k = 0; k < 9; ++k) place[k] = corners[k / 3][k % 3];
    places.emplace_back(place, patch);
  }
  std::sort(places.begin(), places.end());
  other_side_.assign(static_cast<size_t>(scene_.patch_count()), -1);
  for (size_t k = 1; k < places.size(); ++k) {
    if (places[k].first != places[k - 1].first) continue;
    other_side_[places[k].second] = places[k - 1].second;
    other_side_[places[k - 1].second] = places[k].second;
  }
}

void EmbreeEngine::build() {
  device_ = rtcNewDevice("threads=1,user_threads=1");
  if (!device_) fail(Status::internal, "Embree can't open a device");
  rtcSetDeviceMemoryMonitorFunction(device_, count_memory, this);
  geometry_scene_ = rtcNewScene(device_);
  rtcSetSceneFlags(geometry_scene_, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(geometry_scene_, RTC_BUILD_QUALITY_MEDIUM);
  for (int64_t patch = 0; patch < scene_.patch_count(); ++patch)
    if (!scene_.has(patch, patch_dropped)) patches_.push_back(static_cast<int32_t>(patch));
  find_sheets();
  if (!patches_.empty()) {
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertices = static_cast<float*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                3 * sizeof(float), scene_.vertices.size()));
    auto* corners = static_cast<uint32_t*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(uint32_t), patches_.size()));
    if (vertices && corners) {
      for (const Vec3& v : scene_.vertices)
        for (int axis = 0; axis < 3; ++axis)
          *vertices++ = static_cast<float>(v[axis] - center_[axis]);
      for (int32_t patch : patches_)
        for (int32_t corner : scene_.corners[patch]) *corners++ = static_cast<uint32_t>(corner);
      rtcCommitGeometry(geometry);
      rtcAttachGeometry(geometry_scene_, geometry);
    }
    rtcReleaseGeometry(geometry);
  }
  check("take the scene");
  rtcCommitScene(geometry_scene_);
  check("build its tree");
}

uint32_t EmbreeEngine::blocked(const SegmentPacket& packet) const {
  alignas(64) int valid[16];
  RTCRay16 rays;
  for (int i = 0; i < 16; ++i) {
    valid[i] = packet.active >> i & 1 ? -1 : 0;
    rays.org_x[i] = packet.ox[i];
    rays.org_y[i] = packet.oy[i];
    rays.org_z[i] = packet.oz[i];
    rays.dir_x[i] = packet.dx[i];
    rays.dir_y[i] = packet.dy[i];
    rays.dir_z[i] = packet.dz[i];
    rays.tnear[i] = 0;
    rays.tfar[i] = 1;
    rays.time[i] = 0;
    rays.mask[i] = ~0u;
    rays.id[i] = 0;
    rays.flags[i] = 0;
  }
#if HRAD_WITH_EMBREE >= 4
  RTCOccludedArguments arguments;
  rtcInitOccludedArguments(&arguments);
  arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcOccluded16(valid, geometry_scene_, &rays, &arguments);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded16(valid, geometry_scene_, &context, &rays);
#endif
  uint32_t result = 0;
  for (int i = 0; i < 16; ++i) result |= static_cast<uint32_t>(rays.tfar[i] < 0) << i;
  return result & packet.active;
}

Hit EmbreeEngine::nearest(Vec3 origin, Vec3 direction, double t_min) const {
  const double size = length(direction);
  if (!(size > 0) || !std::isfinite(size)) return {};
  const Vec3 unit = direction * (1 / size);
  const Vec3 from_center = origin - center_;
  // Single precision starts close to the scene, however far away the ray does.
  const double ahead = std::max(0.0, -dot(from_center, unit) - 1.5 * radius_);
  const Vec3 start = from_center + unit * ahead;
  RTCRayHit query;
  query.ray.org_x = static_cast<float>(start.x);
  query.ray.org_y = static_cast<float>(start.y);
  query.ray.org_z = static_cast<float>(start.z);
  query.ray.dir_x = static_cast<float>(unit.x);
  query.ray.dir_y = static_cast<float>(unit.y);
  query.ray.dir_z = static_cast<float>(unit.z);
  query.ray.tnear = static_cast<float>(std::max(t_min * size - ahead, 0.0));
  query.ray.tfar = INFINITY;
  query.ray.time = 0;
  query.ray.mask = ~0u;
  query.ray.id = 0;
  query.ray.flags = 0;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if HRAD_WITH_EMBREE >= 4
  rtcIntersect1(geometry_scene_, &query);
#else
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(geometry_scene_, &context, &query);
#endif
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  const double t = (static_cast<double>(query.ray.tfar) + ahead) / size;
  const Hit hit = exact_hit(scene_, patches_[query.hit.primID], origin, direction, t);
  const int32_t other = hit.back ? other_side_[hit.patch] : -1;
  return other < 0 ? hit : exact_hit(scene_, other, origin, direction, t);
}

}  // namespace

std::unique_ptr<VisibilityEngine> make_embree_engine(const Scene& scene,
                                                     const std::string& instruction_set,
                                                     ThreadTeam&) {
  // Embree chooses its own.
  if (instruction_set != "auto")
    fail(Status::argument, "the instruction set of Embree can't be chosen ('%s')",
         instruction_set.c_str());
  return std::make_unique<EmbreeEngine>(scene);
}

}  // namespace hrad
