#include "core/scene/alpha_coverage.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>

namespace dmpc::core {
namespace {

constexpr std::uint32_t alpha_max = 255;
constexpr unsigned alpha_shift = 24;

/// Texels by their alpha.
using AlphaCounts = std::array<std::size_t, alpha_max + 1>;

AlphaCounts alpha_counts(const TextureLevel& level) {
  AlphaCounts counts{};
  for (const std::uint32_t texel : level.texels) {
    ++counts[texel >> alpha_shift];
  }
  return counts;
}

std::size_t count_from(const AlphaCounts& counts, std::size_t least) {
  return std::accumulate(counts.begin() + static_cast<std::ptrdiff_t>(least), counts.end(), std::size_t{0});
}

/// The alpha from which on a level is to be there, so that as nearly as can be `share` of it is: one beyond all for nothing.
std::uint32_t least_to_keep(const AlphaCounts& counts, double share) {
  const double wanted = share * static_cast<double>(count_from(counts, 0));
  std::uint32_t best = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::uint32_t least = 0; least <= alpha_max + 1; ++least) {
    const double off = std::fabs(static_cast<double>(count_from(counts, least)) - wanted);
    if (off < nearest) {
      best = least;
      nearest = off;
    }
  }
  return best;
}

/// Has the level cut where its alpha comes up to `least`, as a cut at `cut` of 255 is to do, and keeps the order of all alphas.
void move_cut(TextureLevel& level, const AlphaCounts& counts, std::uint32_t least, std::uint32_t cut) {
  std::uint32_t first = least, below = std::max(least, 1U) - 1;  // the nearest that there are
  while (first <= alpha_max && counts[first] == 0) {
    ++first;
  }
  while (below > 0 && counts[below] == 0) {
    --below;
  }
  const double scale = 2.0 * cut / std::max(first + below, 1U);  // the cut comes halfway between both
  for (std::uint32_t& texel : level.texels) {
    const std::uint32_t alpha = texel >> alpha_shift;
    const auto scaled = static_cast<std::uint32_t>(std::min<double>(alpha * scale + 0.5, alpha_max));
    const std::uint32_t moved = alpha >= least ? std::max(scaled, cut) : std::min(scaled, cut - 1);
    texel = (texel & ((1U << alpha_shift) - 1)) | moved << alpha_shift;
  }
}

}  // namespace

void keep_coverage(Texture& texture, double cutoff) {
  if (!(cutoff > 0) || texture.format != TexelFormat::srgb_alpha) {
    return;
  }
  const double least_there = std::ceil(std::min(cutoff, 1.0) * alpha_max - 0.01);  // but for rounding
  const auto cut = static_cast<std::uint32_t>(std::max(least_there, 1.0));
  const TextureLevel& finest = texture.levels.front();
  const std::size_t there = count_from(alpha_counts(finest), cut), all = finest.texels.size();
  const double share = static_cast<double>(there) / static_cast<double>(all);
  for (std::size_t i = 1; i < texture.levels.size(); ++i) {
    const AlphaCounts counts = alpha_counts(texture.levels[i]);
    const std::uint32_t least = least_to_keep(counts, share);
    if (count_from(counts, least) != count_from(counts, cut)) {
      move_cut(texture.levels[i], counts, least, cut);
    }
  }
}

}  // namespace dmpc::core
