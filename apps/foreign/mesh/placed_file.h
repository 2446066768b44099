// What a reader of our own has of a file that holds a whole scene: meshes and spheres in places, lights, a sky and a camera.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "apps/foreign/mesh/made_picture.h"
#include "apps/foreign/mesh/polygon_file.h"
#include "apps/foreign/mesh/texture_place.h"
#include "apps/foreign/mesh/transform.h"
#include "core/scene/scene.h"

namespace dmpc::apps {

/// A mesh, or a sphere, where it is placed.
struct ShapePlace {
  std::uint32_t shape = 0;  ///< index into PlacedFile::shapes
  Transform world;          ///< from the shape's own coordinates
};

/// In its own coordinates.
struct PlacedShape {
  PolygonMesh mesh;                    ///< with a material; without faces where it is a sphere
  std::optional<core::Sphere> sphere;  ///< which stays round in all its places
  std::optional<std::size_t> back;     ///< the material of what it shows behind, where it shines to the front alone
  bool is_turned = false;              ///< its faces look to the other side
  std::uint64_t uses = 0;              ///< how many places it has
};

struct PlacedMaterial {
  FileMaterial surface;
  TexturePlace place;  ///< on its texture
};

enum class FileLightKind : std::uint8_t { point, spot, distant };

/// As physics has it: a point's intensity falls off with the square of the distance.
struct FileLight {
  FileLightKind kind{};
  core::Vec3d position;   ///< of a distant one: the way that its light goes
  core::Vec3d intensity;  ///< of a distant one: what a surface gets that faces it
};

/// All directions, as a square picture shows them in equal areas.
struct FileSky {
  std::string path;
  std::array<core::Vec3d, 3> rows;  ///< from a direction of the world to one of the picture
  core::Vec3d scale{1, 1, 1};
};

struct PlacedFile {
  std::vector<PlacedMaterial> materials;
  std::vector<MadePicture> pictures;  ///< what a TextureUse calls "*0", "*1", ...
  std::vector<PlacedShape> shapes;
  std::vector<ShapePlace> places;  ///< in the file's order
  std::vector<FileLight> lights;
  core::Vec3d background;      ///< light from everywhere
  std::vector<FileSky> skies;  ///< beside that
  std::optional<core::View> view;
  std::vector<std::string> notes;    ///< what of the file is not shown as it is, a sentence each
  std::vector<std::string> missing;  ///< sentences: which files it refers to cannot be had, in order, each once
  double coordinate_rounding = 0;    ///< as core::Scene's
};

}  // namespace dmpc::apps
