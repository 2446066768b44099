// The owners of all parts of space, with any partition: one small value that every node holds.
#pragma once

#include <algorithm>
#include <cstdint>
#include <type_traits>
#include <variant>
#include <vector>

#include "dataflow/regions/bsp.h"
#include "dataflow/regions/scattered.h"

namespace dmpc::dataflow {

/// The regions of a run and their owners: every finest cell of the grid lies in exactly one region, and every region belongs to
/// one node, which may have several. As plain bytes copyable to every node.
class Regions {
  template <class Of>
  decltype(auto) ask(const Of& of) const {
    return std::visit(of, how_);
  }

 public:
  /// One per node.
  Regions(const Bsp& bsp) : how_(bsp) {}
  Regions(const Scattered& scattered) : how_(scattered) {}

  std::uint32_t node_count() const {
    return ask([](const auto& how) { return how.node_count(); });
  }
  std::uint32_t region_count() const {
    return ask([](const auto& how) { return how.region_count(); });
  }
  /// In finest cells.
  const core::Corner& grid_size() const {
    return ask([](const auto& how) -> const core::Corner& { return how.grid_size(); });
  }
  /// The region of a finest cell of the grid.
  std::uint32_t region_index_of(const core::Corner& cell) const {
    return ask([&](const auto& how) { return how.region_index_of(cell); });
  }
  /// The region with its box.
  FoundRegion find(const core::Corner& cell) const {
    return ask([&](const auto& how) { return how.find(cell); });
  }
  /// The box of region `index`, in finest cells.
  core::Region region_at(std::uint32_t index) const {
    return ask([&](const auto& how) { return how.region_at(index); });
  }
  /// The owner of region `index`.
  nodes::NodeId owner_at(std::uint32_t index) const {
    return ask([&](const auto& how) { return how.owner_at(index); });
  }
  /// The owner of a finest cell of the grid.
  nodes::NodeId owner_of(const core::Corner& cell) const { return owner_at(region_index_of(cell)); }
  /// The numbers of the regions that each node has, by node, ascending.
  std::vector<std::vector<std::uint32_t>> by_node() const;

  /// Whether region `index` is known to be empty.
  bool is_empty(std::uint32_t index) const {
    return ask([&](const auto& how) { return how.is_empty(index); });
  }
  /// Marks region `index` as empty: rays need not go to its owner.
  void mark_empty(std::uint32_t index) {
    std::visit([&](auto& how) { how.mark_empty(index); }, how_);
  }

  /// Calls visit(axis, at) for the planes that bound regions, in finest cells; some more than once, some at the ends of the grid.
  template <class Visit>
  void for_each_plane(const Visit& visit) const;

  /// Whether regions are units that nodes migrate during the run.
  bool are_moving() const { return bsp() != nullptr && bsp()->is_of_units(); }
  /// These units, as if each were the region of a node of its number. Requires that regions move.
  Regions by_unit() const { return std::get<Bsp>(how_).by_unit(); }
  /// Changes the owner of region `index`, which moves.
  void give_to(std::uint32_t index, nodes::NodeId node) { std::get<Bsp>(how_).give_to(index, node); }

  /// The regions for map_onto(); nullptr if the owners are given by arithmetic.
  Bsp* bsp() { return std::get_if<Bsp>(&how_); }
  const Bsp* bsp() const { return std::get_if<Bsp>(&how_); }

 private:
  std::variant<Bsp, Scattered> how_;
};
static_assert(std::is_trivially_copyable_v<Regions>);
static_assert(sizeof(Scattered) <= sizeof(Bsp), "a node with many regions needs no more room to know who has which");

inline std::vector<std::vector<std::uint32_t>> Regions::by_node() const {
  std::vector<std::vector<std::uint32_t>> of_node(node_count());
  for (std::uint32_t index = 0; index < region_count(); ++index) {
    of_node[nodes::index_of(owner_at(index))].push_back(index);
  }
  return of_node;
}

template <class Visit>
void Regions::for_each_plane(const Visit& visit) const {
  if (const Bsp* const cut = bsp()) {
    for (std::uint32_t index = 0; index + 1 < cut->region_count(); ++index) {
      visit(cut->cut_after(index).axis(), cut->cut_after(index).at());
    }
    return;
  }
  const Scattered& lattice = std::get<Scattered>(how_);
  for (std::size_t along = 0; along < 2; ++along) {
    for (std::uint32_t at = 1; at < lattice.shape().count[along]; ++at) {
      visit(std::size_t{lattice.axes()[along]}, lattice.line(along, at));
    }
  }
}

}  // namespace dmpc::dataflow
