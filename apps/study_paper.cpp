#include "apps/study_paper.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "apps/figures.h"
#include "apps/machines.h"
#include "apps/output_file.h"
#include "apps/paper_data.h"
#include "apps/paper_runs.h"
#include "apps/study_table.h"
#include "core/expect.h"

namespace dmpc::apps {
namespace {

using Results = std::vector<std::optional<PaperResult>>;

/// The iPSC/2's, in the article.
constexpr std::size_t node_memory_bytes = std::size_t{4} << 20U;
/// Of the cache experiments, in the article.
constexpr std::uint32_t cache_node_count = 32;
/// Cache sizes in pages for Rings4, where the network saturates at 204, and for Tetra9.
constexpr std::array<std::uint32_t, 8> rings_caches = {16, 51, 102, 204, 408, 811, 1621, 2900};
constexpr std::array<std::uint32_t, 8> tetra_caches = {4, 16, 51, 204, 408, 724, 1448, 2895};

const nodes::Machine& preset(const char* name) {
  const MachineDescription* description = find_machine_preset(name);
  core::expect(description != nullptr, "the machine of the study has a preset");
  return description->machine;
}

/// All runs of the study, and which is which by their numbers.
struct Catalogue {
  std::vector<PaperRun> runs;
  std::array<std::size_t, paper_scenes.size()> counted{};                                              ///< Table 2
  std::array<std::array<std::size_t, paper_node_counts.size()>, paper_scenes.size()> timed{};          ///< Table 3
  std::array<std::array<std::size_t, paper_node_counts.size()>, 2> rings_by_rays{}, rings_by_pages{};  ///< Rings3, Rings4
  std::array<std::size_t, 2> cache_base{};
  std::array<std::array<std::size_t, rings_caches.size()>, 2> cached{};  ///< Rings4, Tetra9
  std::size_t faster_machine = 0;                                        ///< Rings4 on 32 nodes of an iPSC/860

  std::size_t add(PaperRun run) {
    runs.push_back(std::move(run));
    return runs.size() - 1;
  }
};

constexpr std::array<const char*, 2> rings = {"rings-3-t1", "rings-4-t1"};
constexpr std::array<const char*, 2> cache_scenes = {"rings-4-t1", "tetra-9"};

void add_tables(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    PaperRun run = like;
    run.scene = paper_scenes[scene].scene;
    for (std::size_t column = paper_scenes[scene].base(); column < paper_node_counts.size(); ++column) {
      run.node_count = paper_node_counts[column];
      catalogue.timed[scene][column] = catalogue.add(run);
    }
    run.node_count = 1;
    run.node_memory_bytes.reset();
    run.count_pages = true;
    catalogue.counted[scene] = catalogue.add(run);
  }
}

void add_rings(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    PaperRun run = like;
    run.scene = rings[scene];
    for (std::size_t column = 0; column < paper_node_counts.size(); ++column) {
      run.node_count = paper_node_counts[column];
      run.rays_travel = true;
      catalogue.rings_by_rays[scene][column] = catalogue.add(run);
      run.rays_travel = false;
      catalogue.rings_by_pages[scene][column] = catalogue.add(run);
    }
  }
}

/// At half the resolution a side: small caches miss so often that a picture of 512x512 takes minutes.
void add_caches(Catalogue& catalogue, const PaperRun& like) {
  for (std::size_t scene = 0; scene < cache_scenes.size(); ++scene) {
    PaperRun run = like;
    run.scene = cache_scenes[scene];
    run.resolution = std::max(1U, like.resolution / 2);
    run.node_memory_bytes.reset();
    catalogue.cache_base[scene] = catalogue.add(run);
    run.node_count = cache_node_count;
    for (std::size_t size = 0; size < rings_caches.size(); ++size) {
      run.cache_pages = scene == 0 ? rings_caches[size] : tetra_caches[size];
      catalogue.cached[scene][size] = catalogue.add(run);
    }
  }
}

Catalogue catalogue_of(const PaperStudyOptions& options) {
  Catalogue catalogue;
  const PaperRun like{.machine = preset("ipsc2"), .node_memory_bytes = node_memory_bytes, .resolution = options.resolution};
  add_tables(catalogue, like);
  add_rings(catalogue, like);
  add_caches(catalogue, like);
  PaperRun faster = like;
  faster.scene = "rings-4-t1";
  faster.node_count = 32;
  faster.machine = preset("ipsc860");
  catalogue.faster_machine = catalogue.add(faster);
  return catalogue;
}

