// Tasks that look up one number each, on ranks that part, fail or take their time: what tests start there.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>

#include "apps/computer/dmpc/pages.h"

namespace {

enum Fault : std::uint32_t {
  none,
  runs_less,
  runs_more,
  has_other_data,
  acts_badly,
  fails_in_task,
  takes_its_time,
  is_used_wrongly
};

/// The number at its own place.
struct LookUp {
  std::uint32_t number = 0, value = 0;
  bool is_to_fail = false;

  dmpc::Step run(dmpc::Pages& pages) {
    if (is_to_fail) {
      throw std::runtime_error("task " + std::to_string(number) + " fails");
    }
    return pages.read(std::uint64_t{number} * sizeof(value), value) ? dmpc::Step::finished : dmpc::Step::absent;
  }
  std::uint32_t result() const { return value; }
};

bool is_on_rank(int number) {
  const char* const rank = std::getenv("OMPI_COMM_WORLD_RANK");
  return rank != nullptr && rank == std::to_string(number);
}

}  // namespace

int main(int count, char** words) {
  std::uint32_t tasks = 1000, rounds = 3, fault = none;
  const auto act = [&](dmpc::PagedComputer& computer) {
    const bool is_faulty = is_on_rank(1);
    const std::uint32_t own_rounds =
        rounds - (is_faulty && fault == runs_less ? 1 : 0) + (is_faulty && fault == runs_more ? 1 : 0);
    if (is_faulty && fault == acts_badly) {
      throw std::runtime_error("this rank cannot go on");
    }
    if (fault == is_used_wrongly) {  // on rank 0 last
      std::this_thread::sleep_for(std::chrono::milliseconds(is_on_rank(0) ? 300 : 0));
      throw dmpc::UsageError("--fault=7: no such use");
    }
    std::vector<std::uint32_t> values(tasks, 1);
    for (std::uint32_t round = 0; round < own_rounds; ++round) {
      values.back() += is_faulty && fault == has_other_data && round == 1 ? 1 : 0;
      const auto make = [&](std::uint32_t number) { return LookUp{number, 0, fault == fails_in_task && number == tasks / 2}; };
      values = computer.run(std::span<const std::uint32_t>(values), tasks, make);
      std::transform(values.begin(), values.end(), values.begin(), [](std::uint32_t value) { return 2 * value; });
      std::this_thread::sleep_for(std::chrono::milliseconds(fault == takes_its_time ? (is_faulty ? 300 : 50) : 0));
    }
    return "sum " + std::to_string(std::accumulate(values.begin(), values.end(), std::uint64_t{0}));
  };
  return dmpc::run_tasks(count, words,
                         {.description = "Look up numbers, and double them",
                          .options = {{"--tasks", &tasks, 1, 10'000'000, "A number each"},
                                      {"--rounds", &rounds, 1, 1000, "How often"},
                                      {"--fault", &fault, none, is_used_wrongly, "What rank 1 does otherwise"}},
                          .act = act});
}
