#include <bit>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "apps/formats/view_faults.h"
#include "apps/frontend/system/base64.h"
#include "apps/lab/oracle/places/file_places.h"

namespace dmpc::apps {
namespace {

using core::Vec3d;
using PlacesJson = nlohmann::json;
using Numbers = std::vector<double>;
using JsonPointer = PlacesJson::json_pointer;

struct GltfFile {
  PlacesJson json;
  std::string chunk;
  const BytesOfNamed& bytes_of;
  FilePlaces& places;
  std::map<const PlacesJson*, std::string> buffers = {};
  std::multimap<std::size_t, core::View> cameras = {};  ///< by their indices in the document, then in the order of the tree
};

std::size_t whole(double number) {
  if (!(number >= 0 && number < 0x1p53 && number == std::floor(number))) {
    throw core::InputError("an index or a count of it is none");
  }
  return static_cast<std::size_t>(number);
}

/// Returns the element of the document's list that a member of `part` refers to.
const PlacesJson& listed(const GltfFile& file, const char* list, const PlacesJson& part, const char* name) {
  return file.json.at(list).at(whole(part.at(name).get<double>()));
}

std::size_t bytes_of_type(std::size_t type) { return type < 5122 ? 1 : type < 5124 ? 2 : 4; }

/// Reads a number of OpenGL's types: floats and integers; even type numbers are signed.
double number_at(const char* bytes, std::size_t type, bool is_normalized) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, bytes, bytes_of_type(type));
  if (type == 5126) {
    return double{std::bit_cast<float>(bits)};
  }
  const double all = std::exp2(8.0 * static_cast<double>(bytes_of_type(type))), half = type % 2 == 0 ? all / 2 : all;
  const double read = static_cast<double>(bits), value = read < half ? read : read - all;
  return is_normalized ? std::max(value / (half - 1), -1.0) : value;
}

