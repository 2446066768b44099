// The study `frames`: what nodes that keep their contents fetch and send for a frame, beside nodes that begin with nothing.
#include "apps/lab/study/studies.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/option_values.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/machine/machine_file.h"
#include "apps/frontend/machine/machines.h"
#include "apps/lab/crowd/side_by_side.h"
#include "apps/lab/study/frame_rows.h"
#include "apps/run/run_strategy.h"
#include "apps/scene/camera_path.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "core/base/units.h"
#include "core/picture/camera/frame_settings.h"

namespace dmpc::apps {
namespace {

/// Returns the name of rows of means over all frames except the first.
std::string means_of(std::size_t frame_count) { return "2 to " + std::to_string(frame_count); }

CameraPath path_of(const FramesStudy& study) {
  CameraPath path = study.camera_path ? read_camera_path(*study.camera_path) : CameraPath::turntable(study.turntable_degrees);
  if (path.first() > 1 || path.last() < study.frame_count) {
    throw core::InputError(study.camera_path->string() + ": its keyframes reach from frame " + grouped(path.first()) + " to " +
                           grouped(path.last()) + ", and the study renders 1 to " + grouped(study.frame_count));
  }
  path.set_scene(study.own_view, study.bounds);
  path.check(1, study.frame_count);
  return path;
}

/// The frames of a path in one database, and the computers that render them.
class FrameRuns {
 public:
  FrameRuns(const FramesStudy& study, const core::Database& database, const core::RenderSettings& settings, const StudyRuns& runs)
      : database_(database), runs_(runs) {
    const CameraPath path = path_of(study);
    for (std::uint64_t frame = 1; frame <= study.frame_count; ++frame) {
      const core::Camera& own = settings.camera;
      const core::Camera camera(path.view(frame), settings.header.frame, own.width(), own.height(), own.samples());
      frames_.push_back(core::seen_by(camera, settings, database));
    }
  }

  std::uint32_t page_count() const { return static_cast<std::uint32_t>(database_.page_count()); }

  FrameSeries series(const nodes::Machine& machine, std::uint32_t node_count, const FramesCase& of) const {
    StrategyOptions options;
    choose_machine(options, machine);
    options.strategy = of.strategy;
    options.computer.node_count = node_count;
    options.has_several_frames = true;
    if (of.has_pages()) {
      options.pages.cache_pages = of.cache_pages;
    }
    FrameSeries series{name_with_links(machine), node_count, of, page_count(), {}, {}};
    const ReadyRun warm = make_ready(options, database_, frames_.front());
    for (std::size_t i = 0; i < frames_.size(); ++i) {
      series.warm.push_back(figures(i == 0 ? warm.start({}, token_.get_token()) : warm.go_on(frames_[i], token_.get_token())));
      series.cold.push_back(i == 0 ? series.warm[0]
                                   : figures(make_ready(options, database_, frames_[i]).start({}, token_.get_token())));
      core::expect(series.warm[i].film == series.cold[i].film, "a frame has one film, warm and cold");
    }
    return series;
  }

 private:
  FrameFigures figures(const Report& report) const {
    runs_.check();
    return figures_of(report);
  }

  const core::Database& database_;
  const StudyRuns& runs_;
  std::vector<core::RenderSettings> frames_;
  std::stop_source token_;  ///< never stopped: signals are checked between frames
};

/// Returns the most pages that a node fetches for a cold frame if nothing leaves its cache: each fault is another page.
std::uint32_t working_set_of(const FrameSeries& kept) {
  const std::uint64_t most = core::max_over(kept.cold, std::uint64_t{1}, &FrameFigures::node_faults_max);
  return static_cast<std::uint32_t>(most);
}

/// Writes series into a table, one after the other.
class SeriesRows {
 public:
  SeriesRows(bool has_each_frame, StudyRuns& runs, Table& table) : has_each_frame_(has_each_frame), runs_(runs), table_(table) {}

  void add(const FrameSeries& series) {
    check(series);
    runs_.take(series.warm.front().film);
    for (std::size_t frame = 0; has_each_frame_ && frame < series.warm.size(); ++frame) {
      table_.add_row(row_of(frames_columns(), FramesRow{series, frame, frame + 1, std::to_string(frame + 1)}));
    }
    table_.add_row(row_of(frames_columns(), FramesRow{series, 1, series.warm.size(), means_of(series.warm.size())}));
  }

