// A hit that is being shaded: what is known of it, and what comes next.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "core/base/vec.h"
#include "core/picture/lights/choosing.h"
#include "core/picture/surfaces/texture_footprint.h"
#include "core/picture/surfaces/texture_lookup.h"
#include "core/record/hit.h"
#include "core/record/instance.h"
#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/record/record_kind.h"

namespace dmpc::core {

/// The distance from a hit's point at which rays start, grid-local.
struct Clearance {
  double along = 0;   ///< distance along a ray that leaves the surface at a right angle; others start farther
  double across = 0;  ///< distance across the surface, for grazing rays
  double radius = 0;  ///< radius of a curved surface, which a ray within must not pass; unlimited if flat

  static constexpr Clearance of_flat(double way) { return {way, way, std::numeric_limits<double>::max()}; }
};

/// A hit that is being shaded: an entry of the ray stack, resumable between any two of its records. Each step reads one record.
struct HitState {
  enum class Stage : std::uint8_t {
    instance,  ///< for a triangle of a base mesh: its instance
    geometry,
    normals,
    placed_normals,  ///< for a base mesh: its instance, once more
    texture,
    color_texture,  ///< once the texture of metal and roughness has been looked up: the normals' record once more
    material,
    textured_material,  ///< with a colour that is multiplied by that of the look-up or the corners
    finish,             ///< the material's extension of NFF
    sky,                ///< for a ray that has hit nothing: the sky's picture there
    light,
    emitter_choice,  ///< paths: which emitter is sampled
    emitter,
    sky_choice,  ///< paths: which tile of the sky's picture is sampled
    sky_aim,     ///< and the place in it
    reflected,
    refracted,
    continued,  ///< paths: one more ray, or none
    finished
  };

  /// The surface that lights illuminate.
  struct Surface {
    MaterialRecord material;
    std::uint32_t next_light = 0;  ///< after the lights: DrawnEmitter::index, of an emitter or of a tile of the sky
    float place = 0;               ///< DrawnEmitter::place; while they are selected, both are a Choosing
  };

  /// Factors of highlight and mirror, relative to the material's `specular`, which is their brightest channel.
  struct Gloss {
    Color tint{1, 1, 1};  ///< 1 in the brightest channel
    float mirror = 1;     ///< the share that mirrors
  };

  /// What a microfacet surface has in place of highlight and mirror.
  struct Microfacets {
    float metallic = 0, alpha = 1, reflectance = 0;
    float there = 1;  ///< coverage of the surface
  };

  /// Factors for the material's metal and roughness, from their texture.
  struct FacetShares {
    float metallic = 1, roughness = 1;
  };

  /// Normals of a base mesh, until they are transformed by its instance: stored in place of the shading normal, which follows
  /// from them, and after the ellipse.
  struct MeshNormals {
    CutEllipse ellipse;
    Vec3f third;
  };

  HitState() : surface() {}

  Choosing choosing() const { return Choosing::from({surface.next_light, surface.place}); }
  void keep(const DrawnEmitter& drawn) {
    surface.next_light = drawn.index;
    surface.place = drawn.place;
  }

  /// The instance of the mesh whose triangle was hit, until point, normals and clearance are known: stored in their place.
  void set_place(const InstanceRecord& instance) {
    const auto& world = instance.world;
    point = {world[0], world[1], world[2]};
    geometric_normal = {world[3], world[4], world[5]};
    normal = {world[6], world[7], world[8]};
    clearance = {world[9], world[10], world[11]};
    u = double{instance.unit};
  }
  /// The instance, without what shading does not need.
  InstanceRecord place() const {
    InstanceRecord instance;
    instance.world = {point.x,  point.y,  point.z,  geometric_normal.x, geometric_normal.y, geometric_normal.z,
                      normal.x, normal.y, normal.z, clearance.along,    clearance.across,   clearance.radius};
    instance.unit = static_cast<float>(u);
    return instance;
  }

