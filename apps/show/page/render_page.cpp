#include "apps/show/page/render_page.h"

#include <algorithm>
#include <cstdint>
#include <variant>
#include <vector>

#include "apps/frontend/line/amount.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/run/work.h"
#include "apps/frontend/show/page/sections.h"
#include "apps/frontend/show/page/traffic.h"
#include "apps/frontend/show/page/view_tables.h"
#include "apps/picture/film_image.h"
#include "apps/run/heat_options.h"
#include "apps/show/heat/field.h"
#include "apps/show/heat/picture.h"
#include "apps/show/page/conclusions.h"
#include "apps/show/page/findings.h"
#include "apps/show/page/forecast_view.h"
#include "apps/show/page/path_table.h"
#include "apps/show/page/pictures.h"
#include "apps/show/page/play_data.h"
#include "apps/show/page/player.h"
#include "apps/show/page/render_tables.h"
#include "core/base/ranges.h"
#include "core/picture/heat_kind.h"
#include "nodes/size_text.h"

namespace dmpc::apps::html {

namespace {

/// Identify another run with the same results.
Facts results_of(const RenderRecord& record, const Account& account) {
  Facts results = {{"film", hash_text(record.film_hash())}};
  if (account.virtual_time) {
    results.emplace_back("run", hash_text(account.virtual_time->run_hash(record.film_hash())));
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

void add_opening(Page& page, const RenderRecord& record, const Account& account) {
  const std::string size = std::to_string(account.film.width()) + "x" + std::to_string(account.film.height()) + " pixels";
  add_picture(page, image_of(account.film), "The picture of " + record.options.picture.scene, size + ".");
  page.end_opening(findings_of(record, account));
}

void add_heat_maps(Page& page, const RenderRecord& record) {
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

void add_time(Page& page, const RunView& view, const WaitKinds& waits, bool is_virtual) {
  const std::vector<std::string> names(work_names.begin(), work_names.end());
  const auto wait_names = core::mapped<std::string>(wait_parts, [&waits](TimePart part) { return words_of(part, waits); });
  const char* const rest = is_virtual ? "What is left they were idle at the end."
                                      : "What is left was between calls. By the wall clock a call counts as long as it took, "
                                        "even where it waited for a core.";
  add_steps(page, view.steps, names, wait_names, is_virtual, "", std::string(rest) + " The host is left out.");
}

void add_fetched(Page& page, const RenderRecord& record) {
  const auto& report = std::get<svm::Report>(record.report);
  const svm::PageCounters pages = report.pages();
  add_pages(page, pages, *record.view->fetches, report.virtual_time.has_value(), true, "");
  if (pages.faults == 0 || !record.view->misses) {
    return;
  }
  const auto page_count = static_cast<std::uint32_t>(record.database.page_count());
  add_misses(page, *record.view->misses, page_count, report.plan.frames, pages, "");
  if (const std::optional<ForecastView> forecast = forecast_view(record)) {
    add_forecast(page, *forecast);
  } else {
    page.add_text("Of the references only those of one page in " + std::to_string(record.view->misses->every) +
                  " were recorded, too few to tell what other caches would change.");
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

void add_time_losses(Page& page, const Account& account) {
  add_losses(page, losses_of(account));
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
  add_ranks(page, account.ranks);
  if (account.virtual_time) {
    add_links(page, *account.virtual_time);
  }
}

}  // namespace

std::string render_page(const RenderRecord& record, const Origin& origin) {
  const Account account = account_of(record.report);
  Page page("Render of " + record.options.picture.scene);
  add_opening(page, record, account);
  page.add_text(origin.program + ", " + origin.date);
  page.add_facts(facts_of(record, account));
  add_heat_maps(page, record);
  add_time_losses(page, account);
  if (record.view != nullptr) {
    add_time(page, *record.view, account.waits, account.virtual_time.has_value());
  }
  if (record.view != nullptr && record.view->fetches) {
    add_fetched(page, record);
  }
  if (const auto* const report = std::get_if<dataflow::Report>(&record.report)) {
    add_rays(page, *report, account);
  }
  add_node_section(page, "Nodes", node_conclusion(account), node_table(record), node_plots(record));
  add_traffic(page, account);
  add_node_section(page, "Memory", memory_conclusion(account, record.database.page_count() * record.database.page_size()),
                   memory_table(account), {memory_plot(account)});
  page.add_origin(origin, results_of(record, account));
  if (record.view != nullptr && !record.view->steps.nodes.front().empty()) {
    add_player(page, play_data(record, origin));
  }
  return page.text();
}

}  // namespace dmpc::apps::html
