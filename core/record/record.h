// Addresses and fixed layouts of the database's records: position-independent, little-endian, no pointers.
//
// The database is an array of bytes cut into pages. A record lies wholly in one page, is at most record_bytes_max long and
// starts at a multiple of record_alignment, so that a 32-bit address spans 32 GiB and page = address / (page_size / 8).
//
//   directory   one DirectoryEntry a macro cell of the grid
//   references  of a plain grid, whose macro cells are voxels: VoxelReference, the list of each voxel in one piece
//   instances   InstanceRecord (core/record/instance.h), where meshes are kept once, behind the topmost BVH nodes of all trees
//   BVH nodes      BVH node, the primitive leaves that it names, and its BVH nodes in turn (macro cells in Morton order)
//   normals     PatchNormals, TexturedNormals, FacetedNormals } shading data, read for final hits only
//   materials   MaterialRecord, then MaterialExtensionRecord     }
//   lights      LightRecord                           }
//   emitters    EmitterRecord, then EmitterChoice     } (core/record/emitter.h) for light sampling
//   textures    tables of addresses, and every TextureTile that they name: read where a final hit is textured
//   sky         of a picture: EmitterChoice with the tables, TextureTile behind all (core/record/sky.h)
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/base/region.h"
#include "core/base/units.h"
#include "core/base/vec.h"
#include "core/record/light_spread.h"

