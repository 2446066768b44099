#include "apps/lab/bench/speed/mesh_files.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstring>
#include <span>
#include <sstream>
#include <unordered_map>

#include "core/base/expect.h"
#include "core/base/sampling.h"

namespace dmpc::apps {
namespace {

static_assert(std::endian::native == std::endian::little);

using Vertex = std::array<float, 3>;

struct VertexHash {
  std::size_t operator()(const Vertex& vertex) const {
    std::uint64_t hash = 0;
    for (const float value : vertex) {
      hash = core::mix(hash + std::bit_cast<std::uint32_t>(value));
    }
    return hash;
  }
};

template <class T>
void append(std::span<const T> values, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size_bytes());
}

void append(std::size_t number, std::string& bytes) {
  const auto word = static_cast<std::uint32_t>(number);
  append(std::span<const std::uint32_t>(&word, 1), bytes);
}

std::string json_of(const Vertex& vertex) {
  std::ostringstream text;
  text.precision(9);
  text << '[' << vertex[0] << ',' << vertex[1] << ',' << vertex[2] << ']';
  return text.str();
}

/// What describes the bytes of a GLB file, which begin with the vertices.
std::string description_of(const SharedMesh& mesh) {
  Vertex least = mesh.vertices.front(), most = least;
  for (const Vertex& vertex : mesh.vertices) {
    for (std::size_t axis = 0; axis < vertex.size(); ++axis) {
      least[axis] = std::min(least[axis], vertex[axis]);
      most[axis] = std::max(most[axis], vertex[axis]);
    }
  }
  const std::size_t vertices = mesh.vertices.size() * sizeof(Vertex), indices = mesh.triangles.size() * 12;
  std::ostringstream text;
  text << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)"
       << R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
       << R"("accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":)" << mesh.vertices.size() << R"(,"min":)"
       << json_of(least) << R"(,"max":)" << json_of(most) << R"(},{"bufferView":1,"componentType":5125,"type":"SCALAR","count":)"
       << 3 * mesh.triangles.size() << R"(}],"bufferViews":[{"buffer":0,"byteLength":)" << vertices
       << R"(},{"buffer":0,"byteOffset":)" << vertices << R"(,"byteLength":)" << indices << R"(}],"buffers":[{"byteLength":)"
       << vertices + indices << "}]}";
  std::string padded = text.str();
  padded.resize((padded.size() + 3) / 4 * 4, ' ');
  return padded;
}

}  // namespace

SharedMesh mesh_of(const core::Database& database) {
  SharedMesh mesh;
  std::unordered_map<Vertex, std::uint32_t, VertexHash> numbers;
  for (const core::PrimitiveValues& primitive : database.primitives()) {
    if (primitive.kind != core::PrimitiveKind::triangle) {
      continue;
    }
    auto& triangle = mesh.triangles.emplace_back();
    for (std::size_t corner = 0; corner < triangle.size(); ++corner) {
      const float* const value = &primitive.value[3 * corner];
      const Vertex vertex{value[0], value[1], value[2]};
      const auto [number, is_new] = numbers.try_emplace(vertex, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) {
        mesh.vertices.push_back(vertex);
      }
      triangle[corner] = number->second;
    }
  }
  return mesh;
}

std::string ply_of(const SharedMesh& mesh) {
  constexpr std::size_t face_bytes = 13;
  std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.vertices.size()) +
                      "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                      std::to_string(mesh.triangles.size()) + "\nproperty list uchar int vertex_indices\nend_header\n";
  bytes.reserve(bytes.size() + mesh.vertices.size() * sizeof(Vertex) + mesh.triangles.size() * face_bytes);
  append(std::span<const Vertex>(mesh.vertices), bytes);
  for (const auto& triangle : mesh.triangles) {
    bytes.push_back(3);
    append(std::span<const std::uint32_t>(triangle), bytes);
  }
  return bytes;
}

std::string glb_of(const SharedMesh& mesh) {
  core::expect(!mesh.triangles.empty(), "a glTF file has a triangle");
  constexpr std::size_t version = 2, head_bytes = 12, chunk_head_bytes = 8;
  const std::string description = description_of(mesh);
  const std::size_t data_bytes = mesh.vertices.size() * sizeof(Vertex) + mesh.triangles.size() * 12;
  std::string bytes = "glTF";
  append(version, bytes);
  append(head_bytes + chunk_head_bytes + description.size() + chunk_head_bytes + data_bytes, bytes);
  append(description.size(), bytes);
  bytes += "JSON" + description;
  append(data_bytes, bytes);
  bytes.append("BIN\0", 4);
  append(std::span<const Vertex>(mesh.vertices), bytes);
  append(std::span<const std::array<std::uint32_t, 3>>(mesh.triangles), bytes);
  return bytes;
}

}  // namespace dmpc::apps
