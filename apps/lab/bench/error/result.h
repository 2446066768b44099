// Results of `bench error` for one scene.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/lab/bench/error/sweep.h"
#include "apps/lab/difference/picture_error.h"
#include "apps/lab/oracle/reference/reference.h"

namespace dmpc::apps {

/// Pixels are dealt to so many groups by a hash. What the groups differ in says how far chance moves an error.
inline constexpr std::size_t pixel_groups = 64;

/// One setting, rendered once in each round.
struct Measurement {
  Setting setting;
  std::vector<double> seconds;  ///< phase `render`, by round, in seconds of processor time; empty: not measured yet
  std::uint64_t rays = 0;       ///< rays of all kinds
  std::uint64_t samples = 0;    ///< sum over all pixels
  std::uint64_t film_hash = 0;
  PictureError error;                         ///< against the reference, whose own error is a part of it
  std::vector<double> squares;                ///< square_errors()
  std::optional<PictureError> deterministic;  ///< against the base point's picture, if that has the same samples; not for paths

  bool is_done() const { return !seconds.empty(); }
  /// Other processes can only add to it. Requires is_done().
  double least_seconds() const { return *std::ranges::min_element(seconds); }
};

struct SceneResult {
  std::string scene;
  int width = 0, height = 0;
  Setting base;
  std::uint32_t emitters = 0;  ///< number that the base point samples as lights
  Reference reference;         ///< its images are emptied when the scene is finished
  std::uint32_t reference_samples_a_side = 0;
  std::vector<Point> points;
  std::vector<std::size_t> measurement_of;  ///< by point: the index of its setting's measurement
  std::vector<Measurement> measurements;
  std::optional<PictureError> arithmetic;  ///< error of the base point's picture against the same samples in double

  const Measurement& of(std::size_t point) const { return measurements[measurement_of[point]]; }
  std::uint64_t pixels() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

/// Returns the mean square error of `picture` by group of pixels, without the reference's own error: sums of (P - A)(P - B) over
/// channels, divided by the number of all channels, for a reference with the halves A and B. Both have independent errors, so the
/// groups' sum is on average that of P alone; it can be below 0.
std::vector<double> square_errors(const Image& picture, const Reference& reference);

/// Returns the root of the groups' sum, 0 for a sum below 0. Without the group `left_out`, if it is below pixel_groups.
double error_of(const Measurement& measurement, std::size_t left_out = pixel_groups);

/// Returns whether a measured error is at least the reference's own: smaller ones are not drawn, compared or on a front.
bool is_told(const SceneResult& result, const Measurement& measurement);

/// An estimate with its interval of 95 %.
struct Estimate {
  double low = 0, middle = 0, high = 0;
};
/// The interval, in proportion to the error, is that of the groups' sum: two standard deviations, by how much the groups differ.
/// Requires an error above 0.
Estimate error_interval(const Measurement& measurement);

/// Returns the deterministic error of a point if its knob has one and it is measured.
std::optional<PictureError> deterministic_error(const SceneResult& result, std::size_t point);

/// A measured render: its cost (rays, or seconds) and its error. Both are above 0 where logarithms are taken.
struct CostPoint {
  double cost = 0, error = 0;
};

/// Returns which points no other one beats: no other point has a smaller error at the same or less cost, or the same error at
/// less cost. All of several equal points are on the front. Points with `is_drawn` false are not on it, and beat none.
std::vector<bool> pareto_front(std::span<const CostPoint> points, const std::vector<bool>& is_drawn);

/// Errors so far beyond a curve, as a factor, still have a cost, by its straight continuation.
inline constexpr double curve_reach = 1.1;

/// Returns the cost at which a curve through `points`, in any order, reaches `error`: linearly interpolated in the logarithms of
/// both between the two neighbours by error. Returns nothing beyond curve_reach, and beyond a single point. Points without cost
/// or error are left out; of several with one error the cheapest counts.
std::optional<double> cost_at(std::span<const CostPoint> points, double error);

}  // namespace dmpc::apps
