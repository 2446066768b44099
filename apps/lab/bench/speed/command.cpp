#include "apps/lab/bench/speed/command.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <string>
#include <vector>

#include "apps/frontend/system/real_load.h"
#include "apps/frontend/table/shown_rows.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/part.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/oracle/oracle.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Results = std::vector<Comparison>;

bool has_figures(const Results& results) {
  return std::any_of(results.begin(), results.end(), [](const Comparison& one) { return one.figures.rounds() > 0; });
}

/// How a part is measured, and how its figures are obtained.
struct PartRow {
  MeasurePart* measure;
  const char* explanation;
};
/// By index.
constexpr std::array part_rows = {
    PartRow{
        .measure = measure_plain,
        .explanation =
            "plain: the render phase of both, with the same rays. The plain renderer is recursive, in single precision, with one "
            "Embree tree (robust, high quality; spheres and cones are user geometry in double precision) in memory that its "
            "threads share; it traces one ray at a time and emulates "
            "nothing. Ours has the defaults of `render`; nodes share the same cores; Embree's tree is built within the phase. A "
            "command is `dmpc render` as a process of its own that writes an EXR file, minus the shortest of three of 8x8 "
            "pixels, over the plain renderer's phase. If it takes no longer than that, the round has no figure; a scene without "
            "any figure is not part of a mean. The distance is that of the plain picture from ours, over 1/255."},
    PartRow{.measure = measure_paths,
            .explanation = "paths: the render phase, 16 samples per pixel, three bounces, a white sky. The plain path tracer has "
                           "the same positions in pixels, random numbers, directions and roulette, traces one ray at a time with "
                           "Embree (robust, high quality), and emulates nothing. So its picture has our error; the distance, "
                           "over our noise, is how far rounding leads paths elsewhere. Each scene is rendered as it is, and with "
                           "spherical lights in place of points and metal in place of mirrors."},
    PartRow{.measure = measure_kernel,
            .explanation = "kernel: rays of one render, up to a limit per class, and random bounces from what the camera sees; "
                           "all contenders trace the same rays as closest hit and as any hit, in the processor time of the "
                           "busiest thread. Bundles are those of a render in tiles of 4x4 pixels: up to 16 rays that are traced "
                           "together; grids trace their rays one by one, in the same order. Embree is called by rtcIntersect1 "
                           "and rtcOccluded1, without filters; its trees are of high quality. The pager is that of a node of "
                           "eight, with all other nodes' pages in its cache. Bounces are those of a path tracer."},
    PartRow{.measure = measure_emulation,
            .explanation = "emulation: seconds of the render phase, including allocation of the nodes' memories and distribution "
                           "of the database; the nodes share the same cores."},
    PartRow{.measure = measure_ablation,
            .explanation = "ablation: processor time of the render phase, with its preparation, without a skip over that with "
                           "it; and counted operations by their prices, in which messages do not count. The row of the same "
                           "again shows the noise. The errors are those of what a cutoff leaves out, which changes the picture."},
};
const PartRow& row_of(SpeedPart part) { return part_rows[static_cast<std::size_t>(part)]; }

TableFiles files_of(const SpeedOptions& options) {
  OtherFiles others;
  for (const std::string& scene : options.settings.scenes) {
    add_scene_file(scene, others.inputs);
  }
  return {options.table, {}, others};
}

void measure_all(const SpeedOptions& options, const TableFiles& files, const Interrupt& interrupt, Results& results) {
  SpeedSettings settings = options.settings;
  settings.outputs = files.names();
  ShownRows shown(shows_rows(options.table, options.quiet), std::cerr);
  for (const SpeedPart part : options.parts) {
    row_of(part).measure(settings, interrupt, results);
    if (shown.is_shown()) {
      shown.show(headline_of(results, "", options.shows_all));
    }
  }
}

std::string title() {
  return std::string("Speed beside Embree ") + embree_version() +
         " and of emulated computers; ratios are medians over rounds, subject over baseline";
}

void add_notes(const SpeedOptions& options, double load, bool is_whole, Table& table) {
  for (const SpeedPart part : options.parts) {
    table.add_note(row_of(part).explanation);
  }
  table.add_note(load_note(load));
  if (!is_whole) {
    table.add_note("Ended before its time: parts or rounds are missing.");
  }
}

