#include "apps/lab/study/frames.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "apps/edge/line/number_text.h"
#include "apps/edge/line/option_values.h"
#include "apps/edge/table/filled_columns.h"
#include "apps/lab/study/engine/measure_each.h"
#include "apps/run/run_strategy.h"
#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/picture/frame_settings.h"
#include "svm/packets.h"

namespace dmpc::apps {
namespace {

/// What one frame took.
struct FrameFigures {
  std::uint64_t film = 0, faults = 0, bytes = 0, total_ns = 0;
  std::uint64_t node_faults_max = 0;  ///< of the node that has most
};

FrameFigures figures_of(const svm::Report& report) {
  FrameFigures figures{.film = report.film.hash(),
                       .faults = report.pages().faults,
                       .bytes = report.sent()[svm::number_of(svm::Kind::page_reply)].bytes,
                       .total_ns = report.virtual_time->total_ns};
  for (const svm::NodeReport& node : report.nodes) {
    figures.node_faults_max = std::max(figures.node_faults_max, node.program.pages.faults);
  }
  return figures;
}

FrameFigures figures_of(const dataflow::Report& report) {
  return {
      .film = report.film.hash(), .bytes = dataflow::ray_traffic(report.sent()).bytes, .total_ns = report.virtual_time->total_ns};
}

/// Frames one after the other; of cold ones the first stands for none.
using PathFigures = std::vector<FrameFigures>;

/// The mean over frames 2 to the last.
template <class Number>
double mean_of(const PathFigures& frames, Number FrameFigures::*number) {
  double sum = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    sum += static_cast<double>(frames[i].*number);
  }
  return sum / static_cast<double>(frames.size() - 1);
}

/// What travels, and with which caches.
struct FramesCase {
  std::string what;
  Strategy strategy = Strategy::svm;
  std::uint32_t cache_pages = 0;
};

struct FramesRow {
  FramesCase of;
  std::uint32_t page_count = 1;
  PathFigures warm, cold;

  bool has_pages() const { return of.strategy == Strategy::svm; }
  double percent(std::uint64_t FrameFigures::*number) const { return percent_of(mean_of(warm, number), mean_of(cold, number)); }
  double worst_percent() const {
    double most = 0;
    for (std::size_t i = 1; i < warm.size(); ++i) {
      most = std::max(most, percent_of(warm[i].faults, cold[i].faults));
    }
    return most;
  }
};

const FilledColumns<FramesRow>& frames_columns() {
  using Row = FramesRow;
  static const FilledColumns<Row> columns = [] {
    const auto of_pages = [](auto cell) { return only_if([](const Row& row) { return row.has_pages(); }, cell); };
    const auto mean = [](PathFigures Row::*frames, std::uint64_t FrameFigures::*number) {
      return [frames, number](const Row& row) { return mean_of(row.*frames, number); };
    };
    const auto seconds = [](PathFigures Row::*frames) {
      return [frames](const Row& row) { return 1e-9 * mean_of(row.*frames, &FrameFigures::total_ns); };
    };
    return FilledColumns<Row>{
        {{"what travels"}, [](const Row& row) { return row.of.what; }},
        {{"cache pages"}, of_pages([](const Row& row) { return std::uint64_t{row.of.cache_pages}; })},
        {{"share of database", "%", 1}, of_pages([](const Row& row) { return percent_of(row.of.cache_pages, row.page_count); })},
        {{"faults cold", "", 0}, of_pages(mean(&Row::cold, &FrameFigures::faults))},
        {{"faults warm", "", 0}, of_pages(mean(&Row::warm, &FrameFigures::faults))},
        {{"warm faults", "%", 1}, of_pages([](const Row& row) { return row.percent(&FrameFigures::faults); })},
        {{"worst warm faults", "%", 1}, of_pages([](const Row& row) { return row.worst_percent(); })},
        {{"traffic cold", "bytes", 0}, mean(&Row::cold, &FrameFigures::bytes)},
        {{"traffic warm", "bytes", 0}, mean(&Row::warm, &FrameFigures::bytes)},
        {{"time cold", "s", 3}, seconds(&Row::cold)},
        {{"time warm", "s", 3}, seconds(&Row::warm)},
        {{"warm time", "%", 1}, [](const Row& row) { return row.percent(&FrameFigures::total_ns); }}};
  }();
  return columns;
}

/// The frames of a study and the computers that render them.
class FrameRuns {
 public:
  FrameRuns(const FramesStudy& study, StudyRuns& runs) : study_(study), runs_(runs) {
    CameraPath path = study.camera_path ? read_camera_path(*study.camera_path) : CameraPath::turntable(study.turntable_degrees);
    if (path.first() > 1 || path.last() < study.frame_count) {
      throw core::InputError(study.camera_path->string() + ": its keyframes reach from frame " + grouped(path.first()) + " to " +
                             grouped(path.last()) + ", and the study renders 1 to " + grouped(study.frame_count));
    }
    path.set_scene(study.own_view, study.bounds);
    path.check(1, study.frame_count);
    const core::Camera& own = runs.settings().camera;
    for (std::uint64_t frame = 1; frame <= study.frame_count; ++frame) {
      const core::Camera camera(path.view(frame), runs.settings().header.frame, own.width(), own.height(), own.samples());
      frames_.push_back(core::seen_by(camera, runs.settings(), runs.database()));
    }
  }

