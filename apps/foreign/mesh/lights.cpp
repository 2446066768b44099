#include "apps/foreign/mesh/lights.h"

#include <assimp/commonMetaData.h>
#include <assimp/version.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>

#include "apps/edge/line/number_text.h"
#include "apps/foreign/mesh/imported_file.h"
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

void scale_down(std::vector<PointLight>& lights) {
  double sum = 0;
  for (const PointLight& light : lights) {
    sum += brightest(light.color) * brightest(light.color);
  }
  for (PointLight& light : lights) {
    light.color = light.color * (1 / std::sqrt(std::max(sum, 1.0)));
  }
}

void note_lights(std::map<aiLightSourceType, std::uint64_t>& counts, std::vector<std::string>& notes) {
  const auto note = [&](aiLightSourceType type, const std::string& what) {
    if (counts[type] > 0) {
      notes.push_back(what + ": " + grouped(counts[type]));
    }
  };
  note(aiLightSource_POINT, "point lights whose fall-off with distance is ignored");
  note(aiLightSource_SPOT, "spot lights taken for point lights without fall-off");
  note(aiLightSource_DIRECTIONAL, "directional lights taken for point lights far away");
  note(aiLightSource_AREA, "area lights left out");
  note(aiLightSource_AMBIENT, "ambient lights left out");
  note(aiLightSource_UNDEFINED, "lights of an unknown kind left out");
}

/// The angle whose tangent is that of `angle` (radians) times `share` (at most 1): Newton's method from the right, where the
/// tangent is convex. A right angle and more stays what it is, to be refused.
double narrowed(double angle, double share) {
  if (!(angle < 1.5707963)) {
    return angle;
  }
  const double tangent = core::tan_radians(angle) * share;
  double result = angle;
  for (int i = 0; i < 200; ++i) {
    const double here = core::tan_radians(result);
    result -= (here - tangent) / (1 + here * here);
  }
  return result;
}

/// glTF has cameras with a vertical angle; our reader of it, as Assimp before 5.3, gives that times the aspect as the horizontal
/// one. Such an Assimp repeats the node's translation, which is in the node's transform already, as the camera's position, too.
bool has_vertical_angles(const aiScene& scene) {
  aiString format;
  const bool is_gltf = scene.mMetaData != nullptr && scene.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, format) &&
                       std::string(format.C_Str()).find("glTF") != std::string::npos;
  const bool is_ours = is_gltf && std::string(format.C_Str()) == gltf_source_format;
  return is_ours || (is_gltf && aiGetVersionMajor() * 100 + aiGetVersionMinor() < 503);
}

/// Half of what is seen along the shorter side of a picture whose width is `aspect` times its height, in degrees.
double half_degrees(const aiScene& scene, const aiCamera& camera, double aspect) {
  constexpr double degrees_of_radian = 57.295779513082320877;
  const double half = 0.5 * double{camera.mHorizontalFOV};
  if (has_vertical_angles(scene)) {
    const double vertical = camera.mAspect > 0 ? half / double{camera.mAspect} : half;
    return degrees_of_radian * (aspect < 1 ? narrowed(vertical, aspect) : vertical);
  }
  return degrees_of_radian * (aspect > 1 ? narrowed(half, 1 / aspect) : half);
}

core::View view_of(const aiScene& scene, const aiCamera& camera, const Transform& world) {
  const bool has_aspect = std::isfinite(camera.mAspect) && camera.mAspect > 0;
  const double aspect = has_aspect ? std::clamp(double{camera.mAspect}, 1 / aspect_max, aspect_max) : 1;
  core::View view;
  view.from = world.point(has_vertical_angles(scene) ? Vec3d{} : to_vec(camera.mPosition));
  view.at = view.from + world.direction(to_vec(camera.mLookAt));
  view.up = world.direction(to_vec(camera.mUp));
  view.width = static_cast<int>(std::lround(shorter_side * std::max(aspect, 1.0)));
  view.height = static_cast<int>(std::lround(shorter_side * std::max(1 / aspect, 1.0)));
  view.angle_degrees = 2 * half_degrees(scene, camera, aspect);
  return view;
}

bool is_perspective(const aiCamera& camera) { return camera.mHorizontalFOV > 0 && std::isfinite(camera.mHorizontalFOV); }

}  // namespace

std::vector<PointLight> lights_of(const aiScene& scene, const BoundingSphere& bounds, double scale,
                                  std::vector<std::string>& notes) {
  std::vector<PointLight> lights;
  std::map<aiLightSourceType, std::uint64_t> counts;
  for (std::size_t i = 0; i < scene.mNumLights; ++i) {
    const aiLight& light = *scene.mLights[i];
    const PointLight ours{position_of(light, world_of(scene, light.mName, scale), bounds), color_of(light), true};
    ++counts[light.mType];
    if (is_shown(light) && is_in_reach(ours.position) && brightest(ours.color) > 0) {
      lights.push_back(ours);
    }
  }
  scale_down(lights);
  note_lights(counts, notes);
  return lights;
}

std::optional<core::View> camera_of(const aiScene& scene, double scale, std::vector<std::string>& notes) {
  if (scene.mNumCameras == 0) {
    return std::nullopt;
  }
  if (scene.mNumCameras > 1) {
    notes.push_back("the first of " + std::to_string(scene.mNumCameras) + " cameras is taken");
  }
  const aiCamera& camera = *scene.mCameras[0];
  if (is_perspective(camera)) {
    const core::View view = view_of(scene, camera, world_of(scene, camera.mName, scale));
    if (!fault_of(view)) {
      return view;
    }
  }
  notes.push_back("the file's camera is not taken, since it has no perspective or no direction");
  return std::nullopt;
}

}  // namespace dmpc::apps
