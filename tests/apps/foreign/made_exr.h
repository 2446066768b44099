// EXR of many kinds, with random numbers.
#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/base/sampling.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests {

struct ExrKind {
  int width = 11, height = 37;
  int left = 0, top = 0;  ///< corner of the data window, beside or within the display window
  std::vector<std::string> channels = {"R", "G", "B"};
  Imf::PixelType type = Imf::HALF;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  Imf::LineOrder order = Imf::INCREASING_Y;
  bool has_tiles = false, are_all_numbers = true;

  std::string text() const {
    std::string text = "type " + std::to_string(type) + ", compression " + std::to_string(compression) + ", channels";
    for (const std::string& channel : channels) {
      text += " " + channel;
    }
    return text;
  }
};

/// Makes infinities of what is no number.
inline void make_numbers(std::vector<char>& plane, std::size_t number_bytes) {
  const std::uint64_t infinity = number_bytes == 2 ? 0x7c00 : 0x7f800000, sign = number_bytes == 2 ? 0x8000 : 0x80000000;
  for (std::size_t place = 0; place < plane.size(); place += number_bytes) {
    std::uint64_t number = 0;
    std::memcpy(&number, plane.data() + place, number_bytes);  // the low bytes come first
    if ((number & infinity) == infinity) {
      number &= infinity | sign;
    }
    std::memcpy(plane.data() + place, &number, number_bytes);
  }
}

/// Numbers of any bits, infinities included, and what is no number if that is wanted.
inline std::string exr_of(const ExrKind& kind, std::uint64_t seed = 1) {
  const TemporaryFolder folder;
  const std::string name = folder / "a.exr";
  const Imath::Box2i data({kind.left, kind.top}, {kind.left + kind.width - 1, kind.top + kind.height - 1});
  Imf::Header header(Imath::Box2i({0, 0}, {kind.width - 1, kind.height - 1}), data, 1, Imath::V2f(0, 0), 1, kind.order,
                     kind.compression);
  const std::size_t number_bytes = kind.type == Imf::HALF ? 2 : 4,
                    pixels = static_cast<std::size_t>(kind.width) * static_cast<std::size_t>(kind.height);
  const std::size_t row_bytes = static_cast<std::size_t>(kind.width) * number_bytes;
  std::vector<std::vector<char>> planes;
  Imf::FrameBuffer buffer;
  for (std::size_t channel = 0; channel < kind.channels.size(); ++channel) {
    header.channels().insert(kind.channels[channel], Imf::Channel(kind.type));
    std::vector<char>& plane = planes.emplace_back(pixels * number_bytes);
    for (std::size_t i = 0; i < plane.size(); ++i) {
      plane[i] = static_cast<char>(core::mix(seed << 48U | channel << 40U | i));
    }
    if (kind.are_all_numbers) {
      make_numbers(plane, number_bytes);
    }
    buffer.insert(kind.channels[channel], Imf::Slice::Make(kind.type, plane.data(), data, number_bytes, row_bytes));
  }
  if (kind.has_tiles) {
    header.setTileDescription(Imf::TileDescription(16, 16));
    Imf::TiledOutputFile file(name.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  } else {
    Imf::OutputFile file(name.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(kind.height);
  }
  return file_text(name);
}

}  // namespace dmpc::tests
