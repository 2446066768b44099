// What opens the report: Table 3 at a glance, how well it is predicted, and which claims are held.
#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/lab/study/paper/claim_rows.h"
#include "apps/lab/study/paper/tables.h"

namespace dmpc::apps {
namespace {

std::string prediction_text(const std::vector<TimedCell>& cells) {
  const Errors errors = errors_of(cells);
  return "Table 3 has " + std::to_string(printed_cell_count()) + " printed cells. Three prices are fitted to " +
         std::to_string(fitted_places.size()) +
         " of them, Mountain on 1 and 64 nodes and Rings4 on 2 and 64; the others are predicted. Predicted times of a ray lie "
         "off "
         "by " +
         text_of(errors.times) + "; without Teapot, another scene than theirs, by " + text_of(errors.times_without_teapot) +
         ". Predicted efficiencies lie off by " + fixed(errors.efficiencies.mean(), 1) + " points in the mean and " +
         fixed(errors.efficiencies.worst, 1) + " at worst.";
}

/// Of the pairs of scenes to which prices can be fitted.
std::string choice_text(const Table& pairs) {
  std::vector<double> errors;
  std::string best;
  for (const auto& row : pairs.rows()) {
    const double error = number_in(pairs, row, "mean error").value_or(0);
    best = errors.empty() || error < *std::min_element(errors.begin(), errors.end()) ? texts_of(pairs, row)[0] : best;
    errors.push_back(error);
  }
  if (errors.empty()) {
    return "";
  }
  std::sort(errors.begin(), errors.end());
  const double median = (errors[(errors.size() - 1) / 2] + errors[errors.size() / 2]) / 2;
  return "First reservation: the structure and the two scenes were chosen by someone who had seen all 24 cells. Of the ten pairs "
         "of scenes the best, " +
         best + ", is off by " + fixed(errors.front(), 1) +
         " % in the mean over all cells, fitted ones among them, the median pair by " + fixed(median, 1) +
         " %, and the worst by " + fixed(errors.back(), 1) + " %.";
}

std::string grid_text(const std::vector<TimedCell>& cells) {
  double least = 1, most = 0;
  for (const TimedCell& cell : cells) {
    if (cell.place.scene != calibrated_places[0].scene) {
      least = std::min(least, cell.seconds / cell.printed_seconds);
      most = std::max(most, cell.seconds / cell.printed_seconds);
    }
  }
  return most == 0
             ? ""
             : "Second reservation: on dmpc's own grid, with the prices of ipsc2, the seconds of other scenes than Mountain "
               "are " +
                   fixed(least, 2) + " to " + fixed(most, 2) +
                   " of the printed ones: only the article's structure gives its seconds.";
}

std::vector<std::string> claim_texts(const Table& claims) {
  std::map<std::string, std::size_t> counts;
  std::vector<std::string> texts(1);
  for (const auto& row : claims.rows()) {
    const std::vector<std::string> words = texts_of(claims, row);
    ++counts[words[1]];
    if (words[1] == not_held || words[1] == tie) {
      texts.push_back((words[1] == tie ? "A tie: " : "Not held: ") + words[0] + ". Found: " + words[2] +
                      (words[3].empty() ? "" : " (" + words[3] + ")") + ".");
    }
  }
  for (const char* const verdict : {held, not_held, tie, not_judged}) {
    if (counts[verdict] > 0) {
      texts[0] += (texts[0].empty() ? "Claims of the text: " : ", ") + std::to_string(counts[verdict]) + " " + verdict;
    }
  }
  texts[0] += texts[0].empty() ? "" : ".";
  return texts;
}

}  // namespace

Table summary_table(const Catalogue& catalogue, const PaperResults& results) {
  std::vector<Column> columns = {{"scene"}};
  for (const std::uint32_t nodes : paper_node_counts) {
    columns.push_back({std::to_string(nodes) + (nodes == 1 ? " node" : " nodes")});
  }
  Table table("Table 3 at a glance: seconds printed / found", std::move(columns));
  const std::vector<TimedCell> cells = cells_of(catalogue.article, results);
  for (std::size_t scene = 0; scene < paper_scenes.size(); ++scene) {
    std::vector<Cell> row(1 + paper_node_counts.size());
    row[0] = paper_scenes[scene].title;
    for (const TimedCell& cell : cells) {
      if (cell.place.scene == scene) {
        row[1 + cell.place.column] =
            fixed(cell.printed_seconds, 0) + " / " + fixed(cell.seconds, 0) + (cell.is_fitted ? " *" : "");
      }
    }
    if (std::any_of(row.begin() + 1, row.end(), [](const Cell& cell) { return cell != Cell(); })) {
      table.add_row(std::move(row));
    }
  }
  table.add_note("*: fitted. Where a cell is empty the article prints nothing.");
  note_missing_rows(table, paper_scenes.size());
  return table;
}

std::vector<std::string> summary_texts(const Catalogue& catalogue, const PaperResults& results) {
  const std::vector<TimedCell> cells = cells_of(catalogue.article, results);
  std::vector<std::string> texts;
  if (catalogue.resolution == paper_resolution && !cells.empty()) {
    texts = {prediction_text(cells), choice_text(voxel_pairs(catalogue, results)), grid_text(cells_of(catalogue.grid, results))};
  }
  for (std::string& text : claim_texts(claims(catalogue, results))) {
    texts.push_back(std::move(text));
  }
  texts.erase(std::remove(texts.begin(), texts.end(), ""), texts.end());
  return texts;
}

}  // namespace dmpc::apps
