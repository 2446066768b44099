#include "apps/foreign/gltf/meshes.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>

#include "apps/edge/line/number_text.h"
#include "core/base/expect.h"

namespace dmpc::apps::gltf {
namespace {

/// OpenGL's numbers.
enum class Mode : std::uint8_t { points, lines, line_loop, line_strip, triangles, triangle_strip, triangle_fan };

Mode mode_of(const Part& primitive) {
  const std::uint64_t mode = primitive.whole("mode", 4);
  if (mode > 6) {
    primitive.get("mode").fail("is " + std::to_string(mode) + ", expected 0 to 6");
  }
  return static_cast<Mode>(mode);
}

/// How many faces `corners` indices make.
std::size_t face_count(Mode mode, std::size_t corners) {
  switch (mode) {
    case Mode::points:
      return corners;
    case Mode::lines:
      return corners / 2;
    case Mode::line_loop:
      return corners < 2 ? 0 : corners;
    case Mode::line_strip:
      return corners < 2 ? 0 : corners - 1;
    case Mode::triangles:
      return corners / 3;
    case Mode::triangle_strip:
    case Mode::triangle_fan:
      return corners < 3 ? 0 : corners - 2;
  }
  return 0;
}

/// Places of a face's corners among the indices.
struct FacePlaces {
  std::array<std::size_t, 3> place{};
  std::size_t count = 3;

  auto begin() const { return place.begin(); }
  auto end() const { return place.begin() + static_cast<std::ptrdiff_t>(count); }
};

/// Which indices face `i` takes, of `corners`; every second triangle of a strip is turned, so that all look to one side.
FacePlaces places_of(Mode mode, std::size_t i, std::size_t corners) {
  switch (mode) {
    case Mode::points:
      return {{i}, 1};
    case Mode::lines:
      return {{2 * i, 2 * i + 1}, 2};
    case Mode::line_loop:
    case Mode::line_strip:
      return {{i, (i + 1) % corners}, 2};
    case Mode::triangles:
      return {{3 * i, 3 * i + 1, 3 * i + 2}};
    case Mode::triangle_strip:
      return i % 2 == 0 ? FacePlaces{{i, i + 1, i + 2}} : FacePlaces{{i + 1, i, i + 2}};
    case Mode::triangle_fan:
      return {{0, i + 1, i + 2}};
  }
  return {{}, 0};
}

/// Beside Assimp's faces, each of which takes a piece of memory of its own. A list of triangles stays as it is.
FaceList triangles_of(Mode mode, std::vector<std::uint32_t> indices) {
  FaceList triangles;
  const std::size_t count = face_count(mode, indices.size());
  triangles.ends.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    triangles.ends[i] = static_cast<std::uint32_t>(3 * (i + 1));
  }
  if (mode == Mode::triangles) {
    triangles.corners = std::move(indices);
    triangles.corners.resize(3 * count);
    return triangles;
  }
  triangles.corners.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::size_t place : places_of(mode, i, indices.size())) {
      triangles.corners.push_back(indices[place]);
    }
  }
  return triangles;
}

/// Points and lines.
void add_thin_faces(Mode mode, const std::vector<std::uint32_t>& indices, aiMesh& mesh) {
  const std::size_t count = face_count(mode, indices.size());
  mesh.mFaces = count > 0 ? new aiFace[count] : nullptr;
  mesh.mNumFaces = static_cast<unsigned>(count);
  for (std::size_t i = 0; i < count; ++i) {
    const FacePlaces places = places_of(mode, i, indices.size());
    aiFace& face = mesh.mFaces[i];
    face.mIndices = new unsigned[places.count];
    face.mNumIndices = static_cast<unsigned>(places.count);
    std::transform(places.begin(), places.end(), face.mIndices, [&](std::size_t place) { return indices[place]; });
  }
}

aiVector3D* vectors_of(const Values& values) {
  auto* const vectors = new aiVector3D[values.count()];
  for (std::size_t i = 0; i < values.count(); ++i) {
    vectors[i] = {values[i][0], values[i][1], values.width > 2 ? values[i][2] : 0};
  }
  return vectors;
}

aiColor4D* colors_of(const Values& values) {
  auto* const colors = new aiColor4D[values.count()];
  for (std::size_t i = 0; i < values.count(); ++i) {
    const auto color = values[i];
    colors[i] = {color[0], color[1], color[2], values.width == color_width ? color[3] : 1};
  }
  return colors;
}

/// glTF's t grows downwards, Assimp's upwards.
aiVector3D* places_of_vertices(const Values& values) {
  aiVector3D* const places = vectors_of(values);
  for (std::size_t i = 0; i < values.count(); ++i) {
    places[i].y = 1 - places[i].y;
  }
  return places;
}

