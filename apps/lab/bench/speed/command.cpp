#include "apps/lab/bench/speed/command.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "apps/edge/system/real_load.h"
#include "apps/edge/table/shown_rows.h"
#include "apps/edge/table/table_files.h"
#include "apps/effort/effort.h"
#include "apps/lab/bench/speed/ablation.h"
#include "apps/lab/bench/speed/ablation_table.h"
#include "apps/lab/bench/speed/comparison.h"
#include "apps/lab/bench/speed/headline.h"
#include "apps/lab/bench/speed/kernel_means.h"
#include "apps/lab/bench/speed/parts.h"
#include "apps/lab/bench/speed/plain_table.h"
#include "apps/lab/bench/speed/smallest_item.h"
#include "apps/lab/bench/speed/table.h"
#include "apps/lab/bench/speed/target.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/oracle/oracle.h"
#include "apps/scene/load_scene.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

/// What has been measured so far.
struct Results {
  std::vector<Comparison> comparisons;
  std::vector<Ablation> ablations;

  bool has_figures() const {
    return std::any_of(comparisons.begin(), comparisons.end(), [](const auto& one) { return one.rounds() > 0; }) ||
           !ablations.empty();
  }
};

/// How a part is measured, and how its figures come about.
struct PartRow {
  MeasurePart* measure;  ///< nullptr for the ablation, whose results are of their own
  const char* explanation;
};
/// By number.
constexpr std::array part_rows = {
    PartRow{
        .measure = measure_plain,
        .explanation =
            "plain: the phase render of each, of the same rays. The plain renderer is recursive, in single precision, over one "
            "Embree tree (robust, high quality) in memory that its threads share; it asks for one ray at a time and emulates "
            "nothing. Ours are as `render` has them by default; nodes share the same cores, and a ray's time is a picture's "
            "over all its rays, whatever the number of threads. A command is `dmpc render` as a process of its own that writes "
            "an EXR file, less the least that three of 8x8 pixels take, over the plain renderer's phase; where it takes no "
            "longer "
            "than that the round has no figure, and a scene without any is not among those that a mean is of. Beside busy "
            "processes renders the plain renderer, too."},
    PartRow{
        .measure = measure_paths,
        .explanation =
            "paths: the phase render in processor time, 16 samples a pixel, three bounces, a white sky. The plain path tracer "
            "has the same places in pixels, chances, ways on and roulette, asks Embree (robust, high quality) for one ray at a "
            "time, and emulates nothing; so its picture has our error, and lies from ours as far as rounding leads paths "
            "elsewhere. Each scene is shown as it is, and with balls of light in place of points and metal in place of mirrors."},
    PartRow{
        .measure = measure_kernel,
        .explanation =
            "kernel: rays of one render, up to so many a class, and bounces at random from what the eye sees; all contenders "
            "trace the same rays as closest and as any hit, in the processor time of the busiest thread. Bundles are those of "
            "a render in tiles of 4x4 pixels: up to 16 rays that walk together; grids take their rays one by one, in the same "
            "order. Embree is asked by rtcIntersect1 and rtcOccluded1, for packets, which are the same bundles, by "
            "rtcIntersect16 and rtcOccluded16, told that all but bounces are coherent, without filters, its trees are of high "
            "quality. The pager is that of a node of eight, all other nodes' pages in its cache. Targets of all rays leave "
            "bounces out: a path tracer shoots them."},
    PartRow{
        .measure = measure_picture,
        .explanation =
            "picture: what `render` does, on 2 nodes. Embree's tree is built within its phase render; the whole is the sum of "
            "the phases."},
    PartRow{
        .measure = measure_emulation,
        .explanation =
            "emulation: seconds of the phase render, setting the nodes' memories aside and dealing out the database included; "
            "the nodes share the same cores. An item is a question that some other node answers by 1 KiB, and the work behind "
            "it; a node has 16 under way."},
    PartRow{
        .measure = measure_build,
        .explanation =
            "build: our database from the scene to the pages; Embree's robust tree, and its fast one of high quality (spatial "
            "splits, which robust trees have not), from vertices that lie ready; on as many threads, on one in processor time."},
    PartRow{
        .measure = measure_load,
        .explanation =
            "load: a mesh file read as a scene, by whoever is confined for that, against Assimp's reading it in this process, "
            "without any step behind; by the wall clock."},
    PartRow{.measure = measure_memory,
            .explanation =
                "memory: the most anonymous memory of a process that renders on 8 nodes, above that of one which renders a "
                "triangle, against the sum of the nodes' local memories."},
    PartRow{
        .measure = measure_pages,
        .explanation =
            "pages: our databases and the distinct pages of a pixel against Table 2 of the article, with its counting of rays."},
    PartRow{.measure = nullptr,
            .explanation =
                "ablation: processor time of the phase render, with what a skip takes to prepare. A skip is kept if it wins 3 % "
                "somewhere and loses 1 % nowhere: by time if all rounds say so clearly, else by counted operations and their "
                "prices, "
                "in which messages do not count."},
};
const PartRow& row_of(SpeedPart part) { return part_rows[static_cast<std::size_t>(part)]; }

