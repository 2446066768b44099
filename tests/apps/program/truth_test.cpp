// What dmpc says stays true where other options are given, and what it writes is what the name says.

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "tests/support/run_dmpc.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::truth_test {

TEST_CASE("a scene is written under names alone by which it is read again") {
  const TemporaryFolder folder;
  for (const std::string name : {"a.gltf", "a.obj", "a.ply", "a.nff.gz", "a."}) {
    CAPTURE(name);
    const Said refused = run_dmpc({"scene", "tetra-1", "-o", folder / name});
    CHECK(refused.status == 2);
    CHECK(contains(refused.errors, "tetra-1 is written as NFF: expected a name that ends in .nff, or has no ending"));
  }
  for (const std::string scene : {"landscape-2", "grove"}) {
    const Said refused = run_dmpc({"scene", scene, "-o", folder / "a.nff"});
    CHECK(refused.status == 2);
    CHECK(contains(refused.errors, scene + " is no NFF scene, as it has textures: dmpc render " + scene));
  }
  CHECK(folder.entry_count() == 0);
  for (const std::string name : {"a.nff", "a.NFF", "a"}) {
    CHECK(run_dmpc({"scene", "tetra-1", "-o", folder / name}).status == 0);
    CHECK(run_dmpc({"info", folder / name, "--nodes=1"}).status == 0);
  }
}

TEST_CASE("what a mesh file's view and lights would be is not said where others are given") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", "v 0 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string file = folder / "a.obj";
  CHECK(contains(run_dmpc({"info", file, "--nodes=1"}).errors, "the whole is in view"));
  CHECK(run_dmpc({"info", file, "--nodes=1", "--camera=4,3,5/0,0,0"}).errors.empty());
  CHECK(contains(run_dmpc({"info", file, "--nodes=1", "--light=4,3,5"}).errors, "the whole is in view"));
}

TEST_CASE("names that steer a terminal are shown on it, and not obeyed") {
  const TemporaryFolder folder;
  const std::string name = folder / "\x1b[2Jred\xE2\x80\xAE.nff";
  const Said missing = run_dmpc({"info", name});
  CHECK(missing.status == 1);
  CHECK(contains(missing.errors, "\\x1b[2Jred\\u202e.nff"));
  REQUIRE(run_dmpc({"scene", "tetra-1", "-o", name}).status == 0);
  const Said rendered = run_dmpc({"render", name, "--resolution=4x4", "--stats", folder / "a.json", "-o", folder / "\x9b.png"});
  CHECK(rendered.status == 0);
  CHECK(contains(rendered.output, "\\x1b[2Jred\\u202e.nff"));
  CHECK(contains(rendered.output, "\\x9b.png"));
  CHECK(contains(file_text(folder / "a.json"), "\\u001b[2Jred"));
  CHECK_FALSE(contains(rendered.output + rendered.errors, "\x1b"));
}

}  // namespace dmpc::tests::truth_test
