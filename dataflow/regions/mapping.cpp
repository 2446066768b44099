#include "dataflow/regions/mapping.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "core/base/expect.h"
#include "core/base/sampling.h"

namespace dmpc::dataflow {
namespace {

/// The flows of each region, in both directions.
class Neighbours {
 public:
  struct Entry {
    std::uint32_t region;
    std::int64_t amount;
  };

  Neighbours(std::span<const Flow> flows, std::uint32_t region_count) : of_(region_count) {
    for (const Flow& flow : flows) {
      core::expect(flow.first < region_count && flow.second < region_count && flow.first != flow.second,
                   "a flow goes between two regions");
      const auto amount = static_cast<std::int64_t>(flow.amount);
      of_[flow.first].push_back({flow.second, amount});
      of_[flow.second].push_back({flow.first, amount});
    }
  }
  std::span<const Entry> of(std::uint32_t region) const { return of_[region]; }

 private:
  std::vector<std::vector<Entry>> of_;
};

std::uint32_t hops(const nodes::Topology& topology, std::uint32_t a, std::uint32_t b) {
  return topology.hops(nodes::NodeId{a}, nodes::NodeId{b});
}

/// A table of the hops between any two nodes, since descents look them up millions of times.
class HopTable {
 public:
  explicit HopTable(const nodes::Topology& topology) : node_count_(topology.node_count()) {
    hops_.resize(std::size_t{node_count_} * node_count_);
    for (std::uint32_t a = 0; a < node_count_; ++a) {
      for (std::uint32_t b = 0; b < a; ++b) {
        hops_[at(a, b)] = hops_[at(b, a)] =
            static_cast<std::uint16_t>(hops(topology, a, b));  // up to region_count_max nodes the distance fits
      }
    }
  }
  /// The distances from `node` to all nodes.
  const std::uint16_t* from(std::uint32_t node) const { return hops_.data() + at(node, 0); }

 private:
  std::size_t at(std::uint32_t from, std::uint32_t to) const { return std::size_t{from} * node_count_ + to; }

  std::uint32_t node_count_;
  std::vector<std::uint16_t> hops_;
};

/// Exchanges two regions' nodes as long as that helps: goes through all pairs in order, again and again. Of most pairs it is
/// known beforehand that it does not. (1) Neither they nor their neighbours have moved since the pair was examined. (2) Let d be
/// the hops between the nodes of a and b, and a region's cost the sum of amount * hops over its flows. On b's node a's neighbours
/// would be one hop away or more, and one that is h hops away now at least d - h (triangle inequality): so a saves at most cost -
/// amount, and at most 2 * cost - amount * d. (Flows between a and b, whose hops stay, only make this less.)
class Descent {
 public:
  Descent(Mapping& mapping, const Neighbours& neighbours, const HopTable& hops)
      : mapping_(mapping), neighbours_(neighbours), hops_(hops), flow_(mapping.size()), changed_(mapping.size()) {
    for (std::uint32_t region = 0; region < mapping.size(); ++region) {
      add_up(region);
    }
  }

  /// Terminates, since every exchange decreases an integer sum.
  void run() {
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (std::uint32_t a = 0; a < count(); ++a, ++now_) {
        new_since_ = now_ - std::min<std::uint64_t>(now_, count());
        for (std::uint32_t b = next_new(a, a + 1); b < count(); b = next_new(a, b + 1)) {
          if (may_help(a, b) && helps(a, b)) {
            exchange(a, b);
            has_changed = true;
          }
        }
      }
    }
  }

 private:
  /// The sums over a region's flows.
  struct Flown {
    std::int64_t amount = 0, cost = 0;

    std::int64_t saved_most(std::int64_t hops) const { return std::min(cost - amount, 2 * cost - amount * hops); }
  };

  std::uint32_t count() const { return static_cast<std::uint32_t>(mapping_.size()); }

  /// Whether the region or a neighbour has moved since it was examined with the same one in the round before.
  bool is_new(std::uint32_t region) const { return changed_[region] >= new_since_; }
  /// The first region from `b` on that makes a new pair with a.
  std::uint32_t next_new(std::uint32_t a, std::uint32_t b) const {
    if (is_new(a)) {
      return b;
    }
    const auto from = changed_.begin() + b;
    return b + static_cast<std::uint32_t>(
                   std::find_if(from, changed_.end(), [this](std::uint64_t when) { return when >= new_since_; }) - from);
  }

  std::int64_t hops_between(std::uint32_t a, std::uint32_t b) const { return hops_.from(mapping_[a])[mapping_[b]]; }
  bool may_help(std::uint32_t a, std::uint32_t b) const {
    const std::int64_t hops = hops_between(a, b);
    return flow_[a].saved_most(hops) + flow_[b].saved_most(hops) > 0;
  }
  bool helps(std::uint32_t a, std::uint32_t b) const {
    const Flown at_b = flown_at(mapping_[b], a, b), at_a = flown_at(mapping_[a], b, a);
    const std::int64_t between = (flow_[a].amount - at_b.amount) * hops_between(a, b);
    return at_b.cost + at_a.cost < flow_[a].cost + flow_[b].cost - 2 * between;
  }

  /// The sums if the region were on `node`, without its flows to `other`.
  Flown flown_at(std::uint32_t node, std::uint32_t region, std::uint32_t other) const {
    const std::uint16_t* const hops_to = hops_.from(node);
    Flown sum;
    for (const auto& [neighbour, amount] : neighbours_.of(region)) {
      const std::int64_t counted = neighbour == other ? 0 : amount;
      sum.amount += counted;
      sum.cost += counted * hops_to[mapping_[neighbour]];
    }
    return sum;
  }

