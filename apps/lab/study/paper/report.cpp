#include "apps/lab/study/paper/report.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

#include "apps/frontend/line/folded_text.h"
#include "apps/frontend/line/words.h"
#include "apps/frontend/show/page/origin.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/table/plot_program.h"
#include "apps/lab/study/paper/archive.h"
#include "apps/lab/study/paper/data.h"
#include "apps/show/page/sweep_page.h"
#include "core/base/expect.h"
#include "core/base/ranges.h"

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

constexpr const char *page_name = "index.html", *hashes_name = "SHA256SUMS", *archive_name = "paper.zip";

/// Adds hashes of the files that are there, and all of them as one file.
void write_archive(const PaperReport& report, const std::filesystem::path& folder, std::vector<std::string>& complaints) {
  std::vector<std::string> names;
  for (const OutputName& file : report_files(report, folder, "")) {
    const std::string name = file.file.path.filename();
    if (name != hashes_name && name != archive_name && std::filesystem::is_regular_file(folder / name)) {
      names.push_back(name);
    }
  }
  try {
    write_file(folder / hashes_name, hashes_of(folder, names));
    names.emplace_back(hashes_name);
  } catch (const core::InputError& error) {
    complaints.push_back("the files have no hashes: " + std::string(error.what()));
  }
  std::vector<std::pair<std::string, std::string>> files;
  for (const std::string& name : names) {
    std::ifstream file(folder / name, std::ios::binary);
    files.emplace_back("paper/" + name, std::string(std::istreambuf_iterator<char>(file), {}));
  }
  write_file(folder / archive_name, zip_of(files));
}

constexpr const char* title = "The tables of 1994, regenerated";

std::vector<std::string> introduction(const PaperReport& report) {
  const std::string side = std::to_string(report.resolution), fitted_side = std::to_string(paper_resolution);
  std::vector<std::string> paragraphs = {
      "D. Badouel, K. Bouatouch, T. Priol, \"Distributing Data and Control for Ray Tracing in Parallel\", on the modelled iPSC/2 "
      "(`dmpc machine ipsc2-1994`) and the article's own structure, a plain grid of voxels, pictures of " +
      side + "x" + side +
      " pixels. As in 1994 a node has one pixel in flight, travelling rays have no backpressure, and nothing is skipped that "
      "later "
      "programs skip."};
  if (report.resolution != paper_resolution) {
    paragraphs.push_back("The machine's prices are fitted to pictures of " + fitted_side + "x" + fitted_side +
                         " pixels: those of another size show how the study works, and no more.");
  }
  paragraphs.insert(paragraphs.end(), report.summary.begin(), report.summary.end());
  if (!report.is_complete) {
    paragraphs.push_back("Unfinished: rows are missing.");
  }
  return paragraphs;
}

std::string head_of(const PaperReport& report) {
  return std::string("# ") + title + "\n" + joined(introduction(report), "", [&](const std::string& paragraph) {
           return "\n" + folded(paragraph, markdown_width_max, "") + "\n";
         });
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
  std::string text = head_of(report) + joined(complaints, "", [&](const std::string& complaint) {
                       return "\n" + folded("Note: " + complaint + ".", markdown_width_max, "") + "\n";
                     });
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
  for (const char* const name : {"report.md", page_name, hashes_name, archive_name}) {
    add(name);
  }
  return files;
}

std::vector<std::string> write_report(const PaperReport& report, const std::filesystem::path& folder, Attempts& attempts) {
  std::vector<std::string> complaints;
  write_tables(report.tables, folder, attempts);
  const Pictures pictures = draw_all(report.tables, folder, attempts, complaints);
  attempts.make([&] { write_file(folder / "report.md", text_with(report, pictures, complaints)); });
  attempts.make([&] { write_file(folder / page_name, page_of(report)); });
  attempts.make([&] { write_archive(report, folder, complaints); });
  return complaints;
}

std::string page_of(const PaperReport& report) {
  std::vector<html::SweepPart> parts = core::mapped<html::SweepPart>(report.tables, [&](const NamedTable& named) {
    return html::SweepPart{named.table.title(), named.table, plots_of(named.name), paper_conclusion(named.name, named.table)};
  });
  return html::sweep_page({title, introduction(report), std::move(parts)}, this_origin());
}

}  // namespace dmpc::apps
