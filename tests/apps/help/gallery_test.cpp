#include "apps/help/gallery.h"

#include <doctest/doctest.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/help/list_command.h"
#include "apps/main/commands.h"
#include "core/base/expect.h"
#include "core/families/scenes.h"
#include "tests/support/complaint.h"
#include "tests/support/documents.h"
#include "tests/support/shell.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::gallery_test {

using namespace dmpc::tests;
namespace fs = std::filesystem;

namespace {

core::Color pixel(const Image& image, int x, int y) {
  const auto at = static_cast<std::size_t>(y * image.width + x) * 3;
  return {image.rgb[at], image.rgb[at + 1], image.rgb[at + 2]};
}

Image of_color(const core::Color& color) {
  Image image(104, 104);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    image.rgb[i] = static_cast<float>(color[i % 3]);
  }
  return image;
}

std::string complaint(const fs::path& folder) {
  Interrupt interrupt;
  return tests::complaint_of([&] { write_gallery(folder, interrupt); });
}

}  // namespace

TEST_CASE("a contact sheet has six pictures in a row, each above its name") {
  std::vector<ScenePicture> pictures;
  for (int i = 0; i < 7; ++i) {
    pictures.push_back({"scene", of_color({0.125F * static_cast<float>(i), 0, 0})});
  }
  const Image sheet = contact_sheet(pictures);
  CHECK(sheet.width == 6 * 108 + 4);
  CHECK(pixel(sheet, 4, 4) == core::Color{0, 0, 0});
  CHECK(pixel(sheet, 4 + 5 * 108, 4) == core::Color{0.625F, 0, 0});
  CHECK(pixel(sheet, 4, 4 + 123) == core::Color{0.75F, 0, 0});
  CHECK(pixel(sheet, 4 + 108, 4 + 123) == core::Color{1, 1, 1});
  const Image one = contact_sheet({{"a", of_color({0, 0, 0})}}), other = contact_sheet({{"b", of_color({0, 0, 0})}});
  CHECK(one.width == 4 + 108);
  CHECK(one.rgb != other.rgb);
}

TEST_CASE("the gallery is a picture of each scene, and one of all") {
  const TemporaryFolder folder;
  const fs::path place = folder / "new/scenes";
  REQUIRE(complaint(place).empty());
  std::size_t count = 0;
  for (const core::SceneName& scene : core::default_scenes()) {
    CHECK_MESSAGE(read_image(place / (scene.text() + ".png")).width == 104, scene.text());
    ++count;
  }
  CHECK(read_image(place / "grove-4.png").width == 104);
  CHECK(read_image(place / "scenes.png").width == 6 * 108 + 4);
  CHECK(static_cast<std::size_t>(std::distance(fs::directory_iterator(place), {})) == count + 2);
  CHECK(contains(complaint(place), "balls-4.png, and 12 more, are there already and not written over: remove"));
}

TEST_CASE("what is in the folder is not written over, and then nothing is written") {
  const TemporaryFolder folder;
  write_text(folder / "teapot-12.png", "precious");
  write_text(folder / "notes", "mine");
  CHECK(contains(complaint(folder.path()), "teapot-12.png is there already"));
  CHECK(folder.entry_count() == 2);
  CHECK(contains(complaint(folder / "notes"), "notes: expected a folder"));
  fs::remove(folder / "teapot-12.png");
  fs::create_symlink("elsewhere", folder / "scenes.png");
  CHECK(contains(complaint(folder.path()), "scenes.png is there already"));
}

TEST_CASE("a gallery that is interrupted writes nothing") {
  const TemporaryFolder folder;
  Interrupt interrupt;
  interrupt.stop_once();
  CHECK_THROWS_AS(write_gallery(folder.path(), interrupt), Interrupted);
  CHECK(folder.entry_count() == 0);
}

TEST_CASE("pictures go with the list of scenes alone") {
  const auto parsed = [](std::vector<std::string> words) { return parse_command_line(words).options<ListOptions>().kinds; };
  CHECK(parsed({"list", "--pictures=a"}) == std::vector<std::string>{"scenes"});
  CHECK(parsed({"list", "scenes", "--pictures=a"}) == std::vector<std::string>{"scenes"});
  CHECK_THROWS_WITH_AS(parsed({"list", "machines", "--pictures=a"}), doctest::Contains("dmpc list --pictures=a"),
                       core::UsageError);
}

}  // namespace dmpc::apps::gallery_test
