// The error of a picture's pixels, estimated from the film, and from what is known of the scene.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/picture/film/film.h"
#include "core/picture/sampling/fine_detail.h"
#include "core/picture/sampling/sample_pass.h"

namespace dmpc::core {

/// Where the error of a pixel's mean comes from: edges of objects and shadows, over which a pixel's samples are evenly spread, or
/// noise of random numbers, which paths use at every hit.
enum class ErrorKind : std::uint8_t { edges, noise };

/// What an estimate remembers of a pixel in addition to the film.
struct PixelPast {
  /// Mean scaled light when the current pass was chosen: to 2^-24 of itself, so the change of a pixel whose samples double twice
  /// has that precision, too.
  std::array<float, 3> mean{};
  float expected = -1;  ///< its square error then, if it looked even; less than 0: it did not
  float evidence = 0;   ///< unseen error, shown by this pixel for others that look even, times spread(samples)
  float weight = 0;     ///< the evidence's: 1 at first, halved after each pass
  /// The squared difference between the mean of all of its samples and that of the first half, times spread(samples); for noise,
  /// combined with what earlier changes predict.
  float change = 0;
  /// Sums over passes that brought three quarters of its samples: of that change then, and of the first quarter's.
  float reported_change = 0, reported_quarter_change = 0;

  bool operator==(const PixelPast&) const = default;
};

/// The divisor of the variance of a mean of evenly spread samples. Edges: samples^(3/2) (D. P. Mitchell, "Consequences of
/// Stratified Sampling in Graphics", SIGGRAPH 1996). Noise: samples^(5/4), between errors that fall as samples^(-1/2), where
/// paths are long, and as samples^(-4/5), where one number decides.
double spread(std::uint32_t samples, ErrorKind kind = ErrorKind::edges);

/// Squared errors of the means of pixels, in scaled light; not thread-safe.
///
/// *From the film*: as all blocks of a scrambled sequence are alike, the squared difference between a pixel's mean of n samples
/// and that of 2n is, on average, V(n) - V(2n), the decrease of the variance of the mean. The remaining variance follows from how
/// fast it falls: V(n) / V(2n) is 2 for random samples, and more for edges. It is measured by the pixels that got three quarters
/// of their samples in a pass: (V(n) - V(4n)) / (V(2n) - V(4n)) is one more than that ratio, if it is the same for both
/// doublings. One difference says little, and may be 0 by chance; so a pixel's variance is the mean over it and its neighbours,
/// and at least what the contrast between them suggests. For noise the pixel itself is left out of both: stopping by a pixel's
/// own samples is biased (D. Kirk, J. Arvo, "Unbiased Sampling Techniques for Image Synthesis", SIGGRAPH 1991).
///
/// *From the scene*: a pixel with fine detail (core/picture/sampling/fine_detail.h) is unlike its neighbours without. Only
/// neighbours with detail count in its mean, and the error that the pixel's detail would cause counts as much as the pixel
/// itself; as long as it looks even, its detail may have been missed altogether. The contrast of details is estimated from all
/// such pixels together.
///
/// *From neither*: some of the pixels that look even and have no such detail get more samples at random. How much their means
/// change, beyond what was expected, is evidence of the error of those that get no more, nearby and in the whole picture.
class ErrorEstimate {
 public:
  /// `detail` outlives it, if given. Pixels below `even`, a squared error, look even.
  ErrorEstimate(int width, int height, const FineDetail* detail, double even, ErrorKind kind = ErrorKind::edges);

  /// Resumes with the past of the current pass, one entry per pixel.
  void resume(std::span<const PixelPast> past);
  /// Records the means of a first pass that is used for nothing else: all pixels get as many samples again.
  void take_means(const Film& film);
  /// To be called when the samples of the pass are counted on the film, and all their light is there.
  void end_pass(const Film& film, const Pass& pass);
  /// Records what is expected now, before the next pass.
  void begin_pass();

  /// The squared error of a pixel's mean, as it is on the film.
  double square_error(const Film& film, std::uint32_t pixel) const;
  /// The factor by which its squared error falls when its samples double.
  double doubling(std::uint32_t pixel) const { return 1 / (1 + fall(pixel)); }
  /// Whether there is no known reason why it should be uneven.
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
  double contrast_ = 0;  ///< the squared contrast of details
  /// (V(n) - V(2n)) / V(2n) where n is half of a pixel's samples: for pixels without fine detail, and with it.
  std::array<double, 2> fall_{1, 1};
  std::vector<float> seen_;  ///< squared errors, without what is unseen
  std::vector<PixelPast> past_;
  std::vector<double> unseen_;  ///< squared errors of pixels that look even, by tile, times spread(samples)
};

}  // namespace dmpc::core
