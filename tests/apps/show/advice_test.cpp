#include "apps/show/advice.h"

#include <doctest/doctest.h>

#include "tests/apps/show/rendered.h"

namespace dmpc::apps::advice_test {

namespace {

/// A run's report, with so many faults.
std::string advice(const RenderOptions& options, std::uint64_t faults = 3200, std::uint32_t processors = 2) {
  const Rendered rendered(options);
  svm::Report report = std::get<svm::Report>(*rendered.report);
  report.nodes.front().program.pages.faults += faults - report.pages().faults;
  return advice_lines(options, report, processors);
}

RenderOptions with_nodes(std::uint32_t nodes) {
  RenderOptions options = small();
  options.computer.node_count = nodes;
  return options;
}

}  // namespace

TEST_CASE("many nodes on few processors are advised of three options, unless all are given") {
  const std::string line =
      "advice   32 nodes on 2 processors take less time with --structure=extents --page-size=4KiB --in-flight=32\n";
  RenderOptions options = with_nodes(32);
  CHECK(advice(options) == line);
  CHECK(advice(options, 3199) == "");
  CHECK(advice(options, 3200, 4) == "advice   32 nodes on 4" + line.substr(22));
  CHECK(advice(options, 3200, 5) == "");
  CHECK(advice(with_nodes(31)) == "");
  options.computer.pool_threads = 2;
  CHECK(advice(options) == line);
  options.pages.in_flight = 32;
  options.database.build.page_size_bytes = 4096;
  CHECK(advice(options) == line);
  options.database.build.structure = core::Structure::extents;
  CHECK(advice(options) == "");
}

TEST_CASE("a cache far too small for the half of two nodes is told, with the one that holds all and what it takes") {
  RenderOptions options = with_nodes(2);
  options.picture.scene = "rings-4";
  options.database.build.page_size_bytes = 512;
  CHECK(advice(options, 20) == "");
  CHECK(contains(advice(options, 10'000), "advice   each frame of the caches was filled "));
  CHECK(contains(advice(options, 10'000), " times: --cache-pages="));
  options.computer.node_count = 5;
  CHECK(advice(options, 10'000) == "");
  options.computer.node_count = 2;
  options.pages.cache_pages = 2;
  CHECK(advice(options, 10'000) == "");
}

TEST_CASE("nobody is advised on modelled machines, of other strategies, or of what a published system is") {
  CHECK(advice(on_machine(with_nodes(32), find_machine_preset("ipsc2")->machine)) == "");
  RenderOptions options = with_nodes(32);
  options.system = System::pixel_machine;
  CHECK(advice(options) == "");
  options = small(Strategy::replicated);
  options.computer.node_count = 32;
  CHECK(advice(options) == "");
}

}  // namespace dmpc::apps::advice_test
