#include "apps/picture/layer_image.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/sampling.h"
#include "core/base/srgb.h"

namespace dmpc::apps {
namespace {

using core::Layer;

std::vector<std::string> names_of(Layer layer) {
  switch (layer) {
    case Layer::normal:
      return {"X", "Y", "Z"};
    case Layer::depth:
      return {"Z"};
    case Layer::id:
      return {"X"};
    default:
      return {"R", "G", "B"};
  }
}

/// The colour that a display shows for an encoded value.
float displayed(double encoded) { return static_cast<float>(core::linear_from_srgb(encoded)); }

std::array<float, 3> color_of_id(float number) {
  std::array<float, 3> color{};
  const std::uint64_t bits = core::mix(static_cast<std::uint64_t>(number));
  for (std::size_t i = 0; i < 3 && number > 0; ++i) {
    color[i] = displayed(0.25 + static_cast<double>(bits >> (8 * i) & 0xffU) / 340);
  }
  return color;
}

/// The nearest of the distances, and how much farther the farthest is, more than 0.
std::pair<double, double> range_of(const std::vector<float>& distances) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const float distance : distances) {
    nearest = distance > 0 ? std::min(nearest, double{distance}) : nearest;
    farthest = std::max(farthest, double{distance});
  }
  return {nearest, std::max(farthest - nearest, std::numeric_limits<double>::min())};
}

Image shown(const LayerImage& layer) {
  const Channels& channels = layer.channels;
  Image image(channels.width, channels.height);
  const std::size_t count = channels.names.size();
  const auto [nearest, range] = range_of(channels.values);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    const float value = channels.values[count == 3 ? i : i / 3];
    image.rgb[i] = layer.layer == Layer::normal  ? displayed((double{value} + 1) / 2)
                   : layer.layer == Layer::depth ? displayed(value > 0 ? 1 - 0.9 * (double{value} - nearest) / range : 0)
                   : layer.layer == Layer::id    ? color_of_id(value)[i % 3]
                                                 : value;
  }
  return image;
}

}  // namespace

LayerImage layer_image(Layer layer, const core::Film& film) {
  LayerImage image{
      layer,
      {.width = film.width(), .height = film.height(), .layer = std::string(core::name_of(layer)), .names = names_of(layer)}};
  const std::size_t count = image.channels.names.size();
  image.channels.values.reserve(count * film.pixel_count());
  for (std::uint32_t pixel = 0; pixel < film.pixel_count(); ++pixel) {
    const core::Vec3d mean = film.radiance(pixel);
    for (std::size_t i = 0; i < count; ++i) {
      image.channels.values.push_back(static_cast<float>(layer == Layer::normal ? 2 * mean[i] - 1 : mean[i]));
    }
  }
  return image;
}

std::string layer_file(const std::filesystem::path& path, const LayerImage& image) {
  return path.extension() == ".exr" ? encoded_picture(path, image.channels) : encoded_picture(path, shown(image));
}

}  // namespace dmpc::apps
