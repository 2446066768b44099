#include "nodes/chaos.h"

#include "core/base/expect.h"

namespace dmpc::nodes {
namespace {

/// What a stream is for; streams with different purposes are independent.
enum class Purpose : std::uint64_t { settings, credits, slow_link, slow_node, delays, pauses };

constexpr ChaosStream stream(std::uint64_t seed, Purpose purpose, std::uint32_t first = 0, std::uint32_t second = 0) {
  const std::uint64_t of_purpose = core::mix(seed + 0x9e3779b97f4a7c15ULL) + static_cast<std::uint64_t>(purpose);
  return ChaosStream(core::mix(core::mix(of_purpose) + (std::uint64_t{first} << 32U | second)));
}

}  // namespace

Chaos chaos_of(std::uint64_t seed) {
  ChaosStream draws = stream(seed, Purpose::settings);
  return {.seed = seed,
          .held_percent = 1 + draws.below(100),
          .delay_quanta_max = 1U << draws.below(8),
          .slow_link_percent = draws.below(51),
          .slow_link_factor = 2U << draws.below(4),
          .slow_node_percent = draws.below(51),
          .idle_quanta_max = 1U << draws.below(7),
          .shrinks_credits = draws.chance(75)};
}

std::uint32_t shrunk_credits(const Chaos& chaos, std::uint32_t planned, std::uint32_t kind) {
  if (!chaos.shrinks_credits || planned == 0) {
    return planned;
  }
  ChaosStream draws = stream(chaos.seed, Purpose::credits, kind);
  const std::uint32_t limit = 1 + draws.below(planned);
  return 1 + draws.below(limit);
}

bool is_slow_link(const Chaos& chaos, NodeId source, NodeId target) {
  return stream(chaos.seed, Purpose::slow_link, index_of(source), index_of(target)).chance(chaos.slow_link_percent);
}

bool is_slow_node(const Chaos& chaos, NodeId node) {
  return stream(chaos.seed, Purpose::slow_node, index_of(node)).chance(chaos.slow_node_percent);
}

ChaosDelays::ChaosDelays(const Chaos& chaos, NodeId source)
    : chaos_(chaos), source_(source), draws_(stream(chaos.seed, Purpose::delays, index_of(source))) {
  core::expect(chaos.delay_quanta_max >= 1 && chaos.delay_quanta_max <= 1U << 16U, "a delay lasts a quantum at least");
  core::expect(chaos.slow_link_factor >= 1 && chaos.slow_link_factor <= 1U << 15U, "a slow link is no faster than another");
}

std::uint32_t ChaosDelays::next_quanta(NodeId target) {
  const bool is_held = draws_.chance(chaos_.held_percent);
  const std::uint32_t quanta = 1 + draws_.below(chaos_.delay_quanta_max);  // always drawn: two draws a packet
  if (!is_held) {
    return 0;
  }
  return is_slow_link(chaos_, source_, target) ? quanta * chaos_.slow_link_factor : quanta;
}

ChaosPauses::ChaosPauses(const Chaos& chaos, NodeId node)
    : quanta_max_(is_slow_node(chaos, node) ? chaos.idle_quanta_max : 0),
      draws_(stream(chaos.seed, Purpose::pauses, index_of(node))) {
  core::expect(chaos.idle_quanta_max < 1U << 31U, "a slow node comes round");
}

std::uint32_t ChaosPauses::next_quanta() { return draws_.below(quanta_max_ + 1); }

}  // namespace dmpc::nodes
