// Certificates of hits against rational arithmetic, which rounds nothing. GMP is named in exact.cpp only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/database/database.h"
#include "core/record/ray.h"
#include "core/trace/certificate.h"

namespace dmpc::apps {

/// What of a hit's certificate does not hold.
enum class CertificateFault : std::uint8_t {
  none,
  no_answer,  ///< there is no exact answer, but it claims one
  distance,   ///< the exact t lies outside its interval
  weights,    ///< the exact u or v do
  hit,        ///< the hit's t is farther from the exact one than it allows
  edge        ///< the exact ray passes the triangle farther from an edge than it allows
};
inline constexpr std::size_t certificate_fault_count = 6;
/// A few words for reports.
std::string_view name_of(CertificateFault fault);

/// Holds `certificate`, of a hit of `ray` on `values` at `t`, against the exact answer that
/// core/trace/certificate.h defines. An undecided certificate claims nothing and has no fault. Thread-safe.
CertificateFault fault_of(const core::Ray& ray, const core::PrimitiveValues& values, float t,
                          const core::Certificate& certificate);

/// The exact answer rounded to double, for reports and tests: t, u, v; NaN where there is none. A triangle's.
std::array<double, 3> exact_answer(const core::Ray& ray, const core::PrimitiveValues& triangle);

}  // namespace dmpc::apps
