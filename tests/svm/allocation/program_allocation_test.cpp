// The node programs of svm, replicated and forest, and the host's, allocate nothing between start and end. This executable has
// the replaced global operators.
#include <doctest/doctest.h>

#include <memory>
#include <vector>

#include "core/families/scenes.h"
#include "core/picture/bundle_task.h"
#include "nodes/threads/threads_runner.h"
#include "svm/forest/forest.h"
#include "svm/forest/strategy.h"
#include "svm/local_copy.h"
#include "svm/pages/observers/observed_pagers.h"
#include "svm/pages/pager.h"
#include "svm/run.h"
#include "tests/support/allocation_guard.h"

namespace dmpc::tests::svm_program_allocation_test {

namespace {

/// Renders a small scene with every node and the host (unless it chooses passes) under watch; returns what they allocated and
/// freed.
template <class Records, class Task = core::PixelTask>
std::uint64_t allocated_by(const svm::Strategy* strategy, const svm::RunOptions& options, double error = 0) {
  const core::Scene scene = core::built_in_scene(core::parse_scene_name("balls-2"));
  const core::Database database = core::build_database(
      scene, {.page_size_bytes = 512,
              .structure = strategy == svm::forest_strategy() ? core::Structure::extents : core::Structure::grid});
  const core::RenderSettings settings{
      database.header(), core::Camera(scene.view, database.header().frame, 16, 16, 2), {}, {.error = error}};
  svm::Plan plan = svm::plan_of(*strategy, database, settings, options);
  plan.request.database = database.bytes();
  const svm::MakeProgram make_program = [&](std::uint32_t, nodes::Node& node) {
    const auto make_tracer = [&](Records& records) { return core::GridTracer<Records>(records, settings.header, {}); };
    return std::make_unique<svm::ControlProgram<Records, core::GridTracer<Records>, Task>>(node, plan, settings, database.bytes(),
                                                                                           make_tracer);
  };
  core::Film film(16, 16);
  const nodes::Progress progress;
  std::vector<nodes::NodeSpecification> specifications = svm::specifications_of(plan, make_program, film, progress);
  for (std::uint32_t i = 0; i < options.computer.node_count + (error == 0 ? 1 : 0); ++i) {
    specifications[i] = watched(specifications[i]);
  }
  const nodes::ComputerRequest& computer = options.computer;
  nodes::ThreadsRunner runner(specifications, std::nullopt, nullptr, computer.pool_threads, computer.immutable());
  return allocated_in_run(runner);
}

TEST_CASE("a node of svm allocates nothing while it renders, pages, asks for work and serves") {
  svm::RunOptions options{.computer = {.node_count = 5}};
  CHECK(allocated_by<svm::Pager, core::BundleTask>(svm::svm_strategy(), options) == 0);
  options.pages.cache_pages = 1;
  CHECK(allocated_by<svm::Pager, core::BundleTask>(svm::svm_strategy(), options) == 0);
  options.pages.in_flight = 15;
  CHECK(allocated_by<svm::Pager>(svm::svm_strategy(), options) == 0);
  options.pages.homes = svm::PageHomes::tree;
  CHECK(allocated_by<svm::Pager>(svm::svm_strategy(), options) == 0);
  options.pages.homes = svm::PageHomes::host;
  CHECK(allocated_by<svm::Pager>(svm::svm_strategy(), options) == 0);
  options.pages.count_pages = true;
  CHECK(allocated_by<svm::CountingPager>(svm::svm_strategy(), options) == 0);
}

TEST_CASE("nodes of a pool, which refer to pages, allocate nothing while they render, either") {
  svm::RunOptions options{.computer = {.node_count = 5, .pool_threads = 2}};
  CHECK(allocated_by<svm::LocalCopy, core::BundleTask>(svm::replicated_strategy(), options) == 0);
  options.pages.cache_pages = 1;
  CHECK(allocated_by<svm::Pager, core::BundleTask>(svm::svm_strategy(), options) == 0);
}

TEST_CASE("a node of svm allocates nothing in passes that refine samples") {
  CHECK(allocated_by<svm::Pager, core::BundleTask>(svm::svm_strategy(), {.computer = {.node_count = 5}}, 0.01) == 0);
}

TEST_CASE("a node of forest allocates nothing while it renders, asks and answers") {
  svm::RunOptions options{.computer = {.node_count = 5}};
  CHECK(allocated_by<svm::Forest, core::BundleTask>(svm::forest_strategy(), options) == 0);
  options.pages.in_flight = 1;
  CHECK(allocated_by<svm::Forest>(svm::forest_strategy(), options, 0.01) == 0);
}

TEST_CASE("a node of replicated allocates nothing while it renders") {
  CHECK(allocated_by<svm::LocalCopy, core::BundleTask>(svm::replicated_strategy(), {.computer = {.node_count = 5}}) == 0);
}

}  // namespace
}  // namespace dmpc::tests::svm_program_allocation_test
