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

/// Gives the bytes of the file that a scene refers to by this name, or throws core::InputError that says why there are none.
using OpenNamed = std::function<std::vector<std::byte>(const std::string& name)>;

/// The bytes of a "data:" address (RFC 2397). Throws core::InputError, by `where`, if they are neither in base 64 nor in letters
/// and percents.
std::vector<std::byte> bytes_of_data(const std::string& address, const Part& where);
bool is_data(const std::string& address);

/// A view, unpacked where it was packed.
struct View {
  std::span<const std::byte> bytes;
  std::uint64_t stride_bytes = 0;  ///< 0: elements follow each other
};

/// Reads each buffer once, when it is first asked for.
class Buffers {
 public:
  /// Both outlive the buffers.
  Buffers(const Document& document, const OpenNamed& open);

  /// Throws core::InputError, by its place in the document, for a view beyond its buffer or that does not exist.
  View view(std::size_t index);
  std::size_t view_count() const { return views_.size(); }

 private:
  std::span<const std::byte> buffer(std::size_t index);
  std::span<const std::byte> read(std::size_t index);
  /// `length` bytes of a buffer from `offset` on, which `where` asks for.
  std::span<const std::byte> piece(const Part& where);

  const Document& document_;
  const OpenNamed& open_;
  std::vector<Part> buffers_, views_;
  std::map<std::size_t, std::vector<std::byte>> owned_, unpacked_;
  std::map<std::size_t, std::span<const std::byte>> known_;
};

}  // namespace dmpc::apps::gltf
