// The values of a PLY file's body, in order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/polygon/ply_header.h"

namespace dmpc::apps {

/// Thrown if the body ends within an element.
struct PlyIsShort {};

class PlyValues {
 public:
  virtual ~PlyValues() = default;

  /// Begins an element. In text it starts a line, or follows another on the same line provided that no values remain at the end.
  virtual void begin_element() = 0;
  /// Throws PlyIsShort at the end, and core::InputError, with the position, for an invalid value of the type.
  virtual double next(PlyType type) = 0;
  /// Returns the length of a list of `type`, bounded by the remaining bytes. Throws the exceptions of next().
  virtual std::uint64_t next_length(PlyType count_type, PlyType type) = 0;
  /// Replaces `values` by a list's values. Throws the exceptions of next().
  virtual void next_list(PlyType count_type, PlyType type, std::vector<double>& values) = 0;
  virtual void skip(PlyType type, std::uint64_t count) = 0;

  /// Returns an upper bound on the number of elements for which there are bytes.
  virtual std::uint64_t room_for(const PlyElement& element) const = 0;
  /// Returns the number of bytes after the last element. Throws core::InputError if lines contained superfluous values.
  virtual std::uint64_t count_rest() = 0;
  /// Returns the number of bytes read.
  virtual std::size_t position() const = 0;
  /// Returns a possible reason for a later error, to be appended to its message: " (...)", or nothing.
  virtual std::string doubt() const { return ""; }
  /// Returns the position of the last value, "line 7" or "byte 1234".
  virtual std::string place() const = 0;
};

/// `file` outlives the result.
std::unique_ptr<PlyValues> ply_values(const PlyHeader& header, std::string_view file);

}  // namespace dmpc::apps
