#include "apps/lab/study/paper/report.h"

#include <algorithm>
#include <map>
#include <utility>

#include "apps/frontend/line/folded_text.h"
#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/table/plot_program.h"
#include "apps/lab/study/paper/data.h"
#include "apps/show/page/sweep_page.h"

namespace dmpc::apps {
namespace {

/// The pictures of a table, by its name: links to them in Markdown.
using Pictures = std::map<std::string, std::string>;

void write_tables(const std::vector<NamedTable>& tables, const std::filesystem::path& folder, Attempts& attempts) {
  for (const NamedTable& named : tables) {
    attempts.make([&] { write_file(folder / (named.name + ".csv"), text_of(named.table, TableFormat::csv)); });
    attempts.make([&] { write_file(folder / (named.name + ".json"), text_of(named.table, TableFormat::json)); });
  }
}

/// One sentence for all pictures if the program is missing, else one for each that failed.
void complain(std::vector<std::string>& complaints, const PlotOutcome& outcome) {
  const std::string sentence = sentence_on(outcome);
  if (std::find(complaints.begin(), complaints.end(), sentence) == complaints.end()) {
    complaints.push_back(sentence);
  }
}

Pictures draw_all(const std::vector<NamedTable>& tables, const std::filesystem::path& folder, Attempts& attempts,
                  std::vector<std::string>& complaints) {
  Pictures pictures;
  for (const PaperPlot& of_table : paper_plots()) {
    const auto named = std::find_if(tables.begin(), tables.end(), [&](const auto& at) { return at.name == of_table.table; });
    if (named == tables.end()) {
      continue;
    }
    std::optional<PlotOutcome> outcome;
    attempts.make([&] { outcome = draw(of_table.plot, named->table, folder, named->name + ".csv"); });
    if (outcome && outcome->is_drawn) {
      pictures[named->name] += "\n![" + of_table.plot.title + "](" + of_table.plot.name + ".svg)\n";
    } else if (outcome) {
      complain(complaints, *outcome);
    }
  }
  return pictures;
}

constexpr const char* title = "The tables of 1994, regenerated";

std::vector<std::string> introduction(const PaperReport& report) {
  const std::string side = std::to_string(report.resolution), fitted_side = std::to_string(paper_resolution);
  std::vector<std::string> paragraphs = {
      "D. Badouel, K. Bouatouch, T. Priol, \"Distributing Data and Control for Ray Tracing in Parallel\", on the modelled iPSC/2 "
      "(`dmpc machine ipsc2`), pictures of " +
      side + "x" + side + " pixels."};
  if (report.resolution != paper_resolution) {
    paragraphs.push_back("The machine's prices are fitted to pictures of " + fitted_side + "x" + fitted_side +
                         " pixels: those of another size show how the study works, and no more.");
  }
  if (!report.is_complete) {
    paragraphs.push_back("Unfinished: rows are missing.");
  }
  return paragraphs;
}

std::string head_of(const PaperReport& report) {
  std::string text = std::string("# ") + title + "\n";
  for (const std::string& paragraph : introduction(report)) {
    text += "\n" + folded(paragraph, markdown_width_max, "") + "\n";
  }
  return text;
}

std::vector<Plot> plots_of(const std::string& table) {
  std::vector<Plot> plots;
  for (const PaperPlot& of_table : paper_plots()) {
    if (of_table.table == table) {
      plots.push_back(of_table.plot);
    }
  }
  return plots;
}

std::string text_with(const PaperReport& report, const Pictures& pictures, const std::vector<std::string>& complaints) {
  std::string text = head_of(report);
  for (const std::string& complaint : complaints) {
    text += "\n" + folded("Note: " + complaint + ".", markdown_width_max, "") + "\n";
  }
  for (const NamedTable& named : report.tables) {
    const auto links = pictures.find(named.name);
    text += "\n" + text_of(named.table, TableFormat::markdown) + (links == pictures.end() ? "" : links->second);
  }
  return text;
}

}  // namespace

std::string text_of(const PaperReport& report) { return text_with(report, {}, {}); }

std::vector<OutputName> report_files(const PaperReport& report, const std::filesystem::path& folder, const std::string& option) {
  std::vector<OutputName> files;
  const auto add = [&](const std::string& name) { files.push_back({{option, folder / name}}); };
  for (const NamedTable& table : report.tables) {
    add(table.name + ".csv");
    add(table.name + ".json");
    for (const Plot& plot : plots_of(table.name)) {
      add(plot.name + ".gnuplot");
      add(plot.name + ".svg");
    }
  }
  add("report.md");
  return files;
}

std::vector<std::string> write_report(const PaperReport& report, const std::filesystem::path& folder, Attempts& attempts) {
  std::vector<std::string> complaints;
  write_tables(report.tables, folder, attempts);
  const Pictures pictures = draw_all(report.tables, folder, attempts, complaints);
  attempts.make([&] { write_file(folder / "report.md", text_with(report, pictures, complaints)); });
  return complaints;
}

std::string page_of(const PaperReport& report, std::ostream& complaints) {
  std::vector<html::SweepPart> parts;
  for (const NamedTable& named : report.tables) {
    parts.push_back({named.table.title(), named.table, plots_of(named.name), paper_conclusion(named.name, named.table)});
  }
  return html::sweep_page({title, introduction(report), std::move(parts)}, this_origin(), complaints);
}

}  // namespace dmpc::apps
