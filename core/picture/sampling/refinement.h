// Adaptive sampling: which pixels get more samples, decided pass by pass from the film and the scene, so that every strategy
// refines the same pixels.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/picture/film/film.h"
#include "core/picture/sampling/error_estimate.h"
#include "core/picture/sampling/fine_detail.h"
#include "core/picture/sampling/sample_pass.h"

namespace dmpc::core {

struct PartialPicture;

/// How far a picture is refined beyond the camera's samples, which every pixel gets.
struct RefinementOptions {
  /// Root mean square error of the picture's linear channels at which it is good enough; 0: no refinement.
  double error = 0;
  /// A pixel has at most so many. Pixels stop below it: their samples double.
  std::uint32_t samples_max = 4096;
  ErrorKind kind = ErrorKind::edges;

  constexpr bool is_wanted() const { return error > 0; }
};

/// Of every pixel in the first pass of a picture that is refined. Of edges two: one would tell nothing of a pixel's error, the
/// second tells it by what it changes, and two are what most pixels of most pictures need. Of noise eight, and as many again for
/// all pixels in a second pass, before anything is told from them: of so rare things as one sample in a hundred finds, fewer
/// tell nothing in most neighbourhoods.
constexpr std::uint32_t first_refined_samples(ErrorKind kind) { return kind == ErrorKind::noise ? 8 : 2; }
/// A pixel of a picture that is refined has no fewer when it is done.
constexpr std::uint32_t least_refined_samples(ErrorKind kind) {
  return first_refined_samples(kind) * (kind == ErrorKind::noise ? 2 : 1);
}

/// The last pass ends a picture, whatever its error: with samples enough for any it comes sooner.
inline constexpr std::uint32_t passes_max = 12;
/// In one pass a pixel's samples are doubled so often at most: what few samples say is then looked at again, and of so many
/// groups of samples the film's planes tell each from the others.
inline constexpr std::uint32_t doublings_max = 2;
/// The level that a pixel of `samples` in the first pass may come to; at most SampleStep::level_max.
std::uint32_t level_max(const RefinementOptions& options, std::uint32_t samples);

/// What came of it.
struct RefinementResult {
  std::uint32_t passes = 1;
  double error = 0;  ///< estimated, of the picture as it is; 0 unless refinement was wanted
};

/// The host's: the pass under way, and the choice of the next. Not thread-safe.
///
/// Every pixel has the camera's samples or those doubled a number of times. Each doubling of a pixel's samples promises so much
/// less error (ErrorEstimate) for so many samples: the best promises are taken, as many as are needed for the picture's estimate
/// to come down to the error asked for, at once and for all levels; those that are worth far less than the others wait. Besides,
/// some of the pixels that look even, chosen by a hash, get four times their samples, for what they show of the others.
class Refinement {
 public:
  /// `samples`: of every pixel in the first pass, which is under way from the start. Requires two, and a film of this size and
  /// scale, if there is an error to come down to, or of noise eight; else any number. `detail`, if there is any, outlives it.
  Refinement(const RefinementOptions& options, std::uint32_t samples, int width, int height, const FineDetail* detail = nullptr,
             FilmScale scale = {});

  /// Goes on where another has left off. Before the first next_pass().
  void resume(const PartialPicture& start);

  /// Under way.
  const Pass& pass() const { return pass_; }
  std::uint32_t pixel_count() const { return pixel_count_; }
  /// All light of the pass under way has arrived: counts its samples on the film, and chooses the next one, for whose pixels it
  /// gathers the film's planes. Returns false if the picture is good enough, or no pixel may have more samples.
  bool next_pass(Film& film);
  /// Up to the pass under way, its error not yet known.
  RefinementResult result() const { return {result_.passes, result_.error / scale_}; }
  /// How often gathering has saturated a pixel's sum.
  std::uint64_t gatherings_saturated() const { return gatherings_saturated_; }
  /// What it remembers of the pixels, for who goes on; of none, if no refinement is wanted.
  std::span<const PixelPast> past() const;

 private:
  class Promises;

  void add_samples(Film& film) const;
  bool begins_by_doubling() const { return kind_ == ErrorKind::noise && result_.passes == 1; }
  void double_all(Film& film);
  double doubling(std::uint32_t pixel) const;
  void find_errors(const Film& film);
  bool choose(Film& film);
  Promises promises() const;
  std::uint64_t take_best(std::size_t threshold);
  void explore(std::uint64_t samples_chosen);
  bool can_explore(std::uint32_t pixel) const;
  std::uint32_t samples_at(std::uint32_t level) const { return SampleStep::samples_at(level, pass_.first_samples()); }
  double worth(std::uint32_t pixel, double square_error, std::uint32_t level) const;
  double hash(std::uint32_t pixel) const;

  double scale_;  ///< the film's: errors of light are multiplied by it
  double error_;  ///< the one asked for, scaled
  ErrorKind kind_;
  std::uint32_t level_max_ = 1;
  Pass pass_;
  std::uint32_t pixel_count_;
  RefinementResult result_;                ///< its error scaled
  std::optional<ErrorEstimate> estimate_;  ///< this and the next are empty without refinement
  std::vector<float> square_errors_;
  std::uint64_t gatherings_saturated_ = 0;
};

}  // namespace dmpc::core
