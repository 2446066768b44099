// What a hit does: NFF's surface (diffuse, Phong highlight, mirror, transmission), and what mesh files have beside (tinted
// highlights, emission, alpha), one child ray a step.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/base/vec.h"
#include "core/picture/camera/camera.h"
#include "core/picture/film/film.h"
#include "core/picture/hits/hit_state.h"
#include "core/picture/lights/light_fall.h"
#include "core/picture/surfaces/path_step.h"
#include "core/picture/surfaces/transport.h"
#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/record/sky.h"
#include "core/scene/scene.h"
#include "core/trace/operations.h"
#include "core/trace/skips.h"

namespace dmpc::core {

/// Which shadow rays are cast. haines: one a light that the surface faces (SPD, rule 10). paper: one a light at every hit
/// (Badouel, Bouatouch & Priol 1994, as recovered from their ray counts).
enum class Convention : std::uint8_t { haines, paper };

struct ShadeOptions {
  Convention convention = Convention::haines;
  /// A hit from this depth on that could send both a mirrored and a refracted ray sends one of them, by chance, which counts for
  /// both: the more often the more the ray counts for by itself, so that the picture is right on average (Russian roulette: J.
  /// Arvo, D. Kirk, "Particle Transport and Image Synthesis", SIGGRAPH 1990). The chance is a hash of the ray. 0: all hits send
  /// both.
  std::uint8_t one_child_from = 0;
  /// Hits at this depth spawn shadow rays only; the primary ray has depth 1. By paths it is the bounces and 1, and a surface at
  /// this depth still shows the sky, and what shines by itself.
  int depth_max = 5;
  /// A ray that can bring but less light than this to its sample, in every channel, is not shot: each one cut adds less to the
  /// sample's error. 0: none is cut (after R. Hall, D. Greenberg, "A Testbed for Realistic Image Synthesis", 1983).
  double cutoff = 0;
  double radiance_bound = 0;  ///< radiance_bound() of the scene; read only if there is a cutoff
  /// How much of its pixel's sides a ray stands for where it looks at a texture, if the pixel had only this one. 0: no texture
  /// asks for it.
  double pixel_share = 0;
  std::uint32_t first_samples = 1;  ///< of every pixel; more follow if it is refined
  FilmScale film_scale = {};        ///< film_scale_for() the scene: of what rays deposit
  Transport transport = {};
};

/// How many hits of a ray's path wait at once, while rays below them are traced. By paths one: it has sent its shadow rays when
/// it sends the path on, and does not wait for that.
constexpr int waiting_hits_max(const ShadeOptions& options) { return options.transport.is_by_paths() ? 1 : options.depth_max; }
/// The depth of the deepest ray in a database's picture, at most 255: of paths one more where a hit at depth_max looks for what
/// shines by itself.
int ray_depth_max(const ShadeOptions& options, const DatabaseHeader& header);

/// How far a pixel's samples lie from each other, in sides of the pixel, when those of the pass that this one belongs to have
/// been taken: passes double them. It is so much of its pixel that a sample stands for, so the more samples there
/// are, the less a texture is blurred before they see it.
double sample_spacing(std::uint32_t sample, std::uint32_t first_samples);

/// No reflected or refracted ray in the scene finds more light than this, in any channel: each hit reflects at most the share of
/// all lights, and of the ambient one, that its material allows, beside what that emits, and passes on at most its share of what
/// a ray of the next depth finds. By paths it passes on what it scatters, too.
double radiance_bound(const Scene& scene, int depth_max, const Transport& transport = {});

/// Whether hits send light by themselves, without a ray: what they reflect of an ambient light, or their own; or what rays that
/// met nothing do in their place, of a sky's picture.
inline bool hits_glow(const DatabaseHeader& header) {
  return header.has_emission != 0 || !(header.ambient == Color{}) || has_sky_picture(header);
}

/// Whether a ray that a path goes on with can find any light: of what lights show, of what hits send by themselves, or of what
/// lies beyond the scene, which a scattered ray sees if that is a sky. Where it cannot, its children cannot either, since they
/// are scattered if it is.
bool may_find_light(const DatabaseHeader& header, const Transport& transport, RayKind kind);

/// What a ray that has met nothing finds of a sky's picture, whose record of its direction `tile` is: what hits that aim there
/// leave of it.
Color sky_met(const Ray& ray, const DatabaseHeader& header, const Transport& transport, const std::byte* tile);

/// Shades hits, one record a step. What it is made from outlives it.
class Shader {
 public:
  /// `camera` may be null where no texture asks what a pixel covers.
  Shader(const DatabaseHeader& header, const ShadeOptions& options, const Skips& skips, Operations& operations,
         const Camera* camera = nullptr)
      : header_(header), options_(options), skips_(skips), operations_(operations), camera_(camera) {}

  /// One step. `record` is the record of record_needed() (nullptr if that was no_address). Returns whether `child` was set to a
  /// ray to be shot; the caller shoots it, or deposits its light if it has_arrived(), then goes on, until state.stage is
  /// finished. Before the stage `light` none but such a ray comes.
  bool step(HitState& state, const std::byte* record, Ray& child) const;
  /// Whether step() does to a hit's geometry what read_geometry() does, and no more.
  bool reads_beside() const { return !(options_.pixel_share > 0); }
  /// Whether glow() may tell of light.
  bool hits_glow() const { return core::hits_glow(header_); }
  /// What a hit whose surface is known sends on by itself: its own light, and of the ambient one what its diffuse part
  /// reflects.
  Color glow(const HitState& state) const;
  /// Goes on with a hit at a light that is known to fall on it so; `highlight`: lobe_cosine() to the power of its shine. As of
  /// step(), but for where the child starts, goes and ends, which is the caller's to set.
  bool shine(HitState& state, const LightRecord& light, const LightFall& fall, double highlight, Ray& child) const;
  /// The same of a hit that mirrors or lets through a ray.
  bool send(HitState& state, Ray& child) const;
  /// Goes on with a hit of a path that has seen to its lights: one ray more, or none.
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
  /// Whether `child` was set.
  bool read_light(HitState& state, const std::byte* record, Ray& child) const;
  // In core/picture/lights/shade_emitters.cpp:
  bool aims_at_emitter(const HitState& state) const;
  void begin_choice(HitState& state, std::uint32_t count) const;
  static void draw(HitState& state, const std::byte* choice);
  void begin_emitter(HitState& state) const;
  void read_choice(HitState& state, const std::byte* record) const;
  bool read_emitter(HitState& state, const std::byte* record, Ray& child) const;
  /// Of what a surface shines with that the state's ray has met: the rest comes to the hit before by aiming at it.
  float mis_weight(const HitState& state, const Color& radiance) const;
  // In core/picture/lights/shade_sky.cpp:
  void read_sky(HitState& state, const std::byte* record) const;
  bool aims_at_sky(const HitState& state) const;
  void read_sky_choice(HitState& state, const std::byte* record) const;
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
