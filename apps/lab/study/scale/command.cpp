#include "apps/lab/study/scale/command.h"

#include <algorithm>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/line/option_values.h"
#include "apps/frontend/system/real_load.h"
#include "apps/frontend/table/shown_rows.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/lab/study/scale/measure.h"
#include "apps/lab/study/scale/table.h"
#include "core/base/expect.h"
#include "core/families/scenes.h"
#include "dataflow/regions/bsp.h"

namespace dmpc::apps {
namespace {

constexpr const char* data_file = "scale.csv";

TableFiles files_of(const ScaleOptions& options) { return {options.table, {names_of(data_file, scale_plots(options.settings))}}; }

TableResult result_of(const std::vector<ScaleResult>& results, const ScaleOptions& options, double load, bool is_whole) {
  Table table = scale_table(results, options.settings);
  if (!is_whole) {
    table.add_note("Ended before its time: rows are missing.");
  }
  table.add_note(load_note(load));
  std::string conclusion = scale_conclusion(table);
  return study_result({.title = "Study scale",
                       .table = std::move(table),
                       .data_file = data_file,
                       .plots = scale_plots(options.settings),
                       .conclusion = std::move(conclusion)},
                      options.table.format);
}

std::size_t parse_cache(const std::string& text) {
  const std::size_t bytes = parse_size_bytes(text, "--cache");
  if (bytes == 0 || bytes % ScaleSettings::page_bytes != 0) {
    throw core::UsageError("--cache=" + text + ": this is not a number of whole pages; expected a multiple of 1KiB");
  }
  return bytes;
}

void add_family(const std::string& family, bool& has_families, ScaleSettings& settings) {
  if (!has_families) {
    settings.families.clear();
  }
  has_families = true;
  if (std::find(settings.families.begin(), settings.families.end(), family) != settings.families.end()) {
    throw core::UsageError("FAMILY " + family + ": it is there twice");
  }
  settings.families.push_back(family);
}

void add_subject(OptionSet& set, ScaleSettings& settings) {
  set.add_arguments(
      "FAMILY", [&settings, given = false](const std::string& text) mutable { add_family(text, given, settings); },
      "Families of built-in scenes; without any tetra and mount");
  set.add_text(
      "--sizes", "N-N,N,... [from a thousand primitives to 17 million]",
      [&settings](const std::string& text) { settings.sizes = parse_scale_sizes(text); },
      "Sizes of their scenes, from small to large, each once");
  set.add_text(
      "--parts", "NAME,NAME [sizes,nodes]", [&settings](const std::string& text) { settings.parts = parse_scale_parts(text); },
      "What grows: the scene, the number of nodes");
  set.add_text(
      "--methods", "NAME,... [cache,quarter,dataflow]",
      [&settings](const std::string& text) { settings.methods = parse_scale_methods(text); },
      "Who renders: svm with --cache, svm with a quarter of the database in each cache (not in part nodes), dataflow");
}

void add_computer(OptionSet& set, ScaleSettings& settings) {
  constexpr std::uint32_t most = nodes::node_count_max;
  set.add_text(
      "--cache", "BYTES [1MiB]", [&settings](const std::string& text) { settings.cache_bytes = parse_cache(text); },
      "Of each node, for method cache");
  set.add_number("--size-nodes", settings.node_count, 1, most, "8", "Nodes of part sizes");
  set.add_text(
      "--nodes", "N,N,... [1,2,4,8,16,32,64,128,256]",
      [&settings](const std::string& text) { settings.node_counts = parse_different_numbers(text, "--nodes", most); },
      "Nodes of part nodes, from few to many, each number once");
  set.add_text(
      "--scene", "SCENE [the middle size of the first family]",
      [&settings](const std::string& text) { settings.nodes_scene = text; }, "The built-in scene of part nodes");
  set.add_text(
      "--resolution", "WxH [512x512]", [&settings](const std::string& text) { settings.resolution = parse_resolution(text); },
      "Pixels of every picture");
  set.add_number("--repeat", settings.rounds, 1, 1000, "1", "Runs of each row, of which it has the medians");
}

}  // namespace

void add_options(OptionSet set, ScaleOptions& options) {
  add_subject(set, options.settings);
  add_computer(set, options.settings);
  add_options(set, options.table, TableExtras::plots_and_report);
  set.add_quiet(options.quiet);
  set.set_examples(
      "Examples:\n"
      "  dmpc study scale --plots=plots -o scale.md      a thousand to 17 million triangles: some minutes, and 6 GB of memory\n"
      "  dmpc study scale tetra --sizes=5-10 --parts=sizes --repeat=3\n"
      "  dmpc study scale --parts=nodes --scene=mount-8 --nodes=1,16,256 --format=csv -o nodes.csv\n"
      "A row whose scene does not fit has no figures, and a note that says why.");
}

int study_scale_command(const ScaleOptions& options, Interrupt& interrupt, std::ostream& output) {
  const std::vector<ScaleRun> runs = scale_runs(options.settings);
  const TableFiles files = files_of(options);
  if (runs.empty()) {
    throw core::InputError("there is nothing to run: part nodes has none of the methods asked for");
  }
  const double load = machine_load();
  ShownRows shown(shows_rows(options.table, options.quiet), std::cerr);
  std::vector<ScaleResult> results;
  const auto take = [&](ScaleResult result) {
    results.push_back(std::move(result));
    shown.show(scale_rows(results, options.settings));
  };
  const int status = run_tabled(
      {.measure = [&] { measure_scale(runs, options.settings, interrupt, take); },
       .has_findings = [&] { return !results.empty(); }},
      [&](bool is_whole) { return result_of(results, options, load, is_whole); }, files, interrupt, output);
  check_any_fits(results);
  return status;
}

}  // namespace dmpc::apps
