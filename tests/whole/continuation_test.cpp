// A picture that several runs make one after the other, each stopped on the way, is that of one run, whoever goes on with it.
#include <doctest/doctest.h>

#include <cstdint>
#include <optional>
#include <stop_token>
#include <variant>
#include <vector>

#include "core/picture/film/partial_picture.h"
#include "tests/support/small_scenes.h"
#include "tests/support/strategies.h"
#include "tests/support/subject.h"

namespace continuation_test {

namespace {

using namespace dmpc;
using core::PartialPicture;
using tests::Subject;

enum class Strategy { svm, replicated, dataflow };
constexpr Strategy all_strategies[] = {Strategy::svm, Strategy::replicated, Strategy::dataflow};

/// What matters of any strategy's report.
struct Part {
  core::Film film;
  nodes::RunEnd end;
  core::RefinementResult refinement;
  std::uint64_t primary_rays;
};

template <class Report>
Part part_of(const Report& report) {
  return {report.film, report.end, report.refinement, report.operations().rays[static_cast<std::size_t>(core::RayKind::primary)]};
}

struct Run {
  Strategy strategy = Strategy::svm;
  std::uint32_t nodes = 3;
  core::Continuation continuation = {};
  std::optional<nodes::Chaos> chaos = std::nullopt;
  std::uint32_t work_item_side = 3;
};

Part run(const Subject& subject, const Run& run, const std::stop_token& stop = {}) {
  if (run.strategy == Strategy::dataflow) {
    const dataflow::RunOptions options{.computer = {.node_count = run.nodes, .chaos = run.chaos},
                                       .continuation = run.continuation};
    return part_of(dataflow::run_dataflow(subject.database(), subject.settings(), options, stop));
  }
  const svm::RunOptions options{.computer = {.node_count = run.nodes, .chaos = run.chaos},
                                .pages = {.work_item_side = run.work_item_side},
                                .continuation = run.continuation};
  return part_of(run.strategy == Strategy::svm ? svm::run_svm(subject.database(), subject.settings(), options, stop)
                                               : svm::run_replicated(subject.database(), subject.settings(), options, stop));
}

/// What a run keeps: each time that light has come `every` times since it was last kept; with `stops` it then ends the run.
class Keeper {
 public:
  explicit Keeper(std::uint32_t every, bool stops = false) : every_(every), stops_(stops) {}

  core::Continuation continuation(const PartialPicture* start = nullptr) {
    return {start, [this] { return ++asked_ % every_ == 0; },
            [this](const core::Film& film, const core::Refinement& pass, const core::PixelMask& done) {
              last_.emplace(core::partial_picture(film, pass, done));
              ++count_;
              if (stops_) {
                stop_.request_stop();
              }
            }};
  }
  std::stop_token token() const { return stop_.get_token(); }
  const std::optional<PartialPicture>& last() const { return last_; }
  std::uint32_t count() const { return count_; }

 private:
  std::uint32_t every_;
  bool stops_;
  std::uint32_t asked_ = 0, count_ = 0;
  std::optional<PartialPicture> last_;
  std::stop_source stop_;
};

core::PictureTerms terms_of(const Subject& subject) {
  const core::RenderSettings& settings = subject.settings();
  return {static_cast<std::uint32_t>(settings.camera.samples()), settings.refinement,
          core::radiance_bound(tests::mirrors_and_glass(), settings.shade.depth_max + 1)};
}

/// Runs one after the other, each from what the one before has kept, until one comes to the end. Their strategies, nodes and
/// schedules change from run to run.
struct Relay {
  Relay(const Subject& subject, std::uint64_t seed) {
    std::optional<PartialPicture> start;
    while (runs == 0 || last->end != nodes::RunEnd::finished) {
      Keeper keeper(2, true);
      const Run next{.strategy = all_strategies[(seed + runs) % 3],
                     .nodes = 1 + static_cast<std::uint32_t>(seed + 2 * runs) % 3,
                     .continuation = keeper.continuation(start ? &*start : nullptr),
                     .chaos = runs % 2 == 0 ? std::nullopt : std::optional(nodes::chaos_of(seed + runs)),
                     .work_item_side = runs % 4};
      last.emplace(run(subject, next, keeper.token()));
      start = keeper.last() ? keeper.last() : start;
      has_fault = has_fault || (start && core::fault_of(*start, terms_of(subject)) != nullptr);
      ++runs;
    }
  }

  std::optional<Part> last;
  std::uint32_t runs = 0;
  bool has_fault = false;  ///< in what was saved
};

void check_relays(const core::Scene& scene, const Subject::Size& size, std::uint32_t runs_least) {
  const Subject subject(scene, size);
  const Part whole = run(subject, {});
  REQUIRE(whole.film.hash() == subject.outcome().film_hash);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    CAPTURE(seed);
    const Relay relay(subject, seed);
    CHECK(relay.runs >= runs_least);
    CHECK_FALSE(relay.has_fault);
    CHECK(relay.last->film.hash() == whole.film.hash());
    CHECK(relay.last->film.samples() == whole.film.samples());
    CHECK(relay.last->refinement.passes == whole.refinement.passes);
    CHECK(relay.last->refinement.error == whole.refinement.error);
  }
}

/// `pixel_count` pixels with a sample each, none of which is done.
PartialPicture nothing_done(int width, int height) {
  const auto pixel_count = static_cast<std::uint32_t>(width * height);
  return {core::Film(width, height), 1, core::Pass(pixel_count, 1), core::PixelMask(pixel_count)};
}

}  // namespace

