// Light of any strength is in the picture as it is, or a line says what is not.
#include <doctest/doctest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "apps/picture/image_file.h"
#include "tests/support/run_dmpc.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::tests::light_range_test {

namespace {

/// A matt wall, seen and lit from the eye, with an adjustable intensity.
struct Wall {
  TemporaryFolder folder;

  explicit Wall(const std::string& light, const std::string& more = "") {
    write_text(folder / "a.nff", "v\nfrom 0 0 2\nat 0 0 0\nup 0 1 0\nangle 20\nhither 0.1\nresolution 8 8\nl 0 0 2 " + light +
                                     " " + light + " " + light + "\n" + more +
                                     "f 1 0.5 0.25 0.5 0 0 0 0\np 4\n-9 -9 0\n9 -9 0\n9 9 0\n-9 9 0\n");
  }
  /// What it says.
  std::string render(const std::vector<std::string>& options = {}) const {
    const Said said = run_dmpc(together({{"render", folder / "a.nff", "--nodes=2", "-o", folder / "a.exr"},
                                         {"--stats=" + (folder / "s.json").string()},
                                         options}));
    CHECK(said.status == 0);
    return said.errors;
  }
  /// Maximum of the red channel.
  float brightest() const {
    const std::vector<float> values = apps::read_image(folder / "a.exr").rgb;
    return *std::max_element(values.begin(), values.end());
  }
};

}  // namespace

TEST_CASE("light of 10^-10 and of 10^12 is in the picture, without a word, by every strategy") {
  for (const std::string strategy : {"svm", "dataflow"}) {
    const Wall dim("1e-10"), glaring("1e12");
    CHECK(dim.render({"--strategy=" + strategy}).empty());
    CHECK(dim.brightest() == doctest::Approx(0.5e-10).epsilon(0.01));
    CHECK(contains(file_text(dim.folder / "s.json"), "\"film_scale\": 17179869184.0"));
    CHECK(contains(file_text(dim.folder / "a.exr"), "2^34"));
    CHECK(glaring.render({"--strategy=" + strategy}).empty());
    CHECK(glaring.brightest() == doctest::Approx(0.5e12).epsilon(0.01));
  }
}

TEST_CASE("light that a bound did not tell of is cut with a word, and light far below all other is said") {
  const Wall bright("2e9");
  CHECK(contains(bright.render({"--samples=16"}), "64 of 64 pixels are brighter than the film can hold and were clipped"));
  const Wall dim("1e-10", "l 0 0 -2 1 1 1\n");
  CHECK(contains(dim.render(), "the picture is black, though 64 shadow rays reached a light"));
}

}  // namespace dmpc::tests::light_range_test
