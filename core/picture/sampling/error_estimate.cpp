#include "core/picture/sampling/error_estimate.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/box.h"
#include "core/base/expect.h"
#include "core/base/units.h"

namespace dmpc::core {
namespace {

/// The minimum variance of a sample that a difference of 1 between the darkest and the brightest of nine neighbouring means
/// indicates. An even ramp causes 1/48 in each pixel, an edge through the middle one up to 1/4 in that one.
constexpr double contrast_share = 0.03;
/// The side of a tile in pixels: evidence counts in its own tile and in those around it.
constexpr std::uint32_t nearby_side = 8;
/// The weight of the evidence in the whole picture, as a number of pixels nearby.
constexpr double picture_weight = 8;
constexpr float remembered_share = 0.5F;
/// The weight of earlier changes in a pixel's change. With 0, a picture of mountains of 24x24 pixels is estimated at 0.79 of its
/// error; with a half, a room lit by a small ball at 1.36 times its error, since rare events met by few samples are remembered.
constexpr double remembered_change = 0.25;
/// The weight of the usual fall, in pixels, where little is known. In the long run the fall is 1 for random noise and spread(2) -
/// 1 for edges; from few samples to a few more it is larger, but only temporarily.
constexpr double unknown_pixels = 64;
struct Falls {
  double usual, least, most;
};
/// For noise the maximum is that of errors that fall as samples^(-4/5).
constexpr Falls edge_falls{1.5, 1, 1.8284271247461903}, noise_falls{1.4, 1, 2.0314331330207964};

const Falls& falls_of(ErrorKind kind) { return kind == ErrorKind::noise ? noise_falls : edge_falls; }

/// The maximum share of one pixel in all that is reported of a fall: more than any pixel has in pictures without a highlight. The
/// limit is lowered to this share at most this many times.
constexpr double reported_share = 1.0 / 16;
constexpr int reported_rounds = 16;

double reported_by(const PixelPast& past) { return double{past.reported_change} + double{past.reported_quarter_change}; }

double square_mean(const Vec3d& color) { return dot(color, color) / 3; }

double power(double base, std::uint32_t exponent) {
  double result = 1;
  for (; exponent != 0; exponent >>= 1U, base *= base) {
    result *= (exponent & 1U) != 0 ? base : 1;
  }
  return result;
}

/// The weight of a pixel in its own variance.
constexpr double own_share = 4;

Vec3d vector_of(const std::array<float, 3>& color) { return {double{color[0]}, double{color[1]}, double{color[2]}}; }

std::array<float, 3> as_floats(const Vec3d& color) {
  return {static_cast<float>(color.x), static_cast<float>(color.y), static_cast<float>(color.z)};
}

/// The evidence that a group of adjacent pixels gives for the error of each.
struct Surroundings {
  double change = 0, weight = 0;
  Box colors;

