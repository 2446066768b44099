#include "apps/edge/table/plot_folder.h"

#include "apps/edge/system/output_file.h"
#include "apps/edge/table/plot_program.h"

namespace dmpc::apps {

void PlotFolder::add(const Table& table, const std::string& data_file, std::span<const Plot> plots, Attempts& attempts) {
  const bool has_data = attempts.make([&] { write_file(folder_ / data_file, text_of(table, TableFormat::csv)); });
  if (has_data) {
    for (const Plot& plot : plots) {
      attempts.make([&] { draw_one(plot, table, data_file); });
    }
  }
}

void PlotFolder::draw_one(const Plot& plot, const Table& table, const std::string& data_file) {
  const auto outcome = draw(plot, table, folder_, data_file);
  if (outcome && !outcome->is_drawn && told_.insert(sentence_on(*outcome)).second) {
    complaints_ << "dmpc: " << sentence_on(*outcome) << std::endl;
  }
}

}  // namespace dmpc::apps
