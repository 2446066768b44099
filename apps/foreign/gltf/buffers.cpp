#include "apps/foreign/gltf/buffers.h"

#include <algorithm>

#include "apps/edge/system/base64.h"
#include "apps/foreign/gltf/meshopt.h"

namespace dmpc::apps::gltf {

using Bytes = std::span<const std::byte>;

bool is_data(const std::string& address) { return address.substr(0, 5) == "data:"; }

std::vector<std::byte> bytes_of_data(const std::string& address, const Part& where) {
  const std::size_t comma = address.find(',');
  const bool is_coded = comma != std::string::npos && address.substr(0, comma).find(";base64") != std::string::npos;
  auto bytes = is_coded ? bytes_of_base64(std::string_view(address).substr(comma + 1)) : std::nullopt;
  if (!bytes) {
    where.fail("these data are not in base 64, which is expected here");
  }
  return *std::move(bytes);
}

Buffers::Buffers(const Document& document, const OpenNamed& open)
    : document_(document), open_(open), buffers_(document.root().list("buffers")), views_(document.root().list("bufferViews")) {}

Bytes Buffers::read(std::size_t index) {
  const Part& part = buffers_[index];
  const std::string address = part.text("uri", "");
  if (!part.find("uri")) {
    if (index != 0 || !document_.chunk) {
      part.fail("is missing the uri, and there is no binary chunk that it could be");
    }
    return *document_.chunk;
  }
  return owned_[index] = is_data(address) ? bytes_of_data(address, part) : open_(address);
}

Bytes Buffers::buffer(std::size_t index) {
  const auto [known, is_new] = known_.try_emplace(index);
  if (is_new) {
    const Bytes bytes = read(index);
    const std::uint64_t length = buffers_[index].get("byteLength").as_whole();
    if (length > bytes.size()) {
      buffers_[index].fail("has " + std::to_string(bytes.size()) + " bytes, and byteLength says " + std::to_string(length) +
                           ": it is cut short");
    }
    known->second = bytes.first(length);
  }
  return known->second;
}

Bytes Buffers::piece(const Part& where) {
  const Bytes bytes = buffer(where.required_index("buffer", buffers_.size(), "buffers"));
  const std::uint64_t offset = where.whole("byteOffset", 0), length = where.get("byteLength").as_whole();
  if (offset > bytes.size() || length > bytes.size() - offset) {
    where.fail("reaches to byte " + std::to_string(offset + length) + " of a buffer of " + std::to_string(bytes.size()));
  }
  return bytes.subspan(offset, length);
}

View Buffers::view(std::size_t index) {
  const Part& part = views_[index];
  const std::uint64_t stride = part.whole("byteStride", 0);
  const auto packed = packing_of(part);
  if (!packed) {
    return {piece(part), stride};
  }
  const auto [known, is_new] = unpacked_.try_emplace(index);
  if (is_new) {
    known->second = unpacked(*packed, piece(*packed));
  }
  return {known->second, packed->whole("byteStride", 0)};
}

}  // namespace dmpc::apps::gltf
