#include "apps/lab/bench/speed/plain_contender.h"

#include <algorithm>
#include <array>

#include "apps/run/run_strategy.h"
#include "core/base/expect.h"

namespace dmpc::apps {
namespace {

using Kind = RunnerKind;
using S = Strategy;
constexpr std::nullopt_t no_strategy = std::nullopt;

constexpr std::array<PlainContender, 18> contenders = {
    {{"plain on 2 threads", 2},
     {"plain on 1 thread", 1},
     {"packets on 2 threads", 2, no_strategy, Kind::threads, PlainKind::packets},
     {"packets, not robust, on 2 threads", 2, no_strategy, Kind::threads, PlainKind::fast_packets},
     {"svm on 1 node", 1, S::svm},
     {"svm on 2 nodes", 2, S::svm},
     {"svm on 2 nodes, pool", 2, S::svm, Kind::pool},
     {"svm on 8 nodes", 8, S::svm},
     {"svm on 64 nodes", 64, S::svm},
     {"svm on 64 nodes, pool", 64, S::svm, Kind::pool},
     {"dataflow on 2 nodes", 2, S::dataflow},
     {"dataflow on 2 nodes, pool", 2, S::dataflow, Kind::pool},
     {"dataflow on 64 nodes", 64, S::dataflow},
     {"dataflow on 64 nodes, pool", 64, S::dataflow, Kind::pool},
     {"forest on 8 nodes", 8, S::forest},
     {"forest on 8 nodes, pool", 8, S::forest, Kind::pool},
     {"replicated on 2 nodes", 2, S::replicated},
     {"svm on 64 nodes, virtual", 64, S::svm, Kind::virtual_time}}};

constexpr std::array<PlainContender, 5> commands = {{{"svm on 1 node", 1, S::svm},
                                                     {"svm on 2 nodes", 2, S::svm},
                                                     {"svm on 64 nodes", 64, S::svm},
                                                     {"svm on 64 nodes, pool", 64, S::svm, Kind::pool},
                                                     {"dataflow on 64 nodes, pool", 64, S::dataflow, Kind::pool}}};

constexpr std::array<PlainPair, 7> all_pairs = {{{"svm on 1 node", "svm on 2 nodes"},
                                                 {"svm on 64 nodes", "svm on 2 nodes"},
                                                 {"svm on 64 nodes, pool", "svm on 2 nodes, pool"},
                                                 {"dataflow on 2 nodes", "svm on 2 nodes"},
                                                 {"dataflow on 2 nodes, pool", "svm on 2 nodes, pool"},
                                                 {"dataflow on 64 nodes", "svm on 64 nodes"},
                                                 {"dataflow on 64 nodes, pool", "svm on 64 nodes, pool"}}};

}  // namespace

std::span<const PlainContender> plain_contenders() { return contenders; }
std::span<const PlainContender> command_contenders() { return commands; }
std::span<const PlainPair> plain_pairs() { return all_pairs; }

const PlainContender& contender_named(const std::string& name) {
  const auto found = std::find_if(contenders.begin(), contenders.end(), [&](const auto& one) { return one.name == name; });
  core::expect(found != contenders.end(), "a contender has this name");
  return *found;
}

StrategyOptions strategy_of(const PlainContender& contender) {
  StrategyOptions options{.strategy = *contender.strategy, .computer = {.node_count = contender.count}};
  options.runner.kind = contender.runner;
  choose_pool(contender.runner, options.computer);
  if (contender.runner == RunnerKind::virtual_time) {
    choose_machine(options);
  }
  return options;
}

std::vector<std::string> command_of(const PlainContender& contender, const std::string& scene, const Resolution& size,
                                    const std::filesystem::path& file) {
  return {"render",
          scene,
          "--quiet",
          "--samples=1",
          std::string("--strategy=") + name_of(*contender.strategy),
          std::string("--runner=") + name_of(contender.runner),
          "--nodes=" + std::to_string(contender.count),
          "--resolution=" + std::to_string(size.width) + "x" + std::to_string(size.height),
          "-o",
          file.string()};
}

}  // namespace dmpc::apps
