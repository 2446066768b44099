// The bytes that a glTF document refers to: buffers, and views of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "apps/foreign/gltf/document.h"

namespace dmpc::apps::gltf {

/// Returns the bytes of the file that a scene refers to by this name, or throws core::InputError with the reason.
using OpenNamed = std::function<std::vector<std::byte>(const std::string& name)>;

/// The bytes of a "data:" URL (RFC 2397). Throws core::InputError, with `where`, if they are neither in base 64 nor
/// percent-encoded.
std::vector<std::byte> bytes_of_data(const std::string& address, const Part& where);
bool is_data(const std::string& address);

/// A view, decompressed if necessary.
struct View {
  std::span<const std::byte> bytes;
  std::uint64_t stride_bytes = 0;  ///< 0: elements follow each other
};

/// Reads each buffer once, on first use.
class Buffers {
 public:
  /// Both arguments outlive the buffers.
  Buffers(const Document& document, const OpenNamed& open);

  /// Throws core::InputError, with the place in the document, for a view that exceeds its buffer or does not exist.
  View view(std::size_t index);
  std::size_t view_count() const { return views_.size(); }

 private:
  std::span<const std::byte> buffer(std::size_t index);
  std::span<const std::byte> read(std::size_t index);
  /// The `length` bytes of a buffer from `offset` on, both members of `where`.
  std::span<const std::byte> piece(const Part& where);

  const Document& document_;
  const OpenNamed& open_;
  std::vector<Part> buffers_, views_;
  std::map<std::size_t, std::vector<std::byte>> owned_, unpacked_;
  std::map<std::size_t, std::span<const std::byte>> known_;
};

}  // namespace dmpc::apps::gltf