  std::uint32_t page_count() const { return static_cast<std::uint32_t>(runs_.database().page_count()); }

  FramesRow row(const FramesCase& of) const {
    FramesRow row{.of = of, .page_count = page_count(), .warm = {}, .cold = {}};
    const ReadyRun warm = ready(of, 0);
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      row.warm.push_back(figures(i == 0 ? warm.start({}, token_.get_token()) : warm.go_on(frames_[i], token_.get_token())));
      row.cold.push_back(i == 0 ? row.warm[0] : figures(ready(of, i).start({}, token_.get_token())));
      core::expect(row.warm[i].film == row.cold[i].film, "a frame has one film, warm and cold");
    }
    return row;
  }

 private:
  FrameFigures figures(const Report& report) const {
    runs_.check();
    return std::visit([](const auto& of_strategy) { return figures_of(of_strategy); }, report);
  }

  /// Nodes that begin with frame `index`.
  ReadyRun ready(const FramesCase& of, std::size_t index) const {
    StrategyOptions options = study_.run;
    options.strategy = of.strategy;
    options.computer.node_count = study_.node_count;
    options.has_several_frames = true;
    if (of.strategy == Strategy::svm) {
      options.pages.cache_pages = of.cache_pages;
    }
    return make_ready(options, runs_.database(), frames_[index]);
  }

  const FramesStudy& study_;
  StudyRuns& runs_;
  std::vector<core::RenderSettings> frames_;
  std::stop_source token_;  ///< never stopped: between frames a signal is looked for
};

}  // namespace

