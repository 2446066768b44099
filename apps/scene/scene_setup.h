// Changes to a scene's placement, view and lights from the command line.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/formats/mesh_options.h"
#include "apps/frontend/line/command_line.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// The operand of --camera; omitted values are taken from the scene.
struct CameraChoice {
  core::Vec3d from, at;
  std::optional<core::Vec3d> up;
  std::optional<double> degrees;
};

struct SceneSetup {
  std::optional<CameraChoice> camera;
  std::vector<core::PointLight> lights;   ///< replace the scene's unless empty
  std::optional<double> fill;             ///< intensity of an additional white light at the eye; 0 or more
  std::optional<core::Vec3d> ambient;     ///< core::Scene::ambient; each channel 0 or more
  std::optional<core::Vec3d> background;  ///< replaces the scene's; each channel 0 or more
  MeshOptions mesh;                       ///< only for mesh files

  /// Returns whether the scene's own view and lights are used.
  bool is_as_scene() const { return !camera && lights.empty() && !fill && !ambient && !background; }
};

/// Declares --camera, --light, --fill, --ambient, --background, --scale, --up, --smooth, --missing, --files and --sandbox.
void add_options(OptionSet options, SceneSetup& scene_setup);

/// Parses "FROM/AT[/UP[/DEGREES]]", as in "1,2,3/0,0,0/0,1,0/45". Otherwise, or if nothing is visible, throws core::UsageError
/// with `option`.
CameraChoice parse_camera(const std::string& text, const std::string& option = "--camera");
/// Parses "X,Y,Z[/R,G,B]". Throws core::UsageError for anything else, or for a negative colour.
core::PointLight parse_light(const std::string& text);

/// Parses "R,G,B" or one number for all three, each from 0 to 1e30. Otherwise throws core::UsageError that names the option.
core::Vec3d parse_color(const std::string& option, const std::string& text);

/// Returns the view with the given values of the camera in place of its own.
core::View view_at(const CameraChoice& camera, core::View own);
/// Returns the complete view as a choice.
CameraChoice camera_of(const core::View& view);

/// Returns text that parse_camera() reads as exactly these numbers. Requires an up vector if there are degrees.
std::string text_of(const CameraChoice& camera);
/// Returns text that parse_light() reads as exactly these numbers.
std::string text_of(const core::PointLight& light);
/// Returns "1,2,3", which is read as exactly these numbers.
std::string text_of(const core::Vec3d& vector);

/// The origin of a scene's own view: its file, or, for a mesh, a camera that may look from anywhere.
enum class SceneKind : std::uint8_t { own, mesh };

/// Applies the camera, the lights and the background to the scene. Omitted values of the camera stay the scene's. For a mesh the
/// up vector is that of --up or, if that is parallel to the line of sight, points away from a viewer in front, and the angle is
/// 45 degrees. A fill leaves the other lights as bright as they are. Returns a note, usually empty. Throws core::UsageError if
/// the scene's own up vector is invalid for the camera.
std::string apply(const SceneSetup& scene_setup, core::Scene& scene, SceneKind kind = SceneKind::own);

}  // namespace dmpc::apps
