// Results of `bench error` for one scene.
#pragma once

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

/// One setting, rendered once in each round.
struct Measurement {
  Setting setting;
  std::vector<double> seconds;  ///< phase `render`, by round, in seconds of processor time; empty: not measured yet
  std::uint64_t rays = 0;       ///< rays of all kinds
  std::uint64_t samples = 0;    ///< sum over all pixels
  std::uint64_t film_hash = 0;
  PictureError error;                         ///< against the reference: all errors, including sampling
  std::optional<PictureError> deterministic;  ///< against the base point's picture, if that has the same samples; not for paths

  bool is_done() const { return !seconds.empty(); }
};

struct SceneResult {
  std::string scene;
  int width = 0, height = 0;
  Setting base;
  std::uint32_t emitters = 0;  ///< number that the base point samples as lights
  Reference reference;         ///< its picture is emptied when the scene is finished
  std::uint32_t reference_samples_a_side = 0;
  std::vector<Point> points;
  std::vector<std::size_t> measurement_of;  ///< by point: the index of its setting's measurement
  std::vector<Measurement> measurements;
  std::optional<PictureError> arithmetic;  ///< error of the base point's picture against the same samples in double

  const Measurement& of(std::size_t point) const { return measurements[measurement_of[point]]; }
  std::uint64_t pixels() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

/// Returns whether an error is claimed: the reference's own error, which may be a part of it, is at most a tenth of it.
bool is_claimed(const SceneResult& result, const Measurement& measurement);

/// Returns the root mean square error without the reference's own: both are independent, so their squares add up. Returns nothing
/// if the rest is less than twice the reference's own error.
std::optional<double> error_without_reference(const SceneResult& result, const Measurement& measurement);

/// The interval of the error without the reference's own, which is only estimated: `low` if the reference's is twice the
/// estimate, `high` if it is zero, and `middle` if the estimate is right; each is at least a tenth of `high`, since logarithms
/// are drawn.
struct ErrorInterval {
  double low = 0, middle = 0, high = 0;
};
ErrorInterval error_interval(const SceneResult& result, const Measurement& measurement);

/// Returns the deterministic error of a point if its knob has one and it is measured.
std::optional<PictureError> deterministic_error(const SceneResult& result, std::size_t point);

/// A measured render: its cost (rays, or seconds) and its error. Both are above 0 where logarithms are taken.
struct CostPoint {
  double cost = 0, error = 0;
};

/// Returns which points no other one beats: no other point has a smaller error at the same or less cost, or the same error at
/// less cost. All of several equal points are on the front. Points with `is_eligible` false are not on it, and beat none.
std::vector<bool> pareto_front(std::span<const CostPoint> points, const std::vector<bool>& is_eligible);

/// Returns the cost at which a curve through `points`, in any order, reaches `error`: linearly interpolated in the logarithms of
/// both between the two neighbours by error. Returns nothing outside the range of errors. Points without cost or error are left
/// out; of several with one error the cheapest counts.
std::optional<double> cost_at(std::span<const CostPoint> points, double error);

}  // namespace dmpc::apps
