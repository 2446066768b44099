#include "apps/frontend/show/page/sections.h"

#include "apps/frontend/show/page/node_bands.h"
#include "apps/frontend/show/page/traffic.h"
#include "apps/frontend/show/page/view_conclusions.h"
#include "apps/frontend/show/page/view_tables.h"

namespace dmpc::apps::html {
namespace {

void begin(Page& page, const std::string& heading, const std::string& conclusion, const std::string& remark) {
  page.begin_section(heading);
  page.add_conclusion(conclusion);
  if (!remark.empty()) {
    page.add_text(remark);
  }
}

void add_plotted(Page& page, const Plot& plot, const Table& table) {
  page.add_plot(plot, table);
  page.add_table(table);
}

}  // namespace

void add_node_section(Page& page, const std::string& heading, const std::string& conclusion, const Table& table,
                      const std::vector<Plot>& plots) {
  begin(page, heading, conclusion, "");
  for (const Plot& plot : plots) {
    add_node_plot(page, plot, table);
  }
  page.add_table(table);
}

void add_losses(Page& page, const Losses& losses) {
  add_node_section(page, "Where the time went", loss_conclusion(losses), loss_table(losses), {loss_plot(losses)});
}

void add_steps(Page& page, const nodes::ActivitySteps& steps, std::span<const std::string> work_names,
               std::span<const std::string> wait_names, bool is_virtual, const std::string& remark, const std::string& note) {
  if (steps.nodes.front().empty()) {
    return;
  }
  begin(page, "Over time", is_virtual ? time_conclusion(steps, wait_names) : "", remark);
  Table table = step_table(steps, work_names, wait_names);
  if (!note.empty()) {
    table.add_note(note);
  }
  page.add_plot(step_plot(steps, work_names, wait_names), table);
  page.add_map(step_map(steps), "Each row is a node, each column a step of time: the darker, the less it did.");
  page.add_table(table);
}

void add_pages(Page& page, const svm::PageCounters& pages, const svm::Fetches& fetches, bool is_virtual, bool has_pairs,
               const std::string& remark) {
  begin(page, "Pages", page_conclusion(pages, fetches), remark);
  if (pages.faults == 0) {
    return;
  }
  if (has_pairs) {
    page.add_map(pair_map(fetches.by_pair, "Who fetched pages from whom", "node that asks", "home of the page", "fetches"), "");
  }
  page.add_plot(page_share_plot(), page_share_table(fetches));
  page.add_table(page_table(fetches));
  begin(page, "Fetching a page", is_virtual ? fetch_conclusion(fetches) : "", remark);
  add_plotted(page, fetch_plot(fetches), fetch_table(fetches));
  page.add_table(fetch_part_table(fetches));
}

void add_misses(Page& page, const MissEstimate& misses, std::uint32_t page_count, std::uint32_t cache_pages,
                const svm::PageCounters& pages, const std::string& remark) {
  begin(page, "Other caches", cache_conclusion(misses, cache_pages), remark);
  add_plotted(page, miss_plot(), miss_table(misses, page_count, pages.references, cache_pages, pages.faults));
}

void add_links(Page& page, const nodes::VirtualReport& report) {
  page.add_text(way_text(report.links));
  add_plotted(page, link_plot(), link_table(report));
}

void add_ranks(Page& page, const std::vector<nodes::RankFigures>& ranks) {
  if (!ranks.empty()) {
    page.add_table(rank_table(ranks));
  }
}

}  // namespace dmpc::apps::html
