#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

#include "apps/foreign/plain_picture.h"

namespace dmpc::apps {
namespace {

/// A file in memory.
class BytesStream final : public Imf::IStream {
 public:
  explicit BytesStream(std::span<const std::byte> file) : Imf::IStream("in memory"), file_(file) {}

  bool read(char room[], int count) override {
    const auto wanted = static_cast<std::size_t>(std::max(count, 0));
    if (place_ > file_.size() || wanted > file_.size() - place_) {
      throw std::runtime_error("the file ends early");
    }
    std::memcpy(room, file_.data() + place_, wanted);
    place_ += wanted;
    return place_ < file_.size();
  }
  std::uint64_t tellg() override { return place_; }
  void seekg(std::uint64_t place) override { place_ = place; }

 private:
  std::span<const std::byte> file_;
  std::uint64_t place_ = 0;
};

using Names = std::vector<std::string>;

/// In the order in which OpenImageIO puts them. Nothing for other channels, or some that do not have a float for each pixel.
Names channels_of(const Imf::ChannelList& list) {
  Names names;
  for (auto channel = list.begin(); channel != list.end(); ++channel) {
    if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1 || channel.channel().type == Imf::UINT) {
      return {};
    }
    names.emplace_back(channel.name());
  }
  for (const Names& known : {Names{"R", "G", "B"}, Names{"R", "G", "B", "A"}, Names{"Y"}}) {
    if (std::is_permutation(names.begin(), names.end(), known.begin(), known.end())) {
      return known;
    }
  }
  return {};
}

/// Where each channel's floats go.
Imf::FrameBuffer places_for(const RawPicture& picture, const Names& channels, const Imath::Box2i& window, std::uint8_t* values) {
  const std::size_t pixel_bytes = channels.size() * sizeof(float);
  Imf::FrameBuffer places;
  for (std::size_t channel = 0; channel < channels.size(); ++channel) {
    places.insert(channels[channel], Imf::Slice::Make(Imf::FLOAT, values + channel * sizeof(float), window, pixel_bytes,
                                                      picture.width * pixel_bytes));
  }
  return places;
}

/// OpenImageIO converts NaN to a byte in two different ways.
bool are_numbers(const RawPicture& picture) {
  for (std::size_t place = 0; place < picture.values.size(); place += sizeof(float)) {
    float value = 0;
    std::memcpy(&value, picture.values.data() + place, sizeof(value));
    if (std::isnan(value)) {
      return false;
    }
  }
  return true;
}

/// Throws what OpenEXR throws.
std::optional<RawPicture> picture_of(std::span<const std::byte> file, std::uint64_t pixels_max, bool has_values) {
  BytesStream stream(file);
  Imf::MultiPartInputFile parts(stream, 0);
  if (parts.parts() != 1 || (parts.header(0).hasType() && parts.header(0).type() != "scanlineimage") ||
      parts.header(0).hasTileDescription()) {
    return std::nullopt;
  }
  const Imath::Box2i window = parts.header(0).dataWindow();
  const Names channels = channels_of(parts.header(0).channels());
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                     height = std::int64_t{window.max.y} - window.min.y + 1;
  if (channels.empty() || width < 1 || height < 1 ||
      !is_plain_size(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), sizeof(float), file.size(),
                     pixels_max)) {
    return std::nullopt;
  }
  RawPicture picture{.width = static_cast<std::uint32_t>(width),
                     .height = static_cast<std::uint32_t>(height),
                     .channels = static_cast<int>(channels.size()),
                     .value_bytes = sizeof(float),
                     .values = {}};
  if (!has_values) {
    return picture;
  }
  picture.values.resize(channels.size() * sizeof(float) * picture.width * picture.height);
  Imf::InputPart part(parts, 0);
  part.setFrameBuffer(places_for(picture, channels, window, picture.values.data()));
  part.readPixels(window.min.y, window.max.y);
  return are_numbers(picture) ? std::optional(std::move(picture)) : std::nullopt;
}

}  // namespace

std::optional<RawPicture> exr_picture(std::span<const std::byte> file, std::uint64_t pixels_max, bool has_values) {
  try {
    return picture_of(file, pixels_max, has_values);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace dmpc::apps
