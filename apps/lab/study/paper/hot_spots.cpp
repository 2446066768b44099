#include "apps/lab/study/paper/hot_spots.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "core/base/ranges.h"
#include "core/record/records.h"
#include "svm/packets.h"

namespace dmpc::apps {
namespace {

/// 0 / 0 counts as 0.
double over_mean(std::uint64_t one, const std::vector<std::uint64_t>& all) {
  const auto sum = static_cast<double>(std::accumulate(all.begin(), all.end(), std::uint64_t{0}));
  return sum == 0 ? 0 : static_cast<double>(one) * static_cast<double>(all.size()) / sum;
}

}  // namespace

core::Corner cell_of_light(const core::DatabaseHeader& header, const core::LightRecord& light) {
  const core::GridFrame& frame = header.frame;
  const core::Corner size = core::grid_size(frame);
  core::Corner cell{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double at = (double{light.position[axis]} - frame.low[axis]) / double{frame.finest_cell};
    cell[axis] = static_cast<std::int32_t>(std::clamp(std::floor(at), 0.0, static_cast<double>(size[axis] - 1)));
  }
  return cell;
}

double shadow_flood(const core::Database& database, const dataflow::Report& report) {
  const std::vector<std::uint64_t> received = core::mapped<std::uint64_t>(report.nodes, [&](const dataflow::NodeReport& node) {
    return node.program.rays.in[static_cast<std::size_t>(core::RayKind::shadow)];
  });
  const core::LocalRecords records(database.bytes());
  const core::DatabaseHeader& header = database.header();
  double most = 0;
  for (std::uint32_t i = 0; i < header.light_count; ++i) {
    const auto light = core::read<core::LightRecord>(records.find(core::advance(header.lights, i * sizeof(core::LightRecord))));
    const nodes::NodeId owner = report.regions.owner_of(cell_of_light(header, light));
    most = std::max(most, over_mean(received[nodes::index_of(owner)], received));
  }
  return most;
}

double page_flood(const svm::Report& report) {
  std::vector<std::uint64_t> sent;
  for (const svm::NodeReport& node : report.nodes) {
    sent.push_back(node.counters.sent[svm::number_of(svm::Kind::page_reply)].packets);
  }
  return over_mean(*std::max_element(sent.begin(), sent.end()), sent);
}

}  // namespace dmpc::apps
