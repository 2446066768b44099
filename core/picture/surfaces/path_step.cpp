#include "core/picture/surfaces/path_step.h"

#include <algorithm>
#include <cmath>

#include "core/picture/hits/ray_start.h"
#include "core/picture/sampling/sample_pair.h"
#include "core/picture/surfaces/microfacet_lobes.h"
#include "core/picture/surfaces/surface_response.h"

namespace dmpc::core {
namespace {

constexpr std::uint32_t pairs_a_hit = 4;

std::optional<PathStep> scattered_step(const HitState& state, double chance) {
  const std::optional<Vec3d> towards = scattered_direction(state);
  if (!towards) {
    return std::nullopt;
  }
  const Color weight(Vec3d(scattered_color(state)) * (1.0 / chance));
  return PathStep{*towards, weight, RayKind::scattered, response_towards(state, *towards).density};
}

/// `place`: uniform in [0, sum of the shares).
std::optional<PathStep> step_at(const HitState& state, const WayShares& shares, double place) {
  if (place < shares.scattered) {
    return scattered_step(state, shares.scattered / shares.all());
  }
  const Vec3d direction = state.ray.full_direction();
  const auto all = static_cast<float>(shares.all());
  if (place < shares.scattered + shares.mirrored) {
    return PathStep{normalize(mirrored_direction(direction, state.normal)), mirrored_tint(state) * all,
                    kind_after(state.ray, RayKind::reflected)};
  }
  return PathStep{normalize(bent_direction(direction, state.normal, relative_index(state))), Color{all, all, all},
                  kind_after(state.ray, RayKind::refracted)};
}

std::optional<PathStep> chosen_step(const HitState& state, const SamplePair& choice) {
  if (state.has_microfacets()) {
    return MicrofacetLobes(state).step(choice, pair_of(state.ray, Purpose::direction));
  }
  const WayShares shares = shares_of(state);
  return shares.all() > 0.0 ? step_at(state, shares, choice.x * shares.all()) : std::nullopt;
}

/// Whether the path survives, and stands for those that do not. `chance` is in [0, 1).
bool survives(const Ray& ray, double chance, PathStep& step) {
  const double share = double{brightest(ray.weight * step.weight)};
  if (share > 0.0 && (ray.depth < roulette_from || share >= 1.0)) {
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
  const DiscPlace place = on_disc(pair);
  return normalize(about_axis(normal, place.x, place.y, std::sqrt(std::max(0.0, 1.0 - place.square))));
}

std::optional<Vec3d> scattered_direction(const HitState& state) {
  const Vec3d towards = cosine_direction(pair_of(state.ray, Purpose::direction), state.normal);
  return leads_outside(state, towards) ? std::optional(towards) : std::nullopt;
}

std::optional<PathStep> path_step(const HitState& state) {
  const SamplePair choice = pair_of(state.ray, Purpose::choice);
  std::optional<PathStep> step = chosen_step(state, choice);
  return step && survives(state.ray, choice.y, *step) ? step : std::nullopt;
}

}  // namespace dmpc::core
