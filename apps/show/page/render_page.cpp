#include "apps/show/page/render_page.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <variant>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/run/work.h"
#include "apps/frontend/show/page/node_bands.h"
#include "apps/frontend/show/page/page.h"
#include "apps/frontend/show/page/view_conclusions.h"
#include "apps/frontend/show/page/view_tables.h"
#include "apps/picture/film_image.h"
#include "apps/run/heat_options.h"
#include "apps/show/heat/field.h"
#include "apps/show/heat/picture.h"
#include "apps/show/page/conclusions.h"
#include "apps/show/page/forecast_view.h"
#include "apps/show/page/path_table.h"
#include "apps/show/page/pictures.h"
#include "apps/show/page/play_data.h"
#include "apps/show/page/player.h"
#include "apps/show/page/render_tables.h"
#include "core/picture/heat_kind.h"
#include "nodes/size_text.h"

namespace dmpc::apps::html {

namespace {

/// Identify another run with the same results.
Facts results_of(const RenderRecord& record, const Account& account) {
  Facts results = {{"film", hash_text(record.film_hash)}};
  if (account.virtual_time) {
    results.emplace_back("run", hash_text(account.virtual_time->run_hash(record.film_hash)));
  }
  return results;
}

Facts facts_of(const RenderRecord& record, const Account& account) {
  const RenderOptions& options = record.options;
  Facts facts = {
      {"Scene", options.picture.scene + ", " + counted(record.database.header().primitive_count, "primitive")},
      {"Database", counted(record.database.page_count(), "page") + " of " + nodes::size_text(record.database.page_size())},
      {"Computer", computer_text(record)},
      {"Runner", runner_text(options.computer, account.ranks.empty() ? "" : " on " + counted(account.ranks.size(), "rank"))},
      {"Memory of the fullest node", bytes_text(account.node_memory_max_bytes)},
      {"Rays traced", grouped(account.operations.ray_count())},
      {"Packets sent", grouped(nodes::total(account.sent).packets) + ", " +
                           amount_text(static_cast<double>(nodes::total(account.sent).bytes), "bytes")},
      {"Rendering took", seconds_text(record.seconds.render) + " by the wall clock, " +
                             seconds_text(record.seconds.render_user + record.seconds.render_system) + " of processors"}};
  if (account.virtual_time) {
    facts.push_back({"Virtual time", amount_text(static_cast<double>(account.virtual_time->total_ns), "ns")});
  }
  return facts;
}

void add_pictures(Page& page, const RenderRecord& record, const Account& account) {
  page.begin_section("Picture");
  const std::string size = std::to_string(account.film.width()) + "x" + std::to_string(account.film.height()) + " pixels";
  add_picture(page, image_of(account.film), "The picture of " + record.options.picture.scene, size + ".");
  const std::vector<core::HeatKind> wanted = kinds_of(record.options.heat_maps);
  if (wanted.empty()) {
    return;
  }
  page.begin_section("What each pixel took");
  for (std::size_t number = 0; number < core::heat_kind_names.size(); ++number) {
    if (const auto kind = static_cast<core::HeatKind>(number); std::find(wanted.begin(), wanted.end(), kind) != wanted.end()) {
      const HeatField field = heat_field(kind, record);
      const std::string name(core::name_of(kind));
      page.add_conclusion(heat_conclusion(field));
      add_picture(page, heat_picture(field, record.options.picture.scene + ", " + computer_text(record)), "Heat map of " + name,
                  name + ": " + field.meaning + ", least " + amount_text(field.least(), field.unit) + ", largest " +
                      amount_text(field.largest(), field.unit) + ".");
    }
  }
}

void add_time(Page& page, const RunView& view, const WaitKinds& waits) {
  if (view.steps.nodes.front().empty()) {
    return;
  }
  page.begin_section("Over time");
  const std::vector<std::string> names(work_names.begin(), work_names.end());
  std::vector<std::string> wait_names;
  std::transform(wait_parts.begin(), wait_parts.end(), std::back_inserter(wait_names),
                 [&waits](TimePart part) { return words_of(part, waits); });
  page.add_conclusion(time_conclusion(view.steps, wait_names));
  Table table = step_table(view.steps, names, wait_names);
  table.add_note("The host is left out.");
  page.add_plot(step_plot(view.steps, names, wait_names), table);
  page.add_map(step_map(view.steps), "Each row is a node, each column a step of time: the darker, the less it did.");
  page.add_table(table);
}

void add_misses(Page& page, const RenderRecord& record, const MissEstimate& misses) {
  const auto& report = std::get<svm::Report>(record.report);
  const svm::PageCounters pages = report.pages();
  page.add_conclusion(cache_conclusion(misses, report.plan.frames, static_cast<std::uint32_t>(record.database.page_count())));
  const Table table = miss_table(misses, static_cast<std::uint32_t>(record.database.page_count()), pages.references,
                                 report.plan.frames, pages.faults);
  page.add_plot(miss_plot(), table);
  page.add_table(table);
  if (const std::optional<ForecastView> forecast = forecast_view(record)) {
    add_forecast(page, *forecast);
  } else if (!report.virtual_time) {
    page.add_text(
        "The run time with other caches is predicted on modelled machines (`--runner=virtual`) only: times by the wall clock "
        "compare schedules of this computer.");
  }
}

void add_fetches(Page& page, const svm::Fetches& fetches) {
  page.begin_section("Fetching a page");
  page.add_conclusion(fetch_conclusion(fetches));
  const Table table = fetch_table(fetches);
  page.add_plot(fetch_plot(fetches), table);
  page.add_table(table);
  page.add_table(fetch_part_table(fetches));
}

void add_pages(Page& page, const RenderRecord& record, const svm::Fetches& fetches) {
  page.begin_section("Pages");
  const svm::PageCounters pages = std::get<svm::Report>(record.report).pages();
  page.add_conclusion(page_conclusion(pages, fetches));
  if (pages.faults == 0) {
    return;
  }
  page.add_map(pair_map(fetches.by_pair, "Who fetched pages from whom", "node that asks", "home of the page", "fetches"), "");
  page.add_plot(page_share_plot(), page_share_table(fetches));
  page.add_table(page_table(fetches));
  add_fetches(page, fetches);
  if (record.view->misses) {
    page.begin_section("Other caches");
    add_misses(page, record, *record.view->misses);
  }
}

void add_rays(Page& page, const dataflow::Report& report, const Account& account) {
  page.begin_section("Rays between nodes");
  const std::vector<std::uint64_t> rays = report.ray_matrix();
  page.add_conclusion(ray_conclusion(rays, account.operations.ray_count()));
  if (account.nodes.size() > 1) {
    page.add_map(pair_map(rays, "Who sent rays to whom", "node that sends", "owner that receives", "rays"), "");
  }
}

void add_nodes(Page& page, const RenderRecord& record) {
  page.begin_section("Nodes");
  page.add_conclusion(node_conclusion(account_of(record.report)));
  const Table table = node_table(record);
  for (const Plot& plot : node_plots(record)) {
    add_node_plot(page, plot, table);
  }
  page.add_table(table);
}

void add_losses(Page& page, const Account& account) {
  page.begin_section("Where the time went");
  const Losses losses = losses_of(account);
  page.add_conclusion(loss_conclusion(losses));
  const Table table = loss_table(losses);
  add_node_plot(page, loss_plot(losses), table);
  page.add_table(table);
  if (account.virtual_time && account.virtual_time->critical_path) {
    const nodes::PathTimes& path = account.virtual_time->critical_path->times;
    page.add_conclusion(path_conclusion(path, account.kind_names));
    page.add_table(path_table(path, account.kind_names));
  }
}

void add_traffic(Page& page, const Account& account) {
  page.begin_section("Traffic");
  const std::vector<PacketKindTraffic> packets = packets_of(account);
  page.add_conclusion(traffic_conclusion(packets, account.virtual_time ? &*account.virtual_time : nullptr));
  page.add_table(packet_table(packets));
  if (!account.ranks.empty()) {
    page.add_table(rank_table(account.ranks));
  }
  if (!account.virtual_time) {
    return;
  }
  page.add_text(way_text(account.virtual_time->links));
  const Table table = link_table(*account.virtual_time);
  page.add_plot(link_plot(), table);
  page.add_table(table);
}

void add_memory(Page& page, const Account& account, std::size_t database_bytes) {
  page.begin_section("Memory");
  page.add_conclusion(memory_conclusion(account, database_bytes));
  const Table table = memory_table(account);
  add_node_plot(page, memory_plot(account), table);
  page.add_table(table);
}

}  // namespace

std::string render_page(const RenderRecord& record, const Origin& origin, std::ostream& complaints) {
  const Account account = account_of(record.report);
  Page page("Render of " + record.options.picture.scene, complaints);
  page.add_text(origin.program + ", " + origin.date);
  page.add_facts(facts_of(record, account));
  add_pictures(page, record, account);
  add_losses(page, account);
  if (record.view != nullptr) {
    add_time(page, *record.view, account.waits);
  }
  if (record.view != nullptr && record.view->fetches) {
    add_pages(page, record, *record.view->fetches);
  }
  if (const auto* const report = std::get_if<dataflow::Report>(&record.report)) {
    add_rays(page, *report, account);
  }
  add_nodes(page, record);
  add_traffic(page, account);
  add_memory(page, account, record.database.page_count() * record.database.page_size());
  page.add_origin(origin, results_of(record, account));
  if (record.view != nullptr && !record.view->steps.nodes.front().empty()) {
    add_player(page, play_data(record, origin));
  }
  return page.text();
}

}  // namespace dmpc::apps::html
