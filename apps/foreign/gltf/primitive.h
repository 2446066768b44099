// The numbers of one primitive of a glTF mesh, wherever they come from.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "apps/foreign/gltf/accessors.h"

namespace dmpc::apps::gltf {

struct Primitive {
  std::map<std::string, Values> attributes;  ///< POSITION, NORMAL and all TEXCOORD_n, JOINTS_n and WEIGHTS_n, as many each
  std::vector<std::uint32_t> indices;        ///< of vertices that exist; 0, 1, 2, ... where the file has none
};

/// Plain or packed by Draco (KHR_draco_mesh_compression). One without POSITION is empty. Throws core::InputError, by its place in
/// the document, for attributes of different counts and indices out of range.
Primitive read_primitive(const Part& primitive, Accessors& accessors, Buffers& buffers);

/// The first number of attributes that are called `name`_0, `name`_1, ... and follow each other.
std::size_t set_count(const Part& attributes, const std::string& name);

}  // namespace dmpc::apps::gltf
