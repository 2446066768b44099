#include "apps/foreign/mesh/lights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <numbers>

#include "apps/foreign/mesh/count_note.h"
#include "apps/formats/view_faults.h"
#include "core/base/ranges.h"

namespace dmpc::apps {
namespace {

using core::PointLight;
using core::Vec3d;

constexpr double pi = std::numbers::pi;
constexpr double far_radii = 1000, near_radii = 1.0 / 1000;

double brightest(const Vec3d& color) { return std::max({color.x, color.y, color.z}); }

/// Limits channels to values whose squares are finite.
Vec3d clean(const Vec3d& color) {
  const auto channel = [](double share) { return std::isfinite(share) ? std::clamp(share, 0.0, 1e100) : 0.0; };
  return {channel(color.x), channel(color.y), channel(color.z)};
}

}  // namespace

Vec3d far_position(const FileLight& light, const BoundingSphere& bounds) {
  return bounds.center - light.position * (far_radii * bounds.radius);
}

void scale_down(std::vector<PointLight>& lights) {
  const double sum =
      core::sum_over<double>(lights, [&](const PointLight& light) { return brightest(light.color) * brightest(light.color); });
  for (PointLight& light : lights) {
    light.color = light.color * (1 / std::sqrt(std::max(sum, 1.0)));
  }
}

/// Our lights' intensity 1 is an irradiance of pi.
PointLight falling(const FileLight& light, const BoundingSphere& bounds, double scale) {
  constexpr double least = 1e-29;
  return {.position = light.position * scale,
          .color = light.intensity * (scale * scale / pi),
          .has_color = true,
          .falls_off_from = std::max(bounds.radius * near_radii, least),
          .cone = light.cone};
}

double share_for(const std::vector<PointLight>& lights, const std::vector<Vec3d>& places) {
  std::vector<double> squares;
  for (const Vec3d& place : places) {
    double& sum = squares.emplace_back();
    for (const PointLight& light : lights) {
      const double way = light.falls_off_from > 0 ? std::max(length(light.position - place), light.falls_off_from) : 1;
      const double shown = brightest(light.color) / (way * way);
      sum += shown * shown;
    }
  }
  const auto middle = squares.begin() + (std::ssize(squares) - 1) / 2;
  std::nth_element(squares.begin(), middle, squares.end());
  constexpr double blinding = 16;
  return squares.empty() || *middle <= blinding * blinding ? 1 : 1 / std::sqrt(*middle);
}

std::vector<PointLight> lights_of(const std::vector<FileLight>& lights, const BoundingSphere& bounds, double scale,
                                  bool is_by_paths, bool is_lit_else, std::vector<std::string>& notes) {
  std::vector<PointLight> result;
  std::map<FileLightKind, std::uint64_t> counts;
  std::uint64_t dark = 0, nowhere = 0, ranges = 0;
  for (const FileLight& light : lights) {
    const bool is_distant = light.kind == FileLightKind::distant;
    PointLight ours = falling(light, bounds, scale);
    if (is_distant || !is_by_paths) {
      ours.falls_off_from = 0;
      ours.color = light.intensity * (is_by_paths ? 1 / pi : 1);
    }
    ours.position = is_distant ? far_position(light, bounds) : ours.position;
    ours.color = clean(ours.color);
    if (!(brightest(ours.color) > 0)) {
      ++dark;
    } else if (!is_in_reach(ours.position) || !is_finite(ours.cone.ahead)) {
      ++nowhere;
    } else {
      ++counts[light.kind];
      ranges += light.has_range ? 1 : 0;
      result.push_back(ours);
    }
  }
  if (is_by_paths) {
    note_count(notes, "lights with a range, beyond which they go on shining", ranges);
  } else {
    scale_down(result);
    note_count(notes, "point lights whose fall-off with distance is ignored", counts[FileLightKind::point]);
    note_count(notes, "spot lights whose fall-off with distance is ignored", counts[FileLightKind::spot]);
  }
  note_count(notes, "directional lights taken for point lights far away", counts[FileLightKind::distant]);
  const std::string instead = result.empty() && !is_lit_else ? ", so that plain ones take their place" : "";
  note_count(notes, "lights without any brightness left out" + instead, dark);
  note_count(notes, "lights without a place or direction left out" + instead, nowhere);
  return result;
}

std::optional<core::View> view_of(const std::vector<FileView>& views, double scale, std::vector<std::string>& notes) {
  const std::string count = std::to_string(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (!views[i].view) {
      continue;
    }
    core::View view = *views[i].view;
    const Vec3d ahead = view.at - view.from;
    view.from = view.from * scale;
    view.at = view.from + ahead;
    if (fault_of(view)) {
      continue;
    }
    if (views.size() > 1) {
      notes.push_back((i == 0 ? "the first of " + count + " cameras is taken, '"
                              : "camera " + std::to_string(i + 1) + " of " + count +
                                    " is taken, the first that has a perspective and a direction, '") +
                      views[i].name + "'");
    }
    return view;
  }
  if (!views.empty()) {
    notes.push_back(views.size() == 1
                        ? "the file's camera is not taken, since it has no perspective or no direction"
                        : "none of the file's " + count + " cameras is taken, since none has a perspective and a direction");
  }
  return std::nullopt;
}

}  // namespace dmpc::apps
