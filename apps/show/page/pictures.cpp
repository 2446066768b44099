#include "apps/show/page/pictures.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "apps/edge/show/page/data_url.h"
#include "apps/edge/show/page/table.h"

namespace dmpc::apps::html {

void add_picture(Page& page, const Image& image, const std::string& description, const std::string& caption) {
  const Image shown = shrunk(image, picture_side_max);
  const bool is_shrunk = shown.width != image.width;
  page.add_figure(
      picture_url(shown),
      "class=\"picture\" width=\"" + std::to_string(shown.width) + "\" height=\"" + std::to_string(shown.height) + "\"",
      description,
      caption + (is_shrunk ? " Shown smaller than it is: " + std::to_string(image.width) + "x" + std::to_string(image.height) +
                                 " pixels."
                           : ""),
      is_shrunk ? save_link(description, "PNG", picture_url(image)) : shown_save_link(description, "PNG"));
}

std::string picture_url(const Image& image) { return data_url("image/png", encoded_picture("picture.png", image)); }

Image shrunk(const Image& image, int side_max) {
  const int step = (std::max(image.width, image.height) + side_max - 1) / side_max;
  if (step <= 1) {
    return image;
  }
  const auto at = [](const Image& of, int x, int y) {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(of.width) + static_cast<std::size_t>(x)) * 3;
  };
  Image small((image.width + step - 1) / step, (image.height + step - 1) / step);
  std::vector<float> count(small.rgb.size());
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t from = at(image, x, y), to = at(small, x / step, y / step);
      for (std::size_t channel = 0; channel < 3; ++channel) {
        small.rgb[to + channel] += image.rgb[from + channel];
        count[to + channel] += 1;
      }
    }
  }
  std::transform(small.rgb.begin(), small.rgb.end(), count.begin(), small.rgb.begin(), std::divides());
  return small;
}

}  // namespace dmpc::apps::html
