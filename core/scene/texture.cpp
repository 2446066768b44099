#include "core/scene/texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

#include "core/base/expect.h"
#include "core/record/texture_layout.h"
#include "core/scene/texel.h"

namespace dmpc::core {
namespace {

/// The texels along one side that a coarser texel covers: `first` and the following ones, each with its share.
struct Cover {
  std::uint32_t first = 0;
  std::vector<double> share;  ///< they add up to 1
};

/// The range that texel `index` of `coarse` covers on a side of `fine` texels.
Cover cover_of(std::uint32_t index, std::uint32_t coarse, std::uint32_t fine) {
  const double width = static_cast<double>(fine) / coarse, low = index * width, high = (index + 1) * width;
  Cover cover{.first = static_cast<std::uint32_t>(low), .share = {}};
  for (std::uint32_t texel = cover.first; texel < fine && texel < high; ++texel) {
    cover.share.push_back((std::min<double>(high, texel + 1) - std::max<double>(low, texel)) / width);
  }
  return cover;
}

std::vector<Cover> covers_of(std::uint32_t coarse, std::uint32_t fine) {
  std::vector<Cover> covers;
  for (std::uint32_t index = 0; index < coarse; ++index) {
    covers.push_back(cover_of(index, coarse, fine));
  }
  return covers;
}

/// The mean of the light and, if the format has it, of alpha, which then weights the light.
std::uint32_t mean_of(const TextureLevel& level, TexelFormat format, const Cover& columns, const Cover& rows) {
  Vec3d sum;
  double alpha = 0;
  for (std::size_t row = 0; row < rows.share.size(); ++row) {
    const std::size_t first = (rows.first + row) * level.width + columns.first;
    for (std::size_t column = 0; column < columns.share.size(); ++column) {
      const std::uint32_t texel = level.texels[first + column];
      const double share = rows.share[row] * columns.share[column] * double{alpha_of(format, texel)};
      sum = sum + Vec3d(decoded(format, texel)) * share;
      alpha += share;
    }
  }
  return encoded(format, format == TexelFormat::srgb_alpha && alpha > 0 ? sum * (1 / alpha) : sum, alpha);
}

TextureLevel halved(const TextureLevel& fine, TexelFormat format) {
  TextureLevel coarse{.width = level_size(fine.width, 1), .height = level_size(fine.height, 1), .texels = {}};
  coarse.texels.reserve(std::size_t{coarse.width} * coarse.height);
  const std::vector<Cover> columns = covers_of(coarse.width, fine.width), rows = covers_of(coarse.height, fine.height);
  for (const Cover& row : rows) {
    for (const Cover& column : columns) {
      coarse.texels.push_back(mean_of(fine, format, column, row));
    }
  }
  return coarse;
}

/// For TexelFormat::linear.
Color darkest_of(const TextureLevel& level) {
  Color least{1, 1, 1};
  for (const std::uint32_t texel : level.texels) {
    const Color numbers = decoded(TexelFormat::linear, texel);
    least = {std::min(least.x, numbers.x), std::min(least.y, numbers.y), std::min(least.z, numbers.z)};
  }
  return least;
}

/// For bytes on the curve, which is monotonic, only the largest is decoded.
double brightest_of(const TextureLevel& level, TexelFormat format) {
  if (format == TexelFormat::srgb || format == TexelFormat::srgb_alpha) {
    std::uint32_t most = 0;
    for (const std::uint32_t texel : level.texels) {
      most = std::max({most, texel & 0xffU, texel >> 8U & 0xffU, texel >> 16U & 0xffU});
    }
    return double{decoded(format, most).x};
  }
  double brightest = 0;
  for (const std::uint32_t texel : level.texels) {
    const Color color = decoded(format, texel);
    brightest = std::max({brightest, double{color.x}, double{color.y}, double{color.z}});
  }
  return brightest;
}

constexpr std::uint32_t alpha_max = 255;
constexpr unsigned alpha_shift = 24;

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

/// The least alpha to keep such that as nearly as possible `share` of a level is kept; one beyond all to keep nothing.
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

/// Scales alpha so that a cut at `cut` of 255 falls where alpha reaches `least`; the order of all alphas is kept.
void move_cut(TextureLevel& level, const AlphaCounts& counts, std::uint32_t least, std::uint32_t cut) {
  std::uint32_t first = least, below = std::max(least, 1U) - 1;  // the nearest values that occur
  while (first <= alpha_max && counts[first] == 0) {
    ++first;
  }
  while (below > 0 && counts[below] == 0) {
    --below;
  }
  const double scale = 2.0 * cut / std::max(first + below, 1U);  // the cut lies halfway between both
  for (std::uint32_t& texel : level.texels) {
    const std::uint32_t alpha = texel >> alpha_shift;
    const auto scaled = static_cast<std::uint32_t>(std::min<double>(alpha * scale + 0.5, alpha_max));
    const std::uint32_t moved = alpha >= least ? std::max(scaled, cut) : std::min(scaled, cut - 1);
    texel = (texel & ((1U << alpha_shift) - 1)) | moved << alpha_shift;
  }
}

}  // namespace

void add_levels(Texture& texture) {
  expect(texture.levels.size() == 1, "smaller levels are made of the finest");
  const TextureLevel& finest = texture.levels.front();
  expect(finest.width > 0 && finest.height > 0 && finest.texels.size() == std::size_t{finest.width} * finest.height,
         "a texture has texels");
  texture.brightest = std::max(texture.brightest, brightest_of(finest, texture.format));
  texture.darkest = texture.format == TexelFormat::linear ? darkest_of(finest) : Color{};
  const std::uint32_t count = level_count(finest.width, finest.height);
  texture.levels.reserve(count);
  while (texture.levels.size() < count) {
    texture.levels.push_back(halved(texture.levels.back(), texture.format));
  }
}

void keep_coverage(Texture& texture, double cutoff) {
  if (!(cutoff > 0) || texture.format != TexelFormat::srgb_alpha) {
    return;
  }
  const double least_there = std::ceil(std::min(cutoff, 1.0) * alpha_max - 0.01);  // except for rounding
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
