// Small mesh files made by tests: one triangle in every format, glTF with whatever around it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace dmpc::tests {

/// The triangle of all of these: corners (0 0 0), (2 0 0), (0 1 0).
inline constexpr std::array<float, 9> triangle_corners = {0, 0, 0, 2, 0, 0, 0, 1, 0};

inline const std::string triangle_obj = "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n";

inline const std::string triangle_ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
    "property list uchar int vertex_indices\nend_header\n0 0 0\n2 0 0\n0 1 0\n3 0 1 2\n";

inline const std::string triangle_stl =
    "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 2 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid one\n";

template <class T>
std::string bytes_of(const T& value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

inline std::string triangle_binary_stl() {
  return std::string(80, ' ') + bytes_of(std::uint32_t{1}) + bytes_of(std::array<float, 3>{0, 0, 1}) +
         bytes_of(triangle_corners) + bytes_of(std::uint16_t{0});
}

inline std::string base64(const std::string& bytes) {
  static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8U | (i + k < bytes.size() ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

/// A glTF scene around the triangle.
struct Gltf {
  std::string nodes = R"([{"mesh":0}])", roots = "[0]";
  std::string materials;                                       ///< the triangle's is first; none if empty
  std::array<float, 9> corners = triangle_corners, normals{};  ///< no normals if all are 0
  std::string more;                                            ///< members of the outermost object, after a comma

  std::string bytes() const { return bytes_of(corners) + bytes_of(normals) + bytes_of(std::array<std::uint32_t, 3>{0, 1, 2}); }
  bool has_normals() const { return normals != std::array<float, 9>{}; }

  /// Its JSON; `uri` is where the bytes are: nothing for those of a .glb.
  std::string json(const std::string& uri) const {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":)" + roots + R"(}],"nodes":)" + nodes +
           R"(,"meshes":[{"name":"wheel","primitives":[{"attributes":{"POSITION":0)" + (has_normals() ? R"(,"NORMAL":1)" : "") +
           R"(},"indices":2)" + (materials.empty() ? "" : R"(,"material":0)") + R"(}]}],)" +
           (materials.empty() ? "" : R"("materials":)" + materials + ",") +
           R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[2,1,0]},)"
           R"({"bufferView":1,"componentType":5126,"count":3,"type":"VEC3"},)"
           R"({"bufferView":2,"componentType":5125,"count":3,"type":"SCALAR"}],)"
           R"("bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},)"
           R"({"buffer":0,"byteOffset":72,"byteLength":12}],"buffers":[{"byteLength":84)" +
           (uri.empty() ? "" : R"(,"uri":")" + uri + "\"") + "}]" + (more.empty() ? "" : "," + more) + "}";
  }
  std::string text() const { return json("data:application/octet-stream;base64," + base64(bytes())); }

  std::string binary() const {
    std::string text = json("");
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string chunks = bytes_of(static_cast<std::uint32_t>(text.size())) + "JSON" + text +
                               bytes_of(static_cast<std::uint32_t>(bytes().size())) + std::string("BIN\0", 4) + bytes();
    return "glTF" + bytes_of(std::uint32_t{2}) + bytes_of(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
  }
};

}  // namespace dmpc::tests
