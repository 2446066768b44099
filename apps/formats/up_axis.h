// The axis that points up in a scene.
#pragma once

#include <cstddef>
#include <string>

namespace dmpc::apps {

struct UpAxis {
  std::size_t axis = 1;      ///< 0 x, 1 y, 2 z
  bool is_negative = false;  ///< up is the negative direction

  bool operator==(const UpAxis&) const = default;
};

/// "z" or "-z".
inline std::string text_of(const UpAxis& up) { return (up.is_negative ? "-" : "") + std::string(1, "xyz"[up.axis]); }
/// Requires a text of text_of().
inline UpAxis up_axis_of(const std::string& text) { return {static_cast<std::size_t>(text.back() - 'x'), text.front() == '-'}; }

}  // namespace dmpc::apps
