// Chooses among the functions that Highway compiles for each instruction set.
#pragma once

#include <array>
#include <cstddef>

#include "core/base/vector_width.h"

namespace dmpc::core {

/// For a function that is compiled for several instruction sets (nullptr where it is not): number `rank` of those that this
/// processor has, the fastest first; nullptr if there are no more.
template <class Function>
Function* compiled_for(std::size_t rank, Function* by_512, Function* by_256, Function* by_any) {
  const VectorWidth width = vector_width();
  const std::array<Function*, 3> had{width >= VectorWidth::bits_512 ? by_512 : nullptr,
                                     width >= VectorWidth::bits_256 ? by_256 : nullptr, by_any};
  for (Function* const function : had) {
    if (function != nullptr && rank-- == 0) {
      return function;
    }
  }
  return nullptr;
}

}  // namespace dmpc::core

/// compiled_for() of a function in HWY_NAMESPACE, after Highway's header. Highway's own dispatch chooses the same, but loads its
/// library, which measures this processor's clock for 4 ms at every program start.
#define DMPC_COMPILED_FOR(rank, function)                                                              \
  ::dmpc::core::compiled_for<decltype(HWY_STATIC_DISPATCH(function))>(rank, HWY_CHOOSE_AVX3(function), \
                                                                      HWY_CHOOSE_AVX2(function), &HWY_STATIC_DISPATCH(function))
