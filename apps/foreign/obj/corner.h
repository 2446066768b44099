// A corner of a face in an OBJ file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "apps/foreign/text/line_words.h"

namespace dmpc::apps::obj {

/// The elements that a corner refers to, in the order of the corner's numbers.
enum class Named : std::size_t { vertex, place, normal };
constexpr std::size_t named_count = 3;

/// Numbers of vertices, texture coordinates and normals, indexed by Named.
using Counts = std::array<std::uint64_t, named_count>;

/// Indices from 0, or `none` (apps/foreign/obj/geometry.h) for an element that the corner does not refer to.
using Corner = std::array<std::uint32_t, named_count>;

/// Parses corners: "3", "3/1", "3//2" or "3/1/2", counted from 1, or from -1 backwards. References to elements that are defined
/// later are remembered and checked at the end.
class CornerReader {
 public:
  /// Parses `word`, the last one of `words`. Throws core::InputError, with the line, for a malformed corner or impossible index.
  Corner read(std::string_view word, const LineWords& words, const Counts& so_far);
  /// Throws core::InputError, with the line, for the first corner that refers to an element that the whole file does not define.
  void check_named(const Counts& all) const;

 private:
  std::uint32_t index(std::string_view text, std::size_t kind, const LineWords& words, const Counts& so_far);

  /// A corner that refers to an element beyond all earlier references.
  struct Later {
    std::uint64_t index;
    std::size_t line;
  };
  std::array<std::vector<Later>, named_count> later_;
};

}  // namespace dmpc::apps::obj
