#include "apps/html/render_page.h"

#include "apps/figures.h"
#include "apps/heat_field.h"
#include "apps/heat_picture.h"
#include "apps/html/page.h"
#include "apps/html/render_tables.h"
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
  add_nodes(page, record);
  add_traffic(page, account);
  add_memory(page, account);
  return page.text();
}

}  // namespace dmpc::apps::html
