// How a scene is placed, seen and lit, where the command line has its own idea.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/formats/mesh_options.h"
#include "apps/frontend/line/command_line.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// What --camera says; what it leaves open stays the scene's.
struct CameraChoice {
  core::Vec3d from, at;
  std::optional<core::Vec3d> up;
  std::optional<double> degrees;
};

struct SceneSetup {
  std::optional<CameraChoice> camera;
  std::vector<core::PointLight> lights;   ///< in place of the scene's, unless there are none
  std::optional<double> fill;             ///< the intensity of a white light in the eye, beside all others; 0 or more
  std::optional<core::Vec3d> ambient;     ///< core::Scene::ambient; each channel 0 or more
  std::optional<core::Vec3d> background;  ///< in place of the scene's; each channel 0 or more
  MeshOptions mesh;                       ///< for mesh files alone

  /// The scene is seen and lit as it says itself.
  bool is_as_scene() const { return !camera && lights.empty() && !fill && !ambient && !background; }
};

/// Declares --camera, --light, --fill, --ambient, --background, --scale, --up, --smooth, --missing, --files and --sandbox.
void add_options(OptionSet options, SceneSetup& scene_setup);

/// "FROM/AT[/UP[/DEGREES]]", "1,2,3/0,0,0/0,1,0/45". Throws core::UsageError, naming `option`, for anything else, or for a view
/// that shows nothing.
CameraChoice parse_camera(const std::string& text, const std::string& option = "--camera");
/// "X,Y,Z[/R,G,B]". Throws core::UsageError for anything else, or for a colour below 0.
core::PointLight parse_light(const std::string& text);

/// "R,G,B" or one number for all three, each from 0 to 1e30. Throws core::UsageError that names the option for anything else.
core::Vec3d parse_color(const std::string& option, const std::string& text);

/// The view with what the camera says in place of its own.
core::View view_at(const CameraChoice& camera, core::View own);
/// All of the view.
CameraChoice camera_of(const core::View& view);

/// What parse_camera() reads as these very numbers. Requires an up if there are degrees.
std::string text_of(const CameraChoice& camera);
/// What parse_light() reads as these very numbers.
std::string text_of(const core::PointLight& light);
/// "1,2,3", with the very numbers.
std::string text_of(const core::Vec3d& vector);

/// Whose a scene's own view is: its file's, or, of a mesh, that of a camera which may look from anywhere.
enum class SceneKind : std::uint8_t { own, mesh };

/// Gives the scene the camera, the lights and the background. What a camera leaves open stays the scene's; of a mesh up is what
/// --up says, or, where that points along the line of sight, away from who stands in front, and the angle is 45 degrees. A fill
/// leaves the other lights as bright as they are. Returns what is to be said of it, nothing as a rule. Throws core::UsageError if
/// the scene's own up does not go with the camera.
std::string apply(const SceneSetup& scene_setup, core::Scene& scene, SceneKind kind = SceneKind::own);

}  // namespace dmpc::apps
