#include "apps/lab/figures/figures_file.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "core/base/expect.h"
#include "tests/support/temporary_folder.h"

namespace dmpc::apps::figures_file_test {

namespace {

std::string names_and_values(const std::vector<Figure>& figures) {
  std::string text;
  for (const Figure& figure : figures) {
    text += figure.name + "=" + text_of(figure.value) + " ";
  }
  return text;
}

}  // namespace

TEST_CASE("every value of a file is a figure, called by the keys and places that lead to it, in the file's order") {
  const auto figures = parse_figures(
      R"({"format": 2, "z": {"b": 2, "a": [3, {"c": null}]}, "real": 0.5, "below": -1, "is": true, "name": "svm"})", "f.json");
  CHECK(names_and_values(figures) == "format=2 z.b=2 z.a.0=3 z.a.1.c=null real=0.5 below=-1 is=true name=svm ");
}

TEST_CASE("what has nothing in it has no figures") {
  CHECK(names_and_values(parse_figures(R"({"format": 2, "none": {}, "empty": []})", "f.json")) == "format=2 ");
}

TEST_CASE("a file of another format, or of none, is refused with what was expected") {
  CHECK_THROWS_WITH_AS(parse_figures("{\"format\": 3}", "f.json"),
                       "f.json: expected \"format\": 2, as dmpc render --stats writes it, got 3", core::InputError);
  for (const std::string text : {"{}", "[1]", "7", "{\"format\": \"1\"}"}) {
    CHECK_THROWS_WITH_AS(parse_figures(text, "f.json"), doctest::Contains("expected \"format\": 2"), core::InputError);
  }
}

TEST_CASE("what is no JSON is refused by the name of the file") {
  for (const std::string text : {"", "{", "{\"a\": 1e999}", "no"}) {
    CAPTURE(text);
    CHECK_THROWS_WITH_AS(parse_figures(text, "f.json"), doctest::Contains("f.json: this is no JSON"), core::InputError);
  }
}

TEST_CASE("objects deeper in each other than any of ours are refused") {
  const auto nested = [](std::size_t depth) {
    return "{\"format\": 2, \"a\": " + std::string(depth, '[') + std::string(depth, ']') + "}";
  };
  CHECK(parse_figures(nested(31), "f.json").size() == 1);
  CHECK_THROWS_WITH_AS(parse_figures(nested(100'000), "f.json"), doctest::Contains("at most 32"), core::InputError);
}

TEST_CASE("a file that cannot be read is told by its name, once") {
  const tests::TemporaryFolder folder;
  CHECK_THROWS_WITH_AS(read_figures(folder / "none.json"), doctest::Contains("none.json: "), core::InputError);
  tests::write_text(folder / "bad.json", "no");
  const std::string name = folder / "bad.json";
  CHECK_THROWS_WITH_AS(read_figures(name), (name + ": this is no JSON; expected what dmpc render --stats writes").c_str(),
                       core::InputError);
}

TEST_CASE("a file with more bytes than any of ours has is refused") {
  const tests::TemporaryFolder folder;
  tests::write_text(folder / "large.json", "{");
  std::filesystem::resize_file(folder / "large.json", apps::figures_bytes_max + 1);
  CHECK_THROWS_WITH_AS(
      apps::read_figures(folder / "large.json"),
      ((folder / "large.json").string() + ": has more than 128 MiB, expected what dmpc render --stats writes").c_str(),
      core::InputError);
}

TEST_CASE("a figure stands within its own key, within one above it, and within one with a star for any name") {
  CHECK(is_within("pages.faults", "pages.faults"));
  CHECK(is_within("pages.faults", "pages"));
  CHECK(is_within("nodes.3.pages.faults", "nodes.*.pages"));
  CHECK_FALSE(is_within("pages.faults", "page"));
  CHECK_FALSE(is_within("pages", "pages.faults"));
  CHECK_FALSE(is_within("nodes.3.work.pixels", "nodes.*.pages"));
}

}  // namespace dmpc::apps::figures_file_test
