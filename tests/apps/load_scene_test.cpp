#include "apps/load_scene.h"

#include <doctest/doctest.h>

#include <string>

#include "core/expect.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps {

namespace {

std::string complaint(const std::string& scene) {
  try {
    load_scene(scene);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("a built-in name is made, a path is read") {
  CHECK(load_scene("tetra-1").name == "tetra-1");
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "tetra-1.nff", "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 30\nhither 1\nresolution 8 8\ns 0 0 0 1\n");
  CHECK(load_scene((folder / "tetra-1.nff").string()).spheres.size() == 1);
}

TEST_CASE("what is neither is refused: a bare word as a name, anything else as a file") {
  CHECK(complaint("nonsense").find("teapot") != std::string::npos);
  CHECK(complaint("nonsense.nff").find("nonsense.nff") == 0);
  CHECK(complaint("./nonsense").find("./nonsense") == 0);
  CHECK(complaint(".").find("folder") != std::string::npos);
  CHECK_FALSE(complaint("").empty());
}

TEST_CASE("a scene's own resolution is bounded, unless another is asked for") {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "huge.nff";
  tests::write_text(path, "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 30\nhither 1\nresolution 65535 65535\ns 0 0 0 1\n");
  CHECK_THROWS_WITH_AS(load_scene(PictureOptions{.scene = path}),
                       doctest::Contains("huge.nff:7: found the resolution 65535 65535"), core::InputError);
  CHECK(load_scene(PictureOptions{.scene = path, .resolution = Resolution{8, 8}}).view.width == 65535);
}

}  // namespace dmpc::apps
