#include "core/picture/path_step.h"

#include <algorithm>
#include <cmath>

#include "core/base/elementary.h"
#include "core/picture/ray_start.h"
#include "core/picture/surface_shares.h"

namespace dmpc::core {
namespace {

constexpr double quarter_of_pi = 0.785398163397448310;

constexpr std::uint32_t pairs_a_hit = 4;

SamplePair pair_of(const Ray& ray, Purpose purpose) { return pair_of(ray.pixel, ray.sample, ray.depth, purpose); }

/// Of the surface's three ways, in the brightest channel of each.
struct Shares {
  double scattered, mirrored, refracted;

  double all() const { return scattered + mirrored + refracted; }
};

Color scattered_color(const HitState& state) { return state.surface.material.color * state.surface.material.diffuse; }

Shares shares_of(const HitState& state) {
  return {double{brightest(scattered_color(state))}, double{mirrored_share(state)},
          state.has_refraction ? double{state.surface.material.transmittance} : 0.0};
}

RayKind kind_after(const HitState& state, RayKind kind) {
  return state.ray.kind == RayKind::scattered ? RayKind::scattered : kind;
}

std::optional<PathStep> scattered_step(const HitState& state, double chance) {
  const std::optional<Vec3d> towards = scattered_direction(state);
  return towards ? std::optional(PathStep{*towards, Color(Vec3d(scattered_color(state)) * (1.0 / chance)), RayKind::scattered})
                 : std::nullopt;
}

/// `place`: from 0 to less than the sum of the shares, anywhere as likely.
std::optional<PathStep> step_at(const HitState& state, const Shares& shares, double place) {
  if (place < shares.scattered) {
    return scattered_step(state, shares.scattered / shares.all());
  }
  const Vec3d direction = state.ray.full_direction();
  const auto all = static_cast<float>(shares.all());
  if (place < shares.scattered + shares.mirrored) {
    return PathStep{normalize(mirrored_direction(direction, state.normal)), mirrored_tint(state) * all,
                    kind_after(state, RayKind::reflected)};
  }
  return PathStep{normalize(bent_direction(direction, state.normal, relative_index(state))), Color{all, all, all},
                  kind_after(state, RayKind::refracted)};
}

/// Whether the path survives, and counts for those that do not. `chance`: from 0 to less than 1; `first`: of the hits that ask.
bool survives(const Ray& ray, double chance, int first, PathStep& step) {
  const double share = double{brightest(ray.weight * step.weight)};
  if (share > 0.0 && (ray.depth < first || share >= 1.0)) {
    return true;
  }
  if (!(chance < share)) {
    return false;
  }
  step.weight = Color(Vec3d(step.weight) * (1.0 / share));
  return true;
}

}  // namespace

SamplePair pair_of(std::uint32_t pixel, std::uint32_t sample, int depth, Purpose purpose) {
  const std::uint32_t hits_before = static_cast<std::uint32_t>(depth) - 1;
  return sample_pair(pixel, sample, pairs_a_hit * hits_before + 1 + static_cast<std::uint32_t>(purpose));
}

Vec3d cosine_direction(const SamplePair& pair, const Vec3d& normal) {
  const double a = 2.0 * pair.x - 1.0, b = 2.0 * pair.y - 1.0;
  const bool is_beside = std::fabs(a) > std::fabs(b);
  const double radius = is_beside ? a : b, ratio = radius == 0.0 ? 0.0 : (is_beside ? b : a) / radius;
  const double along = radius * cos_radians(quarter_of_pi * ratio), aside = radius * sin_radians(quarter_of_pi * ratio);
  const double x = is_beside ? along : aside, y = is_beside ? aside : along;
  const double height = std::sqrt(std::max(0.0, 1.0 - radius * radius));
  const double sign = std::copysign(1.0, normal.z), scale = -1.0 / (sign + normal.z), mixed = normal.x * normal.y * scale;
  const Vec3d first{1.0 + sign * normal.x * normal.x * scale, sign * mixed, -sign * normal.x};
  const Vec3d second{mixed, sign + normal.y * normal.y * scale, -normal.y};
  return normalize(first * x + second * y + normal * height);
}

std::optional<Vec3d> scattered_direction(const HitState& state) {
  const Vec3d towards = cosine_direction(pair_of(state.ray, Purpose::direction), state.normal);
  const double side = state.leaving ? -1.0 : 1.0;
  return side * dot(towards, state.geometric_normal) > 0.0 ? std::optional(towards) : std::nullopt;
}

std::optional<PathStep> path_step(const HitState& state, int roulette_from) {
  const Shares shares = shares_of(state);
  if (!(shares.all() > 0.0)) {
    return std::nullopt;
  }
  const SamplePair choice = pair_of(state.ray, Purpose::choice);
  std::optional<PathStep> step = step_at(state, shares, choice.x * shares.all());
  return step && survives(state.ray, choice.y, roulette_from, *step) ? step : std::nullopt;
}

}  // namespace dmpc::core
