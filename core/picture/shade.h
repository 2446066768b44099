// Shading of a hit: NFF's surface (diffuse, Phong highlight, mirror, transmission), and the extensions of mesh files (tinted
// highlights, emission, alpha), one child ray per step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/base/vec.h"
#include "core/picture/camera/camera.h"
#include "core/picture/film/film.h"
#include "core/picture/hits/hit_state.h"
#include "core/picture/lights/light_fall.h"
#include "core/picture/surfaces/layer.h"
#include "core/picture/surfaces/path_step.h"
#include "core/picture/surfaces/surface_response.h"
#include "core/picture/surfaces/transport.h"
#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/record/sky.h"
#include "core/scene/scene.h"
#include "core/trace/operations.h"
#include "core/trace/skips.h"

namespace dmpc::core {

/// Which shadow rays are cast. haines: one per light that the surface faces (SPD, rule 10). paper: one per light at every hit
/// (Badouel, Bouatouch & Priol 1994, derived from their ray counts).
enum class Convention : std::uint8_t { haines, paper };

struct ShadeOptions {
  Convention convention = Convention::haines;
  /// A hit from this depth on that could send both a mirrored and a refracted ray sends one of them at random, with the weight of
  /// both: the more often the larger its own weight is, so that the picture is right on average (Russian roulette: J. Arvo, D.
  /// Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990). The random number is a hash of the ray. 0: all hits send
  /// both.
  std::uint8_t one_child_from = 0;
  /// Hits at this depth spawn shadow rays only; the primary ray has depth 1. With paths it is the number of bounces plus 1, and a
  /// surface at this depth still shows the sky and emitters.
  int depth_max = 5;
  /// Whether a material of the scene may reflect or transmit rays.
  bool has_reflection_or_transmission = true;
  /// What hits show. A layer is rendered by Whitted's transport, and a ray goes on only where alpha leaves something out.
  Layer layer = Layer::light;
  /// The most that a deposit of indirect light has in any channel: more is scaled down. 0: no limit.
  float clamp = 0;
  /// A ray that can add only less light than this to its sample, in every channel, is not shot: this is the largest error of each
  /// omitted ray. 0: all are shot (after R. Hall, D. Greenberg, "A Testbed for Realistic Image Synthesis", 1983).
  double cutoff = 0;
  double radiance_bound = 0;  ///< radiance_bound() of the scene; used only with a cutoff
  /// The share of its pixel's sides that a ray represents in texture look-ups, if it were the pixel's only ray. 0: no texture
  /// needs it.
  double pixel_share = 0;
  std::uint32_t first_samples = 1;  ///< per pixel; more follow if the picture is refined
  FilmScale film_scale = {};        ///< film_scale_for() the scene
  Transport transport = {};
};

/// How many hits of a ray's path wait at once, while rays below them are traced. With paths one: it has sent its shadow rays when
/// it sends the path on, and does not wait for it.
/// 1, too, where no material reflects or transmits, unless rays of weight 0 are sent; and in layers, whose hits send one ray.
constexpr int waiting_hits_max(const ShadeOptions& options, const Skips& skips) {
  const bool sends_rays_on = options.has_reflection_or_transmission || !skips.zero_terms;
  const bool waits = sends_rays_on && !options.transport.is_by_paths() && options.layer == Layer::light;
  return waits ? options.depth_max : 1;
}
/// The depth of the deepest ray in a database's picture, at most 255: with paths one more than depth_max if a hit at depth_max
/// looks for emitters.
int ray_depth_max(const ShadeOptions& options, const DatabaseHeader& header, const Skips& skips);

/// The distance between a pixel's samples, in sides of the pixel, after the pass of this sample: passes double them. A sample
/// represents this share of its pixel, so the more samples there are, the less a texture is blurred in each.
double sample_spacing(std::uint32_t sample, std::uint32_t first_samples);

/// A bound of the radiance that any reflected or refracted ray in the scene finds, in any channel: each hit reflects at most the
/// share of all lights, and of the ambient one, that its material allows, plus its emission, and passes on at most its share of
/// what a ray of the next depth finds. With paths it also passes on what it scatters.
double radiance_bound(const Scene& scene, int depth_max, const Transport& transport = {});

/// Whether hits add light without a ray: reflected ambient light, or emission; or, for rays that hit nothing, a sky's picture.
inline bool hits_glow(const DatabaseHeader& header) {
  return header.has_emission != 0 || !(header.ambient == Color{}) || has_sky_picture(header);
}

/// Whether a ray that continues a path can find any light: from lights, from hits that glow, or from the background, which a
/// scattered ray sees if it is a sky. If it cannot, its children cannot either, since they are scattered if it is.
bool may_find_light(const DatabaseHeader& header, const Transport& transport, RayKind kind);

/// The sky's radiance that a ray that hits nothing finds (its record is `tile`), weighted against light sampling.
Color sky_met(const Ray& ray, const DatabaseHeader& header, const Transport& transport, const std::byte* tile);

/// Whether the light that ends the ray was sent on by more than one surface: what a hit's shadow rays bring to the eye is direct.
inline bool is_indirect(const Ray& ray) { return ray.depth + (ray.kind == RayKind::shadow ? 1 : 0) > 2; }
/// The ray's light, limited by the options.
inline Color clamped(const Ray& ray, const Color& light, const ShadeOptions& options) {
  if (!(options.clamp > 0) || !is_indirect(ray)) {
    return light;
  }
  const float most = brightest(light);
  return most > options.clamp ? light * (options.clamp / most) : light;
}

/// Shades hits, one record per step. The constructor's arguments outlive it.
class Shader {
 public:
  /// `camera` may be null if no texture needs a pixel's footprint.
  Shader(const DatabaseHeader& header, const ShadeOptions& options, const Skips& skips, Operations& operations,
         const Camera* camera = nullptr)
      : header_(header), options_(options), skips_(skips), operations_(operations), camera_(camera) {}

