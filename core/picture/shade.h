// What a hit does: NFF's surface (diffuse, Phong highlight, mirror, transmission), one child ray a step.
#pragma once

#include <cstdint>
#include <type_traits>

#include "core/base/vec.h"
#include "core/picture/texture_lookup.h"
#include "core/record/hit.h"
#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/scene/scene.h"
#include "core/trace/operations.h"
#include "core/trace/skips.h"

namespace dmpc::core {

/// Which shadow rays are cast. haines: one a light that the surface faces (SPD, rule 10). paper: one a light at every hit
/// (Badouel, Bouatouch & Priol 1994, as recovered from their ray counts).
enum class Convention : std::uint8_t { haines, paper };

struct ShadeOptions {
  Convention convention = Convention::haines;
  int depth_max = 5;  ///< hits at this depth spawn shadow rays only; the primary ray has depth 1
  /// A ray that can bring but less light than this to its sample, in every channel, is not shot: each one cut adds less to the
  /// sample's error. 0: none is cut (after R. Hall, D. Greenberg, "A Testbed for Realistic Image Synthesis", 1983).
  double cutoff = 0;
  double radiance_bound = 0;  ///< radiance_bound() of the scene; read only if there is a cutoff
  /// Between the rays of neighbouring pixels, in radians: how fast the cones of rays widen. 0: no texture asks for them.
  double pixel_angle = 0;
};

/// No reflected or refracted ray in the scene finds more light than this, in any channel: each hit reflects at most the share of
/// all lights that its material allows, and passes on at most its share of what a ray of the next depth finds.
double radiance_bound(const Scene& scene, int depth_max);

/// A hit being shaded: a record on the ray stack, resumable between any two of its records. Each step reads exactly one record.
struct HitState {
  enum class Stage : std::uint8_t {
    geometry,
    normals,
    texture,
    material,
    textured_material,  ///< whose colour is multiplied by what the look-up gave
    light,
    reflected,
    refracted,
    finished
  };

  HitState() : material() {}

  Ray ray;  ///< the ray that hit
  Hit hit;
  Vec3d point;             ///< on the primitive
  Vec3d geometric_normal;  ///< true normal, unit length
  Vec3d normal;            ///< shading normal on the ray's side, unit length
  double u = 0, v = 0;     ///< barycentric weights of vertices 1 and 2 (triangles); the place on the texture, once it is known
  union {
    MaterialRecord material;  ///< once it has been read
    TextureLookup lookup;     ///< before that, if there is a texture
  };
  ShadingReference shading;
  std::uint32_t next_light = 0;
  bool curved = false;          ///< a ray from here may meet the same primitive again
  bool leaving = false;         ///< the ray goes along the true normal: out of the body
  bool has_refraction = false;  ///< Snell's law has an answer: known if this hit may have children
  Stage stage = Stage::geometry;
};
static_assert(std::is_trivially_copyable_v<HitState>);

/// The state of a fresh hit.
HitState begin_shading(const Ray& ray, const Hit& hit);

/// The record that the next step reads, or no_address if it reads none.
Address record_needed(const HitState& state, const DatabaseHeader& header);

/// One step. `record` is the record of record_needed() (nullptr if that was no_address). Returns whether `child` was set to a ray
/// to be shot; the caller shoots it, then goes on, until state.stage is finished.
bool shade_step(HitState& state, const std::byte* record, const DatabaseHeader& header, const ShadeOptions& options,
                const Skips& skips, Ray& child, Operations& operations);

}  // namespace dmpc::core
