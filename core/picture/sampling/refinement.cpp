#include "core/picture/sampling/refinement.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/base/expect.h"
#include "core/base/sampling.h"
#include "core/picture/film/partial_picture.h"

namespace dmpc::core {
namespace {

/// The factor of an edge's square error when samples double: 1 / spread(2).
constexpr double edge_doubling = 0.35355339059327373;
/// The share of the requested square error that a pass aims at: slightly less than all, which avoids small passes at the end.
constexpr double aim = 0.82;
/// Shares of the requested square error: pixels below the first look even; those below the second are good enough, whatever
/// happens to the others.
constexpr double even_share = 0.1, negligible_share = 1e-3;
/// Pixels are explored by two doublings, with at most this share of the samples that a pass has anyway.
constexpr std::uint32_t explored_doublings = 2;
constexpr double explored_share = 0.06;
/// The share of pixels explored in the second pass, for this number of pixels and this requested error. More are explored if the
/// error is smaller, since rarer details matter then, and a smaller share of a larger picture, since the number of explored
/// pixels matters more than their share.
constexpr double explored_first_share = 0.03, explored_pixels = 16384, explored_error = 4.0 / 255, explored_share_max = 0.25;
/// A gain below the mean of the chosen ones divided by this waits for the next pass, which has more information: when a pass took
/// all gains, most of its samples went to pixels that need none.
constexpr double worth_of_waiting = 12;
/// Randomises gains, so that equal ones are not all taken or all left.
constexpr double worth_spread = 0.2;

double explored_first(double error, std::size_t pixels) {
  const double finer = explored_error / error, larger = static_cast<double>(pixels) / explored_pixels;
  return std::min(explored_first_share * finer * std::sqrt(std::sqrt(finer)) / std::sqrt(larger), explored_share_max);
}

}  // namespace

/// A histogram of doublings by gain, with 32 bins per octave from the bits of a positive number, which needs no sorting.
class Refinement::Promises {
 public:
  static std::size_t bin_of(double worth) { return std::bit_cast<std::uint64_t>(worth) >> 47U; }

  void add(double worth, double less_error) { weights_[bin_of(worth)] += less_error; }
  /// The highest bin such that it and all above reduce the square errors by `sum`, or whose next bin is worth too little.
  std::size_t threshold(double sum) const {
    std::size_t lowest = weights_.size();
    double less_error = 0, samples = 0;
    for (std::size_t bin = lowest; bin-- > 0 && less_error < sum;) {
      const double worth = std::bit_cast<double>(std::uint64_t{bin} << 47U);
      if (weights_[bin] > 0 && worth * samples * worth_of_waiting >= less_error) {
        less_error += weights_[bin];
        samples += weights_[bin] / worth;
        lowest = bin;
      }
    }
    return lowest;
  }

