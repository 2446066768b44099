#include "apps/foreign/opaque_picture.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace dmpc::apps {
namespace {

using Bytes = std::vector<std::byte>;

/// Clears bits, if the byte is there. Returns whether any was set.
bool clear_bits(Bytes& file, std::size_t at, std::byte bits) {
  const bool had_any = at < file.size() && (file[at] & bits) != std::byte{0};
  if (had_any) {
    file[at] &= ~bits;
  }
  return had_any;
}

/// The chunks of a WebP from `at` to `end`: name, length and content of each, which is filled up to an even length (Google's WebP
/// container specification).
bool make_chunks_opaque(Bytes& file, std::size_t at, std::size_t end) {
  constexpr std::size_t head_bytes = 8, frame_bytes = 16, lossless_flags = 4;
  constexpr std::byte alpha_flag{0x10};
  bool had_alpha = false;
  while (end - at >= head_bytes) {
    const std::string_view name(reinterpret_cast<const char*>(file.data()) + at, 4);
    std::uint32_t length = 0;
    std::memcpy(&length, file.data() + at + 4, sizeof length);
    const std::size_t content = at + head_bytes, next = content + length + length % 2;
    if (name == "VP8X") {
      had_alpha = clear_bits(file, content, alpha_flag) || had_alpha;
    } else if (name == "VP8L") {
      had_alpha = clear_bits(file, content + lossless_flags, alpha_flag) || had_alpha;
    } else if (name == "ALPH") {
      file[at] = std::byte{'-'};  // a chunk of no name that is known is passed over
      had_alpha = true;
    } else if (name == "ANMF" && length >= frame_bytes && next <= end) {
      had_alpha = make_chunks_opaque(file, content + frame_bytes, content + length) || had_alpha;
    }
    at = std::min(next, end);
  }
  return had_alpha;
}

bool make_webp_opaque(Bytes& file) {
  constexpr std::size_t head_bytes = 12;
  return file.size() > head_bytes && make_chunks_opaque(file, head_bytes, file.size());
}

/// The extensions before the first picture of a GIF, each a list of blocks that begin with their lengths (CompuServe's GIF89a).
bool make_gif_opaque(Bytes& file) {
  constexpr std::size_t head_bytes = 13, flags_at = 10;
  constexpr std::byte extension{0x21}, graphic_control{0xf9}, transparent{0x01}, has_palette{0x80}, palette_size{0x07};
  const auto byte_at = [&](std::size_t at) { return at < file.size() ? file[at] : std::byte{0}; };
  const std::byte flags = byte_at(flags_at);
  const auto size_code = std::to_integer<unsigned>(flags & palette_size);
  std::size_t at = head_bytes + ((flags & has_palette) != std::byte{0} ? 3 * (std::size_t{2} << size_code) : 0);
  bool had_alpha = false;
  while (byte_at(at) == extension) {
    if (byte_at(at + 1) == graphic_control && byte_at(at + 2) != std::byte{0}) {
      had_alpha = clear_bits(file, at + 3, transparent) || had_alpha;
    }
    at += 2;
    while (byte_at(at) != std::byte{0}) {
      at += 1 + std::to_integer<std::size_t>(byte_at(at));
    }
    ++at;
  }
  return had_alpha;
}

}  // namespace

std::optional<Bytes> made_opaque(std::string_view format, std::span<const std::byte> file) {
  Bytes opaque;
  if (format == "webp" || format == "gif") {
    opaque.assign(file.begin(), file.end());
  }
  const bool had_alpha = format == "webp" ? make_webp_opaque(opaque) : format == "gif" && make_gif_opaque(opaque);
  return had_alpha ? std::optional(std::move(opaque)) : std::nullopt;
}

}  // namespace dmpc::apps