std::string plot_name_of(SpeedPart part) { return std::string("speed_") + name_of(part); }
std::string data_file_of(SpeedPart part) { return plot_name_of(part) + ".csv"; }

TableFiles files_of(const SpeedOptions& options) {
  OtherFiles others;
  for (const std::string& scene : options.settings.scenes) {
    add_scene_file(scene, others.inputs);
  }
  std::vector<PlottedNames> plotted;
  for (const SpeedPart part : options.parts) {
    plotted.push_back({data_file_of(part), {plot_name_of(part)}});
  }
  return {options.table, plotted, others};
}

/// The one of both tables that part plain has its rows in, or all others.
Table rows_shown_of(const Results& results) {
  Table others = headline_of(results.comparisons, "");
  return others.rows().empty() ? plain_table(results.comparisons, "") : others;
}

/// Shows rows of what was measured so far, as the table in the end has them.
void show_rows(const SpeedOptions& options, const Results& results, ShownRows& shown) {
  if (shown.is_shown()) {
    shown.show(options.is_ablation ? table_of(results.ablations, "") : rows_shown_of(results));
  }
}

void measure_all(const SpeedOptions& options, const TableFiles& files, const Interrupt& interrupt, Results& results) {
  SpeedSettings settings = options.settings;
  settings.outputs = files.names();
  ShownRows shown(shows_rows(options.table, options.quiet), std::cerr);
  for (const SpeedPart part : options.parts) {
    if (const auto measure = row_of(part).measure) {
      measure(settings, interrupt, results.comparisons);
    } else {
      measure_ablation(settings, interrupt, results.ablations);
    }
    show_rows(options, results, shown);
  }
}

std::string title() {
  return std::string("Speed beside Embree ") + embree_version() +
         " and of emulated computers; ratios are medians over rounds, subject over rival";
}

void add_notes(const SpeedOptions& options, const Results& results, double load, bool is_whole, Table& table) {
  for (const SpeedPart part : options.parts) {
    table.add_note(row_of(part).explanation);
  }
  for (const Target& target : speed_targets()) {
    if (std::optional<std::string> sentence = sentence_on(target, results.comparisons)) {
      table.add_note(std::move(*sentence));
    }
  }
  for (const auto& sentences_on : {kernel_means, smallest_items}) {
    for (std::string& sentence : sentences_on(results.comparisons)) {
      table.add_note(std::move(sentence));
    }
  }
  table.add_note(load_note(load));
  if (!is_whole) {
    table.add_note("Ended before its time: parts or rounds are missing.");
  }
}

/// All our own beside a plain renderer, if that was measured; what else was measured; the notes come under the last of both.
std::string means_text(const SpeedOptions& options, const Results& results, double load, bool is_whole, const Table& details) {
  Table plain = plain_table(results.comparisons, "Beside a plain renderer over Embree, geometric means over scenes");
  Table others = headline_of(results.comparisons, title() + ", geometric means over scenes and kinds");
  for (std::string& note : plain_notes(results.comparisons)) {
    plain.add_note(std::move(note));
  }
  const bool has_others = !others.rows().empty() || plain.rows().empty();
  Table& last = has_others ? others : plain;
  add_notes(options, results, load, is_whole, last);
  if (!options.has_details && !options.table.file) {
    last.add_note("--details, or a file (-o), has all " + std::to_string(details.rows().size()) + " comparisons.");
  }
  const std::string before = plain.rows().empty() ? "" : text_of(plain, TableFormat::markdown);
  return !has_others ? before : (before.empty() ? "" : before + "\n") + text_of(others, TableFormat::markdown);
}

/// What is to be read first, then all, if that is asked for or goes to a file.
std::string comparisons_text(const SpeedOptions& options, const Results& results, double load, bool is_whole) {
  Table details = table_of(results.comparisons, title());
  if (options.table.format != TableFormat::markdown) {
    add_notes(options, results, load, is_whole, details);
    return text_of(details, options.table.format);
  }
  const bool has_details = options.has_details || options.table.file;
  return means_text(options, results, load, is_whole, details) +
         (has_details ? "\n" + text_of(details, options.table.format) : "");
}

std::string text_of_all(const SpeedOptions& options, const Results& results, double load, bool is_whole) {
  if (!options.is_ablation) {
    return comparisons_text(options, results, load, is_whole);
  }
  Table table = table_of(results.ablations, "Pictures without skips; ratios are medians over rounds, without over with");
  add_notes(options, results, load, is_whole, table);
  return text_of(table, options.table.format);
}

