// The observations of a render: rank 0 sets its observers by them, and sends them to the other ranks.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/frontend/run/miss_estimate.h"
#include "apps/run/render_options.h"
#include "core/picture/heat_kind.h"
#include "nodes/observers/activity_profile.h"
#include "nodes/observers/exchange_profile.h"
#include "nodes/observers/trace.h"
#include "svm/pages/home.h"

namespace dmpc::apps {

struct ObserverOrder {
  std::uint32_t node_count = 0, page_count = 0, pixel_count = 0;  ///< sizes of computer, database and picture
  std::vector<core::HeatKind> heat_kinds = {};                    ///< empty: no heat map
  std::optional<nodes::TraceChoice> trace = {};                   ///< a rank's share of the events
  bool has_profile = false;
  nodes::WaitOf wait_of = {};  ///< for the profile
  // Only for modelled machines, which have no ranks: not sent to other ranks.
  bool follows_paths = false;  ///< records the critical path to the end of each wait
  std::optional<nodes::ExchangeChoice> exchange = {};
  std::optional<svm::PageHomes> fetches = {};      ///< homes of the pages that are fetched
  std::optional<std::size_t> references_max = {};  ///< per node
  bool has_all_references = false;                 ///< for a file: none is dropped

  bool is_empty() const { return heat_kinds.empty() && !trace && !has_profile && !fetches && !references_max; }
};

/// The observations for the options. `references_max`: approximate number recorded on all nodes together.
ObserverOrder observer_order(const RenderOptions& options, std::uint32_t page_count, std::uint32_t pixel_count,
                             std::size_t references_max = references_usual);

/// Conversion to bytes and back.
std::string bytes_of(const ObserverOrder& order);
ObserverOrder observer_order_from(std::string_view bytes);

}  // namespace dmpc::apps
