#include "apps/render/ranks.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>

#include "apps/edge/ranks/parts.h"
#include "apps/edge/run/computer_room.h"
#include "apps/edge/run/option_words.h"
#include "apps/render/onlookers.h"
#include "apps/render/watch_order.h"
#include "dataflow/packets.h"
#include "dataflow/ranks.h"
#include "nodes/ranks/repeated_runs.h"
#include "nodes/runner.h"
#include "svm/forest/strategy.h"
#include "svm/packets.h"
#include "svm/ranks.h"

namespace dmpc::apps {

namespace {

/// What another rank has for its part of a run, in which `onlookers` are as soon as rank 0 has said what they are to see.
svm::Following following_for(std::optional<Onlookers>& onlookers) {
  svm::Following following;
  following.check_room = [](const nodes::RankMemory& memory) { check_room(memory); };
  following.watch = [&onlookers](std::string_view order) { return onlookers.emplace(watch_order_from(order)).watching(); };
  following.watch_again = [&onlookers] { onlookers->begin_again(); };
  following.seen = [&onlookers] { return onlookers->seen(); };
  following.strategies.push_back(svm::forest_strategy());
  following.reference_logs = [&onlookers] { return onlookers->reference_logs(); };
  return following;
}

/// Any other rank's part of a run.
void take_part(nodes::RankLinks& links, Strategy strategy, const std::stop_token& stop) {
  std::optional<Onlookers> onlookers;
  const svm::Following following = following_for(onlookers);
  if (strategy == Strategy::dataflow) {
    dataflow::follow(links, stop, following);
  } else {
    svm::follow(links, stop, following);
  }
}

}  // namespace

std::size_t payload_bytes_max(const RenderOptions& options) {
  const std::size_t page_bytes = options.database.build.page_size_bytes;
  if (options.strategy != Strategy::dataflow) {
    return svm::page_reply_bytes(page_bytes);
  }
  const std::size_t ray_bytes = dataflow::ray_packet_bytes(options.rays.ray_batch.value_or(1), options.rays.tested_objects);
  const bool is_moving = options.rays.balance.balance == dataflow::Balance::moving;
  return std::max(ray_bytes, is_moving ? sizeof(dataflow::UnitPageHeader) + page_bytes : 0);
}

void check_nodes_on_ranks(const RenderOptions& options, std::uint32_t rank_count) {
  with_options_named(computer_words, [&] { nodes::check_nodes_for(options.computer.node_count, rank_count); });
}

int render_as_rank(nodes::Fabric& fabric, const RenderOptions& options, const RenderOnRanks& render,
                   const std::stop_token& stop) {
  nodes::RankLinks links(fabric, {.longest = std::chrono::seconds(options.runner.patience_seconds)}, options.runner.idle);
  if (!options.quiet) {
    links.tell_to([](const std::string& text) { std::cerr << "dmpc: " + text + '\n'; });
  }
  return links.rank() == 0 ? lead(links, [&] { return render(links); })
                           : follow(links, [&] { take_part(links, options.strategy, stop); });
}

}  // namespace dmpc::apps
