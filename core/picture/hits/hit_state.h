// A hit being shaded: what of it is known, and what comes next.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "core/base/vec.h"
#include "core/picture/surfaces/texture_footprint.h"
#include "core/picture/surfaces/texture_lookup.h"
#include "core/record/hit.h"
#include "core/record/instance.h"
#include "core/record/ray.h"
#include "core/record/record.h"
#include "core/record/record_kind.h"

namespace dmpc::core {

/// How far from a hit's point rays start, grid-local.
struct Clearance {
  double along = 0;   ///< the way of a ray that leaves the surface at a right angle; others more
  double across = 0;  ///< of the surface, for rays that graze it
  double radius = 0;  ///< of what is curved, which a ray within must not pass: no limit for what is flat

  static constexpr Clearance of_flat(double way) { return {way, way, std::numeric_limits<double>::max()}; }
};

/// A hit being shaded: a record on the ray stack, resumable between any two of its records. Each step reads exactly one record.
struct HitState {
  enum class Stage : std::uint8_t {
    instance,  ///< of a triangle of a base mesh: where that stands
    geometry,
    normals,
    placed_normals,  ///< of a base mesh: where it stands, once more
    texture,
    color_texture,  ///< of a surface whose texture of metal and roughness has been looked up: its normals' record once more
    material,
    textured_material,  ///< whose colour is multiplied by what the look-up, or its corners, gave
    finish,             ///< what the material has beyond NFF
    sky,                ///< of a ray that has met nothing: what is there of the sky's picture
    light,
    emitter_choice,  ///< by paths: which emitter is drawn
    emitter,
    sky_choice,  ///< by paths: which tile of the sky's picture is drawn
    sky_aim,     ///< and where in it
    reflected,
    refracted,
    continued,  ///< by paths: one ray more, or none
    finished
  };

  /// What lights fall on.
  struct Surface {
    MaterialRecord material;
    std::uint32_t next_light = 0;  ///< behind the lights: the choice of an emitter or of a tile of the sky, or that
    float place = 0;               ///< on that, the first of two numbers: DrawnEmitter::place
  };

  /// What makes highlight and mirror of the material's `specular`, which is their brightest channel.
  struct Gloss {
    Color tint{1, 1, 1};  ///< 1 in the brightest channel
    float mirror = 1;     ///< the share of them that mirrors
  };

  /// What a surface of microfacets has in place of highlight and mirror.
  struct Microfacets {
    float metallic = 0, alpha = 1, reflectance = 0;
    float there = 1;  ///< the share of the surface that is
  };

  /// What a texture of metal and roughness multiplies those of the material by.
  struct FacetShares {
    float metallic = 1, roughness = 1;
  };

  /// What a base mesh's normals say, until it is known what its place does to them: in the room of the shading normal, which
  /// they lead to, and behind the ellipse.
  struct MeshNormals {
    CutEllipse ellipse;
    Vec3f third;
  };

  HitState() : surface() {}

  /// Where the mesh stands whose triangle was hit, until point, normals and clearance are known: in their room.
  void set_place(const InstanceRecord& instance) {
    const auto& world = instance.world;
    point = {world[0], world[1], world[2]};
    geometric_normal = {world[3], world[4], world[5]};
    normal = {world[6], world[7], world[8]};
    clearance = {world[9], world[10], world[11]};
    u = double{instance.unit};
  }
  /// That, but for what shading does not ask.
  InstanceRecord place() const {
    InstanceRecord instance;
    instance.world = {point.x,  point.y,  point.z,  geometric_normal.x, geometric_normal.y, geometric_normal.z,
                      normal.x, normal.y, normal.z, clearance.along,    clearance.across,   clearance.radius};
    instance.unit = static_cast<float>(u);
    return instance;
  }