// ---- Tables ----------------------------------------------------------------------------------------------------------------

/// In percent: how well `node_count` nodes are used, against `base_count`.
double efficiency(double base_seconds, std::uint32_t base_count, double seconds, std::uint32_t node_count) {
  return 100 * base_seconds * base_count / (seconds * node_count);
}

Table table_2(const Catalogue& catalogue, const Results& results, const std::vector<PaperSubject>& subjects) {
  Table table("Table 2: scenes, rays, database", {{"scene"},
                                                  {"ours"},
                                                  {"polygons printed"},
                                                  {"polygons"},
                                                  {"rays printed"},
                                                  {"rays"},
                                                  {"database printed", "KB"},
                                                  {"database", "KB"},
                                                  {"pages a pixel printed", "", 2},
                                                  {"pages a pixel", "", 2}});
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    const PaperScene& paper = paper_scenes[scene];
    const auto& result = results[catalogue.counted[scene]];
    if (!result) {
      continue;
    }
    const auto subject = std::find_if(subjects.begin(), subjects.end(), [&](const auto& at) { return at.scene == paper.scene; });
    const core::Database& database = subject->subject.database;
    table.add_row({paper.title, paper.scene, paper.polygons, std::uint64_t{database.header().primitive_count}, paper.rays,
                   result->rays, paper.database_kilobytes, std::uint64_t{database.bytes().size() / 1024}, paper.pages_a_pixel,
                   result->pages_a_pixel});
    table.add_note(std::string(paper.title) + ": " + paper.remark + ".");
  }
  return table;
}

/// What Table 3 says of one scene on so many nodes, printed and found; nothing if it is not printed or not known.
struct CellOfTable3 {
  std::uint32_t nodes = 0;
  double printed_seconds = 0, seconds = 0, printed_efficiency = 0, efficiency = 0;
  bool is_calibrated = false;  ///< the machine's prices were fitted to it
  bool is_base = false;
  TimeParts parts;
};

std::optional<CellOfTable3> cell_of(const Catalogue& catalogue, const Results& results, std::size_t scene, std::size_t column) {
  const PaperScene& paper = paper_scenes[scene];
  const std::size_t base = paper.base();
  if (column < base || !results[catalogue.timed[scene][base]] || !results[catalogue.timed[scene][column]]) {
    return std::nullopt;
  }
  const PaperResult& first = *results[catalogue.timed[scene][base]];
  const PaperResult& result = *results[catalogue.timed[scene][column]];
  const std::uint32_t nodes = paper_node_counts[column];
  return CellOfTable3{
      .nodes = nodes,
      .printed_seconds = static_cast<double>(paper.seconds[column]),
      .seconds = result.seconds(),
      .printed_efficiency = efficiency(paper.seconds[base], paper_node_counts[base], paper.seconds[column], nodes),
      .efficiency = efficiency(first.seconds(), paper_node_counts[base], result.seconds(), nodes),
      .is_calibrated = std::string(paper.scene) == "mount-6-t6" && column < 2,
      .is_base = column == base,
      .parts = result.parts};
}

template <class Visit>
void for_each_cell(const Catalogue& catalogue, const Results& results, Visit visit) {
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    for (std::size_t column = 0; column < paper_node_counts.size(); ++column) {
      if (const auto cell = cell_of(catalogue, results, scene, column)) {
        visit(paper_scenes[scene], *cell);
      }
    }
  }
}

/// Of the efficiencies that are predictions: neither calibrated nor 100 % by definition.
struct Errors {
  double sum = 0, worst = 0;
  std::uint32_t count = 0;

  void add(double error) {
    sum += std::fabs(error);
    worst = std::max(worst, std::fabs(error));
    ++count;
  }
  double mean() const { return count == 0 ? 0 : sum / count; }
};

Errors errors_of(const Catalogue& catalogue, const Results& results) {
  Errors errors;
  for_each_cell(catalogue, results, [&](const PaperScene&, const CellOfTable3& cell) {
    if (!cell.is_base && !cell.is_calibrated) {
      errors.add(cell.efficiency - cell.printed_efficiency);
    }
  });
  return errors;
}

