#include "apps/frontend/run/work.h"

#include <initializer_list>

#include "core/trace/charge.h"

namespace dmpc::apps {
namespace {

constexpr nodes::ChargeBits bits_of(std::initializer_list<core::Charge> charges) {
  std::uint32_t bits = 0;
  for (const core::Charge charge : charges) {
    bits |= 1U << static_cast<std::uint32_t>(charge);
  }
  return static_cast<nodes::ChargeBits>(bits);
}

using core::Charge;
constexpr nodes::ChargeBits shade_bits = bits_of({Charge::shading, Charge::tile_read});
constexpr nodes::ChargeBits trace_bits =
    bits_of({Charge::ray_setup, Charge::cell_step, Charge::bvh_node_read, Charge::triangle_test, Charge::sphere_test,
             Charge::cone_test, Charge::home_lookup, Charge::cached_lookup, Charge::question_setup});
constexpr nodes::ChargeBits install_bits = bits_of({Charge::page_install}), pack_bits = bits_of({Charge::ray_packing});

Work work_for(Doing doing) {
  switch (doing) {
    case Doing::trace:
      return Work::tracing;
    case Doing::shade:
      return Work::shading;
    case Doing::install:
      return Work::installing;
    case Doing::pack:
      return Work::packing;
    default:
      return Work::overhead;
  }
}

Work work_for(const nodes::Span& span) {
  switch (span.activity) {
    case nodes::Activity::send:
    case nodes::Activity::take_over:
      return Work::messages;
    case nodes::Activity::serve:
      return span.is_in_idle ? Work::service_idle : Work::service_busy;
    default:
      return work_for(doing_of(span.charged()));
  }
}

}  // namespace

Doing doing_of(nodes::ChargeBits charged) {
  const auto any = [charged](nodes::ChargeBits bits) { return (charged & bits) != 0; };
  return any(shade_bits)     ? Doing::shade
         : any(trace_bits)   ? Doing::trace
         : any(install_bits) ? Doing::install
         : any(pack_bits)    ? Doing::pack
                             : Doing::other;
}

std::size_t work_of(const nodes::Span& span) { return static_cast<std::size_t>(work_for(span)); }

}  // namespace dmpc::apps