const std::string& buffer_of(GltfFile& file, const PlacesJson& view) {
  const PlacesJson& buffer = listed(file, "buffers", view, "buffer");
  const auto [known, is_new] = file.buffers.try_emplace(&buffer, file.chunk);
  if (is_new && buffer.contains("uri")) {
    const auto& uri = buffer.at("uri").get_ref<const std::string&>();
    const std::size_t coding = uri.find(";base64,");
    if (!uri.starts_with("data:")) {
      known->second = file.bytes_of(uri);
    } else if (const auto bytes = bytes_of_base64(std::string_view(uri).substr(std::min(coding, uri.size() - 8) + 8))) {
      known->second.assign(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    }
  }
  return known->second;
}

/// Calls take(i, bytes) for `count` elements at the location given by `part`.
template <class Take>
void for_each_element(GltfFile& file, const PlacesJson& part, std::size_t count, std::size_t element_bytes, const Take& take) {
  const PlacesJson& view = listed(file, "bufferViews", part, "bufferView");
  const std::string& all = buffer_of(file, view);
  const std::size_t begin = whole(view.value("byteOffset", 0.0)), room = whole(view.at("byteLength").get<double>());
  const std::size_t end = std::min(begin + room, all.size()), step = std::min(whole(view.value("byteStride", 0.0)), all.size());
  std::size_t at = begin + whole(part.value("byteOffset", 0.0));
  for (std::size_t i = 0; i < count; ++i, at += step == 0 ? element_bytes : step) {
    if (at + element_bytes > end) {
      throw core::InputError("an accessor of it reaches beyond its bytes");
    }
    take(i, all.data() + at);
  }
}

/// Returns all values of the accessor that `part` names, `width` for each of its elements.
Numbers numbers_of(GltfFile& file, const PlacesJson& part, const char* name, std::size_t width) {
  const PlacesJson& accessor = listed(file, "accessors", part, name);
  const std::size_t count = whole(accessor.at("count").get<double>()), type = whole(accessor.at("componentType").get<double>());
  file.places.spend(count);
  Numbers numbers(count * width);
  const auto put = [&, is_normalized = accessor.value("normalized", false)](std::size_t i, const char* bytes) {
    for (std::size_t k = 0; k < width; ++k) {
      numbers.at(i * width + k) = number_at(bytes + k * bytes_of_type(type), type, is_normalized);
    }
  };
  if (accessor.contains("bufferView")) {
    for_each_element(file, accessor, count, width * bytes_of_type(type), put);
  }
  if (accessor.contains("sparse")) {
    const PlacesJson &sparse = accessor.at("sparse"), &replaced = sparse.at("indices");
    const std::size_t some = whole(sparse.at("count").get<double>()), index = whole(replaced.at("componentType").get<double>());
    file.places.spend(some);
    std::vector<std::size_t> indices;
    for_each_element(file, replaced, some, bytes_of_type(index),
                     [&](std::size_t, const char* at) { indices.push_back(whole(number_at(at, index, false))); });
    for_each_element(file, sparse.at("values"), some, width * bytes_of_type(type),
                     [&](std::size_t i, const char* at) { put(indices[i], at); });
  }
  return numbers;
}

/// The axes and the origin of a node's coordinates.
struct NodeAxes {
  Vec3d x, y, z, origin;

  Vec3d direction(const Vec3d& v) const { return x * v.x + y * v.y + z * v.z; }
  Vec3d point(const Vec3d& v) const { return direction(v) + origin; }
  NodeAxes below(const NodeAxes& above) const {
    return {above.direction(x), above.direction(y), above.direction(z), above.point(origin)};
  }
};

/// A quaternion (q, w) rotates v to v + 2 w (q x v) + 2 q x (q x v).
NodeAxes axes_of_node(const PlacesJson& node) {
  const auto vector = [](const Numbers& from, std::size_t i) { return Vec3d{from.at(i), from.at(i + 1), from.at(i + 2)}; };
  if (node.contains("matrix")) {
    const Numbers m = node.at("matrix");
    return {vector(m, 0), vector(m, 4), vector(m, 8), vector(m, 12)};
  }
  const Numbers turn = node.value("rotation", Numbers{0, 0, 0, 1});
  const Vec3d q = vector(turn, 0), scale = vector(node.value("scale", Numbers{1, 1, 1}), 0);
  const auto turned = [&](const Vec3d& v) { return v + (cross(q, v) * turn.at(3) + cross(q, cross(q, v))) * 2.0; };
  return {turned({scale.x, 0, 0}), turned({0, scale.y, 0}), turned({0, 0, scale.z}),
          vector(node.value("translation", Numbers{0, 0, 0}), 0)};
}

/// Returns whether a mask that no texture raises to its cutoff hides the whole primitive.
bool is_cut_away(const GltfFile& file, const PlacesJson& primitive) {
  static const PlacesJson plain = PlacesJson::object();
  const PlacesJson& material = primitive.contains("material") ? listed(file, "materials", primitive, "material") : plain;
  const double alpha = material.value(JsonPointer("/pbrMetallicRoughness/baseColorFactor/3"), 1.0);
  return material.value("alphaMode", "OPAQUE") == "MASK" && std::min(alpha, 1.0) < material.value("alphaCutoff", 0.5);
}

void add_primitive(GltfFile& file, const PlacesJson& primitive, const NodeAxes& axes) {
  const std::size_t mode = whole(primitive.value("mode", 4.0));  // from 4 on: a list of triangles, a strip, a fan
  file.places.spend(1);
  if (mode < 4 || !primitive.at("attributes").contains("POSITION") || is_cut_away(file, primitive)) {
    return;
  }
  const Numbers points = numbers_of(file, primitive.at("attributes"), "POSITION", 3);
  const bool has_indices = primitive.contains("indices");
  const Numbers indices = has_indices ? numbers_of(file, primitive, "indices", 1) : Numbers();
  const auto corner = [&](std::size_t i) {
    const std::size_t first = 3 * (has_indices ? whole(indices[i]) : i);
    return axes.point({points.at(first), points.at(first + 1), points.at(first + 2)});
  };
  for (std::size_t i = 0; i + 2 < (has_indices ? indices.size() : points.size() / 3); i += mode == 4 ? 3 : 1) {
    file.places.add({corner(mode == 6 ? 0 : i), corner(i + 1), corner(i + 2)});
  }
}

/// A glTF angle spans the vertical from edge to edge, a view's spans the middles of the outer pixels of the shorter side.
core::View view_of_camera(const PlacesJson& camera, const NodeAxes& axes, const Resolution& size) {
  const double angle = camera.value(JsonPointer("/perspective/yfov"), 0.0);
  const double slope = std::tan(angle / 2) * std::max(1, std::min(size.width, size.height) - 1) / size.height;
  const double far = std::max(1.0, largest_component(axes.origin));  // keeps the digits of the direction at a distant position
  return {.from = axes.origin,
          .at = axes.origin - axes.z * far,
          .up = axes.y,
          .angle_degrees = 2 * std::atan(slope) * 180 / std::numbers::pi};
}

/// Adds the node with its subtree. A hidden node has nothing to show.
void add_node(GltfFile& file, const PlacesJson& index, const NodeAxes& above, const Resolution& size, int level) {
  constexpr int levels_max = 2000;
  const PlacesJson& node = file.json.at("nodes").at(whole(index.get<double>()));
  file.places.spend(1);
  if (level > levels_max) {
    throw core::InputError("its nodes hang below each other more than 2000 deep");
  }
  if (!node.value(JsonPointer("/extensions/KHR_node_visibility/visible"), true)) {
    return;
  }
  const NodeAxes axes = axes_of_node(node).below(above);
  if (node.contains("camera")) {
    file.cameras.emplace(whole(node.at("camera").get<double>()),
                         view_of_camera(listed(file, "cameras", node, "camera"), axes, size));
  }
  if (node.contains("mesh")) {
    for (const PlacesJson& primitive : listed(file, "meshes", node, "mesh").at("primitives")) {
      add_primitive(file, primitive, axes);
    }
  }
  if (node.contains("children")) {
    for (const PlacesJson& child : node.at("children")) {
      add_node(file, child, axes, size, level + 1);
    }
  }
}

/// Returns the chunk of a .glb that begins there.
std::string_view chunk_at(std::string_view file, std::size_t at) {
  std::uint32_t bytes = 0;
  if (at + 8 > file.size()) {
    return {};
  }
  std::memcpy(&bytes, file.data() + at, sizeof bytes);
  return file.substr(at + 8, bytes);
}

}  // namespace

