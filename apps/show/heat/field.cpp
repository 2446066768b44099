#include "apps/show/heat/field.h"

#include <algorithm>
#include <numeric>
#include <span>
#include <variant>

#include "core/base/expect.h"

namespace dmpc::apps {

namespace {

using core::HeatKind;

constexpr double picoseconds_in_us = 1e6;
constexpr double nanoseconds_in_us = 1e3;

/// Unless these hold, work items move from node to node, or pixels overtake each other.
struct FixedOrder {
  bool of_nodes = false;   ///< every pixel has its node before the start
  bool of_pixels = false;  ///< and a node renders one pixel at a time
};

FixedOrder order_of(const svm::Report& report) {
  const bool alone = report.nodes.size() == 1, stays = alone || report.plan.work_item_side == 0;
  return {stays, alone || (stays && report.plan.in_flight == 1)};
}

FixedOrder order_of(const dataflow::Report&) { return {true, false}; }

bool is_repeatable(HeatKind kind, const RenderRecord& record) {
  const FixedOrder order = std::visit([](const auto& report) { return order_of(report); }, record.report);
  const bool is_modelled = record.options.computer.machine.has_value();
  switch (kind) {
    case HeatKind::faults:
      return is_modelled || order.of_pixels;
    case HeatKind::node:
      return is_modelled || order.of_nodes;
    case HeatKind::time:
    case HeatKind::done:
      return is_modelled;
    default:
      return true;
  }
}

std::vector<double> values_of(HeatKind kind, const RenderRecord& record, const core::Film& film) {
  std::vector<double> values(film.pixel_count());
  const std::span<const std::uint64_t> counts = record.heat->values(kind);
  for (std::uint32_t pixel = 0; pixel < values.size(); ++pixel) {
    const auto count = static_cast<double>(kind == HeatKind::samples ? film.samples(pixel) : counts[pixel]);
    values[pixel] = kind == HeatKind::time   ? count / picoseconds_in_us
                    : kind == HeatKind::done ? count / nanoseconds_in_us
                                             : count;
  }
  return values;
}

}  // namespace

HeatMeaning meaning_of(HeatKind kind, Strategy strategy) {
  switch (kind) {
    case HeatKind::faults:
      return {"pages requested from other nodes", "faults"};
    case HeatKind::references:
      return {"look-ups of pages", "references"};
    case HeatKind::pages:
      return {"different pages looked up", "pages"};
    case HeatKind::rays:
      return {"rays traced", "rays"};
    case HeatKind::time:
      return {"computing", "us"};
    case HeatKind::node:
      return {strategy == Strategy::dataflow ? "node that traced the first ray" : "node that finished the pixel", "number"};
    case HeatKind::depth:
      return {"depth of the deepest ray", "rays"};
    case HeatKind::samples:
      return {"light samples", "samples"};
    case HeatKind::done:
      return {"done, since the start of the run", "us"};
  }
  core::expect(false, "a kind of heat map has a meaning");
  return {};
}

double HeatField::least() const { return *std::min_element(values.begin(), values.end()); }
double HeatField::largest() const { return *std::max_element(values.begin(), values.end()); }
double HeatField::sum() const { return std::accumulate(values.begin(), values.end(), 0.0); }

HeatField heat_field(HeatKind kind, const RenderRecord& record) {
  core::expect(record.heat != nullptr && record.heat->has(kind), "a heat map is shown of what was recorded");
  const Account account = account_of(record.report);
  const HeatMeaning meaning = meaning_of(kind, record.options.strategy);
  const bool is_modelled = record.options.computer.machine.has_value();
  return {.kind = kind,
          .width = account.film.width(),
          .height = account.film.height(),
          .values = values_of(kind, record, account.film),
          .meaning = meaning.text,
          .unit = meaning.unit,
          .clock = kind != HeatKind::time && kind != HeatKind::done ? ""
                   : is_modelled                                    ? "virtual time"
                   : kind == HeatKind::done                         ? "wall clock"
                                                                    : "processor time",
          .is_repeatable = is_repeatable(kind, record)};
}

}  // namespace dmpc::apps