namespace dmpc::core {

/// Where a record starts: its byte offset in the database divided by record_alignment.
enum class Address : std::uint32_t {};
inline constexpr Address no_address{0xffffffffU};
inline constexpr std::size_t record_alignment = 8;
inline constexpr std::size_t record_bytes_max = 448;

constexpr std::uint64_t byte_offset(Address address) {
  return std::uint64_t{static_cast<std::uint32_t>(address)} * record_alignment;
}
/// The address of the record at `base + bytes`; `bytes` is a multiple of record_alignment.
constexpr Address advance(Address base, std::uint64_t bytes) {
  return Address{static_cast<std::uint32_t>(static_cast<std::uint32_t>(base) + bytes / record_alignment)};
}

/// A value at any byte of a record, with any alignment.
template <class T>
T read(const std::byte* from) {
  static_assert(std::is_trivially_copyable_v<T>);
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

/// Space is measured in cells, whose number follows that of the primitives; the lattice on which regions are cut is finer, and
/// the cells of the directory, which rays traverse, are coarser.
inline constexpr int finest_per_cell = 64;
inline constexpr int cells_per_macro = 8;
/// Cells of the finest lattice along the edge of a macro cell.
inline constexpr int finest_per_macro = cells_per_macro * finest_per_cell;

/// One macro cell: a BVH node's address, or empty with the Chebyshev radius r of macro cells around it that are empty too: all
/// cells nearer than r are empty (Cohen & Sheffer 1994). r = 0: what lies in the cell is no business of this region's.
struct DirectoryEntry {
  static constexpr std::uint32_t empty_flag = 0x80000000U;
  std::uint32_t bits = empty_flag | 1U;

  constexpr bool empty() const { return (bits & empty_flag) != 0; }
  constexpr int radius() const { return static_cast<int>(bits & ~empty_flag); }
  constexpr Address bvh_node() const { return Address{bits}; }
};
static_assert(sizeof(DirectoryEntry) == 4);
inline constexpr int radius_max = 64;

/// One place in the list of a voxel: the leaf that is to be tested. In a database that has these, an entry of the directory
/// tells the number of the list's first reference in place of a BVH node's address.
struct VoxelReference {
  static constexpr std::uint32_t last_flag = 0x80000000U;
  std::uint32_t bits = 0;

  static constexpr VoxelReference to(Address leaf) { return {static_cast<std::uint32_t>(leaf)}; }
  /// The list ends here.
  constexpr bool is_last() const { return (bits & last_flag) != 0; }
  constexpr Address leaf() const { return Address{bits & ~last_flag}; }
};
static_assert(sizeof(VoxelReference) == 4);
/// References that an entry of the directory can tell apart.
inline constexpr std::uint64_t references_max = DirectoryEntry::empty_flag;

/// A child of a BVH node: a leaf of primitives, or a BVH node of its own.
struct BvhChild {
  static constexpr std::uint32_t leaf_flag = 0x80000000U;
  std::uint32_t bits = 0;

  static constexpr BvhChild none() { return {0xffffffffU}; }
  static constexpr BvhChild leaf(Address address) { return {leaf_flag | static_cast<std::uint32_t>(address)}; }
  static constexpr BvhChild bvh_node(Address address) { return {static_cast<std::uint32_t>(address)}; }
  constexpr bool found() const { return bits != none().bits; }
  constexpr bool is_leaf() const { return (bits & leaf_flag) != 0; }
  constexpr Address address() const { return Address{bits & ~leaf_flag}; }
};

inline constexpr std::size_t bvh_children_max = 8;
/// BVH nodes between a macro cell and a leaf, at most: 8^9 primitives fit below a macro cell.
inline constexpr int bvh_levels_max = 8;

/// What a part of a macro cell holds: up to 8 children, each with the box within which a ray may meet it: child i between
/// bounds[axis][i] and bounds[axis + 3][i] units from the origin. A box holds its child's primitives as far as they lie in the
/// macro cell, and the insertion pad around them.
struct BvhNode {
  Vec3f origin;
  float unit = 1;  ///< a power of two
  std::array<BvhChild, bvh_children_max> child{};
  std::array<std::array<std::uint8_t, bvh_children_max>, 6> bounds{};
  std::uint32_t child_count = 0;
  std::uint32_t padding = 0;
};
/// Where the bound in row `row` of a BVH node's child lies, grid-local.
constexpr double place_of(const BvhNode& bvh_node, std::size_t row, std::size_t child) {
  return double{bvh_node.origin[row % 3]} + bvh_node.bounds[row][child] * double{bvh_node.unit};
}
static_assert(sizeof(BvhNode) == 104 && std::is_trivially_copyable_v<BvhNode> && sizeof(BvhNode) <= record_bytes_max);

/// `instance` is none: leaves of that kind hold the boxes of base meshes (core/record/instance.h).
enum class PrimitiveKind : std::uint8_t { triangle, sphere, cone, instance };
inline constexpr std::size_t primitive_kind_count = 3;

inline constexpr std::size_t leaf_lanes = 8;

/// Up to 8 primitives of one kind, as a structure of arrays with `count` lanes: `value_count(kind)` rows of values, then a row of
/// primitive ids (ascending), then a row of ShadingReference. Grid-local coordinates, floats.
///   triangle rows: v0.x v0.y v0.z v1.x .. v2.z
///   sphere rows:   centre.x .y .z radius, rests
///   cone rows:     base.x .y .z radius, apex (or axis: curved_values.h) .x .y .z radius, rests of the first four, of the last
///   four instance rows: low.x .y .z high.x .y .z of a box; in place of its ShadingReference the address of its InstanceRecord
/// Rests: what rounding left of four values, the first lowest: a byte each or, of what passes by local zero, 4 bits a coordinate
/// and 20 of the radius (core/record/curved_values.h). Behind the rows of a leaf that has_plane(): the FacePlane of all its
/// triangles.
struct LeafHeader {
  PrimitiveKind kind{};
  std::uint8_t count = 0;
  /// 0: none. 1: all share a plane that no axis stands on. From exact_plane on: they lie in a plane of their own, which the
  /// file's doubles say and floats cannot tell from others next to it; what is more is its layer among those.
  std::uint8_t plane = 0;
  std::uint8_t shared_lanes = 0;  ///< a bit for each triangle that shares its plane with others (core/database/faces/coplanar.h)
  /// In a part of a database (core/database/extract.h) what names the leaf in all parts, if a ray may meet it again: its box
  /// reaches beyond each of the part's regions or, of voxels, beyond one of those; else 0.
  std::uint32_t shared_name = 0;

  static constexpr std::uint8_t shared_plane = 1, exact_plane = 2;
  /// In a base mesh's leaves alone: all share a plane on which an axis of the mesh stands.
  static constexpr std::uint8_t level_plane = 254;
  constexpr bool has_plane() const { return plane != 0; }
  constexpr bool has_exact_plane() const { return plane >= exact_plane; }
  /// The layer of an exact plane.
  constexpr std::int32_t layer() const { return plane - exact_plane; }
};
static_assert(sizeof(LeafHeader) == 8);

/// Layers of planes that lie so near to each other that a float t may be the same for several.
inline constexpr std::int32_t plane_layers_max = 8;

/// A plane that several triangles lie in, whose distance is that of them all: points p with dot(normal, p) == offset, grid-local.
struct FacePlane {
  Vec3d normal;  ///< unit length
  double offset = 0;

  double height_of(const Vec3d& point) const { return dot(normal, point) - offset; }
};

constexpr std::size_t value_count(PrimitiveKind kind) {
  constexpr std::array<std::size_t, 4> counts{9, 5, 10, 6};
  return counts[static_cast<std::size_t>(kind)];
}
inline constexpr std::size_t value_count_max = 10;
/// The first row of rests of a sphere or cone.
constexpr std::size_t rest_row(PrimitiveKind kind) { return kind == PrimitiveKind::sphere ? 4 : 8; }
constexpr std::size_t leaf_bytes(PrimitiveKind kind, std::size_t count) {
  return sizeof(LeafHeader) + count * 4 * (value_count(kind) + 2);
}
constexpr std::size_t leaf_bytes(const LeafHeader& header) {
  return leaf_bytes(header.kind, header.count) + (header.has_plane() ? sizeof(FacePlane) : 0);
}
static_assert(leaf_bytes(PrimitiveKind::triangle, leaf_lanes) + sizeof(FacePlane) <= record_bytes_max);

/// The row of primitive ids of a leaf.
inline const std::byte* ids_of(const LeafHeader& header, const std::byte* leaf) {
  return leaf + sizeof(header) + sizeof(float) * value_count(header.kind) * header.count;
}

/// The plane of a leaf that has one.
inline FacePlane plane_of(const LeafHeader& header, const std::byte* leaf) {
  return read<FacePlane>(leaf + leaf_bytes(header.kind, header.count));
}

/// Where a primitive's shading data is: the index of its material, or the address of its PatchNormals.
struct ShadingReference {
  static constexpr std::uint32_t smooth_flag = 0x80000000U;
  std::uint32_t bits = 0;

  static constexpr ShadingReference flat(std::uint32_t material) { return {material}; }
  static constexpr ShadingReference smooth(Address normals) { return {smooth_flag | static_cast<std::uint32_t>(normals)}; }
  constexpr bool is_smooth() const { return (bits & smooth_flag) != 0; }
  constexpr std::uint32_t material() const { return bits; }
  constexpr Address normals() const { return Address{bits & ~smooth_flag}; }
};

/// Vertex normals of a smooth triangle, of unit length to rounding; all 0 if it is flat. Begins a TexturedNormals if its flag
/// says so.
struct PatchNormals {
  static constexpr std::uint32_t textured_flag = 0x80000000U;

  std::array<Vec3f, 3> normal;
  std::uint32_t material_bits = 0;  ///< the index of the material, and the flag

  constexpr bool is_textured() const { return (material_bits & textured_flag) != 0; }
  constexpr std::uint32_t material() const { return material_bits & ~textured_flag; }
};
static_assert(sizeof(PatchNormals) == 40);

/// How a texel's 32 bits are read. srgb: red, green and blue from the lowest byte up, with the sRGB curve; shared_exponent:
/// linear, from the lowest bit up three mantissas of 9 bits and an exponent of 5 (OpenGL's RGB9_E5); fine_srgb: red, green and
/// blue in 10 bits each from the lowest up, with the sRGB curve in 1020 steps, every fourth of which is a byte's; srgb_alpha: as
/// srgb, with alpha, 255 where all is there, in the highest byte; linear: of numbers that are no colours, 255ths from the lowest
/// byte up.
enum class TexelFormat : std::uint8_t { srgb, shared_exponent, fine_srgb, srgb_alpha, linear };
/// What lies beyond a texture's edges: itself again, itself mirrored, or its edge.
enum class TextureWrap : std::uint8_t { repeat, mirror, clamp };

/// The side of a tile, in texels.
inline constexpr std::uint32_t tile_side = 8;
/// Texels row by row. Those beyond the edge of a level are of no account.
struct TextureTile {
  std::array<std::uint32_t, std::size_t{tile_side} * tile_side> texel{};
};
static_assert(sizeof(TextureTile) == 256 && sizeof(TextureTile) <= record_bytes_max);

/// A texture as its users know it (core/record/texture_layout.h): levels of tiles, the finest first, each half the size of the
/// one before.
struct TextureReference {
  Address tiles = no_address;  ///< a table of the tiles' addresses, level by level, each row by row; two share a record
  std::uint16_t width = 1, height = 1;
  TexelFormat format{};
  TextureWrap wrap_s{}, wrap_t{};
  std::uint8_t level_count = 1;
};
static_assert(sizeof(TextureReference) == 12);

/// A corner's colour, where there is no texture to have a place on: red, green and blue, linear, then alpha, from 0 to
/// corner_color_max for 1.
using CornerColor = std::array<std::uint16_t, 4>;
inline constexpr std::uint16_t corner_color_max = 65535;

/// What shading needs of a textured triangle, smooth or not, or of one whose corners have colours. A place on a texture: s to the
/// right, t downwards, both from 0 to 1 over the whole.
struct TexturedNormals {
  PatchNormals normals;
  TextureReference texture;
  std::array<std::array<float, 2>, 3> place{};  ///< (s, t) of its corners, or the bits of their colours
  std::uint32_t has_facets = 0;                 ///< 1: it begins a FacetedNormals

  /// Or its corners have colours.
  constexpr bool has_texture() const { return texture.tiles != no_address; }
  CornerColor color(std::size_t corner) const { return std::bit_cast<CornerColor>(place[corner]); }
};
static_assert(sizeof(TexturedNormals) == 80 && sizeof(TexturedNormals) <= record_bytes_max);

/// A TexturedNormals of a triangle with a texture of metal and roughness, too, in the same place as that of its colour: in
/// databases for pictures by paths.
struct FacetedNormals {
  TexturedNormals textured;
  TextureReference facets;  ///< metal and roughness, with TexelFormat::linear
  std::uint32_t padding = 0;
};
static_assert(sizeof(FacetedNormals) == 96 && sizeof(FacetedNormals) <= record_bytes_max);

/// A surface as NFF knows it. Of one that has more, `specular` is the weight of what of its highlight and mirror has its own
/// colour, and the place of the index, as a number that is none, names its MaterialExtensionRecord.
struct MaterialRecord {
  Color color;
  float diffuse = 0, specular = 0, shine = 0, transmittance = 0, refraction_index = 1;

  /// In the place of `shine`: of a surface of microfacets, whose finish is a MicrofacetRecord. Its `diffuse` and `transmittance`
  /// are so, except for what the tiny mirrors reflect of either, and `specular` is the share of it that is there.
  static constexpr float microfacet_mark = -1;
  static constexpr std::uint32_t extension_mark = 0xffc00000U, extension_max = ~extension_mark;

  bool has_microfacets() const { return shine < 0; }
  bool has_extension() const { return std::bit_cast<std::uint32_t>(refraction_index) > extension_mark; }
  /// Which record from the first material on is the finish.
  std::uint32_t finish() const { return std::bit_cast<std::uint32_t>(refraction_index) & extension_max; }
  /// `record`: from 1 to extension_max.
  void set_extension(std::uint32_t record) { refraction_index = std::bit_cast<float>(extension_mark | record); }
};
static_assert(sizeof(MaterialRecord) == 32);

/// What a surface has that NFF cannot say. These records stand behind all materials, of which few have one.
struct MaterialExtensionRecord {
  static constexpr std::uint16_t share_max = 65535;

  Color specular;              ///< colour of highlight and mirror, without the part in the surface's own colour
  Color emission;              ///< radiance
  float refraction_index = 1;  ///< as a MaterialRecord has it
  /// In 65535ths: where what alpha leaves of the surface is less, nothing is there, elsewhere all; 0: as much as alpha leaves.
  std::uint16_t alpha_cutoff = 0;
  std::uint16_t mirror = share_max;  ///< in 65535ths, the share of highlight and mirror that mirrors
};
static_assert(sizeof(MaterialExtensionRecord) == sizeof(MaterialRecord));

/// What takes the place of a MaterialExtensionRecord for a surface of microfacets, in databases of pictures by paths.
struct MicrofacetRecord {
  float metallic = 0;
  float alpha = 1;  ///< its roughness squared
  float reflectance = 0;
  Color emission;
  float refraction_index = 1;
  std::uint16_t alpha_cutoff = 0;  ///< as a MaterialExtensionRecord has it
  /// 1: its triangles have FacetedNormals, whose texture's blue `metallic` is multiplied by, and its green the roughness. Then
  /// the MaterialRecord is that of the surface without any metal.
  std::uint16_t has_texture = 0;
};
static_assert(sizeof(MicrofacetRecord) == sizeof(MaterialRecord));

struct LightRecord {
  Vec3f position;   ///< grid-local
  Color intensity;  ///< with fall-off: ahead, at distance 1
  LightSpread spread{};
};
static_assert(sizeof(LightRecord) == 32);

/// Three unit vectors of the world at right angles, right-handed.
/// How grid-local coordinates come from the world's: local = (world - origin) * scale, scale a power of two that brings the
/// largest extent into (1/2, 1]. Keeps rounding in proportion to the scene, wherever it lies; and to its detail, where that lies
/// close together beside something large: there local zero is, elsewhere where the grid begins (core/scene/detail.h).
struct GridFrame {
  Vec3d origin;
  double scale = 1;
  std::array<std::int32_t, 3> resolution{1, 1, 1};  ///< cells along x, y, z
  float finest_cell = 1;                            ///< edge of a finest cell, grid-local
  Vec3d low;                                        ///< where the grid begins, grid-local: 0 or less
  Vec3d eye_extent;  ///< what far eyes take for the grid's extent (core/picture/camera/camera.h), if cells were joined; else 0
};

/// The coordinate, grid-local, of a plane of the finest lattice.
constexpr double plane_at(const GridFrame& frame, std::size_t axis, std::int32_t plane) {
  return frame.low[axis] + static_cast<double>(plane) * double{frame.finest_cell};
}

/// The grid's size in finest cells.
constexpr Corner grid_size(const GridFrame& frame) {
  return {frame.resolution[0] * finest_per_cell, frame.resolution[1] * finest_per_cell, frame.resolution[2] * finest_per_cell};
}

/// Where the grid ends, grid-local.
constexpr Vec3d grid_high(const GridFrame& frame) {
  const Corner size = grid_size(frame);
  return {plane_at(frame, 0, size[0]), plane_at(frame, 1, size[1]), plane_at(frame, 2, size[2])};
}

/// Macro cells along x, y, z: the last of an axis may reach beyond the grid.
constexpr std::array<std::int32_t, 3> macro_cells(const GridFrame& frame) {
  return {ceil_divide(frame.resolution[0], cells_per_macro), ceil_divide(frame.resolution[1], cells_per_macro),
          ceil_divide(frame.resolution[2], cells_per_macro)};
}

/// A sky's picture as its users know it (core/record/sky.h).
struct SkyReference {
  Address tiles = no_address;             ///< TextureTile, row by row; no_address: there is no picture
  Address choices = no_address;           ///< the tree by which a tile is selected
  std::uint16_t width = 0, height = 0;    ///< texels
  float scale = 1;                        ///< what texels are multiplied by, a power of two
  float density = 0, least_strength = 0;  ///< for SkyCells: the density of light sampling
  Vec3d middle, up;                       ///< where its middle and its upper edge lie, grid-local, unit, at right angles
};

/// The database's table of contents, by value in every node.
struct DatabaseHeader {
  GridFrame frame;
  Region region;  ///< whose records are here: the whole grid, or a node's part of it
  Address directory = no_address;
  Address references = no_address;               ///< the voxels'; no_address: macro cells have trees of BVH nodes
  std::int32_t directory_doublings = 0;          ///< in a proxy of voxels, an entry covers 2^this of them along each axis
  Corner directory_low{};                        ///< finest cells, a multiple of macro cells: where the directory begins
  std::array<std::int32_t, 3> directory_size{};  ///< macro cells along x, y, z
  Address materials = no_address;
  Address lights = no_address;
  std::uint32_t primitive_count = 0;
  std::uint32_t material_count : 30 = 0;  ///< with the MaterialExtensionRecords, which stand behind
  std::uint32_t has_instances : 1 = 0;    ///< there are leaves of instances: cursors are an InstanceCursor
  std::uint32_t has_emission : 1 = 0;     ///< some material shines by itself
  std::uint32_t light_count = 0;
  Color background;
  Color ambient;  ///< Scene::ambient
  Address emitters = no_address;
  std::uint32_t emitter_count = 0;              ///< for light sampling: 0 unless requested and available
  std::uint32_t drawn_materials = 0xffffffffU;  ///< from this one on materials are those of emitters that are drawn
  float emitter_density = 0;  ///< one over the sum of all drawn emitters' areas, grid-local, times their strength_of()
  SkyReference sky;           ///< for paths with a sky's picture

  /// Whether macro cells are voxels with lists.
  constexpr bool has_voxels() const { return references != no_address; }
};
static_assert(std::is_trivially_copyable_v<DatabaseHeader>);

/// `rows` points at the leaf's first value, `stride` is its lane count.
struct LeafLane {
  const float* rows;
  std::size_t stride, lane;

  double value(std::size_t row) const { return double{rows[row * stride + lane]}; }
  /// A vertex, centre or end, by the row where it starts.
  Vec3d vector(std::size_t row) const { return {value(row), value(row + 1), value(row + 2)}; }
};

}  // namespace dmpc::core
