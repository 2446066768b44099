// Checks certificates of hits against rational arithmetic, which rounds nothing: how many hold, and how wide their intervals are.
// Only exact.cpp names GMP.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/database/database.h"
#include "core/record/ray.h"
#include "core/trace/certificate.h"

namespace dmpc::apps {

/// The part of a hit's certificate that does not hold.
enum class CertificateFault : std::uint8_t {
  none,
  no_answer,  ///< the certificate claims an answer, but there is no exact one
  distance,   ///< the exact t lies outside its interval
  weights,    ///< the exact u or v lies outside its interval
  hit,        ///< the hit's t is farther from the exact one than the certificate allows
  edge        ///< the exact ray passes the triangle farther from an edge than the certificate allows
};
inline constexpr std::size_t certificate_fault_count = 6;
std::string_view name_of(CertificateFault fault);

/// Checks `certificate`, of a hit of `ray` on `values` at `t`, against the exact answer that core/trace/certificate.h defines. An
/// undecided certificate claims nothing and has no fault. Thread-safe.
CertificateFault fault_of(const core::Ray& ray, const core::PrimitiveValues& values, float t,
                          const core::Certificate& certificate);

/// One hit. Units in the last place are those of a float: of the hit's t, or of the exact t if that is greater.
struct CertifiedHit {
  CertificateFault fault = CertificateFault::none;
  bool is_decided = false;  ///< if not, the others have no meaning
  bool is_inside = false;   ///< the exact ray certainly meets the triangle
  double width_ulp = 0;     ///< width of the interval that holds the exact t
  double error_ulp = 0;     ///< upper bound of the error of the hit's t: the distance from the far end of that interval
  double allowed_ulp = 0;   ///< error that the kernels' bound allows
};

/// Certifies a hit of `ray` on `values` at `t`. Thread-safe.
CertifiedHit certified(const core::Ray& ray, const core::PrimitiveValues& values, float t);

/// Any number of values, kept for their median.
class Spread {
 public:
  void add(double value) { values_.push_back(value); }
  /// 0 if there are none.
  double median() const;
  double worst() const;

 private:
  std::vector<double> values_;
};

struct CertifiedCounts {
  std::uint64_t hits = 0, undecided = 0, inside = 0;
  std::array<std::uint64_t, certificate_fault_count> faults{};
  Spread width_ulp;               ///< width over decided hits
  Spread error_ulp, allowed_ulp;  ///< over hits that are certainly on their primitive: the exact t of others may lie anywhere on
                                  ///< the plane

  void count(const CertifiedHit& hit);
  std::uint64_t failures() const;
};

}  // namespace dmpc::apps
