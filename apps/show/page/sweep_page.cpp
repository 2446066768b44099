#include "apps/show/page/sweep_page.h"

namespace dmpc::apps::html {

std::string sweep_page(const Sweep& sweep, const Origin& origin) {
  Page page(sweep.title);
  page.add_text(origin.program + ", " + origin.date);
  for (const std::string& text : sweep.texts) {
    page.add_text(text);
  }
  for (const SweepPart& part : sweep.parts) {
    if (!part.heading.empty()) {
      page.begin_section(part.heading);
    }
    page.add_conclusion(part.conclusion);
    for (const Plot& plot : part.plots) {
      page.add_plot(plot, part.table);
    }
    page.add_table(part.table);
  }
  page.add_origin(origin, sweep.results);
  return page.text();
}

}  // namespace dmpc::apps::html
