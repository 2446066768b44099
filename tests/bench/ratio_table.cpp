#include "tests/bench/ratio_table.h"

#include <algorithm>
#include <iomanip>
#include <iostream>

#include "core/base/expect.h"

namespace dmpc::bench {

bool RatioTable::ReportContext(const Context& context) {
  PrintBasicContext(&GetErrorStream(), context);
  return true;
}

void RatioTable::ReportRuns(const std::vector<Run>& runs) {
  std::vector<double> item_ns;
  for (const Run& run : runs) {
    if (run.run_type == Run::RT_Iteration) {
      item_ns.push_back(1e9 / run.counters.at("items_per_second").value);
    }
  }
  if (!item_ns.empty()) {
    rows_.push_back(row_of(runs.front(), std::move(item_ns)));
    subject_width_ = std::max(subject_width_, rows_.back().subject.size());
  }
}

RatioTable::Row RatioTable::row_of(const Run& run, std::vector<double> item_ns) {
  const std::string& name = run.run_name.function_name;
  const std::size_t slash = name.find('/');
  core::expect(slash != std::string::npos, "a row has a group and a subject");
  std::sort(item_ns.begin(), item_ns.end());
  const std::size_t count = item_ns.size();
  const double median = item_ns[count / 2];
  const double quartile_distance = item_ns[count * 3 / 4] - item_ns[count / 4];
  return {run.family_index, name.substr(0, slash), name.substr(slash + 1), median, 50 * quartile_distance / median};
}

void RatioTable::Finalize() {
  std::sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.place < b.place; });
  const Row* reference = nullptr;
  for (const Row& row : rows_) {
    if (reference == nullptr || reference->group != row.group) {
      reference = &row;
      GetOutputStream() << '\n' << row.group << '\n';
    }
    print(row, *reference);
  }
}

void RatioTable::print(const Row& row, const Row& reference) const {
  GetOutputStream() << "  " << std::left << std::setw(static_cast<int>(subject_width_)) << row.subject << std::right << std::fixed
                    << std::setprecision(2) << std::setw(12) << row.item_ns << " ns" << std::setprecision(0) << std::setw(6)
                    << row.spread_percent << " %" << std::setprecision(2) << std::setw(8) << row.item_ns / reference.item_ns
                    << '\n';
}

}  // namespace dmpc::bench
