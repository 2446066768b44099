#include "apps/html/render_page.h"

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "apps/figures.h"
#include "apps/heat_field.h"
#include "apps/heat_picture.h"
#include "apps/html/page.h"
#include "apps/html/render_tables.h"
#include "apps/html/view_tables.h"
#include "apps/render.h"
#include "apps/summary.h"
#include "nodes/size_text.h"

namespace dmpc::apps::html {

namespace {

Facts facts_of(const RenderRecord& record, const Account& account) {
  const RenderOptions& options = record.options;
  Facts facts = {
      {"Scene", options.picture.scene + ", " + counted(record.database.header().primitive_count, "primitive")},
      {"Database", counted(record.database.page_count(), "page") + " of " + nodes::size_text(record.database.page_size())},
      {"Computer", computer_text(record)},
      {"Memory of the fullest node", bytes_text(account.node_memory_max_bytes)},
      {"Rays shot", grouped(account.operations.ray_count())},
      {"Packets sent", grouped(nodes::total(account.sent).packets) + ", " + bytes_text(nodes::total(account.sent).bytes)},
      {"Rendering took", seconds_text(record.seconds.render) + " by the wall clock, " +
                             seconds_text(record.seconds.render_user + record.seconds.render_system) + " of processors"}};
  if (account.virtual_time) {
    facts.push_back({"Virtual time", fixed(static_cast<double>(account.virtual_time->total_ns) / 1e9, 6) + " s"});
    facts.push_back({"Run", hash_text(account.virtual_time->run_hash(account.film.hash()))});
  }
  facts.push_back({"Film", hash_text(account.film.hash())});
  return facts;
}

void add_pictures(Page& page, const RenderRecord& record, const Account& account) {
  page.begin_section("Picture");
  const std::string size = std::to_string(account.film.width()) + "x" + std::to_string(account.film.height()) + " pixels";
  page.add_picture(image_of(account.film), "The picture of " + record.options.picture.scene, size + ".");
  if (record.heat == nullptr) {
    return;
  }
  page.begin_section("What each pixel took");
  for (std::size_t number = 0; number < nodes::heat_kind_names.size(); ++number) {
    if (const auto kind = static_cast<nodes::HeatKind>(number); record.heat->has(kind)) {
      const HeatField field = heat_field(kind, record);
      const std::string name(nodes::name_of(kind));
      page.add_picture(heat_picture(field, record.options.picture.scene + ", " + computer_text(record)), "Heat map of " + name,
                       name + ": " + field.meaning + ", least " + rounded(field.least()) + ", largest " +
                           rounded(field.largest()) + " " + field.unit + ".");
    }
  }
}

void add_time(Page& page, const RunView& view) {
  if (view.steps.nodes.front().empty()) {
    return;
  }
  page.begin_section("Over time");
  const Table table = step_table(view.steps);
  page.add_plot(step_plot(), table);
  page.add_picture(step_picture(view.steps), "How busy each node was over time",
                   "How busy each node was: time from left to right, nodes from node 0 at the top down. Dark: not at all.",
                   PictureSize::wide);
  page.add_table(table);
}

/// Who asks, from the top down, of whom, from left to right.
template <class Count>
void add_matrix(Page& page, const std::vector<Count>& counts, const std::string& what) {
  const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(counts.size())) + 0.5);
  const auto largest = std::max_element(counts.begin(), counts.end());
  const auto at = static_cast<std::size_t>(largest - counts.begin());
  page.add_picture(number_picture(std::vector<double>(counts.begin(), counts.end()), side, side), what,
                   what + ", from node 0 on. Dark: 0; lightest: " + grouped(*largest) + ", from node " +
                       std::to_string(at / side) + " to node " + std::to_string(at % side) + ".",
                   PictureSize::wide);
}

void add_misses(Page& page, const RenderRecord& record, const MissEstimate& misses) {
  const auto& report = std::get<svm::Report>(record.report);
  const svm::PageCounters pages = report.pages();
  const Table table = miss_table(misses, static_cast<std::uint32_t>(record.database.page_count()), pages.references,
                                 report.plan.frames, pages.faults);
  page.add_plot(miss_plot(), table);
  page.add_table(table);
}

void add_fetches(Page& page, const svm::Fetches& fetches) {
  page.begin_section("Fetching a page");
  const Table table = fetch_table(fetches);
  page.add_plot(fetch_plot(fetches), table);
  page.add_table(table);
  page.add_table(fetch_part_table(fetches));
}

void add_pages(Page& page, const RenderRecord& record, const svm::Fetches& fetches) {
  page.begin_section("Pages");
  if (std::get<svm::Report>(record.report).pages().faults == 0) {
    page.add_text("No page was fetched.");
    return;
  }
  add_matrix(page, fetches.by_pair, "Fetches: who asks, from the top down, and the page's home, from left to right");
  page.add_plot(page_share_plot(), page_share_table(fetches));
  page.add_table(page_table(fetches));
  add_fetches(page, fetches);
  if (record.view->misses) {
    page.begin_section("Other caches");
    add_misses(page, record, *record.view->misses);
  }
}

void add_nodes(Page& page, const RenderRecord& record) {
  page.begin_section("Nodes");
  const Table table = node_table(record);
  for (const Plot& plot : node_plots(record)) {
    page.add_plot(plot, table);
  }
  page.add_table(table);
}

void add_losses(Page& page, const Account& account) {
  page.begin_section("Where the time went");
  const Table table = loss_table(account);
  page.add_plot(loss_plot(account), table);
  page.add_table(table);
}

void add_traffic(Page& page, const Account& account) {
  page.begin_section("Traffic");
  page.add_table(packet_table(account));
  if (!account.virtual_time) {
    return;
  }
  const nodes::LinkTraffic& links = account.virtual_time->links;
  const double hops = links.messages == 0 ? 0 : static_cast<double>(links.hops) / static_cast<double>(links.messages);
  page.add_text(counted(links.messages, "message") + " from one node to another passed " + fixed(hops, 2) +
                " links each, on average.");
  const Table table = link_table(*account.virtual_time);
  page.add_plot(link_plot(), table);
  page.add_table(table);
}

void add_memory(Page& page, const Account& account) {
  page.begin_section("Memory");
  const Table table = memory_table(account);
  page.add_plot(memory_plot(account), table);
  page.add_table(table);
}

}  // namespace

std::string render_page(const RenderRecord& record, std::ostream& complaints) {
  const Account account = account_of(record.report);
  Page page("Render of " + record.options.picture.scene, complaints);
  page.add_facts(facts_of(record, account));
  add_pictures(page, record, account);
  add_losses(page, account);
  if (record.view != nullptr) {
    add_time(page, *record.view);
  }
  if (record.view != nullptr && record.view->fetches) {
    add_pages(page, record, *record.view->fetches);
  }
  if (const auto* const report = std::get_if<dataflow::Report>(&record.report)) {
    page.begin_section("Rays between nodes");
    add_matrix(page, report->ray_matrix(), "Rays: their sender, from the top down, and their owner, from left to right");
  }
  add_nodes(page, record);
  add_traffic(page, account);
  add_memory(page, account);
  return page.text();
}

}  // namespace dmpc::apps::html