  /// One step. `record` is the record of record_needed() (nullptr if that was no_address). Returns whether `child` was set to a
  /// ray to be shot; the caller shoots it, or deposits its light if it has_arrived(), then goes on, until state.stage is
  /// finished. Before the stage `light` there are only rays that have arrived.
  bool step(HitState& state, const std::byte* record, Ray& child) const;
  /// Whether step() does for a hit's geometry exactly what read_geometry() does.
  bool reads_beside() const { return !(options_.pixel_share > 0); }
  /// Whether glow() may be nonzero.
  bool hits_glow() const { return core::hits_glow(header_); }
  /// The light that a hit with a known surface sends without a ray: its emission, and the ambient light that its diffuse part
  /// reflects.
  Color glow(const HitState& state) const;
  /// Continues a hit at a light with known illumination; `highlight`: lobe_cosine() to the power of its shine. As step(), except
  /// that the caller sets the child's start, direction and end.
  bool shine(HitState& state, const LightRecord& light, const LightFall& fall, double highlight, Ray& child) const;
  /// As shine(), for a hit that mirrors or transmits a ray.
  bool send(HitState& state, Ray& child) const;
  /// Continues a hit of a path after its lights: one more ray, or none.
  bool send_on(HitState& state, Ray& child) const;

 private:
  void read_geometry(HitState& state, const std::byte* record) const;
  void read_normals(HitState& state, const std::byte* record) const;
  void keep_normals(HitState& state, const PatchNormals& normals) const;
  void place_normals(HitState& state, const std::byte* instance) const;
  void blend_normals(HitState& state, const std::array<Vec3f, 3>& normals) const;
  void begin_texture(HitState& state, const TexturedNormals& textured) const;
  void begin_facets(HitState& state, const FacetedNormals& triangle) const;
  void turn_to_color(HitState& state, const std::byte* record) const;
  void step_texture(HitState& state, const std::byte* record) const;
  void read_corners(HitState& state, const TexturedNormals& corners) const;
  void read_material(HitState& state, const std::byte* record) const;
  void read_extension(HitState& state, const std::byte* record) const;
  void read_microfacets(HitState& state, const std::byte* record) const;
  void come_to_lights(HitState& state, const Color& emission) const;
  bool shows_layer(HitState& state, float metallic, std::optional<std::uint16_t> cutoff = std::nullopt) const;
  /// Whether `child` was set.
  bool read_light(HitState& state, const std::byte* record, Ray& child) const;
  // In core/picture/lights/shade_emitters.cpp:
  bool aims_at_emitter(const HitState& state) const;
  /// Selects one of `count`: at the stage `choice`, or, if there is nothing to choose, at once.
  void begin_choice(HitState& state, std::uint32_t count, HitState::Stage choice, HitState::Stage next) const;
  void begin_emitter(HitState& state) const;
  /// One step down a tree of `count` choices; `next`: the stage after the last.
  static void read_choice(HitState& state, const std::byte* record, std::uint32_t count, HitState::Stage next);
  bool read_emitter(HitState& state, const std::byte* record, Ray& child) const;
  /// The weight of emission that the state's ray has hit: the rest is added by light sampling at the previous hit.
  float mis_weight(const HitState& state, const Color& radiance) const;
  // In core/picture/lights/shade_sky.cpp:
  void read_sky(HitState& state, const std::byte* record) const;
  bool aims_at_sky(const HitState& state) const;
  bool read_sky_aim(HitState& state, const std::byte* record, Ray& child) const;
  void end_emitters(HitState& state) const;

  bool send_alone(HitState& state, Ray& child) const;
  bool is_for_nothing(RayKind kind) const;
  bool look_at_sky(const HitState& state, const PathStep& step, Ray& child) const;
  Ray continued_ray(const HitState& state, const Vec3d& towards, RayKind kind, const Color& weight) const;

  bool reflects(const HitState& state) const;
  bool refracts(const HitState& state) const;
  bool sends_one(const HitState& state) const;
  void end_point_lights(HitState& state) const;
  HitState::Stage after_lights(const HitState& state) const;
  HitState::Stage after_reflection(const HitState& state) const;
  HitState::Stage after_lights_of_path(const HitState& state) const;
  bool is_at_last_depth(const HitState& state) const;
  std::uint32_t light_count(const HitState& state) const;
  void judge_refraction(HitState& state) const;
  void judge_children(HitState& state) const;
  bool leaves_out(bool is_lit, const Color& weight) const;
  bool is_worth_it(const Ray& child) const;
  double width_at_hit(const HitState& state) const;
  void widen(const HitState& state, Ray& child) const;

  const DatabaseHeader& header_;
  const ShadeOptions& options_;
  const Skips& skips_;
  Operations& operations_;
  const Camera* camera_;
};

}  // namespace dmpc::core
