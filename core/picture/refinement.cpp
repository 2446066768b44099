#include "core/picture/refinement.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/expect.h"
#include "core/base/units.h"
#include "core/picture/partial_picture.h"

namespace dmpc::core {
namespace {

/// The least variance of a sample that a difference of 1 between the darkest and the brightest of nine neighbouring means
/// suggests. An even ramp makes 1/48 in each pixel, an edge through the middle one up to 1/4 in that one.
constexpr double contrast_share = 0.03;

double square_mean(const Vec3d& color) { return dot(color, color) / 3; }

/// samples^(3/2): what the variance of evenly spread samples is divided by.
double spread(std::uint32_t samples) { return samples * std::sqrt(double{1} * samples); }

/// By what a square error falls when samples double: 1 / spread(2).
constexpr double doubling = 0.35355339059327373;
/// The share of the square error asked for that a pass aims at: a little lower, or many small passes come at the end. It aims
/// lower again, a few times, if it would have fewer than one in so many samples of those that there are.
constexpr double aim = 0.9;
constexpr std::uint64_t pass_share_min = 32;
constexpr int attempts_max = 6;

/// Pixels with less than this square error are good enough, whatever becomes of the others.
double negligible(const RefinementOptions& options) { return 1e-3 * options.error * options.error; }

/// What is won for a sample where `samples` are doubled, but for a constant factor.
double worth(double square_error, std::uint32_t samples) { return square_error / samples; }

}  // namespace

/// Eight bins an octave, by the bits of a positive number: an order that needs no sorting.
class Refinement::Bins {
 public:
  static constexpr std::size_t count = std::size_t{2048} * 8;
  static std::size_t of(double value) { return std::bit_cast<std::uint64_t>(value) >> 49U; }

  void add(double key, double weight) { weights_[of(key)] += weight; }
  /// The highest bin above which, itself included, the weights sum up to `sum`; 0 if all together do not.
  std::size_t threshold(double sum) const {
    std::size_t bin = count;
    while (bin > 0 && sum > 0) {
      sum -= weights_[--bin];
    }
    return bin;
  }

 private:
  std::vector<double> weights_ = std::vector<double>(count);
};

PixelMask::PixelMask(std::uint32_t pixel_count, bool all) : words_(ceil_divide(pixel_count, 64U), all ? ~std::uint64_t{0} : 0) {
  if (all && pixel_count % 64 != 0) {
    words_.back() = (std::uint64_t{1} << (pixel_count % 64)) - 1;
  }
}

std::uint32_t PixelMask::count() const {
  std::uint32_t sum = 0;
  for (const std::uint64_t word : words_) {
    sum += static_cast<std::uint32_t>(std::popcount(word));
  }
  return sum;
}

PixelMask PixelMask::without(const PixelMask& other) const {
  expect(words_.size() == other.words_.size(), "masks are of one picture");
  PixelMask rest = *this;
  for (std::size_t i = 0; i < words_.size(); ++i) {
    rest.words_[i] &= ~other.words_[i];
  }
  return rest;
}

Refinement::Refinement(const RefinementOptions& options, std::uint32_t samples, int width, int height)
    : options_(options),
      first_samples_(samples),
      width_(width),
      height_(height),
      samples_{0, samples},
      pixels_(static_cast<std::uint32_t>(width * height), true),
      pixel_count_(static_cast<std::uint32_t>(width * height)) {
  expect(samples > 0, "a picture has samples");
  if (options.is_wanted()) {
    expect(samples % 2 == 0 && samples <= options.samples_max, "a picture that is refined starts with samples on both planes");
    levels_.resize(pixel_count_);
    variances_.resize(pixel_count_);
    square_errors_.resize(pixel_count_);
    while (samples_at(level_max_) <= options.samples_max / 2) {
      ++level_max_;
    }
  }
}

/// What next_pass() will not find anew belongs to pixels that neither are in the pass nor touch one of it: on their part of the
/// film nothing has changed since it was estimated last, so that it is estimated alike. The rest does not matter.
void Refinement::resume(const PartialPicture& start) {
  expect(result_.passes == 1 && samples_total_ == 0 && start.film.pixels().size() == pixel_count_,
         "a picture is gone on with from the start");
  samples_ = start.samples;
  pixels_ = start.pixels;
  pixel_count_ = pixels_.count();
  samples_total_ = start.film.samples();
  result_.passes = start.passes;
  if (levels_.empty() || start.passes == 1) {
    return;
  }
  for (std::uint32_t pixel = 0; pixel < levels_.size(); ++pixel) {
    levels_[pixel] = static_cast<std::uint8_t>(std::bit_width(start.film.samples(pixel) / first_samples_) - 1);
    note_variance(start.film, pixel);
  }
  for (std::uint32_t pixel = 0; pixel < levels_.size(); ++pixel) {
    square_errors_[pixel] = estimate(start.film, pixel);
  }
}

bool Refinement::next_pass(Film& film) {
  end_pass(film);
  if (levels_.empty()) {
    return false;
  }
  for (std::uint32_t pixel = 0; pixel < levels_.size(); ++pixel) {
    if (touches_pass(pixel)) {
      square_errors_[pixel] = estimate(film, pixel);
    }
  }
  double sum = 0;
  for (const double square_error : square_errors_) {
    sum += square_error;
  }
  result_.error = std::sqrt(sum / static_cast<double>(square_errors_.size()));
  return result_.error > options_.error && choose(sum);
}

/// Counts the samples of the pass, and notes the own variance of its pixels.
void Refinement::end_pass(Film& film) {
  samples_total_ += pass_samples();
  for (std::uint32_t pixel = 0; pixel < film.pixels().size(); ++pixel) {
    if (!pixels_.has(pixel)) {
      continue;
    }
    film.add_samples(pixel, samples_.count);
    if (!levels_.empty()) {
      levels_[pixel] = static_cast<std::uint8_t>(levels_[pixel] + (result_.passes > 1 ? 1 : 0));
      note_variance(film, pixel);
    }
  }
}

void Refinement::note_variance(const Film& film, std::uint32_t pixel) {
  variances_[pixel] = square_mean(film.half_difference(pixel)) * spread(film.samples(pixel));
}

/// Calls visit(pixel) for the pixel and those around it, as far as the picture goes.
template <class Visit>
void Refinement::visit_around(std::uint32_t pixel, const Visit& visit) const {
  const int column = static_cast<int>(pixel) % width_, row = static_cast<int>(pixel) / width_;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, height_ - 1); ++y) {
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, width_ - 1); ++x) {
      visit(static_cast<std::uint32_t>(y * width_ + x));
    }
  }
}

