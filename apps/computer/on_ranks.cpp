#include "apps/computer/on_ranks.h"

#include <algorithm>
#include <fstream>
#include <iostream>
#include <sstream>

#include "apps/computer/dmpc/computer.h"
#include "apps/frontend/line/number_text.h"
#include "apps/frontend/ranks/parts.h"
#include "apps/frontend/ranks/rank_group.h"
#include "apps/frontend/run/option_words.h"
#include "apps/frontend/system/digest.h"
#include "core/base/expect.h"
#include "nodes/runner.h"

namespace dmpc::apps {
namespace {

/// Returns a digest of this process's executable.
std::uint64_t program_digest() {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  Digest digest;
  digest.add(bytes.view());
  return digest.value();
}

Compatibility program_compatibility() {
  Compatibility compatibility = call_compatibility();
  compatibility.emplace_back("the program", hash_text(program_digest()));
  return compatibility;
}

void choose_nodes(ProgramOptions& options, const RankGroup& group) {
  if (!options.is_node_count_given) {
    options.computer.node_count = std::min(group.default_node_count(), program_nodes_max);
  }
  with_options_named(computer_words, [&] { nodes::check_nodes_for(options.computer.node_count, group.rank_count()); });
}

/// Converts a program's own usage error to ours, which rank 0 sends to the others.
int with_usage_reported(const std::function<int()>& act) {
  try {
    return act();
  } catch (const dmpc::UsageError& error) {
    throw core::UsageError(error.what());
  }
}

}  // namespace

int run_on_ranks(ProgramOptions& options, const ProgramCall& call, const std::function<RankNeeds()>& needs,
                 const std::function<int(RankRounds&)>& act) {
  const RankStart start = {.own = program_compatibility(), .module_of = CompanionOf::own_program};
  return run_as_rank(start, [&](RankGroup& group) {
    choose_nodes(options, group);
    if (group.rank_count() == 1 && !options.quiet) {
      std::cerr << call.name + ": --runner=mpi: this is the only process, so that all nodes are in it\n";
    }
    const RankNeeds own = needs();
    nodes::RankLinks links(group.connect(own.payload_bytes_max, own.alike), {}, group.default_idle(options.computer));
    if (!options.quiet) {
      links.report_to([&call](const std::string& text) { std::cerr << call.name + ": " + text + '\n'; });
    }
    options.computer.ranks = &links;
    RankRounds rounds(links);
    return rounds.is_first() ? lead(links, [&] { return with_usage_reported([&] { return act(rounds); }); })
                             : follow(links, [&] { act(rounds); });
  });
}

}  // namespace dmpc::apps
