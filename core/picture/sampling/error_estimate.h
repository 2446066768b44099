// How far a picture's pixels are from converged ones, estimated from the film, and from what is known of what it cannot show.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/picture/film/film.h"
#include "core/picture/sampling/fine_detail.h"
#include "core/picture/sampling/sample_pass.h"

namespace dmpc::core {

/// What the error of a pixel's mean comes from: edges of things and shadows, on both sides of which a pixel's samples fall as
/// evenly as they lie, or chance, too, which paths take at every hit.
enum class ErrorKind : std::uint8_t { edges, noise };

/// What an estimate remembers of a pixel that a film does not tell.
struct PixelPast {
  /// Of light as the film scales it, when the pass under way was chosen: to 2^-24 of itself, so what a pixel whose samples double
  /// twice has changed by is known as well as that.
  std::array<float, 3> mean{};
  float expected = -1;  ///< its square error then, if it looked even; less than 0: it did not
  float evidence = 0;   ///< what it has shown of error unseen by pixels that look even, times spread(samples)
  float weight = 0;     ///< of the evidence: 1 at first, half as much after each pass
  /// The square of what the mean of all of its samples differs by from that of the first half, times spread(samples); of noise
  /// with what its changes before that lead to expect.
  float change = 0;
  /// Sums over passes that brought three quarters of its samples: of the same then, and of that of the first quarter.
  float reported_change = 0, reported_quarter_change = 0;

  bool operator==(const PixelPast&) const = default;
};

/// What the variance of a mean of evenly spread samples is divided by. Edges: samples^(3/2) (D. P. Mitchell, "Consequences of
/// Stratified Sampling in Graphics", SIGGRAPH 1996). Noise: samples^(5/4), between those of errors that fall as samples^(-1/2),
/// where paths are long, and as samples^(-4/5), where one number decides.
double spread(std::uint32_t samples, ErrorKind kind = ErrorKind::edges);

/// Square errors of the means of pixels, of light as the film scales it; not thread-safe.
///
/// *What the film shows*: as all leaves of a scrambled sequence are alike, the square of what a pixel's mean of n samples differs
/// by from that of 2n is, on average, V(n) - V(2n), what the variance of the mean has become less by. How much is left follows
/// from how fast it falls: V(n) / V(2n) is 2 where samples meet this and that at random, and more where edges are what makes it.
/// So many pixels as have got three quarters of their samples in a pass tell: (V(n) - V(4n)) / (V(2n) - V(4n)) is one more than
/// that ratio, if it is the same for both doublings. One that outshines the others says little. One difference says little, and
/// may be 0 by chance; so a pixel's variance is the mean over it and its neighbours, and at least what the contrast between them
/// suggests. Of noise the pixel itself is left out of both: who stops by what he has seen is biased (D. Kirk, J. Arvo, "Unbiased
/// Sampling Techniques for Image Synthesis", SIGGRAPH 1991).
///
/// *What is known of the scene*: a pixel with fine detail (core/picture/sampling/fine_detail.h) is not like its neighbours
/// without. In the mean only those that have some count, and what the pixel's detail would make counts as much as the pixel
/// itself; as long as it looks even, its detail may all have been missed. How much light details differ by is found from all such
/// pixels together.
///
/// *What is known of neither*: of the pixels that look even, and have no such detail, some get more samples for no reason of
/// their own. How much their means change, beyond what was expected, is evidence of the error of those that do not get more,
/// nearby and in all of the picture.
class ErrorEstimate {
 public:
  /// `detail` outlives it, if there is any. Pixels below `even` look even: a square error.
  ErrorEstimate(int width, int height, const FineDetail* detail, double even, ErrorKind kind = ErrorKind::edges);

  /// Goes on with the past of a pass under way, one for each pixel.
  void resume(std::span<const PixelPast> past);
  /// Takes down the means of a first pass of which nothing else is asked: all pixels get as many samples again.
  void take_means(const Film& film);
  /// The samples of the pass are counted on the film, whose light is all there.
  void end_pass(const Film& film, const Pass& pass);
  /// Remembers what is expected now, before the next pass.
  void begin_pass();

  /// The square of the error of a pixel's mean, as it is on the film.
  double square_error(const Film& film, std::uint32_t pixel) const;
  /// By what its square error falls when its samples double.
  double doubling(std::uint32_t pixel) const { return 1 / (1 + fall(pixel)); }
  /// Nothing is known of why it should be uneven.
  bool looks_even(std::uint32_t pixel) const { return double{seen_[pixel]} < even_ && !has_detail(pixel); }
  std::span<const PixelPast> past() const { return past_; }

 private:
  struct Evidence {
    double sum = 0, weight = 0;
  };

  bool has_detail(std::uint32_t pixel) const { return detail_ != nullptr && detail_->has(pixel); }
  void note_evidence(const Film& film, const Pass& pass, std::uint32_t pixel);
  void note_changes(const Film& film, const Pass& pass, std::uint32_t pixel);
  double expected_growth(std::uint32_t pixel, std::uint32_t before, std::uint32_t now) const;
  void find_falls();
  double reported_limit(bool detail) const;
  double fall(std::uint32_t pixel) const { return fall_[has_detail(pixel) ? 1 : 0]; }
  double spread(std::uint32_t samples) const { return core::spread(samples, kind_); }
  void find_contrast(const Film& film);
  double detail_variance(std::uint32_t pixel, std::uint32_t samples) const;
  double unmet_detail(std::uint32_t pixel, std::uint32_t samples) const;
  double seen_error(const Film& film, std::uint32_t pixel) const;
  void find_unseen();
  std::uint32_t tile_of(std::uint32_t pixel) const;
  Evidence evidence_around(const std::vector<Evidence>& tiles, std::uint32_t tile) const;

  std::uint32_t width_, height_, tile_columns_, tile_rows_;
  const FineDetail* detail_;
  double even_;
  ErrorKind kind_;
  double contrast_ = 0;  ///< the square of that of details
  /// (V(n) - V(2n)) / V(2n) where n is half of a pixel's samples: of pixels without fine detail, and of those with it.
  std::array<double, 2> fall_{1, 1};
  std::vector<float> seen_;  ///< square errors, but for what is unseen
  std::vector<PixelPast> past_;
  std::vector<double> unseen_;  ///< of pixels that look even, by tile, times spread(samples)
};

}  // namespace dmpc::core
