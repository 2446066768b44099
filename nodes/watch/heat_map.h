// What each pixel cost, of each kind that is asked for: an instrument beside the computer, whose memory is no node's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dmpc::nodes {

/// What can be shown of a pixel.
enum class HeatKind : std::uint8_t {
  faults,      ///< requests for pages that its rays began
  references,  ///< look-ups of a page, each counted once
  pages,       ///< different pages looked up
  rays,        ///< rays shot
  time,        ///< picoseconds of computing
  node,        ///< number of the node that the pixel belongs to
  depth,       ///< of its deepest ray; 1: a primary ray
  samples      ///< light samples on the film
};
inline constexpr std::array<std::string_view, 8> heat_kind_names = {"faults", "references", "pages", "rays",
                                                                    "time",   "node",       "depth", "samples"};
constexpr std::string_view name_of(HeatKind kind) { return heat_kind_names[static_cast<std::size_t>(kind)]; }

/// A number for each pixel and kind recorded; of other kinds nothing is kept. Thread safety: several nodes may write at a time,
/// even to one pixel; read when none does.
class HeatMap {
 public:
  /// All zero. A kind may stand twice.
  HeatMap(std::uint32_t pixel_count, std::span<const HeatKind> kinds);

  bool has(HeatKind kind) const { return !values(kind).empty(); }
  std::uint32_t pixel_count() const { return pixel_count_; }

  // Of a kind that is not recorded these do nothing. They require pixel < pixel_count().
  void add(HeatKind kind, std::uint32_t pixel, std::uint64_t amount);
  /// To `value` at least.
  void raise(HeatKind kind, std::uint32_t pixel, std::uint64_t value);
  void set(HeatKind kind, std::uint32_t pixel, std::uint64_t value);

  /// By pixel; empty if the kind is not recorded.
  std::span<const std::uint64_t> values(HeatKind kind) const { return values_[static_cast<std::size_t>(kind)]; }
  std::uint64_t sum(HeatKind kind) const;

  /// All numbers, for add() of a map of the same pixels and kinds.
  std::string bytes() const;
  /// Adds what others, on another rank, have written to theirs; of depth and node the larger number stays.
  void add(std::string_view bytes);

 private:
  /// Where the pixel's number stands; nullptr if the kind is not recorded.
  std::uint64_t* place(HeatKind kind, std::uint32_t pixel);

  std::uint32_t pixel_count_;
  std::array<std::vector<std::uint64_t>, heat_kind_names.size()> values_;
};

}  // namespace dmpc::nodes
