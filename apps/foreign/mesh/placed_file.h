// What a reader has of a file: meshes and spheres in places, materials, lights, skies and cameras.
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

/// A picture's file that a file holds itself.
struct MadePicture {
  std::vector<std::byte> file;
  std::string format_hint;  ///< how such files end
};

/// Where a material says that its colour comes from.
struct TextureUse {
  std::string path;  ///< as the file has it; of one within the file its number behind a star
  TextureEdges edges{.alpha = TextureAlpha::said};
};

/// A material converted to ours, without its textures, which are still to be read.
struct FileMaterial {
  core::Material material;
  std::optional<TextureUse> texture = std::nullopt;  ///< that `material`'s colour is multiplied by
  TexturePlace place{};                              ///< on that
  std::optional<TextureUse> facets = std::nullopt;   ///< metal and roughness: glTF's metallicRoughnessTexture
  bool lie_facets_there = false;                     ///< where `texture` does
  bool is_cut_away = false;                          ///< nothing of the surface is there
};

/// A mesh, or a sphere, where it is placed.
struct ShapePlace {
  std::uint32_t shape = 0;  ///< index into PlacedFile::shapes
  Transform world{};        ///< from the shape's own coordinates
};

/// In its own coordinates.
struct PlacedShape {
  PolygonMesh mesh;                 ///< with a material; without faces where it is round
  std::optional<RoundShape> round;  ///< becomes a mesh where it stands, unless it stays a ball
  std::optional<std::size_t> back;  ///< the material of what it shows behind, where it shines to the front alone
  bool is_turned = false;           ///< its faces look to the other side
  std::uint64_t uses = 0;           ///< how many places it has

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
  bool has_range = false;  ///< beyond which its file has it not shine
};

/// All directions, as a square picture shows them in equal areas.
struct FileSky {
  std::string path;
  std::array<core::Vec3d, 3> rows;  ///< from a direction of the world to one of the picture
  core::Vec3d scale{1, 1, 1};
};

struct PlacedFile {
  std::vector<FileMaterial> materials;  ///< at least one if there is a shape
  std::vector<MadePicture> pictures;    ///< what a TextureUse calls "*0", "*1", ...
  std::vector<PlacedShape> shapes;
  std::vector<ShapePlace> places;  ///< in the file's order
  std::vector<FileView> views;     ///< in the file's order, of which the first that makes a picture is taken
  std::vector<FileLight> lights;
  /// Its lights are all that there is, and as physics has them: a point's intensity falls off with the square of the distance.
  /// Else those of other files do not fall off, and ours take the place of none.
  bool is_lit_whole = false;
  core::Vec3d background;            ///< ambient light, from everywhere
  std::vector<FileSky> skies;        ///< beside that
  std::vector<std::string> notes;    ///< what of the file is not shown as it is, a sentence each
  std::vector<std::string> missing;  ///< sentences: which files it refers to cannot be had, in order, each once
  double coordinate_rounding = 0;    ///< as core::Scene's
  std::optional<int> bounces;        ///< likewise

  /// Adds a mesh that stands where it is.
  void add(PolygonMesh mesh) {
    places.push_back({static_cast<std::uint32_t>(shapes.size())});
    shapes.push_back({.mesh = std::move(mesh), .round = {}, .back = {}, .uses = 1});
  }
};

}  // namespace dmpc::apps
