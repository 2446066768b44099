// The micro-benchmarks: what the innermost parts cost, beside others that do the same.
#include "tests/bench/groups.h"
#include "tests/bench/ratio_table.h"

int main(int argument_count, char** arguments) {
  using namespace dmpc::bench;
  benchmark::Initialize(&argument_count, arguments);
  if (benchmark::ReportUnrecognizedArguments(argument_count, arguments)) {
    return 2;
  }
  add_pager_rows();
  add_mailbox_rows();
  add_virtual_runner_rows();
  RatioTable table;
  const bool has_run = benchmark::RunSpecifiedBenchmarks(&table) > 0;
  benchmark::Shutdown();
  return has_run ? 0 : 1;
}
