#include "apps/html/sweep_page.h"

#include "apps/html/page.h"

namespace dmpc::apps::html {

std::string sweep_page(const std::string& title, const std::vector<std::string>& texts, std::span<const SweepPart> parts,
                       std::ostream& complaints) {
  Page page(title, complaints);
  for (const std::string& text : texts) {
    page.add_text(text);
  }
  for (const SweepPart& part : parts) {
    if (!part.heading.empty()) {
      page.begin_section(part.heading);
    }
    for (const Plot& plot : part.plots) {
      page.add_plot(plot, part.table);
    }
    page.add_table(part.table);
  }
  return page.text();
}

}  // namespace dmpc::apps::html
