// dmpc beside a library that changes the arithmetic of every thread: pictures and databases keep their bits.
#ifdef DMPC_FOREIGN_ARITHMETIC

#include <doctest/doctest.h>

#include <string>
#include <vector>

#include "apps/picture/image_file.h"
#include "tests/support/film_in.h"
#include "tests/support/noise_texture.h"
#include "tests/support/run_dmpc.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::tests::foreign_arithmetic_test {

namespace {

struct Rendered {
  std::string film, picture;
  bool operator==(const Rendered&) const = default;
};

Rendered render_after(const std::vector<std::string>& before, const std::vector<std::string>& options) {
  const TemporaryFolder folder;
  const std::vector<std::string> stats = {"--stats=" + (folder / "s.json").string()};
  const Said said =
      run_dmpc(together({{"render", "--quiet", "--resolution=48x48", "-o", folder / "a.png"}, stats, options}), before);
  CHECK(said.status == 0);
  CHECK(said.errors.empty());
  return {film_in(folder / "s.json"), file_text(folder / "a.png")};
}

void check_kept_beside_it(const std::vector<std::string>& options) {
  CAPTURE(options[0]);
  CAPTURE(options[1]);
  CHECK(render_after({"LD_PRELOAD=" DMPC_FOREIGN_ARITHMETIC}, options) == render_after({}, options));
}

}  // namespace

TEST_CASE("a mesh is read alike beside a library that flushes to zero and rounds down") {
  const TemporaryFolder folder;
  write_text(folder / "a.obj", "v 0.1 0.3 0.7\nv 2.1 0.3 0.1\nv 0.7 1.9 0.3\nv 0.3 0.7 1.1\nf 1 2 3\nf 1 3 4\n");
  check_kept_beside_it({folder / "a.obj", "--up=z"});
}

TEST_CASE("a library that flushes to zero and rounds down in every thread changes no picture") {
  check_kept_beside_it({"mount-5", "--strategy=svm"});
  check_kept_beside_it({"rings-3-t1", "--strategy=dataflow"});
  check_kept_beside_it({"balls-3", "--strategy=forest"});
  check_kept_beside_it({"tree-6", "--strategy=replicated"});
  check_kept_beside_it({"gears-2", "--runner=virtual"});
  check_kept_beside_it({"shells-2", "--tracer=embree", "--strategy=replicated"});
}

TEST_CASE("a texture looks alike beside a library that flushes to zero and rounds down, in 8 bits and in floats") {
  const TemporaryFolder folder;
  core::Texture bytes = noise_texture(32, 16);
  apps::Image picture(32, 16);
  for (std::size_t value = 0; value < picture.rgb.size(); ++value) {
    picture.rgb[value] = static_cast<float>(bytes.levels[0].texels[value / 3] >> value % 3 * 8 & 0xffU) / 200;
  }
  for (const std::string ending : {"png", "exr"}) {
    CAPTURE(ending);
    apps::write_image(folder / ("t." + ending), picture);
    write_text(folder / "a.mtl", "newmtl m\nmap_Kd t." + ending + "\n");
    write_text(folder / "a.obj",
               "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 2 0 0.3\nv 0.1 1.9 0\nvt 0 0\nvt 1.7 0\nvt 0 1.3\nf 1/1 2/2 3/3\n");
    check_kept_beside_it({folder / "a.obj", "--up=z"});
  }
}

TEST_CASE("a library that flushes to zero and rounds down changes no table of a study, whose runs go side by side") {
  const auto table = [](const std::string& surroundings) {
    const Said said =
        run_dmpc({"study", "cache", "balls-2", "--resolution=32x32", "--machine=ipsc2", "--nodes=4", "--quiet"}, {surroundings});
    CHECK(said.status == 0);
    return said.output;
  };
  CHECK(table("LD_PRELOAD=" DMPC_FOREIGN_ARITHMETIC) == table("LD_PRELOAD="));
}

}  // namespace dmpc::tests::foreign_arithmetic_test

#endif