void FramesStudy::add_options(StudyLine line) {
  line.set.add_number("--nodes", node_count, 2, nodes::node_count_max, "8", "Nodes, each with a cache of its own");
  line.set.add_number("--frames", frame_count, 2, 10'000, "6", "Frames of the path, of which all but the first are counted");
  line.set.add_text(
      "--turntable", "DEGREES [1]",
      [this](const std::string& text) {
        turntable_degrees = finite_number(text);
        if (!(std::abs(turntable_degrees) <= 360)) {
          throw core::UsageError("--turntable=" + text + ": expected degrees from one frame to the next, from -360 to 360");
        }
      },
      "From one frame to the next the camera goes round the scene by so much");
  line.set.add_path("--camera-path", "FILE", camera_path,
                    "Move the camera through the keyframes of FILE, lines of a frame and what --camera takes, from frame 1 on");
  add_machine_options(line.set, run.runner, "");
  line.set.check_in_the_end([this, set = line.set, &file = line.machine_name] {
    if (camera_path && set.is_given("--turntable")) {
      throw core::UsageError("--turntable does not go with --camera-path: the camera moves in one way");
    }
    file = run.runner.machine_name;
    run.runner.kind = RunnerKind::virtual_time;
    choose_machine(run);
  });
  line.set.set_examples(
      "Examples:\n"
      "  dmpc study frames rings-4-t1\n"
      "  dmpc study frames mount-6 --turntable=5 --machine=hdr --format=csv -o mount.csv");
}

std::vector<Column> FramesStudy::columns() const { return heads_of(frames_columns()); }

std::vector<Plot> FramesStudy::plots() const {
  return {curves("frames_faults", "Faults of a frame", "cache pages", {}, {.label = "", .least = 0},
                 {{"cold", "faults cold"}, {"warm", "faults warm"}})};
}

std::vector<PlannedRun> FramesStudy::planned() const {
  constexpr std::size_t cases = 5;
  return std::vector<PlannedRun>(cases * 2 * frame_count, {Strategy::svm, node_count, true});
}

void FramesStudy::measure(StudyRuns& runs, Table& table) const {
  const FrameRuns frames(*this, runs);
  const std::uint32_t all = frames.page_count();
  const FramesRow kept = frames.row({"pages, all kept", Strategy::svm, all});
  runs.take(kept.warm.front().film);
  std::uint64_t most = 1;
  for (const FrameFigures& frame : kept.cold) {
    most = std::max(most, frame.node_faults_max);  // nothing leaves such a cache, so each fault is another page
  }
  const auto working_set = static_cast<std::uint32_t>(most);
  const auto share = [all](std::uint32_t percent) { return std::max(core::ceil_divide(all * percent, 100U), 1U); };
  const std::vector<FramesCase> cases = {{"pages, caches of 25 %", Strategy::svm, share(25)},
                                         {"pages, caches of 40 %", Strategy::svm, share(40)},
                                         {"pages, caches of the working set", Strategy::svm, working_set},
                                         {"rays", Strategy::dataflow, 0}};
  measure_each(
      cases.size(), Turns::side_by_side, [&](std::size_t i) { return frames.row(cases[i]); },
      [&](std::size_t i, const FramesRow& row) {
        if (i + 1 == cases.size()) {
          table.add_row(row_of(frames_columns(), kept));
        }
        for (std::size_t frame = 0; frame < row.warm.size(); ++frame) {
          core::expect(row.warm[frame].film == kept.warm[frame].film, "a frame has one film, whoever renders it");
        }
        runs.take(row.warm.front().film);
        table.add_row(row_of(frames_columns(), row));
      });
  runs.check();
}

std::vector<std::string> FramesStudy::notes(const std::string&) const {
  const std::string path = camera_path ? "the camera moves through the keyframes of " + camera_path->string()
                                       : "turned by " + shortest(turntable_degrees) + " degrees a frame";
  return {
      machine_text(*run.computer.machine) + ", " + counted(node_count, "node") + ", 1 pixel in flight; " +
          counted(frame_count, "frame") + ", " + path + ". Means over frames 2 to " + grouped(frame_count) + ".",
      "Cold: by nodes that begin with the frame; warm: by nodes that have rendered those before it, and keep caches, or "
      "regions. Of rays cold ones have regions by the frame's own subsampled picture, warm ones those of frame 1.",
      "Caches, lru, each of so many pages; the working set is what the node that needs most fetches of a cold frame. Traffic: "
      "pages sent, or packets with rays. Worst: of the frame for which the share is largest.",
      "Each frame's film is the same in all rows, warm and cold; below stands that of frame 1."};
}

std::string FramesStudy::conclusion(const Table& table) const {
  std::string text;
  for (const std::vector<Cell>& row : table.rows()) {
    const auto share = number_in(table, row, "warm faults"), cache = number_in(table, row, "share of database");
    if (share && cache) {
      text += (text.empty() ? "Of a cold frame's faults a warm one has " : ", ") + percent_text(*share) + " with caches of " +
              percent_text(*cache) + " of the database";
    }
  }
  return text.empty() ? "" : text + ".";
}

}  // namespace dmpc::apps