 private:
  /// Compares with the series that was added first.
  void check(const FrameSeries& series) {
    for (std::size_t frame = 0; frame < series.warm.size(); ++frame) {
      if (films_.size() == frame) {
        films_.push_back(series.warm[frame].film);
      }
      core::expect(series.warm[frame].film == films_[frame], "a frame has one film, whoever renders it");
    }
  }

  bool has_each_frame_;
  StudyRuns& runs_;
  Table& table_;
  std::vector<std::uint64_t> films_;
};

/// Measures everything that travels, on one computer.
void measure_on(const nodes::Machine& machine, std::uint32_t node_count, const FrameRuns& as_asked, const FrameRuns& in_tree,
                SeriesRows& rows) {
  const std::uint32_t all = as_asked.page_count();
  const FrameSeries kept = as_asked.series(machine, node_count, {"pages, all kept", Strategy::svm, all});
  const auto share = [all](std::uint32_t percent) { return std::max(core::ceil_divide(all * percent, 100U), 1U); };
  const std::vector<FramesCase> cases = {{"pages, caches of a quarter", Strategy::svm, share(25)},
                                         {"pages, caches of two fifths", Strategy::svm, share(40)},
                                         {"pages, caches of the working set", Strategy::svm, working_set_of(kept)},
                                         {"questions", Strategy::forest},
                                         {"rays", Strategy::dataflow}};
  constexpr std::size_t smaller_caches = 3;
  measure_each(
      cases.size(), Turns::side_by_side,
      [&](std::size_t i) {
        return (cases[i].strategy == Strategy::forest ? in_tree : as_asked).series(machine, node_count, cases[i]);
      },
      [&](std::size_t i, const FrameSeries& series) {
        if (i == smaller_caches) {
          rows.add(kept);
        }
        rows.add(series);
      });
}

void check_line(const StudyLine& line, const FramesStudy& study) {
  if (study.camera_path && line.set.is_given("--turntable")) {
    throw core::UsageError("--turntable does not go with --camera-path: the camera moves in one way");
  }
  if (line.set.is_given("--machines") && line.set.is_given("--machine")) {
    throw core::UsageError("--machines does not go with --machine: name all of them, or the one");
  }
  if (std::find(study.node_counts.begin(), study.node_counts.end(), 1U) != study.node_counts.end()) {
    throw core::UsageError("--nodes: expected at least 2, as a node alone fetches and sends nothing");
  }
}

std::vector<std::string> parse_machines(const std::string& text) {
  const std::vector<std::string> names = words_between_commas(text, "--machines");
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (!seen.insert(name).second) {
      throw core::UsageError("--machines=" + text + ": " + name + " is there twice");
    }
    if (find_machine_preset(name) == nullptr) {
      throw core::UsageError("--machines=" + text + ": expected names of " + machine_preset_names() +
                             ", with commas between; a file goes with --machine");
    }
  }
  return names;
}

/// Returns the means of the last row's computer.
std::vector<const std::vector<Cell>*> last_means(const Table& table, const std::string& frames) {
  std::vector<const std::vector<Cell>*> means;
  for (const std::vector<Cell>& row : table.rows()) {
    const bool is_alike = row[0] == table.rows().back()[0] && row[1] == table.rows().back()[1];
    if (is_alike && std::get<std::string>(row[3]) == frames) {
      means.push_back(&row);
    }
  }
  return means;
}

}  // namespace