Table table_3(const Catalogue& catalogue, const Results& results) {
  Table table("Table 3: seconds on the iPSC/2, and efficiencies", {{"scene"},
                                                                   {"nodes"},
                                                                   {"printed", "s", 0},
                                                                   {"found", "s", 1},
                                                                   {"found over printed", "", 3},
                                                                   {"efficiency printed", "%", 1},
                                                                   {"efficiency", "%", 1},
                                                                   {"difference", "points", 1},
                                                                   {"use"}});
  for_each_cell(catalogue, results, [&](const PaperScene& paper, const CellOfTable3& cell) {
    table.add_row({paper.title, std::uint64_t{cell.nodes}, cell.printed_seconds, cell.seconds,
                   cell.seconds / cell.printed_seconds, cell.printed_efficiency, cell.efficiency,
                   cell.efficiency - cell.printed_efficiency,
                   cell.is_calibrated ? "calibrated"
                   : cell.is_base     ? "base"
                                      : "predicted"});
  });
  const Errors errors = errors_of(catalogue, results);
  table.add_note(
      "Calibrated: two figures of the machine were fitted to these two cells, the price of an operation and that of "
      "looking up a cached page. All others are predictions.");
  table.add_note("Predicted efficiencies differ by " + fixed(errors.mean(), 2) + " points on average and " +
                 fixed(errors.worst, 2) + " at worst, " + std::to_string(errors.count) + " cells.");
  return table;
}

Table losses(const Catalogue& catalogue, const Results& results) {
  std::vector<Column> columns = {{"scene"}, {"nodes"}};
  for (const char* part : time_part_names) {
    columns.push_back({part, "%", 2});
  }
  Table table("Where the nodes' time goes", columns);
  for_each_cell(catalogue, results, [&](const PaperScene& paper, const CellOfTable3& cell) {
    std::vector<Cell> row = {paper.title, std::uint64_t{cell.nodes}};
    for (const double percent : cell.parts.percent()) {
      row.emplace_back(percent);
    }
    table.add_row(std::move(row));
  });
  table.add_note("The parts of a row add up to 100 %. Dearer look-ups of cached pages are part of computing.");
  return table;
}

/// Figures 5 and 7: rays that travel beside pages that travel.
Table algorithms(const Catalogue& catalogue, const Results& results) {
  Table table("Figures 5 and 7: efficiency of both algorithms", {{"scene"},
                                                                 {"nodes"},
                                                                 {"rays travel", "s", 1},
                                                                 {"pages travel", "s", 1},
                                                                 {"rays travel efficiency", "%", 1},
                                                                 {"pages travel efficiency", "%", 1}});
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const auto& first = results[catalogue.rings_by_pages[scene][0]];
    for (std::size_t column = 0; column < paper_node_counts.size(); ++column) {
      const auto& rays = results[catalogue.rings_by_rays[scene][column]];
      const auto& pages = results[catalogue.rings_by_pages[scene][column]];
      if (first && rays && pages) {
        const std::uint32_t nodes = paper_node_counts[column];
        table.add_row({rings[scene], std::uint64_t{nodes}, rays->seconds(), pages->seconds(),
                       efficiency(first->seconds(), 1, rays->seconds(), nodes),
                       efficiency(first->seconds(), 1, pages->seconds(), nodes)});
      }
    }
  }
  table.add_note("Both against one node, on which nothing travels. The curves of the article are not printed as numbers.");
  return table;
}

/// Figures 8 to 10: what the size of the cache is worth.
Table caches(const Catalogue& catalogue, const Results& results, const std::vector<PaperSubject>& subjects) {
  Table table("Figures 8 to 10: caches on " + std::to_string(cache_node_count) + " nodes", {{"scene"},
                                                                                            {"cache", "pages"},
                                                                                            {"of the database", "%", 1},
                                                                                            {"efficiency", "%", 1},
                                                                                            {"faults"},
                                                                                            {"page traffic a node", "bytes/s", 0},
                                                                                            {"page wait", "%", 1},
                                                                                            {"stolen", "%", 1}});
  for (std::size_t scene = 0; scene < cache_scenes.size(); ++scene) {
    const auto& base = results[catalogue.cache_base[scene]];
    const auto subject =
        std::find_if(subjects.begin(), subjects.end(), [&](const PaperSubject& at) { return at.scene == cache_scenes[scene]; });
    for (std::size_t size = 0; size < rings_caches.size(); ++size) {
      const std::size_t number = catalogue.cached[scene][size];
      if (base && results[number]) {
        const PaperResult& result = *results[number];
        const std::uint32_t pages = *catalogue.runs[number].cache_pages;
        const auto percent = result.parts.percent();
        table.add_row({cache_scenes[scene], std::uint64_t{pages},
                       100.0 * pages / static_cast<double>(subject->subject.database.page_count()),
                       efficiency(base->seconds(), 1, result.seconds(), cache_node_count), result.faults,
                       result.page_rate(cache_node_count), percent[static_cast<std::size_t>(TimePart::data_wait)],
                       percent[static_cast<std::size_t>(TimePart::stolen)]});
      }
    }
  }
  table.add_note("Pictures of half the resolution a side: small caches miss too often for the whole one.");
  return table;
}

