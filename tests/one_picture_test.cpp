// One picture: whatever the strategy, the nodes, the pages and the schedule, the film equals the reference renderer's to the last
// bit.
#include <doctest/doctest.h>

#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/database.h"
#include "core/render.h"
#include "svm/run.h"
#include "tests/support/pairwise.h"
#include "tests/support/small_scenes.h"

namespace {

using namespace dmpc;

constexpr std::size_t page_sizes[] = {512, 1024, 4096, 65536};
constexpr std::uint32_t node_counts[] = {1, 2, 3, 7, 8, 64};
constexpr std::uint32_t in_flights[] = {1, 64};
constexpr std::uint32_t item_sides[] = {0, 1, 3, 16};
/// Shares of the database in the cache; 0 stands for one page.
constexpr double cache_shares[] = {0.0, 0.05, 1.0};

/// A scene, a picture of it by the reference renderer, and its databases by page size.
class Subject {
 public:
  Subject(const core::Scene& scene, int width, int height) : scene_(scene), width_(width), height_(height) {
    const core::Database& whole = database(1024);
    core::LocalRecords records(whole.bytes());
    core::GridTracer tracer(records, whole.header(), core::TraversalOptions{});
    core::Operations operations;
    hash_ = core::render(tracer, settings(whole), operations).hash();
    rays_ = operations.rays;
  }

  const core::Database& database(std::size_t page_size_bytes) {
    const auto found = databases_.find(page_size_bytes);
    if (found != databases_.end()) {
      return found->second;
    }
    return databases_.emplace(page_size_bytes, core::build_database(scene_, {.page_size_bytes = page_size_bytes})).first->second;
  }
  core::RenderSettings settings(const core::Database& database) const {
    return {database.header(), core::Camera(scene_.view, database.header().frame, width_, height_, 1), {}};
  }
  std::uint64_t hash() const { return hash_; }
  const auto& rays() const { return rays_; }

 private:
  core::Scene scene_;
  int width_, height_;
  std::map<std::size_t, core::Database> databases_;
  std::uint64_t hash_ = 0;
  decltype(core::Operations::rays) rays_{};
};

void check_same_picture(const Subject& subject, const svm::Report& report) {
  CHECK(report.film.hash() == subject.hash());
  CHECK(report.operations().rays == subject.rays());
}

/// Every pair of choices occurs in some run.
void check_pairwise(Subject& subject) {
  const auto rows = tests::pairwise(
      {std::size(node_counts), std::size(page_sizes), std::size(cache_shares), std::size(in_flights), std::size(item_sides), 2});
  for (const auto& row : rows) {
    const core::Database& database = subject.database(page_sizes[row[1]]);
    const bool replicated = row[5] == 1;
    svm::RunOptions options;
    options.node_count = node_counts[row[0]];
    options.in_flight = in_flights[row[3]];
    options.work_item_side = item_sides[row[4]];
    if (!replicated) {
      const double frames = cache_shares[row[2]] * static_cast<double>(database.page_count());
      options.cache_pages = std::max(1U, static_cast<std::uint32_t>(frames));
    }
    CAPTURE(options.node_count);
    CAPTURE(database.page_size());
    CAPTURE(*options.in_flight);
    CAPTURE(options.work_item_side);
    CAPTURE(options.cache_pages.value_or(0));
    CAPTURE(replicated);
    check_same_picture(subject, replicated ? svm::run_replicated(database, subject.settings(database), options, {})
                                           : svm::run_svm(database, subject.settings(database), options, {}));
  }
}

}  // namespace

TEST_CASE("mirrors, glass and every kind of primitive give one picture in every pair of choices") {
  Subject subject(tests::mirrors_and_glass(), 40, 32);
  check_pairwise(subject);
}

TEST_CASE("a thousand lights give one picture in every pair of choices") {
  Subject subject(tests::thousand_lights(), 12, 12);
  check_pairwise(subject);
}

TEST_CASE("concave and transparent gears give one picture in every pair of choices") {
  Subject subject(tests::built_in("gears-1"), 16, 16);
  check_pairwise(subject);
}

TEST_CASE("a teapot gives one picture in every pair of choices") {
  Subject subject(tests::built_in("teapot-4"), 32, 32);
  check_pairwise(subject);
}

TEST_CASE("twenty runs on 64 nodes give one picture") {
  Subject subject(tests::mirrors_and_glass(), 64, 64);
  const core::Database& database = subject.database(1024);
  for (int run = 0; run < 20; ++run) {
    CAPTURE(run);
    check_same_picture(subject, svm::run_svm(database, subject.settings(database), {.node_count = 64}, {}));
  }
}

TEST_CASE("empty space skipped or not, the picture is the same") {
  Subject subject(tests::built_in("balls-2"), 48, 48);
  const core::Database& database = subject.database(1024);
  svm::RunOptions options{.node_count = 3};
  options.traversal.skip_empty_space = false;
  check_same_picture(subject, svm::run_svm(database, subject.settings(database), options, {}));
}

TEST_CASE("a picture of one pixel and a picture with fewer pixels than nodes are the reference's") {
  for (const int width : {1, 5}) {
    Subject subject(tests::mirrors_and_glass(), width, 1);
    const core::Database& database = subject.database(512);
    check_same_picture(subject, svm::run_svm(database, subject.settings(database), {.node_count = 8}, {}));
  }
}

TEST_CASE("films keep their bits from build to build, compiler to compiler and machine to machine") {
  struct Known {
    std::string name;
    std::uint64_t hash;
  };
  for (const Known& known : {Known{"teapot-4", 0x5d862aabaeb46d83ULL}, Known{"gears-1", 0x6073f1a89bf7cd16ULL},
                             Known{"balls-2", 0xe54a1b2299b0cf82ULL}, Known{"rings-1", 0xb7cd7b0b8d0cf6b2ULL},
                             Known{"mount-3", 0x469ffe01b407ec59ULL}, Known{"tree-4", 0x84a057246e2c3cddULL}}) {
    CAPTURE(known.name);
    CHECK(Subject(tests::built_in(known.name), 32, 32).hash() == known.hash);
  }
}
