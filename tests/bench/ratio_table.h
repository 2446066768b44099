// What the micro-benchmarks print: a row's time for one item, and its ratio to the first row of its group.
#pragma once

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dmpc::bench {

/// Collects all rows and prints them at the end. With repetitions a time is their median, and the spread is half the distance of
/// their quartiles, in percent of it. Thread safety: none.
class RatioTable final : public benchmark::BenchmarkReporter {
 public:
  /// Prints the date, the machine and its load to stderr.
  bool ReportContext(const Context& context) override;
  /// Takes all repetitions of one row.
  void ReportRuns(const std::vector<Run>& runs) override;
  /// Prints the table to stdout, in the order in which rows were registered.
  void Finalize() override;

 private:
  struct Row {
    std::int64_t place = 0;  ///< among all that are registered
    std::string group, subject;
    double item_ns = 0;
    double spread_percent = 0;
  };

  static Row row_of(const Run& run, std::vector<double> item_ns);
  void print(const Row& row, const Row& reference) const;

  std::vector<Row> rows_;
  std::size_t subject_width_ = 0;
};

}  // namespace dmpc::bench
