// The command that makes what a view shows.
#include "apps/view/render_words.h"

#include <doctest/doctest.h>

#include <string>
#include <vector>

namespace dmpc::apps::render_words_test {

namespace {

using Words = std::vector<std::string>;

Words words_of(const Words& view) { return render_words(view, "C", {.width = 8, .height = 6}); }

}  // namespace

TEST_CASE("the command has all that decides of picture and computer, and the camera and the size that are shown") {
  CHECK(words_of({"/usr/bin/dmpc", "view", "teapot-12", "--nodes=2", "--depth", "3", "--camera=A", "--port=8080", "--quiet",
                  "--resolution=1x1"}) ==
        Words{"dmpc", "render", "teapot-12", "--nodes=2", "--depth", "3", "--camera=C", "--resolution=8x6", "-o", "view.png"});
}

TEST_CASE("of an option that is left out its value goes, too, wherever it stands") {
  CHECK(words_of({"dmpc", "view", "--camera", "A", "--port", "0", "s.nff", "--resolution", "1x1"}) ==
        Words{"dmpc", "render", "s.nff", "--camera=C", "--resolution=8x6", "-o", "view.png"});
}

TEST_CASE("words behind -- are the scene, whatever they look like") {
  CHECK(words_of({"dmpc", "view", "--nodes=2", "--", "--camera"}) ==
        Words{"dmpc", "render", "--nodes=2", "--camera=C", "--resolution=8x6", "-o", "view.png", "--", "--camera"});
}

}  // namespace dmpc::apps::render_words_test