/// By processor time of a server's core in November 2026 with the default scenes and parts. A bench that is not quick shoots ten
/// times the rays, renders sixteen times the pixels (part plain 64 times), has tetra-9, POV-Ray and ranks, and takes more than
/// twice the rounds.
Effort effort_of(const SpeedOptions& options) {
  constexpr double quick_seconds = 12, quick_ablation_seconds = 19, quick_factor = 25, standard_scenes = 4;
  constexpr double quick_plain_seconds = 14, plain_factor = 50;
  constexpr std::size_t with_embree_bytes = std::size_t{1300} << 20U;
  const double scenes =
      options.settings.scenes.empty() ? 1 : static_cast<double>(options.settings.scenes.size()) / standard_scenes;
  const bool has_plain = options.parts.contains(SpeedPart::plain);
  const double parts =
      static_cast<double>(options.parts.size() - (has_plain ? 1 : 0)) / static_cast<double>(all_speed_parts().size() - 1);
  const double quick = scenes * (options.is_ablation ? quick_ablation_seconds : parts * quick_seconds);
  const double plain = has_plain ? scenes * quick_plain_seconds : 0;
  return {.seconds = options.settings.is_quick ? quick + plain : quick_factor * quick + plain_factor * plain,
          .bytes = options.is_ablation || !options.settings.scenes.empty() ? 0 : with_embree_bytes};
}

std::vector<PlottedTable> plotted_tables(const SpeedOptions& options, const Results& results) {
  std::vector<PlottedTable> plotted;
  for (const SpeedPart part : options.parts) {
    const bool is_ablation = part == SpeedPart::ablation;
    const Table table = is_ablation ? plotted_table(results.ablations) : plotted_table(part, results.comparisons);
    const Plot plot = is_ablation ? plot_of_ablation(table, plot_name_of(part)) : plot_of(part, table, plot_name_of(part));
    plotted.push_back({table, data_file_of(part), {plot}});
  }
  return plotted;
}

/// Parts and threads are those of comparisons.
void choose_ablation(const OptionSet& set, SpeedOptions& options) {
  if (!options.is_ablation) {
    return;
  }
  for (const char* other : {"--parts", "--threads", "--details"}) {
    if (set.is_given(other)) {
      throw core::UsageError(std::string("--ablation does not go with ") + other);
    }
  }
  options.parts = {SpeedPart::ablation};
}

}  // namespace

void add_options(OptionSet set, SpeedOptions& options) {
  SpeedSettings& settings = options.settings;
  set.add_arguments(
      "SCENE", [&settings](const std::string& text) { settings.scenes.push_back(text); },
      "NFF or mesh files, or built-in scenes such as teapot-12, rings-3, tetra-6; without any teapot-12, mount-6-t6, rings-4-t1 "
      "and "
      "tetra-9, with balls-2-t4 for plain, tetra-10 for build, load and memory, and for pages those of the 1994 article");
  set.add_text(
      "--parts", "NAME,NAME,... [all]", [&options](const std::string& text) { options.parts = parse_speed_parts(text); },
      "What is measured: plain (all beside a plain renderer), paths (beside a plain path tracer), kernel (rays a second), "
      "picture (a whole render), emulation (many "
      "nodes, small caches), build (databases), load (mesh files), memory (of the real computer), pages (against the article)");
  set.add_flag("--ablation", options.is_ablation,
               "Instead: what each skip (render --no-skip) is worth. Without SCENE balls-4 and tree-8, too");
  set.check_in_the_end([set, &options] { choose_ablation(set, options); });
  set.add_flag("--quick", settings.is_quick, "Fewer rays, rounds, pixels and large scenes, neither POV-Ray nor ranks");
  set.add_number("--repeat", settings.rounds, 1, 1000, "kernel 7, ablation 5, others 3", "Rounds in which everything is timed");
  set.add_text(
      "--threads", "N,N,... [1 and all cores]",
      [&settings](const std::string& text) { settings.thread_counts = parse_thread_counts(text); },
      "Threads that trace in kernel, and that build in build");
  set.add_text(
      "--resolution", "WxH [512x512, plain and emulation 1024x1024, paths 256x256]",
      [&settings](const std::string& text) { settings.resolution = parse_resolution(text); }, "Pixels of the pictures");
  set.add_flag("--details", options.has_details, "Print every comparison, too, not the means of them alone");
  add_options(set, options.table, TableExtras::plots);
  set.add_quiet(options.quiet);
  set.set_examples(
      "Examples:\n"
      "  dmpc bench speed --quick\n"
      "  dmpc bench speed --parts=kernel --threads=1 --plots=plots -o speed.md\n"
      "  dmpc bench speed --ablation --plots=plots -o skips.md\n"
      "  dmpc bench speed my.nff rings-5-t1 --parts=kernel,picture --resolution=256x256 --format=csv -o speed.csv\n"
      "All figures are of one run on one machine, side by side; figures of two runs do not compare.");
}

int bench_speed_command(const SpeedOptions& options, Interrupt& interrupt, std::ostream& output) {
  const TableFiles files = files_of(options);
  announce("bench speed", effort_of(options), options.quiet, std::cerr);
  const double load = machine_load();
  Results results;
  const auto result = [&](bool is_whole) -> TableResult {
    return {.text = text_of_all(options, results, load, is_whole), .plotted = [&] { return plotted_tables(options, results); }};
  };
  return run_tabled({.measure = [&] { measure_all(options, files, interrupt, results); },
                     .has_findings = [&] { return results.has_figures(); },
                     .consequence = "the table has what was measured before"},
                    result, files, interrupt, output);
}

}  // namespace dmpc::apps