TEST_CASE("a picture of several runs is that of one, whatever their strategies, nodes and schedules") {
  check_relays(tests::mirrors_and_glass(), {96, 80}, 2);
}

TEST_CASE("so it is with several samples of a pixel, on several nodes") {
  check_relays(tests::mirrors_and_glass(), {48, 40, 5}, 2);
}

TEST_CASE("a picture that is refined in several runs gets the same passes and the same estimate as in one") {
  check_relays(tests::mirrors_and_glass(), {24, 20, 2, {.error = 0.02}}, 2);
}

TEST_CASE("what one run has done, the next does not do again") {
  const Subject subject(tests::mirrors_and_glass(), {96, 80});
  for (const Strategy strategy : all_strategies) {
    Keeper keeper(3, true);
    run(subject, {.strategy = strategy, .continuation = keeper.continuation()}, keeper.token());
    REQUIRE(keeper.last());
    const std::uint32_t missing = keeper.last()->missing().count();
    CHECK(missing < 96 * 80);
    for (const Strategy next : all_strategies) {
      CHECK(run(subject, {.strategy = next, .continuation = {.start = &*keeper.last()}}).primary_rays == missing);
    }
  }
}

TEST_CASE("the pixels kept as done have all their light, and the others none") {
  const Subject subject(tests::mirrors_and_glass(), {48, 40, 5});
  const Part whole = run(subject, {});
  for (const Strategy strategy : all_strategies) {
    Keeper keeper(2);
    run(subject, {.strategy = strategy, .continuation = keeper.continuation()});
    REQUIRE(keeper.last());
    for (std::uint32_t pixel = 0; pixel < 48 * 40; ++pixel) {
      const core::PixelSums expected = keeper.last()->done.has(pixel) ? whole.film.sums(pixel) : core::PixelSums{};
      CHECK(keeper.last()->film.sums(pixel) == expected);
    }
  }
}

TEST_CASE("a run that keeps the picture whenever it can comes to the same end") {
  const Subject subject(tests::mirrors_and_glass(), {24, 20, 2, {.error = 0.01}});
  for (const Strategy strategy : all_strategies) {
    Keeper keeper(1);
    CHECK(run(subject, {.strategy = strategy, .continuation = keeper.continuation()}).film.hash() == subject.outcome().film_hash);
    CHECK(keeper.count() > 2);
  }
}

TEST_CASE("a run that is interrupted where pixels come whole keeps all that has come") {
  const Subject subject(tests::mirrors_and_glass(), {96, 80});
  Keeper keeper(~0U);
  std::stop_source stop;
  svm::RunOptions options{.computer = {.node_count = 3}, .continuation = keeper.continuation()};
  options.watching.progress = [&](std::uint32_t done, std::uint32_t) { done > 1000 ? stop.request_stop() : false; };
  const svm::Report report = svm::run_svm(subject.database(), subject.settings(), options, stop.get_token());
  CHECK(report.end == nodes::RunEnd::interrupted);
  CHECK(keeper.count() == 1);
  CHECK(keeper.last()->done.count() == report.pixels_done);
}

TEST_CASE("a picture of which nothing or everything is done can be gone on with") {
  const Subject subject(tests::mirrors_and_glass(), {16, 9});
  PartialPicture nothing = nothing_done(16, 9), everything = nothing_done(16, 9);
  everything.film = run(subject, {}).film;
  everything.done = everything.pass.pixels();
  core::Film sums(16, 9);
  for (std::uint32_t pixel = 0; pixel < 16 * 9; ++pixel) {
    sums.deposit(pixel, everything.film.sums(pixel));
  }
  everything.film = sums;
  for (const Strategy strategy : all_strategies) {
    const Part of_nothing = run(subject, {.strategy = strategy, .continuation = {.start = &nothing}});
    CHECK(of_nothing.film.hash() == subject.outcome().film_hash);
    CHECK(of_nothing.primary_rays == 16 * 9);
    const Part of_everything = run(subject, {.strategy = strategy, .continuation = {.start = &everything}});
    CHECK(of_everything.film.hash() == subject.outcome().film_hash);
    CHECK(of_everything.film.samples() == 16 * 9);
    CHECK(of_everything.primary_rays == 0);
  }
}

TEST_CASE("a start with other pixels than the picture is refused") {
  const Subject subject(tests::mirrors_and_glass(), {16, 9});
  const PartialPicture other = nothing_done(9, 9);
  CHECK_THROWS_AS(run(subject, {.strategy = Strategy::svm, .continuation = {.start = &other}}), core::InternalError);
  CHECK_THROWS_AS(run(subject, {.strategy = Strategy::dataflow, .continuation = {.start = &other}}), core::InternalError);
}

}  // namespace continuation_test
