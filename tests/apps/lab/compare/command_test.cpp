#include "apps/lab/compare/command.h"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/frontend/line/exit_status.h"
#include "apps/picture/image_file.h"
#include "core/base/expect.h"
#include "tests/support/gray.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::compare_command_test {

using tests::gray;

namespace {

/// Two files, what comes of comparing them, and where outputs may go.
struct Compared {
  /// Pictures of these sizes and shades.
  Compared(const Image& a, const Image& b) {
    write_image(folder / "a.exr", a);
    write_image(folder / "b.exr", b);
    options = {folder / "a.exr", folder / "b.exr"};
  }
  /// Files of counters.
  Compared(const std::string& a, const std::string& b) {
    tests::write_text(folder / "a.json", a);
    tests::write_text(folder / "b.json", b);
    options = {folder / "a.json", folder / "b.json"};
  }

  /// The exit status; what it prints is `text` then.
  int compare() {
    std::ostringstream output;
    const int status = compare_command(options, interrupt, output);
    text = output.str();
    return status;
  }
  nlohmann::json json() const { return nlohmann::json::parse(text); }

  tests::TemporaryFolder folder;
  CompareOptions options;
  Interrupt interrupt;
  std::string text;
};

}  // namespace

TEST_CASE("the command compares files, prints the figures and writes the difference picture") {
  Compared two(gray(3, 2, 0.5F), gray(3, 2, 0.25F));
  two.options.difference = two.folder / "d.exr";
  CHECK(two.compare() == 0);
  CHECK(tests::contains(two.text, "root mean square error  0.25\n"));
  CHECK(tests::contains(two.text, "differing pixels        6 of 6 (100 %)\n"));
  CHECK(read_image(two.folder / "d.exr").rgb == gray(3, 2, 0.25F).rgb);
}

TEST_CASE("figures come as JSON, where an infinite ratio is null, and the perceived differences as a picture") {
  Compared two(gray(3, 2, 0.5F), gray(3, 2, 0.5F));
  two.options.flip = two.folder / "f.exr";
  two.options.format = CompareFormat::json;
  CHECK(two.compare() == 0);
  CHECK(two.json()["root_mean_square"] == 0);
  CHECK(two.json()["peak_signal_to_noise_decibels"].is_null());
  CHECK(two.json()["pixels"] == 6);
  CHECK(read_image(two.folder / "f.exr").rgb == gray(3, 2, 0).rgb);
}

TEST_CASE("pictures that lie further apart than a limit end with a status of its own, and the figures are printed all the same") {
  Compared two(gray(3, 2, 0.5F), gray(3, 2, 0.25F));
  two.options.limits = {parse_limit("rmse:1/4"), parse_limit("max:0.25")};
  two.options.format = CompareFormat::json;
  CHECK(two.compare() == 0);
  CHECK(two.json()["passed_limits"].empty());
  two.options.limits.push_back(parse_limit("mae:1/5"));
  CHECK(two.compare() == differs_status);
  CHECK(two.json()["passed_limits"] == nlohmann::json({"mae 0.25 is above 1/5"}));
}

TEST_CASE("counters that differ are printed with both values, with a status of their own") {
  Compared two(R"({"format": 2, "pages": {"faults": 2, "misses": 3}})", R"({"format": 2, "pages": {"faults": 2, "misses": 4}})");
  CHECK(two.compare() == differs_status);
  CHECK(tests::contains(two.text, "pages.misses  A 3  B 4\n3 figures compared, 1 differs\n"));
  two.options.reference = two.options.a;
  CHECK(two.compare() == 0);
  CHECK(tests::contains(two.text, "3 figures compared, 0 differ\n"));
}

TEST_CASE("counters that differ come as JSON, too, without the side where there is none") {
  Compared two(R"({"format": 2, "x": null})", R"({"format": 2, "x": 2, "y": "z"})");
  two.options.format = CompareFormat::json;
  CHECK(two.compare() == differs_status);
  CHECK(two.json()["format"] == 2);
  CHECK(two.json()["compared"] == 3);
  CHECK(two.json()["differences"].dump() == R"([{"a":null,"b":2,"figure":"x"},{"b":"z","figure":"y"}])");
}

TEST_CASE("of many differences a hundred are shown as text") {
  std::string a = R"({"format": 2, "x": [)", b = a;
  for (int i = 0; i < 150; ++i) {
    a += "1,";
    b += "2,";
  }
  Compared two(a + "0]}", b + "0]}");
  CHECK(two.compare() == differs_status);
  CHECK(tests::contains(two.text, "x.99"));
  CHECK_FALSE(tests::contains(two.text, "x.100"));
  CHECK(tests::contains(two.text, "and 50 more: --format=json has them all\n"));
}

TEST_CASE("two outputs of one name, and one that would replace a file that is compared, are refused before anything is read") {
  Compared two(gray(1, 1, 0), gray(1, 1, 0));
  tests::write_text(two.options.a, "no picture");
  two.options.difference = two.options.flip = two.folder / "c.exr";
  CHECK_THROWS_AS(two.compare(), core::UsageError);
  two.options.flip.reset();
  for (const std::filesystem::path& compared : {two.options.a, two.options.reference}) {
    two.options.difference = compared;
    CHECK_THROWS_AS(two.compare(), core::UsageError);
  }
  CHECK(tests::file_text(two.options.a) == "no picture");
}

TEST_CASE("no difference picture is written when the sizes differ") {
  Compared two(gray(3, 2, 0), gray(2, 3, 0));
  two.options.difference = two.folder / "d.exr";
  CHECK_THROWS_AS(two.compare(), core::InputError);
  CHECK_FALSE(std::filesystem::exists(two.folder / "d.exr"));
}

TEST_CASE("figures that cannot be printed are an error") {
  Compared two(gray(1, 1, 0), gray(1, 1, 0));
  std::ofstream full("/dev/full");
  CHECK_THROWS_AS(compare_command(two.options, two.interrupt, full), core::InputError);
}

}  // namespace dmpc::apps::compare_command_test
