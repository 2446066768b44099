// A file as its reader returns it: instanced meshes and spheres, materials, lights, skies and cameras.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "apps/foreign/mesh/round_mesh.h"
#include "apps/foreign/mesh/texture_place.h"
#include "apps/foreign/mesh/transform.h"
#include "apps/picture/texture_file.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// An embedded picture file.
struct MadePicture {
  std::vector<std::byte> file;
  std::string format_hint;  ///< extension of such files
};

/// The source of a material's colour.
struct TextureUse {
  std::string path;  ///< as in the file; for an embedded picture its number after a star
  TextureEdges edges{.alpha = TextureAlpha::said};
};

/// A material converted to ours, without its textures, which are still to be read.
struct FileMaterial {
  core::Material material;
  std::optional<TextureUse> texture = std::nullopt;  ///< multiplied by `material`'s colour
  TexturePlace place{};                              ///< mapping on that texture
  std::optional<TextureUse> facets = std::nullopt;   ///< metal and roughness: glTF's metallicRoughnessTexture
  bool lie_facets_there = false;                     ///< mapped as `texture` is
  bool is_cut_away = false;                          ///< the surface is fully cut out by its mask
};

/// An instance of a mesh or a sphere.
struct ShapePlace {
  std::uint32_t shape = 0;  ///< index into PlacedFile::shapes
  Transform world{};        ///< from the shape's own coordinates
};

/// In its own coordinates.
struct PlacedShape {
  PolygonMesh mesh;                 ///< with a material; without faces where it is round
  std::optional<RoundShape> round;  ///< becomes a mesh where it stands, unless it stays a ball
  std::optional<std::size_t> back;  ///< the material of its back, where it emits to the front alone
  bool is_turned = false;           ///< its faces are flipped
  std::uint64_t uses = 0;           ///< number of instances

  bool is_ball() const { return round && round->is_ball(); }
  /// Size of a copy; for a ball, as if it stays one.
  GeometrySize size_of_copy() const {
    return is_ball() ? GeometrySize{.bytes = sizeof(core::Object) + sizeof(core::Sphere)}
           : round   ? apps::size_of_copy(*round)
                     : apps::size_of_copy(mesh);
  }
};

struct FileView {
  std::string name;
  std::optional<core::View> view;  ///< nothing if it has no perspective
};

enum class FileLightKind : std::uint8_t { point, spot, distant };

struct FileLight {
  FileLightKind kind{};
  core::Vec3d position;    ///< for a distant light: the direction of its light, normalized unless zero
  core::Vec3d intensity;   ///< for a distant light: what a surface receives that faces it
  core::LightCone cone{};  ///< for a light that does not shine in all directions
  bool has_range = false;  ///< the file limits its range
};

/// Radiance from all directions, as a square picture in an equal-area mapping.
struct FileSky {
  std::string path;
  std::array<core::Vec3d, 3> rows;  ///< rotates a direction of the world to one of the picture
  core::Vec3d scale{1, 1, 1};
};

struct PlacedFile {
  std::vector<FileMaterial> materials;  ///< at least one if there is a shape
  std::vector<MadePicture> pictures;    ///< embedded pictures, which TextureUse calls "*0", "*1", ...
  std::vector<PlacedShape> shapes;
  std::vector<ShapePlace> places;  ///< in the file's order
  std::vector<FileView> views;     ///< in the file's order; the first that makes a picture is used
  std::vector<FileLight> lights;
  /// Its lights are complete and physical: a point's intensity falls off with the square of the distance. Otherwise lights do not
  /// fall off, and default lights may be added.
  bool is_lit_whole = false;
  core::Vec3d background;            ///< ambient light, from everywhere
  std::vector<FileSky> skies;        ///< in addition to the background
  std::vector<std::string> notes;    ///< sentences about features that are not shown exactly
  std::vector<std::string> missing;  ///< sentences about missing files, in order, each once
  double coordinate_rounding = 0;    ///< as core::Scene's
  std::optional<int> bounces;        ///< likewise

  /// Adds a mesh without a transform.
  void add(PolygonMesh mesh) {
    places.push_back({static_cast<std::uint32_t>(shapes.size())});
    shapes.push_back({.mesh = std::move(mesh), .round = {}, .back = {}, .uses = 1});
  }
};

}  // namespace dmpc::apps
