// A mesh file of a square with a texture, for tests.
#pragma once

#include <filesystem>

#include "apps/picture/image_file.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

/// Writes a square of two triangles with a texture of `side` x `side` texels to `folder`; the path of the scene.
inline std::filesystem::path write_painted_square(const TemporaryFolder& folder, int side) {
  apps::Image image(side, side);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    image.rgb[i] = static_cast<float>(i % 7) / 7;
  }
  apps::write_image(folder / "paint.png", image);
  write_text(folder / "square.mtl", "newmtl paint\nKd 1 1 1\nmap_Kd paint.png\n");
  write_text(folder / "square.obj",
             "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl paint\n"
             "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  return folder / "square.obj";
}

}  // namespace dmpc::tests
