// Adaptive sampling: which pixels get more samples, decided pass by pass from the film alone, so that every strategy refines the
// same pixels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/picture/film.h"

namespace dmpc::core {

struct PartialPicture;

/// Consecutive samples that each pixel of a pass gets.
struct SampleRange {
  std::uint32_t first = 0, count = 1;
  constexpr bool operator==(const SampleRange&) const = default;
};

/// How far a picture is refined beyond the camera's samples, which every pixel gets.
struct RefinementOptions {
  /// Estimated root mean square error of the picture's linear channels at which it is good enough; 0: no refinement.
  double error = 0;
  /// Of a pixel. Pixels stop below it: their samples double.
  std::uint32_t samples_max = 4096;

  constexpr bool is_wanted() const { return error > 0; }
};

/// What came of it.
struct RefinementResult {
  std::uint32_t passes = 1;
  double error = 0;  ///< estimated, of the picture as it is; 0 unless refinement was wanted
};

/// A bit for each pixel of a picture.
class PixelMask {
 public:
  explicit PixelMask(std::uint32_t pixel_count, bool all = false);

  bool has(std::uint32_t pixel) const { return (words_[pixel / 64] >> (pixel % 64) & 1U) != 0; }
  void add(std::uint32_t pixel) { words_[pixel / 64] |= std::uint64_t{1} << (pixel % 64); }
  std::uint32_t count() const;
  /// Those that `other`, a mask of the same picture, does not have.
  PixelMask without(const PixelMask& other) const;
  /// 64 pixels each, the first the lowest bit. Whoever writes them sets no bit beyond the picture.
  std::span<const std::uint64_t> words() const { return words_; }
  std::span<std::uint64_t> words() { return words_; }
  bool operator==(const PixelMask&) const = default;

 private:
  std::vector<std::uint64_t> words_;
};

/// The host's: the pass under way, and the choice of the next. Not thread-safe.
///
/// A pixel's error is that of its mean: half of the difference between the means of its even and its odd samples is an estimate
/// of it. One pixel's difference says little, and may be 0 by chance where an edge runs; so a pixel's variance is the mean over
/// it and its neighbours, and at least what the contrast between them suggests. It falls with samples^-3/2, as that of evenly
/// spread samples does where edges make it (D. P. Mitchell, "Consequences of Stratified Sampling in Graphics", SIGGRAPH 1996).
///
/// Every pixel has the camera's samples or those doubled a number of times, its level. A pass doubles the samples of pixels of
/// one level, the lowest of which any promises enough: those whose error falls most for a sample, as many as are needed for the
/// picture's estimate to come down to the error asked for.
class Refinement {
 public:
  /// `samples`: of every pixel in the first pass, which is under way from the start. Requires an even number of them, and a film
  /// of this size, if there is an error to come down to; else any number.
  Refinement(const RefinementOptions& options, std::uint32_t samples, int width, int height);

  /// Goes on where another has left off, from whose film all that it had estimated is found again. Before the first next_pass().
  void resume(const PartialPicture& start);

  SampleRange samples() const { return samples_; }
  /// The pixels of the pass under way.
  const PixelMask& pixels() const { return pixels_; }
  std::uint32_t pixel_count() const { return pixel_count_; }
  /// All light of the pass under way has arrived: counts its samples on the film, and chooses the next one. Returns false if the
  /// picture is good enough, or no pixel may have more samples.
  bool next_pass(Film& film);
  /// Up to the pass under way, its error not yet known.
  const RefinementResult& result() const { return result_; }

 private:
  class Bins;

  void end_pass(Film& film);
  void note_variance(const Film& film, std::uint32_t pixel);
  template <class Visit>
  void visit_around(std::uint32_t pixel, const Visit& visit) const;
  bool touches_pass(std::uint32_t pixel) const;
  double estimate(const Film& film, std::uint32_t pixel) const;
  bool choose(double sum);
  void select(std::size_t threshold);
  std::uint64_t pass_samples() const { return std::uint64_t{pixel_count_} * samples_.count; }
  Bins gains() const;
  std::uint32_t samples_at(std::uint32_t level) const { return first_samples_ << level; }

  RefinementOptions options_;
  std::uint32_t first_samples_;
  int width_, height_;
  std::uint32_t level_max_ = 0;
  SampleRange samples_;
  PixelMask pixels_;
  std::uint32_t pixel_count_;
  std::uint64_t samples_total_ = 0;  ///< of all pixels, in passes that have ended
  RefinementResult result_;
  std::vector<std::uint8_t> levels_;  ///< of each pixel; this and the next are empty without refinement
  std::vector<double> variances_;     ///< of a sample, by the pixel's own difference
  std::vector<double> square_errors_;
};

}  // namespace dmpc::core
