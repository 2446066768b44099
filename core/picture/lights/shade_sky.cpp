// Path tracing with a sky picture: a hit sends a shadow ray to a point of it (light sampling), and a ray that leaves the scene
// adds the rest (BSDF sampling). Both are weighted by the other method's density, as with emitters.
#include "core/picture/hits/ray_start.h"
#include "core/picture/lights/emitter_light.h"
#include "core/picture/shade.h"
#include "core/picture/surfaces/surface_response.h"
#include "core/scene/sky_cells.h"

namespace dmpc::core {
namespace {

using Stage = HitState::Stage;

/// The weight of the sky's light for a ray scattered by a surface (BSDF sampling).
double mis_weight(const Ray& ray, const SkyLight& light, const Transport& transport) {
  return ray.density == 0       ? 1.0
         : transport.only_aims  ? 0.0
         : transport.never_aims ? 1.0
                                : way_share(density_of(ray.density), light.density);
}

}  // namespace

Color sky_met(const Ray& ray, const DatabaseHeader& header, const Transport& transport, const std::byte* tile) {
  const SkyLight light = sky_light(header.sky, tile, sky_place(header.sky, ray.full_direction()));
  return light.radiance * static_cast<float>(mis_weight(ray, light, transport));
}

void Shader::read_sky(HitState& state, const std::byte* record) const {
  ++operations_.tile_reads;
  state.surface = {};
  state.set_emission(sky_met(state.ray, header_, options_.transport, record));
  state.stage = Stage::finished;
}

/// As with emitters: only where the path continues and may also reach the sky.
bool Shader::aims_at_sky(const HitState& state) const {
  if (!options_.transport.is_by_paths() || !has_sky_picture(header_) || options_.transport.never_aims ||
      state.ray.depth > options_.depth_max || is_at_last_depth(state)) {
    return false;
  }
  const bool is_needless = skips_.zero_terms && !scatters(state);
  operations_.skipped.zero_terms += is_needless ? 1 : 0;
  return !is_needless;
}

/// Goes on to the sky tile that is sampled, if there is one, else to the stage after all lights.
void Shader::end_emitters(HitState& state) const {
  if (aims_at_sky(state)) {
    begin_choice(state, sky_tile_count(header_.sky), Stage::sky_choice, Stage::sky_aim);
  } else {
    state.stage = after_lights(state);
  }
}

bool Shader::read_sky_aim(HitState& state, const std::byte* record, Ray& child) const {
  ++operations_.tile_reads;
  state.stage = after_lights(state);
  const SkyCells::Drawn drawn = SkyCells(header_.sky, state.surface.next_light, record)
                                    .draw(double{state.surface.place}, pair_of(state.ray, Purpose::place).y);
  const SkyLight light = sky_light(header_.sky, record, drawn.place);
  const SurfaceResponse response = response_towards(state, drawn.towards);
  const bool is_lit = response.density > 0.0;
  child = child_ray(state, drawn.towards, start_towards(drawn.towards, state.geometric_normal, state.clearance), RayKind::shadow);
  child.weight = {};
  if (is_lit) {
    const double share =
        options_.transport.only_aims ? 1.0 : way_share(light.density, density_of(density_bits(response.density)));
    child.weight = Color(Vec3d(state.ray.weight) * Vec3d(light.radiance) * response.value * (share / light.density));
  }
  return !leaves_out(is_lit, child.weight);
}

}  // namespace dmpc::core