/// The means come first; all comparisons follow if the output is a file.
std::string text_of_all(const SpeedOptions& options, const Results& results, double load, bool is_whole) {
  Table details = table_of(results, title());
  if (options.table.format != TableFormat::markdown) {
    add_notes(options, load, is_whole, details);
    return text_of(details, options.table.format);
  }
  Table means = headline_of(results, title() + ", geometric means over scenes and kinds", options.shows_all);
  add_notes(options, load, is_whole, means);
  if (options.table.file) {
    return text_of(means, TableFormat::markdown) + "\n" + text_of(details, TableFormat::markdown);
  }
  means.add_note("--all prints all means, a file (-o) has all " + std::to_string(details.rows().size()) + " comparisons.");
  return text_of(means, TableFormat::markdown);
}

/// Parts and threads belong to comparisons.
void choose_ablation(const OptionSet& set, SpeedOptions& options) {
  if (!options.is_ablation) {
    return;
  }
  for (const char* other : {"--parts", "--threads"}) {
    if (set.is_given(other)) {
      throw core::UsageError(std::string("--ablation does not go with ") + other);
    }
  }
  options.parts = {SpeedPart::ablation};
  options.shows_all = true;
}

}  // namespace

void add_options(OptionSet set, SpeedOptions& options) {
  SpeedSettings& settings = options.settings;
  set.add_arguments(
      "SCENE", [&settings](const std::string& text) { settings.scenes.push_back(text); },
      "NFF or mesh files, or built-in scenes such as teapot-12, rings-3, tetra-6; by default teapot-12, mount-6-t6, rings-4-t1 "
      "and tetra-9; plain adds balls-2-t4, and jacks-3 and lattice-12, which are curved");
  set.add_text(
      "--parts", "NAME,NAME,... [all]", [&options](const std::string& text) { options.parts = parse_speed_parts(text); },
      "Parts to measure: plain (all compared with a plain renderer), paths (compared with a plain path tracer), kernel (rays per "
      "second), emulation (small caches)");
  set.add_flag("--ablation", options.is_ablation,
               "Measure the benefit of each skip (render --no-skip) instead. The default scenes then include balls-4 and tree-8");
  set.check_in_the_end([set, &options] { choose_ablation(set, options); });
  set.add_flag("--all", options.shows_all, "Print the means of all contenders, not only of those that say most");
  set.add_flag("--quick", settings.is_quick, "Use fewer rays, rounds, pixels and large scenes");
  set.add_number("--repeat", settings.rounds, 1, 1000, "kernel 7, ablation 5, others 3",
                 "Number of rounds; everything is timed in each");
  set.add_text(
      "--threads", "N,N,... [1 and all cores]",
      [&settings](const std::string& text) { settings.thread_counts = parse_thread_counts(text); },
      "Numbers of threads that trace in part kernel");
  set.add_text(
      "--resolution", "WxH [512x512, plain and emulation 1024x1024, paths 256x256]",
      [&settings](const std::string& text) { settings.resolution = parse_resolution(text); },
      "Width and height of the pictures in pixels");
  add_options(set, options.table, TableExtras::none);
  set.add_quiet(options.quiet);
  set.set_examples(
      "Examples:\n"
      "  dmpc bench speed --quick\n"
      "  dmpc bench speed --parts=kernel --threads=1 -o speed.md\n"
      "  dmpc bench speed --ablation -o skips.md\n"
      "  dmpc bench speed my.nff rings-5-t1 --parts=kernel,emulation --resolution=256x256 --format=csv -o speed.csv\n"
      "All figures are measured in one run on one machine; figures of two runs are not comparable.");
}

int bench_speed_command(const SpeedOptions& options, Interrupt& interrupt, std::ostream& output) {
  const TableFiles files = files_of(options);
  const double load = machine_load();
  Results results;
  const auto result = [&](bool is_whole) -> TableResult { return {.text = text_of_all(options, results, load, is_whole)}; };
  return run_tabled({.measure = [&] { measure_all(options, files, interrupt, results); },
                     .has_findings = [&] { return has_figures(results); },
                     .consequence = "the table has what was measured before"},
                    result, files, interrupt, output);
}

}  // namespace dmpc::apps
