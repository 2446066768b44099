// The values of a PLY file's body, one after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "apps/foreign/polygon/ply_header.h"

namespace dmpc::apps {

/// The body ends within an element.
struct PlyIsShort {};

class PlyValues {
 public:
  virtual ~PlyValues() = default;

  /// An element begins. In text that is a line's begin, or behind another element where nothing is left over in the end.
  virtual void begin_element() = 0;
  /// Throws PlyIsShort at the end, core::InputError, with the place, for what is no value of the type.
  virtual double next(PlyType type) = 0;
  /// Length of a list of `type`: at most as many as there are bytes for. Throws as next() does.
  virtual std::uint64_t next_length(PlyType count_type, PlyType type) = 0;
  /// A list's values, in place of what is in `values`. Throws as the others do.
  virtual void next_list(PlyType count_type, PlyType type, std::vector<double>& values) = 0;
  virtual void skip(PlyType type, std::uint64_t count) = 0;

  /// How many of these there are bytes for, at most.
  virtual std::uint64_t room_for(const PlyElement& element) const = 0;
  /// What follows the last element, in bytes. Throws core::InputError if lines had more values than elements have.
  virtual std::uint64_t count_rest() = 0;
  /// How many bytes of the body are read.
  virtual std::size_t position() const = 0;
  /// What may be the reason for an error that is met later, to be added to it: " (...)", or nothing.
  virtual std::string doubt() const { return ""; }
  /// "line 7" or "byte 1234", of the last value.
  virtual std::string place() const = 0;
};

/// `file` outlives it.
std::unique_ptr<PlyValues> ply_values(const PlyHeader& header, std::string_view file);

}  // namespace dmpc::apps
