#include "apps/lab/bench/speed/ablation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <utility>

#include "apps/edge/system/progress.h"
#include "apps/edge/system/stopwatch.h"
#include "apps/edge/table/rounds.h"
#include "apps/lab/study/engine/timed_render.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"
#include "core/picture/background.h"
#include "core/trace/work.h"

namespace dmpc::apps {
namespace {

using core::Skip;
using core::Skips;

/// Regions of fewer nodes all hold something.
constexpr std::uint32_t page_nodes = 2, ray_nodes = 64;

struct Cutoff {
  const char* name;
  double value;
};
constexpr std::array traced_cutoffs{Cutoff{"cutoff 1/1024", 1.0 / 1024}, Cutoff{"cutoff 1/255", 1.0 / 255}};

/// How a picture comes about.
struct Variant {
  Strategy strategy = Strategy::svm;
  Skips skips;
  double cutoff = 0;
};

bool is_of_rays(const Skip& skip) { return skip.is_on == &Skips::empty_regions; }

StrategyOptions strategy_of(const Variant& variant) {
  return {.strategy = variant.strategy,
          .computer = {.node_count = variant.strategy == Strategy::dataflow ? ray_nodes : page_nodes}};
}

double error_between(const core::Film& film, const core::Film& other) {
  const auto pixels = static_cast<std::uint32_t>(film.pixel_count());
  double squares = 0;
  for (std::uint32_t pixel = 0; pixel < pixels; ++pixel) {
    const core::Vec3d off = film.radiance(pixel) - other.radiance(pixel);
    squares += dot(off, off);
  }
  return std::sqrt(squares / (3.0 * pixels));
}

/// The renders of one scene.
class AblationBench {
 public:
  AblationBench(const std::string& scene, const SpeedSettings& settings, const Interrupt& interrupt)
      : scene_(scene), interrupt_(interrupt), subject_(settings.subject_of(SpeedPart::ablation, scene)) {
    by_pages_ = add_variant({});
    by_rays_ = add_variant({.strategy = Strategy::dataflow});
    rows_.push_back({"all", nullptr, add_variant({.skips = core::no_skips()}), by_pages_});
    for (const Skip& skip : core::all_skips) {
      const Strategy strategy = is_of_rays(skip) ? Strategy::dataflow : Strategy::svm;
      rows_.push_back({skip.name, &skip, add_variant({.strategy = strategy, .skips = without(skip)}),
                       is_of_rays(skip) ? by_rays_ : by_pages_});
    }
    for (const Cutoff& cutoff : traced_cutoffs) {
      rows_.push_back({cutoff.name, nullptr, by_pages_, add_variant({.cutoff = cutoff.value})});
    }
    for (const std::size_t again : {by_pages_, by_rays_}) {
      controls_.push_back(rows_.size());
      rows_.push_back({"none", nullptr, add_variant(Variant(renders_[again].variant)), again});
      render(renders_[again].variant);  // the first render in a process takes longer
    }
  }

  std::size_t variant_count() const { return renders_.size(); }

  void render(std::size_t index) {
    const auto [seconds, report] = render(renders_[index].variant);
    note(renders_[index], account_of(report), seconds);
  }

  /// After a round, in which all variants have been rendered.
  std::vector<Ablation> results() const {
    std::vector<Ablation> results;
    for (const Row& row : rows_) {
      results.push_back(result_of(row));
    }
    return results;
  }

 private:
  struct Render {
    Variant variant;
    core::Operations operations = {};
    std::optional<core::Film> film = std::nullopt;
    std::vector<double> seconds = {};  ///< of processors, by round
  };
  /// Two renders, by their places, and what they show.
  struct Row {
    const char* name;
    const Skip* skip;  ///< none for all, and for cutoffs
    std::size_t without, with;
  };

  /// Seconds of processors, and what came out.
  std::pair<double, Report> render(const Variant& variant) const {
    core::RenderSettings settings = subject_.settings;
    settings.skips = variant.skips;
    settings.shade.cutoff = variant.cutoff;
    DoubleStopwatch stopwatch;
    settings.background =
        variant.skips.background ? core::find_background(subject_.database, settings.camera) : core::BackgroundTiles();
    const double to_prepare = stopwatch.lap().processor_seconds;
    TimedRender one = render_timed(strategy_of(variant), subject_.database, settings, interrupt_);
    return {to_prepare + one.times.processor_seconds, std::move(one.report)};
  }

  Ablation result_of(const Row& row) const {
    const Render &without = renders_[row.without], &with = renders_[row.with];
    Ablation result{
        .seconds = seconds_of(row), .work_ratio = work_of(without) / work_of(with), .noise = noise_of(with.variant.strategy)};
    if (row.skip != nullptr) {
      result.avoided = with.operations.skipped.*row.skip->avoided;
      result.unit = row.skip->unit;
    } else if (with.variant.cutoff > 0) {
      result.avoided = with.operations.rays_cut;
      result.unit = "rays";
      result.error = error_between(*with.film, *without.film);
    }
    return result;
  }

  Comparison seconds_of(const Row& row) const {
    const bool is_of_rays = renders_[row.with].variant.strategy == Strategy::dataflow;
    return {.part = SpeedPart::ablation,
            .scene = scene_,
            .what = row.name,
            .detail = is_of_rays ? "dataflow" : "svm",
            .threads = is_of_rays ? ray_nodes : page_nodes,
            .subject = "without it",
            .rival = "with it",
            .unit = "s",
            .subject_figures = renders_[row.without].seconds,
            .rival_figures = renders_[row.with].seconds};
  }

  double noise_of(Strategy strategy) const {
    double noise = 0;
    for (const std::size_t control : controls_) {
      if (renders_[rows_[control].with].variant.strategy == strategy) {
        const RatioSpread ratio = ratio_of(seconds_of(rows_[control]));
        noise = std::max(ratio.most - 1, 1 - ratio.least);
      }
    }
    return noise;
  }

  static double work_of(const Render& render) { return static_cast<double>(core::work_of(render.operations)); }

  std::size_t add_variant(const Variant& variant) {
    renders_.push_back({variant});
    return renders_.size() - 1;
  }

  void note(Render& render, const Account& account, double seconds) {
    render.operations = account.operations;
    render.film = account.film;
    render.seconds.push_back(seconds);
    core::expect(render.variant.cutoff > 0 || account.film.hash() == renders_[by_pages_].film->hash(),
                 "an exact skip changes no film");
  }

  std::string scene_;
  const Interrupt& interrupt_;
  Subject subject_;
  std::vector<Render> renders_;
  std::vector<Row> rows_;
  std::size_t by_pages_ = 0, by_rays_ = 0;  ///< variants with all skips on
  std::vector<std::size_t> controls_;       ///< rows of the same once more
};

}  // namespace

void measure_ablation(const SpeedSettings& settings, const Interrupt& interrupt, std::vector<Ablation>& results) {
  const std::size_t rounds = settings.rounds_of(SpeedPart::ablation);
  for (const std::string& scene : settings.scenes_of(SpeedPart::ablation)) {
    Progress progress(std::cerr, stderr_is_terminal(), scene + " without skips:", "renders");
    AblationBench bench(scene, settings, interrupt);
    const std::size_t count = bench.variant_count(), first = results.size();
    round_by_round(rounds, count, progress, [&](std::size_t index) {
      bench.render(index);
      if (index + 1 == count) {
        const std::vector<Ablation> rows = bench.results();
        results.resize(first);
        results.insert(results.end(), rows.begin(), rows.end());
      }
    });
  }
}

}  // namespace dmpc::apps
