#include "apps/lab/check/command.h"

#include <doctest/doctest.h>

#include <sstream>
#include <string>
#include <utility>

#include "core/base/expect.h"
#include "tests/support/mesh_files.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::check_command_test {
namespace {

/// What a command prints to stdout, and its status.
struct Said {
  int status = -1;
  std::string text;
};

Said check(const apps::CheckOptions& options) {
  std::ostringstream output;
  apps::Interrupt interrupt;
  const int status = apps::check_command(options, interrupt, output);
  return {status, output.str()};
}

apps::CheckOptions small(const std::string& scene) {
  apps::CheckOptions options;
  options.picture.scene = scene;
  options.picture.resolution = apps::Resolution{40, 30};
  return options;
}

TEST_CASE("check prints a table and ends with status 0 where every ray is explained") {
  const Said said = check(small("tetra-3"));
  CHECK(said.status == 0);
  CHECK(said.text.find("tetra-3: 64 primitives, 40x30 pixels") != std::string::npos);
  CHECK(said.text.find("primary            1200") != std::string::npos);
  CHECK(said.text.find("Pixels that Embree would change: 0 of 1200, 0.0 ppm") != std::string::npos);
  CHECK(said.text.find("Failed: nothing.") != std::string::npos);
}

TEST_CASE("check says of a file whether it was read where it stands, and ends in one line of all that was tried") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", triangle_obj);
  const Said said = check(small((folder / "a.obj").string()));
  CHECK(said.status == 0);
  CHECK(contains(said.text, "The file's own positions, read by the oracle: 0 of 1,200 pixels see another place\nTried: "));
  CHECK(contains(said.text, " rays, 1,200 places. Failed: nothing. Worst: "));
  CHECK(said.text.find('\n', said.text.find("Tried: ")) == said.text.size() - 1);
  CHECK_FALSE(contains(check(small("tetra-3")).text, "own positions"));
}

TEST_CASE("check tests random rays against every primitive when asked to") {
  apps::CheckOptions options = small("rings-1");
  CHECK(check(options).text.find("Brute force") == std::string::npos);
  options.brute_force = 50;
  CHECK(check(options).text.find("Brute force: 50 random rays") != std::string::npos);
}

TEST_CASE("check holds certificates of random hits against rational arithmetic when asked to") {
  apps::CheckOptions options = small("balls-1");
  CHECK(check(options).text.find("Certificates") == std::string::npos);
  options.certify = 300;
  const Said said = check(options);
  CHECK(said.status == 0);
  CHECK(said.text.find("Certificates: 300 random hits against rational arithmetic: 0 fail, ") != std::string::npos);
  CHECK(said.text.find("interval of the exact t: median ") != std::string::npos);
}

TEST_CASE("check honours convention, depth and samples") {
  apps::CheckOptions options = small("mount-2");
  options.picture.samples = 2;
  CHECK(check(options).text.find("primary            2400") != std::string::npos);
  options.picture.depth = 1;
  CHECK(check(options).text.find("reflected             0") != std::string::npos);
  const std::string haines = check(options).text;
  options.picture.convention = core::Convention::paper;
  CHECK(check(options).text != haines);
}

TEST_CASE("check traces the structure that is asked for, and says which") {
  CHECK(check(small("balls-1")).text.find("40x30 pixels, our grid against Embree ") != std::string::npos);
  for (const auto& [structure, name] : {std::pair(core::Structure::voxels, "voxels"), {core::Structure::extents, "extents"}}) {
    apps::CheckOptions options = small("balls-1");
    options.database.build.structure = structure;
    options.certify = 100;
    const Said said = check(options);
    CHECK(said.status == 0);
    CHECK(said.text.find(std::string("40x30 pixels, our ") + name + " against Embree ") != std::string::npos);
    CHECK(said.text.find("Failed: nothing.") != std::string::npos);
  }
}

TEST_CASE("check sends rays into meshes that are kept, and says so") {
  apps::CheckOptions options = small("grove-2");
  options.database.build.structure = core::Structure::extents;
  options.database.build.keeps_instances = true;
  options.certify = 100;
  const Said said = check(options);
  CHECK(said.status == 0);
  CHECK(said.text.find("40x30 pixels, our extents with base meshes against Embree ") != std::string::npos);
  CHECK(said.text.find("Failed: nothing.") != std::string::npos);
}

TEST_CASE("check of a scene that does not exist is bad input") {
  CHECK_THROWS_AS(check(small("no-such-scene")), core::InputError);
}

}  // namespace
}  // namespace dmpc::tests::check_command_test
