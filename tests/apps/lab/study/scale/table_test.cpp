#include "apps/lab/study/scale/table.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <variant>

#include "tests/support/table_cells.h"

namespace dmpc::tests::scale_table_test {

using apps::ScaleFigures;
using apps::ScaleMethod;
using apps::ScalePart;
using apps::ScaleResult;
using apps::ScaleSettings;
using apps::Table;

namespace {

/// A scene of 4^size triangles that is built in seconds^exponent, with a fault a ray from size 7 on.
ScaleResult of_size(int size, double exponent, ScaleMethod method = ScaleMethod::cache) {
  ScaleFigures figures;
  figures.primitives = std::uint64_t{1} << (2U * static_cast<unsigned>(size));
  figures.by_name["build"] = std::pow(static_cast<double>(figures.primitives), exponent);
  figures.by_name["faults a ray"] = size < 7 ? 0 : 1;
  return {.run = {ScalePart::sizes, {.family = "tetra", .size = size}, method, 8}, .figures = figures, .misfit = {}};
}

ScaleResult of_nodes(std::uint32_t count, double render_seconds) {
  ScaleFigures figures;
  figures.primitives = 64;
  figures.by_name["render"] = render_seconds;
  return {.run = {ScalePart::nodes, {.family = "tetra", .size = 3}, ScaleMethod::cache, count}, .figures = figures, .misfit = {}};
}

ScaleResult misfit(int size) {
  return {.run = {ScalePart::sizes, {.family = "tetra", .size = size}, ScaleMethod::cache, 8},
          .figures = {},
          .misfit = "too little memory"};
}

}  // namespace

TEST_CASE("the growth over all sizes and over the last three stands below the rows, and in the notes") {
  const Table table = apps::scale_table({of_size(5, 1), of_size(6, 1), of_size(7, 1), of_size(8, 1)}, ScaleSettings());
  REQUIRE(table.rows().size() == 6);
  CHECK(text(table, 3, "part") == "sizes");
  CHECK(text(table, 4, "part") == "growth by size");
  CHECK(text(table, 4, "scene") == "tetra-5 to tetra-8");
  CHECK(text(table, 5, "scene") == "tetra-6 to tetra-8");
  CHECK(real(table, 4, "build") == doctest::Approx(1));
  CHECK(has_note(table, "Growth, tetra-5 to tetra-8, svm 1MiB: build 1.00, faults a ray 0.00 (2 of 4 rows)."));
}

TEST_CASE("every method grows by its own exponent") {
  const Table table = apps::scale_table(
      {of_size(5, 1), of_size(5, 2, ScaleMethod::dataflow), of_size(6, 1), of_size(6, 2, ScaleMethod::dataflow)},
      ScaleSettings());
  REQUIRE(table.rows().size() == 6);
  CHECK(text(table, 4, "method") == "svm 1MiB");
  CHECK(real(table, 4, "build") == doctest::Approx(1));
  CHECK(text(table, 5, "method") == "dataflow");
  CHECK(real(table, 5, "build") == doctest::Approx(2));
}

TEST_CASE("on more nodes the time is held against that on the first number of them") {
  const Table table = apps::scale_table({of_nodes(1, 2), of_nodes(4, 3), of_nodes(16, 8)}, ScaleSettings());
  CHECK(real(table, 0, "render over first") == 1);
  CHECK(real(table, 1, "render over first") == 1.5);
  CHECK(text(table, 3, "part") == "growth by nodes");
  CHECK(text(table, 3, "scene") == "tetra-3 on 1 to 16 nodes");
  CHECK(real(table, 3, "render") == doctest::Approx(0.5));
}

TEST_CASE("what does not fit has a row without figures, a note, and no part in the growth") {
  const Table table = apps::scale_table({of_size(5, 1), of_size(6, 1), misfit(7)}, ScaleSettings());
  REQUIRE(table.rows().size() == 4);
  CHECK(std::holds_alternative<std::monostate>(cell(table, 2, "build")));
  CHECK(std::get<std::uint64_t>(cell(table, 2, "primitives")) == 16384);
  CHECK(has_note(table, "tetra-7, svm 1MiB on 8 nodes: no figures. too little memory."));
  CHECK(text(table, 3, "scene") == "tetra-5 to tetra-6");
}

TEST_CASE("nothing, and one row, have no growth") {
  CHECK(apps::scale_table({}, ScaleSettings()).rows().empty());
  CHECK(apps::scale_table({of_size(5, 1)}, ScaleSettings()).rows().size() == 1);
  CHECK(apps::scale_table({misfit(5), misfit(6)}, ScaleSettings()).rows().size() == 2);
}

TEST_CASE("pictures of the study of scale show columns of its table, under names of their own") {
  const ScaleSettings settings;
  const Table table = apps::scale_table({of_size(5, 1), of_nodes(1, 2)}, settings);
  std::set<std::string> names;
  for (const apps::Plot& plot : apps::scale_plots(settings)) {
    CHECK(names.insert(plot.name).second);
    CHECK_NOTHROW(apps::script_of(plot, table, "t.csv"));
  }
  CHECK(names.size() == 9);
  CHECK(names.contains("scale_mount_memory"));
}

TEST_CASE("the table of scale is concluded with how the first method's time and memory grow") {
  CHECK(scale_conclusion(apps::scale_table({}, ScaleSettings())).empty());
  const std::string text =
      scale_conclusion(apps::scale_table({of_size(1, 0.5), of_size(3, 0.5), of_nodes(1, 2), of_nodes(4, 4)}, ScaleSettings()));
  CHECK(text.starts_with("From tetra-1 to tetra-3 by svm "));
  CHECK(text.find("building takes primitives to the power of 0.50") != std::string::npos);
  CHECK(text.ends_with("rendering takes nodes to the power of 0.50."));
}

}  // namespace dmpc::tests::scale_table_test
