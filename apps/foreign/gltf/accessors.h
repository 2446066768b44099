// The numbers of a glTF document: its accessors, as floats or indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "apps/foreign/gltf/buffers.h"
#include "apps/foreign/mesh/scene_totals.h"

namespace dmpc::apps::gltf {

/// Vectors of `width` numbers each, one after the other.
struct Values {
  std::size_t width = 0;
  std::vector<float> numbers;

  std::size_t count() const { return width == 0 ? 0 : numbers.size() / width; }
  std::span<const float> operator[](std::size_t i) const { return std::span(numbers).subspan(i * width, width); }
};

/// Reads accessors: dense, interleaved, sparse or without a view (zeros). Throws core::InputError, with the place in the
/// document, for data that exceed their view or are not of the expected kind; core::CapacityError for zeros that exceed the
/// memory.
class Accessors {
 public:
  Accessors(const Document& document, Buffers& buffers, SceneTotals& totals)
      : buffers_(buffers), totals_(totals), accessors_(document.root().list("accessors")) {}

  std::size_t count() const { return accessors_.size(); }

  /// The accessor at `where`, whose vectors have `width` or `other_width` numbers; integers as the file says: normalised to -1 or
  /// 0 to 1, or unchanged (KHR_mesh_quantization).
  Values values(const Part& where, std::size_t width, std::size_t other_width = 0);
  /// Non-negative integers.
  std::vector<std::uint32_t> indices(const Part& where);
  /// The number of its vectors.
  std::uint64_t count_of(const Part& where);

 private:
  const Part& accessor(const Part& where) const;

  Buffers& buffers_;
  SceneTotals& totals_;
  std::vector<Part> accessors_;
};

}  // namespace dmpc::apps::gltf
