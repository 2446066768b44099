#include "apps/study_speedup.h"

#include <array>
#include <utility>

#include "apps/report.h"
#include "apps/stats.h"
#include "dataflow/run.h"
#include "svm/run.h"

namespace dmpc::apps {
namespace {

/// One pixel in flight, as on the machines of the 1994 article.
Report run_on(StudyRuns& runs, const SpeedupStudy& study, std::uint32_t node_count) {
  const std::string computer = std::to_string(node_count) + " nodes of " + study.machine.name;
  if (study.strategy == SpeedupStrategy::dataflow) {
    return runs.run(computer,
                    dataflow::RunOptions{.node_count = node_count, .topology = study.machine.topology, .machine = study.machine});
  }
  return runs.run(computer, svm::RunOptions{.node_count = node_count, .in_flight = 1, .machine = study.machine});
}

}  // namespace

std::vector<Column> SpeedupStudy::columns() const {
  std::vector<Column> columns = {{"nodes"}, {"virtual time", "s", 3}, {"speedup", "", 2}, {"efficiency", "%", 1}};
  for (const char* part : time_part_names) {
    columns.push_back({part, "%", 1});
  }
  columns.push_back({"link wait", "s", 3});
  columns.push_back({"run hash"});
  return columns;
}

void SpeedupStudy::measure(StudyRuns& runs, Table& table) const {
  double first = 0;  // node-seconds of the first run
  for (const std::uint32_t node_count : node_counts) {
    const Report report = run_on(runs, *this, node_count);
    const Account account = account_of(report);
    const nodes::VirtualReport& time = *account.virtual_time;
    const double seconds = 1e-9 * static_cast<double>(time.total_ns);
    first = table.rows().empty() ? seconds * node_count : first;
    const double efficiency = seconds == 0 ? 1 : first / (seconds * node_count);
    std::vector<Cell> row = {std::uint64_t{node_count}, seconds, efficiency * node_count, 100 * efficiency};
    for (const double percent : parts_of(sum_of_nodes(time), account.waits).percent()) {
      row.emplace_back(percent);
    }
    row.emplace_back(1e-9 * static_cast<double>(time.links.wait_ns));
    row.emplace_back(hash_text(time.hash));
    table.add_row(std::move(row));
  }
}

std::vector<std::string> SpeedupStudy::notes(const std::string&) const {
  return {"Virtual time on the modelled machine " + machine.name + ", strategy " +
              (strategy == SpeedupStrategy::svm ? "svm, one pixel in flight." : "dataflow, regions by the subsampled picture."),
          "Speedup and efficiency are held against the first row's node-seconds. The parts of a row add up to 100 %.",
          "Link wait: that messages stood before links that others held, summed over all messages."};
}

}  // namespace dmpc::apps