  void exchange(std::uint32_t a, std::uint32_t b) {
    std::swap(mapping_[a], mapping_[b]);
    for (const std::uint32_t moved : {a, b}) {
      note_change(moved);
      for (const Neighbours::Entry& entry : neighbours_.of(moved)) {
        note_change(entry.region);
      }
    }
  }
  void note_change(std::uint32_t region) {
    changed_[region] = now_;
    add_up(region);
  }
  void add_up(std::uint32_t region) { flow_[region] = flown_at(mapping_[region], region, region); }

  Mapping& mapping_;
  const Neighbours& neighbours_;
  const HopTable& hops_;
  std::vector<Flown> flow_;             ///< by region
  std::vector<std::uint64_t> changed_;  ///< by region: when it or a neighbour moved last
  std::uint64_t now_ = 0;               ///< counts the regions a of all rounds
  std::uint64_t new_since_ = 0;         ///< when the same region was a in the round before
};

/// The number of descents and their starting points, the most promising first.
std::uint64_t beginning_count(std::uint32_t region_count) {
  constexpr std::uint32_t random_regions_max = 128;  // with more regions each descent takes tenths of a second
  constexpr std::uint64_t random_count = 24;
  return region_count <= random_regions_max ? 2 + random_count : 2;
}

Mapping beginning(const Bsp& bsp, std::uint64_t index) {
  return index == 0   ? gray_mapping(bsp)
         : index == 1 ? identity_mapping(bsp.region_count())
                      : random_mapping(bsp.region_count(), index - 2);
}

std::uint64_t total_hops(const Mapping& mapping, std::span<const Flow> flows, const nodes::Topology& topology) {
  std::uint64_t sum = 0;
  for (const Flow& flow : flows) {
    sum += flow.amount * hops(topology, mapping[flow.first], mapping[flow.second]);
  }
  return sum;
}

std::uint64_t total_amount(std::span<const Flow> flows) {
  return std::accumulate(flows.begin(), flows.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Flow& flow) { return sum + flow.amount; });
}

}  // namespace

std::vector<Flow> flows_of(std::span<const Boundary> boundaries) {
  std::vector<Flow> flows;
  for (const Boundary& boundary : boundaries) {
    flows.push_back({boundary.low, boundary.high, static_cast<std::uint64_t>(boundary.length_cells)});
  }
  return flows;
}

double mean_hops(const Mapping& mapping, std::span<const Flow> flows, const nodes::Topology& topology) {
  const std::uint64_t amount = total_amount(flows);
  return amount > 0 ? static_cast<double>(total_hops(mapping, flows, topology)) / static_cast<double>(amount) : 0.0;
}

double mean_hops_of_random(std::span<const Flow> flows, const nodes::Topology& topology, std::uint32_t mapping_count) {
  core::expect(mapping_count > 0, "a mean is of one mapping or more");
  double sum = 0;
  for (std::uint32_t seed = 0; seed < mapping_count; ++seed) {
    sum += mean_hops(random_mapping(topology.node_count(), seed), flows, topology);
  }
  return sum / mapping_count;
}

Mapping map_regions(const Bsp& bsp, std::span<const Flow> flows, const nodes::Topology& topology) {
  core::expect(topology.node_count() == bsp.region_count(), "there are as many nodes as regions");
  const Neighbours neighbours(flows, bsp.region_count());
  const std::uint64_t least_hops = total_amount(flows);  // one hop for each, since every region has a node of its own
  std::optional<HopTable> hops;
  Mapping best;
  std::uint64_t best_hops = std::numeric_limits<std::uint64_t>::max();
  for (std::uint64_t index = 0; index < beginning_count(bsp.region_count()) && best_hops > least_hops; ++index) {
    Mapping mapping = beginning(bsp, index);
    if (total_hops(mapping, flows, topology) > least_hops) {
      Descent(mapping, neighbours, hops ? *hops : hops.emplace(topology)).run();
    }
    if (const std::uint64_t found_hops = total_hops(mapping, flows, topology); found_hops < best_hops) {
      best = std::move(mapping);
      best_hops = found_hops;
    }
  }
  return best;
}

Mapping gray_mapping(const Bsp& bsp) {
  Mapping mapping = identity_mapping(bsp.region_count());
  if (!std::has_single_bit(bsp.region_count())) {
    return mapping;
  }
  for (std::uint32_t region = 0; region < bsp.region_count(); ++region) {
    std::uint32_t code = 0;
    std::array<bool, 3> was_high{};  // along each axis, at the previous cut
    bsp.for_each_cut(region, [&](Bsp::Cut cut, bool is_high) {
      bool& before = was_high[cut.axis()];
      code = 2 * code + (is_high != before ? 1U : 0U);
      before = is_high;
    });
    mapping[region] = code;
  }
  return mapping;
}

void map_onto(Bsp& bsp, nodes::TopologyKind kind, const CutAxes& axes) {
  const Bsp whole = bsp.without_units();
  const std::vector<Flow> flows = flows_of(boundaries_of(whole, axes));
  bsp.assign(map_regions(whole, flows, nodes::Topology(kind, whole.region_count())));
}

Mapping identity_mapping(std::uint32_t region_count) {
  Mapping mapping(region_count);
  std::iota(mapping.begin(), mapping.end(), 0U);
  return mapping;
}

Mapping random_mapping(std::uint32_t region_count, std::uint64_t seed) {
  Mapping mapping = identity_mapping(region_count);
  // R. Durstenfeld, "Algorithm 235: Random permutation", 1964.
  for (std::uint32_t left = region_count; left > 1; --left) {
    const std::uint64_t draw = core::mix(core::mix(seed) + left);
    std::swap(mapping[left - 1], mapping[static_cast<std::uint32_t>(draw % left)]);
  }
  return mapping;
}

}  // namespace dmpc::dataflow
