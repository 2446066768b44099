#include "apps/show/page/pictures.h"

#include "apps/frontend/show/page/data_url.h"
#include "apps/frontend/show/page/table.h"
#include "apps/picture/shrunk.h"

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

}  // namespace dmpc::apps::html
