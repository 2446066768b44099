#include "apps/lab/bench/error/command.h"

#include <algorithm>
#include <bit>
#include <iostream>
#include <set>
#include <span>
#include <utility>

#include "apps/frontend/line/folded_text.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/line/parsed_number.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/system/real_load.h"
#include "apps/frontend/table/shown_rows.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/bench/error/findings.h"
#include "apps/lab/bench/error/table.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "svm/plan.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t default_reference_side = 32;
/// A quick bench takes less than 20 s on two cores.
constexpr std::uint32_t quick_reference_side = 12;
constexpr Resolution quick_resolution{192, 192};
/// For paths, whose references have many more samples.
constexpr Resolution path_resolution{128, 128}, quick_path_resolution{64, 64};

/// Samples for path references, and fewer for a quick bench.
constexpr std::uint32_t path_reference_side = 128, quick_path_reference_side = 32;

/// The number is even, since the reference has two halves.
std::uint32_t parse_reference_side(const std::string& text) {
  const std::uint32_t side = number_in<std::uint32_t>(text).value_or(0);
  if (side < 2 || side > 128 || side % 2 != 0) {
    throw core::UsageError("--reference-samples=" + text + ": expected an even number from 2 to 128");
  }
  return side;
}

std::string plot_name_of(const std::string& scene) { return "error_" + file_text(scene); }
std::string data_file_of(const std::string& scene) { return plot_name_of(scene) + ".csv"; }

void check_scenes(const ErrorOptions& options) {
  if (options.scenes.empty()) {
    throw core::UsageError("SCENE: expected one or more");
  }
  std::set<std::string> names;
  for (const std::string& scene : options.scenes) {
    if (!names.insert(file_text(scene)).second) {
      throw core::UsageError("SCENE " + scene + ": there is another one with this name, and their outputs would clash");
    }
    if (options.has_tessellation && tessellations_of(scene, options.measure.is_quick).empty()) {
      throw core::UsageError(
          "--knobs=tessellation: " + scene +
          " is no built-in scene of at most a million triangles that has exact spheres or cones to tessellate");
    }
  }
}

TableFiles files_of(const ErrorOptions& options) {
  OtherFiles others;
  std::vector<PlottedNames> plotted;
  for (const std::string& scene : options.scenes) {
    add_scene_file(scene, others.inputs);
    plotted.push_back({data_file_of(scene), {plot_name_of(scene), knobs_plot_of(plot_name_of(scene))}});
  }
  return {options.table, plotted, others};
}

std::string light_text(const PictureOptions& picture) {
  return picture.transport.is_by_paths() ? ", " + text_of(picture.transport) : " at depth " + std::to_string(picture.depth);
}

std::string title_of(const ErrorOptions& options) {
  const MeasureOptions& measure = options.measure;
  return "Error against time: about " + counted(static_cast<std::uint64_t>(measure.picture.samples), "sample") + " a pixel" +
         light_text(measure.picture) + ", convention " +
         (measure.picture.convention == core::Convention::haines ? "haines" : "paper") + ", " +
         name_of(measure.strategy.strategy) + " on " + counted(measure.strategy.computer.node_count, "node") + ", " +
         counted(measure.rounds, "round");
}

std::vector<std::string> explanations(bool are_by_paths) {
  return {std::string("RMSEs are against the converged picture in ") +
              (are_by_paths ? "the renderer's own arithmetic, with other samples than all rows." : "double precision."),
          "Errors are RMSEs without the reference's own, whose square is subtracted, with an interval of 95 % by how much 64 "
          "groups of pixels differ; an error below the reference's own is not told, drawn or compared.",
          "Seconds are processor time. Shares at equal error are interpolated in logarithms; their intervals have the groups' "
          "differences and the rounds' least and most.",
          are_by_paths ? "Fewer bounces make the picture darker, an error that samples do not reduce; roulette and BSDF sampling "
                         "alone cause no such error."
                       : "Deterministic errors are those of the knob alone: against the picture with the same samples and the "
                         "knob at its exact position; for arithmetic, against the same samples in double precision.",
          "Adaptive sampling is asked for no error below the reference's own, or that uniform samples do not reach."};
}