  /// Once the material has been read: in the room of the weights, which nobody asks for any more.
  Gloss gloss() const { return std::bit_cast<Gloss>(std::array{u, v}); }
  void set_gloss(const Gloss& gloss) {
    const auto bits = std::bit_cast<std::array<double, 2>>(gloss);
    u = bits[0];
    v = bits[1];
  }
  bool has_microfacets() const { return surface.material.has_microfacets(); }
  /// If so, in the room of the gloss.
  Microfacets microfacets() const { return std::bit_cast<Microfacets>(std::array{u, v}); }
  void set_microfacets(const Microfacets& facets) {
    const auto bits = std::bit_cast<std::array<double, 2>>(facets);
    u = bits[0];
    v = bits[1];
  }
  /// How wide a probe of the colour's texture will be, in its texels, while that of metal and roughness is looked up: in the room
  /// of the ray's end.
  float color_width() const { return ray.t_max; }
  void set_color_width(double width) { ray.t_max = static_cast<float>(width); }
  /// Once that has been looked up, until the surface is known: there, and in the room of what says where the hit was found.
  FacetShares facet_shares() const { return {std::bit_cast<float>(hit.leaf), ray.t_max}; }
  void set_facet_shares(const FacetShares& shares) {
    hit.leaf = Address{std::bit_cast<std::uint32_t>(shares.metallic)};
    ray.t_max = shares.roughness;
  }
  /// The surface's own light as far as it is there, once all is known of the surface of a scene where hits glow: in the room of
  /// the ray's end and of what says where the hit was found.
  Color emission() const { return {ray.t_max, std::bit_cast<float>(hit.leaf), coverage()}; }
  void set_emission(const Color& light) {
    ray.t_max = light.x;
    hit.leaf = Address{std::bit_cast<std::uint32_t>(light.y)};
    set_coverage(light.z);
  }
  /// What of the surface is there by the alpha of a texture or of its corners, 0 to 1, once they have been read: in the room of
  /// the lane, since the leaf has been.
  float coverage() const { return std::bit_cast<float>(hit.lane); }
  void set_coverage(float coverage) { hit.lane = std::bit_cast<std::uint32_t>(coverage); }

  Ray ray;  ///< the ray that hit
  Hit hit;
  Vec3d point;             ///< on the primitive
  Vec3d geometric_normal;  ///< true normal, unit length
  Vec3d normal;            ///< shading normal on the ray's side, unit length
  Clearance clearance;
  double u = 0, v = 0;  ///< barycentric weights of vertices 1 and 2 (triangles); the place on the texture, once it is known
  union {
    Surface surface;       ///< once its material has been read
    TextureLookup lookup;  ///< before that, if there is a texture
    CutEllipse ellipse;    ///< before that, where there may be one
    MeshNormals of_mesh;   ///< begins with the same
  };
  ShadingReference shading;
  bool curved = false;              ///< a ray from here may meet the same primitive again
  bool leaving = false;             ///< the ray goes along the true normal: out of the body
  bool has_refraction : 1 = false;  ///< Snell's law has an answer: known if this hit may have children
  bool is_in_mirror : 1 = false;    ///< of a base mesh: its corners come the other way round
  bool has_normals : 1 = false;     ///< of a base mesh, placed
  Stage stage = Stage::geometry;

  /// Its material has been read.
  bool has_surface() const { return stage >= Stage::light; }
  /// It sends nothing more.
  bool is_finished() const { return stage == Stage::finished; }
};
static_assert(sizeof(HitState) == 256 && std::is_trivially_copyable_v<HitState>);

/// The index of refraction of what the ray comes from over that of what lies behind; needs the material.
inline double relative_index(const HitState& state) {
  const float index = state.surface.material.refraction_index;
  const double inside = index > 0.0F ? double{index} : 1.0;
  return state.leaving ? inside : 1.0 / inside;
}

/// Makes `state` that of a fresh hit. What nothing asks for before it is set stays as it was.
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

/// Of a ray that has met nothing below a sky's picture, which it shows as a surface would that shines.
HitState begin_sky(const Ray& ray);
/// The record that this reads.
Address sky_record(const Ray& ray, const DatabaseHeader& header);

/// How many of the first `count` hits of a stack, each a HitState or a bundle of them, stay: the newest leave it as far as they
/// wait for nothing more, so that what they sent last may have their place.
template <class Hits>
constexpr std::uint32_t waiting_count(std::span<Hits> stack, std::uint32_t count) {
  while (count > 0 && stack[count - 1].is_finished()) {
    --count;
  }
  return count;
}

/// What the next step reads, if that is neither material nor light nor a table of tiles.
RecordKind record_kind_of(const HitState& state);

/// The record that the next step reads, or no_address if it reads none.
Address record_needed(const HitState& state, const DatabaseHeader& header);

}  // namespace dmpc::core
