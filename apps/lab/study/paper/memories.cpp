// The effect of memory sizes and of the order of records on Table 3.
#include <array>
#include <string>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/paper/tables.h"

namespace dmpc::apps {
namespace {

struct Kind {
  const char* name;
  const std::array<Catalogue::ByNodeCount, missing_rows.size()>* runs;  ///< nothing: those of Table 3
  Differences differences = {};

  const Catalogue::ByNodeCount& of(const Catalogue& catalogue, std::size_t row) const {
    return runs == nullptr ? catalogue.timed[missing_rows[row]] : (*runs)[row];
  }
};
using Kinds = std::array<Kind, 4>;

Kinds kinds_of(const Catalogue& catalogue) {
  return {{{"the article's share", nullptr},
           {"records scattered", &catalogue.scattered},
           {"the figures' caches", &catalogue.figures_memory},
           {"the article's 4 MB", &catalogue.whole_memory}}};
}

Table table_of(const Kinds& kinds) {
  std::vector<Column> columns = {{"scene"}, {"nodes"}, {"printed", "%", 1}};
  for (const Kind& kind : kinds) {
    columns.push_back({kind.name, "%", 1});
  }
  return {"Table 3 by other memories and another order of records", std::move(columns)};
}

void add_cell(Table& table, Kinds& kinds, const Catalogue& catalogue, const PaperResults& results, std::size_t row,
              std::size_t column) {
  const PaperScene& paper = paper_scenes[missing_rows[row]];
  const double printed = printed_efficiency(paper, column);
  std::vector<Cell> cells = {paper.title, std::uint64_t{paper_node_counts[column]}, printed};
  std::array<double, std::tuple_size_v<Kinds>> found{};
  for (std::size_t kind = 0; kind < found.size(); ++kind) {
    const auto by_kind = found_efficiency(kinds[kind].of(catalogue, row), results, paper.base(), column);
    if (!by_kind) {
      return;
    }
    found[kind] = *by_kind;
    cells.emplace_back(*by_kind);
  }
  for (std::size_t kind = 0; kind < found.size(); ++kind) {
    kinds[kind].differences.add(found[kind] - printed);
  }
  table.add_row(std::move(cells));
}

/// "Rings4 3242 pages and 4632/32 KB, 3387 KB together".
std::string largest_cache(const CacheScene& scene) {
  return std::string(scene.row().title) + " " + std::to_string(scene.pages.back()) + " pages of 1 KB and " +
         std::to_string(scene.row().database_kilobytes) + "/" + std::to_string(cache_node_count) + " KB of its own, " +
         fixed(scene.shared_kilobytes(), 0) + " KB together";
}

void add_notes(Table& table, const Kinds& kinds) {
  table.add_note(
      "The article's share: caches hold as much of the database as the article's could, if 3.2 MB of each node are shared "
      "memory, as its text says. Table 3 above is of these.");
  table.add_note("Records scattered: caches of the article's share, and neighbours in space on one page only by chance.");
  table.add_note("The figures' caches: the shared memory that the largest caches of Figures 8 to 10 on " +
                 std::to_string(cache_node_count) + " nodes make: " + largest_cache(cache_scenes[0]) + "; " +
                 largest_cache(cache_scenes[1]) + ". The article contradicts itself here: its text says about " +
                 fixed(shared_kilobytes, 0) + " KB.");
  table.add_note(
      "The article's 4 MB: its bytes in place of its share. They hold more of our databases, which are smaller (Table 2), so "
      "pages are missed less often.");
  std::string text = "Mean and worst difference from what is printed, in points:";
  for (const Kind& kind : kinds) {
    text += std::string(text.ends_with(':') ? " " : "; ") + kind.name + " " + fixed(kind.differences.mean(), 2) + " and " +
            fixed(kind.differences.worst, 2);
  }
  table.add_note(text + ".");
  table.add_note(
      "Of the other scenes Teapot and Mountain fit wholly into every memory. Tetra10 fits into none, but has one printed cell "
      "and so no efficiency.");
}

}  // namespace

Table memories(const Catalogue& catalogue, const PaperResults& results) {
  Kinds kinds = kinds_of(catalogue);
  Table table = table_of(kinds);
  std::size_t expected = 0;
  for (std::size_t row = 0; row < missing_rows.size(); ++row) {
    for (std::size_t column = paper_scenes[missing_rows[row]].base() + 1; column < paper_node_counts.size(); ++column) {
      add_cell(table, kinds, catalogue, results, row, column);
      ++expected;
    }
  }
  add_notes(table, kinds);
  note_missing_rows(table, expected);
  return table;
}

}  // namespace dmpc::apps
