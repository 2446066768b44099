// The data of one primitive of a glTF mesh, compressed or not.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "apps/foreign/gltf/accessors.h"

namespace dmpc::apps::gltf {

struct Primitive {
  /// POSITION, NORMAL, all TEXCOORD_n, JOINTS_n and WEIGHTS_n, and COLOR_0, if present, with equal numbers of vectors.
  std::map<std::string, Values> attributes;
  std::vector<std::uint32_t> indices;  ///< valid vertices; 0, 1, 2, ... where the file has none
};

/// Numbers of a colour: with alpha, and without.
inline constexpr std::size_t color_width = 4, opaque_color_width = 3;

/// Reads a primitive, also one compressed by Draco (KHR_draco_mesh_compression). Without POSITION it is empty. Throws
/// core::InputError, with the place in the document, for attributes of different counts and indices out of range.
Primitive read_primitive(const Part& primitive, Accessors& accessors, Buffers& buffers);

/// Reads a primitive compressed by Draco. `widths`: the attributes to read, and their numbers per vector. Throws core::InputError
/// for bytes that Draco cannot decompress.
Primitive read_draco(const Part& packing, Buffers& buffers, const std::map<std::string, std::size_t>& widths);

/// The number of consecutive attributes `name`_0, `name`_1, ...
std::size_t set_count(const Part& attributes, const std::string& name);

}  // namespace dmpc::apps::gltf
