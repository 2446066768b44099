#include "apps/info/forecast.h"

#include <doctest/doctest.h>

#include "core/base/expect.h"
#include "nodes/size_text.h"
#include "svm/plan.h"
#include "tests/apps/show/rendered.h"
#include "tests/support/complaint.h"
#include "tests/support/painted_square.h"

namespace dmpc::apps::forecast_test {

using dataflow::Balance;
using tests::contains;

namespace {

/// On three nodes, of what `options` renders.
ComputerForecast forecast_for(const RenderOptions& options) {
  const Subject subject = build_subject(load_scene(options.picture, LoadNotes::silent), options.picture, options.database);
  return forecast(subject.database, subject.settings, {options.computer.node_count}, options.rays.balance).computers.at(0);
}

const MemoryForecast& part_of(const ComputerForecast& forecast, Strategy strategy) {
  return strategy == Strategy::svm ? forecast.svm : strategy == Strategy::replicated ? forecast.replicated : *forecast.dataflow;
}

/// Why a render is refused, if it is for want of room.
std::string refusal(RenderOptions options, std::size_t node_memory_bytes) {
  options.computer.node_memory_bytes = node_memory_bytes;
  return tests::complaint_of<core::CapacityError>([&] { const Rendered rendered(options); });
}

constexpr Strategy all_strategies[] = {Strategy::svm, Strategy::replicated, Strategy::dataflow};

}  // namespace

TEST_CASE("a textured scene larger than all nodes is refused with the memory that is forecast, and with that it is rendered") {
  const tests::TemporaryFolder folder;
  RenderOptions options = small();
  options.picture.scene = tests::write_painted_square(folder, 256);
  const ComputerForecast forecast = forecast_for(options);
  for (const Strategy strategy : all_strategies) {
    CAPTURE(std::string(name_of(strategy)));
    options.strategy = strategy;
    const std::size_t least = part_of(forecast, strategy).least_bytes;
    CHECK(least > 100'000);
    const std::string refused = refusal(options, least - 1);
    CAPTURE(refused);
    CHECK(contains(refused, "the smallest that works is --node-memory=" + nodes::size_text(least)));
    CHECK(refusal(options, least).empty());
  }
  CHECK(forecast.svm.least_bytes < forecast.replicated.least_bytes);
}

TEST_CASE("without a bound a render takes what is forecast") {
  for (const Strategy strategy : all_strategies) {
    CAPTURE(std::string(name_of(strategy)));
    const RenderOptions options = small(strategy);
    const Rendered rendered(options);
    const MemoryForecast memory = part_of(forecast_for(options), strategy);
    const Account account = account_of(*rendered.report);
    std::size_t largest = 0, sum = 0;
    for (const NodeAccount& node : account.nodes) {
      largest = std::max(largest, node.memory_planned.total());
      sum += node.memory_planned.total();
    }
    CHECK(memory.usual_bytes == largest);
    CHECK(memory.all_bytes > sum);
    CHECK(memory.least_bytes <= memory.usual_bytes);
  }
}

TEST_CASE("primary rays of many nodes are forecast as they are assigned, in squares of pixels") {
  RenderOptions options = small(Strategy::dataflow);
  options.picture.scene = "tetra-6";
  options.picture.resolution = Resolution{128, 128};
  options.computer.node_count = 8;
  options.rays.balance = {.balance = Balance::equal_size};
  const MemoryForecast memory = *forecast_for(options).dataflow;
  CHECK(refusal(options, memory.least_bytes).empty());
  CHECK(contains(refusal(options, memory.least_bytes - 1),
                 "the smallest that works is --node-memory=" + nodes::size_text(memory.least_bytes)));
}

TEST_CASE("regions that move take what is forecast, room for units that come included, and with less are refused") {
  RenderOptions options = small(Strategy::dataflow);
  options.rays.balance = {.balance = Balance::moving, .regions_a_node = 4};
  const MemoryForecast memory = *forecast_for(options).dataflow;
  const Rendered rendered(options);
  std::size_t largest = 0;
  for (const NodeAccount& node : account_of(*rendered.report).nodes) {
    largest = std::max(largest, node.memory_planned.total());
  }
  CHECK(memory.usual_bytes == largest);
  CHECK(refusal(options, memory.least_bytes).empty());
  CHECK(contains(refusal(options, memory.least_bytes - 1),
                 "the smallest that works is --node-memory=" + nodes::size_text(memory.least_bytes)));
}

TEST_CASE("of regions that move there is a forecast for as many nodes as there may be units") {
  const RenderOptions options = small();
  const Subject subject = build_subject(load_scene(options.picture), options.picture);
  const Forecast found =
      forecast(subject.database, subject.settings, {256, 512}, {.balance = Balance::moving, .regions_a_node = 16});
  CHECK(found.computers[0].dataflow);
  CHECK_FALSE(found.computers[1].dataflow);
  CHECK(found.regions_a_node == 16);
}

TEST_CASE("what two pixels take is forecast to the byte") {
  RenderOptions options = small(Strategy::svm);
  options.picture.resolution = {2, 1};
  options.database.build.page_size_bytes = 65536;
  const MemoryForecast memory = forecast_for(options).svm;
  const Rendered rendered(options);
  const Account account = account_of(*rendered.report);
  CHECK(memory.usual_bytes == account.nodes.front().memory_planned.total());
  CHECK(refusal(options, memory.least_bytes).empty());
  CHECK_FALSE(refusal(options, memory.least_bytes - 1).empty());
}

TEST_CASE("every computer is forecast, up to the largest") {
  const RenderOptions options = small();
  const Subject subject = build_subject(load_scene(options.picture), options.picture);
  std::vector<std::uint64_t> reported;
  const Forecast found =
      forecast(subject.database, subject.settings, {1, 4, nodes::node_count_max}, {.balance = Balance::equal_size},
               [&](std::uint64_t done, std::uint64_t) { reported.push_back(done); });
  REQUIRE(found.computers.size() == 3);
  CHECK(reported == std::vector<std::uint64_t>{1, 2, 3});
  CHECK(found.computers[0].dataflow_copies == 1);
  CHECK(found.computers[1].dataflow_copies > 1);
  CHECK(found.computers[2].dataflow_copies > found.computers[1].dataflow_copies);
  CHECK(found.computers[2].dataflow->all_bytes > found.computers[1].dataflow->all_bytes);
  CHECK(found.balance == Balance::equal_size);
  CHECK(found.region_seconds > 0);
}

TEST_CASE("a forecast of no computer is empty, and options out of range are refused") {
  const RenderOptions options = small();
  const Subject subject = build_subject(load_scene(options.picture), options.picture);
  CHECK(forecast(subject.database, subject.settings, {}, {}).computers.empty());
  CHECK_THROWS_AS(forecast(subject.database, subject.settings, {1}, {.subsample = 0}), core::UsageError);
}

}  // namespace dmpc::apps::forecast_test
