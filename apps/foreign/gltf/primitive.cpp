#include "apps/foreign/gltf/primitive.h"

#include <algorithm>
#include <numeric>

namespace dmpc::apps::gltf {
namespace {

/// TEXCOORD_1 without TEXCOORD_0 would be taken for it by some and left out by others.
void check_sets(const Part& attributes) {
  for (const auto& [name, part] : attributes.members()) {
    const std::string first = name.substr(0, name.find('_') + 1);
    const bool has_sets = first == "TEXCOORD_" || first == "COLOR_" || first == "JOINTS_" || first == "WEIGHTS_";
    const std::string number = name.substr(first.size());
    if (has_sets && number != "0" && (number.empty() || !attributes.find(first + "0"))) {
      part.fail("attributes of this kind are numbered from 0 on, and there is no " + first + "0");
    }
  }
}

/// Names of what is read, and how many numbers each has; colours may have one fewer.
std::map<std::string, std::size_t> wanted(const Part& attributes) {
  std::map<std::string, std::size_t> widths;
  if (attributes.find("POSITION")) {
    widths["POSITION"] = 3;
    if (attributes.find("NORMAL")) {
      widths["NORMAL"] = 3;
    }
    for (std::size_t i = 0; i < set_count(attributes, "TEXCOORD"); ++i) {
      widths["TEXCOORD_" + std::to_string(i)] = 2;
    }
    for (const std::string kind : {"JOINTS", "WEIGHTS"}) {
      for (std::size_t i = 0; i < set_count(attributes, kind); ++i) {
        widths[kind + "_" + std::to_string(i)] = 4;
      }
    }
    if (attributes.find("COLOR_0")) {
      widths["COLOR_0"] = color_width;
    }
  }
  return widths;
}

void check_counts(const Primitive& result, const Part& attributes) {
  for (const auto& [name, values] : result.attributes) {
    const std::size_t expected = result.attributes.at("POSITION").count();
    if (values.count() != expected) {
      attributes.get(name).fail("has " + std::to_string(values.count()) + " vectors, expected as many as POSITION has, " +
                                std::to_string(expected));
    }
  }
}

void check_indices(const Primitive& result, const Part& primitive) {
  const std::size_t count = result.attributes.at("POSITION").count();
  std::uint32_t most = 0;
  for (const std::uint32_t index : result.indices) {  // many at once, by vectors
    most = std::max(most, index);
  }
  if (most < count || result.indices.empty()) {
    return;
  }
  for (std::size_t i = 0; i < result.indices.size(); ++i) {
    if (result.indices[i] >= count) {
      primitive.fail("index " + std::to_string(i) + " is of vertex " + std::to_string(result.indices[i]) +
                     ", which does not exist: there are " + std::to_string(count));
    }
  }
}

Primitive read_plain(const Part& primitive, Accessors& accessors) {
  const Part attributes = primitive.get("attributes");
  check_sets(attributes);
  Primitive result;
  for (const auto& [name, width] : wanted(attributes)) {
    result.attributes[name] = accessors.values(attributes.get(name), width, name == "COLOR_0" ? opaque_color_width : 0);
  }
  if (const auto indices = primitive.find("indices")) {
    result.indices = accessors.indices(*indices);
  } else if (!result.attributes.empty()) {
    result.indices.resize(result.attributes.at("POSITION").count());
    std::iota(result.indices.begin(), result.indices.end(), 0U);
  }
  return result;
}

}  // namespace

Primitive read_primitive(const Part& primitive, Accessors& accessors, Buffers& buffers) {
  const auto packing = primitive.extension("KHR_draco_mesh_compression");
  Primitive result =
      packing ? read_draco(*packing, buffers, wanted(packing->get("attributes"))) : read_plain(primitive, accessors);
  if (result.attributes.empty()) {
    return {};
  }
  check_counts(result, primitive.get("attributes"));
  check_indices(result, primitive);
  return result;
}

std::size_t set_count(const Part& attributes, const std::string& name) {
  std::size_t count = 0;
  while (attributes.find(name + "_" + std::to_string(count))) {
    ++count;
  }
  return count;
}

}  // namespace dmpc::apps::gltf
