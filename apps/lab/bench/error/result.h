// What `bench error` found for one scene.
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
  PictureError error;                         ///< against the reference: sampling and all else
  std::optional<PictureError> deterministic;  ///< against the base point's picture, if that has the same samples; not by paths

  bool is_done() const { return !seconds.empty(); }
};

struct SceneResult {
  std::string scene;
  int width = 0, height = 0;
  Setting base;
  std::uint32_t emitters = 0;  ///< that the base point aims at
  Reference reference;         ///< its picture is empty when the scene is done with
  std::uint32_t reference_samples_a_side = 0;
  std::vector<Point> points;
  std::vector<std::size_t> measurement_of;  ///< by point: its setting's place among the measurements
  std::vector<Measurement> measurements;
  std::optional<PictureError> arithmetic;  ///< error of the base point's picture against the same samples in double

  const Measurement& of(std::size_t point) const { return measurements[measurement_of[point]]; }
  std::uint64_t pixels() const { return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height); }
};

/// An error is claimed if the reference's own one, which may be a part of it, is at most a tenth of it.
bool is_claimed(const SceneResult& result, const Measurement& measurement);

/// The root mean square error without the reference's own: both are independent, so their squares add up. Nothing if less than
/// twice the reference's own is left to be told from it.
std::optional<double> error_without_reference(const SceneResult& result, const Measurement& measurement);

/// What the error may be without the reference's own, of which only an estimate is known: `low` if it is twice that, `high` if
/// there is none, and between them the error if it is right; at least a tenth of `high`, since logarithms are drawn.
struct ErrorInterval {
  double low = 0, middle = 0, high = 0;
};
ErrorInterval error_interval(const SceneResult& result, const Measurement& measurement);

/// The deterministic error of a point's knob, where it has one and is measured.
std::optional<PictureError> deterministic_error(const SceneResult& result, std::size_t point);

/// A measured render: what it took (rays, or seconds) and how far it is off. Both above 0 where logarithms are taken.
struct CostPoint {
  double cost = 0, error = 0;
};

/// Which points no other one is better than: none costs less or as much and has a smaller error, or the same error for less.
/// All of several points that are equal in both are on the front. Points with `is_eligible` false are not, and beat none.
std::vector<bool> pareto_front(std::span<const CostPoint> points, const std::vector<bool>& is_eligible);

/// The cost at which a curve through `points`, in any order, comes to `error`: on a straight line in the logarithms of both
/// between the two neighbours by error. Nothing outside the errors that there are. Points without cost or error are left out; of
/// several with one error the cheapest counts.
std::optional<double> cost_at(std::span<const CostPoint> points, double error);

}  // namespace dmpc::apps