/// Whether the pass has changed anything that the estimate of this pixel depends on.
bool Refinement::touches_pass(std::uint32_t pixel) const {
  bool touches = false;
  visit_around(pixel, [&](std::uint32_t near) { touches = touches || pixels_.has(near); });
  return touches;
}

/// The square of the error of a pixel's mean.
double Refinement::estimate(const Film& film, std::uint32_t pixel) const {
  double variance = 0;
  int count = 0;
  Vec3d darkest = film.radiance(pixel), brightest = darkest;
  visit_around(pixel, [&](std::uint32_t near) {
    variance += variances_[near];
    ++count;
    const Vec3d mean = film.radiance(near);
    for (std::size_t channel = 0; channel < 3; ++channel) {
      darkest[channel] = std::min(darkest[channel], mean[channel]);
      brightest[channel] = std::max(brightest[channel], mean[channel]);
    }
  });
  return std::max(variance / count, contrast_share * square_mean(brightest - darkest)) / spread(film.samples(pixel));
}

/// The next pass, for a sum of all square errors that is too large.
bool Refinement::choose(double sum) {
  const Bins gains = this->gains();
  double wanted = options_.error * options_.error * static_cast<double>(levels_.size());
  for (int attempt = 0; attempt < attempts_max; ++attempt) {
    wanted *= aim;
    select(gains.threshold(sum - wanted));
    if (pass_samples() * pass_share_min >= samples_total_) {
      break;
    }
  }
  result_.passes += pixel_count_ > 0 ? 1 : 0;
  return pixel_count_ > 0;
}

/// Pixels of the lowest level that has any whose next doubling is worth at least as much as the threshold's bin says.
void Refinement::select(std::size_t threshold) {
  const auto is_worth_it = [&](std::uint32_t pixel) {
    return levels_[pixel] < level_max_ && square_errors_[pixel] > negligible(options_) &&
           Bins::of(worth(square_errors_[pixel], samples_at(levels_[pixel]))) >= threshold;
  };
  std::uint32_t level = level_max_;
  for (std::uint32_t pixel = 0; pixel < levels_.size(); ++pixel) {
    if (levels_[pixel] < level && is_worth_it(pixel)) {
      level = levels_[pixel];
    }
  }
  pixels_ = PixelMask(static_cast<std::uint32_t>(levels_.size()));
  for (std::uint32_t pixel = 0; pixel < levels_.size(); ++pixel) {
    if (levels_[pixel] == level && is_worth_it(pixel)) {
      pixels_.add(pixel);
    }
  }
  samples_ = {samples_at(level), samples_at(level)};
  pixel_count_ = pixels_.count();
}

/// What each doubling of any pixel's samples would take off the sum of square errors, by what it is worth.
Refinement::Bins Refinement::gains() const {
  Bins gains;
  for (std::uint32_t pixel = 0; pixel < levels_.size(); ++pixel) {
    double square_error = square_errors_[pixel];
    for (std::uint32_t level = levels_[pixel]; level < level_max_ && square_error > negligible(options_); ++level) {
      gains.add(worth(square_error, samples_at(level)), square_error * (1 - doubling));
      square_error *= doubling;
    }
  }
  return gains;
}

}  // namespace dmpc::core
