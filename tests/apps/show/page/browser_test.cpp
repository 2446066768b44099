// A page in a real browser.

#include <doctest/doctest.h>

#include <cstddef>
#include <sstream>
#include <string>

#include "apps/picture/image_file.h"
#include "apps/show/page/render_page.h"
#include "tests/apps/show/watched.h"
#include "tests/support/browser.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::html::page_browser_test {

namespace {

/// A page of a modelled machine with all that a page can have but heat maps.
std::string page_text() {
  return render_page(Watched(starved(modelled())).record(), {.command = "dmpc render " + std::string(300, 'x')});
}

/// Mean light of a column of pixels, 0 to 1.
double brightness(const Image& image, int column) {
  double sum = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int channel = 0; channel < 3; ++channel) {
      sum += static_cast<double>(image.rgb[static_cast<std::size_t>((y * image.width + column) * 3 + channel)]);
    }
  }
  return sum / (3 * image.height);
}

}  // namespace

TEST_CASE("a browser shows the page whole, on a screen and on a telephone, light and dark, and asks nobody for more") {
  const tests::TemporaryFolder folder;
  const std::string page = page_text();
  for (const int width : {1280, 400}) {
    for (const bool is_dark : {false, true}) {
      CAPTURE(width);
      CAPTURE(is_dark);
      tests::check_shown_whole(tests::reported_by_browser(page, width, is_dark, folder / "shot.png"), page, width, is_dark);
      const Image picture = read_image(folder / "shot.png");
      REQUIRE(picture.width == width);
      CHECK(is_dark == (brightness(picture, 2) < 0.1));
      CHECK((is_dark || brightness(picture, 2) > 0.9));
    }
  }
}

}  // namespace dmpc::apps::html::page_browser_test
