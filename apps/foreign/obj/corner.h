// A corner of a face in an OBJ file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "apps/foreign/text/line_words.h"

namespace dmpc::apps::obj {

/// What a corner names, in the order in which it does.
enum class Named : std::size_t { vertex, place, normal };
constexpr std::size_t named_count = 3;

/// How many vertices, places and normals there are, by Named.
using Counts = std::array<std::uint64_t, named_count>;

/// From 0, or `none` of geometry.h for what the corner does not name.
using Corner = std::array<std::uint32_t, named_count>;

/// Reads corners: "3", "3/1", "3//2" or "3/1/2", from 1, or from -1 backwards. What is named before it is there is remembered.
class CornerReader {
 public:
  /// Throws core::InputError, with the line of `words`, whose last word `word` is, for what is no corner, or what cannot exist.
  Corner read(std::string_view word, const LineWords& words, const Counts& so_far);
  /// Throws core::InputError, with the line, for the first corner that names what is not even there at the end.
  void check_named(const Counts& all) const;

 private:
  std::uint32_t index(std::string_view text, std::size_t kind, const LineWords& words, const Counts& so_far);

  /// One that names more than all before it.
  struct Later {
    std::uint64_t index;
    std::size_t line;
  };
  std::array<std::vector<Later>, named_count> later_;
};

}  // namespace dmpc::apps::obj
