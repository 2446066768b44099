#include "apps/show/page/render_tables.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "tests/apps/show/watched.h"

namespace dmpc::apps::html::render_tables_test {

namespace {

/// A cell by its column's name.
const Cell& cell(const Table& table, std::size_t row, const std::string& name) {
  const auto& columns = table.columns();
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& column) { return column.name == name; });
  REQUIRE(found != columns.end());
  return table.rows().at(row).at(static_cast<std::size_t>(found - columns.begin()));
}

std::uint64_t sum(const Table& table, const std::string& name) {
  std::uint64_t total = 0;
  for (std::size_t row = 0; row < table.rows().size(); ++row) {
    total += std::get<std::uint64_t>(cell(table, row, name));
  }
  return total;
}

void check_hundreds(const Table& table) {
  for (const std::vector<Cell>& row : table.rows()) {
    double total = 0;
    for (std::size_t i = 1; i < row.size(); ++i) {
      total += std::get<double>(row[i]);
    }
    CHECK(total == doctest::Approx(100));
  }
}

}  // namespace

TEST_CASE("the rows of the nodes add up to the run's counters") {
  const Rendered rendered(modelled());
  const RenderRecord record = rendered.record();
  const auto& report = std::get<svm::Report>(*rendered.report);
  const Table table = node_table(record);
  CHECK(table.rows().size() == 3);
  CHECK(sum(table, "rays traced") == report.operations().ray_count());
  CHECK(sum(table, "faults") == report.pages().faults);
  CHECK(sum(table, "pages served") == report.pages().faults);
  CHECK(sum(table, "pixels") == 16 * 12);
}

TEST_CASE("each strategy has columns of its own") {
  const Table rays = node_table(Rendered(small(Strategy::dataflow)).record());
  CHECK(sum(rays, "rays in") == sum(rays, "rays out"));
  CHECK(sum(rays, "rays in") > 0);
  const Table copies = node_table(Rendered(small(Strategy::replicated)).record());
  CHECK(sum(copies, "pixels") == 16 * 12);
  CHECK(copies.columns().size() == rays.columns().size() - 3);
}

TEST_CASE("losses add up to a hundred percent, node by node and in all") {
  for (const Strategy strategy : {Strategy::svm, Strategy::dataflow}) {
    const Rendered rendered(modelled(strategy));
    const Table table = loss_table(losses_of(account_of(*rendered.report)));
    CHECK(table.rows().size() == 4);
    CHECK(std::get<std::string>(table.rows().back()[0]) == "all");
    check_hundreds(table);
  }
}

TEST_CASE("losses of threads add up, too") {
  const Rendered rendered(small());
  const Table table = loss_table(losses_of(account_of(*rendered.report)));
  CHECK(table.columns()[3].name == "waiting for a core");
  check_hundreds(table);
}

TEST_CASE("the categories of a node's memory add up to what it uses") {
  const Rendered rendered(small());
  const Table table = memory_table(account_of(*rendered.report));
  for (const std::vector<Cell>& row : table.rows()) {
    double total = 0;
    for (std::size_t i = 1; i + 2 < row.size(); ++i) {
      total += std::get<double>(row[i]);
    }
    CHECK(total == doctest::Approx(std::get<double>(row[row.size() - 2])));
    CHECK(std::get<double>(row[row.size() - 2]) <= std::get<double>(row.back()));
  }
}

TEST_CASE("each part of a stack has a look of its own") {
  const Rendered rendered(starved(modelled()));
  const Account account = account_of(*rendered.report);
  for (const Plot& plot : {memory_plot(account), loss_plot(losses_of(account))}) {
    std::set<std::size_t> looks;
    for (const PlotSeries& series : plot.series) {
      looks.insert(series.color);
    }
    CHECK(looks.size() == plot.series.size());
  }
  CHECK(memory_plot(account).series.size() > 8);
}

TEST_CASE("what no node has is not plotted") {
  RenderOptions alone = modelled();
  alone.computer.node_count = 1;
  CHECK(node_plots(Rendered(alone).record()).size() == 1);
  CHECK(node_plots(Rendered(starved(modelled())).record()).size() == 2);
}

TEST_CASE("packets of all kinds that were sent are listed") {
  const Rendered rendered(small());
  const Account account = account_of(*rendered.report);
  CHECK(sum(packet_table(packets_of(account)), "packets") == nodes::total(account.sent).packets);
}

TEST_CASE("links are listed, the busiest first, with what they carried") {
  const Rendered rendered(modelled());
  const nodes::VirtualReport& report = *account_of(*rendered.report).virtual_time;
  const Table table = link_table(report);
  CHECK(table.rows().size() == report.links_used);
  CHECK(sum(table, "carried") == report.links.bytes);
  CHECK(std::get<double>(cell(table, 0, "held")) >= std::get<double>(cell(table, 1, "held")));
}

TEST_CASE("each rank has a row, with what is its own beside its nodes' memories") {
  Rendered rendered(small());
  CHECK(rank_table(account_of(*rendered.report).ranks).rows().empty());
  std::get<svm::Report>(*rendered.report).ranks = {
      {.name = "rank 0 on host a", .memory = {.node_count = 2}, .traffic = {.packets_sent = 5, .packets_received = 7}},
      {.name = "rank 1 on host b",
       .memory = {.node_count = 1, .network = {.outbox_bytes = 2048}},
       .traffic = {.packets_sent = 7, .packets_received = 5, .frames_sent = 3, .bytes_sent = 900}}};
  const Table table = rank_table(account_of(*rendered.report).ranks);
  REQUIRE(table.rows().size() == 2);
  CHECK(std::get<std::string>(cell(table, 1, "rank")) == "rank 1 on host b");
  CHECK(sum(table, "nodes") == 3);
  CHECK(sum(table, "packets sent") == sum(table, "packets received"));
  CHECK(std::get<double>(cell(table, 1, "network memory")) == 2);
  CHECK(std::get<std::uint64_t>(cell(table, 1, "sent")) == 900);
}

}  // namespace dmpc::apps::html::render_tables_test