  void add(const PixelPast& past, double share) {
    change += share * double{past.change};
    weight += share;
    colors.include(vector_of(past.mean));
  }
  /// The squared difference between the darkest and the brightest pixel.
  double contrast() const { return square_mean(colors.high - colors.low); }
};

/// Calls visit(pixel, share) for the pixel and those around it within the picture; shares are those of a tent, 4 to 1.
template <class Visit>
void visit_around(std::uint32_t pixel, std::uint32_t width, std::uint32_t height, const Visit& visit) {
  const std::uint32_t column = pixel % width, row = pixel / width;
  for (std::uint32_t y = row - (row > 0 ? 1 : 0); y <= std::min(row + 1, height - 1); ++y) {
    for (std::uint32_t x = column - (column > 0 ? 1 : 0); x <= std::min(column + 1, width - 1); ++x) {
      visit(y * width + x, (x == column ? 2.0 : 1.0) * (y == row ? 2.0 : 1.0));
    }
  }
}

}  // namespace

double spread(std::uint32_t samples, ErrorKind kind) {
  const double root = std::sqrt(double{1} * samples);
  return samples * (kind == ErrorKind::noise ? std::sqrt(root) : root);
}

ErrorEstimate::ErrorEstimate(int width, int height, const FineDetail* detail, double even, ErrorKind kind)
    : width_(static_cast<std::uint32_t>(width)),
      height_(static_cast<std::uint32_t>(height)),
      tile_columns_(ceil_divide(width_, nearby_side)),
      tile_rows_(ceil_divide(height_, nearby_side)),
      detail_(detail),
      even_(even),
      kind_(kind),
      seen_(std::size_t{width_} * height_),
      past_(seen_.size()),
      unseen_(std::size_t{tile_columns_} * tile_rows_) {}

void ErrorEstimate::resume(std::span<const PixelPast> past) {
  expect(past.size() == past_.size(), "a pass under way has the past of all pixels");
  std::copy(past.begin(), past.end(), past_.begin());
  find_falls();  // used by the current pass when it ends
}

void ErrorEstimate::take_means(const Film& film) {
  for (std::uint32_t pixel = 0; pixel < past_.size(); ++pixel) {
    past_[pixel].mean = as_floats(film.scaled_mean(pixel));
  }
}

void ErrorEstimate::end_pass(const Film& film, const Pass& pass) {
  for (std::uint32_t pixel = 0; pixel < past_.size(); ++pixel) {
    past_[pixel].weight *= remembered_share;
    if (pass.has(pixel)) {
      note_evidence(film, pass, pixel);
      note_changes(film, pass, pixel);
      past_[pixel].mean = as_floats(film.scaled_mean(pixel));
    }
  }
  find_falls();
  find_contrast(film);
  for (std::uint32_t pixel = 0; pixel < past_.size(); ++pixel) {
    seen_[pixel] = static_cast<float>(seen_error(film, pixel));
  }
  find_unseen();
}

void ErrorEstimate::begin_pass() {
  for (std::uint32_t pixel = 0; pixel < past_.size(); ++pixel) {
    past_[pixel].expected = looks_even(pixel) ? seen_[pixel] : -1;
  }
}

/// A mean of some samples and a mean of more that include them differ by the difference of their square errors.
void ErrorEstimate::note_evidence(const Film& film, const Pass& pass, std::uint32_t pixel) {
  PixelPast& past = past_[pixel];
  const std::uint32_t before = pass.samples(pixel).first, now = film.samples(pixel);
  if (before > 0 && past.expected >= 0) {
    const double change = square_mean(film.scaled_mean(pixel) - vector_of(past.mean)) / (1 - double{1} * before / now);
    past.evidence = static_cast<float>((change - double{past.expected}) * spread(before));
    past.weight = 1;
  }
}

/// For noise a part of a pixel's change is predicted from earlier changes, as variances fall: pixels get more samples because of
/// large changes, so the others have small ones by selection, and a single observation of each would underestimate their error.
/// The planes were gathered on that of the last sample before the pass; the following block went to the other. So the film has
/// the exact mean of the first half, except where samples doubled twice: there half of it is that of the first quarter, rounded
/// to a float.
void ErrorEstimate::note_changes(const Film& film, const Pass& pass, std::uint32_t pixel) {
  PixelPast& past = past_[pixel];
  const std::uint32_t before = pass.samples(pixel).first, now = film.samples(pixel);
  const Vec3d mean = film.scaled_mean(pixel);
  const double expected = double{past.change} * expected_growth(pixel, before, now);
  const auto scaled_change = [&](const Vec3d& from) { return static_cast<float>(square_mean(mean - from) * spread(now)); };
  if (before > 0 && now == 4 * before) {
    const Vec3d quarter = vector_of(past.mean), leaf = film.scaled_sum(pixel, 1 - plane_of(before - 1)) * (1.0 / before);
    past.change = scaled_change((quarter + leaf) * 0.5);
    past.reported_change += past.change;
    past.reported_quarter_change += scaled_change(quarter);
  } else {
    const std::uint32_t half = now / 2;
    past.change = scaled_change(film.scaled_sum(pixel, plane_of(half - 1)) * (1.0 / half));
  }
  if (kind_ == ErrorKind::noise && expected > 0) {
    past.change = static_cast<float>(double{past.change} * (1 - remembered_change) + expected * remembered_change);
  }
}

/// The predicted change times spread(samples), if variances fall with each doubling as they have so far.
double ErrorEstimate::expected_growth(std::uint32_t pixel, std::uint32_t before, std::uint32_t now) const {
  double growth = 1;
  for (std::uint32_t samples = before; samples > 0 && samples < now; samples *= 2) {
    growth *= spread(2) / (1 + fall(pixel));
  }
  return growth;
}

/// Uses all pixels of a kind that report, plus some unknown ones that are assumed to have mostly edges; the share of a pixel that
/// outshines the others is limited. Earlier reports are kept: pixels get more samples because of their change, so the others have
/// smaller ones by selection.
void ErrorEstimate::find_falls() {
  const Falls& falls = falls_of(kind_);
  for (const bool detail : {false, true}) {
    const double limit = reported_limit(detail);
    double change = 0, quarter_change = 0, count = 0;
    for (std::uint32_t pixel = 0; pixel < past_.size(); ++pixel) {
      const double reported = reported_by(past_[pixel]);
      if (has_detail(pixel) == detail && reported > 0) {
        const double weight = std::min(1.0, limit / reported);
        change += weight * double{past_[pixel].reported_change};
        quarter_change += weight * double{past_[pixel].reported_quarter_change};
        count += past_[pixel].reported_quarter_change > 0 ? 1 : 0;
      }
    }
    const double found = change > 0 ? quarter_change / change - 2 : falls.usual;
    fall_[detail ? 1 : 0] =
        std::clamp((count * found + unknown_pixels * falls.usual) / (count + unknown_pixels), falls.least, falls.most);
  }
}

/// The limit for a pixel's report that keeps it to at most reported_share of the sum: lowered until it does.
double ErrorEstimate::reported_limit(bool detail) const {
  double limit = std::numeric_limits<double>::max();
  for (int round = 0; round < reported_rounds; ++round) {
    double sum = 0, most = 0;
    for (std::uint32_t pixel = 0; pixel < past_.size(); ++pixel) {
      const double reported = has_detail(pixel) == detail ? std::min(reported_by(past_[pixel]), limit) : 0;
      sum += reported;
      most = std::max(most, reported);
    }
    if (most <= sum * reported_share) {
      break;
    }
    limit = sum * reported_share;
  }
  return limit;
}

/// If few samples met a detail, the brightness of others is unknown: the expected contrast counts as much as one observed detail.
/// Pixels whose details are met by many samples count as if each was met once.
void ErrorEstimate::find_contrast(const Film& film) {
  if (detail_ == nullptr || detail_->is_empty()) {
    return;
  }
  contrast_ = 1;
  const double scale = film.scale().factor();
  double found = detail_->contrast() * scale * scale, expected = 1;
  for (std::uint32_t pixel = 0; pixel < past_.size(); ++pixel) {
    if (has_detail(pixel)) {
      const std::uint32_t samples = film.samples(pixel);
      const double met = std::max(1.0, samples * detail_->coverage(pixel)), weight = samples / met * (samples / met);
      found += weight * double{past_[pixel].change} / (fall(pixel) * spread(samples));
      expected += weight * detail_variance(pixel, samples);
    }
  }
  contrast_ = found / expected;
}

/// The variance of the pixel's mean due to its details: few samples meet them at random, many samples evenly.
double ErrorEstimate::detail_variance(std::uint32_t pixel, std::uint32_t samples) const {
  const double met = std::max(1.0, samples * detail_->coverage(pixel));
  return contrast_ * detail_->variance(pixel) / (samples * std::sqrt(met));
}

/// The square error of a mean that has seen none of the pixel's details, times the probability that no sample met one.
double ErrorEstimate::unmet_detail(std::uint32_t pixel, std::uint32_t samples) const {
  return contrast_ * detail_->squares(pixel) * power(1 - detail_->coverage(pixel), samples);
}

/// For noise a pixel's own samples do not decide when it has enough: a pixel that has hit nothing bright so far would look good
/// and stop, and pictures would be too dark. Its neighbours' samples are independent of its own.
double ErrorEstimate::seen_error(const Film& film, std::uint32_t pixel) const {
  const bool is_detail = has_detail(pixel), counts_itself = kind_ == ErrorKind::edges;
  Surroundings around;
  visit_around(pixel, width_, height_, [&](std::uint32_t near, double share) {
    if (has_detail(near) == is_detail && (near != pixel || counts_itself)) {
      around.add(past_[near], share);
    }
  });
  if (around.weight == 0) {  // there is no other pixel of its kind
    around.add(past_[pixel], own_share);
  }
  double variance = around.change / fall(pixel), weight = around.weight;
  const double samples_spread = spread(film.samples(pixel));
  if (is_detail) {
    variance += own_share * detail_variance(pixel, film.samples(pixel)) * samples_spread;
    weight += own_share;
  }
  return std::max(variance / weight, contrast_share * around.contrast()) / samples_spread;
}

double ErrorEstimate::square_error(const Film& film, std::uint32_t pixel) const {
  const double seen{seen_[pixel]};
  if (seen >= even_) {
    return seen;
  }
  const std::uint32_t samples = film.samples(pixel);
  return seen + (has_detail(pixel) ? unmet_detail(pixel, samples) : unseen_[tile_of(pixel)] / spread(samples));
}

std::uint32_t ErrorEstimate::tile_of(std::uint32_t pixel) const {
  return pixel / width_ / nearby_side * tile_columns_ + pixel % width_ / nearby_side;
}

ErrorEstimate::Evidence ErrorEstimate::evidence_around(const std::vector<Evidence>& tiles, std::uint32_t tile) const {
  Evidence sum;
  visit_around(tile, tile_columns_, tile_rows_, [&](std::uint32_t near, double) {
    sum.sum += tiles[near].sum;
    sum.weight += tiles[near].weight;
  });
  return sum;
}

/// Scales by the evidence nearby so that the mean over the picture is that of all evidence; otherwise the lower bound of 0 for
/// single tiles would accumulate.
void ErrorEstimate::find_unseen() {
  std::vector<Evidence> tiles(unseen_.size());
  std::vector<std::uint32_t> even_pixels(unseen_.size());
  Evidence all;
  for (std::uint32_t pixel = 0; pixel < past_.size(); ++pixel) {
    const PixelPast& past = past_[pixel];
    const double weighed = double{past.weight} * double{past.evidence};
    const std::uint32_t tile = tile_of(pixel);
    tiles[tile].sum += weighed;
    tiles[tile].weight += double{past.weight};
    all.sum += weighed;
    all.weight += double{past.weight};
    even_pixels[tile] += looks_even(pixel) ? 1 : 0;
  }
  const double mean = all.weight > 0 ? std::max(0.0, all.sum / all.weight) : 0;
  double wanted = 0, found = 0;
  for (std::uint32_t tile = 0; tile < tiles.size(); ++tile) {
    const Evidence near = evidence_around(tiles, tile);
    unseen_[tile] = std::max(0.0, (near.sum + picture_weight * mean) / (near.weight + picture_weight));
    found += even_pixels[tile] * unseen_[tile];
    wanted += even_pixels[tile] * mean;
  }
  for (double& unseen : unseen_) {
    unseen *= found > 0 ? wanted / found : 0;
  }
}

}  // namespace dmpc::core