Table finished_table(const ErrorOptions& options, std::span<const SceneResult> results, double load, bool is_whole) {
  Table table = table_of(results, title_of(options));
  for (const std::string& sentence : explanations(options.measure.picture.transport.is_by_paths())) {
    table.add_note(sentence);
  }
  for (const SceneResult& result : results) {
    for (std::string& sentence : findings_of(result)) {
      table.add_note(std::move(sentence));
    }
  }
  table.add_note(load_note(load));
  if (!is_whole) {
    table.add_note("Ended before its time: points or rounds are missing.");
  }
  return table;
}

std::string first_words(const ErrorOptions& options, std::span<const SceneResult> results) {
  const std::string summary = options.table.format == TableFormat::markdown ? summary_of(results) : "";
  constexpr std::size_t width = 120;  // as the table's notes
  return summary.empty() ? "" : folded(summary, width, "") + "\n\n";
}

std::vector<PlottedTable> plotted_tables(std::span<const SceneResult> results) {
  return core::mapped<PlottedTable>(results, [&](const SceneResult& result) -> PlottedTable {
    return {table_of({&result, 1}, result.scene), data_file_of(result.scene), plots_of(result, plot_name_of(result.scene))};
  });
}

/// Shows points that were rendered once; the table has their final times.
void show_rows(const SceneResult& result, ShownRows& shown) {
  constexpr std::size_t key_count = 3;  // scene, knob and setting
  if (shown.is_shown()) {
    shown.show(table_of({&result, 1}, ""), key_count);
  }
}

void measure_all(const ErrorOptions& options, const TableFiles& files, const Interrupt& interrupt,
                 std::vector<SceneResult>& results) {
  MeasureOptions measure = options.measure;
  measure.outputs = files.names();
  ShownRows shown(shows_rows(options.table, options.quiet), std::cerr);
  measure.reported = [&](const SceneResult& result) { show_rows(result, shown); };
  for (const std::string& scene : options.scenes) {
    measure_scene(scene, measure, interrupt, results.emplace_back());
  }
}

bool has_measurements(const SceneResult& result) {
  return std::any_of(result.measurements.begin(), result.measurements.end(), [](const auto& one) { return one.is_done(); });
}

/// Explicit options take precedence.
void choose_quick(const OptionSet& set, MeasureOptions& measure) {
  const bool are_by_paths = measure.picture.transport.is_by_paths();
  if (!set.is_given("--resolution")) {
    measure.picture.resolution = are_by_paths ? quick_path_resolution : quick_resolution;
  }
  if (!set.is_given("--reference-samples")) {
    measure.reference.samples_a_side = are_by_paths ? quick_path_reference_side : quick_reference_side;
  }
}

/// The default knobs and the reference's samples depend on the transport.
void choose_transport(const OptionSet& set, MeasureOptions& measure) {
  const bool are_by_paths = measure.picture.transport.is_by_paths();
  if (!set.is_given("--knobs")) {
    measure.knobs = all_knobs(are_by_paths);
  }
  check_knobs(measure.knobs, are_by_paths);
  if (!are_by_paths) {
    return;
  }
  if (!set.is_given("--resolution")) {
    measure.picture.resolution = path_resolution;
  }
  std::uint32_t& side = measure.reference.samples_a_side;
  side = set.is_given("--reference-samples") ? side : path_reference_side;
  if (!std::has_single_bit(side)) {
    throw core::UsageError("--reference-samples=" + std::to_string(side) + ": by paths expected a power of two from 2 to 128");
  }
}

