#include "apps/scene/scene_setup.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/formats/view_faults.h"
#include "apps/formats/whole_view.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;

constexpr const char* camera_form = "FROM/AT[/UP[/DEGREES]] with points such as 1,2,3";
constexpr const char* light_form = "X,Y,Z[/R,G,B] with numbers, coordinates from -1e30 to 1e30, none of the colour below 0";
constexpr const char* color_form = "R,G,B such as 0.1,0.1,0.2, or one number for all three, each from 0 to 1e30";
constexpr double intensity_max = 1e30;

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& expected) {
  throw core::UsageError(option + "=" + text + ": expected " + expected);
}

std::optional<Vec3d> parse_vector(const std::string& text) {
  const std::vector<std::string> words = words_between(text, ',');
  if (words.size() != 3) {
    return std::nullopt;
  }
  const Vec3d vector{finite_number(words[0]), finite_number(words[1]), finite_number(words[2])};
  return is_finite(vector) ? std::optional(vector) : std::nullopt;
}

/// If no up vector is given, one that is valid for the direction is used.
core::View view_of(const CameraChoice& camera) {
  const Vec3d direction = camera.at - camera.from;
  const bool is_upright = std::abs(direction.y) >= std::max(std::abs(direction.x), std::abs(direction.z));
  return {.from = camera.from,
          .at = camera.at,
          .up = camera.up.value_or(is_upright ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}),
          .angle_degrees = camera.degrees.value_or(45)};
}

const char* expected_instead(ViewFault fault) {
  switch (fault) {
    case ViewFault::angle:
      return "an angle between 0 and 180 degrees, both excluded";
    case ViewFault::far_from:
    case ViewFault::far_at:
      return "coordinates from -1e30 to 1e30";
    case ViewFault::direction:
      return "FROM and AT at different points";
    case ViewFault::up:
      return "an UP that is not zero and not parallel to the line from FROM to AT";
  }
  return "";
}

/// Lights without a colour, which share one total, keep the intensity that they have without the fill.
void add_fill(double intensity, core::Scene& scene) {
  std::vector<core::PointLight> lights;
  for (const core::PointLight& light : scene.lights) {
    lights.push_back(light);
    lights.back().color = core::intensity_of(light, scene);
    lights.back().has_color = true;
  }
  lights.push_back({scene.view.from, {intensity, intensity, intensity}, true});
  scene.lights = std::move(lights);
}

/// Returns an empty note.
std::string look(const CameraChoice& camera, core::View& view) {
  view = view_at(camera, view);
  if (fault_of(view)) {
    throw core::UsageError("--camera: the scene's own up is parallel to the line from FROM to AT: give UP, too");
  }
  return "";
}

/// Returns the up axis of a view of the whole scene, which is the file's.
UpAxis axis_of(const Vec3d& up) {
  const std::size_t axis = std::abs(up.x) > 0.5 ? 0 : std::abs(up.y) > 0.5 ? 1 : 2;
  return {axis, up[axis] < 0};
}

/// Ignores the file's own camera: `view` shows the whole scene.
std::string look_at_mesh(const SceneSetup& scene_setup, core::View& view) {
  const CameraChoice& camera = *scene_setup.camera;
  const SceneAxes axes = axes_of(scene_setup.mesh.up.value_or(axis_of(view.up)));
  const Vec3d direction = camera.at - camera.from;
  view.up = axes.up;
  view.angle_degrees = core::View{}.angle_degrees;
  view = view_at(camera, view);
  if (fault_of(view) != ViewFault::up) {
    return "";
  }
  view.up = dot(direction, axes.up) > 0 ? axes.front : Vec3d{} - axes.front;  // avoids negative zeros
  return "--camera looks along the axis that points up: upwards in the picture is " + text_of(view.up) +
         ", as by --camera=" + text_of(camera.from) + "/" + text_of(camera.at) + "/" + text_of(view.up);
}

void add_light_options(OptionSet& options, SceneSetup& scene_setup) {
  options.add_texts(
      "--light", "X,Y,Z[/R,G,B] [the scene's]",
      [&scene_setup](const std::string& text) { scene_setup.lights.push_back(parse_light(text)); },
      "A point light in place of the scene's; may be given several times. Without a colour it is as bright as NFF's");
  options.add_text(
      "--fill", "INTENSITY [none]",
      [&scene_setup](const std::string& text) {
        scene_setup.fill = parse_within(text, "--fill", 0, intensity_max, "a number from 0 to 1e30");
      },
      "Add a white light at the camera, so that what the other lights do not reach is not black. A mesh without lights gets 0.3; "
      "1 is as bright as a single light");
  options.add_text(
      "--ambient", "R,G,B|GREY [0]",
      [&scene_setup](const std::string& text) { scene_setup.ambient = parse_color("--ambient", text); },
      "Ambient light without shadows: add this times the diffuse colour to every surface. 0.1 is faint, 1 shows colours as they "
      "are");
  options.add_text(
      "--background", "R,G,B|GREY [the scene's]",
      [&scene_setup](const std::string& text) { scene_setup.background = parse_color("--background", text); },
      "Colour of rays that hit nothing, linear: 0 is black, 1 is white");
}

}  // namespace

Vec3d parse_color(const std::string& option, const std::string& text) {
  const bool is_grey = text.find(',') == std::string::npos;
  const auto color = parse_vector(is_grey ? text + "," + text + "," + text : text);
  if (!color || std::min({color->x, color->y, color->z}) < 0 || largest_component(*color) > intensity_max) {
    refuse(option, text, color_form);
  }
  return *color;
}

