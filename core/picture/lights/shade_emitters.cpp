// Path tracing with emitters: a hit sends a shadow ray to an emitter (light sampling), and emitters that a path hits (BSDF
// sampling) count less if the hit before could have sampled them. Weights by the other method's density count all light once.
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/picture/hits/ray_start.h"
#include "core/picture/lights/emitter_light.h"
#include "core/picture/shade.h"
#include "core/picture/surfaces/surface_response.h"
#include "core/record/choice_node.h"

namespace dmpc::core {
namespace {

using Stage = HitState::Stage;

/// The density with which hits sample, from the ray's start, the point that it hit on an emitter that may be chosen.
double bsdf_sampling_density_at(const HitState& state, double density_on) {
  const Vec3d origin = state.ray.full_origin();
  if (state.curved) {
    const double radius = state.clearance.radius;
    return density_towards_sphere(density_on, length(state.point - state.geometric_normal * radius - origin), radius);
  }
  return density_towards_triangle(density_on, length(state.point - origin),
                                  std::fabs(dot(state.ray.full_direction(), state.geometric_normal)));
}

/// The density with which hits sample along a shadow ray, computed as for a path's ray from the same start to that point.
double light_sampling_density_at(const EmitterRecord& emitter, const LightSample& place, const Ray& shadow, double along,
                                 double density_on) {
  return emitter.kind == PrimitiveKind::sphere
             ? density_towards_sphere(density_on, length(emitter.center() - shadow.full_origin()), emitter.radius())
             : density_towards_triangle(density_on, place.distance - along, place.cosine);
}

}  // namespace

/// Only where the path continues and may also hit emitters, so a hit at the depth limit samples only the sky.
bool Shader::aims_at_emitter(const HitState& state) const {
  if (!options_.transport.is_by_paths() || !has_emitters(header_) || state.ray.depth > options_.depth_max ||
      is_at_last_depth(state)) {
    return false;
  }
  const bool is_needless = skips_.zero_terms && !scatters(state);
  operations_.skipped.zero_terms += is_needless ? 1 : 0;
  return !is_needless;
}

void Shader::begin_choice(HitState& state, std::uint32_t count, Stage choice, Stage next) const {
  const SamplePair place = pair_of(state.ray, Purpose::place);
  state.keep(count > 1 ? Choosing::of(place.x, pair_of(state.ray, Purpose::emitter).x).stored() : DrawnEmitter::at(0, place.x));
  state.stage = count > 1 ? choice : next;
}

void Shader::begin_emitter(HitState& state) const {
  begin_choice(state, header_.emitter_count, Stage::emitter_choice, Stage::emitter);
}

void Shader::read_choice(HitState& state, const std::byte* record, std::uint32_t count, Stage next) {
  Choosing at = state.choosing();
  const std::optional<DrawnEmitter> drawn = at.step(read<ChoiceNode>(record), count);
  state.keep(drawn ? *drawn : at.stored());
  state.stage = drawn ? next : state.stage;
}

bool Shader::read_emitter(HitState& state, const std::byte* record, Ray& child) const {
  const auto emitter = read<EmitterRecord>(record);
  const std::optional<LightSample> place =
      aim_at(emitter, state.point, {double{state.surface.place}, pair_of(state.ray, Purpose::place).y});
  end_emitters(state);
  if (!place) {
    return false;
  }
  const SurfaceResponse response = response_towards(state, place->towards);
  const bool is_lit = response.density > 0.0;
  const RayStart start = start_towards(place->towards, state.geometric_normal, state.clearance);
  child = child_ray(state, place->towards, start, RayKind::shadow);
  child.t_max = static_cast<float>(std::max(place->distance - start.along - gap_before(emitter, *place), 0.0));
  child.weight = {};
  if (is_lit) {
    const double aimed = light_sampling_density_at(emitter, *place, child, start.along, density_on(header_, emitter.radiance));
    const double share = options_.transport.only_aims ? 1.0 : way_share(aimed, density_of(density_bits(response.density)));
    child.weight = Color(Vec3d(state.ray.weight) * Vec3d(emitter.radiance) * response.value * (share / place->density));
  }
  return !leaves_out(is_lit, child.weight);
}

float Shader::mis_weight(const HitState& state, const Color& radiance) const {
  if (state.shading.material() < header_.drawn_materials || state.ray.density == 0) {
    return 1.0F;
  }
  if (options_.transport.only_aims) {
    return 0.0F;
  }
  return static_cast<float>(
      way_share(density_of(state.ray.density), bsdf_sampling_density_at(state, density_on(header_, radiance))));
}

}  // namespace dmpc::core
