// Scenes of pbrt-v4 that tests write, each with a camera in right-handed coordinates and a triangle.
#pragma once

#include <string>

#include "tests/support/read_mesh.h"

namespace dmpc::tests {

/// Ten in front of the middle, in coordinates that are right-handed, as most scenes have them.
inline const std::string pbrt_camera =
    "Scale -1 1 1\nLookAt 0 0 10  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 90\n"
    "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 32\nWorldBegin\n";
inline const std::string pbrt_triangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0] \"integer indices\" [0 1 2]\n";

/// A scene of these statements after that camera.
inline apps::MeshFile read_pbrt(const std::string& world, const apps::MeshOptions& options = {}) {
  return read_mesh("a.pbrt", pbrt_camera + world, options);
}

/// What is said of them if they are refused, without what comes before the line: "6:1: Shape ...".
inline std::string pbrt_refusal(const std::string& world) {
  const std::string text = mesh_refusal("a.pbrt", pbrt_camera + world), name = "a.pbrt:";
  const std::size_t at = text.find(name);
  return at == std::string::npos ? text : text.substr(at + name.size());
}

}  // namespace dmpc::tests