CameraChoice parse_camera(const std::string& text, const std::string& option) {
  const std::vector<std::string> parts = words_between(text, '/');
  const auto vector = [&](std::size_t i) {
    const auto read = i < parts.size() ? parse_vector(parts[i]) : std::nullopt;
    return read ? *read : (refuse(option, text, camera_form), Vec3d{});
  };
  if (parts.size() > 4) {
    refuse(option, text, camera_form);
  }
  CameraChoice camera{.from = vector(0), .at = vector(1)};
  if (parts.size() > 2) {
    camera.up = vector(2);
  }
  if (parts.size() > 3) {
    camera.degrees = finite_number(parts[3]);
  }
  if (const auto fault = fault_of(view_of(camera))) {
    refuse(option, text, expected_instead(*fault));
  }
  return camera;
}

core::View view_at(const CameraChoice& camera, core::View own) {
  own.from = camera.from;
  own.at = camera.at;
  own.up = camera.up.value_or(own.up);
  own.angle_degrees = camera.degrees.value_or(own.angle_degrees);
  return own;
}

CameraChoice camera_of(const core::View& view) { return {view.from, view.at, view.up, view.angle_degrees}; }

core::PointLight parse_light(const std::string& text) {
  const std::vector<std::string> parts = words_between(text, '/');
  const auto position = parse_vector(parts[0]);
  const auto color = parse_vector(parts.back());
  if (parts.size() > 2 || !position || !is_in_reach(*position) || !color ||
      (parts.size() == 2 && std::min({color->x, color->y, color->z}) < 0)) {
    refuse("--light", text, light_form);
  }
  return parts.size() == 2 ? core::PointLight{*position, *color, true} : core::PointLight{.position = *position};
}

std::string text_of(const core::Vec3d& vector) {
  return shortest(vector.x) + "," + shortest(vector.y) + "," + shortest(vector.z);
}

std::string text_of(const CameraChoice& camera) {
  core::expect(camera.up || !camera.degrees, "degrees stand behind an up");
  const std::string up = camera.up ? "/" + text_of(*camera.up) : "";
  return text_of(camera.from) + "/" + text_of(camera.at) + up + (camera.degrees ? "/" + shortest(*camera.degrees) : "");
}

std::string text_of(const core::PointLight& light) {
  return text_of(light.position) + (light.has_color ? "/" + text_of(light.color) : "");
}

void add_options(OptionSet options, SceneSetup& scene_setup) {
  options.add_text(
      "--camera", "FROM/AT[/UP[/DEGREES]] [the scene's]",
      [&scene_setup](const std::string& text) { scene_setup.camera = parse_camera(text); },
      "Position and target of the camera, such as 1,2,3/0,0,0/0,1,0/45. For a mesh UP defaults to y, or to --up, and DEGREES to "
      "45, whatever camera its file has");
  add_light_options(options, scene_setup);
  options.add_text(
      "--scale", "S [1]",
      [&scene_setup](const std::string& text) {
        scene_setup.mesh.scale = parse_within(text, "--scale", above_0, view_coordinate_max, "a number above 0, at most 1e30");
      },
      "Mesh files: multiply all coordinates by S");
  OptionSet::Choices<UpAxis> axes;
  for (const char* const word : {"x", "y", "z", "-x", "-y", "-z"}) {
    axes.emplace_back(word, up_axis_of(word));
  }
  options.add_choice(
      "--up", scene_setup.mesh.up, axes, "y",
      "Mesh files: the axis that points up, such as --up=-z. It is used if the file has no camera or --camera has no UP");
  options.add_text(
      "--smooth", "DEGREES [the file's normals]",
      [&scene_setup](const std::string& text) {
        scene_setup.mesh.smooth_degrees = parse_within(text, "--smooth", 0, 180, "degrees from 0 to 180");
      },
      "Mesh files: recompute vertex normals, smooth across edges up to this angle");
  options.add_words(
      "--missing", {"error", "plain"},
      [&scene_setup](const std::string& text) { scene_setup.mesh.allows_missing = text == "plain"; },
      "Mesh files: if textures or other files that they refer to cannot be read, stop with an error, or use the plain colour of "
      "what they cover; error if not given");
  options.add_words(
      "--files", {"below", "anywhere"},
      [&scene_setup](const std::string& text) { scene_setup.mesh.opens_anywhere = text == "anywhere"; },
      "Mesh files: the files that they may refer to: those in their own folder and below it, or any; below if not given");
  add_sandbox_option(options, scene_setup.mesh.sandbox);
}

std::string apply(const SceneSetup& scene_setup, core::Scene& scene, SceneKind kind) {
  std::string note;
  if (scene_setup.camera) {
    note = kind == SceneKind::mesh ? look_at_mesh(scene_setup, scene.view) : look(*scene_setup.camera, scene.view);
  }
  if (!scene_setup.lights.empty()) {
    scene.lights = scene_setup.lights;
  }
  if (scene_setup.fill.value_or(0) > 0) {
    add_fill(*scene_setup.fill, scene);
  }
  scene.ambient = scene_setup.ambient.value_or(scene.ambient);
  scene.background = scene_setup.background.value_or(scene.background);
  return note;
}

}  // namespace dmpc::apps
