#include "apps/foreign/gltf/buffers.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include "apps/foreign/gltf/meshopt.h"
#include "apps/frontend/system/base64.h"

namespace dmpc::apps::gltf {

using Bytes = std::span<const std::byte>;

bool is_data(const std::string& address) { return address.substr(0, 5) == "data:"; }

namespace {

enum class DataCoding : std::uint8_t { unknown, base64, percent };

/// By RFC 2397: a kind of media, parameters "name=value", and perhaps ";base64" as the last.
DataCoding coding_of(std::string_view head) {
  constexpr std::string_view base64 = ";base64";
  const bool is_base64 = head.ends_with(base64);
  head.remove_suffix(is_base64 ? base64.size() : 0);
  for (std::size_t at = head.find(';'); at != std::string_view::npos; at = head.find(';')) {
    head.remove_prefix(at + 1);
    if (head.substr(0, head.find(';')).find('=') == std::string_view::npos) {
      return DataCoding::unknown;
    }
  }
  return is_base64 ? DataCoding::base64 : DataCoding::percent;
}

/// Letters stand for themselves, "%89" for a byte. Nothing if a percent sign is not followed by two digits, or a letter is none
/// that an address may have.
std::optional<std::vector<std::byte>> bytes_of_percents(std::string_view text) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i < text.size(); ++i) {
    auto byte = static_cast<unsigned char>(text[i]);
    if (byte == '%') {
      const std::string_view digits = text.substr(i + 1, 2);
      if (digits.size() < 2 || std::from_chars(digits.begin(), digits.end(), byte, 16).ptr != digits.end()) {
        return std::nullopt;
      }
      i += 2;
    } else if (byte <= ' ' || byte > '~') {
      return std::nullopt;
    }
    bytes.push_back(std::byte{byte});
  }
  return bytes;
}

}  // namespace

std::vector<std::byte> bytes_of_data(const std::string& address, const Part& where) {
  const std::string_view whole = address;
  const std::size_t comma = whole.find(',');
  const DataCoding coding = comma == std::string_view::npos ? DataCoding::unknown : coding_of(whole.substr(0, comma));
  std::optional<std::vector<std::byte>> bytes;
  if (coding == DataCoding::base64) {
    bytes = bytes_of_base64(whole.substr(comma + 1));
  } else if (coding == DataCoding::percent) {
    bytes = bytes_of_percents(whole.substr(comma + 1));
  }
  if (!bytes) {
    where.fail("these data are not in base 64, nor in letters and percents of an address, one of which is expected here");
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
