#include "apps/foreign/pbrt/lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "apps/foreign/pbrt/affine.h"
#include "apps/foreign/pbrt/spectra.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/shown_text.h"
#include "core/base/elementary.h"

namespace dmpc::apps::pbrt {
namespace {

using core::Vec3d;
using enum ParameterType;

constexpr double pi = std::numbers::pi;

Vec3d light(const Parameters& parameters, const char* name, const Exposure& exposure, double factor) {
  const Parameter* const found = parameters.find(name, {rgb, spectrum, blackbody});
  return exposure.of(found == nullptr ? Vec3d{1, 1, 1} : color_of(*found, parameters, SpectrumUse::light)) * factor;
}

double scale_of(const Parameters& parameters) {
  constexpr double most = 1e12;
  const double scale = parameters.number("scale", 1);
  if (!(scale >= 0 && scale <= most)) {
    parameters.fail("its scale is " + rounded(scale) + ", expected 0 to 1e12");
  }
  return scale;
}

/// Returns the factor that scales the light's total `of_one` to the requested one; 1 if none is requested.
double factor_of(const Parameters& parameters, const char* name, double of_one) {
  const double value = parameters.number(name, 0);
  return value > 0 ? value / of_one : 1;
}

void check_place(const Parameters& parameters, const Vec3d& point) {
  if (!(length(point) < 1e30)) {
    parameters.fail("stands nowhere: a coordinate is beyond 1e30");
  }
}

/// Returns the solid angle that the light of a spot would fill at its axial intensity.
double filled(const core::LightCone& cone) {
  const double full = core::cos_degrees(cone.full_degrees), none = core::cos_degrees(cone.none_degrees);
  return 2 * pi * ((1 - full) + (full - none) / 2);
}

core::LightCone cone_of(const Parameters& parameters, const Transform& world) {
  const Vec3d from = parameters.point("from").value_or(Vec3d{}), to = parameters.point("to").value_or(Vec3d{0, 0, 1});
  const Vec3d ahead = world.direction(to - from);
  const double none = parameters.number("coneangle", 30), full = none - parameters.number("conedeltaangle", 5);
  if (!(none > 0 && none <= 180 && full <= none)) {
    parameters.fail("its cone ends at " + rounded(none) + " degrees, from " + rounded(full) +
                    " on, expected more than 0 and at most 180");
  }
  if (!(length(ahead) > 0 && length(ahead) < 1e30)) {
    parameters.fail("its light goes nowhere: from and to are one point, or too far apart");
  }
  return {.ahead = normalize(ahead), .full_degrees = std::max(full, 0.0), .none_degrees = none, .edge = core::ConeEdge::smooth};
}

/// Returns a circular cone with the solid angle of a projector's square picture.
core::LightCone projector_of(const Parameters& parameters, const Transform& world) {
  const double fov = parameters.number("fov", 90);
  const Vec3d ahead = world.direction({0, 0, 1});
  if (!(fov > 0 && fov < 180 && length(ahead) > 0 && length(ahead) < 1e30)) {
    parameters.fail("its picture spans " + rounded(fov) +
                    " degrees, expected between 0 and 180, in coordinates not pressed flat");
  }
  const double t = core::tan_degrees(fov / 2), cosine = 1 - core::angle_of(t * t, std::sqrt(1 + 2 * t * t)) * (2 / pi);
  const double degrees = core::angle_of(std::sqrt(1 - cosine * cosine), cosine) * (180 / pi);
  return {.ahead = normalize(ahead), .full_degrees = degrees, .none_degrees = degrees};
}

void add_point(const Parameters& parameters, const Transform& world, const Exposure& exposure, const core::LightCone& cone,
               PlacedFile& file) {
  const bool is_spot = cone.none_degrees > 0;
  const double factor = scale_of(parameters) * factor_of(parameters, "power", is_spot ? filled(cone) : 4 * pi);
  FileLight result{.kind = is_spot ? FileLightKind::spot : FileLightKind::point,
                   .position = world.point(parameters.point("from").value_or(Vec3d{})),
                   .intensity = light(parameters, "I", exposure, factor),
                   .cone = cone};
  check_place(parameters, result.position);
  file.lights.push_back(result);
}

void add_distant(const Parameters& parameters, const Transform& world, const Exposure& exposure, PlacedFile& file) {
  const Vec3d from = parameters.point("from").value_or(Vec3d{}), to = parameters.point("to").value_or(Vec3d{0, 0, 1});
  const Vec3d way = world.direction(to - from);
  const double distance = length(way);
  if (!(distance > 0 && distance < 1e30)) {
    parameters.fail("its light goes nowhere: from and to are one point, or too far apart");
  }
  const double factor = scale_of(parameters) * factor_of(parameters, "illuminance", 1);
  file.lights.push_back(
      {.kind = FileLightKind::distant, .position = way * (1 / distance), .intensity = light(parameters, "L", exposure, factor)});
}

void add_infinite(const Parameters& parameters, const Tokens& tokens, const Transform& world, const Exposure& exposure,
                  PlacedFile& file, Notes& notes) {
  const double scale = scale_of(parameters);
  const std::string name = parameters.text("filename", "");
  notes.count("portals of infinite lights, which change no light, left out",
              parameters.find("portal", {point3}) != nullptr ? 1 : 0);
  if (name.empty()) {
    const double factor = scale * factor_of(parameters, "illuminance", pi);
    file.background = file.background + light(parameters, "L", exposure, factor);
    return;
  }
  const bool is_measured = parameters.number("illuminance", 0) > 0;
  notes.count("pictures of the sky that are to bring an illuminance, shown as bright as they are", is_measured ? 1 : 0);
  const auto inverse = inverse_of(world);
  if (!inverse) {
    parameters.fail("has coordinates that are pressed flat, in which no sky has directions");
  }
  file.skies.push_back({.path = tokens.path_of(name), .rows = inverse->rows, .scale = exposure.of({scale, scale, scale})});
}

/// A small face; the length of its vector is its area.
FileLight half_round(const Vec3d& centre, const Vec3d& face, const Vec3d& radiance) {
  return {.kind = FileLightKind::spot,
          .position = centre,
          .intensity = radiance * length(face),
          .cone = {.ahead = normalize(face), .full_degrees = 0, .none_degrees = 90}};
}

double triangle_area(const Vec3d& a, const Vec3d& b, const Vec3d& c) { return 0.5 * length(cross(b - a, c - a)); }

/// Calls take(a, b, c) for each triangle of a shape that is not a sphere.
template <class Take>
void for_each_triangle(const PlacedShape& shape, const Transform& world, const Take& take) {
  const PolygonMesh made = shape.round ? mesh_of(*shape.round) : PolygonMesh{};
  const PolygonMesh& mesh = shape.round ? made : shape.mesh;
  std::size_t first = 0;
  const auto corner = [&](std::size_t i) { return world.point(mesh.vertices[mesh.faces.corners[i]]); };
  for (const std::uint32_t end : mesh.faces.ends) {
    for (std::size_t i = first + 2; i < end; ++i) {
      take(corner(first), corner(i - 1), corner(i));
    }
    first = end;
  }
}

double area_of(const PlacedShape& shape, const Transform& world) {
  if (shape.is_ball()) {
    const double stretch = std::cbrt(std::abs(world.determinant())) * shape.round->radius;
    return 4 * pi * stretch * stretch;
  }
  double area = 0;
  for_each_triangle(shape, world, [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) { area += triangle_area(a, b, c); });
  return area;
}

}  // namespace

AreaLight area_light_of(const std::string& kind, const Parameters& parameters, const Exposure& exposure, Notes& notes) {
  if (kind != "diffuse") {
    parameters.fail("there is no area light of kind '" + clipped(kind, 40) + "' in pbrt-v4");
  }
  AreaLight result{.radiance = light(parameters, "L", exposure, scale_of(parameters)), .power = {}, .is_twosided = false};
  const double power = parameters.number("power", 0);
  if (power > 0) {
    result.power = power;
  }
  result.is_twosided = parameters.flag("twosided", false);
  notes.count("area lights with a picture, shown as bright all over", parameters.text("filename", "").empty() ? 0 : 1);
  return result;
}

Vec3d radiance_of(const AreaLight& light, const PlacedShape& shape, const Transform& world) {
  const double area = light.power ? area_of(shape, world) * pi * (light.is_twosided ? 2 : 1) : 0;
  return light.power && area > 0 ? light.radiance * (*light.power / area) : light.radiance;
}

/// Returns point lights: a cosine light into the half-space of each face as long as there are few faces; otherwise, and for a
/// sphere, an isotropic light, which is what a surface that faces all directions equally looks like from afar.
std::vector<FileLight> unseen_lights(const AreaLight& light, const PlacedShape& shape, const Transform& world) {
  constexpr std::size_t faces_max = 16;
  const Vec3d radiance = radiance_of(light, shape, world);
  const double sides = light.is_twosided ? 2 : 1;
  if (shape.is_ball()) {
    return {
        {.kind = FileLightKind::point, .position = world.point({}), .intensity = radiance * (sides * area_of(shape, world) / 4)}};
  }
  const double side = (world.determinant() < 0) != shape.is_turned ? -0.5 : 0.5;
  std::vector<FileLight> lights;
  Vec3d middle, across;
  double area = 0;
  for_each_triangle(shape, world, [&](const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d face = cross(b - a, c - a) * side, centre = (a + b + c) * (1.0 / 3);
    middle = middle + centre * length(face);
    across = across + face;
    area += length(face);
    if (lights.size() <= faces_max && length(face) > 0) {
      lights.push_back(half_round(centre, face, radiance));
    }
  });
  if (lights.size() > faces_max) {
    const bool is_flat = length(across) > 0.999 * area;
    lights = {is_flat ? half_round(middle * (1 / area), across, radiance)
                      : FileLight{.kind = FileLightKind::point,
                                  .position = middle * (1 / area),
                                  .intensity = radiance * (sides * area / 4)}};
  }
  const bool has_backs = light.is_twosided && !lights.empty() && lights.front().kind == FileLightKind::spot;
  for (std::size_t i = 0, count = lights.size(); has_backs && i < count; ++i) {
    lights.push_back(lights[i]);
    lights.back().cone.ahead = -lights.back().cone.ahead;
  }
  return lights;
}

void add_light(const std::string& kind, const Parameters& parameters, const Tokens& tokens, const Transform& world,
               const Exposure& exposure, PlacedFile& file, Notes& notes) {
  if (kind == "point") {
    add_point(parameters, world, exposure, {}, file);
  } else if (kind == "spot") {
    add_point(parameters, world, exposure, cone_of(parameters, world), file);
  } else if (kind == "goniometric" || kind == "projection") {
    const bool is_projection = kind == "projection";
    notes.count("lights of kind '" + kind + "', which shine " + (is_projection ? "in a cone" : "all round") +
                " here, without their picture");
    parameters.text("filename", "");
    add_point(parameters, world, exposure, is_projection ? projector_of(parameters, world) : core::LightCone{}, file);
  } else if (kind == "distant") {
    add_distant(parameters, world, exposure, file);
  } else if (kind == "infinite") {
    add_infinite(parameters, tokens, world, exposure, file, notes);
  } else {
    parameters.fail("there is no light of kind '" + clipped(kind, 40) + "' in pbrt-v4");
  }
}

}  // namespace dmpc::apps::pbrt
