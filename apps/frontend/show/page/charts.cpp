#include "apps/frontend/show/page/charts.h"

#include <fstream>
#include <ostream>
#include <sstream>
#include <utility>

#include "apps/frontend/show/page/data_url.h"
#include "apps/frontend/system/output_file.h"
#include "apps/frontend/table/plot_program.h"

namespace dmpc::apps::html {

namespace {

/// A style is stronger than the attributes that gnuplot writes. save.js knows it by how it begins.
constexpr const char* chart_style =
    "<style>rect[fill='#ffffff']{fill:none}"
    "@media(prefers-color-scheme:dark){[fill='black']{fill:#e4e4e4}[stroke='black']{stroke:#e4e4e4}[color='black']{color:#e4e4e4}"
    "[fill='rgb(  0,   0,   0)']{fill:#fff}[stroke='rgb(  0,   0,   0)']{stroke:#fff}[color='rgb(  0,   0,   0)']{color:#fff}"
    "[stroke='rgb(221, 221, 221)']{stroke:#444}}</style>\n";

/// Empty if there is none, or it cannot be read.
std::string bytes_of(const std::filesystem::path& path) {
  std::ostringstream bytes;
  bytes << std::ifstream(path, std::ios::binary).rdbuf();
  return bytes.str();
}

}  // namespace

Charts::Charts(std::ostream& complaints, std::string speaker, std::string program)
    : complaints_(complaints), speaker_(std::move(speaker)), program_(std::move(program)) {}

std::string Charts::draw(Plot plot, const Table& table) {
  plot.size = PlotSize::small;
  const std::string data_file = plot.name + ".csv";
  write_file(folder_ / data_file, text_of(table, TableFormat::csv), Durability::until_power_loss);
  const std::optional<PlotOutcome> outcome = apps::draw(plot, table, folder_ / "", data_file, program_);
  if (!outcome) {
    return "";
  }
  if (!outcome->is_drawn) {
    const std::string sentence = outcome->is_program_missing
                                     ? "the page has no plots: " + outcome->complaint + " (package gnuplot-nox)"
                                     : outcome->complaint;
    report(sentence);
    return "";
  }
  const std::string picture = plot.name + ".svg", bytes = bytes_of(folder_ / picture);
  if (bytes.empty()) {
    report("the page lacks a plot: " + picture + " is drawn, and cannot be read back");
    return "";
  }
  return data_url("image/svg+xml", themed(bytes));
}

void Charts::report(const std::string& sentence) {
  if (reported_.insert(sentence).second) {
    complaints_ << speaker_ << ": " << sentence << std::endl;
  }
}

std::string themed(std::string svg) {
  if (const std::size_t at = svg.find("<g id=\"gnuplot_canvas\">"); at != std::string::npos) {
    svg.insert(at, chart_style);
  }
  return svg;
}

}  // namespace dmpc::apps::html
