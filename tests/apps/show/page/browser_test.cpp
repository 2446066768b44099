// A page in a real browser: headless Chromium, Debian's package chromium, which tests/run installs.

#include <doctest/doctest.h>

#include <array>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "apps/picture/image_file.h"
#include "apps/show/page/render_page.h"
#include "tests/apps/show/watched.h"
#include "tests/support/child_process.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::html {

using tests::ChildProcess;
using tests::TemporaryFolder;

namespace {

constexpr const char* chromium = "/usr/bin/chromium";

/// Tells the frame around the page how wide the page is, and how many of its pictures the browser shows.
constexpr const char* telling_script =
    "<script>addEventListener('load',()=>{const all=[...document.images];"
    "parent.postMessage(`width ${document.documentElement.scrollWidth} of ${innerWidth}, shown "
    "${all.filter(i=>i.complete&&i.naturalWidth>0).length} of ${all.length}, asked for "
    "${performance.getEntriesByType('resource').filter(e=>!e.name.startsWith('data:')).length}, tables cut "
    "${[...document.querySelectorAll('.scroll')].filter(e=>e.scrollWidth>e.clientWidth).length}, dark "
    "${matchMedia('(prefers-color-scheme:dark)').matches}`,'*')})</script>";

/// A window with a page so many pixels wide, since no window of the browser's is as narrow as a telephone. Its title says what
/// the page has told.
std::string window_around(const std::string& file, int width) {
  return "<!DOCTYPE html><meta name=\"color-scheme\" content=\"light dark\"><script>addEventListener('message',"
         "e=>{document.title=e.data})</script><style>body{margin:0}iframe{border:0;height:900px;width:" +
         std::to_string(width) + "px}</style><iframe src=\"" + file + "\"></iframe>";
}

/// A page of a modelled machine with all that a page can have but heat maps.
std::string page_text() {
  std::ostringstream complaints;
  return render_page(Watched(starved(modelled())).record(), {.command = "dmpc render " + std::string(300, 'x')}, complaints);
}

/// What the browser shows of the page in a window of so many pixels.
struct Shown {
  std::string title;
  Image picture;
};

Shown shown(const std::string& page, int width, bool is_dark) {
  const TemporaryFolder folder;
  tests::write_text(folder / "page.html", page + telling_script);
  tests::write_text(folder / "window.html", window_around("page.html", width));
  ChildProcess browser({chromium, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", "--no-first-run",
                        "--user-data-dir=" + (folder / "profile").string(), "--window-size=" + std::to_string(width) + ",900",
                        std::string("--blink-settings=preferredColorScheme=") + (is_dark ? "0" : "1"),
                        "--virtual-time-budget=5000", "--screenshot=" + (folder / "shot.png").string(), "--dump-dom",
                        "file://" + (folder / "window.html").string()});
  const int status = browser.status();
  REQUIRE_MESSAGE(status == 0,
                  "chromium ends with status " << status << ": is the package chromium installed? " << browser.errors());
  const std::string dom = browser.output();
  const std::size_t begin = dom.find("<title>") + 7;
  return {dom.substr(begin, dom.find("</title>") - begin), read_image(folder / "shot.png")};
}

std::size_t picture_count(const std::string& page) {
  std::size_t count = 0;
  for (std::size_t at = page.find("<img "); at != std::string::npos; at = page.find("<img ", at + 1)) {
    ++count;
  }
  return count;
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
  const std::string page = page_text(), pictures = std::to_string(picture_count(page));
  for (const int width : {1280, 400}) {
    for (const bool is_dark : {false, true}) {
      CAPTURE(width);
      CAPTURE(is_dark);
      const Shown found = shown(page, width, is_dark);
      INFO(found.title);
      const std::string wide = std::to_string(width);
      CHECK(contains(found.title, "width " + wide + " of " + wide));
      CHECK(contains(found.title, "shown " + pictures + " of " + pictures + ", asked for 0"));
      CHECK((width < 1280 || contains(found.title, "tables cut 0,")));
      CHECK(contains(found.title, is_dark ? "dark true" : "dark false"));
      REQUIRE(found.picture.width == width);
      CHECK(is_dark == (brightness(found.picture, 2) < 0.1));
      CHECK((is_dark || brightness(found.picture, 2) > 0.9));
    }
  }
}

}  // namespace dmpc::apps::html
