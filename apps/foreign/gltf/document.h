// A glTF document: the JSON of a .gltf, or of a .glb with its binary chunk.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "apps/foreign/gltf/part.h"

namespace dmpc::apps::gltf {

struct Document {
  nlohmann::json json;
  std::optional<std::span<const std::byte>> chunk;  ///< part of the file's bytes

  Part root() const { return Part(json); }
};

/// Parses a file, whose bytes outlive the document. Throws core::InputError for a file that is no glTF as a whole: other
/// versions, truncated chunks, truncated JSON.
Document parse_document(std::span<const std::byte> file);

}  // namespace dmpc::apps::gltf
