// Adaptive sampling: which pixels get more samples, decided pass by pass from the film and the scene, so that every strategy
// refines the same pixels.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/picture/film/film.h"
#include "core/picture/sampling/error_estimate.h"
#include "core/picture/sampling/fine_detail.h"
#include "core/picture/sampling/sample_pass.h"

namespace dmpc::core {

struct PartialPicture;

/// The maximum number of passes, whatever the error then is: with samples enough for any error there are fewer.
inline constexpr std::uint32_t passes_max = 12;

/// How far a picture is refined beyond the camera's samples per pixel.
struct RefinementOptions {
  /// Root mean square error of the picture's linear channels at which refinement stops; 0: no refinement.
  double error = 0;
  /// Maximum for a pixel. Pixels stop below it if doubling would exceed it.
  std::uint32_t samples_max = 4096;
  /// Maximum number of passes; at least two for noise, whose first two say nothing apart.
  std::uint32_t passes = passes_max;
  ErrorKind kind = ErrorKind::edges;

  constexpr bool is_wanted() const { return error > 0; }
};

/// Samples of every pixel in the first pass of a refined picture. Two for edges: one says nothing of a pixel's error, the second
/// one's change does, and two are what most pixels of most pictures need. Eight for noise, and as many again for all pixels in a
/// second pass, before anything is estimated: for rare events, such as one in a hundred samples, fewer say nothing in most
/// neighbourhoods.
constexpr std::uint32_t first_refined_samples(ErrorKind kind) { return kind == ErrorKind::noise ? 8 : 2; }
/// The least number of samples of a pixel of a finished refined picture.
constexpr std::uint32_t least_refined_samples(ErrorKind kind) {
  return first_refined_samples(kind) * (kind == ErrorKind::noise ? 2 : 1);
}

/// The maximum number of doublings of a pixel's samples in one pass: what few samples say is then checked again, and the film's
/// planes can keep apart no more blocks of samples.
inline constexpr std::uint32_t doublings_max = 2;
/// The highest level for a pixel of `samples` in the first pass; at most SampleStep::level_max.
std::uint32_t level_max(const RefinementOptions& options, std::uint32_t samples);

/// The outcome of refinement.
struct RefinementResult {
  std::uint32_t passes = 1;
  double error = 0;           ///< estimated, for the current picture; 0 without refinement
  bool is_cut_short = false;  ///< EndsBefore has ended it
};

/// A picture between two passes.
struct PassEnd {
  RefinementResult result;           ///< of the pass that has ended
  std::uint64_t samples_done = 0;    ///< of all pixels
  std::uint64_t samples_chosen = 0;  ///< for the next pass
};

/// Whether a picture ends here, although another pass is chosen. Empty: never.
using EndsBefore = std::function<bool(const PassEnd& end)>;

/// The host's state: the current pass, and the choice of the next. Not thread-safe.
///
/// Every pixel has the camera's samples, doubled a number of times. Each doubling of a pixel's samples is expected to reduce the
/// error (ErrorEstimate) at the cost of these samples: the best are chosen, as many as are needed to bring the picture's estimate
/// down to the requested error, at once and for all levels; those that are worth far less than the others wait. Besides, some of
/// the pixels that look even, chosen by a hash, get four times their samples, as evidence about the others.
class Refinement {
 public:
  /// `samples`: of every pixel in the first pass, which is the current one at the start. If an error is requested it must be two,
  /// or eight for noise, and the film must have this size and scale. `detail`, if given, outlives it.
  Refinement(const RefinementOptions& options, std::uint32_t samples, int width, int height, const FineDetail* detail = nullptr,
             FilmScale scale = {});

  /// Resumes another run. To be called before the first next_pass().
  void resume(const PartialPicture& start);

  /// The current pass.
  const Pass& pass() const { return pass_; }
  std::uint32_t pixel_count() const { return pixel_count_; }
  /// To be called when all light of the current pass has arrived: counts its samples on the film, and chooses the next pass, for
  /// whose pixels it gathers the film's planes. Returns false if the picture is good enough, no pixel may have more samples, or
  /// it ends before: then film and result are those of as many passes as have ended.
  bool next_pass(Film& film, const EndsBefore& ends_before = {});
  /// Begins the pass that was chosen when the picture was cut short: for the state from which another run resumes it.
  void begin_chosen(Film& film);
  /// Up to the current pass, whose error is not yet known.
  RefinementResult result() const { return {result_.passes, result_.error / scale_, result_.is_cut_short}; }
  /// How often gathering has saturated a pixel's sum.
  std::uint64_t gatherings_saturated() const { return gatherings_saturated_; }
  /// What it remembers of the pixels, for a run that resumes; empty without refinement.
  std::span<const PixelPast> past() const;

 private:
  class Promises;

  void add_samples(Film& film) const;
  bool begins_by_doubling() const { return kind_ == ErrorKind::noise && result_.passes == 1; }
  void double_all(Film& film);
  double doubling(std::uint32_t pixel) const;
  void find_errors(const Film& film);
  std::uint64_t choose();
  Promises promises() const;
  std::uint64_t take_best(std::size_t threshold);
  void explore(std::uint64_t samples_chosen);
  bool can_explore(std::uint32_t pixel) const;
  std::uint32_t samples_at(std::uint32_t level) const { return SampleStep::samples_at(level, pass_.first_samples()); }
  double worth(std::uint32_t pixel, double square_error, std::uint32_t level) const;
  double hash(std::uint32_t pixel) const;

  double scale_;          ///< the film's, a factor of errors
  double error_;          ///< the requested one, scaled
  std::uint32_t passes_;  ///< at most
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