void add_vertices(const Primitive& source, aiMesh& mesh) {
  mesh.mNumVertices = static_cast<unsigned>(source.attributes.at("POSITION").count());
  for (const auto& [name, values] : source.attributes) {
    if (name == "POSITION") {
      mesh.mVertices = vectors_of(values);
    } else if (name == "NORMAL") {
      mesh.mNormals = vectors_of(values);
    } else if (name == "COLOR_0") {
      mesh.mColors[0] = colors_of(values);
    } else if (name.starts_with("TEXCOORD_")) {
      const std::size_t set = std::stoul(name.substr(name.find('_') + 1));
      if (set < AI_MAX_NUMBER_OF_TEXTURECOORDS) {
        mesh.mTextureCoords[set] = places_of_vertices(values);
        mesh.mNumUVComponents[set] = 2;
      }
    }
  }
}

/// Throws, by its place, for joints without weights and the reverse.
Influences influences_of(const Part& primitive, Primitive& source) {
  Influences influences;
  for (std::size_t set = 0; set < set_count(primitive.get("attributes"), "JOINTS"); ++set) {
    const auto joints = source.attributes.find("JOINTS_" + std::to_string(set));
    const auto weights = source.attributes.find("WEIGHTS_" + std::to_string(set));
    if (joints == source.attributes.end() || weights == source.attributes.end()) {
      primitive.fail("has JOINTS_" + std::to_string(set) + " without WEIGHTS_" + std::to_string(set) + " beside it");
    }
    influences.joints.push_back(std::move(joints->second));
    influences.weights.push_back(std::move(weights->second));
  }
  return influences;
}

/// What apps/foreign/mesh/features.h counts and nobody looks into: morph targets are there, or not.
void mark_features(const Part& primitive, aiMesh& mesh) {
  if (!primitive.list("targets").empty()) {
    mesh.mAnimMeshes = new aiAnimMesh* [1] { new aiAnimMesh };
    mesh.mNumAnimMeshes = 1;
  }
}

void check_size(const Part& primitive, const Primitive& source) {
  constexpr std::size_t most = std::numeric_limits<unsigned>::max() / 3;  // each index of a strip may be in three triangles
  if (source.indices.size() > most || (!source.attributes.empty() && source.attributes.at("POSITION").count() > most)) {
    throw core::RoomError(primitive.where() + ": has more than " + grouped(most) + " vertices or corners: divide it");
  }
}

class Reader {
 public:
  Reader(const Document& document, Buffers& buffers, std::size_t material_count)
      : buffers_(buffers), accessors_(document, buffers), material_count_(material_count) {}

  std::unique_ptr<aiMesh> mesh(const Part& primitive, const std::string& name, FaceList& triangles, Meshes& result) {
    const Mode mode = mode_of(primitive);
    Primitive source = read_primitive(primitive, accessors_, buffers_);
    check_size(primitive, source);
    auto mesh = std::make_unique<aiMesh>();
    mesh->mName = name;
    // The last of the scene's is that of primitives without.
    mesh->mMaterialIndex =
        static_cast<unsigned>(primitive.index("material", material_count_ - 1, "materials").value_or(material_count_ - 1));
    if (!source.attributes.empty()) {
      add_vertices(source, *mesh);
      result.corners_left_over += mode == Mode::triangles ? source.indices.size() % 3 : 0;
      if (mode < Mode::triangles) {
        add_thin_faces(mode, source.indices, *mesh);
      } else {
        triangles = triangles_of(mode, std::move(source.indices));
      }
    }
    result.influences.push_back(source.attributes.empty() ? Influences{} : influences_of(primitive, source));
    mark_features(primitive, *mesh);
    return mesh;
  }

 private:
  Buffers& buffers_;
  Accessors accessors_;
  std::size_t material_count_;
};

}  // namespace

Meshes add_meshes(const Document& document, Buffers& buffers, ImportedFile& file) {
  aiScene& scene = *file.scene;
  Reader reader(document, buffers, scene.mNumMaterials);
  std::vector<std::unique_ptr<aiMesh>> all;
  Meshes result;
  for (const Part& source : document.root().list("meshes")) {
    const auto first = static_cast<unsigned>(all.size());
    for (const Part& primitive : source.list("primitives")) {
      FaceList& triangles = file.triangles.emplace_back();
      all.push_back(reader.mesh(primitive, source.text("name", source.where()), triangles, result));
    }
    result.ranges.emplace_back(first, static_cast<unsigned>(all.size()));
  }
  scene.mMeshes = new aiMesh*[all.size() + 1]();
  for (auto& mesh : all) {
    scene.mMeshes[scene.mNumMeshes] = mesh.release();
    ++scene.mNumMeshes;
  }
  return result;
}

}  // namespace dmpc::apps::gltf
