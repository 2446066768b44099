#include "apps/lab/study/paper/price_fit.h"

#include <doctest/doctest.h>

#include <vector>

#include "apps/frontend/machine/machines.h"
#include "core/trace/charge.h"
#include "tests/support/paper_results.h"

namespace dmpc::tests::price_fit_test {

using namespace apps;

namespace {

std::uint64_t price(const nodes::Machine& machine, core::Charge charge) {
  return machine.cost_ps[static_cast<std::size_t>(charge)];
}

PricedCell cell_of(double walk, double rays, double cached_lookup, double rest, double printed) {
  return {{{walk, rays, cached_lookup}, rest}, printed};
}

/// A small scene by the article's rule, on one node and on four whose memories do not hold it.
std::vector<PaperRun> voxel_runs(const VoxelPrices& prices) {
  PaperRun run{.scene = "rings-1-t1", .machine = voxel_machine(prices), .structure = core::Structure::voxels, .resolution = 24};
  std::vector<PaperRun> runs(2, run);
  runs[1].node_count = 4;
  runs[1].shared_pages = 20;
  return runs;
}

}  // namespace

TEST_CASE("prices in closed form: 3 of a traversal, 2 of a ray, 5 of a look-up") {
  const std::vector<PricedCell> cells = {cell_of(1, 1, 0, 0, 5), cell_of(2, 1, 0, 1, 9), cell_of(1, 1, 1, 0.5, 10.5)};
  const auto prices = fit_prices(cells);
  REQUIRE(prices);
  CHECK(prices->walk == doctest::Approx(3));
  CHECK(prices->rays == doctest::Approx(2));
  CHECK(prices->cached_lookup == doctest::Approx(5));
}

TEST_CASE("no price is negative: what would be is nothing, and the others do as well as they can") {
  const std::vector<PricedCell> cells = {cell_of(1, 1, 0, 0, 1), cell_of(2, 1, 0, 0, 3), cell_of(1, 1, 1, 0, 2)};  // rays: -1
  const auto prices = fit_prices(cells);
  REQUIRE(prices);
  CHECK(prices->rays == 0);
  CHECK(prices->walk > 1);
  CHECK(prices->cached_lookup > 0);
}

TEST_CASE("a price that cells leave open is nothing, and no cells fit none") {
  const auto prices = fit_prices(std::vector<PricedCell>{cell_of(2, 0, 0, 1, 7)});
  REQUIRE(prices);
  CHECK(*prices == VoxelPrices{.walk = 3});
  CHECK_FALSE(fit_prices({}).has_value());
}

TEST_CASE("where messages alone take longer than is printed, operations are for nothing") {
  CHECK(fit_prices(std::vector<PricedCell>{cell_of(2, 1, 1, 9, 7)}) == VoxelPrices{});
}

TEST_CASE("errors are relative: a cell of ten times the time pulls no harder") {
  const std::vector<PricedCell> cells = {cell_of(1, 0, 0, 0, 1), cell_of(10, 0, 0, 0, 20)};
  CHECK(fit_prices(cells)->walk == doctest::Approx(1.5 / 1.25));  // of (w - 1)^2 + (w / 2 - 1)^2
}

TEST_CASE(
    "the machine of voxels ties a step to a test and a ray to a hit, and leaves pages and messages as the preset has them") {
  const nodes::Machine& preset = find_machine_preset("ipsc2")->machine;
  const nodes::Machine machine = voxel_machine({.walk = 2, .rays = 3, .cached_lookup = 4});
  CHECK(price(machine, core::Charge::cell_step) == 2 * 7'500);
  CHECK(price(machine, core::Charge::triangle_test) == 2 * (14'700 + 3'700));
  CHECK(price(machine, core::Charge::ray_setup) == 3 * 55'000);
  CHECK(price(machine, core::Charge::shading) == 3 * 167'000);
  CHECK(price(machine, core::Charge::cached_lookup) == 4 * 3'160);
  CHECK(price(machine, core::Charge::page_install) == price(preset, core::Charge::page_install));
  CHECK(machine.service_ns == preset.service_ns);
  CHECK(machine.topology == preset.topology);
}

TEST_CASE("the time of a ray by its run's own prices is what the run took, and other prices change it by what was charged") {
  const std::vector<PaperRun> runs = voxel_runs(fitted_voxel_prices);
  const PaperResults results = carried_out(runs, paper_subjects(runs));
  for (std::size_t i = 0; i < runs.size(); ++i) {
    CAPTURE(i);
    REQUIRE(results[i]);
    const RayTime time = ray_time_of(*results[i]);
    const double taken = 1e-6 * static_cast<double>(results[i]->parts.total_ns()) / static_cast<double>(results[i]->rays);
    CHECK(time.milliseconds(fitted_voxel_prices) == doctest::Approx(taken).epsilon(1e-6));
  }
  VoxelPrices dearer = fitted_voxel_prices;
  dearer.rays *= 2;
  const std::vector<PaperRun> others = voxel_runs(dearer);
  const PaperResults slower = carried_out(others, paper_subjects(others));
  CHECK(ray_time_of(*results[0]).milliseconds(dearer) ==
        doctest::Approx(1e-6 * static_cast<double>(slower[0]->total_ns) / static_cast<double>(slower[0]->rays)).epsilon(1e-4));
}

TEST_CASE("runs on voxels have the film of those on the grid, and their caches hold what a node's own pages leave") {
  std::vector<PaperRun> runs = voxel_runs(fitted_voxel_prices);
  runs.push_back(runs[0]);
  runs[2].structure = core::Structure::grid;
  const std::vector<PaperSubject> subjects = paper_subjects(runs);
  REQUIRE(subjects.size() == 2);
  const auto pages = static_cast<std::uint32_t>(subjects[0].subject.database.page_count()), own = (pages + 3) / 4;
  REQUIRE(pages > own + 7);
  runs[1].shared_pages = own + 7;
  const PaperResults results = carried_out(runs, subjects);
  REQUIRE((results[0] && results[1] && results[2]));
  CHECK(results[0]->film_hash == results[2]->film_hash);
  CHECK(results[1]->cache_pages == 7);
}

}  // namespace dmpc::tests::price_fit_test
