// Those that part plain of `bench speed` lets render.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/run/strategy_options.h"
#include "apps/scene/picture_options.h"

namespace dmpc::apps {

/// How a plain renderer asks Embree: for one ray at a time, or for 16, robustly or not.
enum class PlainKind : std::uint8_t { single, packets, fast_packets };

/// One of those that render.
struct PlainContender {
  const char* name;
  std::uint32_t count;                              ///< of threads, or of nodes
  std::optional<Strategy> strategy = std::nullopt;  ///< nothing: it is a plain renderer
  RunnerKind runner = RunnerKind::threads;
  PlainKind kind = PlainKind::single;
};

/// Those whose phase `render` is timed. The first is the rival of all.
std::span<const PlainContender> plain_contenders();
/// Those of them that are timed as whole commands, too.
std::span<const PlainContender> command_contenders();
/// The one with this name. Requires that there is one.
const PlainContender& contender_named(const std::string& name);

/// Two of ours whose times are compared.
struct PlainPair {
  const char* subject;
  const char* rival;
};
std::span<const PlainPair> plain_pairs();

/// What one of ours asks for.
StrategyOptions strategy_of(const PlainContender& contender);
/// The words behind `dmpc` of a command that renders `scene` as one of ours into a file.
std::vector<std::string> command_of(const PlainContender& contender, const std::string& scene, const Resolution& size,
                                    const std::filesystem::path& file);

}  // namespace dmpc::apps