 private:
  std::vector<double> weights_ = std::vector<double>(std::size_t{2048} * 32);
};

std::uint32_t level_max(const RefinementOptions& options, std::uint32_t samples) {
  std::uint32_t level = 1;
  while (options.is_wanted() && level < SampleStep::level_max && std::uint64_t{samples} << level <= options.samples_max) {
    ++level;
  }
  return level;
}

Refinement::Refinement(const RefinementOptions& options, std::uint32_t samples, int width, int height, const FineDetail* detail,
                       FilmScale scale)
    : scale_(scale.factor()),
      error_(options.error * scale_),
      passes_(options.passes),
      kind_(options.kind),
      level_max_(core::level_max(options, samples)),
      pass_(static_cast<std::uint32_t>(width * height), samples),
      pixel_count_(static_cast<std::uint32_t>(width * height)) {
  expect(samples > 0, "a picture has samples");
  if (options.is_wanted()) {
    expect(samples == first_refined_samples(kind_) && least_refined_samples(kind_) <= options.samples_max,
           "a picture that is refined starts with as many samples as tell of an error");
    estimate_.emplace(width, height, detail, even_share * error_ * error_, kind_);
    square_errors_.resize(pixel_count_);
  }
}

void Refinement::resume(const PartialPicture& start) {
  expect(result_.passes == 1 && start.film.pixel_count() == pass_.steps().size(), "a picture is gone on with from the start");
  pass_ = start.pass;
  pixel_count_ = pass_.pixel_count();
  result_.passes = start.passes;
  if (estimate_ && start.passes > 1) {
    estimate_->resume(start.past);
  }
}

std::span<const PixelPast> Refinement::past() const { return estimate_ ? estimate_->past() : std::span<const PixelPast>(); }

/// All nodes wait for the host during this, most often in a picture's only pass, which does not write the count of each pixel.
void Refinement::add_samples(Film& film) const {
  if (pass_.is_first()) {
    return film.add_samples_to_all(pass_.first_samples());
  }
  for (std::uint32_t pixel = 0; pixel < pass_.steps().size(); ++pixel) {
    film.add_samples(pixel, pass_.samples(pixel).count);
  }
}

bool Refinement::next_pass(Film& film, const EndsBefore& ends_before) {
  add_samples(film);
  if (!estimate_) {
    return false;
  }
  if (begins_by_doubling()) {
    double_all(film);
    return true;
  }
  estimate_->end_pass(film, pass_);
  find_errors(film);
  const std::uint64_t chosen = result_.error > error_ && result_.passes < passes_ ? choose() : 0;
  result_.is_cut_short = chosen > 0 && ends_before && ends_before({result(), film.samples(), chosen});
  if (chosen == 0 || result_.is_cut_short) {
    return false;
  }
  begin_chosen(film);
  return true;
}

/// Doubles the samples of all pixels, on the other plane.
void Refinement::double_all(Film& film) {
  estimate_->take_means(film);
  for (std::uint32_t pixel = 0; pixel < pass_.steps().size(); ++pixel) {
    pass_.steps()[pixel] = {1, 2};
    gatherings_saturated_ += film.gather_planes(pixel) ? 1 : 0;
  }
  ++result_.passes;
}

double Refinement::doubling(std::uint32_t pixel) const {
  return kind_ == ErrorKind::noise ? estimate_->doubling(pixel) : edge_doubling;
}

void Refinement::find_errors(const Film& film) {
  double sum = 0;
  for (std::uint32_t pixel = 0; pixel < square_errors_.size(); ++pixel) {
    square_errors_[pixel] = static_cast<float>(estimate_->square_error(film, pixel));
    sum += double{square_errors_[pixel]};
  }
  result_.error = std::sqrt(sum / static_cast<double>(square_errors_.size()));
}

/// Chooses the next pass, for an error that is too large. Returns the number of its samples.
std::uint64_t Refinement::choose() {
  for (SampleStep& step : pass_.steps()) {
    const std::uint32_t level = std::max(step.from(), step.to());
    step = {level, level};
  }
  const double wanted = aim * error_ * error_, too_much = result_.error * result_.error - wanted;
  const std::uint64_t best = take_best(promises().threshold(too_much * static_cast<double>(square_errors_.size())));
  if (best == 0) {
    return 0;
  }
  explore(best);
  std::uint64_t samples = 0;
  for (std::uint32_t pixel = 0; pixel < pass_.steps().size(); ++pixel) {
    samples += pass_.samples(pixel).count;
  }
  return samples;
}

void Refinement::begin_chosen(Film& film) {
  for (std::uint32_t pixel = 0; pixel < pass_.steps().size(); ++pixel) {
    if (pass_.has(pixel)) {
      gatherings_saturated_ += film.gather_planes(pixel) ? 1 : 0;
    }
  }
  estimate_->begin_pass();
  ++result_.passes;
  pixel_count_ = pass_.pixel_count();
}

/// The gain per sample of continuing from a level, except for a constant factor.
double Refinement::worth(std::uint32_t pixel, double square_error, std::uint32_t level) const {
  return square_error * (1 + worth_spread * hash(pixel)) / samples_at(level);
}

/// From 0 to 1, different in each pass.
double Refinement::hash(std::uint32_t pixel) const {
  const std::uint64_t bits = mix((std::uint64_t{pixel} << 8U | result_.passes) + 0x9e3779b97f4a7c15ULL);
  return static_cast<double>(bits >> 11U) * 0x1p-53;
}

/// For each doubling of a pixel's samples, the expected reduction of the sum of square errors, binned by gain.
Refinement::Promises Refinement::promises() const {
  Promises promises;
  const double negligible = negligible_share * error_ * error_;
  for (std::uint32_t pixel = 0; pixel < square_errors_.size(); ++pixel) {
    double square_error = square_errors_[pixel];
    const std::uint32_t from = pass_.steps()[pixel].from(), end = std::min(level_max_, from + doublings_max);
    for (std::uint32_t level = from; level < end && square_error > negligible; ++level) {
      promises.add(worth(pixel, square_error, level), square_error * (1 - doubling(pixel)));
      square_error *= doubling(pixel);
    }
  }
  return promises;
}

/// Takes all doublings down to the threshold's bin. Returns the number of samples.
std::uint64_t Refinement::take_best(std::size_t threshold) {
  const double negligible = negligible_share * error_ * error_;
  std::uint64_t samples = 0;
  for (std::uint32_t pixel = 0; pixel < square_errors_.size(); ++pixel) {
    double square_error = square_errors_[pixel];
    const std::uint32_t from = pass_.steps()[pixel].from(), end = std::min(level_max_, from + doublings_max);
    std::uint32_t to = from;
    while (to < end && square_error > negligible && Promises::bin_of(worth(pixel, square_error, to)) >= threshold) {
      square_error *= doubling(pixel);
      ++to;
    }
    pass_.steps()[pixel] = {from, to};
    samples += pass_.samples(pixel).count;
  }
  return samples;
}

bool Refinement::can_explore(std::uint32_t pixel) const {
  return !pass_.has(pixel) && pass_.steps()[pixel].from() + explored_doublings <= level_max_ && estimate_->looks_even(pixel);
}

/// Chooses some of the remaining pixels that look even.
void Refinement::explore(std::uint64_t samples_chosen) {
  const auto samples_of = [&](std::uint32_t level) { return samples_at(level + explored_doublings) - samples_at(level); };
  std::uint64_t samples_of_all = 0;
  for (std::uint32_t pixel = 0; pixel < square_errors_.size(); ++pixel) {
    samples_of_all += can_explore(pixel) ? samples_of(pass_.steps()[pixel].from()) : 0;
  }
  double share =
      explored_share * static_cast<double>(samples_chosen) / static_cast<double>(std::max<std::uint64_t>(samples_of_all, 1));
  share = result_.passes == 1 ? std::max(share, explored_first(error_, square_errors_.size())) : share;
  for (std::uint32_t pixel = 0; pixel < square_errors_.size(); ++pixel) {
    if (hash(pixel) < share && can_explore(pixel)) {
      const std::uint32_t level = pass_.steps()[pixel].from();
      pass_.steps()[pixel] = {level, level + explored_doublings};
    }
  }
}

}  // namespace dmpc::core
