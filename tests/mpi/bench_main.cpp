// What two ranks cost: half a round trip of a short frame, and the processor time of a rank that has nothing to do. To be started
// by mpirun -n 2; prints two lines.
//   mpi_bench [SECONDS]     how long a rank has nothing to do; 3 if it is not said
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "apps/frontend/line/number_text.h"
#include "apps/frontend/ranks/mpi_library.h"
#include "apps/frontend/ranks/rank_group.h"
#include "nodes/ranks/ranks_runner.h"
#include "tests/nodes/toy_machine.h"

namespace dmpc::tests {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr std::size_t ping_bytes = 64;
constexpr int rounds = 2'000;

/// As the other rank does as soon as a frame has come.
void send_one(nodes::Fabric& fabric) {
  while (fabric.room(1 - fabric.rank()).empty()) {
  }
  fabric.send(1 - fabric.rank(), ping_bytes);
}

void take_one(nodes::Fabric& fabric) {
  while (!fabric.take()) {
  }
}

/// The median, on rank 0.
double half_round_trip_us(nodes::Fabric& fabric) {
  std::vector<double> times_us;
  for (int round = 0; round < rounds; ++round) {
    const Clock::time_point start = Clock::now();
    if (fabric.rank() == 0) {
      send_one(fabric);
      take_one(fabric);
    } else {
      take_one(fabric);
      send_one(fabric);
    }
    times_us.push_back(1e6 * Seconds(Clock::now() - start).count() / 2);
  }
  std::nth_element(times_us.begin(), times_us.begin() + rounds / 2, times_us.end());
  return times_us[rounds / 2];
}

double processor_seconds() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Works for so long, then is finished.
class WorksFor : public ToyProgram {
 public:
  WorksFor(nodes::Node& node, double seconds)
      : ToyProgram(node), end_(Clock::now() + std::chrono::duration_cast<Clock::duration>(Seconds(seconds))) {}
  bool work() override { return !finished(); }
  bool finished() const override { return Clock::now() > end_; }

 private:
  Clock::time_point end_;
};

/// The share of a core that each rank takes, by rank, while a node of rank 0 works and all others sleep.
std::vector<double> shares_of_core(nodes::Fabric& fabric, double seconds) {
  auto specifications = equal_nodes(5, {}, making<ToyProgram>());
  specifications[0].make_program = making<WorksFor>(seconds);
  nodes::RankLinks links(fabric);
  nodes::RanksRunner runner(specifications, links);
  const double before = processor_seconds();
  const Clock::time_point start = Clock::now();
  runner.run({});
  const double share = (processor_seconds() - before) / Seconds(Clock::now() - start).count();
  std::vector<double> shares;
  for (const std::string& text : apps::mpi_library().exchange(std::to_string(share))) {
    shares.push_back(std::stod(text));
  }
  return shares;
}

int measure(apps::RankGroup& group, double seconds) {
  if (group.rank_count() != 2) {
    throw core::UsageError("mpi_bench measures two ranks: start it by mpirun -n 2");
  }
  nodes::Fabric& fabric = group.connect(1);
  const double trip_us = half_round_trip_us(fabric);
  apps::mpi_library().exchange("");
  const std::vector<double> shares = shares_of_core(fabric, seconds);
  if (group.rank() == 0) {
    std::cout << "half a round trip of " << ping_bytes << " B: " << apps::fixed(trip_us, 2) << " us\n"
              << "a rank with nothing to do takes " << apps::percent_text(100 * shares[1]) << " of a core\n";
  }
  return 0;
}

}  // namespace

}  // namespace dmpc::tests

int main(int count, char** values) {
  using namespace dmpc;
  int status = 1;
  try {
    const double seconds = count > 1 ? std::strtod(values[1], nullptr) : 3;
    status = apps::run_as_rank({.own = apps::build_compatibility()},
                               [seconds](apps::RankGroup& group) { return tests::measure(group, seconds); });
  } catch (const std::exception& error) {
    std::cerr << "mpi_bench: " << error.what() << std::endl;
  }
  apps::end_ranks(status);
  return status;
}
