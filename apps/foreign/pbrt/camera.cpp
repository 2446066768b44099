#include "apps/foreign/pbrt/camera.h"

#include <algorithm>
#include <cmath>

#include "apps/foreign/mesh/lights.h"
#include "apps/foreign/pbrt/affine.h"
#include "apps/foreign/pbrt/spectra.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "core/base/elementary.h"

namespace dmpc::apps::pbrt {
namespace {

using core::Vec3d;
using enum ParameterType;

constexpr double degrees_of_radian = 57.295779513082320877;

double angle_of_tangent(double tangent) { return degrees_of_radian * core::angle_of(tangent, 1); }

/// By default half of the shorter side is 1 in the screen window.
double window_half(const Parameters& parameters, Notes& notes) {
  const Parameter* const window = parameters.find("screenwindow", {number});
  if (window == nullptr) {
    return 1;
  }
  if (window->numbers.size() != 4) {
    parameters.fail(window->place, "screenwindow has " + grouped(window->numbers.size()) + " numbers, expected 4");
  }
  const auto& w = window->numbers;
  const bool is_middle = std::abs(w[0] + w[1]) < 1e-6 && std::abs(w[2] + w[3]) < 1e-6;
  notes.count("screen windows that are not about the middle, shown as if they were", is_middle ? 0 : 1);
  const double half = std::min(w[1] - w[0], w[3] - w[2]) / 2;
  if (!(half > 0 && half < 1e6)) {
    parameters.fail(window->place, "screenwindow shows nothing");
  }
  return half;
}

/// Returns the exposure without the shutter: ISO / 100, and the white point from a temperature.
Exposure exposure_of(const Parameters& parameters, Notes& notes) {
  Exposure exposure{.factor = parameters.number("iso", 100) / 100};
  if (!(exposure.factor > 0 && exposure.factor < 1e12)) {
    parameters.fail("its iso is " + rounded(exposure.factor * 100) + ", expected more than 0");
  }
  const bool is_camera = parameters.text("sensor", "cie1931") != "cie1931";
  notes.count("films with the sensor of a camera, shown with that of CIE 1931", is_camera ? 1 : 0);
  const double kelvin = parameters.number("whitebalance", 0);
  if (kelvin != 0) {
    if (!(kelvin >= 500 && kelvin <= 25'000)) {
      parameters.fail("its whitebalance is " + rounded(kelvin) + ", expected a temperature from 500 to 25,000 K");
    }
    exposure.balance = white_balance(kelvin);
    notes.count("films whose white balance is given to the lights, in place of their light");
  }
  return exposure;
}

}  // namespace

Vec3d Exposure::of(const Vec3d& light) const {
  const auto channel = [&](std::size_t i) { return std::max(dot(balance[i], light), 0.0) * factor; };
  return {channel(0), channel(1), channel(2)};
}

Film film_of(const std::string& kind, const Parameters& parameters, Notes& notes) {
  if (kind == "image") {
    parameters.fail("is of pbrt-v3: turn the scene into one of version 4 by pbrt --upgrade");
  }
  Film film;
  const std::int64_t width = parameters.integer("xresolution", film.size.width),
                     height = parameters.integer("yresolution", film.size.height);
  constexpr std::int64_t side_max = 65536;
  if (width < 1 || height < 1 || width > side_max || height > side_max || width * height > picture_pixels_max) {
    parameters.fail("has " + std::to_string(width) + "x" + std::to_string(height) +
                    " pixels, expected 1 to 65536 along a side, and at most 2^28");
  }
  film.size = {static_cast<int>(width), static_cast<int>(height)};
  film.exposure = exposure_of(parameters, notes);
  const bool is_cut = parameters.find("cropwindow", {number}) != nullptr || parameters.find("pixelbounds", {integer}) != nullptr;
  notes.count("films of which a part is to be made, made whole", is_cut ? 1 : 0);
  return film;
}

Camera camera_of(const std::string& kind, const Parameters& parameters, const Transform& from_world, Notes& notes) {
  Camera camera{.degrees = 0, .from_world = from_world};
  if (!inverse_of(from_world)) {
    parameters.fail("stands in coordinates that are pressed flat");
  }
  camera.open_seconds = parameters.number("shutterclose", 1) - parameters.number("shutteropen", 0);
  if (!(camera.open_seconds > 0 && camera.open_seconds < 1e12)) {
    parameters.fail("its shutter is open for " + rounded(camera.open_seconds) + " s, expected more than 0");
  }
  if (kind != "perspective") {
    notes.count("cameras of kind '" + clipped(kind, 40) + "', which are not taken");
    return camera;
  }
  camera.degrees = parameters.number("fov", 90);
  if (!(camera.degrees > 0 && camera.degrees < 180)) {
    parameters.fail("its fov is " + rounded(camera.degrees) + ", expected degrees between 0 and 180, both excluded");
  }
  const double half = core::tan_degrees(camera.degrees / 2) * window_half(parameters, notes);
  camera.degrees = 2 * angle_of_tangent(half);
  notes.count("aspects of cameras that are not the film's, shown with that", parameters.number("frameaspectratio") ? 1 : 0);
  notes.count("lenses that blur what is near or far, shown sharp", parameters.number("lensradius", 0) > 0 ? 1 : 0);
  return camera;
}

bool sees_left_handed(const Camera& camera) { return camera.from_world.determinant() > 0; }

std::optional<core::View> view_of(const Camera& camera, const Film& film, const std::optional<Resolution>& size,
                                  const Transform& turn) {
  const auto to_world = inverse_of(camera.from_world);
  if (camera.degrees <= 0 || !to_world) {
    return std::nullopt;
  }
  const Transform world = composed(turn, *to_world);
  const Vec3d ahead = world.direction({0, 0, 1}), up = world.direction({0, 1, 0});
  core::View view{.from = world.shift, .at = world.shift + normalize(ahead), .up = normalize(up)};
  view.width = film.size.width;
  view.height = film.size.height;
  const Resolution pixels = size.value_or(film.size);
  const int steps = std::min(pixels.width, pixels.height);
  const double half = core::tan_degrees(camera.degrees / 2) * std::max(steps - 1, 1) / steps;
  view.angle_degrees = 2 * angle_of_tangent(half);
  return view;
}

}  // namespace dmpc::apps::pbrt
