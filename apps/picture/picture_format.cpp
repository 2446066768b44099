#include "apps/picture/picture_format.h"

#include <unistd.h>

#include <algorithm>

#include "apps/frontend/line/small_letters.h"

namespace dmpc::apps {
namespace {

struct Beginning {
  std::string_view bytes;
  const char* format;
};

using namespace std::string_view_literals;

constexpr std::array beginnings{
    Beginning{"\x89PNG\r\n\x1a\n"sv, "png"},
    Beginning{"\xff\xd8\xff"sv, "jpeg"},
    Beginning{"v/1\x01"sv, "openexr"},
    Beginning{"II*\0"sv, "tiff"},
    Beginning{"MM\0*"sv, "tiff"},
    Beginning{"II+\0"sv, "tiff"},
    Beginning{"MM\0+"sv, "tiff"},
    Beginning{"BM"sv, "bmp"},
    Beginning{"#?RADIANCE"sv, "hdr"},
    Beginning{"#?RGBE"sv, "hdr"},
    Beginning{"GIF8"sv, "gif"},
    Beginning{"DDS "sv, "dds"},
    Beginning{"P1"sv, "pnm"},
    Beginning{"P2"sv, "pnm"},
    Beginning{"P3"sv, "pnm"},
    Beginning{"P4"sv, "pnm"},
    Beginning{"P5"sv, "pnm"},
    Beginning{"P6"sv, "pnm"},
    Beginning{"PF"sv, "pnm"},
    Beginning{"Pf"sv, "pnm"},
};

}  // namespace

std::optional<std::string> picture_format(std::string_view beginning, std::string_view ending) {
  const auto known = std::find_if(beginnings.begin(), beginnings.end(),
                                  [&](const Beginning& each) { return beginning.starts_with(each.bytes); });
  if (known != beginnings.end()) {
    return known->format;
  }
  if (beginning.starts_with("RIFF") && beginning.substr(std::min<std::size_t>(8, beginning.size())).starts_with("WEBP")) {
    return "webp";
  }
  return in_small_letters(ending) == "tga" ? std::optional<std::string>("targa") : std::nullopt;
}

std::optional<std::string> picture_format(const Descriptor& file, std::string_view ending) {
  std::array<char, 16> bytes{};
  const ssize_t count = ::pread(file.number(), bytes.data(), bytes.size(), 0);
  return picture_format({bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))}, ending);
}

std::string known_picture_formats() { return "PNG, JPEG, EXR, TIFF, TGA, BMP, HDR, WebP, GIF, PNM or DDS"; }

std::uint64_t decoded_bytes(std::uint64_t width, std::uint64_t height, std::uint64_t bytes_a_channel) {
  return width * height * 3 * bytes_a_channel;
}

std::uint64_t decoded_bytes_max(std::uint64_t file_bytes) { return (std::uint64_t{512} << 20U) + file_bytes * 4096; }

}  // namespace dmpc::apps