  /// After the material has been read: stored in place of the weights, which are no longer needed.
  Gloss gloss() const { return std::bit_cast<Gloss>(std::array{u, v}); }
  void set_gloss(const Gloss& gloss) {
    const auto bits = std::bit_cast<std::array<double, 2>>(gloss);
    u = bits[0];
    v = bits[1];
  }
  bool has_microfacets() const { return surface.material.has_microfacets(); }
  /// For microfacets: stored in place of the gloss.
  Microfacets microfacets() const { return std::bit_cast<Microfacets>(std::array{u, v}); }
  void set_microfacets(const Microfacets& facets) {
    const auto bits = std::bit_cast<std::array<double, 2>>(facets);
    u = bits[0];
    v = bits[1];
  }
  /// The width of a probe in texels of the colour's texture, while that of metal and roughness is looked up: stored in place of
  /// the ray's end.
  float color_width() const { return ray.t_max; }
  void set_color_width(double width) { ray.t_max = static_cast<float>(width); }
  /// After that look-up, until the surface is known: stored there, and in place of the hit's address.
  FacetShares facet_shares() const { return {std::bit_cast<float>(hit.leaf), ray.t_max}; }
  void set_facet_shares(const FacetShares& shares) {
    hit.leaf = Address{std::bit_cast<std::uint32_t>(shares.metallic)};
    ray.t_max = shares.roughness;
  }
  /// The surface's own light, times its coverage, once everything is known of a surface of a scene where hits glow: stored in
  /// place of the ray's end and of the hit's address.
  Color emission() const { return {ray.t_max, std::bit_cast<float>(hit.leaf), coverage()}; }
  void set_emission(const Color& light) {
    ray.t_max = light.x;
    hit.leaf = Address{std::bit_cast<std::uint32_t>(light.y)};
    set_coverage(light.z);
  }
  /// Coverage of the surface by the alpha of a texture or of its corners, 0 to 1, once they have been read: stored in place of
  /// the lane, since the leaf has been read.
  float coverage() const { return std::bit_cast<float>(hit.lane); }
  void set_coverage(float coverage) { hit.lane = std::bit_cast<std::uint32_t>(coverage); }

  Ray ray;  ///< the ray that hit
  Hit hit;
  Vec3d point;             ///< on the primitive
  Vec3d geometric_normal;  ///< true normal, unit length
  Vec3d normal;            ///< shading normal on the ray's side, unit length
  Clearance clearance;
  double u = 0, v = 0;  ///< barycentric weights of vertices 1 and 2 (triangles); later the place on the texture
  union {
    Surface surface;       ///< once its material has been read
    TextureLookup lookup;  ///< before that, if there is a texture
    CutEllipse ellipse;    ///< before that, where there may be one
    MeshNormals of_mesh;   ///< begins with the ellipse
  };
  ShadingReference shading;
  bool curved = false;              ///< a ray from here may hit the same primitive again
  bool leaving = false;             ///< the ray goes along the true normal: out of the body
  bool has_refraction : 1 = false;  ///< Snell's law has a solution: set if this hit may have children
  bool is_in_mirror : 1 = false;    ///< for a base mesh: its instance mirrors it, so corners are in reverse order
  bool has_normals : 1 = false;     ///< for a placed base mesh
  Stage stage = Stage::geometry;

  /// Whether its material has been read.
  bool has_surface() const { return stage >= Stage::light; }
  /// Whether it sends no more rays.
  bool is_finished() const { return stage == Stage::finished; }
};
static_assert(sizeof(HitState) == 256 && std::is_trivially_copyable_v<HitState>);

/// The index of refraction on the ray's side over that behind the surface; needs the material.
inline double relative_index(const HitState& state) {
  const float index = state.surface.material.refraction_index;
  const double inside = index > 0.0F ? double{index} : 1.0;
  return state.leaving ? inside : 1.0 / inside;
}

/// Makes `state` that of a fresh hit. What is not needed before it is set keeps its value.
inline void begin_shading(HitState& state, const Ray& ray, const Hit& hit) {
  state.ray = ray;
  state.hit = hit;
  state.u = state.v = 0;
  state.curved = state.leaving = state.has_refraction = state.is_in_mirror = state.has_normals = false;
  state.stage = is_in_instance(hit) ? HitState::Stage::instance : HitState::Stage::geometry;
}
/// The state of a fresh hit.
inline HitState begin_shading(const Ray& ray, const Hit& hit) {
  HitState state;
  begin_shading(state, ray, hit);
  return state;
}

/// The state of a ray that hits nothing, with a sky's picture, which it shows like an emitter's surface.
HitState begin_sky(const Ray& ray);
/// The record that such a state reads.
Address sky_record(const Ray& ray, const DatabaseHeader& header);

/// How many of the first `count` hits of a stack, each a HitState or a bundle of them, stay: the newest are removed as far as
/// they wait for nothing more, so that the rays that they sent last may have their slots.
template <class Hits>
constexpr std::uint32_t waiting_count(std::span<Hits> stack, std::uint32_t count) {
  while (count > 0 && stack[count - 1].is_finished()) {
    --count;
  }
  return count;
}

/// What the next step reads, if that is not a material, a light or a table of tiles.
RecordKind record_kind_of(const HitState& state);

/// The record that the next step reads, or no_address if it reads none.
Address record_needed(const HitState& state, const DatabaseHeader& header);

}  // namespace dmpc::core