// ---- Claims ----------------------------------------------------------------------------------------------------------------

void add_claim(Table& table, const std::string& claim, bool is_held, const std::string& found) {
  table.add_row({claim, is_held ? "held" : "not held", found});
}

void claim_efficiency(Table& table, const Catalogue& catalogue, const Results& results) {
  double least = 100;
  for_each_cell(catalogue, results,
                [&](const PaperScene&, const CellOfTable3& cell) { least = std::min(least, cell.efficiency); });
  add_claim(table, "With up to 64 nodes the efficiency is almost always above 78 %", least > 78,
            "the least is " + fixed(least, 1) + " %");
}

void claim_rays_fall(Table& table, const Catalogue& catalogue, const Results& results) {
  for (std::size_t scene = 0; scene < rings.size(); ++scene) {
    const auto& first = results[catalogue.rings_by_pages[scene][0]];
    const auto& few = results[catalogue.rings_by_rays[scene][2]];
    const auto& many = results[catalogue.rings_by_rays[scene].back()];
    const auto& pages = results[catalogue.rings_by_pages[scene].back()];
    if (first && few && many && pages) {
      const double at_4 = efficiency(first->seconds(), 1, few->seconds(), 4);
      const double at_64 = efficiency(first->seconds(), 1, many->seconds(), 64);
      const double by_pages = efficiency(first->seconds(), 1, pages->seconds(), 64);
      add_claim(
          table,
          std::string("The efficiency of travelling rays falls with the nodes, and is below travelling pages', ") + rings[scene],
          at_64 < at_4 && at_64 < by_pages,
          fixed(at_4, 1) + " % on 4 nodes, " + fixed(at_64, 1) + " % on 64; pages " + fixed(by_pages, 1) + " %");
    }
  }
}

/// Of one scene's caches: size, efficiency and traffic.
struct CachePoint {
  std::uint32_t pages = 0;
  double efficiency = 0, page_rate = 0;
};
std::vector<CachePoint> points_of(const Catalogue& catalogue, const Results& results, std::size_t scene) {
  std::vector<CachePoint> points;
  const auto& base = results[catalogue.cache_base[scene]];
  for (const std::size_t number : catalogue.cached[scene]) {
    if (base && results[number]) {
      points.push_back({*catalogue.runs[number].cache_pages,
                        efficiency(base->seconds(), 1, results[number]->seconds(), cache_node_count),
                        results[number]->page_rate(cache_node_count)});
    }
  }
  return points;
}

std::uint32_t pages_for_half(const std::vector<CachePoint>& points) {
  const auto found = std::find_if(points.begin(), points.end(), [](const CachePoint& point) { return point.efficiency > 50; });
  return found == points.end() ? 0 : found->pages;
}

void claim_caches(Table& table, const Catalogue& catalogue, const Results& results) {
  const std::vector<CachePoint> of_rings = points_of(catalogue, results, 0), of_tetra = points_of(catalogue, results, 1);
  if (of_rings.empty() || of_tetra.empty()) {
    return;
  }
  const std::uint32_t for_rings = pages_for_half(of_rings), for_tetra = pages_for_half(of_tetra);
  add_claim(table, "Rings4 needs larger caches than Tetra9 to stay above 50 %", for_rings > for_tetra,
            "Rings4 from " + std::to_string(for_rings) + " pages on, Tetra9 from " + std::to_string(for_tetra));
  const auto peak = std::max_element(of_rings.begin(), of_rings.end(),
                                     [](const CachePoint& a, const CachePoint& b) { return a.page_rate < b.page_rate; });
  add_claim(table, "The communication rate of Rings4 peaks (theirs at 204 pages) and falls for smaller caches",
            peak != of_rings.begin() && peak->pages < of_rings.back().pages,
            "the peak is at " + std::to_string(peak->pages) + " pages");
  const double share = peak->page_rate / 0.9e6;
  add_claim(table, "At the peak the network carries about 70 % of the 0.9 MB/s that messages of 1 KB allow",
            share > 0.6 && share < 0.8, fixed(100 * share, 0) + " % for each node");
}

