#include "apps/lab/study/scale/figures.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <optional>
#include <string>

#include "core/base/expect.h"

namespace dmpc::tests::figures_test {

using apps::ScaleFigures;

namespace {

/// What `render --stats` writes of a run of 100 rays on two nodes, as far as it is read.
const std::string statistics = R"({"format": 2, "film_hash": "0123456789abcdef",
  "rays": {"total": 100}, "packets": {"sent": 50}, "pages": {"faults": 20, "distinct_per_pixel": 2.5},
  "travel": null, "database": {"bytes": 3000000, "primitives": 77},
  "seconds": {"load": 1.0, "build": 2.0, "prepare": 4.0, "render": 8.0, "write": 16.0, "user": 99.0, "system": 99.0,
              "render_user": 0.5, "render_system": 0.25},
  "nodes": [{"memory": {"planned": {"total": 1000000}}}, {"memory": {"planned": {"total": 1500000}}}]})";

ScaleFigures figures_of(const std::string& stats, std::optional<std::size_t> memory_bytes) {
  return apps::scale_figures_of(apps::parse_figures(stats, "stats.json"), memory_bytes);
}

ScaleFigures round_of(double seconds, const std::string& film = "a") {
  ScaleFigures figures;
  figures.by_name["render"] = seconds;
  figures.film_hash = film;
  return figures;
}

}  // namespace

TEST_CASE("figures of a run are read from its statistics") {
  const ScaleFigures figures = figures_of(statistics, 7'000'000);
  CHECK(figures["build"] == 2);
  CHECK(figures["total"] == 31);
  CHECK(figures["processor"] == 0.75);
  CHECK(figures["database"] == 3);
  CHECK(figures["memory"] == 7);
  CHECK(figures["local memory"] == 2.5);
  CHECK(figures["faults a ray"] == 0.2);
  CHECK(figures["packets a ray"] == 0.5);
  CHECK(figures["pages a pixel"] == 2.5);
  CHECK_FALSE(figures["moves a ray"]);
  CHECK(figures.primitives == 77);
  CHECK(figures.film_hash == "0123456789abcdef");
}

TEST_CASE("memory that was not seen is no figure") { CHECK_FALSE(figures_of(statistics, std::nullopt)["memory"]); }

TEST_CASE("moves are rays that dataflow sent to another node, not links that they passed") {
  const std::string travel = "\"travel\": {\"messages_per_ray\": 0.75}";
  std::string of_dataflow = statistics;
  of_dataflow.replace(of_dataflow.find("\"travel\": null"), 14, travel);
  CHECK(figures_of(of_dataflow, 0)["moves a ray"] == 0.75);
}

TEST_CASE("statistics that cannot be read are a fault of our own") {
  for (const char* text : {"{\"format\": 2}", "{\"format\": 2, \"rays\": 3}"}) {
    CHECK_THROWS_AS(figures_of(text, 0), core::InternalError);
  }
}

TEST_CASE("every figure of a run has a column of its own") {
  const auto& columns = apps::scale_figure_columns();
  std::string of_all = statistics;
  of_all.replace(of_all.find("\"travel\": null"), 14, "\"travel\": {\"messages_per_ray\": 0.75}");
  const ScaleFigures figures = figures_of(of_all, 1);
  CHECK(figures.by_name.size() == columns.size());
  CHECK(std::all_of(columns.begin(), columns.end(), [&](const auto& column) { return figures[column.name].has_value(); }));
}

TEST_CASE("of several rounds the middle counts, and they give one film") {
  const ScaleFigures middle = apps::median_figures({round_of(3), round_of(90), round_of(1)});
  CHECK(middle["render"] == 3);
  CHECK_FALSE(middle["faults a ray"]);
  CHECK(apps::median_figures({round_of(5)})["render"] == 5);
  CHECK_THROWS_AS(apps::median_figures({round_of(3), round_of(3, "b")}), core::InternalError);
}

}  // namespace dmpc::tests::figures_test
