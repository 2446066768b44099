// Where a picture shows nothing but the background no ray is traced: the film, the rays and what they hit stay the reference
// renderer's, which traces them all.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdint>

#include "core/trace/charge.h"
#include "dataflow/run.h"
#include "svm/run.h"
#include "tests/support/small_scenes.h"
#include "tests/support/subject.h"

namespace dmpc::tests::whole_background_test {
namespace {

core::RenderSettings without_skip(const Subject& subject) { return subject.settings({.background = false}); }

/// Rays through a picture's empty tiles, in its first pass.
std::uint64_t background_rays(const core::RenderSettings& settings) {
  std::uint64_t pixels = 0;
  for (std::uint32_t pixel = 0; pixel < settings.camera.pixel_count(); ++pixel) {
    pixels += settings.shows_background(pixel) ? 1 : 0;
  }
  return pixels * settings.first_samples().count;
}

/// Far fewer than the reference's.
std::uint64_t steps(const core::Operations& operations) { return operations.cell_steps + operations.bvh_node_reads; }

template <class Report>
void check_skip(const Report& skipping, const Report& tracing, const Subject& subject, std::uint64_t least_rays) {
  CHECK(outcome_of(skipping) == subject.outcome());
  CHECK(outcome_of(tracing) == subject.outcome());
  CHECK(skipping.operations().skipped.background >= least_rays);
  CHECK(tracing.operations().skipped.background == 0);
  CHECK(steps(skipping.operations()) < steps(tracing.operations()));
}

/// By every strategy.
void check_strategies(const Subject& subject, std::uint32_t nodes) {
  CAPTURE(nodes);
  const core::RenderSettings skipping = subject.settings(), tracing = without_skip(subject);
  const std::uint64_t rays = background_rays(skipping);
  REQUIRE(rays > 100);
  CHECK(background_rays(tracing) == 0);
  const svm::RunOptions pages{.computer = {.node_count = nodes}, .pages = {.cache_pages = 1}};
  check_skip(svm::run_svm(subject.database(), skipping, pages, {}), svm::run_svm(subject.database(), tracing, pages, {}), subject,
             rays);
  const svm::RunOptions copies{.computer = {.node_count = nodes}};
  check_skip(svm::run_replicated(subject.database(), skipping, copies, {}),
             svm::run_replicated(subject.database(), tracing, copies, {}), subject, rays);
  const dataflow::RunOptions regions{.computer = {.node_count = nodes}};
  check_skip(dataflow::run_dataflow(subject.database(), skipping, regions, {}),
             dataflow::run_dataflow(subject.database(), tracing, regions, {}), subject, rays);
}

}  // namespace

TEST_CASE("films keep their bits by every strategy where background is not traced") {
  for (const char* name : {"tetra-3", "teapot-2", "mount-3", "tree-4"}) {
    CAPTURE(std::string(name));
    const Subject subject(built_in(name), {.width = 48, .height = 40, .samples = 2, .knows_background = true});
    check_strategies(subject, 1);
    check_strategies(subject, 5);
  }
}

TEST_CASE("refined pictures keep their bits where background is not traced") {
  const Subject subject(built_in("tetra-3"),
                        {.width = 48, .height = 40, .samples = 2, .refinement = {.error = 0.01}, .knows_background = true});
  REQUIRE(subject.outcome().rays[0] > 3 * 48 * 40);
  check_strategies(subject, 3);
}

TEST_CASE("in virtual time a ray of the background is charged no setup and no step") {
  core::Operations operations;
  operations.rays = {5, 0, 0, 0};
  operations.skipped.background = 3;
  CHECK(nodes::Charges{core::charges_of(operations)}[core::Charge::ray_setup] == 2);
  const Subject subject(built_in("tetra-3"), {.width = 48, .height = 40, .knows_background = true});
  const core::RenderSettings skipping = subject.settings(), tracing = without_skip(subject);
  nodes::Machine machine{.name = "slow steps"};
  std::fill(machine.cost_ps.begin(), machine.cost_ps.end(), 1'000'000);
  const svm::RunOptions options{.computer = {.node_count = 4, .machine = machine}, .pages = {.in_flight = 1}};
  const auto fast = svm::run_svm(subject.database(), skipping, options, {});
  const auto slow = svm::run_svm(subject.database(), tracing, options, {});
  check_skip(fast, slow, subject, background_rays(skipping));
  CHECK(fast.virtual_time->total_ns < slow.virtual_time->total_ns);
  const dataflow::RunOptions rays{.computer = {.node_count = 4, .machine = machine}};
  check_skip(dataflow::run_dataflow(subject.database(), skipping, rays, {}),
             dataflow::run_dataflow(subject.database(), tracing, rays, {}), subject, background_rays(skipping));
}

TEST_CASE("a picture of nothing but background needs no page and sends no ray, and nodes share its rays evenly") {
  core::Scene scene = built_in("tetra-3");
  scene.view.at = scene.view.from * 2.0 - scene.view.at;
  const Subject subject(scene, {.width = 32, .height = 32, .knows_background = true});
  const core::RenderSettings settings = subject.settings();
  const svm::Report pages =
      svm::run_svm(subject.database(), settings, {.computer = {.node_count = 3}, .pages = {.cache_pages = 1}}, {});
  CHECK(outcome_of(pages) == subject.outcome());
  CHECK(pages.pages().references == 0);
  const dataflow::Report rays = dataflow::run_dataflow(subject.database(), settings, {.computer = {.node_count = 4}}, {});
  CHECK(outcome_of(rays) == subject.outcome());
  CHECK(rays.messages_per_ray() == 0);
  for (const dataflow::NodeReport& node : rays.nodes) {
    CHECK(node.program.operations.skipped.background == 32 * 32 / 4);
  }
}

}  // namespace dmpc::tests::whole_background_test