void FramesStudy::add_options(StudyLine line) {
  add_node_counts(line.set, node_counts);
  line.set.add_number("--frames", frame_count, 2, 10'000, "6", "Frames of the path, of which all but the first are counted");
  line.set.add_flag("--each-frame", has_each_frame, "Rows for single frames, too, the first among them");
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
  add_machine_option(line.set, machine_name, "");
  line.set.add_text(
      "--machines", "NAME,NAME,...", [this](const std::string& text) { machine_names = parse_machines(text); },
      "Several machines in place of one, each with rows of its own");
  line.set.check_in_the_end([this, line] {
    check_line(line, *this);
    line.machine_name = machine_name;
    machines.clear();
    for (const std::string& machine : machine_names.empty() ? std::vector{machine_name} : machine_names) {
      machines.push_back(load_machine(machine).machine);
    }
  });
  line.set.set_examples(
      "Examples:\n"
      "  dmpc study frames rings-4-t1\n"
      "  dmpc study frames rings-4-t1 --resolution=128x128 --nodes=16,64 --machines=ipsc2,gigabit,hdr\n"
      "  dmpc study frames mount-6 --turntable=5 --each-frame --format=csv -o mount.csv");
}

std::vector<Column> FramesStudy::columns() const { return heads_of(frames_columns()); }

std::vector<Plot> FramesStudy::plots() const {
  const std::string means = means_of(frame_count);
  std::vector<PlotSeries> faults, times;
  for (const nodes::Machine& machine : machines) {
    for (const std::uint32_t count : node_counts) {
      const std::string shown = name_with_links(machine), nodes = std::to_string(count);
      const auto add = [&](std::vector<PlotSeries>& series, const std::string& what, const std::string& column, PlotMark mark) {
        series.push_back({what + ", " + nodes + " nodes of " + shown,
                          column,
                          {{"machine", shown}, {"nodes", nodes}, {"frames", means}},
                          mark,
                          series.size() % plot_color_count});
      };
      add(faults, "cold", "faults cold", PlotMark::line);
      add(faults, "warm", "faults warm", PlotMark::line);
      add(times, "warm", "warm time", PlotMark::bars);
    }
  }
  return {curves("frames_faults", "Faults of a frame", "cache pages", {}, {.label = "", .least = 0}, std::move(faults)),
          {.name = "frames_time",
           .title = "Virtual time of a warm frame",
           .places = {"what travels"},
           .x = {},
           .y = {.label = "of a cold frame's (%)", .least = 0},
           .series = std::move(times)}};
}

void FramesStudy::measure(StudyRuns& runs, Table& table) const {
  const Subject tree = build_tree();
  const FrameRuns as_asked(*this, runs.database(), runs.settings(), runs), in_tree(*this, tree.database, tree.settings, runs);
  SeriesRows rows(has_each_frame, runs, table);
  for (const nodes::Machine& machine : machines) {
    runs.note_prices(machine, runs.database());
    runs.note_prices(machine, tree.database);
    for (const std::uint32_t node_count : node_counts) {
      measure_on(machine, node_count, as_asked, in_tree, rows);
    }
  }
  runs.check();
}

std::vector<std::string> FramesStudy::notes(const std::string&) const {
  const std::string path = camera_path ? "the camera moves through the keyframes of " + camera_path->string()
                                       : "turned by " + shortest(turntable_degrees) + " degrees a frame";
  std::vector<std::string> notes =
      core::mapped<std::string>(machines, [&](const nodes::Machine& machine) { return machine_text(machine) + "."; });
  const std::vector<std::string> rest = {
      counted(frame_count, "frame") + ", " + path + "; means over frames 2 to " + std::to_string(frame_count) +
          ". Pages and questions: " + in_flight_text(Strategy::svm) + " in flight.",
      "Cold: by nodes that begin with the frame; warm: by nodes that have rendered those before it, and keep caches, or "
      "regions. Of rays cold ones have regions by the frame's own subsampled picture, warm ones those of frame 1. Questions "
      "leave nothing behind.",
      "Caches, lru, each of so many pages; the working set is what the node that needs most fetches of a cold frame. Where all "
      "is kept, a warm frame's faults are pages that their node has never had. Worst: of the frame for which the share is "
      "largest.",
      "Messages: packets of every kind. Traffic: pages sent, packets with questions and answers, or packets with rays.",
      "Each frame's film is the same in all rows, warm and cold; below stands that of frame 1."};
  notes.insert(notes.end(), rest.begin(), rest.end());
  return notes;
}

std::string FramesStudy::conclusion(const Table& table) const {
  if (table.rows().empty()) {
    return "";
  }
  std::string faults, times;
  for (const std::vector<Cell>* const row : last_means(table, means_of(frame_count))) {
    const auto share = number_in(table, *row, "warm faults"), cache = number_in(table, *row, "share of database"),
               time = number_in(table, *row, "warm time");
    if (share && cache) {
      faults += (faults.empty() ? "a warm frame has of a cold one's faults " : ", ") + percent_text(*share) + " with caches of " +
                percent_text(*cache) + " of the database";
    }
    times += (times.empty() ? "It takes of its time: " : ", ") + std::get<std::string>((*row)[2]) + " " + percent_text(*time);
  }
  const std::vector<Cell>& last = table.rows().back();
  return times.empty() ? ""
                       : "On " + nodes_text(table, last) + " of " + std::get<std::string>(last[0]) + " " +
                             (faults.empty() ? "frames follow each other" : faults) + ". " + times + ".";
}

}  // namespace dmpc::apps
