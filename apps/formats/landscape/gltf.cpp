#include "apps/formats/landscape/gltf.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "core/base/vec.h"

namespace dmpc::apps {

namespace {

using Json = nlohmann::ordered_json;

constexpr int real_number = 5126, whole_number = 5125;  // componentType: float, unsigned int

/// Gathers arrays in one buffer, each an accessor of its own.
class Buffer {
 public:
  /// The number of the new accessor; its rows are `type`s.
  template <class T>
  std::size_t add(const std::vector<T>& rows, const std::string& type, int number) {
    const std::size_t bytes = rows.size() * sizeof(T);
    views.push_back({{"buffer", 0}, {"byteOffset", numbers.size()}, {"byteLength", bytes}});
    numbers.append(reinterpret_cast<const char*>(rows.data()), bytes);
    accessors.push_back({{"bufferView", views.size() - 1}, {"componentType", number}, {"count", rows.size()}, {"type", type}});
    return accessors.size() - 1;
  }

  /// With the bounds that glTF asks for.
  std::size_t add_positions(const std::vector<LandscapeMesh::Point>& positions) {
    LandscapeMesh::Point low = positions.front(), high = low;
    for (const LandscapeMesh::Point& position : positions) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], position[axis]);
        high[axis] = std::max(high[axis], position[axis]);
      }
    }
    const std::size_t accessor = add(positions, "VEC3", real_number);
    accessors[accessor]["min"] = low;
    accessors[accessor]["max"] = high;
    return accessor;
  }

  std::string numbers;
  Json views = Json::array(), accessors = Json::array();
};

Json primitive_json(const LandscapeMesh& mesh, std::size_t material, Buffer& buffer) {
  Json attributes = {{"POSITION", buffer.add_positions(mesh.positions)},
                     {"NORMAL", buffer.add(mesh.normals, "VEC3", real_number)}};
  if (!mesh.places.empty()) {
    attributes["TEXCOORD_0"] = buffer.add(mesh.places, "VEC2", real_number);
  }
  return {{"attributes", attributes}, {"indices", buffer.add(mesh.indices, "SCALAR", whole_number)}, {"material", material}};
}

Json mesh_json(const LandscapeMesh& mesh, std::size_t material, Buffer& buffer) {
  return {{"primitives", Json::array({primitive_json(mesh, material, buffer)})}};
}

/// A camera's place and directions, column by column.
Json camera_matrix(const core::Vec3d& from, const core::Vec3d& at) {
  const core::Vec3d back = core::normalize(from - at), right = core::normalize(core::cross({0, 1, 0}, back));
  const core::Vec3d up = core::cross(back, right);
  Json matrix = Json::array();
  for (const core::Vec3d& column : {right, up, back, from}) {
    for (const double number : {column.x, column.y, column.z}) {
      matrix.push_back(number);
    }
    matrix.push_back(matrix.size() == 15 ? 1 : 0);
  }
  return matrix;
}

Json materials_json() {
  const Json ground = {{"baseColorTexture", {{"index", 0}}}, {"metallicFactor", 0}, {"roughnessFactor", 1}};
  const Json lake = {{"baseColorFactor", Json::array({0.25, 0.4, 0.5, 1})}, {"metallicFactor", 1}, {"roughnessFactor", 0}};
  return Json::array(
      {{{"name", "ground"}, {"pbrMetallicRoughness", ground}}, {{"name", "lake"}, {"pbrMetallicRoughness", lake}}});
}

Json rough_json(const std::string& name, const Json& color) {
  return {{"name", name}, {"pbrMetallicRoughness", {{"baseColorFactor", color}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}};
}

/// A mesh of bark and leaves for each kind of tree that stands somewhere, and a node that puts it in all its places.
void add_trees(const Grove& grove, Json& json, Buffer& buffer) {
  static const std::array<Json, tree_kinds> greens{Json::array({0.05, 0.14, 0.06, 1}), Json::array({0.16, 0.27, 0.05, 1}),
                                                   Json::array({0.04, 0.1, 0.07, 1}), Json::array({0.24, 0.28, 0.06, 1})};
  const std::size_t bark = json["materials"].size();
  json["materials"].push_back(rough_json("bark", Json::array({0.2, 0.13, 0.08, 1})));
  json["extensionsUsed"] = json["extensionsRequired"] = Json::array({"EXT_mesh_gpu_instancing"});
  for (std::size_t kind = 0; kind < tree_kinds; ++kind) {
    const TreePlaces& places = grove.places[kind];
    if (places.translations.empty()) {
      continue;
    }
    json["materials"].push_back(rough_json("leaves", greens[kind]));
    const Json primitives = Json::array({primitive_json(grove.trees[kind].bark, bark, buffer),
                                         primitive_json(grove.trees[kind].leaves, json["materials"].size() - 1, buffer)});
    json["meshes"].push_back({{"name", "tree"}, {"primitives", primitives}});
    const Json attributes = {{"TRANSLATION", buffer.add(places.translations, "VEC3", real_number)},
                             {"ROTATION", buffer.add(places.rotations, "VEC4", real_number)},
                             {"SCALE", buffer.add(places.scales, "VEC3", real_number)}};
    json["scenes"][0]["nodes"].push_back(json["nodes"].size());
    json["nodes"].push_back(
        {{"mesh", json["meshes"].size() - 1}, {"extensions", {{"EXT_mesh_gpu_instancing", {{"attributes", attributes}}}}}});
  }
}

}  // namespace

LandscapeGltf landscape_gltf(const LandscapeMesh& ground, const LandscapeMesh& lake, const std::string& numbers_name,
                             const std::string& picture_name, const Grove* trees) {
  Buffer buffer;
  const Json meshes = Json::array({mesh_json(ground, 0, buffer), mesh_json(lake, 1, buffer)});
  const Json perspective = {{"aspectRatio", 1}, {"yfov", 0.8}, {"znear", 0.01}};
  Json json = {{"asset", {{"version", "2.0"}, {"generator", "dmpc"}}}, {"scene", 0}};
  json["scenes"] = Json::array({{{"nodes", {0, 1, 2}}}});
  json["nodes"] =
      Json::array({{{"mesh", 0}},
                   {{"mesh", 1}},
                   {{"name", "camera"}, {"camera", 0}, {"matrix", camera_matrix({-0.12, 0.11, 0.52}, {-0.02, 0.12, 0})}}});
  json["cameras"] = Json::array({{{"type", "perspective"}, {"perspective", perspective}}});
  json["meshes"] = meshes;
  json["materials"] = materials_json();
  json["textures"] = Json::array({{{"source", 0}, {"sampler", 0}}});
  json["samplers"] = Json::array({{{"wrapS", 33071}, {"wrapT", 33071}}});  // the edge goes on
  json["images"] = Json::array({{{"uri", picture_name}}});
  if (trees != nullptr) {
    add_trees(*trees, json, buffer);
  }
  json["accessors"] = buffer.accessors;
  json["bufferViews"] = buffer.views;
  json["buffers"] = Json::array({{{"uri", numbers_name}, {"byteLength", buffer.numbers.size()}}});
  return {json.dump(1) + "\n", std::move(buffer.numbers)};
}

}  // namespace dmpc::apps
