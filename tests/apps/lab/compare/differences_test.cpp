#include "apps/lab/compare/differences.h"

#include <doctest/doctest.h>

#include <string>

#include "core/base/expect.h"

namespace dmpc::apps::differences_test {

namespace {

using Names = std::vector<std::string>;

/// The comparison of two objects, "format" put before what they have.
FigureComparison compared(const std::string& a, const std::string& b, const FigureChoice& choice = {}) {
  const auto figures = [](const std::string& text) { return parse_figures("{\"format\": 2, " + text + "}", "f.json"); };
  return compare_figures(figures(a), figures(b), choice);
}

Names differing(const std::string& a, const std::string& b, const FigureChoice& choice = {}) {
  Names names;
  for (const Difference& difference : compared(a, b, choice).differences) {
    names.push_back(difference.name);
  }
  return names;
}

}  // namespace

TEST_CASE("equal figures do not differ, whatever their order") {
  const FigureComparison result = compared(R"("a": 1, "b": [2, "x"])", R"("b": [2, "x"], "a": 1)");
  CHECK(result.compared == 4);
  CHECK(result.differences.empty());
}

TEST_CASE("a figure that differs is told with both values") {
  const FigureComparison result = compared(R"("a": 1, "b": 2)", R"("a": 1, "b": 3)");
  REQUIRE(result.differences.size() == 1);
  CHECK(result.differences[0].name == "b");
  CHECK(text_of(*result.differences[0].figure) == "2");
  CHECK(text_of(*result.differences[0].reference) == "3");
}

TEST_CASE("a figure that one file alone has differs, even where it is null") {
  const FigureComparison result = compared(R"("new": null)", R"("old": 1)");
  REQUIRE(result.differences.size() == 2);
  CHECK(result.differences[0].name == "old");
  CHECK_FALSE(result.differences[0].figure.has_value());
  CHECK(result.differences[1].name == "new");
  CHECK_FALSE(result.differences[1].reference.has_value());
  CHECK(result.compared == 3);
}

TEST_CASE("the largest whole numbers are told apart") {
  CHECK(differing(R"("seed": 18446744073709551615)", R"("seed": 18446744073709551614)") == Names{"seed"});
}

TEST_CASE("what hangs on this computer's clock, the version and names of files and computers are left out") {
  CHECK(
      differing(R"("program": "a", "seconds": {"load": 1}, "nodes": [{"seconds": {"busy": 1}}], "host": {"seconds": {"wall": 1}},
                     "heat_maps": [{"file": "a", "clock": "processor time", "sum": 1}])",
                R"("program": "b", "seconds": {"load": 2}, "nodes": [{"seconds": {"busy": 2}}], "host": {"seconds": {"wall": 2}},
                     "heat_maps": [{"file": "b", "clock": "processor time", "sum": 2}])")
          .empty());
  CHECK(differing(R"("ranks": [{"name": "rank 0 on host a", "clock_error": 1, "nodes": 2}])",
                  R"("ranks": [{"name": "rank 0 on host b", "clock_error": 2, "nodes": 3}])") == Names{"ranks.0.nodes"});
  CHECK(differing(R"("virtual_seconds": {"total": 1}, "heat_maps": [{"clock": "virtual time", "sum": 1}])",
                  R"("virtual_seconds": {"total": 2}, "heat_maps": [{"clock": "virtual time", "sum": 2}])") ==
        Names{"virtual_seconds.total", "heat_maps.0.sum"});
}

TEST_CASE("a tolerance is a share of the reference, and brings in what is left out otherwise") {
  const FigureChoice choice{.tolerances = {{"pages", 0.1}, {"seconds", 0.5}}};
  CHECK(differing(R"("pages": {"faults": 110}, "seconds": {"load": 3})", R"("pages": {"faults": 100}, "seconds": {"load": 2})",
                  choice)
            .empty());
  CHECK(differing(R"("pages": {"faults": 111}, "seconds": {"load": 3.1})", R"("pages": {"faults": 100}, "seconds": {"load": 2})",
                  choice) == Names{"pages.faults", "seconds.load"});
  CHECK(differing(R"("pages": null, "seconds": 1)", R"("pages": 1, "seconds": 1)", choice) == Names{"pages"});
}

TEST_CASE("of several tolerances for a figure the last one counts") {
  const FigureChoice choice{.tolerances = {{"pages", 1}, {"pages.faults", 0}}};
  CHECK(differing(R"("pages": {"faults": 2, "hits": 2})", R"("pages": {"faults": 1, "hits": 1})", choice) ==
        Names{"pages.faults"});
}

TEST_CASE("with --only what lies below its keys is compared and nothing else") {
  const FigureComparison result =
      compared(R"("a": {"x": 1, "y": 1}, "b": 1)", R"("a": {"x": 2, "y": 1}, "b": 2)", {.only = {"a"}});
  CHECK(result.compared == 2);
  CHECK(result.differences.size() == 1);
}

TEST_CASE("a key at which there is no figure is refused, with one that may have been meant") {
  CHECK_THROWS_WITH_AS(compared(R"("pages": {"faults": 1})", R"("pages": {"faults": 1})", {.only = {"pages.fautls"}}),
                       doctest::Contains("--only=pages.fautls: neither file has a figure there"), core::InputError);
  CHECK_THROWS_WITH_AS(compared(R"("pages": {"faults": 1})", R"("a": 1)", {.tolerances = {{"pages.fautls", 1}}}),
                       doctest::Contains("Did you mean pages.faults?"), core::InputError);
}

TEST_CASE("a tolerance is typed as keys, a colon and a share") {
  CHECK(parse_tolerance("nodes.*.pages:1/20").key == "nodes.*.pages");
  CHECK(parse_tolerance("a:1/20").share == 0.05);
  CHECK(parse_tolerance("a:2").share == 2);
  for (const std::string text : {"", "a", "a:", ":1", "a:x", "a:-1"}) {
    CHECK_THROWS_WITH_AS(parse_tolerance(text), doctest::Contains("such as pages.faults:0.05"), core::UsageError);
  }
}

}  // namespace dmpc::apps::differences_test