/// Declares the options for what is varied and what is not.
void add_turned_options(OptionSet set, ErrorOptions& options) {
  MeasureOptions& measure = options.measure;
  set.add_text(
      "--knobs", "NAME,NAME,... [all]",
      [&](const std::string& text) {
        measure.knobs = parse_knobs(text);
        options.has_tessellation = measure.knobs.contains(Knob::tessellation);
      },
      "Knobs to turn, one at a time: samples, adaptive (sampling), cutoff, depth, tessellation, arithmetic, quality (draft, "
      "default). By paths: samples, adaptive, bounces, roulette and emitters (the number of those for light sampling)");
  set.add_flag("--quick", measure.is_quick,
               "Fewer positions of each knob and, unless given, 192x192 pixels and 12 x 12 samples per pixel of the "
               "reference: less than 20 s");
  set.add_number("--repeat", measure.rounds, 1, 1000, "3", "Number of rounds; everything is rendered and timed in each");
  set.add_number("--samples", measure.picture.samples, 2, 4096, std::to_string(measure.picture.samples),
                 "Samples per pixel where they are not the knob");
}

}  // namespace

ErrorOptions::ErrorOptions() {
  measure.picture.samples = Setting().samples;
  measure.picture.depth = Setting().depth;
  measure.strategy.strategy = Strategy::replicated;
  measure.strategy.computer.node_count = core_count();
  measure.knobs = all_knobs();
  measure.reference.samples_a_side = default_reference_side;
}

void add_options(OptionSet set, ErrorOptions& options) {
  MeasureOptions& measure = options.measure;
  set.add_arguments(
      "SCENE", [&options](const std::string& text) { options.scenes.push_back(text); },
      "NFF or mesh files, or built-in scenes such as teapot-12, rings-3, tetra-6");
  add_turned_options(set, options);
  add_options(set, measure.picture.scene_setup);
  add_view_options(set, measure.picture);
  add_transport_options(set, measure.picture);
  set.add_text(
      "--reference-samples",
      "N, even, 2..128 [" + std::to_string(default_reference_side) + ", by paths " + std::to_string(path_reference_side) + "]",
      [&measure](const std::string& text) { measure.reference.samples_a_side = parse_reference_side(text); },
      "N x N samples per pixel of the reference");
  add_strategy_option(set, measure.strategy.strategy);
  set.add_number("--nodes", measure.strategy.computer.node_count, 1, nodes::node_count_max,
                 std::to_string(measure.strategy.computer.node_count), "Nodes that render");
  add_options(set, options.table, TableExtras::plots);
  set.add_quiet(options.quiet);
  set.set_examples(
      "Examples:\n"
      "  dmpc bench error teapot-12 --quick\n"
      "  dmpc bench error rings-3 balls-3 --knobs=samples,adaptive --plots=plots -o error.md\n"
      "  dmpc bench error balls-3 --transport=paths --bounces=4 --sky=1 --light-radius=1 --quick\n"
      "  dmpc bench error shells-3 --knobs=depth,cutoff --repeat=1 --format=csv -o shells.csv\n"
      "By paths pictures have 128x128 pixels by default, 64x64 with --quick, and references 32 x 32 samples with --quick.\n"
      "The reference and the base point have the given depth; the other depths are smaller.");
  set.check_in_the_end([set, &options] {
    choose_transport(set, options.measure);
    if (options.measure.is_quick) {
      choose_quick(set, options.measure);
    }
    check_scenes(options);
    check_together(set, options.measure.strategy);
  });
}

int bench_error_command(const ErrorOptions& options, Interrupt& interrupt, std::ostream& output) {
  const TableFiles files = files_of(options);
  const double load = machine_load();
  std::vector<SceneResult> results;
  const auto result = [&](bool is_whole) -> TableResult {
    return {
        .text = first_words(options, results) + text_of(finished_table(options, results, load, is_whole), options.table.format),
        .plotted = [&] { return plotted_tables(results); }};
  };
  return run_tabled({.measure = [&] { measure_all(options, files, interrupt, results); },
                     .has_findings = [&] { return std::any_of(results.begin(), results.end(), has_measurements); },
                     .consequence = "the table has the points measured before"},
                    result, files, interrupt, output);
}

}  // namespace dmpc::apps
