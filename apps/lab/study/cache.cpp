#include "apps/lab/study/cache.h"

#include <iostream>
#include <utility>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/machine/machine_file.h"
#include "apps/frontend/machine/machines.h"
#include "apps/frontend/system/progress.h"
#include "apps/frontend/table/geometric_sizes.h"
#include "apps/frontend/table/shown_rows.h"
#include "apps/frontend/table/table_files.h"
#include "apps/lab/crowd/side_by_side.h"
#include "apps/lab/study/engine/tabled_job.h"
#include "apps/render/picture_identity.h"
#include "apps/run/strategy_rows.h"
#include "apps/scene/load_scene.h"
#include "apps/scene/subject.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"
#include "core/families/scenes.h"

namespace dmpc::apps {
namespace {

constexpr std::uint32_t standard_size_count = 12;
/// Within this factor of the best, lru counts as good as any policy.
constexpr double as_good = 1.1;

/// svm on a machine, with one pixel at a time on each node, as in the 1994 paper.
svm::RunOptions one_at_a_time(std::uint32_t node_count, const nodes::Machine& machine) {
  return {.computer = {.node_count = node_count, .machine = machine}, .pages = {.in_flight = 1}};
}

/// All references, which depend on neither cache nor machine, so the default machine, which takes no time, will do.
svm::Report record(CacheRuns& runs, std::uint32_t node_count) {
  Progress progress(std::cerr, runs.shows_progress, counted(node_count, "node") + ", recording: ");
  svm::RunOptions options{.computer = {.node_count = node_count, .machine = nodes::Machine()},
                          .pages = {.in_flight = 1, .work_item_side = 0, .record_references = true}};
  options.watching.progress = [&progress](std::uint32_t done, std::uint32_t total) { progress.update(done, total); };
  svm::Report report = runs.run(options);
  runs.take(report.film);
  return report;
}

const std::vector<Column> timed_columns = {{"virtual time", "s", 3}, {"efficiency", "%", 2}, {"page traffic a node", "bytes/s"}};

/// Cells of these columns. A machine that takes no time has but the first.
std::vector<Cell> timed_cells(const svm::Report& report, std::uint32_t node_count, std::uint64_t one_node_ns) {
  const std::uint64_t total_ns = report.virtual_time->total_ns;
  const double seconds = 1e-9 * static_cast<double>(total_ns);
  const auto bytes = static_cast<double>(report.sent()[svm::number_of(svm::Kind::page_reply)].bytes);
  return {seconds, total_ns > 0 ? Cell(percent_of<std::uint64_t>(one_node_ns, node_count * total_ns)) : Cell(),
          total_ns > 0 ? Cell(static_cast<std::uint64_t>(bytes / node_count / seconds)) : Cell()};
}

/// Adds a row for each size as soon as the machine has run with it. Modelled machines have no threads.
void add_timed_rows(const CacheStudy& study, const CacheCurves& curves, std::uint32_t page_count, CacheRuns& runs, Table& table) {
  std::vector<svm::RunOptions> options = {one_at_a_time(1, *study.machine)};
  for (const std::uint32_t size : curves.sizes()) {
    options.push_back(one_at_a_time(study.node_count, *study.machine));
    options.back().pages.cache_pages = size;
  }
  std::uint64_t one_node_ns = 0;
  Progress progress(std::cerr, runs.shows_progress, "side by side: ", "runs");
  const auto measure = [&](std::size_t run) { return runs.run(options[run]); };
  measure_each(options.size(), measure, [&](std::size_t run, const svm::Report& report) {
    runs.take(report.film);
    progress.update(run + 1, options.size());
    if (run == 0) {
      one_node_ns = report.virtual_time->total_ns;
      return;
    }
    std::vector<Cell> row = curves.row(run - 1, page_count);
    const std::vector<Cell> timed = timed_cells(report, study.node_count, one_node_ns);
    row.insert(row.end(), timed.begin(), timed.end());
    table.add_row(std::move(row));
  });
}

std::vector<CacheCurves::NodeReferences> references_of(const svm::Report& recorded) {
  return core::mapped<CacheCurves::NodeReferences>(
      recorded.nodes, [](const svm::NodeReport& node) { return CacheCurves::NodeReferences{node.references.pages()}; });
}

constexpr const char* data_file = "cache.csv";

TableFiles files_of(const StudyOptions& options) {
  std::vector<NamedFile> inputs;
  add_scene_file(options.picture, inputs);
  if (!options.machine_name.empty() && find_machine_preset(options.machine_name) == nullptr) {
    inputs.push_back({"--machine", options.machine_name});
  }
  return {options.table, {names_of(data_file, options.study.plots())}, {.inputs = std::move(inputs)}};
}

/// Returns the subject, and the digest of its scene for a page. Here a signal ends the process at once.
std::pair<Subject, std::optional<std::uint64_t>> load(const StudyOptions& options, const TableFiles& files,
                                                      Interrupt& interrupt) {
  const Interrupt::EndAtOnce end_at_once(interrupt);
  OpenedFiles opened;
  core::Scene scene = load_scene(options.picture, LoadNotes::said, &opened);
  check_not_read(opened, files.names());
  const auto digest = options.table.report ? std::optional(scene_digest(scene)) : std::nullopt;
  return {build_subject(std::move(scene), options.picture, options.database, true), digest};
}

std::string samples_text(const PictureOptions& picture) {
  const std::string text = picture.is_refined
                               ? "samples refined to an error of " + fixed(255 * picture.refinement.error, 3) + "/255"
                               : std::to_string(picture.samples) + (picture.samples == 1 ? " sample" : " samples") + " a pixel";
  return picture.cutoff > 0 ? text + ", cutoff " + fixed(255 * picture.cutoff, 3) + "/255" : text;
}

/// Returns "structure extents, " or "structure voxels (article), ", nothing for the grid.
std::string structure_text(const core::BuildOptions& build) {
  using core::Structure;
  const std::string rule = build.structure == Structure::voxels ? " (" + text_of(build.voxels) + ")" : "";
  return build.structure == Structure::grid ? "" : std::string("structure ") + name_of(build.structure) + rule + ", ";
}

std::string title_of(const StudyOptions& options, const Subject& subject) {
  const PictureOptions& picture = options.picture;
  const core::Camera& camera = subject.settings.camera;
  return "Study cache of " + picture.scene + ": " + std::to_string(camera.width()) + "x" + std::to_string(camera.height()) +
         " pixels, " + samples_text(picture) + ", " +
         (picture.transport.is_by_paths() ? text_of(picture.transport) : "depth " + std::to_string(picture.depth)) +
         ", convention " + (picture.convention == core::Convention::haines ? "haines" : "paper") + ", record order " +
         name_of(options.database.build.record_order) + ", " + structure_text(options.database.build) +
         counted(subject.database.header().primitive_count, "primitive");
}

}  // namespace

svm::Report CacheRuns::run(const svm::RunOptions& options) const {
  interrupt.check();
  svm::Report report =
      with_options_named(strategy_words(), [&] { return svm::run_svm(database, settings, options, interrupt.token()); });
  interrupt.check();
  return report;
}

void CacheRuns::take(const core::Film& film) {
  core::expect(film.hash() == film_hash.value_or(film.hash()), "every run of a study gives the same film");
  film_hash = film.hash();
  ++count;
}

void CacheStudy::add_options(OptionSet set, std::string& machine_name) {
  set.add_number("--nodes", node_count, 2, nodes::node_count_max, "32", "Nodes, each with a cache of its own");
  add_cache_pages(set, cache_pages);
  add_policies(set, policy_places);
  set.add_text(
      "--machine", "MACHINE|FILE.json",
      [this, &file = machine_name](const std::string& text) {
        machine = load_machine(text).machine;
        file = text;
      },
      "The machine that the study is timed on, in virtual time: one of " + machine_preset_names() + ", or a file");
  set.set_examples(
      "Examples:\n"
      "  dmpc study cache rings-4-t1\n"
      "  dmpc study cache tetra-9 --nodes=32 --machine=ipsc2 --resolution=512x512 --format=csv -o tetra.csv");
}

std::vector<Column> CacheStudy::columns() const {
  std::vector<Column> columns = CacheCurves::columns("share of database", policies);
  if (machine) {
    columns.insert(columns.end(), timed_columns.begin(), timed_columns.end());
  }
  return columns;
}

std::vector<Plot> CacheStudy::plots() const {
  const PlotAxis rate{.label = "", .least = 0};
  std::vector<Plot> plots = {CacheCurves::plot(policies)};
  if (machine) {
    plots.push_back(curves("cache_efficiency", "Efficiency", "cache pages", CacheCurves::size_axis(), percent_axis("efficiency"),
                           {{"on " + machine->name, "efficiency"}}));
    plots.push_back(curves("cache_traffic", "Pages received by a node", "cache pages", CacheCurves::size_axis(), rate,
                           {{"on " + machine->name, "page traffic a node"}}));
  }
  return plots;
}

void CacheStudy::measure(CacheRuns& runs, Table& table) const {
  svm::Report recorded = record(runs, node_count);
  const std::uint32_t page_count = recorded.plan.request.page_count;
  const CacheCurves curves(
      references_of(recorded), recorded.pages().references,
      cache_pages.empty() ? geometric_sizes(page_count - page_count / node_count, standard_size_count) : cache_pages, policies,
      {.check = [&runs] { runs.interrupt.check(); }});
  recorded = svm::Report{{{.film = core::Film(1, 1)}}};  // frees the references' memory
  if (machine) {
    add_timed_rows(*this, curves, page_count, runs, table);
  } else {
    curves.add_rows(page_count, table);
  }
  table.add_note(curves.needs_note());
  runs.interrupt.check();
}

std::vector<std::string> CacheStudy::notes(const std::string& scene) const {
  std::vector<std::string> notes = {
      std::to_string(node_count) + " nodes. Share of database: the cache of one node over all pages.",
      "Faults and misses: pixels shared out beforehand, one in flight on a node, so that all policies see the same references "
      "and every miss is a fault. Misses are given as a share of all references, pages at home included.",
      CacheCurves::note()};
  if (machine) {
    notes.push_back(
        "Virtual time, efficiency against one node with all pages at home, and bytes of pages received a node and "
        "second: the machine " +
        machine->name + ", lru, one pixel in flight, work items of 3x3.");
  }
  const auto scene_name = core::find_scene_name(scene);
  if (scene_name && scene_name->text() == "rings-4-t1") {
    notes.emplace_back(
        "Badouel, Bouatouch and Priol (1994) report for Rings4 on 32 nodes of an iPSC/2 that efficiency stays above 50 % with "
        "larger caches only, and that the communication rate peaks at 204 pages, at about 70 % of 0.9 MB/s, and falls with "
        "less.");
  } else if (scene_name && scene_name->text() == "tetra-9") {
    notes.emplace_back(
        "Badouel, Bouatouch and Priol (1994) report for Tetra9 on 32 nodes of an iPSC/2 that a small cache is enough.");
  }
  return notes;
}

std::string CacheStudy::conclusion(const Table& table) const {
  for (const std::vector<Cell>& row : table.rows()) {
    const auto pages = number_in(table, row, "cache pages"), share = number_in(table, row, "share of database"),
               lru = number_in(table, row, "faults lru"), optimum = number_in(table, row, "faults optimum");
    const std::vector<Cell>& first = table.rows().front();
    const double most = number_in(table, first, "faults lru").value_or(0);
    if (pages && share && lru && optimum && *pages > 1 && most > 0 && *lru <= as_good * *optimum) {
      return "From caches of " + counted(static_cast<std::uint64_t>(*pages), "page") + " on (" + percent_text(*share) +
             " of the database) lru is within 10 % of the best that any policy could do; it faults " +
             percent_text(100 * *lru / most) + " as often as with " +
             counted(static_cast<std::uint64_t>(number_in(table, first, "cache pages").value_or(0)), "page") + ".";
    }
  }
  return "";
}

void add_options(OptionSet set, StudyOptions& options) {
  options.study.add_options(set, options.machine_name);
  add_options(set, options.picture);
  add_transport_options(set, options.picture);
  add_options(set, options.database);
  add_options(set, options.table, TableExtras::plots_and_report);
  set.add_quiet(options.quiet);
}

int study_command(const StudyOptions& asked, Interrupt& interrupt, std::ostream& output) {
  StudyOptions options = asked;
  const TableFiles files = files_of(options);
  options.study.load([&interrupt] { interrupt.check(); });
  const auto [subject, digest] = load(options, files, interrupt);
  Table table(title_of(options, subject), options.study.columns());
  for (std::string& note : options.study.notes(options.picture.scene)) {
    table.add_note(std::move(note));
  }
  ShownRows shown(shows_rows(options.table, options.quiet), std::cerr);
  table.set_listener([&shown](const Table& rows) { shown.show(rows); });
  CacheRuns runs{subject.database, subject.settings, interrupt, stderr_is_terminal()};
  const std::string title = "Study cache of " + options.picture.scene;
  const auto write = [&](bool is_whole, Attempts& attempts) {
    if (!is_whole) {
      table.add_note(interrupt.requested() ? "Interrupted: rows are missing." : "Ended by an error: rows are missing.");
    }
    const std::string prices = options.study.machine ? price_note(*options.study.machine, runs.database.structure()) : "";
    if (!prices.empty()) {
      table.add_note(prices + ".");
    }
    table.add_note("Film of every run, " + std::to_string(runs.count) + " in all: " + hash_text(runs.film_hash.value()) + ".");
    std::optional<Interrupt::EndAtOnce> end_at_once;
    if (is_whole) {
      interrupt.set_consequence(options.table.file ? "nothing was written" : "the table is incomplete");
      end_at_once.emplace(interrupt);
    }
    files.write(study_result({title,
                              table,
                              data_file,
                              options.study.plots(),
                              options.study.conclusion(table),
                              {{"film", hash_text(runs.film_hash.value())}},
                              digest},
                             options.table.format),
                output, std::cerr, attempts);
  };
  return run_tabled({.measure = [&] { options.study.measure(runs, table); },
                     .has_findings = [&] { return !table.rows().empty(); },
                     .write = write},
                    interrupt);
}

}  // namespace dmpc::apps
