#include "apps/render/ranks.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>

#include "apps/frontend/ranks/parts.h"
#include "apps/frontend/run/computer_capacity.h"
#include "apps/frontend/run/option_words.h"
#include "apps/render/observer_order.h"
#include "apps/render/observers.h"
#include "dataflow/packets.h"
#include "dataflow/ranks.h"
#include "nodes/ranks/repeated_runs.h"
#include "nodes/runner.h"
#include "svm/forest/strategy.h"
#include "svm/packets.h"
#include "svm/ranks.h"

namespace dmpc::apps {

namespace {

/// What another rank has for its part of a run, in which `observers` are as soon as rank 0 has said what they are to see.
svm::WorkerCallbacks following_for(std::optional<Observers>& observers) {
  svm::WorkerCallbacks callbacks;
  callbacks.check_room = [](const nodes::RankMemory& memory) { check_room(memory); };
  callbacks.watch = [&observers](std::string_view order) { return observers.emplace(observer_order_from(order)).watching(); };
  callbacks.watch_again = [&observers] { observers->begin_again(); };
  callbacks.seen = [&observers] { return observers->seen(); };
  callbacks.strategies.push_back(svm::forest_strategy());
  callbacks.reference_logs = [&observers] { return observers->reference_logs(); };
  return callbacks;
}

/// Any other rank's part of a run.
void take_part(nodes::RankLinks& links, Strategy strategy, const std::stop_token& stop) {
  std::optional<Observers> observers;
  const svm::WorkerCallbacks callbacks = following_for(observers);
  if (strategy == Strategy::dataflow) {
    dataflow::follow(links, stop, callbacks);
  } else {
    svm::follow(links, stop, callbacks);
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
  nodes::RankLinks links(fabric, {.longest = std::chrono::seconds(options.runner.timeout_seconds)}, options.runner.idle);
  if (!options.quiet) {
    links.report_to([](const std::string& text) { std::cerr << "dmpc: " + text + '\n'; });
  }
  return links.rank() == 0 ? lead(links, [&] { return render(links); })
                           : follow(links, [&] { take_part(links, options.strategy, stop); });
}

}  // namespace dmpc::apps
