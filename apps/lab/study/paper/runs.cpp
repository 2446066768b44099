#include "apps/lab/study/paper/runs.h"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>
#include <numeric>
#include <tuple>

#include "apps/frontend/system/progress.h"
#include "apps/lab/crowd/side_by_side.h"
#include "apps/lab/study/paper/hot_spots.h"
#include "apps/run/report.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/trace/skips.h"
#include "dataflow/regions/bsp.h"
#include "dataflow/run.h"
#include "svm/packets.h"
#include "svm/run.h"

namespace dmpc::apps {
namespace {

/// In the middle of Rings4.
constexpr core::PointLight inner_light{.position = {-1, 7.36, 0.5}};

/// A blocked shadow ray goes no further, and a ray without weight is not shot: all other skips came later.
core::Skips article_skips() {
  core::Skips skips = core::no_skips();
  skips.any_hit = skips.zero_terms = true;
  return skips;
}

/// The article's program counts rays as this convention does, and traced all of them. Its nodes asked each other for work in
/// turn.
PictureOptions picture_of(const PaperRun& run) {
  const auto side = static_cast<int>(run.resolution);
  PictureOptions picture{.scene = run.scene, .resolution = Resolution{side, side}, .convention = core::Convention::paper};
  picture.skips.background = false;
  picture.skips.idle_nodes = false;
  if (run.structure == core::Structure::voxels || run.lacks_later_skips) {
    picture.skips = article_skips();
  }
  if (run.has_inner_light) {
    picture.skips.empty_regions = false;
    picture.scene_setup.lights = {inner_light};
  }
  return picture;
}

std::uint64_t pixels_of(const PaperRun& run) { return std::uint64_t{run.resolution} * run.resolution; }

std::optional<std::uint32_t> cache_pages_of(const PaperRun& run, const core::Database& database) {
  if (run.shared_pages) {
    const auto all = static_cast<std::uint32_t>(database.page_count()), own = core::ceil_divide(all, run.node_count);
    return std::max(1U, std::min(all - own, *run.shared_pages > own ? *run.shared_pages - own : 0));
  }
  if (!run.cache_share) {
    return run.cache_pages;
  }
  const double pages = *run.cache_share * static_cast<double>(database.page_count());
  return std::max(1U, static_cast<std::uint32_t>(std::lround(pages)));
}

Report report_of(const PaperRun& run, const Subject& subject, const std::stop_token& stop) {
  StrategyOptions options{.strategy = run.strategy,
                          .computer = {.node_count = run.node_count, .node_memory_bytes = run.node_memory_bytes},
                          .pages = run.pages,
                          .rays = run.rays};
  choose_machine(options, run.machine);
  options.pages.cache_pages = cache_pages_of(run, subject.database);
  return make_ready(options, subject.database, subject.settings, stop).start([](std::uint32_t, std::uint32_t) {}, stop);
}

/// Charges as for the nodes of a shared memory.
core::ChargeCounts charges_of(const Account& account, const svm::PageCounters& pages) {
  core::ChargeCounts charges = core::charges_of(account.operations);
  const auto set = [&charges](core::Charge charge, std::uint64_t count) { charges[static_cast<std::size_t>(charge)] = count; };
  set(core::Charge::home_lookup, pages.home_hits);
  set(core::Charge::cached_lookup, pages.references - pages.home_hits);
  set(core::Charge::page_install, pages.faults);
  return charges;
}

PaperResult result_of(const Report& report, const core::Database& database) {
  const Account account = account_of(report);
  PaperResult result{.total_ns = account.virtual_time->total_ns,
                     .parts = parts_of(account),
                     .rays = account.operations.ray_count(),
                     .tests = std::accumulate(account.operations.primitive_tests.begin(),
                                              account.operations.primitive_tests.end(), std::uint64_t{0}),
                     .database_bytes = database.bytes().size(),
                     .film_hash = account.film.hash()};
  if (const auto* rays = std::get_if<dataflow::Report>(&report)) {
    result.flood = shadow_flood(database, *rays);
    result.average_load = dataflow::average_load(rays->work());
    const dataflow::Gather::Counters gathers = rays->gathers();
    result.overflowed =
        gathers.packets == 0 ? 0 : static_cast<double>(gathers.packets_overflowed) / static_cast<double>(gathers.packets);
    result.ray_bytes = dataflow::ray_traffic(account.sent).bytes;
  }
  if (const auto* pages = std::get_if<svm::Report>(&report)) {
    result.flood = page_flood(*pages);
    result.references = pages->pages().references;
    result.faults = pages->pages().faults;
    result.cache_pages = pages->plan.pages().cache.frame_count;
    result.page_bytes = account.sent[svm::number_of(svm::Kind::page_reply)].bytes;
    result.charges = charges_of(account, pages->pages());
    result.pages_a_pixel = static_cast<double>(pages->pages().distinct_pages) / static_cast<double>(account.film.pixel_count());
  }
  return result;
}

}  // namespace

const Subject& subject_of(const PaperRun& run, std::span<const PaperSubject> subjects) {
  const auto found =
      std::find_if(subjects.begin(), subjects.end(), [&](const PaperSubject& subject) { return subject.is_of(run); });
  core::expect(found != subjects.end(), "every run has its scene");
  return found->subject;
}

std::vector<PaperSubject> paper_subjects(std::span<const PaperRun> runs) {
  std::vector<PaperSubject> subjects;
  for (const PaperRun& run : runs) {
    if (std::none_of(subjects.begin(), subjects.end(), [&](const PaperSubject& subject) { return subject.is_of(run); })) {
      const PictureOptions picture = picture_of(run);
      subjects.push_back(
          {run.scene, run.resolution, run.has_inner_light, run.structure, run.lacks_later_skips,
           build_subject(load_scene(picture), picture, {.build = {.structure = run.structure, .voxels = core::article_voxels}})});
    }
  }
  return subjects;
}

void carry_out(std::span<const PaperRun> runs, std::span<const PaperSubject> subjects, const Interrupt& interrupt,
               PaperResults& results, const std::function<void()>& reported) {
  core::expect(results.size() == runs.size(), "every run has a place for its result");
  std::map<std::tuple<std::string, std::uint32_t, bool>, std::uint64_t> films;  // by scene, size and light
  Progress progress(std::cerr, stderr_is_terminal(), std::to_string(runs.size()) + " runs: ");
  std::uint64_t done_pixels = 0;
  const std::uint64_t all_pixels = std::accumulate(runs.begin(), runs.end(), std::uint64_t{0},
                                                   [](auto sum, const PaperRun& run) { return sum + pixels_of(run); });
  const auto measure = [&](std::size_t index) -> std::optional<PaperResult> {
    if (interrupt.requested()) {
      return std::nullopt;
    }
    const Subject& subject = subject_of(runs[index], subjects);
    const Report report = report_of(runs[index], subject, interrupt.token());
    const bool is_finished = account_of(report).end == nodes::RunEnd::finished;
    return is_finished ? std::optional(result_of(report, subject.database)) : std::nullopt;
  };
  measure_each(runs.size(), Turns::side_by_side, measure, [&](std::size_t index, const std::optional<PaperResult>& result) {
    if (result) {
      const PaperRun& run = runs[index];
      const auto film = films.try_emplace({run.scene, run.resolution, run.has_inner_light}, result->film_hash).first;
      core::expect(film->second == result->film_hash, "every run of a scene gives the same film");
      results[index] = result;
      reported();
      done_pixels += pixels_of(run);
      progress.update(done_pixels, all_pixels);
    }
  });
}

}  // namespace dmpc::apps