void read_gltf_places(const std::string& file, const BytesOfNamed& bytes_of, double scale, const Resolution& size,
                      FilePlaces& places) {
  const bool is_binary = file.starts_with("glTF");
  const std::string_view text = is_binary ? chunk_at(file, 12) : file;
  for (const std::string unknown : {"KHR_draco_mesh_compression", "EXT_meshopt_compression", "EXT_mesh_gpu_instancing",
                                    "KHR_materials_pbrSpecularGlossiness", "\"skin\"", "\"targets\""}) {
    if (text.find(unknown) != std::string_view::npos) {
      throw core::InputError("it has " + unknown + ", which the oracle does not read");
    }
  }
  if (text.size() > std::size_t{1} << 26U) {
    throw core::InputError("it has more than 64 MiB of JSON");
  }
  GltfFile read{.json = PlacesJson::parse(text.begin(), text.end()), .chunk = {}, .bytes_of = bytes_of, .places = places};
  read.chunk = is_binary ? chunk_at(file, 20 + text.size()) : std::string_view();
  const PlacesJson& scene = read.json.at("scenes").at(whole(read.json.value("scene", 0.0)));
  for (const PlacesJson& root : scene.value("nodes", PlacesJson::array())) {
    add_node(read, root, {{scale, 0, 0}, {0, scale, 0}, {0, 0, scale}, {}}, size, 0);
  }
  for (const auto& [index, view] : read.cameras) {  // the first that gives a picture
    places.view = places.view || fault_of(view) ? places.view : std::optional(view);
  }
}

}  // namespace dmpc::apps