void claim_faster_machine(Table& table, const Catalogue& catalogue, const Results& results) {
  const auto& slow = results[catalogue.timed[2][5]];
  const auto& fast = results[catalogue.faster_machine];
  if (slow && fast) {
    const double ratio = slow->seconds() / fast->seconds();
    add_claim(table, "The iPSC/860 is about 7 times faster (Rings4, 32 nodes)", ratio > 6 && ratio < 8,
              fixed(ratio, 2) + " times; its processor is modelled as 7 times faster, so this tests the network alone");
  }
}

Table claims(const Catalogue& catalogue, const Results& results) {
  Table table("What the text claims", {{"claim"}, {"verdict"}, {"found"}});
  claim_efficiency(table, catalogue, results);
  claim_rays_fall(table, catalogue, results);
  claim_caches(table, catalogue, results);
  claim_faster_machine(table, catalogue, results);
  return table;
}

// ---- The report ------------------------------------------------------------------------------------------------------------

struct NamedTable {
  const char* name;
  Table table;
};

std::string report_text(const std::vector<NamedTable>& tables, const PaperStudyOptions& options, bool is_complete) {
  std::string text =
      "# The tables of 1994, regenerated\n\nD. Badouel, K. Bouatouch, T. Priol, \"Distributing Data and Control for "
      "Ray Tracing in Parallel\", on the modelled iPSC/2 (`dmpc machine ipsc2`), pictures of " +
      std::to_string(options.resolution) + "x" + std::to_string(options.resolution) + " pixels.\n";
  text += is_complete ? "" : "\nInterrupted: rows are missing.\n";
  for (const NamedTable& named : tables) {
    text += "\n" + text_of(named.table, TableFormat::markdown);
  }
  return text;
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

void write_folder(const std::filesystem::path& folder, const std::vector<NamedTable>& tables, const std::string& report) {
  for (const NamedTable& named : tables) {
    write_file(folder / (std::string(named.name) + ".csv"), text_of(named.table, TableFormat::csv));
    write_file(folder / (std::string(named.name) + ".json"), text_of(named.table, TableFormat::json));
  }
  write_file(folder / "report.md", report);
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error || !std::filesystem::is_directory(folder)) {
    throw core::InputError("-o " + folder.string() + ": expected a folder, or a name for one that can be made");
  }
  check_output_path(folder / "report.md", "-o");
}

}  // namespace

void add_options(OptionSet options, PaperStudyOptions& paper) {
  options.add_number("--resolution", paper.resolution, 8, 4096, "512, the article's", "Pixels a side of every picture");
  options.add_path("-o,--output", "FOLDER", paper.output, "Where report.md goes, with each table as CSV and JSON");
  options.set_examples(
      "Examples:\n"
      "  dmpc study paper -o paper              the article's pictures: some minutes\n"
      "  dmpc study paper --resolution=64       a quick look");
}

int study_paper_command(const PaperStudyOptions& options, Interrupt& interrupt, std::ostream& output) {
  if (options.output) {
    make_folder(*options.output);
  }
  const Catalogue catalogue = catalogue_of(options);
  const std::vector<PaperSubject> subjects = [&] {
    const Interrupt::EndAtOnce end_at_once(interrupt);
    return paper_subjects(catalogue.runs);
  }();
  const Results results = carry_out(catalogue.runs, subjects, interrupt);
  const std::vector<NamedTable> tables = {{"table_2", table_2(catalogue, results, subjects)},
                                          {"table_3", table_3(catalogue, results)},
                                          {"losses", losses(catalogue, results)},
                                          {"algorithms", algorithms(catalogue, results)},
                                          {"caches", caches(catalogue, results, subjects)},
                                          {"claims", claims(catalogue, results)}};
  const std::string report = report_text(tables, options, !interrupt.requested());
  output << report;
  if (options.output) {
    write_folder(*options.output, tables, report);
  }
  finish_output(output, "the report");
  interrupt.set_consequence("the report has the rows finished before");
  interrupt.check();
  return 0;
}

}  // namespace dmpc::apps
