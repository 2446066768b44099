// What an OBJ file says, before its materials are known.
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

/// All corners of a face have a place, or none, and so with normals.
struct Faces : FaceList {
  std::vector<std::uint32_t> places;   ///< a corner each, or `none`; empty until a corner has one
  std::vector<std::uint32_t> normals;  ///< a corner each, or `none`; empty until a corner has one
  std::vector<std::uint32_t> groups;   ///< smoothing group per face, 0 for none; empty if the file has none

  bool has_places(std::size_t face) const { return !places.empty() && places[begin_of(face)] != none; }
  bool has_normals(std::size_t face) const { return !normals.empty() && normals[begin_of(face)] != none; }
};

/// Faces that follow one another and have one material.
struct Run {
  std::uint32_t first_face;
  std::uint32_t name;  ///< index into Geometry::material_names, or `none` before any usemtl
};

struct Geometry {
  std::vector<core::Vec3d> vertices, normals;
  std::vector<core::Vec3d> colors;            ///< a vertex each, white where it has none; empty if none has one
  std::vector<std::array<double, 2>> places;  ///< t grows upwards
  Faces faces;
  std::vector<Run> runs;                    ///< in order, each with a face at least
  std::vector<std::string> material_names;  ///< as usemtl says them, once each
  std::vector<std::string> libraries;       ///< what follows mtllib, once each
  std::vector<std::string> notes;           ///< what is not shown, a sentence each

  /// Calls take(face, index of its run) for each.
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
