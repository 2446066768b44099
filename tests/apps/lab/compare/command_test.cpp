#include "apps/lab/compare/command.h"

#include <doctest/doctest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "apps/edge/line/exit_status.h"
#include "apps/picture/image_file.h"
#include "core/base/expect.h"
#include "tests/support/gray.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/text.h"

namespace dmpc::apps::compare_command_test {

using tests::gray;

TEST_CASE("the command compares files, prints the figures and writes the difference picture") {
  const tests::TemporaryFolder folder;
  write_image(folder / "a.exr", gray(3, 2, 0.5F));
  write_image(folder / "b.exr", gray(3, 2, 0.25F));
  std::ostringstream output;
  Interrupt interrupt;
  CHECK(compare_command({folder / "a.exr", folder / "b.exr", folder / "d.exr"}, interrupt, output) == 0);
  CHECK(output.str().find("root mean square error  0.25\n") != std::string::npos);
  CHECK(output.str().find("differing pixels        6 of 6 (100 %)\n") != std::string::npos);
  CHECK(read_image(folder / "d.exr").rgb == gray(3, 2, 0.25F).rgb);
}

TEST_CASE("figures come as JSON, where an infinite ratio is null, and the perceived differences as a picture") {
  const tests::TemporaryFolder folder;
  write_image(folder / "a.exr", gray(3, 2, 0.5F));
  std::ostringstream output;
  Interrupt interrupt;
  CompareOptions options{folder / "a.exr", folder / "a.exr"};
  options.flip = folder / "f.exr";
  options.format = CompareFormat::json;
  CHECK(compare_command(options, interrupt, output) == 0);
  const auto json = nlohmann::json::parse(output.str());
  CHECK(json["root_mean_square"] == 0);
  CHECK(json["peak_signal_to_noise_decibels"].is_null());
  CHECK(json["pixels"] == 6);
  CHECK(read_image(folder / "f.exr").rgb == gray(3, 2, 0).rgb);
}

TEST_CASE("pictures that lie further apart than a limit end with a status of its own, and the figures are printed all the same") {
  const tests::TemporaryFolder folder;
  write_image(folder / "a.exr", gray(3, 2, 0.5F));
  write_image(folder / "b.exr", gray(3, 2, 0.25F));
  std::ostringstream output;
  Interrupt interrupt;
  CompareOptions options{folder / "a.exr", folder / "b.exr"};
  options.limits = {parse_limit("rmse:1/4"), parse_limit("max:0.25")};
  options.format = CompareFormat::json;
  CHECK(compare_command(options, interrupt, output) == 0);
  CHECK(nlohmann::json::parse(output.str())["passed_limits"].empty());
  output.str("");
  options.limits.push_back(parse_limit("mae:1/5"));
  CHECK(compare_command(options, interrupt, output) == differs_status);
  CHECK(nlohmann::json::parse(output.str())["passed_limits"] == nlohmann::json({"mae 0.25 is above 1/5"}));
}

TEST_CASE("counters that differ are printed with both values, with a status of their own") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.json", R"({"format": 1, "pages": {"faults": 2, "misses": 3}})");
  tests::write_text(folder / "b.json", R"({"format": 1, "pages": {"faults": 2, "misses": 4}})");
  std::ostringstream output;
  Interrupt interrupt;
  CompareOptions options{folder / "a.json", folder / "b.json"};
  CHECK(compare_command(options, interrupt, output) == differs_status);
  CHECK(tests::contains(output.str(), "pages.misses  A 3  B 4\n3 figures compared, 1 differs\n"));
  output.str("");
  options.reference = options.a;
  CHECK(compare_command(options, interrupt, output) == 0);
  CHECK(tests::contains(output.str(), "3 figures compared, 0 differ\n"));
}

TEST_CASE("counters that differ come as JSON, too, without the side where there is none") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.json", R"({"format": 1, "x": null})");
  tests::write_text(folder / "b.json", R"({"format": 1, "x": 2, "y": "z"})");
  std::ostringstream output;
  Interrupt interrupt;
  CompareOptions options{folder / "a.json", folder / "b.json"};
  options.format = CompareFormat::json;
  CHECK(compare_command(options, interrupt, output) == differs_status);
  const auto json = nlohmann::json::parse(output.str());
  CHECK(json["format"] == 1);
  CHECK(json["compared"] == 3);
  CHECK(json["differences"].dump() == R"([{"a":null,"b":2,"figure":"x"},{"b":"z","figure":"y"}])");
}

TEST_CASE("of many differences a hundred are shown as text") {
  const tests::TemporaryFolder folder;
  std::string a = R"({"format": 1, "x": [)", b = a;
  for (int i = 0; i < 150; ++i) {
    a += "1,";
    b += "2,";
  }
  tests::write_text(folder / "a.json", a + "0]}");
  tests::write_text(folder / "b.json", b + "0]}");
  std::ostringstream output;
  Interrupt interrupt;
  CHECK(compare_command({folder / "a.json", folder / "b.json"}, interrupt, output) == differs_status);
  CHECK(tests::contains(output.str(), "x.99"));
  CHECK_FALSE(tests::contains(output.str(), "x.100"));
  CHECK(tests::contains(output.str(), "and 50 more: --format=json has them all\n"));
}

TEST_CASE("two outputs of one name are refused") {
  const tests::TemporaryFolder folder;
  std::ostringstream output;
  Interrupt interrupt;
  CHECK_THROWS_AS(compare_command({folder / "a.exr", folder / "b.exr", folder / "c.exr", folder / "c.exr"}, interrupt, output),
                  core::UsageError);
}

TEST_CASE("no difference picture is written when the sizes differ") {
  const tests::TemporaryFolder folder;
  write_image(folder / "a.exr", gray(3, 2, 0));
  write_image(folder / "b.exr", gray(2, 3, 0));
  std::ostringstream output;
  Interrupt interrupt;
  CHECK_THROWS_AS(compare_command({folder / "a.exr", folder / "b.exr", folder / "d.exr"}, interrupt, output), core::InputError);
  CHECK_FALSE(std::filesystem::exists(folder / "d.exr"));
}

TEST_CASE("a difference picture that would replace one of the two is refused before anything is read") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "a.exr", "no picture");
  std::ostringstream output;
  Interrupt interrupt;
  CHECK_THROWS_AS(compare_command({folder / "a.exr", folder / "b.exr", folder / "a.exr"}, interrupt, output), core::UsageError);
  CHECK_THROWS_AS(compare_command({folder / "a.exr", folder / "b.exr", folder / "b.exr"}, interrupt, output), core::UsageError);
  CHECK(tests::file_text(folder / "a.exr") == "no picture");
}

TEST_CASE("figures that cannot be printed are an error") {
  const tests::TemporaryFolder folder;
  write_image(folder / "a.exr", gray(1, 1, 0));
  std::ofstream full("/dev/full");
  Interrupt interrupt;
  CHECK_THROWS_AS(compare_command({folder / "a.exr", folder / "a.exr"}, interrupt, full), core::InputError);
}

}  // namespace dmpc::apps::compare_command_test
