// The contents of an OBJ file before its materials are resolved.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/foreign/mesh/polygon_mesh.h"
#include "core/base/vec.h"

namespace dmpc::apps::obj {

inline constexpr std::uint32_t none = 0xffffffffU;

/// Texture coordinates are given for all corners of a face or for none; the same holds for normals.
struct Faces : FaceList {
  std::vector<std::uint32_t> places;   ///< one per corner, or `none`; empty until a corner has one
  std::vector<std::uint32_t> normals;  ///< one per corner, or `none`; empty until a corner has one
  std::vector<std::uint32_t> groups;   ///< smoothing group per face, 0 for none; empty if the file has none

  bool has_places(std::size_t face) const { return !places.empty() && places[begin_of(face)] != none; }
  bool has_normals(std::size_t face) const { return !normals.empty() && normals[begin_of(face)] != none; }
};

/// Consecutive faces with one material.
struct Run {
  std::uint32_t first_face;
  std::uint32_t name;  ///< index into Geometry::material_names, or `none` before any usemtl
};

struct Geometry {
  std::vector<core::Vec3d> vertices, normals;
  std::vector<core::Vec3d> colors;            ///< one per vertex, white for vertices without one; empty if no vertex has one
  std::vector<std::array<double, 2>> places;  ///< t increases upwards
  Faces faces;
  std::vector<Run> runs;                    ///< in order; none is empty
  std::vector<std::string> material_names;  ///< as written after usemtl, without repetitions
  std::vector<std::string> libraries;       ///< operands of mtllib, without repetitions
  std::vector<std::string> notes;           ///< one sentence per feature that is not shown

  /// Calls take(face, index of its run) for each face.
  template <class Take>
  void for_each_face(const Take& take) const {
    std::size_t run = 0;
    for (std::uint32_t face = 0; face < faces.ends.size(); ++face) {
      run += run + 1 < runs.size() && runs[run + 1].first_face == face ? 1 : 0;
      take(face, run);
    }
  }
};

}  // namespace dmpc::apps::obj
