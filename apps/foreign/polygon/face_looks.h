// Attributes of mesh faces in scan formats.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "apps/foreign/mesh/placed_file.h"
#include "core/base/vec.h"

namespace dmpc::apps {

/// Red, green and blue, with float precision.
using Color = core::Vec3d;

/// The linear colour of elements without one, if other elements have colours.
inline constexpr Color colour_of_none = {double{0.6F}, double{0.6F}, double{0.6F}};

/// A placeholder for a missing colour until all are read.
inline constexpr Color not_yet = {-std::numeric_limits<double>::max(), 0, 0};

/// Sets the colour of the last of `count` faces or vertices; earlier ones without a colour stay without.
void set_last(std::vector<Color>& colors, std::size_t count, const Color& color);

/// Converts sRGB values from 0 to `most` into linear values from 0 to 1. MeshLab, Blender and three.js interpret the colours of
/// these formats so, whatever their type. If any of the `count` elements has a colour, those without get `plain`.
void make_linear(std::vector<Color>& colors, std::size_t count, double most, const Color& plain = colour_of_none);
Color linear_color(const Color& color, double most);

/// Returns the value of full intensity if the number type does not define it: 255 if any value exceeds 1, else 1.
double full_light(const std::vector<Color>& colors);

/// Each vector has one entry per face, or none.
struct FaceLooks {
  std::vector<Color> colors;             ///< linear
  std::vector<std::uint32_t> materials;  ///< indices into a file's materials; if empty, all faces have material 0

  /// Drops the face colours, with a note, if the vertices have colours as well.
  void give_way_to(const PolygonMesh& mesh, std::vector<std::string>& notes);
};

/// Throws core::CapacityError if there are more corners than indices can address.
void add_face(std::span<const std::uint32_t> corners, PolygonMesh& mesh);

/// Adds a mesh that has faces, grouped by material in their order. Up to face_colors_max face colours become materials, which
/// reproduce them exactly; otherwise colours are stored per corner. The file's first material must exist.
void add_mesh(PolygonMesh mesh, FaceLooks looks, PlacedFile& file);

}  // namespace dmpc::apps
