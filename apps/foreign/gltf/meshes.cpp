#include "apps/foreign/gltf/meshes.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <string>

#include "apps/frontend/line/number_text.h"
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

/// Which indices triangle `i` takes; every second one of a strip is turned, so that all look to one side.
std::array<std::size_t, 3> places_of(Mode mode, std::size_t i) {
  if (mode == Mode::triangle_fan) {
    return {0, i + 1, i + 2};
  }
  return i % 2 == 0 ? std::array{i, i + 1, i + 2} : std::array{i + 1, i, i + 2};
}

/// A list of triangles stays as it is.
FaceList triangles_of(Mode mode, std::vector<std::uint32_t> indices) {
  const std::size_t count = face_count(mode, indices.size());
  if (mode == Mode::triangles) {
    indices.resize(3 * count);
    return triangle_list(std::move(indices));
  }
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i) {
    for (const std::size_t place : places_of(mode, i)) {
      corners.push_back(indices[place]);
    }
  }
  return triangle_list(std::move(corners));
}

std::vector<core::Vec3d> vectors_of(const Values& values) {
  std::vector<core::Vec3d> vectors;
  vectors.reserve(values.count());
  for (std::size_t i = 0; i < values.count(); ++i) {
    const auto vector = values[i];
    vectors.push_back({double{vector[0]}, double{vector[1]}, double{vector[2]}});
  }
  return vectors;
}

/// None if all are white and whole.
void add_colors(const Values& values, PolygonMesh& mesh) {
  if (values.width == color_width) {
    for (std::size_t i = 0; i < values.count(); ++i) {
      mesh.alphas.push_back(double{values[i][3]});
    }
    if (std::ranges::all_of(mesh.alphas, [](double alpha) { return alpha >= 1; })) {
      mesh.alphas = {};
    }
  }
  mesh.colors = vectors_of(values);
  if (mesh.alphas.empty() && std::ranges::all_of(mesh.colors, [](const auto& color) { return color == core::Vec3d{1, 1, 1}; })) {
    mesh.colors = {};
  }
}

std::vector<std::array<float, 2>> places_of(const Values& values) {
  std::vector<std::array<float, 2>> places(values.count());
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = {values[i][0], values[i][1]};
  }
  return places;
}

/// `coordinates`: the set of places that its material's texture lies by.
void add_vertices(const Primitive& source, const std::optional<std::uint64_t>& coordinates, PolygonMesh& mesh) {
  const auto with = [&](const std::string& name, const auto& take) {
    if (const auto found = source.attributes.find(name); found != source.attributes.end()) {
      take(found->second);
    }
  };
  with("POSITION", [&](const Values& values) { mesh.vertices = vectors_of(values); });
  with("NORMAL", [&](const Values& values) { mesh.normals = vectors_of(values); });
  with("COLOR_0", [&](const Values& values) { add_colors(values, mesh); });
  if (coordinates) {
    with("TEXCOORD_" + std::to_string(*coordinates), [&](const Values& values) { mesh.places = places_of(values); });
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

void check_size(const Part& primitive, const Primitive& source) {
  constexpr std::size_t most = std::numeric_limits<unsigned>::max() / 3;  // each index of a strip may be in three triangles
  if (source.indices.size() > most || (!source.attributes.empty() && source.attributes.at("POSITION").count() > most)) {
    throw core::CapacityError(primitive.where() + ": has more than " + grouped(most) + " vertices or corners: divide it");
  }
}

class PrimitiveReader {
 public:
  PrimitiveReader(Buffers& buffers, Accessors& accessors, const std::vector<MaterialTraits>& materials, SceneTotals& totals)
      : buffers_(buffers), accessors_(accessors), materials_(materials), totals_(totals) {}

  void add(const Part& primitive, const std::string& name, Meshes& result) {
    const Mode mode = mode_of(primitive);
    Primitive source = read_primitive(primitive, accessors_, buffers_);
    check_size(primitive, source);
    const std::size_t last = materials_.size() - 1;
    PrimitiveMesh read{.mesh = {.name = "mesh " + std::to_string(result.list.size()) + " '" + name + "'",
                                .material = primitive.index("material", last, "materials").value_or(last),
                                .is_by_vertex = true},
                       .influences = {}};
    read.has_targets = !primitive.list("targets").empty();
    if (!source.attributes.empty()) {
      read.influences = influences_of(primitive, source);
      read.has_several_places = source.attributes.contains("TEXCOORD_1");
      result.corners_left_over += mode == Mode::triangles ? source.indices.size() % 3 : 0;
      if (mode < Mode::triangles) {
        read.thin_faces = face_count(mode, source.indices.size());
      } else {
        const auto where = [&primitive] { return primitive.where() + ": "; };
        const std::uint64_t faces = face_count(mode, source.indices.size());
        totals_.ask(size_of_faces(faces, 3 * faces), where);
        add_vertices(source, materials_[read.mesh.material].coordinates, read.mesh);
        read.mesh.faces = triangles_of(mode, std::move(source.indices));
        totals_.add(size_of(read.mesh), where);
        totals_.add({.bytes = read.influences.joints.size() * read.mesh.vertices.size() * 8 * sizeof(float)}, where);
      }
    }
    result.list.push_back(std::move(read));
  }

 private:
  Buffers& buffers_;
  Accessors& accessors_;
  const std::vector<MaterialTraits>& materials_;
  SceneTotals& totals_;
};

}  // namespace

Meshes read_meshes(const Document& document, Buffers& buffers, Accessors& accessors, const std::vector<MaterialTraits>& materials,
                   SceneTotals& totals) {
  PrimitiveReader reader(buffers, accessors, materials, totals);
  Meshes result;
  for (const Part& source : document.root().list("meshes")) {
    const std::size_t first = result.list.size();
    for (const Part& primitive : source.list("primitives")) {
      reader.add(primitive, source.text("name", source.where()), result);
    }
    result.ranges.emplace_back(first, result.list.size());
  }
  return result;
}

}  // namespace dmpc::apps::gltf
