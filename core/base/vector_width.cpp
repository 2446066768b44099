#include "core/base/vector_width.h"

namespace dmpc::core {
namespace {

VectorWidth widest() {
  __builtin_cpu_init();
  const bool has_256 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("bmi") != 0 &&
                       __builtin_cpu_supports("bmi2") != 0 && __builtin_cpu_supports("fma") != 0;
  const bool has_512 = has_256 && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
                       __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
                       __builtin_cpu_supports("avx512vl") != 0;
  return has_512 ? VectorWidth::bits_512 : has_256 ? VectorWidth::bits_256 : VectorWidth::any;
}

}  // namespace

VectorWidth vector_width() {
  static const VectorWidth width = widest();
  return width;
}

}  // namespace dmpc::core
