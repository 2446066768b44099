#include "apps/paper_report.h"

#include <algorithm>
#include <map>

#include "apps/output_file.h"
#include "apps/paper_plots.h"
#include "apps/plot_program.h"

namespace dmpc::apps {
namespace {

/// Of a table, by its name: links to them in Markdown.
using Pictures = std::map<std::string, std::string>;

void write_file(const std::filesystem::path& path, const std::string& text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

void write_tables(const std::vector<NamedTable>& tables, const std::filesystem::path& folder) {
  for (const NamedTable& named : tables) {
    write_file(folder / (named.name + ".csv"), text_of(named.table, TableFormat::csv));
    write_file(folder / (named.name + ".json"), text_of(named.table, TableFormat::json));
  }
}

/// One sentence for all pictures if the program is missing, else one for each that failed.
void complain(std::vector<std::string>& complaints, const PlotOutcome& outcome) {
  const std::string sentence = sentence_on(outcome);
  if (std::find(complaints.begin(), complaints.end(), sentence) == complaints.end()) {
    complaints.push_back(sentence);
  }
}

Pictures draw_all(const std::vector<NamedTable>& tables, const std::filesystem::path& folder, PaperReport& report) {
  Pictures pictures;
  for (const PaperPlot& of_table : paper_plots()) {
    const auto named = std::find_if(tables.begin(), tables.end(), [&](const auto& at) { return at.name == of_table.table; });
    if (named == tables.end()) {
      continue;
    }
    const auto outcome = draw(of_table.plot, named->table, folder, named->name + ".csv");
    if (outcome && outcome->is_drawn) {
      pictures[named->name] += "\n![" + of_table.plot.title + "](" + of_table.plot.name + ".svg)\n";
    } else if (outcome) {
      complain(report.complaints, *outcome);
    }
  }
  return pictures;
}

}  // namespace

PaperReport write_report(const std::vector<NamedTable>& tables, std::uint32_t resolution, bool is_complete,
                         const std::optional<std::filesystem::path>& folder) {
  PaperReport report;
  Pictures pictures;
  if (folder) {
    write_tables(tables, *folder);
    pictures = draw_all(tables, *folder, report);
  }
  const std::string side = std::to_string(resolution);
  report.text =
      "# The tables of 1994, regenerated\n\nD. Badouel, K. Bouatouch, T. Priol, \"Distributing Data and Control for Ray Tracing "
      "in Parallel\", on the modelled iPSC/2 (`dmpc machine ipsc2`), pictures of " +
      side + "x" + side + " pixels.\n";
  report.text += is_complete ? "" : "\nInterrupted: rows are missing.\n";
  for (const std::string& complaint : report.complaints) {
    report.text += "\nNote: " + complaint + ".\n";
  }
  for (const NamedTable& named : tables) {
    report.text += "\n" + text_of(named.table, TableFormat::markdown) + pictures[named.name];
  }
  if (folder) {
    write_file(*folder / "report.md", report.text);
  }
  return report;
}

}  // namespace dmpc::apps
