#include "apps/paper_memories.h"

#include <optional>
#include <string>
#include <vector>

#include "apps/figures.h"
#include "apps/paper_tables.h"

namespace dmpc::apps {
namespace {

/// Of one cell by one kind of run; nothing if a run is missing.
std::optional<double> efficiency_by(const Catalogue::ByNodeCount& runs, const PaperResults& results, std::size_t base,
                                    std::size_t column) {
  const auto &first = results[runs[base]], &result = results[runs[column]];
  if (!first || !result) {
    return std::nullopt;
  }
  return efficiency(first->seconds(), paper_node_counts[base], result->seconds(), paper_node_counts[column]);
}

/// The three kinds of a scene's runs.
std::array<const Catalogue::ByNodeCount*, 3> kinds_of(const Catalogue& catalogue, std::size_t row) {
  return {&catalogue.timed[missing_rows[row]], &catalogue.scattered[row], &catalogue.whole_memory[row]};
}

void add_cell(Table& table, std::array<Differences, 3>& differences, const Catalogue& catalogue, const PaperResults& results,
              std::size_t row, std::size_t column) {
  const PaperScene& paper = paper_scenes[missing_rows[row]];
  const std::size_t base = paper.base();
  const double printed =
      efficiency(paper.seconds[base], paper_node_counts[base], paper.seconds[column], paper_node_counts[column]);
  std::vector<Cell> cells = {paper.title, std::uint64_t{paper_node_counts[column]}, printed};
  std::array<double, 3> found{};
  for (std::size_t kind = 0; kind < found.size(); ++kind) {
    const auto by_kind = efficiency_by(*kinds_of(catalogue, row)[kind], results, base, column);
    if (!by_kind) {
      return;
    }
    found[kind] = *by_kind;
    cells.emplace_back(*by_kind);
  }
  for (std::size_t kind = 0; kind < found.size(); ++kind) {
    differences[kind].add(found[kind] - printed);
  }
  table.add_row(std::move(cells));
}

}  // namespace

Table memories(const Catalogue& catalogue, const PaperResults& results) {
  Table table("Table 3 by other memories and another order of records", {{"scene"},
                                                                         {"nodes"},
                                                                         {"printed", "%", 1},
                                                                         {"the article's share", "%", 1},
                                                                         {"records scattered", "%", 1},
                                                                         {"the article's 4 MB", "%", 1}});
  std::array<Differences, 3> differences;
  std::size_t expected = 0;
  for (std::size_t row = 0; row < missing_rows.size(); ++row) {
    for (std::size_t column = paper_scenes[missing_rows[row]].base() + 1; column < paper_node_counts.size(); ++column) {
      add_cell(table, differences, catalogue, results, row, column);
      ++expected;
    }
  }
  table.add_note(
      "The article's share: caches hold as much of the database as the article's could, 3.2 MB of each node being shared "
      "memory. Its 4 MB hold more of our databases, which are smaller (Table 2), so pages are missed less often.");
  table.add_note("Records scattered: caches of the article's share, and no two neighbours in space on one page.");
  table.add_note("Mean and worst difference from what is printed, in points: " + fixed(differences[0].mean(), 2) + " and " +
                 fixed(differences[0].worst, 2) + "; scattered " + fixed(differences[1].mean(), 2) + " and " +
                 fixed(differences[1].worst, 2) + "; 4 MB " + fixed(differences[2].mean(), 2) + " and " +
                 fixed(differences[2].worst, 2) + ". The other scenes fit wholly into every memory.");
  note_missing_rows(table, expected);
  return table;
}

}  // namespace dmpc::apps
