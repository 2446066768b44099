// Files that are out to do harm, small.
#pragma once

#include <cstdint>
#include <string>

#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests {

/// A triangle whose material has this texture.
inline std::string write_textured_triangle(const TemporaryFolder& folder, const std::string& texture) {
  write_text(folder / "a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\n");
  write_text(folder / "a.mtl", "newmtl m\nKd 1 1 1\nmap_Kd " + texture + "\n");
  return folder / "a.obj";
}

/// A triangle as glTF whose material has this texture: `image` is what stands in an entry of "images".
inline std::string gltf_triangle(const std::string& image) {
  return R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"scene":0,"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],"textures":[{"source":0}],"images":[{)" +
         image + R"(}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":24}],
"buffers":[{"byteLength":60,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/"}]})";
}

/// An EXR's header, of a picture of that size, and the places of its pixels, of which there are none.
inline std::string exr_header(std::uint32_t width, std::uint32_t height) {
  using namespace std::string_literals;
  const auto number = [](std::uint32_t value) {
    std::string bytes;
    for (int shift = 0; shift < 32; shift += 8) {
      bytes += static_cast<char>(value >> shift & 0xffU);
    }
    return bytes;
  };
  const auto attribute = [&](const std::string& name, const std::string& type, const std::string& value) {
    return name + '\0' + type + '\0' + number(static_cast<std::uint32_t>(value.size())) + value;
  };
  std::string channels;
  for (const std::string name : {"B", "G", "R"}) {
    channels += name + '\0' + number(1) + number(0) + number(1) + number(1);
  }
  const std::string window = number(0) + number(0) + number(width - 1) + number(height - 1);
  return "v/1\x01\x02\0\0\0"s + attribute("channels", "chlist", channels + '\0') +
         attribute("compression", "compression", "\x09"s) + attribute("dataWindow", "box2i", window) +
         attribute("displayWindow", "box2i", window) + attribute("lineOrder", "lineOrder", "\0"s) +
         attribute("pixelAspectRatio", "float", "\0\0\x80\x3f"s) + attribute("screenWindowCenter", "v2f", "\0\0\0\0\0\0\0\0"s) +
         attribute("screenWindowWidth", "float", "\0\0\x80\x3f"s) + '\0' + std::string((height + 255) / 256 * 8, '\0');
}

}  // namespace dmpc::tests
