#include "apps/foreign/mesh/lights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "apps/edge/line/number_text.h"
#include "apps/foreign/mesh/count_note.h"
#include "apps/foreign/mesh/placement.h"
#include "apps/formats/view_faults.h"
#include "core/base/elementary.h"

namespace dmpc::apps {
namespace {

using core::PointLight;
using core::Vec3d;

constexpr double far_radii = 1000;
constexpr int shorter_side = 512;
constexpr double aspect_max = 16;

double brightest(const Vec3d& color) { return std::max({color.x, color.y, color.z}); }

Vec3d color_of(const aiLight& light) {
  const auto clean = [](ai_real channel) { return std::isfinite(channel) ? std::max(double{channel}, 0.0) : 0.0; };
  return {clean(light.mColorDiffuse.r), clean(light.mColorDiffuse.g), clean(light.mColorDiffuse.b)};
}

Vec3d position_of(const aiLight& light, const Transform& world, const BoundingSphere& bounds) {
  if (light.mType != aiLightSource_DIRECTIONAL) {
    return world.point(to_vec(light.mPosition));
  }
  const Vec3d direction = world.direction(to_vec(light.mDirection));
  return bounds.center - direction * (far_radii * bounds.radius / length(direction));
}

bool is_shown(const aiLight& light) {
  return light.mType == aiLightSource_POINT || light.mType == aiLightSource_SPOT || light.mType == aiLightSource_DIRECTIONAL;
}

void note_lights(std::map<aiLightSourceType, std::uint64_t>& counts, std::vector<std::string>& notes) {
  const auto note = [&](aiLightSourceType type, const std::string& what) { note_count(notes, what, counts[type]); };
  note(aiLightSource_POINT, "point lights whose fall-off with distance is ignored");
  note(aiLightSource_SPOT, "spot lights taken for point lights without fall-off");
  note(aiLightSource_DIRECTIONAL, "directional lights taken for point lights far away");
  note(aiLightSource_AREA, "area lights left out");
  note(aiLightSource_AMBIENT, "ambient lights left out");
  note(aiLightSource_UNDEFINED, "lights of an unknown kind left out");
}

/// The angle whose tangent is that of `angle` (radians) times `share`: Newton's method from the right, where the tangent is
/// convex. A right angle and more stays what it is, to be refused.
double with_tangent_times(double angle, double share) {
  constexpr double nearly_right = 1.5707963;
  if (!(angle < nearly_right)) {
    return angle;
  }
  const double tangent = core::tan_radians(angle) * share;
  double result = share <= 1 ? angle : nearly_right;
  for (int i = 0; i < 200; ++i) {
    const double here = core::tan_radians(result);
    result -= (here - tangent) / (1 + here * here);
  }
  return result;
}

bool has_aspect(const aiCamera& camera) { return std::isfinite(camera.mAspect) && camera.mAspect > 0; }

/// Half of what core::View calls the angle, in degrees, if the camera's spans the pixels of `size` from edge to edge.
double half_degrees(const aiCamera& camera, const Resolution& size) {
  constexpr double degrees_of_radian = 57.295779513082320877;
  const double half = 0.5 * double{camera.mHorizontalFOV}, aspect = has_aspect(camera) ? double{camera.mAspect} : 0;
  const int steps = std::max(1, std::min(size.width, size.height) - 1);
  return degrees_of_radian * with_tangent_times(aspect > 0 ? half / aspect : half, double(steps) / size.height);
}

core::View view_of(const aiCamera& camera, const std::optional<Resolution>& size, const Transform& world) {
  const double aspect = has_aspect(camera) ? std::clamp(double{camera.mAspect}, 1 / aspect_max, aspect_max) : 1;
  core::View view;
  view.from = world.point({});
  view.at = view.from + world.direction(to_vec(camera.mLookAt));
  view.up = world.direction(to_vec(camera.mUp));
  view.width = static_cast<int>(std::lround(shorter_side * std::max(aspect, 1.0)));
  view.height = static_cast<int>(std::lround(shorter_side * std::max(1 / aspect, 1.0)));
  view.angle_degrees = 2 * half_degrees(camera, size.value_or(Resolution{view.width, view.height}));
  return view;
}

bool is_perspective(const aiCamera& camera) { return camera.mHorizontalFOV > 0 && std::isfinite(camera.mHorizontalFOV); }

}  // namespace

void scale_down(std::vector<PointLight>& lights) {
  double sum = 0;
  for (const PointLight& light : lights) {
    sum += brightest(light.color) * brightest(light.color);
  }
  for (PointLight& light : lights) {
    light.color = light.color * (1 / std::sqrt(std::max(sum, 1.0)));
  }
}

std::vector<PointLight> lights_of(const aiScene& scene, const BoundingSphere& bounds, double scale, bool is_lit_else,
                                  std::vector<std::string>& notes) {
  std::vector<PointLight> lights;
  std::map<aiLightSourceType, std::uint64_t> counts;
  std::uint64_t dark = 0, nowhere = 0;
  for (std::size_t i = 0; i < scene.mNumLights; ++i) {
    const aiLight& light = *scene.mLights[i];
    const PointLight ours{position_of(light, world_of(scene, light.mName, scale), bounds), color_of(light), true};
    if (is_shown(light) && !(brightest(ours.color) > 0)) {
      ++dark;
    } else if (is_shown(light) && !is_in_reach(ours.position)) {
      ++nowhere;
    } else {
      ++counts[light.mType];
      if (is_shown(light)) {
        lights.push_back(ours);
      }
    }
  }
  scale_down(lights);
  note_lights(counts, notes);
  const std::string instead = lights.empty() && !is_lit_else ? ", so that plain ones take their place" : "";
  note_count(notes, "lights without any brightness left out" + instead, dark);
  note_count(notes, "lights without a place or direction left out" + instead, nowhere);
  return lights;
}

std::optional<core::View> camera_of(const aiScene& scene, const std::optional<Resolution>& size, double scale,
                                    std::vector<std::string>& notes) {
  const std::string count = std::to_string(scene.mNumCameras);
  for (unsigned i = 0; i < scene.mNumCameras; ++i) {
    const aiCamera& camera = *scene.mCameras[i];
    const core::View view = view_of(camera, size, world_of(scene, camera.mName, scale));
    if (!is_perspective(camera) || fault_of(view)) {
      continue;
    }
    if (scene.mNumCameras > 1) {
      notes.push_back((i == 0 ? "the first of " + count + " cameras is taken, '"
                              : "camera " + std::to_string(i + 1) + " of " + count +
                                    " is taken, the first that has a perspective and a direction, '") +
                      camera.mName.C_Str() + "'");
    }
    return view;
  }
  if (scene.mNumCameras > 0) {
    notes.push_back(scene.mNumCameras == 1
                        ? "the file's camera is not taken, since it has no perspective or no direction"
                        : "none of the file's " + count + " cameras is taken, since none has a perspective and a direction");
  }
  return std::nullopt;
}

}  // namespace dmpc::apps
