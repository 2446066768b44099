#include "apps/picture/exr_file.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <string_view>

#include "apps/picture/deflate.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using namespace std::string_view_literals;

static_assert(std::endian::native == std::endian::little, "EXR files have the least byte first");

constexpr int rows_a_block = 16;  ///< as zip packing has it
constexpr int effort = 4;         ///< as OpenEXR has it: floats gain nothing from more
constexpr std::size_t name_bytes_max = 31;

template <class T>
std::string raw(T value) {
  return {reinterpret_cast<const char*>(&value), sizeof(value)};
}

std::string with_end(std::string_view text) { return std::string(text) + '\0'; }

template <class T>
std::string raw_pair(T first, T second) {
  return raw(first) + raw(second);
}

/// Sorted by their names, as readers of channels expect it.
std::vector<ExrChannel> sorted(std::vector<ExrChannel> channels) {
  std::sort(channels.begin(), channels.end(), [](const ExrChannel& a, const ExrChannel& b) { return a.name < b.name; });
  return channels;
}

std::string channel_list(const std::vector<ExrChannel>& channels) {
  constexpr std::int32_t is_float = 2, is_linear = 0, every = 1;
  std::string list;
  for (const ExrChannel& channel : channels) {
    core::expect(!channel.name.empty() && channel.name.size() <= name_bytes_max, "an EXR file's names are short");
    list += with_end(channel.name) + raw_pair(is_float, is_linear) + raw_pair(every, every);
  }
  return with_end(list);
}

std::string header(const ExrPicture& picture, const std::vector<ExrChannel>& channels) {
  struct Attribute {
    std::string_view type;
    std::string value;
  };
  const std::string window = raw_pair(std::int32_t{0}, std::int32_t{0}) + raw_pair(picture.width - 1, picture.height - 1);
  std::map<std::string, Attribute> attributes = {
      {"Software", {"string", "dmpc"}},
      {"channels", {"chlist", channel_list(channels)}},
      {"compression", {"compression", "\3"}},  // zip
      {"dataWindow", {"box2i", window}},
      {"displayWindow", {"box2i", window}},
      {"lineOrder", {"lineOrder", std::string("\0"sv)}},  // from the top
      {"pixelAspectRatio", {"float", raw(1.0F)}},
      {"screenWindowCenter", {"v2f", raw_pair(0.0F, 0.0F)}},
      {"screenWindowWidth", {"float", raw(1.0F)}},
  };
  for (const auto& [name, text] : picture.remarks) {
    core::expect(!name.empty() && name.size() <= name_bytes_max, "an EXR file's names are short");
    attributes.insert_or_assign(name, Attribute{"string", text});
  }
  constexpr std::uint32_t magic = 20000630, version = 2;
  std::string text = raw_pair(magic, version);
  for (const auto& [name, attribute] : attributes) {
    text += with_end(name) + with_end(attribute.type) + raw(static_cast<std::int32_t>(attribute.value.size())) + attribute.value;
  }
  return with_end(text);
}

/// Row by row, and in a row channel by channel.
std::string rows(const ExrPicture& picture, const std::vector<ExrChannel>& channels, int first, int last) {
  const auto width = static_cast<std::size_t>(picture.width);
  std::string bytes(static_cast<std::size_t>(last - first) * width * channels.size() * sizeof(float), '\0');
  char* to = bytes.data();
  for (int row = first; row < last; ++row) {
    for (const ExrChannel& channel : channels) {
      const float* from = channel.values.data() + static_cast<std::size_t>(row) * width * channel.stride;
      for (std::size_t column = 0; column < width; ++column, from += channel.stride, to += sizeof(float)) {
        std::memcpy(to, from, sizeof(float));
      }
    }
  }
  return bytes;
}

/// First all bytes at even places, then the others, as differences from the one before (OpenEXR's ImfZip.cpp).
std::string predicted(std::string_view bytes) {
  std::string result(bytes.size(), '\0');
  const std::size_t half = (bytes.size() + 1) / 2;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    result[i / 2 + (i % 2 == 0 ? 0 : half)] = bytes[i];
  }
  for (std::size_t i = result.size() - 1; i > 0; --i) {
    result[i] = static_cast<char>(result[i] - result[i - 1] + 128);
  }
  return result;
}

/// What does not get smaller stays as it is.
std::string packed(std::string bytes) {
  std::string smaller = deflated(predicted(bytes), effort);
  return smaller.size() < bytes.size() ? smaller : bytes;
}

}  // namespace

std::string exr_file(const ExrPicture& picture) {
  const std::vector<ExrChannel> channels = sorted(picture.channels);
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  for (const ExrChannel& channel : channels) {
    core::expect(pixels > 0 && (pixels - 1) * channel.stride < channel.values.size(), "a channel has a number for each pixel");
  }
  std::string file = header(picture, channels);
  std::size_t place = file.size();  // in the table of where the blocks begin
  file.resize(place + static_cast<std::size_t>((picture.height + rows_a_block - 1) / rows_a_block) * sizeof(std::uint64_t));
  for (int row = 0; row < picture.height; row += rows_a_block, place += sizeof(std::uint64_t)) {
    file.replace(place, sizeof(std::uint64_t), raw(std::uint64_t{file.size()}));
    const std::string block = packed(rows(picture, channels, row, std::min(row + rows_a_block, picture.height)));
    file += raw_pair(std::int32_t{row}, static_cast<std::int32_t>(block.size())) + block;
  }
  return file;
}

}  // namespace dmpc::apps
