// Shading for a plain renderer of packets: 16 rays side by side, in the vectors that the processor has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/base/vec.h"
#include "core/record/record.h"

namespace dmpc::apps {

inline constexpr std::size_t packet_rays = 16;

/// A number of each ray.
template <class T>
struct alignas(64) PacketRow : std::array<T, packet_rays> {};
using FloatRow = PacketRow<float>;
using IntRow = PacketRow<std::int32_t>;  ///< where it says who is meant: -1, others 0
struct VectorRow {
  FloatRow x, y, z;
};

/// What shading asks of a material, by its place in a table of rows of 16: linear colours are three numbers.
enum MaterialField : std::size_t {
  diffuse_field = 0,  ///< times the surface's colour
  highlight_field = 3,
  mirrored_field = 6,  ///< the share of what comes by reflection
  own_field = 9,       ///< what it sends by itself, with what it reflects of an ambient light
  shine_field = 12,
  transmittance_field = 13,
  index_field = 14,   ///< of refraction, of the inside
  glossy_field = 15,  ///< above 0 if it has highlights
  material_fields = 16
};

/// A triangle's row in its table: its three vertex normals, all 0 if it is flat, then the bits of its material's number.
inline constexpr std::size_t triangle_fields = 10;

/// Rays that come from hits, in rows that grow; behind the last there is room for a packet.
struct RayQueue {
  std::array<std::vector<float>, 9> row;  ///< of origins, directions, weights
  std::vector<std::int32_t> pixel;
  std::size_t count = 0;

  void clear() { count = 0; }
  /// Makes room for so many more, and a packet.
  void reserve_more(std::size_t more);
  /// Sets numbers to 0 from behind the last ray to `end`, at most a packet behind it: Embree looks at those of lanes that do not
  /// ask, too.
  void close(std::size_t end);
};

/// A packet's rays, and what they have hit.
struct PacketHits {
  IntRow active, pixel;
  VectorRow origin, direction, weight;
  FloatRow t, u, v;
  IntRow triangle;                            ///< as Embree numbers them; 0 where there is none
  VectorRow point, geometric_normal, normal;  ///< the normals of unit length, the latter on the ray's side
  IntRow leaving, material;
  std::array<FloatRow, material_fields> surface;
  VectorRow light;  ///< what has been found
};

/// Of a light: what it brings to each ray's hit, from where a shadow ray starts, and how far it goes.
struct PacketLight {
  IntRow asked;
  VectorRow start, way, brought;
};

/// The functions, made for the best instruction set of this processor. Those of active rays alone tell.
struct PacketShading {
  /// `ng`, of any length, is Embree's. Sets point, normals, leaving and material of what has hit a triangle of the table.
  void (*find_surfaces)(PacketHits& hits, const VectorRow& ng, const float* triangles);
  /// Sets surface, and light to what surfaces send by themselves.
  void (*find_materials)(PacketHits& hits, const float* materials);
  /// Returns whether anybody asks.
  bool (*meet_light)(const PacketHits& hits, const core::LightRecord& light, PacketLight& met);
  /// Adds what came: `end` is below 0 where something was between.
  void (*add_light)(PacketHits& hits, const PacketLight& met, const float* end);
  /// Appends what is reflected and what is refracted to queues, which have room.
  void (*send)(const PacketHits& hits, RayQueue& reflected, RayQueue& refracted);
};
const PacketShading& packet_shading();

}  // namespace dmpc::apps
